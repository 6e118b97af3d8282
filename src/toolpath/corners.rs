//! Joining the offsets of neighbouring walls to one closed path.
//!
//! Where the offsets touch they pass into each other; at a convex corner the wire rolls about the vertex; at a concave corner the
//! two are cut where they meet. What is used up by that is left out and its neighbours are cut with each other. That is quick, and
//! right on most contours: `proof` says whether it is, and `loops` finds the path where it is not. `tips` in place of rolls come last.

use super::cores::each;
use super::offset::{Offset, Wall, offset};
use super::path::{PathSegment, Source};
use crate::geometry::{
    Arc, Few, Locus, Point, Segment, Vector, cross, left_normal, positive_angle,
};
use std::f64::consts::TAU;
use std::ops::Range;

/// Elements that one core takes at a time.
pub(super) const AT_A_TIME: usize = 2048;

/// A piece of the closed path and the wall it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    pub(crate) geometry: Segment,
    pub(crate) source: Source,
    /// Index of the wall; of the one before it, for the way round a corner.
    pub(crate) wall: usize,
}

impl Element {
    /// Without its wall.
    pub(super) fn piece(&self) -> PathSegment {
        PathSegment {
            geometry: self.geometry,
            source: self.source,
        }
    }

    /// True for the way round a corner.
    pub(super) fn is_roll(&self) -> bool {
        matches!(self.source, Source::Corner { .. })
    }
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

/// What follows an element.
#[derive(Clone, Copy, Debug)]
pub(super) enum Joint {
    At(Point),
    /// The two elements meet where their lines or circles cross, nearest to this point.
    CrossNear(Point),
}

/// The offsets of all walls and the ways round their convex corners, before anything is cut. The
/// key of each is twice the index of its wall, plus one for the way round the end of that wall.
/// Each is made when it is asked for: that takes less time than to fetch it from memory.
#[derive(Clone, Copy)]
pub(super) struct Offsets<'a> {
    pub(crate) walls: &'a [Wall],
    /// Of each wall at its ends.
    pub(crate) tangents: &'a [[Vector; 2]],
    pub(crate) joining: &'a Joining,
}

/// True for the way round a corner.
pub(super) fn is_roll(key: usize) -> bool {
    key % 2 == 1
}

impl Offsets<'_> {
    /// The wall after another.
    pub(super) fn behind(&self, wall: usize) -> usize {
        match wall + 1 == self.walls.len() {
            true => 0,
            false => wall + 1,
        }
    }

    /// The way after a wall.
    pub(super) fn way(&self, wall: usize) -> Way {
        corner(
            self.walls[wall].geometry.end(),
            self.turn(wall),
            self.joining,
        )
    }

    fn shifted(&self, wall: usize) -> Offset {
        let Joining {
            correction,
            side,
            tolerance,
            ..
        } = *self.joining;
        match &self.walls[wall].geometry {
            Segment::Line(line) => {
                let shift = left_normal(self.tangents[wall][0]) * (side * correction);
                Offset::Runs(Segment::line(line.start + shift, line.end + shift))
            }
            arc => offset(arc, correction, side, tolerance),
        }
    }

    /// The offset of a wall, where the wire's centre can follow it.
    pub(super) fn along(&self, wall: usize) -> Option<Segment> {
        match self.shifted(wall) {
            Offset::Runs(geometry) => Some(geometry),
            Offset::TooTight { .. } => None,
        }
    }

    /// The way round the end of a wall, where there is one.
    pub(super) fn roll(&self, wall: usize) -> Option<Segment> {
        match self.way(wall) {
            Way::Roll(ends) => Some(self.roll_between(wall, ends, None)),
            Way::Through(_) => None,
        }
    }

    /// The way round the end of a wall between its ends. Its angle at the beginning, and how far it
    /// turns, are the same at every correction: they may be known.
    pub(super) fn roll_between(
        &self,
        wall: usize,
        [start, end]: [Point; 2],
        angles: Option<[f64; 2]>,
    ) -> Segment {
        let [start_angle, sweep] = angles.unwrap_or_else(|| {
            let side = self.joining.side;
            let [from, to] = self.turn(wall).map(|along| {
                let out = left_normal(along) * side;
                out.y.atan2(out.x)
            });
            let forward = positive_angle(to - from);
            [from, if side < 0.0 { forward } else { forward - TAU }]
        });
        Segment::Arc(Arc {
            center: self.walls[wall].geometry.end(),
            radius: self.joining.correction,
            start_angle,
            sweep,
            start,
            end,
        })
    }

    /// The directions before and after the end of a wall.
    fn turn(&self, wall: usize) -> [Vector; 2] {
        [self.tangents[wall][1], self.tangents[self.behind(wall)][0]]
    }

    /// Those that the wire's centre cannot follow at all are points.
    pub(super) fn geometry(&self, key: usize) -> Segment {
        if is_roll(key)
            && let Some(roll) = self.roll(key / 2)
        {
            return roll;
        }
        match self.shifted(key / 2) {
            Offset::Runs(geometry) => geometry,
            Offset::TooTight { center } => Segment::line(center, center),
        }
    }

    /// Where one begins and where it ends.
    pub(super) fn ends(&self, key: usize) -> [Point; 2] {
        if is_roll(key)
            && let Way::Roll(ends) = self.way(key / 2)
        {
            return ends;
        }
        match self.shifted(key / 2) {
            Offset::Runs(geometry) => [geometry.start(), geometry.end()],
            Offset::TooTight { center } => [center, center],
        }
    }

    /// The same with what is known of it, in another form.
    pub(super) fn element(&self, key: usize, geometry: Segment) -> Element {
        let wall = key / 2;
        let source = match self.walls[wall].source {
            Source::Segment { entity, segment } if is_roll(key) => {
                Source::Corner { entity, segment }
            }
            source => source,
        };
        Element {
            geometry,
            source,
            wall,
        }
    }

    /// What follows one.
    pub(super) fn joint(&self, key: usize) -> Joint {
        match (self.way(key / 2), is_roll(key)) {
            (Way::Through(joint), _) => joint,
            (Way::Roll([from, _]), false) => Joint::At(from),
            (Way::Roll([_, to]), true) => Joint::At(to),
        }
    }

    /// The keys of what is of a wall.
    pub(super) fn of_wall(&self, wall: usize) -> Range<usize> {
        let is_roll = matches!(self.way(wall), Way::Roll(_));
        2 * wall..2 * wall + if is_roll { 2 } else { 1 }
    }

    /// True for a piece of the way round a corner that is seen to be all of it but for half of `rounding` at its ends. False says nothing.
    pub(super) fn is_all_of_roll(&self, key: usize, piece: &Segment, rounding: f64) -> bool {
        let Segment::Arc(arc) = piece else {
            return false;
        };
        if !is_roll(key)
            || arc.center != self.walls[key / 2].geometry.end()
            || arc.radius != self.joining.correction
            || arc.sweep * self.joining.side >= 0.0
            || !arc.is_minor()
        {
            return false;
        }
        let [from, to] = self.ends(key);
        let most = rounding / 2.0;
        (arc.start - from).norm_squared() <= most * most
            && (arc.end - to).norm_squared() <= most * most
    }

    /// True where a piece of one goes from its start to its end against the direction of the whole.
    pub(super) fn runs_backwards(&self, key: usize, start: Point, end: Point) -> bool {
        if is_roll(key) && self.ends(key) == [start, end] {
            return false;
        }
        goes_backwards(&self.geometry(key), start, end)
    }
}

/// True where the way along a segment from a start to an end goes against its direction.
pub(super) fn goes_backwards(segment: &Segment, start: Point, end: Point) -> bool {
    if let Segment::Line(line) = segment {
        let along = line.end - line.start;
        let forward = (end - start).dot(&along);
        return forward < 0.0 && forward * forward > 1e-18 * along.norm_squared();
    }
    let length = segment.length();
    length > 0.0
        && !is_all_of(segment, start, end)
        && !is_seen_forward(segment, start, end)
        && (share_on(segment, end) - share_on(segment, start)) * length < -1e-9
}

/// The existing offsets and ways round corners, in the order of the contour.
pub(super) struct Raw<'a> {
    pub(super) offsets: Offsets<'a>,
    keys: Vec<u32>,
    /// Those that the wire's centre cannot follow, with the place that stands for them.
    pub(super) tight: Vec<(usize, Point)>,
}

impl<'a> Raw<'a> {
    pub(crate) fn new(offsets: Offsets<'a>) -> Raw<'a> {
        let count = offsets.walls.len();
        let mut raw = Raw {
            offsets,
            keys: Vec::with_capacity(2 * count),
            tight: Vec::new(),
        };
        let kinds = each(count, AT_A_TIME, |wall| {
            let is_tight = matches!(offsets.shifted(wall), Offset::TooTight { .. });
            (matches!(offsets.way(wall), Way::Roll(_)), is_tight)
        });
        for (wall, (is_roll, is_tight)) in kinds.into_iter().enumerate() {
            if is_tight && let Offset::TooTight { center } = offsets.shifted(wall) {
                raw.tight.push((raw.keys.len(), center));
            }
            raw.keys.push(2 * wall as u32);
            if is_roll {
                raw.keys.push(2 * wall as u32 + 1);
            }
        }
        raw
    }

    pub(crate) fn len(&self) -> usize {
        self.keys.len()
    }

    pub(super) fn key(&self, index: usize) -> usize {
        self.keys[index] as usize
    }

    pub(crate) fn geometry(&self, index: usize) -> Segment {
        self.offsets.geometry(self.key(index))
    }

    /// For an open contour that is travelled there and back, with this many walls either way: the
    /// element that leads round its end. Those before it lie on the side of the wire.
    pub(crate) fn end_roll(&self, walls: usize) -> usize {
        let behind = self.keys.partition_point(|key| (key / 2) < walls as u32);
        behind.saturating_sub(1)
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
    let met = nearly_meetings(a, b).into_iter();
    met.map(|point| nearer_to_both(a, b, point)).collect()
}

/// The same but for rounding, which about a centre that is far away shows.
pub(super) fn nearly_meetings(a: &Segment, b: &Segment) -> Few<Point, 2> {
    Locus::of(a).meet(&Locus::of(b))
}

/// A meeting of two carriers, one step nearer to both.
pub(super) fn nearer_to_both(a: &Segment, b: &Segment, point: Point) -> Point {
    let off = |segment: &Segment| match segment {
        Segment::Line(line) => {
            let normal = left_normal(line.direction());
            (normal.dot(&(point - line.start)), normal)
        }
        Segment::Arc(arc) => {
            let out = point - arc.center;
            let away = out.norm();
            let rise = match arc.is_shallow() {
                true => arc.rise_of(point),
                false => away - arc.radius,
            };
            (
                rise,
                if away > 0.0 {
                    out / away
                } else {
                    Vector::zeros()
                },
            )
        }
    };
    if let (Segment::Line(_), Segment::Line(_)) = (a, b) {
        return point;
    }
    let ((from_a, normal_a), (from_b, normal_b)) = (off(a), off(b));
    let between = cross(normal_a, normal_b);
    if between.abs() < 1e-3 {
        // Where the two touch, a step across both says nothing.
        return point;
    }
    point - (left_normal(normal_a) * from_b - left_normal(normal_b) * from_a) / between
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
pub(super) fn is_all_of(segment: &Segment, start: Point, end: Point) -> bool {
    let is_at = |one: Point, other: Point| (one - other).norm_squared() <= SAME * SAME;
    start != end
        && is_at(segment.start(), start)
        && is_at(segment.end(), end)
        && segment.length() > 1e3 * SAME
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

/// True where one point of an arc's circle is seen to lie after the other in its sense: both are on the half of the circle that the middle of
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
