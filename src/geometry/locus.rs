//! Lines and circles: those that carry segments, and those on which the centre of a disc may lie that touches something.

use super::intersection::Meetings;
use super::{Point, Segment, Vector, circle_circle, left_normal, line_circle, line_line};

#[derive(Clone, Copy, Debug)]
pub(crate) enum Locus {
    Line { point: Point, direction: Vector },
    Circle { center: Point, radius: f64 },
}

impl Locus {
    /// The line or circle that carries a segment.
    pub(crate) fn of(segment: &Segment) -> Locus {
        match segment {
            Segment::Line(line) => Locus::Line {
                point: line.start,
                direction: line.end - line.start,
            },
            Segment::Arc(arc) => Locus::about(arc.center, arc.radius),
        }
    }

    /// The locus for discs of `radius` that touch the line or circle of a segment, on its left where `side` is +1, on
    /// its right where it is −1. `None` for a line no longer than `zero_length`, and inside an arc that is no larger
    /// than the disc.
    pub(crate) fn beside(
        segment: &Segment,
        side: f64,
        radius: f64,
        zero_length: f64,
    ) -> Option<Locus> {
        match segment {
            Segment::Line(line) => {
                let direction = line.direction();
                let point = line.start + left_normal(direction) * (radius * side);
                (line.length() > zero_length).then_some(Locus::Line { point, direction })
            }
            Segment::Arc(arc) if arc.sweep * side > 0.0 => {
                (arc.radius > radius).then_some(Locus::Circle {
                    center: arc.center,
                    radius: arc.radius - radius,
                })
            }
            Segment::Arc(arc) => Some(Locus::Circle {
                center: arc.center,
                radius: arc.radius + radius,
            }),
        }
    }

    /// The locus for discs of `radius` with `point` on their edge.
    pub(crate) fn about(point: Point, radius: f64) -> Locus {
        Locus::Circle {
            center: point,
            radius,
        }
    }

    /// The points that lie on both.
    pub(crate) fn meet(&self, other: &Locus) -> Meetings {
        match (self, other) {
            (
                Locus::Line {
                    point: p,
                    direction: u,
                },
                Locus::Line {
                    point: q,
                    direction: v,
                },
            ) => line_line(*p, *u, *q, *v).into_iter().collect(),
            (Locus::Line { point, direction }, Locus::Circle { center, radius })
            | (Locus::Circle { center, radius }, Locus::Line { point, direction }) => {
                line_circle(*point, *direction, *center, *radius)
            }
            (
                Locus::Circle {
                    center: a,
                    radius: ra,
                },
                Locus::Circle {
                    center: b,
                    radius: rb,
                },
            ) => circle_circle(*a, *ra, *b, *rb),
        }
    }
}
