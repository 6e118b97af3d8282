//! A program of another writer: each pass follows the way of the wire round one contour at one offset.
//!
//! Ways in and out are not judged, nor is where the wire is threaded or where a contour is begun. After a wrong block
//! the comparison goes on from where the program does.

use super::budget::Budget;
use super::difference::{Comparison, Difference, DifferenceKind};
use super::drawn::Drawn;
use super::entry::{begin, enter};
use super::passes::{Pass, passes, share};
use super::place::{of_size, place, refined};
use super::ring::{Course, NONE, Ring};
use super::traced::{Cut, Motion, Traced};
use super::walk::{At, COVERED, WITHIN, WITHIN_FOUR_B, Walk};
use super::walls::FARTHEST;
use crate::geometry::{Segment, Side, Vector};
use crate::settings::Corner;
use std::ops::Range;

/// At most so many blocks lead to a contour.
const LEADS: usize = 4;
/// An arc in a sharp corner leaves no more of it than this, µm.
const ROUNDED: f64 = 300.0;
/// A smaller deviation is the writer's rounding, or the drift of a machine that counts, µm.
const SLIGHT: f64 = 8.0;
/// A contour that is begun this near to where it ends is begun there, µm.
const NEAR: f64 = 1_500.0;
/// A table is moved by hand at least this far, µm.
const BY_HAND: f64 = 1_000.0;
/// Of so many blocks of a pass one may be wrong; with more, it is another contour.
const ONE_OF: usize = 3;

/// What is seen of a program.
pub(super) struct Seen {
    pub(super) comparison: Comparison,
    /// Handles of the contours that it cuts, in its order, where it does not cut all.
    pub(super) handles: Option<Vec<String>>,
}

/// A pass that has been followed.
pub(super) struct Judged {
    pub(super) pass: Pass,
    /// The first block of its contour.
    pub(super) first: usize,
    pub(super) differences: Vec<Difference>,
    pub(super) follows: Vec<usize>,
    /// How many blocks are wrong, whether they are named or not.
    pub(super) wrong: usize,
    /// The block behind its last one.
    pub(super) end: usize,
    /// Where the program lies behind it.
    pub(super) shift: Vector,
}

pub(super) fn compare(drawn: &Drawn, traced: &Traced) -> Option<Seen> {
    if traced.is_empty() || drawn.contours().is_empty() {
        return None;
    }
    let budget = Budget::default();
    let shift = place(drawn, traced, &budget)?;
    let mut foreign = Foreign {
        drawn,
        traced,
        shift,
        base: shift,
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

pub(super) struct Foreign<'a> {
    pub(super) drawn: &'a Drawn,
    pub(super) traced: &'a Traced,
    pub(super) budget: Budget,
    /// From the program's places to those of the drawing, as it is at the cut.
    pub(super) shift: Vector,
    /// The same as it was first found.
    pub(super) base: Vector,
    /// What lies elsewhere has been moved: the program says where it lies, or a contour of it has been followed.
    pub(super) has_place: bool,
    pub(super) judged: Vec<Judged>,
    /// First blocks of contours that are not in the drawing.
    pub(super) unknown: Vec<usize>,
}

impl Foreign<'_> {
    /// Follows the passes of a cut, one after the other: a wrong block in one may move all that come after it.
    fn cut(&mut self, cut: &Cut) {
        let mut rest = cut.clone();
        let mut is_known = false;
        while !rest.blocks.is_empty() {
            let Some((pass, shift)) = self.first_pass(&rest, is_known) else {
                break;
            };
            is_known = true;
            rest.blocks.start = pass.last + 1;
            if let Some(judged) = self.pass(&pass, shift) {
                self.shift = judged.shift;
                self.has_place = true;
                rest.blocks.start = rest.blocks.start.max(judged.end);
                self.judged.push(judged);
            }
            rest.blocks.start = rest.blocks.start.min(rest.blocks.end);
        }
        let is_beside = || {
            let blocks = cut.contour.clone();
            share(
                self.traced,
                self.drawn.walls(),
                blocks,
                self.shift,
                &self.budget,
            ) > 0.0
        };
        if !is_known && cut.contour.len() > LEADS && !is_beside() {
            self.unknown.push(cut.contour.start);
        }
    }

    /// The first pass of what is left of a cut, and where the program lies there.
    fn first_pass(&self, rest: &Cut, is_known: bool) -> Option<(Pass, Vector)> {
        let walls = self.drawn.walls();
        // An absolute program lies where it did, whatever was wrong before.
        let here = match self.traced.is_relative {
            true => self.shift,
            false => self.base,
        };
        let found = passes(self.traced, walls, rest, here, &self.budget);
        if !is_known
            && !found.iter().any(|pass| pass.is_whole)
            && let Some((others, place)) = self.elsewhere(rest)
        {
            // Near where it should be, it may have parted from there amid the contour.
            let is_far = (place - here).norm() > FARTHEST;
            let shift = if is_far { place } else { here };
            return Some((others.into_iter().next()?, shift));
        }
        Some((found.into_iter().next()?, here))
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
            let count = |judged: &Judged| (judged.wrong, usize::MAX - judged.follows.len());
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
        // An absolute program comes back to where it lies.
        let mut places = [self.base, shift]
            .into_iter()
            .filter(|place| !self.traced.is_relative || *place == shift);
        let (first, entry) = places
            .find_map(|place| begin(&walk, place, self.traced.is_relative))
            .or_else(|| enter(&walk, shift))?;
        let mut judged = Judged {
            pass: pass.clone(),
            first,
            differences: Vec::new(),
            follows: Vec::new(),
            wrong: 0,
            end: first,
            shift: entry.shift,
        };
        let named = |index: usize, along: f64, off: f64, kind: DifferenceKind| {
            let block = self.traced.blocks.get(index)?;
            Some(Difference::of(block, ring.source(along), off, kind))
        };
        let mut away = (entry.shift - shift).norm();
        if !self.traced.is_relative {
            away = away.min((entry.shift - self.base).norm());
        }
        if self.has_place && away > SLIGHT && !self.is_taken(pass, away) {
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
        let mut is_resumed = false;
        while let Some(next) = walk.next(index) {
            if at.along >= complete && walk.follow(next, at).is_none() {
                break;
            }
            if let Some(along) = walk.follow(next, at) {
                judged.follows.push(next);
                (at.along, index, last) = (along, next + 1, Some(next));
                if self.traced.counts {
                    at.shift += walk.drift(next, at);
                }
                continue;
            }
            let deepest = pass.offset.abs().max(ROUNDED);
            if let Some(along) = walk.round_corner(next, at, deepest) {
                (at.along, index, last) = (along, next + 1, Some(next));
                continue;
            }
            if let Some((back, place)) = self.comes_back(&walk, next, at, complete) {
                (at, index, last) = (place, back, None);
                continue;
            }
            // From pass to pass, at the end of a tab.
            let own = walk.segment(next).map_or(0.0, Segment::length);
            if own <= ROUNDED && next > pass.last && !walk.runs_along(next, at) {
                break;
            }
            let Some(resumed) = walk.resume(next, at, last, complete) else {
                if pass.is_whole {
                    self.leave(&walk, &mut judged, next, at, complete);
                }
                break;
            };
            is_resumed = true;
            // By less, it is as its writer rounds it.
            if resumed.off > SLIGHT {
                let kind = DifferenceKind::Block;
                let wrong = named(resumed.wrong, at.along, resumed.off, kind);
                judged.differences.extend(wrong);
            }
            judged.follows.retain(|index| *index != resumed.wrong);
            (at, index, last) = (resumed.at, resumed.next, None);
        }
        let is_all = index > pass.last;
        if at.along < complete
            && judged.differences.is_empty()
            && pass.is_whole
            && is_all
            && !self.has_tab(first)
        {
            self.unfinished(&walk, &mut judged, [entry, at], is_resumed);
        }
        (judged.shift, judged.end) = (at.shift, index);
        judged.wrong = judged.differences.len();
        // It is another contour, or another drawing: that is said once.
        if judged.wrong > 1 && ONE_OF * judged.wrong > judged.follows.len() {
            judged.differences.truncate(1);
        }
        Some(judged)
    }

    /// Where an absolute program follows again at its stated places, with this block or the next one.
    fn comes_back(&self, walk: &Walk, block: usize, at: At, complete: f64) -> Option<(usize, At)> {
        if self.traced.is_relative || at.shift == self.base {
            return None;
        }
        let own = walk.segment(block)?;
        [Some(block), walk.next(block + 1)]
            .into_iter()
            .flatten()
            .find_map(|next| {
                let start = walk.segment(next)?.start() + self.base;
                let to = at.along + 2.0 * own.length() + 10.0;
                let (along, away) = walk.ring.nearest(start, at.along - walk.within, to)?;
                let place = At {
                    along,
                    shift: self.base,
                };
                let follows = walk.count(next, place, 1, complete).count > 0;
                (away <= walk.within && follows).then_some((next, place))
            })
    }

    /// Whether the machine stops within the cut of a block, as it does before a tab.
    fn has_tab(&self, block: usize) -> bool {
        self.traced.cuts.iter().any(|cut| {
            let blocks = self.traced.blocks.get(cut.blocks.clone());
            let mut blocks = blocks.into_iter().flatten();
            cut.blocks.contains(&block) && blocks.any(|block| block.motion == Motion::Stop)
        })
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
        // A program that does not say where it lies may have begun with any of several contours that are alike.
        let may_be_another = !self.traced.is_placed && away > FARTHEST;
        self.traced.four_b
            || may_be_another
            || cut.is_some() && before.is_some() && !leads && away > BY_HAND
    }

    /// A block that follows nothing: a way out, or one from which nothing comes back.
    fn leave(&self, walk: &Walk, judged: &mut Judged, index: usize, at: At, complete: f64) {
        let rest = (index..walk.range.end)
            .filter(|index| walk.segment(*index).is_some())
            .count();
        if rest <= LEADS && at.along >= complete - walk.ring.length * 0.5 {
            return;
        }
        let off = walk.off(index, at);
        let block = self.traced.blocks.get(index).filter(|_| off > SLIGHT);
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
    fn unfinished(&self, walk: &Walk, judged: &mut Judged, [entry, at]: [At; 2], is_resumed: bool) {
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
        // What was not followed at the begin comes near to where the contour ends: the last of it is wrong.
        let close = walk.place(at.along);
        let begins = (walk.range.start..judged.first).filter_map(|index| {
            let off = (walk.segment(index)?.start() + at.shift - close).norm();
            (off <= NEAR).then_some((index, off))
        });
        if let Some((begin, off)) = begins.min_by(|one, other| one.1.total_cmp(&other.1)) {
            // One that begins beside the contour is led there.
            let is_alone = begin + 1 == judged.first && !walk.counts;
            let way = begin
                .checked_sub(1)
                .filter(|way| walk.segment(*way).is_some());
            let (wrong, kind) = match way.filter(|_| is_alone) {
                Some(way) => (way, DifferenceKind::Astray),
                None => (judged.first - 1, DifferenceKind::Block),
            };
            let block = self.traced.blocks.get(wrong).filter(|_| off > SLIGHT);
            let wrong = block.map(|block| Difference::of(block, None, off, kind));
            judged.differences.extend(wrong);
            return;
        }
        if judged.first > judged.pass.first || is_resumed {
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
}
