//! Whether a path is that of the wire: nowhere nearer to the contour than the correction, everywhere at it, and nothing missing.
//!
//! A place of the wire's centre lies on the edge of where it may be when no wall is nearer than the correction and one is just
//! that far away. Every such place is on the raw offset of a wall or on the way round a corner. So a path is right when all of it is
//! such places, and when of what was cut off the raw elements none is.

use super::clearance::Walls;
use super::corners::{Element, Raw, meetings};
use super::kept::Kept;
use super::nest::{BesideWall, Nest};
use super::offset::Wall;
use crate::drawing::winding_of;
use crate::geometry::{Arc, Bounds, Line, Point, Segment, Vector, cross};
use std::ops::Deref;

/// What the offset of one contour is held against.
pub(super) struct Proof<'a> {
    pub(crate) place: Beside<'a>,
    pub(crate) raw: &'a Raw<'a>,
}

impl<'a> Deref for Proof<'a> {
    type Target = Beside<'a>;

    fn deref(&self) -> &Beside<'a> {
        &self.place
    }
}

/// Where the path of one contour runs. Lengths in drawing units.
pub(super) struct Beside<'a> {
    pub(crate) walls: &'a [Wall],
    /// The walls once more, to ask what is near.
    pub(crate) own: &'a Walls,
    pub(crate) correction: f64,
    /// +1 where the wire runs to the left of the walls, −1 to the right.
    pub(crate) side: f64,
    /// How far a path may be off by rounding.
    pub(crate) rounding: f64,
    /// False for the walls there and back along an open contour.
    pub(crate) closed: bool,
}

/// The path cannot be vouched for, near this wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unproved {
    pub(crate) wall: usize,
}

impl Beside<'_> {
    /// True where the wire runs, beside the contour. Costs a look at every wall.
    pub(crate) fn is_on_wire_side(&self, point: Point) -> bool {
        !self.closed
            || (winding_of(self.walls.iter().map(|wall| wall.geometry), point) != 0)
                == self.is_inside()
    }

    /// True where the wire runs inside of the contour.
    pub(crate) fn is_inside(&self) -> bool {
        if !self.closed {
            return false;
        }
        let origin = self
            .walls
            .first()
            .map_or_else(Point::origin, |wall| wall.geometry.start());
        let twice_area: f64 = self
            .walls
            .iter()
            .map(|wall| wall.geometry.twice_area(origin))
            .sum();
        twice_area * self.side > 0.0
    }

    /// Pieces of a path: nowhere nearer to a wall than the correction, and at it from their own. What is `kept` is asked with the
    /// boxes of what has changed.
    pub(crate) fn pieces_hold<'p>(
        &self,
        pieces: impl Iterator<Item = &'p Element>,
        nest: Option<&Nest>,
        mut kept: Option<(&mut Kept, &[Bounds])>,
    ) -> Result<(), Unproved> {
        for element in pieces {
            if let Some((kept, about)) = &mut kept
                && kept.holds(element, about)
            {
                continue;
            }
            let beyond = nest.and_then(|nest| {
                let beside = BesideWall {
                    wall: self.walls[element.wall].geometry,
                    side: self.side,
                    correction: self.correction,
                    rounding: self.rounding,
                };
                nest.beyond(beside, element)
            });
            match beyond {
                Some(parts) => {
                    let [begin, end] = parts;
                    let begin = begin.map(|part| (part, part.start()));
                    let end = end.map(|part| (part, part.end()));
                    for (part, outer) in begin.into_iter().chain(end) {
                        self.part_holds(&part, outer, element.wall)?;
                    }
                }
                None => self.piece_holds(&element.geometry, element.wall)?,
            }
        }
        Ok(())
    }

    /// The same of what reaches, up to a point, beyond an earlier pass, and is known to run at the correction from its own wall.
    fn part_holds(&self, part: &Segment, outer: Point, wall: usize) -> Result<(), Unproved> {
        let least = self.correction - self.rounding;
        let too_near = match self.closed {
            true => self.own.too_near_beside(wall, part, least, false),
            false => self.own.too_near(part, least),
        };
        let is_off = self.walls[wall].geometry.distance_to(outer) > self.correction + self.rounding;
        match too_near.or(is_off.then_some(wall)) {
            Some(wall) => Err(Unproved { wall }),
            None => Ok(()),
        }
    }

    fn piece_holds(&self, geometry: &Segment, wall: usize) -> Result<(), Unproved> {
        let own = &self.walls[wall].geometry;
        let (least, most) = (
            self.correction - self.rounding,
            self.correction + self.rounding,
        );
        let is_beside = runs_beside(geometry, own, [least, most]);
        let too_near = match self.closed {
            true => self.own.too_near_beside(wall, geometry, least, !is_beside),
            false => self.own.too_near(geometry, least),
        };
        if let Some(wall) = too_near {
            return Err(Unproved { wall });
        }
        if is_beside {
            return Ok(());
        }
        let is_off = |point: Point| own.distance_to(point) > most;
        let places = [geometry.start(), middle(geometry), geometry.end()];
        match places.into_iter().any(is_off) {
            true => Err(Unproved { wall }),
            false => Ok(()),
        }
    }
}

impl Proof<'_> {
    /// How many of the raw elements the path follows: of an open contour those on the side of the wire.
    pub(crate) fn followed(&self) -> usize {
        match self.closed {
            true => self.raw.len(),
            false => self.raw.end_roll(self.walls.len() / 2),
        }
    }

    /// Nothing that was cut off is a place of the path: what is left out of the raw elements `range` is too near to some wall.
    /// `by_raw` are all pieces of the path in the order of the raw elements.
    pub(crate) fn nothing_is_missing(
        &self,
        by_raw: &[(usize, Element)],
        range: std::ops::Range<usize>,
    ) -> Result<(), Unproved> {
        let mut next = by_raw.partition_point(|(raw, _)| *raw < range.start);
        for index in range {
            let first = next;
            while by_raw.get(next).is_some_and(|(raw, _)| *raw == index) {
                next += 1;
            }
            let only = match &by_raw[first..next] {
                [(_, piece)] => Some(&piece.geometry),
                _ => None,
            };
            if only.is_some_and(|piece| self.raw.is_all_of_roll(index, piece, self.rounding)) {
                continue;
            }
            let raw = &self.raw.geometry(index);
            if only.is_some_and(|piece| self.is_whole(piece, raw)) {
                continue;
            }
            let beside = [
                first
                    .checked_sub(1)
                    .unwrap_or(by_raw.len().saturating_sub(1)),
                if next < by_raw.len() { next } else { 0 },
            ];
            let beside = beside.map(|place| by_raw.get(place).map(|(_, element)| element));
            let [before, behind] = beside;
            let length = raw.length();
            let shares = |piece: &(usize, Element)| {
                let share = |point| raw.share_of(point).clamp(0.0, 1.0);
                match (&piece.1.geometry, raw) {
                    // Both ends of a full turn are one point.
                    (Segment::Arc(arc), _) if arc.is_full_turn() => [0.0, 1.0],
                    (Segment::Arc(arc), Segment::Arc(raw)) if raw.sweep != 0.0 => {
                        let from = (arc.start_angle - raw.start_angle) / raw.sweep;
                        [from, from + arc.sweep / raw.sweep].map(|share| share.clamp(0.0, 1.0))
                    }
                    (geometry, _) => [share(geometry.start()), share(geometry.end())],
                }
            };
            let mut done = (0.0, raw.start());
            let pieces = by_raw[first..next].iter().map(|piece| {
                let ([from, to], geometry) = (shares(piece), &piece.1.geometry);
                [(from, geometry.start()), (to, geometry.end())]
            });
            for [from, to] in pieces.chain([[(1.0, raw.end()); 2]]) {
                if (from.0 - done.0) * length > 2.0 * self.rounding
                    && self.is_missing(
                        index,
                        stretch_of(raw, done, from),
                        // What is cut off at the end, by what comes next.
                        if from.0 == 1.0 {
                            [behind, before]
                        } else {
                            beside
                        },
                        &by_raw[first..next],
                    )
                {
                    return Err(Unproved {
                        wall: self.raw.wall(index),
                    });
                }
                done = to;
            }
        }
        Ok(())
    }

    /// True for a piece of a raw element that leaves nothing out at its ends.
    fn is_whole(&self, piece: &Segment, raw: &Segment) -> bool {
        let half = self.rounding / 2.0;
        let is_close = |one: Point, other: Point| (one - other).norm_squared() <= half * half;
        if let (Segment::Line(piece), Segment::Line(raw)) = (piece, raw)
            && is_close(piece.start, raw.start)
            && is_close(piece.end, raw.end)
        {
            return true;
        }
        (piece.start() - raw.start()).norm() <= self.rounding
            && (piece.end() - raw.end()).norm() <= self.rounding
            && (piece.length() - raw.length()).abs() <= self.rounding
    }

    /// True when a stretch of a raw element has places of the path in it that lie beside what is there of the path.
    fn is_missing(
        &self,
        index: usize,
        stretch: Segment,
        beside: [Option<&Element>; 2],
        same: &[(usize, Element)],
    ) -> bool {
        // Most is cut off at a corner, by the wall that comes next.
        let takes_all = |element: &&Element| {
            let wall = &self.walls[element.wall].geometry;
            is_all_about_foot(&stretch, wall, self.correction)
                || is_all_within(&stretch, wall, self.correction)
        };
        if beside.iter().flatten().any(takes_all) {
            return false;
        }
        let is_there = |point: Point| {
            let of_path = beside
                .into_iter()
                .flatten()
                .chain(same.iter().map(|(_, element)| element));
            let mut distances = of_path.map(|element| element.geometry.distance_to(point));
            distances.any(|distance| distance <= 2.0 * self.rounding)
        };
        let cuts = self.cuts(index, &stretch, None);
        cuts.windows(2).any(|pair| {
            let middle = stretch.point_at((pair[0] + pair[1]) / 2.0);
            (pair[1] - pair[0]) * stretch.length() > 2.0 * self.rounding
                && self.own.nearer(middle, self.correction - 1e-3 * self.rounding).is_none()
                && !is_there(middle)
                // A crumb in the contour may turn a corner inside out.
                && self.is_on_wire_side(middle)
        })
    }

    /// Shares of a stretch of a raw element at which other raw elements cross it or end on it, with 0 and 1, rising. Between two of
    /// them either all places keep clear of the walls or none. Who asks for many hands in all raw elements.
    pub(crate) fn cuts(&self, index: usize, stretch: &Segment, all: Option<&Walls>) -> Vec<f64> {
        let mut cuts = vec![0.0, 1.0];
        let slack = self.rounding * 1e-2;
        let area = stretch.bounds().grown(slack);
        let is_on = |segment: &Segment, point: Point| {
            let is_at = |end: Point| (point - end).norm() <= slack;
            segment.spans(point) || is_at(segment.start()) || is_at(segment.end())
        };
        let mut cut_by = |other: usize, segment: &Segment| {
            if other == index || segment.length() == 0.0 {
                return;
            }
            let crossings = meetings(stretch, segment)
                .into_iter()
                .filter(|&point| is_on(segment, point));
            let ends = [segment.start(), segment.end()]
                .into_iter()
                .filter(|&end| stretch.distance_to(end) <= slack);
            let points = crossings.chain(ends).filter(|&point| is_on(stretch, point));
            cuts.extend(points.map(|point| stretch.share_of(point).clamp(0.0, 1.0)));
        };
        match all {
            _ if stretch.length() <= 0.0 => {}
            Some(all) => {
                all.find(&area, |other| {
                    cut_by(other, all.segment(other));
                    false
                });
            }
            None => {
                // A raw element is as far as the correction from its wall.
                let reach = area.grown(self.correction + self.rounding);
                self.own.find(&reach, |wall| {
                    let back = (!self.closed).then(|| self.walls.len() - 1 - wall);
                    for other in [Some(wall), back].into_iter().flatten() {
                        for other in self.raw.of_wall(other) {
                            let segment = self.raw.geometry(other);
                            if segment.bounds().touches(&area) {
                                cut_by(other, &segment);
                            }
                        }
                    }
                    false
                });
            }
        }
        cuts.sort_by(f64::total_cmp);
        cuts
    }
}

/// The stretch of a raw element between two places, each with its share of it.
fn stretch_of(raw: &Segment, from: (f64, Point), to: (f64, Point)) -> Segment {
    let place = |(share, point): (f64, Point)| match share {
        // What lies beyond an end has been cut back to it.
        0.0 => raw.start(),
        1.0 => raw.end(),
        _ => point,
    };
    let (start, end) = (place(from), place(to));
    match raw {
        Segment::Line(_) => Segment::line(start, end),
        Segment::Arc(arc) => Segment::Arc(Arc {
            start_angle: arc.start_angle + arc.sweep * from.0,
            sweep: arc.sweep * (to.0 - from.0),
            start,
            end,
            ..*arc
        }),
    }
}

/// The middle of a segment, for an arc from its ends where these say it well.
fn middle(segment: &Segment) -> Point {
    match segment {
        Segment::Arc(arc) if !arc.is_shallow() && arc.sweep.abs() < 3.0 => {
            let out = (arc.start - arc.center) + (arc.end - arc.center);
            let way = out.try_normalize(0.0);
            way.map_or(arc.center, |way| arc.center + way * arc.radius)
        }
        _ => segment.point_at(0.5),
    }
}

/// True when a segment is seen to run beside another of its kind, between so near and so far from it all along. False says nothing.
fn runs_beside(segment: &Segment, wall: &Segment, [least, most]: [f64; 2]) -> bool {
    match (segment, wall) {
        (Segment::Line(segment), Segment::Line(wall)) => {
            // All of it times the length of the wall.
            let along = wall.end - wall.start;
            let squared = along.norm_squared();
            let (start, end) = (segment.start - wall.start, segment.end - wall.start);
            let is_over = |from: Vector| (0.0..=squared).contains(&along.dot(&from));
            let (first, last) = (cross(along, start), cross(along, end));
            let (nearest, farthest) = (
                (first * first).min(last * last),
                (first * first).max(last * last),
            );
            first * last > 0.0
                && nearest >= least * least * squared
                && farthest <= most * most * squared
                && is_over(start)
                && is_over(end)
        }
        (Segment::Arc(segment), Segment::Arc(wall)) => {
            let is_at = |radius: f64| (least..=most).contains(&(radius - wall.radius).abs());
            let is_near = |point: Point, end: Point| (point - end).norm_squared() <= most * most;
            let is_end = |end: Point| {
                is_at((end - wall.center).norm())
                    && (wall.spans(end) || is_near(end, wall.start) || is_near(end, wall.end))
            };
            segment.center == wall.center
                && !segment.is_shallow()
                && !wall.is_shallow()
                && wall.is_minor()
                && segment.sweep * wall.sweep > 0.0
                && segment.sweep.abs() <= wall.sweep.abs() + 1e-9
                && is_at(segment.radius)
                && is_end(segment.start)
                && is_end(segment.end)
        }
        _ => false,
    }
}

/// The corners of what a stretch of a raw element lies within, and its middle. `None` for an arc that turns too far.
fn hull(stretch: &Segment) -> Option<([Point; 3], Point)> {
    let (start, end) = (stretch.start(), stretch.end());
    match stretch {
        Segment::Line(_) => Some(([start, end, start], start + (end - start) * 0.5)),
        Segment::Arc(arc) if arc.sweep.abs() > 2.0 => None,
        Segment::Arc(arc) => {
            let half_way = middle(stretch);
            let out = half_way - arc.center;
            let apex = arc.center + out * (out.norm_squared() / out.dot(&(start - arc.center)));
            Some(([start, end, apex], half_way))
        }
    }
}

/// True when a stretch is seen to lie within `distance` of the place of a wall that is nearest to one of its ends, all but its ends nearer
/// than that: so it is at most corners. False says nothing.
fn is_all_about_foot(stretch: &Segment, wall: &Segment, distance: f64) -> bool {
    let Some((corners, half_way)) = hull(stretch) else {
        return false;
    };
    let (least, most) = (distance * (1.0 - 1e-7), distance * (1.0 + 1e-9));
    let is_about = |foot: Point| {
        let is_within = |corner: &Point| (corner - foot).norm_squared() <= most * most;
        (half_way - foot).norm_squared() < least * least && corners.iter().all(is_within)
    };
    let foot_of = |end: Point| match wall {
        Segment::Line(line) => {
            let share = line.share_of(end).clamp(0.0, 1.0);
            Some(line.start + (line.end - line.start) * share)
        }
        Segment::Arc(arc) if arc.is_shallow() || !arc.spans(end) => None,
        Segment::Arc(arc) => {
            let out = (end - arc.center).try_normalize(0.0)?;
            Some(arc.center + out * arc.radius)
        }
    };
    let mut feet = [corners[0], corners[1]].into_iter().filter_map(foot_of);
    feet.any(is_about)
}

/// True when a stretch is seen to lie within `distance` of a wall, all but its ends nearer than that. False says nothing.
///
/// The distance from a line is convex: it is nowhere larger than at the corners of what the stretch lies within. Beside an arc of no more than
/// a half turn these corners lie in its sector, which is convex, too: there only how far they are from the centre counts.
fn is_all_within(stretch: &Segment, wall: &Segment, distance: f64) -> bool {
    let Some((corners, half_way)) = hull(stretch) else {
        return false;
    };
    let [start, end, apex] = corners;
    let most = distance * (1.0 + 1e-9);
    let is_within = |point: &Point| wall.distance_to(*point) <= most;
    if wall.distance_to(half_way) >= distance * (1.0 - 1e-7) || !corners.iter().all(is_within) {
        return false;
    }
    let Segment::Arc(arc) = wall else {
        return true;
    };
    let least = arc.radius - most;
    let sides = [(start, end), (end, apex), (apex, start)];
    let keeps_out = |&(start, end): &(Point, Point)| {
        least <= 0.0 || Line { start, end }.distance_to(arc.center) >= least
    };
    !arc.is_shallow()
        && arc.is_minor()
        && corners.iter().all(|corner| arc.spans(*corner))
        && sides.iter().all(keeps_out)
}
