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
use std::cmp::Reverse;

/// Offsets of contours are the same within this, µm.
const SAME_OFFSET: f64 = 3.0;

impl Foreign<'_> {
    /// What is told of all passes.
    pub(super) fn told(self) -> Option<Seen> {
        if self.judged.is_empty() && self.beyond.is_none() {
            return None;
        }
        let mut differences = self.sides();
        let is_other = |one: &Difference| one.kind == DifferenceKind::OtherSide;
        // 4B is the part itself.
        if !differences.iter().any(is_other) && !self.traced.four_b {
            differences.extend(self.corrections());
        }
        let blocks = &self.traced.blocks;
        let of_block =
            |index: usize, kind| Some(Difference::of(blocks.get(index)?, None, 0.0, kind));
        let unknown = self.unknown.iter();
        differences.extend(unknown.filter_map(|at| of_block(*at, DifferenceKind::Foreign)));
        differences.extend(
            self.beyond
                .and_then(|at| of_block(at, DifferenceKind::Beyond)),
        );
        let of_passes = self.judged.iter().flat_map(|judged| &judged.differences);
        differences.extend(of_passes.cloned());
        differences.sort_by_key(|one| one.range.start);
        let follows = self.judged.iter().flat_map(|judged| &judged.follows);
        let follows = follows.filter_map(|index| Some(blocks.get(*index)?.range.clone()));
        let mut cut: Vec<usize> = self.judged.iter().map(|it| it.course.contour).collect();
        cut.dedup();
        let contours = self.drawn.contours();
        let handle = |contour: &usize| {
            let first = contours.get(*contour)?.segments.first()?;
            Some(self.drawn.handle(first.entity).to_owned())
        };
        let is_some = cut.len() < contours.len();
        Some(Seen {
            handles: is_some.then(|| cut.iter().filter_map(handle).collect()),
            comparison: Comparison {
                follows: follows.collect(),
                differences,
            },
        })
    }

    /// Contours whose first pass lies farther from them than those of most others, or than the settings say.
    fn corrections(&self) -> Vec<Difference> {
        let mut firsts: Vec<&Judged> = Vec::new();
        for judged in &self.judged {
            let contour = judged.course.contour;
            if firsts.iter().all(|first| first.course.contour != contour) {
                firsts.push(judged);
            }
        }
        let block = |judged: &Judged| self.traced.blocks.get(judged.first);
        let offset = |judged: &Judged| judged.course.offset.abs();
        let is_path = |judged: &Judged| block(judged).is_some_and(|block| block.side.is_none());
        firsts.retain(|judged| is_path(judged) && offset(judged) > NONE);
        let set = self.drawn.settings.each_correction();
        let set = set.first().map_or(0.0, |mm| mm * 1e3);
        let are_same = |one: f64, other: f64| (one - other).abs() <= SAME_OFFSET;
        let rank = |one: &&&Judged| {
            let own = offset(one);
            let alike = firsts.iter().filter(|other| are_same(offset(other), own));
            (alike.count(), are_same(own, set), Reverse(one.first))
        };
        let of_contour = |one: &Judged| self.drawn.contours().get(one.course.contour);
        let is_on_line = |one: &Judged| of_contour(one).is_some_and(|it| it.on_line);
        let most = firsts.iter().filter(|one| !is_on_line(one));
        let most = most.max_by_key(rank).map(|most| offset(most));
        let nm = |um: f64| (um * 1e3).round() as u32;
        let named = firsts.iter().filter_map(|one| {
            let (own, most) = match is_on_line(one) {
                true => (offset(one), 0.0),
                false => (offset(one), most?),
            };
            let kind = DifferenceKind::Correction {
                stated: nm(own),
                ideal: nm(most),
            };
            let contour = self.drawn.contours().get(one.course.contour)?;
            let segment = contour.segments.first()?;
            let source = Some((segment.entity, segment.segment));
            let block = block(one).filter(|_| !are_same(own, most))?;
            Some(Difference::of(block, source, 0.0, kind))
        });
        named.collect()
    }

    /// Passes on another side of their contour than the drawing has it, or under no correction where others are.
    fn sides(&self) -> Vec<Difference> {
        if self.traced.four_b {
            return Vec::new();
        }
        let is_offset = self.traced.blocks.iter().any(|block| block.side.is_some());
        let asked = self.drawn.settings.compensation;
        let wants = is_offset || asked == Compensation::Controller && !self.traced.counts;
        let mut found = Vec::new();
        let (mut sided, mut on_other) = (0, 0);
        for judged in &self.judged {
            let course = &judged.course;
            let contour = self.drawn.contours().get(course.contour);
            let block = self.traced.blocks.get(judged.first);
            let (Some(side), Some(block)) = (contour.and_then(|it| it.side), block) else {
                continue;
            };
            let ideal = if course.back { side.reversed() } else { side };
            if course.offset.abs() > NONE {
                sided += 1;
                on_other += usize::from((course.offset > 0.0) != (side == Side::Left));
            } else if wants && block.side != Some(ideal) {
                found.push(self.at_switch(judged.first, block, ideal));
            }
        }
        if !is_offset {
            found.truncate(1);
        }
        if sided > 0 && on_other == sided && asked != Compensation::None {
            let first = self.judged.first();
            let first = first.and_then(|first| self.traced.blocks.get(first.first));
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
