//! Tips in place of the ways round convex corners.

use super::clearance::Walls;
use super::corners::{Element, Joining, Way, between, corner, meetings};
use super::offset::{Offset, Wall, offset};
use super::path::Source;
use crate::geometry::{Point, Segment};

/// An extended corner reaches at most this many corrections from its vertex; beyond, the wire rolls about it.
const LONGEST_TIP: f64 = 4.0;

/// Lets the wire run to the tip in place of each roll about a corner, where it keeps clear of all walls on the way there and back.
/// What the path reaches stays as it is: the tips come on top of it.
pub(super) fn with_tips(
    path: Vec<Element>,
    walls: &[Wall],
    joining: &Joining,
    own: &Walls,
    clearance: f64,
) -> Vec<Element> {
    let count = path.len();
    let mut extended = path;
    let mut gone = vec![false; count];
    for index in 0..count {
        let roll = extended[index];
        if count < 3 || !matches!(roll.source, Source::Corner { .. }) {
            continue;
        }
        let (before, after) = ((index + count - 1) % count, (index + 1) % count);
        let (wall, next) = (roll.wall, (roll.wall + 1) % walls.len());
        let are_neighbours = |element: &Element, wall: usize| {
            element.wall == wall && !matches!(element.source, Source::Corner { .. })
        };
        if !are_neighbours(&extended[before], wall) || !are_neighbours(&extended[after], next) {
            continue;
        }
        let (one, other) = (&walls[wall].geometry, &walls[next].geometry);
        let turn = [one.end_tangent(), other.start_tangent()];
        let Way::Roll([from, to]) = corner(one.end(), turn, joining) else {
            continue;
        };
        let is_whole = (roll.geometry.start() - from).norm() <= joining.touch
            && (roll.geometry.end() - to).norm() <= joining.touch;
        let Some(tip) =
            tip(&walls[wall].geometry, &walls[next].geometry, joining).filter(|_| is_whole)
        else {
            continue;
        };
        let (out, back) = (extended[before].geometry, extended[after].geometry);
        let ways = [
            between(&out, roll.geometry.start(), tip),
            between(&back, tip, roll.geometry.end()),
        ];
        if ways
            .iter()
            .all(|way| own.too_near(way, clearance).is_none())
        {
            extended[before].geometry = between(&out, out.start(), tip);
            extended[after].geometry = between(&back, tip, back.end());
            gone[index] = true;
        }
    }
    extended
        .into_iter()
        .zip(gone)
        .filter(|(_, gone)| !gone)
        .map(|(element, _)| element)
        .collect()
}

/// Where the two offsets meet when both are extended beyond a convex corner; `None` when they do not, or too far out.
fn tip(wall: &Segment, next: &Segment, joining: &Joining) -> Option<Point> {
    let runs = |segment: &Segment| match offset(
        segment,
        joining.correction,
        joining.side,
        joining.tolerance,
    ) {
        Offset::Runs(geometry) if geometry.length() > 0.0 => Some(geometry),
        _ => None,
    };
    let (before, after) = (runs(wall)?, runs(next)?);
    let vertex = wall.end();
    meetings(&before, &after)
        .into_iter()
        .filter(|&tip| {
            (tip - before.end()).dot(&before.end_tangent()) > 0.0
                && (tip - after.start()).dot(&after.start_tangent()) < 0.0
                && (tip - vertex).norm() <= LONGEST_TIP * joining.correction
        })
        .min_by(|a, b| (a - vertex).norm().total_cmp(&(b - vertex).norm()))
}
