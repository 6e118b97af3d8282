//! Random outlines for properties: stars whose edges may bend and whose corners are rounded in many ways.

use proptest::prelude::*;
use wedm::drawing::Vertex;
use wedm::geometry::{Point, Segment};

/// How a corner of the outline is rounded.
#[derive(Clone, Copy, Debug)]
pub enum Corner {
    Sharp,
    /// An arc between two points at these distances from the corner, of any bulge: fillets, notches, bulbs.
    Arc {
        before: f64,
        after: f64,
        bulge: f64,
    },
    /// Two arcs in a row.
    Arcs {
        before: f64,
        after: f64,
        bulge: f64,
        middle: f64,
    },
    /// A tangent fillet where the neighbours are lines.
    Fillet {
        length: f64,
    },
}

/// A star-shaped outline: corners by angle step and radius, the bulge of each edge, the form of each corner.
#[derive(Clone, Debug)]
pub struct Star {
    pub corners: Vec<(f64, f64, f64, Corner)>,
    pub clockwise: bool,
}

fn corner() -> impl Strategy<Value = Corner> {
    let distance = || 0.02..0.5f64;
    prop_oneof![
        1 => Just(Corner::Sharp),
        4 => (distance(), distance(), -1.2..1.2f64).prop_map(|(before, after, bulge)| Corner::Arc { before, after, bulge }),
        1 => (distance(), distance(), -0.9..0.9f64, 0.3..0.7f64)
            .prop_map(|(before, after, bulge, middle)| Corner::Arcs { before, after, bulge, middle }),
        4 => (0.01..0.6f64).prop_map(|length| Corner::Fillet { length }),
    ]
}

pub fn star() -> impl Strategy<Value = Star> {
    let edge = prop_oneof![3 => Just(0.0), 1 => -0.12..0.12f64];
    (
        proptest::collection::vec((0.6..1.4f64, 2.0..5.0f64, edge, corner()), 4..9),
        any::<bool>(),
    )
        .prop_map(|(corners, clockwise)| Star { corners, clockwise })
}

impl Star {
    pub fn vertices(&self) -> Vec<Vertex> {
        let whole: f64 = self.corners.iter().map(|corner| corner.0).sum();
        let mut angle = 0.0;
        let mut points = Vec::new();
        for &(step, radius, ..) in &self.corners {
            points.push(Point::new(
                radius * f64::cos(angle),
                radius * f64::sin(angle),
            ));
            angle += step / whole * std::f64::consts::TAU;
        }
        let count = points.len();
        let edge =
            |i: usize| Segment::from_bulge(points[i], points[(i + 1) % count], self.corners[i].2);
        let mut vertices = Vec::new();
        for (i, &corner_at) in points.iter().enumerate() {
            let (incoming, outgoing) = (edge((i + count - 1) % count), edge(i));
            let share = |segment: &Segment, distance: f64| (distance / segment.length()).min(0.4);
            let next_start = |distance: f64| outgoing.point_at(share(&outgoing, distance));
            let last_end = |distance: f64| incoming.point_at(1.0 - share(&incoming, distance));
            let turned = wedm::geometry::turn(incoming.end_tangent(), outgoing.start_tangent());
            let mut push = |point: Point, bulge: f64| vertices.push(Vertex { point, bulge });
            let leave = match self.corners[i].3 {
                Corner::Sharp => corner_at,
                Corner::Arc {
                    before,
                    after,
                    bulge,
                } => {
                    push(last_end(before), bulge);
                    next_start(after)
                }
                Corner::Arcs {
                    before,
                    after,
                    bulge,
                    middle,
                } => {
                    let (from, to) = (last_end(before), next_start(after));
                    let whole = Segment::from_bulge(from, to, bulge);
                    push(from, (bulge.atan() * middle).tan());
                    push(
                        whole.point_at(middle),
                        (bulge.atan() * (1.0 - middle)).tan() * 1.3,
                    );
                    to
                }
                Corner::Fillet { length } => {
                    let length = length
                        .min(0.4 * incoming.length())
                        .min(0.4 * outgoing.length());
                    push(last_end(length), (turned / 4.0).tan());
                    next_start(length)
                }
            };
            // The edge that leaves the corner, cut back at both ends, keeps its curve.
            let cut_at_end = match self.corners[(i + 1) % count].3 {
                Corner::Sharp => 0.0,
                Corner::Arc { before, .. } | Corner::Arcs { before, .. } => before,
                Corner::Fillet { length } => length
                    .min(0.4 * outgoing.length())
                    .min(0.4 * edge((i + 1) % count).length()),
            };
            let end = outgoing.point_at(1.0 - share(&outgoing, cut_at_end));
            let bulge = match outgoing {
                Segment::Arc(arc) => {
                    (arc.sweep * (arc.share_of(end) - arc.share_of(leave)) / 4.0).tan()
                }
                Segment::Line(_) => 0.0,
            };
            push(leave, bulge);
        }
        if self.clockwise {
            let bulges: Vec<f64> = vertices.iter().map(|vertex| -vertex.bulge).collect();
            vertices.reverse();
            let count = vertices.len();
            for (i, vertex) in vertices.iter_mut().enumerate() {
                vertex.bulge = bulges[(2 * count - 2 - i) % count];
            }
        }
        vertices
    }
}
