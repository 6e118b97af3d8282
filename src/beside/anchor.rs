//! The place of a program on its drawing.

use super::REACH;
use super::matching::{Found, matching};
use super::placement::Placement;
use super::rounds::Rounds;
use super::traced::{Motion, Traced};
use super::walk::Walk;
use crate::geometry::Vector;
use std::ops::Range;

/// The most cuts from which a place is tried.
const TRIED: usize = 60;
/// The first cuts from which every place is tried, and the most of these.
const FIRST: usize = 12;
const PLACES: usize = 32;
/// A place farther away than this is not caused by a wrong block, µm.
const FAR: f64 = 1e4;
/// A place from which this many consecutive blocks follow the drawing is the right one.
const SURE: usize = 40;

/// The place of the program, from the blocks of its cuts; `None` where nothing of it matches the drawing.
pub(super) fn anchor(traced: &Traced, rounds: &Rounds) -> Option<Placement> {
    let still = Placement::at(Vector::zeros());
    let walk = Walk::new(traced, rounds, still);
    let tried = cuts(traced, 0..traced.blocks.len());
    let mut best = 0;
    if traced.is_placed {
        for &index in &tried {
            let Some(begin) = still.begin(&traced.blocks[index]) else {
                continue;
            };
            for spot in rounds.near(begin, REACH) {
                let (count, ends) = walk.verify(still, spot, spot, index, SURE);
                best = best.max(count + usize::from(ends));
            }
            if best >= 3 {
                break;
            }
        }
        if best >= 2 {
            return Some(still.gridded());
        }
    }
    found_by(traced, rounds, &walk, &tried)
}

/// Other possible places of the program: one wrong block moves everything after it, which may be most of the program.
pub(super) fn others(traced: &Traced, rounds: &Rounds, placement: &Placement) -> Vec<Placement> {
    let still = Placement::at(Vector::zeros());
    let walk = Walk::new(traced, rounds, still);
    let stated = traced.is_placed.then(|| still.gridded());
    let first = traced.cuts.first().and_then(|[all, _]| {
        let tried = cuts(traced, all.clone());
        found_by(traced, rounds, &walk, &tried)
    });
    let is_another = |other: &Placement| {
        let away = (other.shift - placement.shift).norm();
        away > 0.5 && away < FAR
    };
    let others = stated.into_iter().chain(first).filter(is_another);
    match placement.is_exact() {
        true => others.filter_map(|other| other.exactly()).collect(),
        false => others.collect(),
    }
}

/// All places where the program may lie: where several contours are alike, the first of them in the program may be any.
pub(super) fn places(traced: &Traced, rounds: &Rounds) -> Vec<Placement> {
    let still = Placement::at(Vector::zeros());
    let walk = Walk::new(traced, rounds, still);
    let mut all: Vec<Placement> = traced
        .is_placed
        .then(|| still.gridded())
        .into_iter()
        .collect();
    for index in cuts(traced, 0..traced.blocks.len()).into_iter().take(FIRST) {
        for found in matching(rounds, traced, index, &still) {
            let (count, _) = walk.verify(found.placement, found.spot, found.spot, index, 1);
            if count == 0 {
                continue;
            }
            let place = refined(traced, rounds, found, index);
            let is_known = |other: &Placement| (other.shift - place.shift).norm() <= 0.5;
            if !all.iter().any(is_known) {
                all.push(place);
            }
            if all.len() >= PLACES {
                return all;
            }
        }
    }
    all
}

/// Cuts among these blocks from which a place is tried.
fn cuts(traced: &Traced, among: Range<usize>) -> Vec<usize> {
    let is_cut = |index: &usize| matches!(traced.blocks[*index].motion, Motion::Cut(_));
    among.filter(is_cut).take(TRIED).collect()
}

/// The first contour decides: a wrong one moves what comes after.
fn found_by(traced: &Traced, rounds: &Rounds, walk: &Walk, tried: &[usize]) -> Option<Placement> {
    let still = Placement::at(Vector::zeros());
    let mut best: Option<(usize, Found, usize)> = None;
    for &index in tried {
        for found in matching(rounds, traced, index, &still) {
            let (count, ends) = walk.verify(found.placement, found.spot, found.spot, index, SURE);
            let count = count + usize::from(ends);
            if best.as_ref().is_none_or(|(most, ..)| count > *most) {
                best = Some((count, found, index));
            }
        }
        if best.as_ref().is_some_and(|(most, ..)| *most >= 3) {
            break;
        }
    }
    let (_, found, index) = best?;
    Some(refined(traced, rounds, found, index))
}

/// The shift by the nodes of a run: they are the nodes of the drawing, rounded to the grid of the program.
fn refined(traced: &Traced, rounds: &Rounds, found: Found, index: usize) -> Placement {
    let (mut placement, mut spot) = (found.placement, found.spot);
    let mut low = Vector::new(f64::INFINITY, f64::INFINITY);
    let mut high = -low;
    let mut note = |off: Vector| {
        low = low.inf(&off);
        high = high.sup(&off);
    };
    note(Vector::zeros());
    for next in index..traced.blocks.len().min(index + 64) {
        let Some(block) = traced.blocks[next].segment() else {
            break;
        };
        let Some(reached) = placement.follow(rounds, traced, next, &spot, &found.spot) else {
            break;
        };
        // After an arc the places of a program that counts have drifted.
        let drifts = traced.counts && block.as_arc().is_some();
        let (Some(further), true, false) = (reached.spot, reached.whole, drifts) else {
            break;
        };
        note(found.placement.place(block.end()) - further.at);
        spot = further;
    }
    let shift = found.placement.shift + (low + high) / 2.0;
    let whole = shift.map(f64::round);
    let is_whole = (whole - shift).amax() <= 0.5 - (high - low).amax() / 2.0 + 0.01
        && (high - low).amax() <= 1.02;
    if is_whole {
        Placement::at(whole).gridded().unsurely()
    } else {
        Placement::at(shift)
    }
}
