//! A program of another writer: each pass follows the way of the wire round one contour at one offset.
//!
//! Ways in and out are not judged, nor is where the wire is threaded or where a contour is begun. After a wrong block
//! the comparison goes on from where the program does.

use super::budget::Budget;
use super::difference::{Comparison, Difference, DifferenceKind};
use super::drawn::Drawn;
use super::passes::{Pass, passes};
use super::place::{of_size, place, refined};
use super::ring::{Course, NONE, Ring};
use super::traced::{Block, Cut, Motion, Traced};
use super::walk::{At, COVERED, WITHIN, WITHIN_FOUR_B, Walk};
use super::walls::FARTHEST;
use crate::geometry::{Point, Side, Vector};
use crate::settings::{Compensation, Corner};
use std::ops::Range;

/// At most so many blocks lead to a contour; and so many corners of a ring are tried where it begins.
const LEADS: usize = 4;
const ENTRIES: usize = 200;
/// From so many blocks on that follow, a pass has begun.
const BEGUN: usize = 3;
/// An arc in a sharp corner leaves no more of it than this, µm.
const ROUNDED: f64 = 300.0;
/// A table is moved by hand at least this far, µm.
const BY_HAND: f64 = 1_000.0;
/// Offsets of contours are the same within this, µm.
const SAME_OFFSET: f64 = 3.0;
/// Of so many blocks of a pass one may be wrong; with more, it is another contour.
const ONE_OF: usize = 3;

/// What is seen of a program.
pub(super) struct Seen {
    pub(super) comparison: Comparison,
    /// Handles of the contours that it cuts, in its order, where it does not cut all.
    pub(super) handles: Option<Vec<String>>,
}

/// A pass that has been followed.
struct Judged {
    pass: Pass,
    /// The first block of its contour.
    first: usize,
    differences: Vec<Difference>,
    follows: Vec<usize>,
    /// Where the program lies behind it.
    shift: Vector,
}

pub(super) fn compare(drawn: &Drawn, traced: &Traced) -> Option<Seen> {
    if traced.is_empty() || drawn.contours().is_empty() {
        return None;
    }
    let budget = Budget::default();
    let mut foreign = Foreign {
        drawn,
        traced,
        shift: place(drawn, traced, &budget)?,
        has_place: traced.is_placed,
        budget,
        judged: Vec::new(),
        unknown: Vec::new(),
    };
    for cut in &traced.cuts {
        foreign.cut(cut);
    }
    foreign.told()
}

struct Foreign<'a> {
    drawn: &'a Drawn,
    traced: &'a Traced,
    budget: Budget,
    /// From the program's places to those of the drawing, as it is at the cut.
    shift: Vector,
    /// What lies elsewhere has been moved: the program says where it lies, or a contour of it has been followed.
    has_place: bool,
    judged: Vec<Judged>,
    /// First blocks of contours that are not in the drawing.
    unknown: Vec<usize>,
}

impl Foreign<'_> {
    fn cut(&mut self, cut: &Cut) {
        let walls = self.drawn.walls();
        let mut found = passes(self.traced, walls, cut, self.shift, &self.budget);
        let mut shift = self.shift;
        if !found.iter().any(|pass| pass.is_whole)
            && let Some((others, place)) = self.elsewhere(cut)
        {
            found = others;
            // Near where it should be, it may have parted from there amid the contour.
            if (place - shift).norm() > FARTHEST {
                shift = place;
            }
        }
        if found.is_empty() && cut.contour.len() > LEADS {
            self.unknown.push(cut.contour.start);
        }
        for pass in found {
            let Some(judged) = self.pass(&pass, shift) else {
                continue;
            };
            shift = judged.shift;
            self.shift = shift;
            self.has_place = true;
            self.judged.push(judged);
        }
    }

    /// A cut that goes round no contour where it is, but does nearby, or on a contour of its size.
    fn elsewhere(&self, cut: &Cut) -> Option<(Vec<Pass>, Vector)> {
        let walls = self.drawn.walls();
        let sized = of_size(self.drawn, self.traced, &cut.contour)
            .into_iter()
            .take(LEADS);
        let mut tried = std::iter::once(self.shift)
            .chain(sized)
            .filter_map(|place| {
                let shift = refined(self.drawn, self.traced, &cut.contour, place, &self.budget);
                let found = passes(self.traced, walls, cut, shift, &self.budget);
                let is_round = found.iter().any(|pass| pass.is_whole);
                is_round.then_some((found, shift))
            });
        tried.next()
    }

    /// Follows a pass, with round corners or with sharp ones, whichever leaves less to name.
    fn pass(&self, pass: &Pass, shift: Vector) -> Option<Judged> {
        let mut best: Option<Judged> = None;
        for course in self.courses(pass) {
            let Some(ring) = self.drawn.ring(&course) else {
                continue;
            };
            let judged = self.follow(pass, &ring, shift);
            let count =
                |judged: &Judged| (judged.differences.len(), usize::MAX - judged.follows.len());
            let is_better = |best: &Judged| {
                judged
                    .as_ref()
                    .is_some_and(|judged| count(judged) < count(best))
            };
            if best.as_ref().is_none_or(is_better) {
                best = judged.or(best);
            }
            if best
                .as_ref()
                .is_some_and(|best| best.differences.is_empty())
            {
                break;
            }
        }
        best
    }

    /// The ways that a pass may go.
    fn courses(&self, pass: &Pass) -> Vec<Course> {
        let course = |offset: f64, corner: Corner| Course {
            contour: pass.contour,
            offset,
            back: pass.back,
            corner,
            four_b: self.traced.four_b,
        };
        let offset = self.snapped(pass.offset);
        if self.traced.four_b {
            // The contour itself, with transitions for the wire's side.
            let side = self
                .drawn
                .contours()
                .get(pass.contour)
                .and_then(|contour| contour.side);
            let sides = side.map_or(vec![Side::Left, Side::Right], |side| vec![side]);
            let um = self.drawn.settings.correction * 1e3;
            return sides
                .into_iter()
                .map(|side| course(side.sign() * um, Corner::Arc))
                .collect();
        }
        match offset.abs() > NONE {
            true => [Corner::Arc, Corner::Intersection]
                .map(|corner| course(offset, corner))
                .into(),
            // On the contour itself there is nothing to go round.
            false => vec![course(offset, Corner::Arc)],
        }
    }

    /// An offset as the settings have it, where it is that of a pass.
    fn snapped(&self, offset: f64) -> f64 {
        const NEAR: f64 = 0.7;
        let set = self.drawn.settings.each_correction();
        let set = set.iter().map(|mm| (mm * 1e3).copysign(offset));
        let mut set = set.into_iter();
        let set = set.find(|set| (set - offset).abs() <= NEAR);
        // To a tenth of a micrometre.
        set.unwrap_or((offset * 10.0).round() / 10.0)
    }

    fn walk<'a>(&'a self, ring: &'a Ring, range: Range<usize>) -> Walk<'a> {
        Walk {
            ring,
            blocks: &self.traced.blocks,
            range,
            within: if self.traced.four_b {
                WITHIN_FOUR_B
            } else {
                WITHIN
            },
            counts: self.traced.counts,
            budget: &self.budget,
        }
    }

    fn follow(&self, pass: &Pass, ring: &Ring, shift: Vector) -> Option<Judged> {
        let walk = self.walk(ring, pass.blocks.clone());
        let (first, entry) = enter(&walk, shift)?;
        let mut judged = Judged {
            pass: pass.clone(),
            first,
            differences: Vec::new(),
            follows: Vec::new(),
            shift: entry.shift,
        };
        let named = |index: usize, along: f64, off: f64, kind: DifferenceKind| {
            let block = self.traced.blocks.get(index)?;
            Some(Difference::of(block, ring.source(along), off, kind))
        };
        let away = (entry.shift - shift).norm();
        if self.has_place && away > walk.within && !self.is_taken(pass, away) {
            let way = first
                .checked_sub(1)
                .filter(|way| walk.segment(*way).is_some());
            let kind = DifferenceKind::Moved;
            judged
                .differences
                .extend(named(way.unwrap_or(first), entry.along, away, kind));
        }
        let complete = match ring.closed {
            true => entry.along + ring.length - COVERED,
            false => ring.length - COVERED,
        };
        let (mut at, mut index, mut last) = (entry, first, None);
        while let Some(next) = walk.next(index) {
            if at.along >= complete && walk.follow(next, at).is_none() {
                break;
            }
            if let Some(along) = walk.follow(next, at) {
                judged.follows.push(next);
                (at.along, index, last) = (along, next + 1, Some(next));
                continue;
            }
            let deepest = pass.offset.abs().max(ROUNDED);
            if let Some(along) = walk.round_corner(next, at, deepest) {
                (at.along, index, last) = (along, next + 1, Some(next));
                continue;
            }
            let Some(resumed) = walk.resume(next, at, last, complete) else {
                if pass.is_whole {
                    self.leave(&walk, &mut judged, next, at, complete);
                }
                break;
            };
            let kind = DifferenceKind::Block;
            judged
                .differences
                .extend(named(resumed.wrong, at.along, resumed.off, kind));
            judged.follows.retain(|index| *index != resumed.wrong);
            (at, index, last) = (resumed.at, resumed.next, None);
        }
        let has_tab = self.traced.cuts.iter().any(|cut| {
            let blocks = self
                .traced
                .blocks
                .get(cut.blocks.clone())
                .unwrap_or_default();
            cut.blocks.contains(&first) && blocks.iter().any(|block| block.motion == Motion::Stop)
        });
        if at.along < complete && judged.differences.is_empty() && pass.is_whole && !has_tab {
            self.unfinished(&walk, &mut judged, entry, at);
        }
        judged.shift = at.shift;
        let wrong = judged.differences.len();
        if wrong > 1 && ONE_OF * wrong > judged.follows.len() {
            return None;
        }
        Some(judged)
    }

    /// A contour to which no block leads: the table is moved by hand, or the program sets where it is; each contour of 4B
    /// lies beside its place, by the correction where it begins.
    fn is_taken(&self, pass: &Pass, away: f64) -> bool {
        let at = pass.blocks.start;
        let cut = self
            .traced
            .cuts
            .iter()
            .position(|cut| cut.blocks.start == at);
        let before = cut.and_then(|cut| self.traced.cuts.get(cut.checked_sub(1)?));
        let leads = before.is_some_and(|before| {
            let between = self
                .traced
                .blocks
                .get(before.blocks.end..at)
                .unwrap_or_default();
            between.iter().any(|block| block.motion != Motion::Stop)
        });
        self.traced.four_b || cut.is_some() && before.is_some() && !leads && away > BY_HAND
    }

    /// A block that follows nothing: a way out, or one from which nothing comes back.
    fn leave(&self, walk: &Walk, judged: &mut Judged, index: usize, at: At, complete: f64) {
        let rest = (index..walk.range.end)
            .filter(|index| walk.segment(*index).is_some())
            .count();
        if rest <= LEADS && at.along >= complete - walk.ring.length * 0.5 {
            return;
        }
        let block = self.traced.blocks.get(index);
        let off = walk.off(index, at);
        judged.differences.extend(block.map(|block| {
            Difference::of(
                block,
                walk.ring.source(at.along),
                off,
                DifferenceKind::Block,
            )
        }));
    }

    /// A contour that is not cut all round, by more than a tab within a side of it.
    fn unfinished(&self, walk: &Walk, judged: &mut Judged, entry: At, at: At) {
        let Some(last) = judged
            .follows
            .last()
            .and_then(|last| self.traced.blocks.get(*last))
        else {
            return;
        };
        let (from, to) = match walk.ring.closed {
            true => (at.along, entry.along + walk.ring.length),
            false => (at.along, walk.ring.length),
        };
        // A first block that begins beside the contour.
        let before = judged.first.checked_sub(1);
        if let Some((before, own)) = before.and_then(|at| Some((at, walk.segment(at)?)))
            && (own.length() - (to - from)).abs() <= 0.1 * own.length() + COVERED
            && (own.end() + at.shift - walk.place(entry.along)).norm() <= walk.within
        {
            let off = (own.start() + at.shift - walk.place(at.along)).norm();
            let way = before
                .checked_sub(1)
                .filter(|way| walk.segment(*way).is_some());
            let block = self.traced.blocks.get(way.unwrap_or(before));
            judged.differences.extend(
                block.map(|block| Difference::of(block, None, off, DifferenceKind::Astray)),
            );
            return;
        }
        let corners = walk.ring.between(from + COVERED, to - COVERED);
        let corners = corners
            .filter(|(before, _)| *before > from + COVERED)
            .count();
        if corners > 0 || !walk.ring.closed {
            let kind = DifferenceKind::Unfinished;
            let source = walk.ring.source(from + COVERED);
            judged
                .differences
                .push(Difference::of(last, source, to - from, kind));
        }
    }

    /// What is told of all passes.
    fn told(self) -> Option<Seen> {
        if self.judged.is_empty() {
            return None;
        }
        let mut differences: Vec<Difference> = self.sides();
        let is_other_side = differences
            .iter()
            .any(|one| one.kind == DifferenceKind::OtherSide);
        if !is_other_side {
            differences.extend(self.corrections());
        }
        let unknown = self
            .unknown
            .iter()
            .filter_map(|index| self.traced.blocks.get(*index));
        differences
            .extend(unknown.map(|block| Difference::of(block, None, 0.0, DifferenceKind::Foreign)));
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
            if is_new && !is_known && judged.pass.offset.abs() > NONE {
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
        let mut found = Difference::of(block, None, 0.0, kind);
        // It is switched on before the way in.
        let of_pass = |at: &usize| {
            let other = self.traced.blocks.get(*at);
            other.is_some_and(|other| other.stretch == block.stretch)
        };
        let first = (0..=index).rev().take_while(of_pass).last();
        let switch = first.filter(|_| block.side.is_some());
        if let Some((range, line)) = switch.and_then(|first| self.traced.switch_before(first)) {
            (found.range, found.line) = (range, line);
        }
        found
    }
}

/// The first block of a pass that is of its contour, and where it begins: where the program lies, else from a corner of
/// the ring.
fn enter(walk: &Walk, shift: Vector) -> Option<(usize, At)> {
    let blocks = walk
        .range
        .clone()
        .filter(|index| walk.segment(*index).is_some());
    let blocks: Vec<usize> = blocks.take(LEADS + 1).collect();
    let length = walk.ring.length;
    let enough = |index: usize, at: At| {
        let left = walk.range.clone().skip_while(|own| *own < index);
        let left = left.filter(|own| walk.segment(*own).is_some()).count();
        let complete = at.along + length - COVERED;
        let followed = walk.count(index, at, BEGUN, complete);
        followed.count >= BEGUN.min(left) || followed.count > 0 && followed.along >= complete
    };
    let mut begins: Vec<(usize, At)> = Vec::new();
    for &index in &blocks {
        let start = walk.segment(index)?.start() + shift;
        if !walk.budget.take(walk.ring.pieces.len()) {
            return None;
        }
        let near = walk.ring.nearest(start, 0.0, length * (1.0 - 1e-12));
        let Some((along, _)) = near.filter(|(_, away)| *away <= walk.within) else {
            continue;
        };
        let at = At { along, shift };
        if walk.follow(index, at).is_some() {
            return Some((index, at));
        }
        begins.push((index, at));
    }
    // Its first block may be the wrong one.
    let goes_on = |(index, at): &(usize, At)| {
        let complete = at.along + length - COVERED;
        walk.resume(*index, *at, None, complete).is_some()
    };
    if let Some(begin) = begins.into_iter().find(goes_on) {
        return Some(begin);
    }
    let mut best: Option<(f64, usize, At)> = None;
    for &index in &blocks {
        let own = walk.segment(index)?;
        for piece in walk.ring.pieces.iter().take(ENTRIES) {
            let mut places: Vec<(f64, Point, Point)> =
                vec![(piece.before, piece.segment.start(), own.start())];
            if let (Some(arc), Some(other)) = (own.as_arc(), piece.segment.as_arc()) {
                let by = other.center - arc.center;
                let share = piece.segment.share_of(own.start() + by).clamp(0.0, 1.0);
                let along = piece.before + share * piece.segment.length();
                places.push((along, other.center, arc.center));
            }
            for (along, ideal, stated) in places {
                let at = At {
                    along,
                    shift: ideal - stated,
                };
                let away = (at.shift - shift).norm();
                let is_nearer = best.is_none_or(|(nearest, ..)| away < nearest - 1e-3);
                if is_nearer && enough(index, at) {
                    best = Some((away, index, at));
                }
            }
        }
    }
    best.map(|(_, index, at)| (index, at))
}
