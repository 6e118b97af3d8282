//! A program of another writer: each pass follows the way of the wire round one contour at one offset.
//!
//! The rule: every piece of the program lies at its pass's offset from the contour, and every segment of the contour is
//! covered. Ways in and out are not judged, nor is where the wire is threaded or where a contour is begun. The offset is
//! the one, of those at which blocks lie and of those of other contours, that leaves the least to name.

use super::budget::Budget;
use super::difference::Comparison;
use super::drawn::Drawn;
use super::judged::{Judged, Pass, ROUNDED, SLIGHT, count, unfinished};
use super::level::{LEVEL, Run, runs};
use super::place::{place, places, told_by_arcs};
use super::ring::{Course, NONE, Ring};
use super::traced::{Cut, Motion, Traced};
use super::walk::{At, COVERED, WITHIN, WITHIN_FOUR_B, Walk};
use crate::finding::DifferenceKind;
use crate::geometry::{Point, Side, Vector};
use crate::settings::Corner;
use std::ops::Range;

/// Fewer blocks may be a way; so many about the first that lies beside a contour may be its first one.
const LEADS: usize = 4;
const ABOUT: usize = 6;
/// A pass goes round at least this much of its contour, and so much of one with a wrong block lies at one distance.
const PASS: f64 = 0.4;
const PART: f64 = 0.1;
/// In a cut of so few blocks one wrong block is not taken for granted: it is laid at all corners of the way.
const SHORT: usize = 60;
/// No tab is shorter, µm.
const TAB: f64 = 200.0;
/// So many offsets are tried.
const OFFSETS: usize = 6;
/// A table is moved by hand at least this far, µm.
const BY_HAND: f64 = 1_000.0;
/// Of more than so many wrong blocks, half of a pass may be wrong: more are another contour, and that is said once.
const FEW: usize = 3;

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
        base: shift,
        has_place,
        budget,
        judged: Vec::new(),
        unknown: Vec::new(),
        beyond: None,
    };
    for cut in &traced.cuts {
        let known = (foreign.judged.len(), foreign.unknown.len());
        foreign.cut(cut);
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
    /// The offsets that its arcs tell, µm.
    told: Vec<f64>,
}

/// The ways that a pass may go at an offset: round sharp corners in arcs, or to their tips.
fn courses(run: &Run, offset: f64) -> Vec<Course> {
    let corners: &[Corner] = match offset.abs() > NONE {
        true => &[Corner::Arc, Corner::Intersection],
        // On the contour itself there is nothing to go round.
        false => &[Corner::Arc],
    };
    let course = |corner: &Corner| Course {
        contour: run.contour,
        offset,
        back: run.back,
        corner: *corner,
        four_b: false,
    };
    corners.iter().map(course).collect()
}

/// Keeps the better one of two.
fn keep_better(best: &mut Option<Judged>, other: Option<Judged>) {
    if let Some(other) = other
        && best.as_ref().is_none_or(|best| count(&other) < count(best))
    {
        *best = Some(other);
    }
}

fn is_sound(best: &Option<Judged>) -> bool {
    best.as_ref().is_some_and(|best| best.wrong == 0)
}

pub(super) struct Foreign<'a> {
    pub(super) drawn: &'a Drawn,
    pub(super) traced: &'a Traced,
    pub(super) budget: Budget,
    /// From the program's places to those of the drawing, as it is at the cut.
    shift: Vector,
    /// The same as it was first found.
    base: Vector,
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
    fn cut(&mut self, cut: &Cut) {
        let begun = self.judged.len();
        let mut rest = cut.blocks.clone();
        while !rest.is_empty() {
            let Some(judged) = self.next_pass(&rest) else {
                break;
            };
            self.shift = judged.shift;
            self.has_place = true;
            rest.start = judged.end.max(rest.start + 1);
            self.judged.push(judged);
        }
        if self.judged.len() == begun {
            if cut.contour.len() > LEADS {
                self.unknown.push(cut.contour.start);
            }
            return;
        }
        self.comes_back(cut, begun);
    }

    /// Where the program lies: an absolute one where it did, whatever was wrong before.
    fn here(&self) -> Vector {
        match self.traced.is_relative {
            true => self.shift,
            false => self.base,
        }
    }

    /// The next pass of what is left of a cut: where the program lies, and where that leaves something to name, where it
    /// would lie if a block moved what comes after it.
    fn next_pass(&self, blocks: &Range<usize>) -> Option<Judged> {
        let told = match self.traced.is_relative {
            true => told_by_arcs(self.drawn, self.traced, blocks.clone()),
            false => Vec::new(),
        };
        let blocks = blocks.clone();
        let rest = &Rest { blocks, told };
        let here = self.here();
        let mut best = self.best_at(here, rest, false);
        if is_sound(&best) || !self.traced.is_relative && best.is_some() {
            return best;
        }
        let places = places(self.drawn, self.traced, rest.blocks.clone(), &self.budget);
        for there in places {
            if is_sound(&best) {
                return best;
            }
            keep_better(&mut best, self.best_at(there, rest, false));
        }
        let is_one = best.as_ref().is_some_and(|best| best.wrong <= 1);
        if is_sound(&best) || is_one && rest.blocks.len() > SHORT {
            return best;
        }
        keep_better(&mut best, self.best_at(here, rest, true));
        best
    }

    /// The pass that is next where the program lies at a place; `anywhere`: or at any corner of its way.
    fn best_at(&self, there: Vector, rest: &Rest, anywhere: bool) -> Option<Judged> {
        let (traced, walls, blocks) = (self.traced, self.drawn.walls(), &rest.blocks);
        let runs = runs(traced, walls, blocks.clone(), there, &self.budget);
        let is_known = |run: &Run| {
            let is_it = |other: &Judged| {
                let apart = (other.pass.offset - run.offset()).abs();
                other.pass.contour == run.contour && apart <= LEVEL
            };
            self.judged.iter().any(is_it)
        };
        let longest = runs
            .iter()
            .max_by(|one, other| one.share.total_cmp(&other.share));
        let run = runs.iter().find(|run| run.share >= PASS);
        let run = run.or(longest.filter(|run| run.share >= PART));
        let run = run.or_else(|| runs.iter().find(|run| is_known(run)))?;
        // What is left of a tab, on one side.
        let is_part = run.share < PASS && run.count() <= 2 && is_known(run);
        let offsets = match is_part {
            true => vec![self.snapped(run.offset())],
            false => self.offsets(run, &runs, rest),
        };
        let courses = match traced.four_b {
            true => self.courses_of_four_b(run, rest),
            false => offsets
                .iter()
                .flat_map(|offset| courses(run, *offset))
                .collect(),
        };
        // A wrong block may lie between the way in and all that runs at one distance.
        let from = run.first.saturating_sub(ABOUT).max(blocks.start);
        let behind_way = blocks.start..(blocks.start + ABOUT).min(from);
        let begins = behind_way.chain(from..(run.first + ABOUT).min(blocks.end));
        let begins: Vec<usize> = begins.collect();
        // A wrong block may move all of it away from where it says that it begins.
        let is_stated = traced.is_placed && self.judged.is_empty();
        let stated = is_stated.then_some(Vector::zeros());
        let here = self.here();
        let places: Vec<Vector> = [here, there].into_iter().chain(stated).collect();
        let mut best: Option<Judged> = None;
        for course in courses {
            let Some(ring) = self.drawn.ring(&course) else {
                continue;
            };
            let pass = Pass {
                contour: run.contour,
                offset: course.offset,
                back: run.back,
            };
            let walk = self.walk(&ring, blocks.clone());
            for entry in walk.entries(&begins, &places, is_part, anywhere) {
                let is_there = stated.filter(|at| (entry.1.shift - at).norm() <= SLIGHT);
                let from = is_there.unwrap_or(here);
                let other = self.follow(&walk, pass, (entry, is_part), from);
                keep_better(&mut best, Some(other));
                if is_sound(&best) {
                    return best;
                }
            }
        }
        best
    }

    /// The offsets that a pass may have: those at which most of its blocks lie, and those of the contours before it.
    fn offsets(&self, run: &Run, runs: &[Run], rest: &Rest) -> Vec<f64> {
        let mut own: Vec<&Run> = runs.iter().collect();
        own.retain(|other| (other.contour, other.back) == (run.contour, run.back));
        own.sort_by(|one, other| other.length.total_cmp(&one.length));
        let before = self.judged.iter().rev().map(|judged| judged.pass.offset);
        let told = rest.told.iter().map(|told| told.copysign(run.offset()));
        let told = told.filter(|offset| (offset - run.offset()).abs() <= ROUNDED);
        let all = std::iter::once(run.offset()).chain(told);
        let all = all
            .chain(own.into_iter().take(OFFSETS).map(Run::offset))
            .chain(before.take(1));
        let mut offsets: Vec<f64> = Vec::new();
        for offset in all.map(|offset| self.snapped(offset)) {
            if offsets.iter().all(|other| (other - offset).abs() > 1.0) {
                offsets.push(offset);
            }
        }
        offsets.truncate(OFFSETS);
        offsets
    }

    /// The ways that a pass of 4B may go: along the contour itself, with transitions for the wire's side.
    fn courses_of_four_b(&self, run: &Run, rest: &Rest) -> Vec<Course> {
        let contour = self.drawn.contours().get(run.contour);
        let side = contour.and_then(|it| it.side);
        let sides = side.map_or(vec![Side::Left, Side::Right], |side| vec![side]);
        // The arcs that go round its corners are larger than the correction by the margin.
        let margin = (self.drawn.settings.margin * 1e3).max(1.0) + 0.25;
        let told = rest.told.iter().map(|radius| radius.round() - margin);
        let set = self.drawn.settings.correction * 1e3;
        let all = std::iter::once(set).chain(told.filter(|um| *um > NONE));
        let offsets = all.flat_map(|um| sides.iter().map(move |side| side.sign() * um));
        let course = |offset: f64| Course {
            contour: run.contour,
            offset,
            back: run.back,
            corner: Corner::Arc,
            four_b: true,
        };
        offsets.map(course).collect()
    }

    /// An offset as the settings have it, where it is that of a pass; else to a tenth of a micrometre.
    fn snapped(&self, offset: f64) -> f64 {
        const NEAR: f64 = 0.7;
        let set = self.drawn.settings.each_correction();
        let mut set = set.iter().map(|mm| (mm * 1e3).copysign(offset));
        let set = set.find(|set| (set - offset).abs() <= NEAR);
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
            is_relative: self.traced.is_relative,
            budget: &self.budget,
        }
    }

    fn follow(
        &self,
        walk: &Walk,
        pass: Pass,
        ((first, entry), is_part): ((usize, At), bool),
        here: Vector,
    ) -> Judged {
        let mut judged = Judged {
            pass,
            first,
            end: first,
            differences: Vec::new(),
            follows: Vec::new(),
            wrong: 0,
            shift: entry.shift,
            covered: [0.0; 2],
            length: walk.ring.length,
            ends: [Point::origin(); 2],
            is_tab: false,
            edges: [Point::origin(); 2],
            gap: None,
        };
        // What it leaves out before it is more than a way in.
        let before = (walk.range.start..first).filter(|index| walk.segment(*index).is_some());
        judged.wrong += before.count().saturating_sub(LEADS);
        self.moved(walk, &mut judged, entry, here);
        let complete = walk.complete(entry);
        let (mut at, mut index, mut last) = (entry, first, None);
        while let Some(next) = walk.next(index) {
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
            // After a stop the wire goes over to another pass: what is left is a tab.
            if at.along >= complete || is_part || index < next {
                break;
            }
            let Some(resumed) = walk.resume(next, at, last, complete) else {
                break;
            };
            judged.wrong += 1;
            judged.follows.retain(|index| *index != resumed.wrong);
            if resumed.off > SLIGHT {
                judged.name(walk, resumed.wrong, at, resumed.off, DifferenceKind::Block);
            }
            (at, index, last) = (resumed.at, resumed.next, None);
        }
        (judged.shift, judged.end) = (at.shift, index);
        let covered = [entry.along, at.along];
        judged.covered = match pass.back {
            true => covered.map(|along| walk.ring.length - along),
            false => covered,
        };
        judged.covered.sort_by(f64::total_cmp);
        judged.ends = [entry.along, at.along].map(|along| walk.place(along));
        if at.along < complete && !is_part {
            judged.gap = unfinished(walk, &judged, [entry, at], last);
            let end = complete + COVERED;
            // A tab stands on one side; on a circle, on less than a quarter.
            let sides = walk.corners(at.along + COVERED, end - COVERED).len();
            judged.edges = [at.along, end].map(|along| walk.place(along));
            judged.is_tab = sides == 0 && end - at.along >= TAB;
            let rest = self.traced.blocks.get(index..).unwrap_or_default();
            // A tab is cut after a stop.
            let behind = rest.iter().skip_while(|block| block.motion != Motion::Stop);
            let goes_on = behind.skip(1).any(|block| block.motion != Motion::Stop);
            judged.wrong += if goes_on { sides } else { sides.max(1) };
        }
        if judged.differences.len() > FEW && 2 * judged.differences.len() > judged.follows.len() {
            judged.differences.truncate(1);
            judged.gap = None;
        }
        judged
    }

    /// A contour that begins elsewhere than the drawing has it is named at the way to it.
    fn moved(&self, walk: &Walk, judged: &mut Judged, entry: At, here: Vector) {
        let away = (entry.shift - here).norm();
        if !self.has_place || away <= SLIGHT || self.is_taken(judged.first, away) {
            return;
        }
        let way = judged.first.checked_sub(1);
        let way = way.filter(|way| walk.segment(*way).is_some());
        judged.wrong += 1;
        judged.name(
            walk,
            way.unwrap_or(judged.first),
            entry,
            away,
            DifferenceKind::Moved,
        );
    }

    /// A contour to which no block leads: the table is moved by hand, or the program sets where it is; each contour of 4B
    /// lies beside its place, by the correction where it begins.
    fn is_taken(&self, first: usize, away: f64) -> bool {
        let cut = self
            .traced
            .cuts
            .iter()
            .position(|cut| cut.blocks.contains(&first));
        let is_first = cut.is_some_and(|cut| {
            let blocks = &self.traced.cuts[cut].blocks;
            self.judged
                .last()
                .is_none_or(|last| last.first < blocks.start)
        });
        let before = cut.and_then(|cut| self.traced.cuts.get(cut.checked_sub(1)?));
        let leads = before.zip(cut).is_some_and(|(before, cut)| {
            let between = before.blocks.end..self.traced.cuts[cut].blocks.start;
            let between = self.traced.blocks.get(between).unwrap_or_default();
            between.iter().any(|block| block.motion != Motion::Stop)
        });
        self.traced.four_b || is_first && before.is_some() && !leads && away > BY_HAND
    }
}
