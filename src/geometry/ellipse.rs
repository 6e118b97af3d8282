//! An arc of an ellipse, by two conjugate half diameters: any plane transformation of it is again such an arc.

use super::biarc::Curve;
use super::{Point, Vector};
use std::f64::consts::{FRAC_PI_2, TAU};

/// `center + u cos t + v sin t` for `t` from `start` through `sweep` radians; a full turn is closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EllipticArc {
    pub(crate) center: Point,
    /// From the centre to the point at parameter 0.
    pub(crate) u: Vector,
    /// From the centre to the point at parameter π / 2.
    pub(crate) v: Vector,
    pub(crate) start: f64,
    /// The parameter range, |sweep| ≤ 2π.
    pub(crate) sweep: f64,
}

impl EllipticArc {
    pub(crate) fn is_full_turn(&self) -> bool {
        self.sweep.abs() >= TAU - 1e-9
    }

    /// True when numbers are finite and the two half diameters span a plane.
    pub(crate) fn is_sound(&self) -> bool {
        let area = super::cross(self.u, self.v);
        let numbers = [
            self.center.x,
            self.center.y,
            self.start,
            self.sweep,
            area,
            self.u.norm(),
            self.v.norm(),
        ];
        numbers.iter().all(|number| number.is_finite()) && area != 0.0 && self.sweep != 0.0
    }
}

impl Curve for EllipticArc {
    fn pieces(&self) -> Vec<(f64, f64)> {
        let count = (self.sweep.abs() / FRAC_PI_2 - 1e-9).ceil().clamp(1.0, 4.0);
        let place = |index: f64| self.start + self.sweep * (index / count);
        (0..count as usize)
            .map(|index| (place(index as f64), place(index as f64 + 1.0)))
            .collect()
    }

    fn at(&self, piece: usize, t: f64) -> (Point, Vector) {
        // The last point of a full turn is the first one, to the last bit.
        let t = if self.is_full_turn() && piece == 3 && t == self.start + self.sweep {
            self.start
        } else {
            t
        };
        let (sin, cos) = t.sin_cos();
        (
            self.center + self.u * cos + self.v * sin,
            self.v * cos - self.u * sin,
        )
    }

    fn extent(&self) -> f64 {
        self.u.norm().max(self.v.norm()) * 2.0
    }
}
