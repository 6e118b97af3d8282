//! Whether all of a program follows its drawing: at any correction, with either kind of corner, wherever it lies.
//!
//! A block is named where no way of writing the drawing explains it: what leaves nothing to name comes before what
//! leaves little.

use super::LEADS;
use super::anchor::places;
use super::comparison::{CHANGED, Tried, courses, longest_cut, sound, with_other_corner};
use super::difference::Comparison;
use super::drawn::Drawn;
use super::infer;
use super::members::Members;
use super::passes::corrections;
use super::placement::Placement;
use super::rounds::{Course, Rounds};
use super::single::{Only, single};
use super::traced::{Block, Traced};
use std::cmp::Reverse;
use std::rc::Rc;

/// The most lists of corrections that are tried.
const LISTS: usize = 12;
/// The most layings in which one changed block is looked for.
const LIKELY: usize = 16;
/// Layings that are less than this apart, µm, explain the same.
const ALIKE: f64 = 0.3;

/// For each block whose numbers are off, this many must be as any writer has them.
const SLIPS: usize = 3;

/// A way in which a program may lie on its drawing.
#[derive(Clone)]
struct Laying {
    drawn: Drawn,
    courses: Vec<Course>,
    rounds: Rc<Rounds>,
    placement: Placement,
}

impl Laying {
    /// All but rounding is the same: of two that are a micrometre apart, one may lie exactly as it was written.
    fn is_like(&self, other: &Laying) -> bool {
        let is_near = |(one, other): (&Course, &Course)| match (one, other) {
            (Course::Beside(one), Course::Beside(other)) => (one - other).abs() < ALIKE * 1e-3,
            _ => one == other,
        };
        let away = (self.placement.shift - other.placement.shift).norm();
        away < ALIKE
            && self.drawn.settings.corner == other.drawn.settings.corner
            && self.courses.len() == other.courses.len()
            && self.courses.iter().zip(&other.courses).all(is_near)
    }
}

/// All ways in which a program may lie on its drawing, the likeliest first; each is laid once.
pub(super) struct Layings<'a> {
    traced: &'a Traced,
    known: Vec<Laying>,
    rest: Box<dyn Iterator<Item = Laying> + 'a>,
    /// All of the program follows at one correction.
    pub(super) is_even: bool,
}

impl<'a> Layings<'a> {
    pub(super) fn of(drawn: &'a Drawn, traced: &'a Traced) -> Layings<'a> {
        Layings {
            traced,
            known: Vec::new(),
            is_even: false,
            rest: Box::new(std::iter::once(()).flat_map(|()| layings(drawn, traced))),
        }
    }

    fn get(&mut self, nth: usize) -> Option<&Laying> {
        if self.known.len() <= nth {
            self.known.extend(self.rest.next());
        }
        self.known.get(nth)
    }
}

/// The comparison of a program of which every block follows the drawing; `None` where one does not. A number that is off
/// by less than moves its block aside is told, and the one block without which the wire does not come back.
pub(super) fn followed(layings: &mut Layings) -> Option<Comparison> {
    let traced = layings.traced;
    let mut all = 0..;
    let (laying, mut walked) = loop {
        let laying = layings.get(all.next()?)?;
        let whole = sound(traced, &laying.rounds, laying.placement);
        if let Some((walked, _)) = whole.filter(|(walked, _)| !is_left(traced, &walked.runs)) {
            break (laying.clone(), walked);
        }
    };
    if walked.misses_start
        && let Some(seen) = but_one(layings)
    {
        return Some(seen);
    }
    layings.is_even = laying.courses.len() == 1;
    // Many are the way of its writer; a few somebody has changed.
    if SLIPS * walked.slips.len() <= walked.follows.len() {
        walked.unlike = std::mem::take(&mut walked.slips);
        walked
            .unlike
            .retain(|one| !traced.counts || one.off >= CHANGED);
    }
    let Laying {
        drawn,
        rounds,
        placement,
        ..
    } = laying;
    Tried::of(traced, walked, &[], (rounds, placement)).told(&drawn, traced)
}

/// The comparison of a program that follows the drawing, and comes back to where each cut begins, but for one block:
/// of all such blocks the one that is the least off.
pub(super) fn but_one(layings: &mut Layings) -> Option<Comparison> {
    let traced = layings.traced;
    layings.known.extend(&mut layings.rest);
    let count = |laying: &&Laying| Members::count(traced, &laying.rounds, laying.placement);
    let mut all: Vec<&Laying> = layings.known.iter().collect();
    all.sort_by_cached_key(|laying| Reverse(count(laying)));
    let mut likely: Vec<&Laying> = Vec::new();
    for laying in all {
        if likely.len() < LIKELY && !likely.iter().any(|other| other.is_like(laying)) {
            likely.push(laying);
        }
    }
    let found = likely.into_iter().filter_map(|laying| {
        let (rounds, placement) = (&laying.rounds, laying.placement);
        let whole = |traced: &Traced, placement: Placement| {
            let (walked, miss) = sound(traced, rounds, placement)?;
            let is_whole = !walked.misses_start && !is_left(traced, &walked.runs);
            is_whole.then_some((walked, miss))
        };
        let only = single(traced, rounds, placement, &[], f64::INFINITY, &whole)?;
        Some((laying.clone(), only))
    });
    let (laying, only) = found.reduce(|best, one| match one.1.is_likelier(&best.1) {
        true => one,
        false => best,
    })?;
    let Laying {
        drawn,
        rounds,
        placement,
        ..
    } = laying;
    let Only {
        repaired,
        mut walked,
        unlike,
        ..
    } = only;
    // A step that is rounded by itself is no change; an arc of which no arc can be made is one.
    let is_lost = traced.blocks.get(unlike.block).is_some_and(|it| it.is_lost);
    let is_change = unlike.off >= CHANGED || is_lost;
    walked.unlike = Vec::from_iter(is_change.then_some(unlike));
    Tried::of(&repaired, walked, &[], (rounds, placement)).told(&drawn, &repaired)
}

/// All of them, the likeliest first.
fn layings(drawn: &Drawn, traced: &Traced) -> impl Iterator<Item = Laying> {
    let mut tried: Vec<Vec<Course>> = Vec::new();
    if !traced.is_empty() && !drawn.contours().is_empty() {
        for courses in ways(drawn, traced) {
            if !tried.contains(&courses) {
                tried.push(courses);
            }
        }
    }
    let corners = [drawn.clone(), with_other_corner(drawn)];
    corners.into_iter().flat_map(move |drawn| {
        tried.clone().into_iter().flat_map(move |courses| {
            let mut rounds = Rounds::default();
            rounds.add(&drawn, &courses, None);
            let placements = places(traced, &rounds);
            let (drawn, rounds) = (drawn.clone(), Rc::new(rounds));
            placements.into_iter().map(move |placement| Laying {
                drawn: drawn.clone(),
                courses: courses.clone(),
                rounds: rounds.clone(),
                placement,
            })
        })
    })
}

/// The ways that the wire may go beside the contours, the likeliest first.
fn ways(drawn: &Drawn, traced: &Traced) -> Vec<Vec<Course>> {
    let of_settings = courses(&drawn.settings, traced);
    let mut all = vec![of_settings, vec![Course::Drawn]];
    if traced.four_b {
        return all;
    }
    let lists = corrections(drawn, traced).into_iter();
    let scale = drawn.unit_mm * 1e3;
    let single = infer::corrections(drawn.contours().iter(), scale, &longest_cut(traced));
    let single = single.into_iter().map(|mm| vec![mm]);
    let beside = |list: Vec<f64>| list.into_iter().map(Course::Beside).collect();
    all.extend(single.chain(lists).take(LISTS).map(beside));
    all
}

/// Whether a block of a pass that the control offsets follows nothing and is no way in or out: it lies between
/// blocks that follow the drawing, or is one of too many before or after them.
fn is_left(traced: &Traced, runs: &[bool]) -> bool {
    let blocks: Vec<(&Block, bool)> = traced.blocks.iter().zip(runs.iter().copied()).collect();
    let passes = blocks.chunk_by(|(one, _), (other, _)| one.stretch == other.stretch);
    let mut offset = passes.filter(|pass| pass.iter().all(|(block, _)| block.is_offset()));
    let left = |blocks: &[(&Block, bool)]| {
        let cuts = blocks
            .iter()
            .filter(|(block, follows)| !follows && block.segment().is_some());
        cuts.count()
    };
    offset.any(|pass| {
        let first = pass.iter().position(|(_, follows)| *follows);
        let last = pass.iter().rposition(|(_, follows)| *follows);
        first.zip(last).is_some_and(|(first, last)| {
            left(&pass[first..last]) > 0
                || left(&pass[..first]) > LEADS
                || left(&pass[last..]) > LEADS
        })
    })
}
