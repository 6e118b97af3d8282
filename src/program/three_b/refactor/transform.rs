//! Mirror and rotate a program about the origin of its frame: which is where it begins, where no header says otherwise.
//!
//! ```text
//! B5000B0B5000GXL1           B5000B0B5000GYL2
//! B5000B0B10000GYNR1    →    B0B5000B10000GXNR2      (a quarter turn counter-clockwise)
//! ```
//!
//! Every number of a block stays; axes, quadrants and directions change. So the path changes exactly, to the last µm.

use super::Refactoring;
use super::rewrite::{New, Rewrite};
use super::sheet::{Content, Row, Sheet};
use crate::geometry::{Arc, Point, Segment, Vector};
use crate::program::three_b::block::{Block, CountingAxis, Motion, Node, Quadrant};
use crate::program::three_b::encode::Encoded;
use crate::text::TextEdit;

pub const MIRROR_X: Refactoring = Refactoring {
    id: "refactor.rewrite.mirror.x",
    title: |_| "Mirror left and right (X to −X)".into(),
    rewrite: |sheet| {
        transformed(
            sheet,
            Transform {
                xx: -1,
                xy: 0,
                yx: 0,
                yy: 1,
            },
        )
    },
};
pub const MIRROR_Y: Refactoring = Refactoring {
    id: "refactor.rewrite.mirror.y",
    title: |_| "Mirror up and down (Y to −Y)".into(),
    rewrite: |sheet| {
        transformed(
            sheet,
            Transform {
                xx: 1,
                xy: 0,
                yx: 0,
                yy: -1,
            },
        )
    },
};
pub const ROTATE_LEFT: Refactoring = Refactoring {
    id: "refactor.rewrite.rotate.left",
    title: |_| "Rotate by 90° counter-clockwise".into(),
    rewrite: |sheet| {
        transformed(
            sheet,
            Transform {
                xx: 0,
                xy: -1,
                yx: 1,
                yy: 0,
            },
        )
    },
};
pub const ROTATE_RIGHT: Refactoring = Refactoring {
    id: "refactor.rewrite.rotate.right",
    title: |_| "Rotate by 90° clockwise".into(),
    rewrite: |sheet| {
        transformed(
            sheet,
            Transform {
                xx: 0,
                xy: 1,
                yx: -1,
                yy: 0,
            },
        )
    },
};
pub const ROTATE_HALF: Refactoring = Refactoring {
    id: "refactor.rewrite.rotate.half",
    title: |_| "Rotate by 180°".into(),
    rewrite: |sheet| {
        transformed(
            sheet,
            Transform {
                xx: -1,
                xy: 0,
                yx: 0,
                yy: -1,
            },
        )
    },
};

/// `x' = xx·x + xy·y`, `y' = yx·x + yy·y`, all of them 0, 1 or −1.
#[derive(Clone, Copy, Debug)]
struct Transform {
    xx: i64,
    xy: i64,
    yx: i64,
    yy: i64,
}

impl Transform {
    fn of_numbers(self, x: i64, y: i64) -> (i64, i64) {
        (self.xx * x + self.xy * y, self.yx * x + self.yy * y)
    }

    fn of_node(self, node: Node) -> Node {
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

    fn mirrors(self) -> bool {
        self.xx * self.yy - self.xy * self.yx < 0
    }

    fn of_segment(self, segment: &Segment) -> Segment {
        match segment {
            Segment::Line(line) => {
                Segment::line(self.of_point(line.start), self.of_point(line.end))
            }
            Segment::Arc(arc) => {
                let from_center = self.of_vector(arc.start - arc.center);
                Segment::Arc(Arc {
                    center: self.of_point(arc.center),
                    start: self.of_point(arc.start),
                    end: self.of_point(arc.end),
                    start_angle: from_center.y.atan2(from_center.x),
                    sweep: if self.mirrors() {
                        -arc.sweep
                    } else {
                        arc.sweep
                    },
                    radius: arc.radius,
                })
            }
        }
    }

    fn of_axis(self, axis: CountingAxis) -> CountingAxis {
        match axis {
            _ if self.xx != 0 => axis,
            CountingAxis::X => CountingAxis::Y,
            CountingAxis::Y => CountingAxis::X,
        }
    }

    fn of_block(self, block: &Block) -> Block {
        let signed = |quadrant: Quadrant| {
            let (sign_x, sign_y) = quadrant.signs();
            let (x, y) = match (block.x, block.y, block.motion, block.axis) {
                // A line that leaves both numbers out runs along its counting axis.
                (0, 0, Motion::Line(_), CountingAxis::X) => (block.j, 0),
                (0, 0, Motion::Line(_), CountingAxis::Y) => (0, block.j),
                (x, y, ..) => (x, y),
            };
            self.of_numbers(x * sign_x as i64, y * sign_y as i64)
        };
        let turned = |quadrant: Quadrant, counter_clockwise: bool| {
            let (x, y) = signed(quadrant);
            if counter_clockwise != self.mirrors() {
                Motion::CounterClockwise(Quadrant::counter_clockwise(x, y))
            } else {
                Motion::Clockwise(Quadrant::clockwise(x, y))
            }
        };
        let motion = match block.motion {
            Motion::Line(quadrant) => {
                let (x, y) = signed(quadrant);
                Motion::Line(Quadrant::counter_clockwise(x, y))
            }
            Motion::CounterClockwise(quadrant) => turned(quadrant, true),
            Motion::Clockwise(quadrant) => turned(quadrant, false),
        };
        let (x, y) = self.of_numbers(block.x, block.y);
        let axis = match motion {
            // A line at 45° counts by its quadrant.
            Motion::Line(Quadrant::First | Quadrant::Third) if x.abs() == y.abs() && x != 0 => {
                CountingAxis::Y
            }
            Motion::Line(_) if x.abs() == y.abs() && x != 0 => CountingAxis::X,
            _ => self.of_axis(block.axis),
        };
        Block {
            x: x.abs(),
            y: y.abs(),
            j: block.j,
            axis,
            motion,
        }
    }
}

fn transformed(sheet: &Sheet<'_>, transform: Transform) -> Result<Vec<TextEdit>, String> {
    let content: &Content = sheet.content()?;
    let nodes = content.nodes()?;
    let of_row = |(index, row): (usize, &Row)| {
        let (from, to) = nodes[index];
        let encoded = Encoded {
            block: transform.of_block(&row.block),
            from: transform.of_node(from),
            to: transform.of_node(to),
            piece: transform.of_segment(&content.piece_from(index, from)),
        };
        (
            index,
            vec![New {
                encoded,
                part: row.part,
                source: index,
                exact: true,
            }],
        )
    };
    let start = nodes.first().map(|(from, _)| transform.of_node(*from));
    let end = transform.of_point(sheet.trace.end());
    Rewrite {
        rows: content.rows.iter().enumerate().map(of_row).collect(),
        start,
        end,
    }
    .edits(sheet, content)
}
