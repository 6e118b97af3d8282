//! What is said of the passes of a program of another writer, all of them together: their differences, their sides, and
//! their corrections.

use super::difference::{Comparison, Difference};
use super::foreign::{Foreign, Seen};
use super::judged::Judged;
use super::ring::NONE;
use super::traced::Block;
use crate::finding::DifferenceKind;
use crate::geometry::Side;
use crate::settings::Compensation;

/// Offsets of contours are the same within this, µm.
const SAME_OFFSET: f64 = 3.0;

impl Foreign<'_> {
    /// What is told of all passes.
    pub(super) fn told(self) -> Option<Seen> {
        if self.judged.is_empty() && self.beyond.is_none() {
            return None;
        }
        let mut differences: Vec<Difference> = self.sides();
        let is_other_side = differences
            .iter()
            .any(|one| one.kind == DifferenceKind::OtherSide);
        // 4B is the part itself.
        if !is_other_side && !self.traced.four_b {
            differences.extend(self.corrections());
        }
        let unknown = self
            .unknown
            .iter()
            .filter_map(|index| self.traced.blocks.get(*index));
        differences
            .extend(unknown.map(|block| Difference::of(block, None, 0.0, DifferenceKind::Foreign)));
        let beyond = self.beyond.and_then(|index| self.traced.blocks.get(index));
        differences
            .extend(beyond.map(|block| Difference::of(block, None, 0.0, DifferenceKind::Beyond)));
        let mut follows = Vec::new();
        for judged in &self.judged {
            differences.extend(judged.differences.iter().cloned());
            let blocks = judged
                .follows
                .iter()
                .filter_map(|index| self.traced.blocks.get(*index));
            follows.extend(blocks.map(|block| block.range.clone()));
        }
        differences.sort_by_key(|one| one.range.start);
        let mut cut: Vec<usize> = self
            .judged
            .iter()
            .map(|judged| judged.pass.contour)
            .collect();
        cut.dedup();
        let handle = |contour: &usize| {
            let contour = self.drawn.contours().get(*contour)?;
            Some(
                self.drawn
                    .handle(contour.segments.first()?.entity)
                    .to_owned(),
            )
        };
        let is_some = cut.len() < self.drawn.contours().len();
        Some(Seen {
            handles: is_some.then(|| cut.iter().filter_map(handle).collect()),
            comparison: Comparison {
                differences,
                follows,
            },
        })
    }

    /// Contours whose first pass lies farther from them than those of most others, or than the settings say.
    fn corrections(&self) -> Vec<Difference> {
        let mut firsts: Vec<&Judged> = Vec::new();
        for judged in &self.judged {
            let is_new = firsts
                .last()
                .is_none_or(|last| last.pass.contour != judged.pass.contour);
            let is_known = firsts
                .iter()
                .any(|first| first.pass.contour == judged.pass.contour);
            let block = self.traced.blocks.get(judged.first);
            let is_path = block.is_some_and(|block| !block.is_offset());
            if is_new && !is_known && is_path && judged.pass.offset.abs() > NONE {
                firsts.push(judged);
            }
        }
        let like = |offset: f64| {
            let alike = |one: &&&Judged| (one.pass.offset.abs() - offset).abs() <= SAME_OFFSET;
            firsts.iter().filter(alike).count()
        };
        let set = self.drawn.settings.each_correction();
        let set = set.first().map_or(0.0, |mm| mm * 1e3);
        let rank = |one: &&&Judged| {
            let own = one.pass.offset.abs();
            (
                like(own),
                (own - set).abs() <= SAME_OFFSET,
                std::cmp::Reverse(one.first),
            )
        };
        let Some(most) = firsts
            .iter()
            .max_by_key(rank)
            .map(|one| one.pass.offset.abs())
        else {
            return Vec::new();
        };
        let others = firsts
            .iter()
            .filter(|one| (one.pass.offset.abs() - most).abs() > SAME_OFFSET);
        let nm = |um: f64| (um * 1e3).round() as u32;
        let named = others.filter_map(|one| {
            let block = self.traced.blocks.get(one.first)?;
            let contour = self.drawn.contours().get(one.pass.contour)?;
            let segment = contour.segments.first()?;
            let kind = DifferenceKind::Correction {
                stated: nm(one.pass.offset.abs()),
                ideal: nm(most),
            };
            Some(Difference::of(
                block,
                Some((segment.entity, segment.segment)),
                0.0,
                kind,
            ))
        });
        named.collect()
    }

    /// Passes on another side of their contour than the drawing has it, or under no correction where others are.
    fn sides(&self) -> Vec<Difference> {
        let is_offset = self.traced.blocks.iter().any(Block::is_offset);
        let asked = self.drawn.settings.compensation;
        let (mut found, mut on_other) = (Vec::new(), 0);
        let mut sided = 0;
        for judged in &self.judged {
            let Some(side) = self
                .drawn
                .contours()
                .get(judged.pass.contour)
                .and_then(|it| it.side)
            else {
                continue;
            };
            let Some(block) = self.traced.blocks.get(judged.first) else {
                continue;
            };
            if judged.pass.offset.abs() > NONE {
                sided += 1;
                on_other += usize::from((judged.pass.offset > 0.0) != (side == Side::Left));
                continue;
            }
            let ideal = if judged.pass.back {
                side.reversed()
            } else {
                side
            };
            let wants = is_offset || asked == Compensation::Controller && !self.traced.counts;
            if wants && block.side != Some(ideal) && !self.traced.four_b {
                found.push(self.at_switch(judged.first, block, ideal));
            }
        }
        if !is_offset {
            found.truncate(1);
        }
        if sided > 0 && on_other == sided && asked != Compensation::None && !self.traced.four_b {
            let first = self
                .judged
                .first()
                .and_then(|first| self.traced.blocks.get(first.first));
            let kind = DifferenceKind::OtherSide;
            found.extend(first.map(|block| Difference::of(block, None, 0.0, kind)));
        }
        found
    }

    fn at_switch(&self, index: usize, block: &Block, ideal: Side) -> Difference {
        let kind = DifferenceKind::Side {
            stated: block.side,
            ideal: Some(ideal),
        };
        // It is switched on before the way in.
        let of_pass = |at: &usize| {
            let other = self.traced.blocks.get(*at);
            other.is_some_and(|other| other.stretch == block.stretch)
        };
        let first = (0..=index).rev().take_while(of_pass).last();
        Difference::at_switch(self.traced, block, first.unwrap_or(index), kind)
    }
}
