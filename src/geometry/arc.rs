//! A circular arc, made from a bulge or from a centre, and its properties.

use super::{Bounds, Point, Vector, cross, direction, left_normal, positive_angle};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A circular arc from `start` to `end`.
///
/// `sweep` is positive counter-clockwise and at most a full turn; `start` and `end` are stored beside the angles
/// because the neighbours share them exactly, to the last bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    pub center: Point,
    pub radius: f64,
    /// Angle of `start` seen from the centre, radians.
    pub start_angle: f64,
    /// Radians, positive counter-clockwise, |sweep| ≤ 2π.
    pub sweep: f64,
    pub start: Point,
    pub end: Point,
}

/// Below this sweep (radians) the centre is so far away that rounding in its coordinates, and in angles about it, would
/// show: places on such an arc are measured from its start.
const SHALLOW: f64 = 1e-5;

impl Arc {
    /// The arc of a polyline segment with `bulge = tan(sweep / 4)`.
    ///
    /// Radius `L (1 + b²) / (4 |b|)`, centre `midpoint + (1 − b²) / (4 b) · left normal of the chord`, which
    /// also holds past a half turn (|b| > 1), where the centre changes sides.
    /// `None` where there is no arc: a bulge of zero, a chord of length zero, or numbers that overflow.
    pub(crate) fn from_bulge(start: Point, end: Point, bulge: f64) -> Option<Arc> {
        let chord = end - start;
        let length = chord.norm();
        if bulge == 0.0 || length == 0.0 {
            return None;
        }
        let radius = length * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
        let center =
            start + chord * 0.5 + left_normal(chord) * ((1.0 - bulge * bulge) / (4.0 * bulge));
        let start_angle = (start.y - center.y).atan2(start.x - center.x);
        let sweep = 4.0 * bulge.atan();
        let sound = radius.is_finite() && center.x.is_finite() && center.y.is_finite();
        sound.then_some(Arc {
            center,
            radius,
            start_angle,
            sweep,
            start,
            end,
        })
    }

    /// The arc about `center` from `start_angle` through `sweep` (radians, positive counter-clockwise).
    pub(crate) fn from_center(center: Point, radius: f64, start_angle: f64, sweep: f64) -> Arc {
        let start = center + direction(start_angle) * radius;
        let full = sweep.abs() >= TAU;
        let end = if full {
            start
        } else {
            center + direction(start_angle + sweep) * radius
        };
        Arc {
            center,
            radius,
            start_angle,
            sweep: sweep.clamp(-TAU, TAU),
            start,
            end,
        }
    }

    /// The arc from `start` to `end` with a radius: of at most half a turn, or of more where the radius is negative. A
    /// radius that is too small gives a half circle; the ends may not coincide.
    pub(crate) fn of_radius(start: Point, end: Point, radius: f64, counter_clockwise: bool) -> Arc {
        let chord = end - start;
        let half = chord.norm() / 2.0;
        let height = (radius * radius - half * half).max(0.0).sqrt();
        let is_left = counter_clockwise != (radius < 0.0);
        let aside = if is_left { height } else { -height };
        let normal = left_normal(chord) / (2.0 * half).max(1e-9);
        let center = start + chord / 2.0 + normal * aside;
        Arc::about(center, start, end, counter_clockwise)
    }

    /// The arc about `center` from `start` to `end`, counter-clockwise or clockwise. Coinciding ends are a full turn.
    pub fn about(center: Point, start: Point, end: Point, counter_clockwise: bool) -> Arc {
        let start_angle = (start.y - center.y).atan2(start.x - center.x);
        let end_angle = (end.y - center.y).atan2(end.x - center.x);
        let forward = positive_angle(end_angle - start_angle);
        let sweep = match (counter_clockwise, start == end) {
            (true, true) => TAU,
            (false, true) => -TAU,
            (true, false) => forward,
            (false, false) => forward - TAU,
        };
        Arc {
            center,
            radius: (start - center).norm(),
            start_angle,
            sweep,
            start,
            end,
        }
    }

    pub fn is_full_turn(&self) -> bool {
        self.sweep.abs() >= TAU
    }

    /// `tan(sweep / 4)`; a full turn has no finite bulge and gives ±infinity or a huge number.
    pub(crate) fn bulge(&self) -> f64 {
        (self.sweep / 4.0).tan()
    }

    /// Length along the arc.
    pub(crate) fn length(&self) -> f64 {
        self.radius * self.sweep.abs()
    }

    /// How high the arc rises above its chord, `r (1 − cos(sweep / 2))`; twice the radius for a full turn.
    pub(crate) fn sagitta(&self) -> f64 {
        2.0 * self.radius * (self.sweep / 4.0).sin().powi(2)
    }

    /// Nearly straight: its centre is too far away to be known well.
    pub(crate) fn is_shallow(&self) -> bool {
        self.sweep.abs() < SHALLOW
    }

    /// The same arc in the other direction.
    pub fn reversed(&self) -> Arc {
        Arc {
            start_angle: self.start_angle + self.sweep,
            sweep: -self.sweep,
            start: self.end,
            end: self.start,
            ..*self
        }
    }

    /// The point at `share` (0 … 1) of the sweep.
    pub fn point_at(&self, share: f64) -> Point {
        match share {
            s if s <= 0.0 => self.start,
            s if s >= 1.0 => self.end,
            s if self.is_shallow() => self.point_from_start(s),
            s => self.center + direction(self.start_angle + self.sweep * s) * self.radius,
        }
    }

    #[cold]
    fn point_from_start(&self, share: f64) -> Point {
        let half = self.sweep * share / 2.0;
        let along = left_normal(direction(self.start_angle + half));
        self.start + along * (2.0 * self.radius * half.sin())
    }

    /// Unit tangent in the direction of travel at `share` (0 … 1) of the sweep.
    pub(crate) fn tangent_at(&self, share: f64) -> Vector {
        let radial = direction(self.start_angle + self.sweep * share);
        left_normal(radial) * self.sweep.signum()
    }

    /// Share of the sweep (0 … 1) at which `point`'s direction from the centre lies, unclamped:
    /// below 0 or above 1 when it lies outside the arc, whichever end is nearer.
    pub fn share_of(&self, point: Point) -> f64 {
        let extent = self.sweep.abs();
        if extent == 0.0 {
            return 0.0;
        }
        if self.is_shallow() {
            let (out, along) = (self.start - self.center, point - self.start);
            return cross(out, along).atan2(out.norm_squared() + out.dot(&along)) / self.sweep;
        }
        let angle = (point.y - self.center.y).atan2(point.x - self.center.x);
        let travelled = positive_angle((angle - self.start_angle) * self.sweep.signum());
        // Past the end, the share counts from the nearer end.
        let past_middle = extent + (TAU - extent) / 2.0;
        if travelled > past_middle {
            (travelled - TAU) / extent
        } else {
            travelled / extent
        }
    }

    /// Smallest distance from `point` to the arc.
    pub(crate) fn distance_to(&self, point: Point) -> f64 {
        if self.spans(point) || point == self.center {
            return self.rise_of(point).abs();
        }
        let (from_start, from_end) = (point - self.start, point - self.end);
        from_start
            .norm_squared()
            .min(from_end.norm_squared())
            .sqrt()
    }

    /// True where the arc passes through the direction of `point` from the centre.
    #[inline]
    pub(crate) fn spans(&self, point: Point) -> bool {
        if self.is_shallow() {
            return (0.0..=1.0).contains(&self.share_of(point));
        }
        let way = point - self.center;
        let from_start = cross(self.start - self.center, way);
        let to_end = cross(way, self.end - self.center);
        let (behind_start, before_end) = match self.sweep > 0.0 {
            true => (from_start >= 0.0, to_end >= 0.0),
            false => (from_start <= 0.0, to_end <= 0.0),
        };
        match self.is_minor() {
            true => behind_start && before_end,
            false => behind_start || before_end || self.is_full_turn(),
        }
    }

    /// How far `point` lies outside the arc's circle; negative inside.
    pub(crate) fn rise_of(&self, point: Point) -> f64 {
        let to_center = (point - self.center).norm();
        if self.is_shallow() {
            // The difference of two squares, computed without cancelling the digits that they
            // share.
            let (out, along) = (self.start - self.center, point - self.start);
            return (along.norm_squared() + 2.0 * along.dot(&out)) / (to_center + self.radius);
        }
        to_center - self.radius
    }

    pub(crate) fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::of_points(&[self.start, self.end]);
        if self.is_shallow() {
            return bounds.grown(self.sagitta());
        }
        // The quarter points that the sweep passes widen the box of the two ends.
        if self.sweep.abs() <= 3.0 {
            let (mut from, mut to) = (self.start - self.center, self.end - self.center);
            if self.sweep < 0.0 {
                (from, to) = (to, from);
            }
            let mut pass = |is_passed: bool, x: f64, y: f64| {
                if is_passed {
                    bounds.include(self.center + Vector::new(x, y) * self.radius);
                }
            };
            pass(from.y <= 0.0 && to.y >= 0.0, 1.0, 0.0);
            pass(from.x >= 0.0 && to.x <= 0.0, 0.0, 1.0);
            pass(from.y >= 0.0 && to.y <= 0.0, -1.0, 0.0);
            pass(from.x <= 0.0 && to.x >= 0.0, 0.0, -1.0);
            return bounds;
        }
        let (low, high) = if self.sweep >= 0.0 {
            (self.start_angle, self.start_angle + self.sweep)
        } else {
            (self.start_angle + self.sweep, self.start_angle)
        };
        let first = (low / FRAC_PI_2).ceil();
        let last = (high / FRAC_PI_2).floor();
        for quarter in (0..4)
            .map(|more| first + f64::from(more))
            .take_while(|&quarter| quarter <= last)
        {
            let (x, y) = match quarter.rem_euclid(4.0) as u8 {
                0 => (1.0, 0.0),
                1 => (0.0, 1.0),
                2 => (-1.0, 0.0),
                _ => (0.0, -1.0),
            };
            bounds.include(self.center + Vector::new(x, y) * self.radius);
        }
        bounds
    }

    /// Twice the signed area between the chord and the arc, `r² (sweep − sin sweep)`: the arc's share of the shoelace
    /// sum.
    #[inline(never)]
    pub(crate) fn twice_cap_area(&self) -> f64 {
        let sweep = self.sweep;
        // The series of sin is more accurate where the sweep is small.
        let difference = if sweep.abs() < 1e-3 {
            sweep.powi(3) / 6.0 * (1.0 - sweep * sweep / 20.0)
        } else {
            sweep - sweep.sin()
        };
        self.radius * self.radius * difference
    }

    /// True when the arc turns by at most a half turn.
    pub(crate) fn is_minor(&self) -> bool {
        self.sweep.abs() <= PI
    }
}

/// The place nearest to a centre that is equally far from two ends; `None` where they coincide.
pub(crate) fn equally_far(center: Point, start: Point, end: Point) -> Option<Point> {
    let along = (end - start).try_normalize(0.0)?;
    let middle = start + (end - start) * 0.5;
    Some(center - along * (center - middle).dot(&along))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn past_a_half_turn_the_centre_lies_on_the_other_side_of_the_chord() {
        let arc =
            Arc::from_bulge(Point::new(0.0, 0.0), Point::new(2.0, 0.0), 3.0_f64.sqrt()).unwrap();
        assert!((arc.sweep - 4.0 * PI / 3.0).abs() < 1e-12);
        assert!((arc.center - arc.start).norm() - arc.radius < 1e-12);
        assert!(arc.center.y < 0.0, "{:?}", arc.center);
    }

    #[test]
    fn the_ends_are_reached_exactly_and_never_passed() {
        let (start, end) = (Point::new(5.0, 0.1), Point::new(0.1, 5.0));
        let arc = Arc::about(Point::origin(), start, end, true);
        for share in [-0.3, 0.0] {
            assert_eq!(arc.point_at(share), start);
        }
        for share in [1.0, 1.3] {
            assert_eq!(arc.point_at(share), end);
        }
    }

    #[test]
    fn bulge_and_centre_agree_at_every_sweep() {
        for step in 1..40 {
            for sign in [1.0, -1.0] {
                let bulge = sign * step as f64 * 0.1;
                let (start, end) = (Point::new(3.0, -1.0), Point::new(4.5, 2.0));
                let arc = Arc::from_bulge(start, end, bulge).unwrap();
                assert!(((start - arc.center).norm() - arc.radius).abs() < 1e-12);
                assert!(((end - arc.center).norm() - arc.radius).abs() < 1e-12);
                assert!(
                    (arc.center + direction(arc.start_angle + arc.sweep) * arc.radius - end).norm()
                        < 1e-12
                );
                assert!((arc.bulge() - bulge).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn distance_and_bounds_of_a_quarter() {
        let arc = Arc::from_center(Point::origin(), 2.0, 0.0, FRAC_PI_2);
        assert!((arc.distance_to(Point::new(3.0, 3.0)) - (18.0_f64.sqrt() - 2.0)).abs() < 1e-12);
        assert!((arc.distance_to(Point::new(2.0, -1.0)) - 1.0).abs() < 1e-12);
        let bounds = arc.bounds();
        assert!(
            (bounds.max - Point::new(2.0, 2.0)).norm() < 1e-12 && bounds.min.coords.norm() < 1e-12
        );
    }
}
