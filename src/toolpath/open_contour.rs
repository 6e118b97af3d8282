//! One side of an open contour.
//!
//! The wire's way round an open contour goes there on one side of it, round its last end, back on the other side and
//! round its first end: there and back the contour is a closed one that holds nothing. The path is the part on the side
//! of the wire, between the ways round the two ends: it begins and ends at the correction from the ends, square to the
//! contour there.

use super::clearance::Walls;
use super::corners::{Element, Raw};
use super::loops::Loops;
use super::offset::Wall;
use super::path::Source;
use crate::geometry::Point;
use std::f64::consts::SQRT_2;

/// The walls of an open contour, and after them the same backwards.
pub(super) fn there_and_back(walls: &[Wall]) -> Vec<Wall> {
    let back = walls.iter().rev().map(|wall| Wall {
        geometry: wall.geometry.reversed(),
        ..*wall
    });
    walls.iter().copied().chain(back).collect()
}

/// A place that the wire does not come to, and the wall there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lost {
    pub(super) near: Point,
    pub(super) wall: usize,
}

/// Where walls at an end are not followed, more than this share of the correction may not stay uncut: it is what a corner of 90° leaves.
const LEFT_OF_AN_END: f64 = SQRT_2 - 1.0;

/// The path on the side of the wire, from all closed ways about an open contour of `walls`. None of these may be lost at an end, as in a
/// wedge that the wire does not come into: else what is lost, or nothing where none of the path lies on the side of the wire.
pub(super) fn one_side(
    loops: Loops,
    raw: &Raw,
    walls: &[Wall],
    correction: f64,
) -> Result<Vec<(usize, Element)>, Option<Lost>> {
    let end = raw.end_roll(walls.len());
    let is_own = |piece: &(usize, Element)| piece.0 < end;
    let lost = |(_, element): &(usize, Element)| {
        Some(Lost {
            near: element.geometry.point_at(0.5),
            wall: element.wall,
        })
    };
    let mut own = loops.into_iter().filter(|path| path.iter().any(is_own));
    let mut path = own.next().ok_or(None)?;
    if let Some(other) = own.next().and_then(|other| other.into_iter().find(is_own)) {
        return Err(lost(&other));
    }
    let count = path.len();
    let begins = |&at: &usize| is_own(&path[at]) && !is_own(&path[(at + count - 1) % count]);
    // Where there is no begin, the wire would be shut in between the ends.
    let begin = (0..count).find(begins).ok_or_else(|| lost(&path[0]))?;
    path.rotate_left(begin);
    let length = path.iter().take_while(|piece| is_own(piece)).count();
    let is_roll =
        |piece: Option<&(usize, Element)>, roll: usize| piece.is_some_and(|it| it.0 == roll);
    if let Some(again) = path[length..].iter().find(|piece| is_own(piece)) {
        return Err(lost(again));
    }
    if !is_roll(path.last(), raw.len() - 1) {
        return Err(lost(&path[0]));
    }
    if !is_roll(path.get(length), end) {
        return Err(lost(&path[length - 1]));
    }
    path.truncate(length);
    match lost_at_an_end(&path, walls, correction) {
        Some(lost) => Err(Some(lost)),
        None => Ok(path),
    }
}

/// The place of walls at an end that the path does not follow which is farthest from what the wire cuts, and its wall, where that is too far.
fn lost_at_an_end(path: &[(usize, Element)], walls: &[Wall], correction: f64) -> Option<Lost> {
    let followed = path
        .iter()
        .filter(|(_, element)| matches!(element.source, Source::Segment { .. }))
        .map(|(_, element)| element.wall);
    let (first, last) = followed.fold((walls.len(), 0), |(first, last), wall| {
        (first.min(wall), last.max(wall + 1))
    });
    if first == 0 && last >= walls.len() {
        return None;
    }
    let pieces = path.iter().map(|(_, element)| element.geometry).collect();
    let pieces = Walls::by_one_core(pieces);
    let lost = walls.iter().enumerate();
    let lost = lost.filter(|(wall, _)| !(first..last).contains(wall));
    let places = lost.flat_map(|(wall, Wall { geometry, .. })| {
        [0.0, 0.5, 1.0].map(|share| Lost {
            near: geometry.point_at(share),
            wall,
        })
    });
    let (away, lost) = places
        .map(|lost| (pieces.distance_to(lost.near, 2.0 * correction), lost))
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    (away > (1.0 + LEFT_OF_AN_END) * correction).then_some(lost)
}
