//! Lines and circles: those that carry segments, and those on which the centre of a disc may lie that touches something.

use super::intersection::Meetings;
use super::{Arc, Point, Segment, Vector, circle_circle, left_normal, line_circle, line_line};
use std::f64::consts::PI;

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

/// Where two segments that follow each other meet once each has been made longer or shorter, on its own line or circle, by no
/// more than their ends are apart. `None` also where that is much of a segment, or an arc goes nearly all round.
pub(crate) fn corner_between(before: &Segment, behind: &Segment) -> Option<Point> {
    let (end, start) = (before.end(), behind.start());
    let reach = (start - end).norm();
    let has_room = |segment: &Segment| {
        let is_open = segment
            .as_arc()
            .is_none_or(|arc| arc.sweep.abs() < 1.9 * PI);
        is_open && segment.length() > 2.0 * reach
    };
    if !has_room(before) || !has_room(behind) {
        return None;
    }
    let farther = |corner: &Point| (corner - end).norm().max((corner - start).norm());
    let corners = Locus::of(before).meet(&Locus::of(behind));
    let nearest =
        (corners.into_iter()).min_by(|one, other| farther(one).total_cmp(&farther(other)));
    nearest.filter(|corner| farther(corner) <= reach)
}

/// A segment with its end (or, with `at_end` false, its start) at another point of its line or circle.
pub(crate) fn led_to(segment: &Segment, at_end: bool, to: Point) -> Segment {
    let (start, end) = match at_end {
        true => (segment.start(), to),
        false => (to, segment.end()),
    };
    match segment {
        Segment::Line(_) => Segment::line(start, end),
        Segment::Arc(arc) => Segment::Arc(Arc::about(arc.center, start, end, arc.sweep > 0.0)),
    }
}
