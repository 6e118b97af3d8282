//! Where a program lies on its drawing.

use super::REACH;
use super::matching::{Found, matching};
use super::pose::Pose;
use super::rounds::Rounds;
use super::traced::{Motion, Traced};
use super::walk::Walk;
use crate::geometry::Vector;

/// Blocks from which it is tried.
const TRIED: usize = 60;
/// Blocks by which places are told apart.
const SURE: usize = 40;

/// Where the program lies, from the blocks of its cuts; `None` where nothing of it is like the drawing.
pub(super) fn anchor(traced: &Traced, rounds: &Rounds) -> Option<Pose> {
    let still = Pose::at(Vector::zeros());
    let walk = Walk::new(traced, rounds, still);
    let cuts = traced.blocks.iter().enumerate();
    let cuts = cuts.filter(|(_, block)| matches!(block.motion, Motion::Cut(_)));
    let tried: Vec<usize> = cuts.map(|(index, _)| index).take(TRIED).collect();
    let mut best: Option<(usize, Found, usize)> = None;
    if traced.is_placed {
        for &index in &tried {
            let Some(begin) = still.begin(&traced.blocks[index]) else {
                continue;
            };
            for spot in rounds.near(begin, REACH) {
                let (count, ends) = walk.verify(still, spot, spot, index, SURE);
                let count = count + usize::from(ends);
                if best.as_ref().is_none_or(|(most, ..)| count > *most) {
                    best = Some((count, Found { spot, pose: still }, index));
                }
            }
            if best.as_ref().is_some_and(|(most, ..)| *most >= 3) {
                break;
            }
        }
        if best.as_ref().is_some_and(|(most, ..)| *most >= 2) {
            return Some(still.gridded());
        }
    }
    // The first contour says it: whatever is wrong in one moves what comes behind.
    for &index in &tried {
        for found in matching(rounds, traced, index, &still) {
            let (count, ends) = walk.verify(found.pose, found.spot, found.spot, index, SURE);
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

/// The shift by the nodes of a run: they lie on the grid of the program, and are those of the drawing rounded.
fn refined(traced: &Traced, rounds: &Rounds, found: Found, index: usize) -> Pose {
    let (mut pose, mut spot) = (found.pose, found.spot);
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
        let Some(reached) = pose.follow(rounds, traced, next, &spot, &found.spot) else {
            break;
        };
        let exact = !traced.counts || block.as_arc().is_none();
        let (Some(further), true) = (reached.spot, reached.whole) else {
            break;
        };
        if exact {
            note(found.pose.place(block.end()) - further.at);
        } else {
            // Behind an arc the program's own places have drifted.
            break;
        }
        spot = further;
    }
    let shift = found.pose.shift + (low + high) / 2.0;
    let whole = shift.map(f64::round);
    let is_whole = (whole - shift).amax() <= 0.5 - (high - low).amax() / 2.0 + 0.01
        && (high - low).amax() <= 1.02;
    if is_whole {
        Pose::at(whole).gridded().unsurely()
    } else {
        Pose::at(shift)
    }
}
