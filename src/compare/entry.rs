//! Where a pass begins: the first block of its contour, and its place on the ring.

use super::walk::{At, COVERED, Walk};
use super::walls::FARTHEST;
use crate::geometry::{Point, Vector};

/// Blocks from which a pass may be followed.
const FIRST: usize = 10;
/// From so many blocks on that follow, a pass has begun.
const BEGUN: usize = 3;
/// So many corners of a ring are tried.
const ENTRIES: usize = 200;

/// The first block of a pass that is of its contour, and where it begins, from a place of the program.
pub(super) fn begin(walk: &Walk, shift: Vector, is_relative: bool) -> Option<(usize, At)> {
    let length = walk.ring.length;
    for index in first_blocks(walk) {
        let start = walk.segment(index)?.start() + shift;
        if !walk.budget.take(walk.ring.pieces.len()) {
            return None;
        }
        if is_relative && let Some(begin) = from_corner(walk, index, shift) {
            return Some(begin);
        }
        let near = walk.ring.nearest(start, 0.0, length * (1.0 - 1e-12));
        // A machine that counts has drifted there.
        let reach = if walk.counts {
            2.0 * walk.within
        } else {
            walk.within
        };
        let Some((along, _)) = near.filter(|(_, away)| *away <= reach) else {
            continue;
        };
        let drift = if walk.counts {
            walk.place(along) - start
        } else {
            Vector::zeros()
        };
        let at = At {
            along,
            shift: shift + drift,
        };
        // Its first block may be the wrong one.
        let complete = along + length - COVERED;
        let goes_on =
            || walk.runs_along(index, at) && walk.resume(index, at, None, complete).is_some();
        if walk.follow(index, at).is_some() || goes_on() {
            return Some((index, at));
        }
    }
    None
}

/// The first blocks of a pass: those that may lead to its contour, and one more.
fn first_blocks(walk: &Walk) -> Vec<usize> {
    let blocks = walk
        .range
        .clone()
        .filter(|index| walk.segment(*index).is_some());
    blocks.take(FIRST).collect()
}

/// The begin of a pass with one block that follows with the next ones at a place, or from a corner near it: where a
/// program counts from block to block, most of it may lie elsewhere because of a block that is wrong.
fn from_corner(walk: &Walk, index: usize, shift: Vector) -> Option<(usize, At)> {
    let own = walk.segment(index)?;
    let length = walk.ring.length;
    let follows = |at: At| {
        let complete = at.along + length - COVERED;
        let followed = walk.count(index, at, BEGUN, complete);
        followed.count >= BEGUN || followed.count > 0 && followed.along >= complete
    };
    let near = walk
        .ring
        .nearest(own.start() + shift, 0.0, length * (1.0 - 1e-12));
    let here = near.filter(|(_, away)| *away <= walk.within);
    let here = here
        .map(|(along, _)| At { along, shift })
        .filter(|at| follows(*at));
    if let Some(at) = here {
        return Some((index, at));
    }
    let corners = walk.ring.pieces.iter().take(ENTRIES).map(|piece| At {
        along: piece.before,
        shift: piece.segment.start() - own.start(),
    });
    let near = corners.filter(|at| (at.shift - shift).norm() <= FARTHEST);
    let mut near: Vec<At> = near.collect();
    near.sort_by(|one, other| {
        let away = |at: &At| (at.shift - shift).norm();
        away(one).total_cmp(&away(other))
    });
    near.into_iter()
        .find(|at| follows(*at))
        .map(|at| (index, at))
}

/// The same from wherever a corner of the ring is its first one, as near to a place as may be.
pub(super) fn enter(walk: &Walk, shift: Vector) -> Option<(usize, At)> {
    let blocks = first_blocks(walk);
    let length = walk.ring.length;
    let enough = |index: usize, at: At| {
        let left = walk.range.clone().skip_while(|own| *own < index);
        let left = left.filter(|own| walk.segment(*own).is_some()).count();
        let complete = at.along + length - COVERED;
        let followed = walk.count(index, at, BEGUN, complete);
        followed.count >= BEGUN.min(left) || followed.count > 0 && followed.along >= complete
    };
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
