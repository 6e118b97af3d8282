//! Plane geometry of a wire's contour: points, arcs by bulge, segments, distances, intersections.
//!
//! Pure and total: nothing here reads a document, allocates by a number from outside, or panics. Lengths are in the
//! unit of the drawing, angles in radians, counter-clockwise positive.

mod approach;
mod arc;
mod biarc;
mod bounds;
mod boxes;
pub(crate) mod chords;
mod ellipse;
mod few;
mod grid;
mod intersection;
mod locus;
mod segment;
mod shells;
mod side;
mod slant;
mod spline;
mod tolerances;
mod xy;

pub(crate) use approach::{
    curvature, facing, foot_inside, meetings, reached, shared_length, shared_stretches,
};
pub use arc::Arc;
pub(crate) use arc::equally_far;
pub(crate) use biarc::{Chain, Curve, Unfit, fit};
pub(crate) use bounds::Bounds;
pub(crate) use boxes::Boxes;
pub(crate) use ellipse::EllipticArc;
pub(crate) use few::Few;
pub(crate) use grid::Grid;
pub(crate) use intersection::{circle_circle, line_circle, line_line};
pub(crate) use locus::{Locus, corner_between, led_to};
pub(crate) use segment::Line;
pub use segment::Segment;
pub(crate) use shells::{Shell, Shells};
pub use side::Side;
use slant::Slant;
pub(crate) use spline::{Spline, SplineCurve};
pub(crate) use tolerances::Tolerances;
pub(crate) use xy::{Xy, serialize_degrees};

/// A point of the plane, in drawing units.
pub type Point = nalgebra::Point2<f64>;
/// A displacement or direction in the plane.
pub type Vector = nalgebra::Vector2<f64>;

/// `a × b`, the z component of the cross product: positive when `b` lies to the left of `a`.
pub(crate) fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// `v` turned by a quarter turn to the left.
pub fn left_normal(v: Vector) -> Vector {
    Vector::new(-v.y, v.x)
}

/// The unit vector at `angle` radians from the +X axis.
///
/// Never inlined: the compiler takes sines to be cheap, and computes them even on branches that do not need them.
#[inline(never)]
pub fn direction(angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    Vector::new(cos, sin)
}

/// `degrees` in radians. Whole turns are removed first, which is exact in degrees and not in radians.
fn radians(degrees: f64) -> f64 {
    if degrees.abs() > 360.0 {
        (degrees % 360.0).to_radians()
    } else {
        degrees.to_radians()
    }
}

/// Signed angle from `a` to `b` in (−π, π], positive counter-clockwise; 0 when either is zero.
pub fn turn(a: Vector, b: Vector) -> f64 {
    let (sine, cosine) = (cross(a, b), a.dot(&b));
    // A short cut for most joints, which do not turn at all; the difference is below rounding.
    if sine.abs() < 1e-9 * cosine {
        return sine / cosine;
    }
    sine.atan2(cosine)
}

/// How far beyond a full turn (degrees) the end of an arc may lie for the arc to be a full turn: as programs round 2π or
/// 360°. Nobody writes 361° for 1°.
pub(crate) const BEYOND_A_TURN: f64 = 1.0;

/// The angles of an arc, degrees, in radians; the same one twice where the second lies a hair beyond a full turn.
pub(crate) fn radians_of_arc(from: f64, to: f64) -> (f64, f64) {
    let is_turn = (0.0..BEYOND_A_TURN).contains(&(to - from - 360.0));
    (radians(from), radians(if is_turn { from } else { to }))
}

/// `angle` brought into [0, 2π).
pub fn positive_angle(angle: f64) -> f64 {
    if (0.0..std::f64::consts::TAU).contains(&angle) {
        return angle;
    }
    let wrapped = angle.rem_euclid(std::f64::consts::TAU);
    // rem_euclid of a tiny negative number rounds up to 2π itself.
    if wrapped >= std::f64::consts::TAU {
        0.0
    } else {
        wrapped
    }
}
