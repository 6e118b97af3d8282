//! Chords in a row that stand for an arc: five or more lines whose ends lie on one circle.
//!
//! Where chords are short, the rounding of their corners hides how the outline turns from one to the next: the corners are then
//! also taken in strides ([`STRIDES`]), and those between only have to lie on the circle.

use super::{Point, cross, left_normal, line_line};

/// The number of chords that make an arc.
pub(crate) const LEAST: usize = 5;

/// Every how many corners the turn is looked at. A circle of R 10 mm in a thousand chords of 0.06 mm, rounded to
/// 0.001 mm: a corner turns by 0.4°, and rounding turns it by 1°; every fourth corner, 1.4° and 0.2°.
pub(crate) const STRIDES: [usize; 3] = [1, 4, 16];

/// Tangent of the largest turn (25°) from chord to chord: a hexagon stays a hexagon, 16 chords to the full circle are
/// an arc.
const STEEPEST: f64 = 0.466_307_658;

/// How far from an arc those chords may lie that stand for it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Within {
    /// Their ends.
    pub(crate) corners: f64,
    /// Their middles, inside of it.
    pub(crate) chords: f64,
}

/// The circle through some points in a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FittedCircle {
    pub(crate) center: Point,
    pub(crate) radius: f64,
    /// The largest distance of a corner.
    pub(crate) deviation: f64,
    pub(crate) counter_clockwise: bool,
}

/// The circle through the ends of chords in a row, `point` by number. `None` unless they all turn the same way by a
/// small angle, at one of some strides, lie `within` one circle, and fit it clearly better than a straight line.
fn fit(
    point: impl Fn(usize) -> Point,
    chords: usize,
    strides: &[usize],
    within: Within,
) -> Option<FittedCircle> {
    let turns = |stride: &usize| turn_of_all(&point, chords, chords / stride);
    let side = strides.iter().find_map(turns)?;
    let (first, last) = (point(0), point(chords));
    // On a full circle both ends are one point.
    let round = (last - first).norm() < (point(1) - first).norm() * 0.5;
    let (middle, end) = if round {
        (point(chords / 3), point(2 * chords / 3))
    } else {
        (point(chords / 2), last)
    };
    let center = center_through(first, middle, end)?;
    let radius = (first - center).norm();
    let axis = last - first;
    let (mut deviation, mut rise) = (0_f64, 0_f64);
    for corner in (0..=chords).map(&point) {
        deviation = deviation.max(((corner - center).norm() - radius).abs());
        if deviation > within.corners {
            return None;
        }
        rise = rise.max(cross(axis, corner - first).abs());
    }
    rise = if round { radius } else { rise / axis.norm() };
    let is_shallow = |at: usize| turn_of_corner([at - 1, at, at + 1].map(&point)).is_some();
    let is_near = |at: usize| {
        let middle = point(at) + (point(at + 1) - point(at)) * 0.5;
        radius - (middle - center).norm() <= within.chords
    };
    let fits = rise > 4.0 * deviation
        && (1..chords).all(is_shallow)
        && (within.chords == f64::INFINITY || (0..chords).all(is_near));
    fits.then_some(FittedCircle {
        center,
        radius,
        deviation,
        counter_clockwise: side > 0.0,
    })
}

/// The side to which `pieces` of about the same number of chords turn, all of them.
fn turn_of_all(point: &impl Fn(usize) -> Point, chords: usize, pieces: usize) -> Option<f64> {
    let node = |index: usize| point(index * chords / pieces);
    let turn = |middle: usize| turn_of_corner([node(middle - 1), node(middle), node(middle + 1)]);
    if pieces < LEAST {
        return None;
    }
    let side = turn(1)?;
    let alike = |turn: f64| turn * side > 0.0;
    (1..pieces)
        .all(|middle| turn(middle).is_some_and(alike))
        .then_some(side)
}

/// Positive to the left; `None` where it is too steep for chords of an arc.
fn turn_of_corner([before, corner, behind]: [Point; 3]) -> Option<f64> {
    let (one, other) = (corner - before, behind - corner);
    let (sine, cosine) = (cross(one, other), one.dot(&other));
    (cosine > 0.0 && sine.abs() <= STEEPEST * cosine).then_some(sine)
}

fn center_through(a: Point, b: Point, c: Point) -> Option<Point> {
    let (one, other) = (b - a, c - b);
    line_line(
        a + one * 0.5,
        left_normal(one),
        b + other * 0.5,
        left_normal(other),
    )
}

/// The longest window of at most `most` chords that fits one circle; `point` by its number, of so many chords.
pub(crate) fn longest_window(
    point: impl Fn(usize, usize) -> Point,
    most: usize,
    within: Within,
) -> Option<usize> {
    let fits = |stride: &usize| {
        let chords = LEAST * stride;
        let is_it = chords <= most
            && fit(|index| point(index, chords), chords, &[*stride], within).is_some();
        is_it.then_some(chords)
    };
    STRIDES.iter().rev().find_map(fits)
}

/// The longest run of at most `most` chords that fits one circle, `point` by its number.
pub(crate) fn longest(
    point: impl Fn(usize) -> Point,
    most: usize,
    within: Within,
) -> Option<(usize, FittedCircle)> {
    let fit = |chords: usize| fit(&point, chords, &STRIDES, within);
    let mut chords = longest_window(|index, _| point(index), most, within)?;
    // Doubled while it fits, then found between what fits and what does not.
    let mut too_many = most + 1;
    while too_many - chords > 1 {
        let next = match too_many > most {
            true => (2 * chords).min(most),
            false => chords.midpoint(too_many),
        };
        match fit(next) {
            Some(_) => chords = next,
            None => too_many = next,
        }
    }
    Some((chords, fit(chords)?))
}

/// A corner that turns by more than this (radians) does not lie between chords.
pub(crate) fn steepest() -> f64 {
    STEEPEST.atan()
}
