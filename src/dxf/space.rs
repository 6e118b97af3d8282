//! Planes in space: where the plane of an entity or a block lies in the space around it.
//!
//! The extrusion gives the plane of an entity's own coordinates by the arbitrary axis algorithm (DXF reference, object
//! coordinate systems). A shape whose plane ends parallel to that of the drawing is cut, however often it was tilted on
//! the way.

use super::shape::Affine;
use crate::geometry::{Point, Vector};

pub(super) type Vector3 = nalgebra::Vector3<f64>;

/// A plane is flat when it rises by no more than this share of a length along it: a micron in a metre.
pub(super) const FLAT: f64 = 1e-6;
/// Below this share of 1 in x and y, a normal counts as near the z axis (DXF reference, arbitrary axis algorithm).
const NEAR_Z: f64 = 1.0 / 64.0;

/// `p ↦ x · p.x + y · p.y + z · p.z + origin`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Space {
    pub(super) x: Vector3,
    pub(super) y: Vector3,
    pub(super) z: Vector3,
    pub(super) origin: Vector3,
}

impl Space {
    pub(super) const IDENTITY: Space = Space {
        x: Vector3::new(1.0, 0.0, 0.0),
        y: Vector3::new(0.0, 1.0, 0.0),
        z: Vector3::new(0.0, 0.0, 1.0),
        origin: Vector3::new(0.0, 0.0, 0.0),
    };

    /// The coordinate system of an extrusion; `None` for one without length, or with numbers that overflow.
    pub(super) fn of_extrusion(extrusion: Vector3) -> Option<Space> {
        let z = extrusion.try_normalize(0.0).filter(|z| z.norm() > 0.5)?;
        let across = if z.x.abs() < NEAR_Z && z.y.abs() < NEAR_Z {
            Vector3::y()
        } else {
            Vector3::z()
        };
        let x = across.cross(&z).try_normalize(0.0)?;
        Some(Space {
            x,
            y: z.cross(&x),
            z,
            origin: Vector3::zeros(),
        })
    }

    /// The plane through points, with its origin at the first of them; `None` where they are not in one plane, measured
    /// against their spread.
    pub(super) fn through(points: &[Vector3]) -> Option<Space> {
        let first = *points.first()?;
        let far = |from: &dyn Fn(&Vector3) -> f64| points.iter().map(from).fold(0.0, f64::max);
        let spread = far(&|point| (point - first).norm());
        let along = points
            .iter()
            .map(|point| point - first)
            .max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let x = along.try_normalize(0.0).unwrap_or(Vector3::x());
        let off_axis = |point: &Vector3| (point - first) - x * x.dot(&(point - first));
        let aside = points
            .iter()
            .map(off_axis)
            .max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        // Points on one line lie in many planes: any that is level across the line will do.
        let level = Vector3::z()
            .cross(&x)
            .try_normalize(1e-9)
            .unwrap_or(Vector3::y());
        let y = if aside.norm() > FLAT * spread {
            aside.try_normalize(0.0)?
        } else {
            level
        };
        let z = x.cross(&y);
        (far(&|point| z.dot(&(point - first)).abs()) <= FLAT * spread).then_some(Space {
            x,
            y,
            z,
            origin: first,
        })
    }

    pub(super) fn vector(&self, vector: Vector3) -> Vector3 {
        self.x * vector.x + self.y * vector.y + self.z * vector.z
    }

    pub(super) fn point(&self, point: Vector3) -> Vector3 {
        self.origin + self.vector(point)
    }

    /// First `inner`, then this one.
    pub(super) fn after(&self, inner: &Space) -> Space {
        Space {
            x: self.vector(inner.x),
            y: self.vector(inner.y),
            z: self.vector(inner.z),
            origin: self.point(inner.origin),
        }
    }

    /// A point in the coordinates of a plane from [`Space::through`].
    pub(super) fn seen_from(&self, point: Vector3) -> Point {
        let from = point - self.origin;
        Point::new(self.x.dot(&from), self.y.dot(&from))
    }

    /// True where the plane of x and y ends parallel to that of the drawing.
    pub(super) fn is_flat(&self) -> bool {
        [self.x, self.y]
            .iter()
            .all(|axis| axis.z.abs() <= FLAT * axis.norm())
    }

    /// The plane of x and y after the transformation, seen from above.
    pub(super) fn seen_from_above(&self) -> Affine {
        Affine {
            x_axis: self.x.xy(),
            y_axis: self.y.xy(),
            origin: Point::from(self.origin.xy()),
        }
    }
}

/// The plane of a shape.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Lies {
    /// Level, at this height.
    Level(f64),
    /// In a plane with coordinates of its own; with the reason why it is not cut as it is.
    Aslant(Box<Space>, &'static str),
    /// The ends of a rising line; its shape is the view from above.
    Rising(Box<[Vector3; 2]>),
}

pub(super) fn in_space(point: Vector, height: f64) -> Vector3 {
    Vector3::new(point.x, point.y, height)
}
