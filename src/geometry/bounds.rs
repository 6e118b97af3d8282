//! Axis-parallel boxes.

use super::Point;
use super::Vector;

/// A closed axis-parallel box. The empty box has `min` above `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) min: Point,
    pub(crate) max: Point,
}

impl Bounds {
    pub(crate) const EMPTY: Bounds = Bounds {
        min: Point::new(f64::INFINITY, f64::INFINITY),
        max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The smallest box that holds all `points`; empty for none.
    pub(crate) fn of_points(points: &[Point]) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        points.iter().for_each(|&point| bounds.include(point));
        bounds
    }

    /// The box of a disc.
    pub(crate) fn of_disc(center: Point, radius: f64) -> Bounds {
        Bounds {
            min: center.map(|c| c - radius),
            max: center.map(|c| c + radius),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.min.x > self.max.x
    }

    pub(crate) fn include(&mut self, point: Point) {
        self.min = self.min.inf(&point);
        self.max = self.max.sup(&point);
    }

    pub(crate) fn merge(&mut self, other: &Bounds) {
        self.min = self.min.inf(&other.min);
        self.max = self.max.sup(&other.max);
    }

    /// The smallest box that holds both.
    pub(crate) fn merged(&self, other: &Bounds) -> Bounds {
        Bounds {
            min: self.min.inf(&other.min),
            max: self.max.sup(&other.max),
        }
    }

    /// True when all of the other box lies in this one.
    pub(crate) fn holds(&self, other: &Bounds) -> bool {
        self.min.x <= other.min.x
            && other.max.x <= self.max.x
            && self.min.y <= other.min.y
            && other.max.y <= self.max.y
    }

    /// True when the two boxes share a point.
    pub(crate) fn touches(&self, other: &Bounds) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
    }

    /// The box, moved.
    pub(crate) fn moved(&self, by: Vector) -> Bounds {
        Bounds {
            min: self.min + by,
            max: self.max + by,
        }
    }

    /// The box grown by `margin` on every side.
    pub(crate) fn grown(&self, margin: f64) -> Bounds {
        Bounds {
            min: self.min.map(|c| c - margin),
            max: self.max.map(|c| c + margin),
        }
    }

    pub(crate) fn width(&self) -> f64 {
        (self.max.x - self.min.x).max(0.0)
    }

    pub(crate) fn height(&self) -> f64 {
        (self.max.y - self.min.y).max(0.0)
    }
}
