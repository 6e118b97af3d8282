//! Mirrors and quarter turns about the origin, which change axes and signs and no number.

use crate::geometry::{Arc, Point, Segment, Vector};

/// `x' = xx·x + xy·y`, `y' = yx·x + yy·y`, all of them 0, 1 or −1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) struct Transform(pub(in crate::program) [[i64; 2]; 2]);

impl Transform {
    /// Everything stays where it is.
    pub(crate) const NONE: Transform = Transform([[1, 0], [0, 1]]);

    pub(crate) fn of_place(self, [x, y]: [i64; 2]) -> [i64; 2] {
        self.0.map(|[along_x, along_y]| along_x * x + along_y * y)
    }

    fn of_vector(self, v: Vector) -> Vector {
        Vector::from(self.0.map(|[x, y]| x as f64 * v.x + y as f64 * v.y))
    }

    pub(crate) fn of_point(self, point: Point) -> Point {
        Point::from(self.of_vector(point.coords))
    }

    pub(crate) fn of_segment(self, segment: &Segment) -> Segment {
        let Segment::Arc(arc) = segment else {
            return Segment::line(self.of_point(segment.start()), self.of_point(segment.end()));
        };
        let from_center = self.of_vector(arc.start - arc.center);
        let turn = if self.mirrors() { -1.0 } else { 1.0 };
        Segment::Arc(Arc {
            center: self.of_point(arc.center),
            start: self.of_point(arc.start),
            end: self.of_point(arc.end),
            start_angle: from_center.y.atan2(from_center.x),
            sweep: turn * arc.sweep,
            radius: arc.radius,
        })
    }

    pub(crate) fn mirrors(self) -> bool {
        let [[xx, xy], [yx, yy]] = self.0;
        xx * yy - xy * yx < 0
    }

    /// X becomes Y.
    pub(crate) fn swaps(self) -> bool {
        self.0[0][0] == 0
    }

    /// The new sign of a coordinate, by its old axis.
    pub(crate) fn sign(self, axis: usize) -> i64 {
        self.0.iter().map(|row| row[axis]).sum()
    }
}
