//! One side of an open contour.
//!
//! The wire's way round an open contour goes there on one side of it, round its last end, back on the other side and
//! round its first end: there and back the contour is a closed one that holds nothing. The path is the part on the side
//! of the wire, between the ways round the two ends: it begins and ends at the correction from the ends, square to the
//! contour there.

use super::corners::{Element, Raw};
use super::loops::Loops;
use super::offset::Wall;
use crate::geometry::Point;

/// The walls of an open contour, and after them the same backwards.
pub(super) fn there_and_back(walls: &[Wall]) -> Vec<Wall> {
    let back = walls.iter().rev().map(|wall| Wall {
        geometry: wall.geometry.reversed(),
        ..*wall
    });
    walls.iter().copied().chain(back).collect()
}

/// Why there is no path: nothing of one lies on the side of the wire, or some of it is lost, near a point beside a
/// wall.
pub(super) type Lost = Option<(Point, usize)>;

/// The path on the side of the wire, from all closed ways about an open contour with this many `walls`.
pub(super) fn one_side(
    loops: Loops,
    raw: &Raw,
    walls: usize,
) -> Result<Vec<(usize, Element)>, Lost> {
    let end = raw.end_roll(walls);
    let is_own = |piece: &(usize, Element)| piece.0 < end;
    let lost =
        |(_, element): &(usize, Element)| Some((element.geometry.point_at(0.5), element.wall));
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
    Ok(path)
}
