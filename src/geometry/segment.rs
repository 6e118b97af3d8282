//! A segment of a contour: a line or an arc, with a direction of travel.

use super::{Arc, Bounds, Point, Vector};

/// A straight line from `start` to `end`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    pub start: Point,
    pub end: Point,
}

impl Line {
    pub(crate) fn length(&self) -> f64 {
        (self.end - self.start).norm()
    }

    /// Unit direction of travel; zero for a line without length.
    pub(crate) fn direction(&self) -> Vector {
        (self.end - self.start)
            .try_normalize(0.0)
            .unwrap_or_else(Vector::zeros)
    }

    /// Share (0 … 1, unclamped) of the foot of the perpendicular from `point`; 0 for a line without length.
    pub(crate) fn share_of(&self, point: Point) -> f64 {
        let along = self.end - self.start;
        let squared = along.norm_squared();
        if squared == 0.0 {
            0.0
        } else {
            (point - self.start).dot(&along) / squared
        }
    }

    pub(crate) fn distance_to(&self, point: Point) -> f64 {
        let share = self.share_of(point).clamp(0.0, 1.0);
        (point - (self.start + (self.end - self.start) * share)).norm()
    }
}

/// One piece of a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    Line(Line),
    Arc(Arc),
}

impl Segment {
    pub fn line(start: Point, end: Point) -> Segment {
        Segment::Line(Line { start, end })
    }

    /// The segment of a polyline from `start` to `end` with `bulge`; a line where the bulge makes no arc.
    pub fn from_bulge(start: Point, end: Point, bulge: f64) -> Segment {
        match Arc::from_bulge(start, end, bulge) {
            Some(arc) => Segment::Arc(arc),
            None => Segment::line(start, end),
        }
    }

    /// The same segment, a line where it is an arc that rises less than `flat` above its chord: see
    /// [`Tolerances::flat`].
    ///
    /// All segments of a drawing go through this, so that reader, rules, fixes and paths agree. A full turn stays one.
    ///
    /// [`Tolerances::flat`]: super::Tolerances::flat
    pub(crate) fn straightened(self, flat: f64) -> Segment {
        match self {
            Segment::Arc(arc) if !arc.is_full_turn() && arc.sagitta() < flat => {
                Segment::line(arc.start, arc.end)
            }
            segment => segment,
        }
    }

    pub fn start(&self) -> Point {
        match self {
            Segment::Line(line) => line.start,
            Segment::Arc(arc) => arc.start,
        }
    }

    pub fn end(&self) -> Point {
        match self {
            Segment::Line(line) => line.end,
            Segment::Arc(arc) => arc.end,
        }
    }

    pub fn as_arc(&self) -> Option<&Arc> {
        match self {
            Segment::Arc(arc) => Some(arc),
            Segment::Line(_) => None,
        }
    }

    pub fn length(&self) -> f64 {
        match self {
            Segment::Line(line) => line.length(),
            Segment::Arc(arc) => arc.length(),
        }
    }

    /// `tan(sweep / 4)`, 0 for a line.
    pub fn bulge(&self) -> f64 {
        self.as_arc().map_or(0.0, Arc::bulge)
    }

    pub(crate) fn reversed(&self) -> Segment {
        match self {
            Segment::Line(line) => Segment::line(line.end, line.start),
            Segment::Arc(arc) => Segment::Arc(arc.reversed()),
        }
    }

    /// The same segment, moved.
    pub fn moved(&self, by: Vector) -> Segment {
        match self {
            Segment::Line(line) => Segment::line(line.start + by, line.end + by),
            Segment::Arc(arc) => Segment::Arc(Arc {
                center: arc.center + by,
                start: arc.start + by,
                end: arc.end + by,
                ..*arc
            }),
        }
    }

    /// The point at `share` (0 … 1) of the length.
    pub fn point_at(&self, share: f64) -> Point {
        match self {
            Segment::Line(line) => line.start + (line.end - line.start) * share,
            Segment::Arc(arc) => arc.point_at(share),
        }
    }

    /// Unit tangent in the direction of travel; zero where a line has no length.
    pub fn tangent_at(&self, share: f64) -> Vector {
        match self {
            Segment::Line(line) => line.direction(),
            Segment::Arc(arc) => arc.tangent_at(share),
        }
    }

    pub fn start_tangent(&self) -> Vector {
        self.tangent_at(0.0)
    }

    pub fn end_tangent(&self) -> Vector {
        self.tangent_at(1.0)
    }

    /// Share (0 … 1, unclamped) of the place on the segment's line or circle that is nearest to `point`.
    pub fn share_of(&self, point: Point) -> f64 {
        match self {
            Segment::Line(line) => line.share_of(point),
            Segment::Arc(arc) => arc.share_of(point),
        }
    }

    /// True where the place on the segment's line or circle that is nearest to `point` lies on the segment.
    pub(crate) fn spans(&self, point: Point) -> bool {
        match self {
            Segment::Line(line) => (0.0..=1.0).contains(&line.share_of(point)),
            Segment::Arc(arc) => arc.spans(point),
        }
    }

    /// Smallest distance from `point` to the segment.
    pub fn distance_to(&self, point: Point) -> f64 {
        match self {
            Segment::Line(line) => line.distance_to(point),
            Segment::Arc(arc) => arc.distance_to(point),
        }
    }

    pub(crate) fn bounds(&self) -> Bounds {
        match self {
            Segment::Line(line) => Bounds::of_points(&[line.start, line.end]),
            Segment::Arc(arc) => arc.bounds(),
        }
    }

    /// The segment's share of twice the signed area of a closed contour, relative to `origin`: the shoelace term of its
    /// chord and, for an arc, the area between chord and arc.
    pub fn twice_area(&self, origin: Point) -> f64 {
        let chord = super::cross(self.start() - origin, self.end() - origin);
        chord + self.as_arc().map_or(0.0, Arc::twice_cap_area)
    }

    /// The part of the segment between two shares of it, 0 ≤ `from` ≤ `to` ≤ 1.
    pub fn part(&self, from: f64, to: f64) -> Segment {
        match self {
            Segment::Line(_) => Segment::line(self.point_at(from), self.point_at(to)),
            Segment::Arc(arc) => Segment::Arc(Arc {
                start_angle: arc.start_angle + arc.sweep * from,
                sweep: arc.sweep * (to - from),
                start: self.point_at(from),
                end: self.point_at(to),
                ..*arc
            }),
        }
    }
}
