//! Pieces that may fill a gap between two blocks.

use crate::geometry::{Point, Segment, Vector, turn};

/// Blocks that meet within this angle are smooth, radians: two degrees, the rounding to µm of a small arc.
pub(in crate::program) const SMOOTH: f64 = 0.035;

/// No arc between two others turns by more, half of its turn in radians.
const WIDEST: f64 = 2.9;

/// Shorter blocks are not lost, but rounding, µm.
pub(super) const SHORTEST: f64 = 10.0;

/// Lines that end this far, µm, beside one line are parts of it.
const COLLINEAR: f64 = 1.5;

/// Half the turn of the arc that smoothly fills the gap between the direction before it and the one after it, radians;
/// `None` where there is none, or it would be a line.
pub(in crate::program) fn half_turn_between(
    before: Vector,
    behind: Vector,
    gap: Vector,
) -> Option<f64> {
    let (into, out) = (turn(before, gap), turn(gap, behind));
    let half = (into + out) / 2.0;
    let is_arc = (into - out).abs() <= SMOOTH && half.abs() > SMOOTH && half.abs() < WIDEST;
    is_arc.then_some(half)
}

/// The line over a gap, and the arc that fills it smoothly.
pub(super) fn fillings(
    gap: Vector,
    headings: Option<[Vector; 2]>,
) -> impl Iterator<Item = Segment> {
    let (start, end) = (Point::origin(), Point::from(gap));
    let half = headings.and_then(|[before, behind]| half_turn_between(before, behind, gap));
    let arc = half.map(|half| Segment::from_bulge(start, end, (half / 2.0).tan()));
    let ways = arc.into_iter().chain([Segment::line(start, end)]);
    ways.filter(move |_| gap.norm() >= SHORTEST)
}

/// True for two straight pieces, one after the other, that would have been written as one.
pub(in crate::program) fn is_one_line(one: Vector, other: Vector) -> bool {
    turn(one, other).abs() * one.norm().min(other.norm()) <= COLLINEAR
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_fills_a_gap_whose_ends_it_is_tangent_to() {
        let [right, up, left] =
            [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)].map(|(x, y)| Vector::new(x, y));
        let quarter = half_turn_between(right, up, Vector::new(5.0, 5.0));
        assert!(quarter.is_some_and(|half| (half - std::f64::consts::FRAC_PI_4).abs() < 1e-9));
        let half = half_turn_between(right, left, up * 8.0);
        assert!(half.is_some_and(|half| (half - std::f64::consts::FRAC_PI_2).abs() < 1e-9));
        assert_eq!(half_turn_between(right, right, right), None);
        assert_eq!(half_turn_between(right, up, up), None);
    }

    #[test]
    fn lines_that_run_on_are_one_within_rounding() {
        let line = Vector::new(8000.0, 0.0);
        assert!(is_one_line(line, Vector::new(500.0, 1.0)));
        assert!(!is_one_line(line, Vector::new(500.0, 9.0)));
        assert!(!is_one_line(line, -line));
    }
}
