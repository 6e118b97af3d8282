//! Joining the offsets of neighbouring walls to one closed path.
//!
//! Where the offsets touch they pass into each other; at a convex corner the wire rolls about the vertex; at a concave corner the
//! two are cut where they meet. What is used up by that is left out and its neighbours are cut with each other. That is quick, and
//! right on most contours: `proof` says whether it is, and `loops` finds the path where it is not. `tips` in place of rolls come last.

use super::cores::{each, each_two};
use super::offset::{Offset, Wall, offset};
use super::path::Source;
use crate::geometry::{
    Arc, Few, Point, Segment, Vector, circle_circle, cross, left_normal, line_circle, line_line,
};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// One core takes so many elements at a time.
const AT_A_TIME: usize = 2048;

/// A piece of the closed path and the wall it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    pub(crate) geometry: Segment,
    pub(crate) source: Source,
    /// Index of the wall; of the one before it, for the way round a corner.
    pub(crate) wall: usize,
}

/// The walls themselves as a path.
pub(super) fn elements(walls: &[Wall]) -> Vec<Element> {
    let element = |(wall, of): (usize, &Wall)| Element {
        geometry: of.geometry,
        source: of.source,
        wall,
    };
    walls.iter().enumerate().map(element).collect()
}

/// How the corners are made. Lengths in drawing units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joining {
    pub(crate) correction: f64,
    /// +1 where the wire runs to the left of the walls, −1 to the right.
    pub(crate) side: f64,
    /// Offsets whose ends lie closer than this pass into each other.
    pub(crate) touch: f64,
    /// How far a radius may lie below the correction by rounding.
    pub(crate) tolerance: f64,
}

/// What is behind an element.
#[derive(Clone, Copy, Debug)]
pub(super) enum Joint {
    At(Point),
    /// The two elements meet where their lines or circles cross, nearest to this point.
    CrossNear(Point),
}

/// The offsets of all walls and the ways round their convex corners in the order of the contour, before anything is cut.
pub(super) struct Raw {
    /// Those that the wire's centre cannot follow at all are points.
    pub(crate) elements: Vec<Element>,
    /// Behind each element.
    joints: Vec<Joint>,
    /// Elements that the wire's centre cannot follow, with the place that stands for them.
    tight: Vec<(usize, Point)>,
}

impl Raw {
    /// `tangents` are those of each wall at its ends.
    pub(crate) fn new(walls: &[Wall], tangents: &[[Vector; 2]], joining: &Joining) -> Raw {
        let way = |wall: usize| {
            let behind = if wall + 1 == walls.len() { 0 } else { wall + 1 };
            let turn = [tangents[wall][1], tangents[behind][0]];
            corner(walls[wall].geometry.end(), turn, joining)
        };
        let shifted = |wall: usize| {
            let geometry = &walls[wall].geometry;
            offset(
                geometry,
                joining.correction,
                joining.side,
                joining.tolerance,
            )
        };
        let rolls = each(walls.len(), AT_A_TIME, |wall| {
            matches!(way(wall), Way::Roll(_))
        });
        // Of each element its wall, and whether it leads round the end of that.
        let mut of = Vec::with_capacity(2 * walls.len());
        for (wall, &is_roll) in rolls.iter().enumerate() {
            of.push((wall as u32, false));
            if is_roll {
                of.push((wall as u32, true));
            }
        }
        let is_any_tight = AtomicBool::new(false);
        let element = |at: usize| {
            let (index, is_roll) = (of[at].0 as usize, of[at].1);
            let wall = &walls[index];
            let (geometry, source, joint) = match (way(index), is_roll) {
                (Way::Roll([from, to]), true) => {
                    let arc = Arc::about(wall.geometry.end(), from, to, joining.side < 0.0);
                    let arc = Arc {
                        radius: joining.correction,
                        ..arc
                    };
                    let source = match wall.source {
                        Source::Segment { entity, segment } => Source::Corner { entity, segment },
                        other => other,
                    };
                    (Segment::Arc(arc), source, Joint::At(to))
                }
                (way, _) => {
                    let geometry = match shifted(index) {
                        Offset::Runs(geometry) => geometry,
                        Offset::TooTight { center } => {
                            is_any_tight.store(true, Relaxed);
                            Segment::line(center, center)
                        }
                    };
                    let joint = match way {
                        Way::Through(joint) => joint,
                        Way::Roll([from, _]) => Joint::At(from),
                    };
                    (geometry, wall.source, joint)
                }
            };
            let element = Element {
                geometry,
                source,
                wall: index,
            };
            (element, joint)
        };
        let (elements, joints) = each_two(of.len(), AT_A_TIME, element);
        let tight = |(at, &(wall, is_roll)): (usize, &(u32, bool))| match shifted(wall as usize) {
            Offset::TooTight { center } if !is_roll => Some((at, center)),
            _ => None,
        };
        let tight = match is_any_tight.into_inner() {
            true => of.iter().enumerate().filter_map(tight).collect(),
            false => Vec::new(),
        };
        Raw {
            elements,
            joints,
            tight,
        }
    }

    /// Of an open contour that is gone there and back, so many walls either way: the element that leads round its end. Those before it
    /// lie on the side of the wire.
    pub(crate) fn end_roll(&self, walls: usize) -> usize {
        self.elements
            .partition_point(|element| element.wall < walls)
            .saturating_sub(1)
    }

    /// The path that is left where neighbours are cut with each other and what they use up goes, each piece with the index of the
    /// element that it is of. Right wherever corners do not reach past their neighbours; whether it is, `proof` says. `None`
    /// where nothing is left or neighbours do not meet.
    pub(crate) fn trimmed(&self) -> Option<Vec<(usize, Element)>> {
        Ring::new(self).resolve()
    }
}

/// How the path goes from one offset to the next.
pub(super) enum Way {
    Through(Joint),
    /// About the vertex from one place to another, in the sense that leaves the contour on its side.
    Roll([Point; 2]),
}

/// The way round a vertex, from one direction into another.
pub(super) fn corner(vertex: Point, [before, behind]: [Vector; 2], joining: &Joining) -> Way {
    let Joining {
        correction, side, ..
    } = *joining;
    let from = vertex + left_normal(before) * (side * correction);
    let to = vertex + left_normal(behind) * (side * correction);
    if (from - to).norm() <= joining.touch {
        return Way::Through(Joint::At(from + (to - from) * 0.5));
    }
    let turned = cross(before, behind);
    // A contour that turns right back is taken as a spike of the part.
    if turned * side > 0.0 && (turned.abs() > 1e-9 || before.dot(&behind) > 0.0) {
        return Way::Through(Joint::CrossNear(from + (to - from) * 0.5));
    }
    Way::Roll([from, to])
}

/// Where the lines or circles that carry two segments meet.
pub(super) fn meetings(a: &Segment, b: &Segment) -> Few<Point, 2> {
    let met: Few<Point, 2> = match (a, b) {
        (Segment::Line(a), Segment::Line(b)) => {
            return line_line(a.start, a.end - a.start, b.start, b.end - b.start)
                .into_iter()
                .collect();
        }
        (Segment::Line(line), Segment::Arc(arc)) | (Segment::Arc(arc), Segment::Line(line)) => {
            line_circle(line.start, line.end - line.start, arc.center, arc.radius)
        }
        (Segment::Arc(a), Segment::Arc(b)) => circle_circle(a.center, a.radius, b.center, b.radius),
    };
    met.into_iter()
        .map(|point| nearer_to_both(a, b, point))
        .collect()
}

/// A meeting of two carriers, one step nearer to both: about a centre that is far away, rounding shows.
fn nearer_to_both(a: &Segment, b: &Segment, point: Point) -> Point {
    let off = |segment: &Segment| match segment {
        Segment::Line(line) => {
            let normal = left_normal(line.direction());
            (normal.dot(&(point - line.start)), normal)
        }
        Segment::Arc(arc) => (
            arc.rise_of(point),
            (point - arc.center)
                .try_normalize(0.0)
                .unwrap_or_else(Vector::zeros),
        ),
    };
    let ((from_a, normal_a), (from_b, normal_b)) = (off(a), off(b));
    let between = cross(normal_a, normal_b);
    if between.abs() < 1e-3 {
        // Where the two touch, a step across both says nothing.
        return point;
    }
    point - (left_normal(normal_a) * from_b - left_normal(normal_b) * from_a) / between
}

/// The elements round a contour, from which what is used up is taken out.
struct Ring<'a> {
    elements: &'a [Element],
    /// Behind each element.
    joints: Vec<Joint>,
    /// Elements that the wire's centre cannot follow at all, with the place that stands for them.
    tight: &'a [(usize, Point)],
    before: Vec<u32>,
    after: Vec<u32>,
    alive: Vec<bool>,
    count: usize,
}

impl Ring<'_> {
    fn new(raw: &Raw) -> Ring<'_> {
        let count = raw.elements.len();
        let last = count.saturating_sub(1) as u32;
        Ring {
            elements: &raw.elements,
            joints: raw.joints.clone(),
            tight: &raw.tight,
            before: std::iter::once(last).chain(0..last).collect(),
            after: (1..=last).chain([0]).collect(),
            alive: vec![true; count],
            count,
        }
    }

    fn before(&self, index: usize) -> usize {
        self.before[index] as usize
    }

    fn after(&self, index: usize) -> usize {
        self.after[index] as usize
    }

    /// Takes out what is used up until every element runs forward; `None` when nothing is left or neighbours do not meet.
    fn resolve(mut self) -> Option<Vec<(usize, Element)>> {
        if self.count < 2 {
            return None;
        }
        for &(index, center) in self.tight {
            self.remove(index, center)?;
        }
        self.settle_all();
        // What runs forward from the first is looked at again only beside what goes.
        let settled = |index: usize| match self.joints[index] {
            Joint::At(point) => Some(point),
            Joint::CrossNear(_) => None,
        };
        let runs_forward = |index: usize| {
            let ends = settled(self.before(index)).zip(settled(index));
            ends.is_some_and(|(start, end)| !self.runs_backwards(index, start, end))
        };
        let is_fine = each(self.elements.len(), AT_A_TIME, |index| {
            !self.alive[index] || runs_forward(index)
        });
        let waiting = (0..self.elements.len()).rev();
        let mut waiting: Vec<usize> = waiting.filter(|&index| !is_fine[index]).collect();
        while let Some(index) = waiting.pop() {
            if !self.alive[index] {
                continue;
            }
            let gone = match (self.settle(self.before(index)), self.settle(index)) {
                (Err(shorter), _) | (_, Err(shorter)) => shorter,
                (Ok(start), Ok(end)) if self.runs_backwards(index, start, end) => index,
                _ => continue,
            };
            let near = self.elements[gone].geometry.point_at(0.5);
            let (before, after) = (self.before(gone), self.after(gone));
            self.remove(gone, near)?;
            waiting.extend([after, before, index]);
        }
        self.trimmed()
    }

    fn remove(&mut self, index: usize, near: Point) -> Option<()> {
        let (before, after) = (self.before(index), self.after(index));
        self.alive[index] = false;
        self.count -= 1;
        self.after[before] = after as u32;
        self.before[after] = before as u32;
        self.joints[before] = Joint::CrossNear(near);
        (self.count >= 2).then_some(())
    }

    /// The points behind all elements, where they meet the next.
    fn settle_all(&mut self) {
        let Ring {
            elements,
            joints,
            after,
            alive,
            ..
        } = self;
        let joints = joints.par_iter_mut().with_min_len(AT_A_TIME).enumerate();
        joints.for_each(|(index, joint)| {
            if let Joint::CrossNear(near) = *joint
                && alive[index]
            {
                let next = &elements[after[index] as usize].geometry;
                if let Some(point) = meeting(&elements[index].geometry, next, near) {
                    *joint = Joint::At(point);
                }
            }
        });
    }

    /// The point behind element `index`; where the two do not meet, the shorter one.
    fn settle(&mut self, index: usize) -> Result<Point, usize> {
        let near = match self.joints[index] {
            Joint::At(point) => return Ok(point),
            Joint::CrossNear(near) => near,
        };
        let next = self.after(index);
        let (a, b) = (
            &self.elements[index].geometry,
            &self.elements[next].geometry,
        );
        let shorter = if a.length() < b.length() { index } else { next };
        let point = meeting(a, b, near).ok_or(shorter)?;
        self.joints[index] = Joint::At(point);
        Ok(point)
    }

    fn runs_backwards(&self, index: usize, start: Point, end: Point) -> bool {
        let geometry = &self.elements[index].geometry;
        if let Segment::Line(line) = geometry {
            let along = line.end - line.start;
            let forward = (end - start).dot(&along);
            return forward < 0.0 && forward * forward > 1e-18 * along.norm_squared();
        }
        let length = geometry.length();
        length > 0.0
            && !is_all_of(geometry, start, end)
            && !is_seen_forward(geometry, start, end)
            && (share_on(geometry, end) - share_on(geometry, start)) * length < -1e-9
    }

    fn trimmed(mut self) -> Option<Vec<(usize, Element)>> {
        let alive = 0..self.elements.len();
        let alive: Vec<usize> = alive.filter(|&index| self.alive[index]).collect();
        let ends: Option<Vec<Point>> = (alive.iter())
            .map(|&index| self.settle(index).ok())
            .collect();
        let ends = ends?;
        let is_any_point = AtomicBool::new(false);
        let piece = |at: usize| {
            let (index, start) = (alive[at], ends[if at == 0 { ends.len() } else { at } - 1]);
            let element = self.elements[index];
            let geometry = between(&element.geometry, start, ends[at]);
            let piece = Element {
                geometry,
                ..element
            };
            if is_point(&piece) {
                is_any_point.store(true, Relaxed);
            }
            (index, piece)
        };
        let mut path = each(alive.len(), AT_A_TIME, piece);
        if is_any_point.into_inner() {
            path = without_points(path);
        }
        if let (Some(head), Some((_, last))) = (
            path.first()
                .map(|(_, first): &(usize, Element)| first.geometry.start()),
            path.last_mut(),
        ) {
            close_up(last, head);
        }
        (path.len() >= 2).then_some(path)
    }
}

/// Where two elements that follow each other meet, of several places the one nearest to a point.
fn meeting(a: &Segment, b: &Segment, near: Point) -> Option<Point> {
    let rank = |point: &Point| {
        let is_beside = |segment: &&Segment| {
            !segment.spans(*point) && !(-1e-9..=1.0 + 1e-9).contains(&segment.share_of(*point))
        };
        let beside = [a, b].iter().any(is_beside);
        (beside, (point - near).norm())
    };
    let best = meetings(a, b).into_iter().min_by(|p, q| {
        let ((p_beside, p_away), (q_beside, q_away)) = (rank(p), rank(q));
        p_beside.cmp(&q_beside).then(p_away.total_cmp(&q_away))
    });
    best.filter(|point| point.x.is_finite() && point.y.is_finite())
}

/// A piece of a path that is no more than a point of it.
fn is_point(piece: &Element) -> bool {
    piece.geometry.length() <= 1e-9
}

/// What follows a point of the path begins where it stands: what is before it ends there, so nothing is left between.
fn without_points(path: Vec<(usize, Element)>) -> Vec<(usize, Element)> {
    let mut kept: Vec<(usize, Element)> = Vec::with_capacity(path.len());
    for (index, piece) in path {
        if !is_point(&piece) {
            kept.push((index, piece));
        } else if let Some((_, last)) = kept.last_mut() {
            close_up(last, piece.geometry.end());
        }
    }
    kept
}

/// Lets an element end in a point that lies within rounding of its end.
pub(super) fn close_up(element: &mut Element, end: Point) {
    match &mut element.geometry {
        Segment::Line(line) => line.end = end,
        Segment::Arc(arc) => arc.end = end,
    }
}

/// No more than rounding of coordinates.
const SAME: f64 = 1e-11;

/// The share of a segment at which one of its points lies: an angle need not be worked out for its ends.
fn share_on(segment: &Segment, point: Point) -> f64 {
    let is_at = |end: Point| (point - end).norm_squared() <= SAME * SAME;
    match segment {
        Segment::Arc(arc) if !arc.is_full_turn() && arc.length() > 1e3 * SAME => {
            if is_at(arc.start) {
                0.0
            } else if is_at(arc.end) {
                1.0
            } else {
                arc.share_of(point)
            }
        }
        _ => segment.share_of(point),
    }
}

/// True for points that are the ends of a segment but for what is no more than rounding of coordinates.
fn is_all_of(segment: &Segment, start: Point, end: Point) -> bool {
    let is_at = |one: Point, other: Point| (one - other).norm_squared() <= SAME * SAME;
    start != end
        && is_at(segment.start(), start)
        && is_at(segment.end(), end)
        && segment.length() > 1e3 * SAME
}

/// True where one point of an arc's circle is seen to lie behind the other in its sense: both are on the half of the circle that the middle of
/// the arc is on. False says nothing.
fn is_seen_forward(segment: &Segment, start: Point, end: Point) -> bool {
    let Some(arc) = segment
        .as_arc()
        .filter(|arc| !arc.is_shallow() && arc.sweep.abs() < 3.0)
    else {
        return false;
    };
    let middle = (arc.start - arc.center) + (arc.end - arc.center);
    let (from, to) = (start - arc.center, end - arc.center);
    from.dot(&middle) > 0.0 && to.dot(&middle) > 0.0 && cross(from, to) * arc.sweep > 0.0
}

/// The part of a segment, or of what carries it, from `start` to `end`.
pub(super) fn between(segment: &Segment, start: Point, end: Point) -> Segment {
    match segment {
        Segment::Line(_) => Segment::line(start, end),
        Segment::Arc(arc) if is_all_of(segment, start, end) => {
            Segment::Arc(Arc { start, end, ..*arc })
        }
        Segment::Arc(arc) => {
            let (from, to) = (share_on(segment, start), share_on(segment, end));
            Segment::Arc(Arc {
                start_angle: arc.start_angle + arc.sweep * from,
                sweep: arc.sweep * (to - from),
                start,
                end,
                ..*arc
            })
        }
    }
}
