//! Joining the offsets of neighbouring walls to one closed path.
//!
//! Where the offsets touch they pass into each other; at a convex corner the wire rolls about the vertex or runs to the tip; at a
//! concave corner the two are cut where they meet. What is used up by that is left out and its neighbours are cut with each other.
//! Whether the whole path is then sound is for `clearance` to say.

use super::Source;
use super::offset::{Offset, Wall, normal, offset};
use crate::geometry::{Arc, Point, Segment, circle_circle, line_circle, line_line, turn};
use crate::settings::Corner;
use std::f64::consts::PI;

/// A piece of the closed path and the wall it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    pub geometry: Segment,
    pub source: Source,
    /// Index of the wall; of the one before it, for the way round a corner.
    pub wall: usize,
}

/// How the corners are made. Lengths in drawing units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joining {
    pub correction: f64,
    /// +1 where the wire runs to the left of the walls, −1 to the right.
    pub side: f64,
    pub corner: Corner,
    /// Offsets whose ends lie closer than this pass into each other.
    pub touch: f64,
    /// How far a radius may lie below the correction by rounding.
    pub tolerance: f64,
}

/// An extended corner reaches at most this many corrections from its vertex; beyond, the wire rolls about it.
const LONGEST_TIP: f64 = 4.0;

/// What is behind an element.
#[derive(Clone, Copy, Debug)]
enum Joint {
    At(Point),
    /// The two elements meet where their lines or circles cross, nearest to this point.
    CrossNear(Point),
}

/// The path round closed `walls`, in their order; where it cannot be closed, the place.
pub(super) fn closed_path(walls: &[Wall], joining: &Joining) -> Result<Vec<Element>, Point> {
    let mut ring = Ring::default();
    for (index, wall) in walls.iter().enumerate() {
        let (geometry, tight) = match offset(&wall.geometry, joining.correction, joining.side, joining.tolerance) {
            Offset::Runs(geometry) => (geometry, None),
            Offset::TooTight { center } => (Segment::line(center, center), Some(center)),
        };
        if let [only] = walls
            && only.geometry.as_arc().is_some_and(Arc::is_full_turn)
        {
            let element = Element { geometry, source: wall.source, wall: index };
            return if geometry.length() > 0.0 { Ok(vec![element]) } else { Err(wall.geometry.start()) };
        }
        let next = &walls[(index + 1) % walls.len()].geometry;
        let corner = corner(&wall.geometry, next, joining);
        let element = Element { geometry, source: wall.source, wall: index };
        match corner {
            Way::Through(joint) => ring.push(element, joint, tight),
            Way::Roll(arc) => {
                let source = match wall.source {
                    Source::Segment { entity, segment } => Source::Corner { entity, segment },
                    other => other,
                };
                ring.push(element, Joint::At(arc.start), tight);
                ring.push(Element { geometry: Segment::Arc(arc), source, wall: index }, Joint::At(arc.end), None);
            }
        }
    }
    ring.resolve().ok_or_else(|| walls.first().map_or_else(Point::origin, |wall| wall.geometry.start()))
}

/// How the path goes from one offset to the next.
enum Way {
    Through(Joint),
    Roll(Arc),
}

fn corner(wall: &Segment, next: &Segment, joining: &Joining) -> Way {
    let Joining { correction, side, .. } = *joining;
    let vertex = wall.end();
    let from = vertex + normal(wall, 1.0, side) * correction;
    let to = vertex + normal(next, 0.0, side) * correction;
    if (from - to).norm() <= joining.touch {
        return Way::Through(Joint::At(from + (to - from) * 0.5));
    }
    let turned = turn(wall.end_tangent(), next.start_tangent());
    // A contour that turns right back is taken as a spike of the part.
    if turned * side > 0.0 && turned.abs() < PI - 1e-9 {
        return Way::Through(Joint::CrossNear(from + (to - from) * 0.5));
    }
    if joining.corner == Corner::Intersection
        && let Some(tip) = tip(wall, next, joining)
    {
        return Way::Through(Joint::At(tip));
    }
    Way::Roll(Arc { radius: correction, ..Arc::about(vertex, from, to, side < 0.0) })
}

/// Where the two offsets meet when both are extended beyond a convex corner; `None` when they do not, or too far out.
fn tip(wall: &Segment, next: &Segment, joining: &Joining) -> Option<Point> {
    let runs = |segment: &Segment| match offset(segment, joining.correction, joining.side, joining.tolerance) {
        Offset::Runs(geometry) if geometry.length() > 0.0 => Some(geometry),
        _ => None,
    };
    let (before, after) = (runs(wall)?, runs(next)?);
    let vertex = wall.end();
    meetings(&before, &after)
        .into_iter()
        .filter(|&tip| {
            (tip - before.end()).dot(&before.end_tangent()) > 0.0
                && (tip - after.start()).dot(&after.start_tangent()) < 0.0
                && (tip - vertex).norm() <= LONGEST_TIP * joining.correction
        })
        .min_by(|a, b| (a - vertex).norm().total_cmp(&(b - vertex).norm()))
}

/// Where the lines or circles that carry two segments meet.
fn meetings(a: &Segment, b: &Segment) -> Vec<Point> {
    match (a, b) {
        (Segment::Line(a), Segment::Line(b)) => line_line(a.start, a.end - a.start, b.start, b.end - b.start).into_iter().collect(),
        (Segment::Line(line), Segment::Arc(arc)) | (Segment::Arc(arc), Segment::Line(line)) => {
            line_circle(line.start, line.end - line.start, arc.center, arc.radius)
        }
        (Segment::Arc(a), Segment::Arc(b)) => circle_circle(a.center, a.radius, b.center, b.radius),
    }
}

/// The elements round a contour, from which what is used up is taken out.
#[derive(Default)]
struct Ring {
    elements: Vec<Element>,
    /// Behind each element.
    joints: Vec<Joint>,
    /// Elements that the wire's centre cannot follow at all, with the place that stands for them.
    tight: Vec<(usize, Point)>,
    before: Vec<usize>,
    after: Vec<usize>,
    alive: Vec<bool>,
    count: usize,
}

impl Ring {
    fn push(&mut self, element: Element, joint: Joint, tight: Option<Point>) {
        if let Some(center) = tight {
            self.tight.push((self.elements.len(), center));
        }
        self.elements.push(element);
        self.joints.push(joint);
    }

    /// Takes out what is used up until every element runs forward; `None` when nothing is left or neighbours do not meet.
    fn resolve(mut self) -> Option<Vec<Element>> {
        self.count = self.elements.len();
        if self.count < 2 {
            return None;
        }
        self.before = (0..self.count).map(|index| (index + self.count - 1) % self.count).collect();
        self.after = (0..self.count).map(|index| (index + 1) % self.count).collect();
        self.alive = vec![true; self.count];
        for (index, center) in std::mem::take(&mut self.tight) {
            self.remove(index, center)?;
        }
        let mut waiting: Vec<usize> = (0..self.elements.len()).rev().collect();
        while let Some(index) = waiting.pop() {
            if !self.alive[index] {
                continue;
            }
            let gone = match (self.settle(self.before[index]), self.settle(index)) {
                (Err(shorter), _) | (_, Err(shorter)) => shorter,
                (Ok(start), Ok(end)) if self.runs_backwards(index, start, end) => index,
                _ => continue,
            };
            let near = self.elements[gone].geometry.point_at(0.5);
            let (before, after) = (self.before[gone], self.after[gone]);
            self.remove(gone, near)?;
            waiting.extend([after, before, index]);
        }
        self.trimmed()
    }

    fn remove(&mut self, index: usize, near: Point) -> Option<()> {
        let (before, after) = (self.before[index], self.after[index]);
        self.alive[index] = false;
        self.count -= 1;
        self.after[before] = after;
        self.before[after] = before;
        self.joints[before] = Joint::CrossNear(near);
        (self.count >= 2).then_some(())
    }

    /// The point behind element `index`; where the two do not meet, the shorter one.
    fn settle(&mut self, index: usize) -> Result<Point, usize> {
        let near = match self.joints[index] {
            Joint::At(point) => return Ok(point),
            Joint::CrossNear(near) => near,
        };
        let next = self.after[index];
        let (a, b) = (&self.elements[index].geometry, &self.elements[next].geometry);
        let shorter = if a.length() < b.length() { index } else { next };
        let rank = |point: &Point| {
            let beside = [a, b].iter().any(|segment| !(-1e-9..=1.0 + 1e-9).contains(&segment.share_of(*point)));
            (beside, (point - near).norm())
        };
        let best = meetings(a, b).into_iter().min_by(|p, q| {
            let ((p_beside, p_away), (q_beside, q_away)) = (rank(p), rank(q));
            p_beside.cmp(&q_beside).then(p_away.total_cmp(&q_away))
        });
        let point = best.filter(|point| point.x.is_finite() && point.y.is_finite()).ok_or(shorter)?;
        self.joints[index] = Joint::At(point);
        Ok(point)
    }

    fn runs_backwards(&self, index: usize, start: Point, end: Point) -> bool {
        let geometry = &self.elements[index].geometry;
        let length = geometry.length();
        length > 0.0 && (geometry.share_of(end) - geometry.share_of(start)) * length < -1e-9
    }

    fn trimmed(mut self) -> Option<Vec<Element>> {
        let first = self.alive.iter().position(|&alive| alive)?;
        let mut path = Vec::with_capacity(self.count);
        let mut index = first;
        loop {
            let start = self.settle(self.before[index]).ok()?;
            let end = self.settle(index).ok()?;
            let element = self.elements[index];
            let geometry = between(&element.geometry, start, end);
            if geometry.length() > 1e-9 {
                path.push(Element { geometry, ..element });
            } else if let Some(last) = path.last_mut() {
                // A point of the path: what follows begins where it stands, so nothing is left between.
                close_up(last, end);
            }
            index = self.after[index];
            if index == first {
                break;
            }
        }
        if let (Some(head), Some(last)) = (path.first().map(|first| first.geometry.start()), path.last_mut()) {
            close_up(last, head);
        }
        (path.len() >= 2).then_some(path)
    }
}

/// Lets an element end in a point that lies within rounding of its end.
fn close_up(element: &mut Element, end: Point) {
    match &mut element.geometry {
        Segment::Line(line) => line.end = end,
        Segment::Arc(arc) => arc.end = end,
    }
}

/// The part of a segment, or of what carries it, from `start` to `end`.
pub(super) fn between(segment: &Segment, start: Point, end: Point) -> Segment {
    match segment {
        Segment::Line(_) => Segment::line(start, end),
        Segment::Arc(arc) => {
            let (from, to) = (arc.share_of(start), arc.share_of(end));
            Segment::Arc(Arc { start_angle: arc.start_angle + arc.sweep * from, sweep: arc.sweep * (to - from), start, end, ..*arc })
        }
    }
}
