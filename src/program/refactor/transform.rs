//! Mirrors and quarter turns about the origin, which change axes and signs and no number.

use crate::geometry::{Arc, Point, Segment, Vector};
use crate::program::grid::Node;

/// `x' = xx·x + xy·y`, `y' = yx·x + yy·y`, all of them 0, 1 or −1.
#[derive(Clone, Copy, Debug)]
pub(in crate::program) struct Transform {
    pub(super) xx: i64,
    pub(super) xy: i64,
    pub(super) yx: i64,
    pub(super) yy: i64,
}

impl Transform {
    pub(crate) fn of_numbers(self, x: i64, y: i64) -> (i64, i64) {
        (self.xx * x + self.xy * y, self.yx * x + self.yy * y)
    }

    pub(crate) fn of_node(self, node: Node) -> Node {
        let (x, y) = self.of_numbers(node.x, node.y);
        Node { x, y }
    }

    fn of_vector(self, v: Vector) -> Vector {
        Vector::new(
            self.xx as f64 * v.x + self.xy as f64 * v.y,
            self.yx as f64 * v.x + self.yy as f64 * v.y,
        )
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
        self.xx * self.yy - self.xy * self.yx < 0
    }

    /// X becomes Y.
    pub(crate) fn swaps(self) -> bool {
        self.xx == 0
    }

    /// The new sign of a coordinate, by its old axis.
    pub(crate) fn sign(self, axis: usize) -> i64 {
        match (self.swaps(), axis) {
            (false, 0) => self.xx,
            (false, _) => self.yy,
            (true, 0) => self.yx,
            (true, _) => self.xy,
        }
    }
}
