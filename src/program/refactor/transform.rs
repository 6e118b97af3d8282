//! Mirror and rotate a program about the origin of its frame: its zero, or where it begins, where nothing says otherwise.
//!
//! ```text
//! B5000B0B5000GXL1           B5000B0B5000GYL2         G01 X5. Y0.                G01 X0. Y5.
//! B5000B0B10000GYNR1    →    B0B5000B10000GXNR2       G03 X0. Y5. I-5. J0.  →    G03 X-5. Y0. I0. J-5.     (a quarter turn)
//! ```
//!
//! Every number stays as it is written; axes, quadrants, letters, signs change. So the path changes exactly.

use super::{Notation, Refactoring, Rewrite, Sheet};
use crate::geometry::{Arc, Point, Segment, Vector};
use crate::program::grid::Node;
use crate::text::TextEdit;

pub(super) fn all<N: Notation>() -> [Refactoring<N>; 5] {
    [
        Refactoring {
            id: "refactor.rewrite.mirror.x",
            title: |_| say!(mirror_left_and_right).into(),
            rewrite: |sheet| transformed(sheet, [-1, 0, 0, 1]),
        },
        Refactoring {
            id: "refactor.rewrite.mirror.y",
            title: |_| say!(mirror_up_and_down).into(),
            rewrite: |sheet| transformed(sheet, [1, 0, 0, -1]),
        },
        Refactoring {
            id: "refactor.rewrite.rotate.left",
            title: |_| say!(rotate_by_90_counter_clockwise).into(),
            rewrite: |sheet| transformed(sheet, [0, -1, 1, 0]),
        },
        Refactoring {
            id: "refactor.rewrite.rotate.right",
            title: |_| say!(rotate_by_90_clockwise).into(),
            rewrite: |sheet| transformed(sheet, [0, 1, -1, 0]),
        },
        Refactoring {
            id: "refactor.rewrite.rotate.half",
            title: |_| say!(rotate_by_180).into(),
            rewrite: |sheet| transformed(sheet, [-1, 0, 0, -1]),
        },
    ]
}

/// `x' = xx·x + xy·y`, `y' = yx·x + yy·y`, all of them 0, 1 or −1.
#[derive(Clone, Copy, Debug)]
pub(in crate::program) struct Transform {
    xx: i64,
    xy: i64,
    yx: i64,
    yy: i64,
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

    fn of_point(self, point: Point) -> Point {
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

    /// The sign that the coordinate of an axis gets, by the axis on which it stood.
    pub(crate) fn sign(self, axis: usize) -> i64 {
        match (self.swaps(), axis) {
            (false, 0) => self.xx,
            (false, _) => self.yy,
            (true, 0) => self.yx,
            (true, _) => self.xy,
        }
    }
}

fn transformed<N: Notation>(
    sheet: &Sheet<'_, N>,
    [xx, xy, yx, yy]: [i64; 4],
) -> Result<Vec<TextEdit>, String> {
    let transform = Transform { xx, xy, yx, yy };
    let content = sheet.content()?;
    let mut rewrite = Rewrite::new();
    for row in 0..content.rows.len() {
        let new = N::transformed(sheet, content, row, transform);
        rewrite.rows.insert(row, vec![new]);
    }
    N::transform_words(sheet, transform, &mut rewrite)?;
    let first = content.rows.first();
    rewrite.start = first.map(|row| transform.of_node(row.from));
    rewrite.end = Some(transform.of_point(sheet.trace.end()));
    rewrite.edits(sheet, content)
}
