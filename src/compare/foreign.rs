//! A program of another writer: each pass follows the way of the wire round one contour at one offset.
//!
//! The rule: every piece of the program lies at its pass's offset from the contour, and every segment of the contour is
//! covered. Ways in and out are not judged, nor is where the wire is threaded or where a contour is begun. The offset is
//! the one, of those at which blocks lie and of those of other contours, that leaves the least to name.

use super::budget::Budget;
use super::difference::{Comparison, Difference};
use super::drawn::Drawn;
use super::judged::{Judged, SLIGHT};
use super::level::{LEVEL, Run, runs};
use super::place::{place, places};
use super::ring::{Course, NONE, Ring};
use super::traced::{Cut, Motion, Traced};
use super::walk::{At, WITHIN, Walk};
use crate::finding::DifferenceKind;
use crate::geometry::Vector;
use crate::settings::Corner;
use std::ops::Range;

/// Fewer blocks may be a way; so many about the first that lies beside a contour may be its first one.
const LEADS: usize = 4;
const ABOUT: usize = 6;
/// A pass goes round at least this much of its contour, and so much of one with a wrong block lies at one distance.
const PASS: f64 = 0.4;
const PART: f64 = 0.1;
/// In a cut of more blocks than these one wrong block is taken for granted: no other place is looked for.
const SHORT: usize = 60;
/// Places are one within this, µm.
const SAME_PLACE: f64 = 1.0;
/// So many offsets are tried.
const OFFSETS: usize = 6;
/// An arc in a sharp corner leaves no more of it than this, or than the offset, µm; those of 4B go round by the wire.
const ROUNDED: f64 = 300.0;
const ROUNDED_BY_FOUR_B: f64 = 2_000.0;
/// A table is moved by hand at least this far, µm.
const BY_HAND: f64 = 1_000.0;

/// What is seen of a program.
pub(super) struct Seen {
    pub(super) comparison: Comparison,
    /// Handles of the contours that it cuts, in its order, where it does not cut all.
    pub(super) handles: Option<Vec<String>>,
}

pub(super) fn compare(drawn: &Drawn, traced: &Traced, budget: Budget) -> Option<Seen> {
    if traced.is_empty() || drawn.contours().is_empty() {
        return None;
    }
    let found = place(drawn, traced, &budget);
    let (shift, has_place) = match budget.is_spent() {
        true => (Vector::zeros(), false),
        false => found?,
    };
    let mut foreign = Foreign {
        drawn,
        traced,
        shift,
        has_place,
        budget,
        judged: Vec::new(),
        unknown: Vec::new(),
        beyond: None,
    };
    let mut behind = 0;
    for cut in &traced.cuts {
        let known = (foreign.judged.len(), foreign.unknown.len());
        let way = traced
            .blocks
            .get(behind..cut.blocks.start)
            .unwrap_or_default();
        foreign.cut(cut, way.iter().any(|block| block.motion != Motion::Stop));
        behind = cut.blocks.end;
        if foreign.budget.is_spent() {
            foreign.judged.truncate(known.0);
            foreign.unknown.truncate(known.1);
            foreign.beyond = Some(cut.blocks.start);
            break;
        }
    }
    // Whether something is left to stand shows at the end only.
    if foreign.beyond.is_none() {
        foreign.cover();
    }
    foreign.told()
}

/// What is left of a cut.
struct Rest {
    blocks: Range<usize>,
    /// A way leads to it, or a pass before it.
    is_led: bool,
    /// Where each block counts from the one before: how far the cut ends from where it begins, µm.
    opening: Option<Vector>,
}

pub(super) struct Foreign<'a> {
    pub(super) drawn: &'a Drawn,
    pub(super) traced: &'a Traced,
    budget: Budget,
    /// From the program's places to those of the drawing; where it counts, as it is behind the last pass.
    shift: Vector,
    /// What lies elsewhere has been moved: the program says where it lies, or a contour of it has been followed.
    has_place: bool,
    pub(super) judged: Vec<Judged>,
    /// First blocks of contours that are not in the drawing.
    pub(super) unknown: Vec<usize>,
    /// The block from which on nothing is compared.
    pub(super) beyond: Option<usize>,
}

impl Foreign<'_> {
    /// Follows the passes of a cut, one after the other: a wrong block in one may move all that come after it.
    fn cut(&mut self, cut: &Cut, has_way: bool) {
        let (begun, is_relative) = (self.judged.len(), self.traced.is_relative);
        let mut rest = Rest {
            blocks: cut.blocks.clone(),
            is_led: has_way || begun == 0,
            opening: self.opening(cut).filter(|_| is_relative),
        };
        while !rest.blocks.is_empty() {
            let Some(mut judged) = self.next_pass(&rest) else {
                break;
            };
            // What a pass has left that a fault cut short is not said to be unfinished once more.
            let of_cut = self.judged.get(begun..).unwrap_or_default().iter();
            let mut before = of_cut.filter(|it| it.course.contour == judged.course.contour);
            if judged.is_part() && before.any(|it| it.gap.is_some()) {
                judged.gap = None;
            }
            if is_relative {
                self.shift = judged.shift;
            }
            self.has_place = true;
            rest.is_led = true;
            rest.blocks.start = judged.end.max(rest.blocks.start + 1);
            self.judged.push(judged);
        }
        if self.judged.len() > begun {
            self.comes_back(&rest, begun);
        } else if cut.contour.len() > LEADS {
            self.unknown.push(cut.contour.start);
        }
    }

    fn opening(&self, cut: &Cut) -> Option<Vector> {
        let blocks = self.traced.blocks.get(cut.blocks.clone())?;
        let mut ends = blocks.iter().filter_map(|block| block.motion.ends());
        let first = ends.next()?;
        Some(ends.next_back().unwrap_or(first)[1] - first[0])
    }

    /// A program that counts and follows to its end, but comes back beside where the wire is threaded by as much as it
    /// went on over the begin of its contour: its last block is too long.
    fn comes_back(&mut self, rest: &Rest, begun: usize) {
        let own = self.judged.get(begun..).unwrap_or_default();
        let is_sound = own.iter().all(|judged| judged.differences.is_empty());
        let (Some(opening), [first, ..], [.., last], true) = (rest.opening, own, own, is_sound)
        else {
            return;
        };
        let contour = self.drawn.contours().get(first.course.contour);
        let is_closed = contour.is_some_and(|contour| contour.closed);
        let over = last.ends[1] - first.ends[0];
        if is_closed && opening.norm() > SLIGHT && (opening - over).norm() <= WITHIN {
            let block = last.end.checked_sub(1);
            let block = block.and_then(|block| self.traced.blocks.get(block));
            let kind = DifferenceKind::Block;
            let found = block.map(|block| Difference::of(block, None, opening.norm(), kind));
            if let Some(last) = self.judged.last_mut() {
                last.differences.extend(found);
            }
        }
    }

    /// The next pass of what is left of a cut: where the program lies, and where that leaves something to name, where it
    /// would lie if a block moved what comes after it.
    fn next_pass(&self, rest: &Rest) -> Option<Judged> {
        let mut best = self.best_at(self.shift, rest);
        let is_told = |best: &Option<Judged>| {
            let most = if rest.blocks.len() > SHORT { 1 } else { 0 };
            best.as_ref().is_some_and(|best| best.wrong <= most)
        };
        if is_told(&best) || !self.traced.is_relative && best.is_some() {
            return best;
        }
        let mut tried = vec![self.shift];
        for there in places(self.drawn, self.traced, rest.blocks.clone(), &self.budget) {
            if tried
                .iter()
                .any(|known| (known - there).norm() <= SAME_PLACE)
            {
                continue;
            }
            tried.push(there);
            keep_better(&mut best, self.best_at(there, rest));
            if is_told(&best) {
                break;
            }
        }
        best
    }

    /// The pass that is next where the program lies at a place.
    fn best_at(&self, there: Vector, rest: &Rest) -> Option<Judged> {
        let (traced, blocks) = (self.traced, &rest.blocks);
        let runs = runs(
            traced,
            self.drawn.walls(),
            blocks.clone(),
            there,
            &self.budget,
        );
        let is_known = |run: &&Run| {
            let is_it = |other: &Judged| {
                let apart = (other.course.offset - run.offset()).abs();
                other.course.contour == run.contour && apart <= LEVEL
            };
            self.judged.iter().any(is_it)
        };
        let by_share = |one: &&Run, other: &&Run| one.share.total_cmp(&other.share);
        let longest = runs.iter().max_by(by_share).filter(|run| run.share >= PART);
        let run = runs.iter().find(|run| run.share >= PASS).or(longest);
        let run = run.or_else(|| runs.iter().find(is_known))?;
        // What is left of a tab, on one side.
        let is_part = run.share < PASS && run.count() <= 2 && is_known(&run);
        let offsets = match is_part {
            true => vec![tenth(run.offset())],
            false => self.offsets(run, &runs),
        };
        let courses = courses(run, offsets);
        // A wrong block may lie between the way in and all that runs at one distance.
        let from = run.first.saturating_sub(ABOUT).max(blocks.start);
        let behind_way = blocks.start..(blocks.start + ABOUT).min(from);
        let begins: Vec<usize> = behind_way
            .chain(from..(run.first + ABOUT).min(blocks.end))
            .collect();
        let moved = rest.opening.filter(|by| !is_part && by.norm() > SLIGHT);
        let moved = moved.map(|by| vec![there - by, there + by]);
        let hypotheses: Vec<Vec<Vector>> = std::iter::once(vec![there]).chain(moved).collect();
        let mut best: Option<Judged> = None;
        for course in courses {
            let Some(ring) = self.drawn.ring(&course) else {
                continue;
            };
            let walk = self.walk(&ring, course.offset, rest);
            for places in &hypotheses {
                let Some((first, entry)) = walk.entry(&begins, places, is_part) else {
                    continue;
                };
                // What begins close to a corner may begin at it: that it does not is the fault of a side.
                let at_corner = walk.at_corner(first, entry).filter(|_| !is_part);
                for entry in std::iter::once(entry).chain(at_corner) {
                    let mut judged = Judged::of(&walk, course, (first, entry), is_part);
                    // What it leaves out before it is more than a way in.
                    let before = (blocks.start..first).filter(|at| walk.segment(*at).is_some());
                    judged.wrong += before.count().saturating_sub(LEADS);
                    self.moved(&walk, &mut judged, entry, rest);
                    keep_better(&mut best, Some(judged));
                    if is_sound(&best) {
                        return best;
                    }
                }
            }
        }
        best
    }

    /// A contour that begins elsewhere than the drawing has it is named at the way to it.
    fn moved(&self, walk: &Walk, judged: &mut Judged, entry: At, rest: &Rest) {
        let away = (entry.shift - self.shift).norm();
        // Where no block leads to it, the table is moved by hand; each contour of 4B lies beside its place, by the
        // correction where it begins.
        let is_meant = self.traced.four_b || !rest.is_led && away > BY_HAND;
        // A wrong block in it moves all that comes after it away from where the program says that it begins.
        let is_first = self.traced.is_placed && self.judged.is_empty();
        let is_stated = is_first && entry.shift.norm() <= SLIGHT;
        if self.has_place && away > SLIGHT && !is_meant && !is_stated {
            let way = judged.first.checked_sub(1);
            let way = way.filter(|way| walk.segment(*way).is_some());
            let block = way.unwrap_or(judged.first);
            judged.wrong += 1;
            judged.name(walk, block, entry.along, away, DifferenceKind::Moved);
        }
    }

    /// The offsets that a pass may have, to a tenth of a micrometre: those at which most of its blocks lie, and that of
    /// the pass before it.
    fn offsets(&self, run: &Run, runs: &[Run]) -> Vec<f64> {
        let mut own: Vec<&Run> = runs.iter().collect();
        own.retain(|other| (other.contour, other.back) == (run.contour, run.back));
        own.sort_by(|one, other| other.length.total_cmp(&one.length));
        let before = self.judged.last().map(|judged| judged.course.offset);
        let own = std::iter::once(run).chain(own).map(Run::offset);
        let mut offsets: Vec<f64> = Vec::new();
        for offset in own.take(OFFSETS).chain(before).map(tenth) {
            if offsets.iter().all(|other| (other - offset).abs() > 1.0) {
                offsets.push(offset);
            }
        }
        offsets
    }

    fn walk<'a>(&'a self, ring: &'a Ring, offset: f64, rest: &Rest) -> Walk<'a> {
        Walk {
            ring,
            blocks: &self.traced.blocks,
            range: rest.blocks.clone(),
            counts: self.traced.counts,
            opening: rest.opening,
            rounded: match self.traced.four_b {
                true => ROUNDED_BY_FOUR_B,
                false => offset.abs().max(ROUNDED),
            },
            budget: &self.budget,
        }
    }

    /// Names what is not covered. What a tab leaves is covered by a part of its own.
    fn cover(&mut self) {
        let mut named: Vec<usize> = Vec::new();
        for (number, judged) in self.judged.iter().enumerate() {
            let mut all = self
                .judged
                .iter()
                .filter(|it| it.course.contour == judged.course.contour);
            let is_covered = all.clone().any(|it| it.covers_rest_of(judged));
            // One change in a program that counts moves what comes after it: it is one finding.
            let is_moved = self.traced.is_relative && all.any(|it| !it.differences.is_empty());
            if judged.gap.is_some() && !is_covered && !(judged.is_tab && is_moved) {
                named.push(number);
            }
        }
        for number in named {
            // What comes after it in a program that counts is moved by it.
            if let Some(next) = self.judged.get_mut(number + 1)
                && self.traced.is_relative
            {
                next.differences
                    .retain(|one| one.kind != DifferenceKind::Moved);
            }
            let judged = &mut self.judged[number];
            let gap = judged.gap.take();
            judged.differences.extend(gap);
        }
    }
}

/// The ways that a pass may go at some offsets: round sharp corners in arcs, or to their tips.
fn courses(run: &Run, offsets: Vec<f64>) -> Vec<Course> {
    let course = |offset: f64, corner: Corner| Course {
        contour: run.contour,
        offset,
        back: run.back,
        corner,
    };
    let of_offset = |offset: f64| {
        let tips = course(offset, Corner::Intersection);
        // On the contour itself there is nothing to go round.
        let tips = (offset.abs() > NONE).then_some(tips);
        std::iter::once(course(offset, Corner::Arc)).chain(tips)
    };
    offsets.into_iter().flat_map(of_offset).collect()
}

fn tenth(offset: f64) -> f64 {
    (offset * 10.0).round() / 10.0
}

/// Keeps the better one of two.
fn keep_better(best: &mut Option<Judged>, other: Option<Judged>) {
    if let Some(other) = other
        && best.as_ref().is_none_or(|best| other.rank() < best.rank())
    {
        *best = Some(other);
    }
}

fn is_sound(best: &Option<Judged>) -> bool {
    best.as_ref().is_some_and(|best| best.wrong == 0)
}
