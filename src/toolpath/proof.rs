//! Whether a path is that of the wire: nowhere nearer to the contour than the correction, everywhere at it, and nothing missing.
//!
//! A place of the wire's centre lies on the edge of where it may be when no wall is nearer than the correction and one is just
//! that far away. Every such place is on the raw offset of a wall or on the way round a corner. So a path is right when all of it is
//! such places, and when nothing that was cut off the raw elements is.

use super::clearance::Walls;
use super::corners::{Element, Offsets, Raw, meetings};
use super::nest::{BesideWall, Nest};
use super::offset::Wall;
use super::quick_tests::{is_all_about_foot, is_all_within, middle, runs_beside};
use super::ring::Pieces;
use crate::drawing::winding_of;
use crate::geometry::{Arc, Bounds, Point, Segment};
use std::ops::{Deref, Range};

/// What the offset of one contour is checked against.
pub(super) struct Proof<'a> {
    pub(crate) place: Beside<'a>,
    pub(crate) offsets: Offsets<'a>,
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

    /// Pieces of a path: nowhere nearer to a wall than the correction, and at it from their own.
    pub(crate) fn pieces_hold<'p>(
        &self,
        pieces: impl Iterator<Item = &'p Element>,
        nest: Option<&Nest>,
    ) -> Result<(), Unproved> {
        for element in pieces {
            let beyond = nest.and_then(|nest| nest.beyond(self.beside_wall(element.wall), element));
            self.holds_beyond(element, beyond)?;
        }
        Ok(())
    }

    /// How the path runs beside a wall.
    pub(super) fn beside_wall(&self, wall: usize) -> BesideWall<'_> {
        let geometry = &self.walls[wall].geometry;
        BesideWall {
            wall: geometry,
            along: match self.closed {
                true => self.own.tangents()[wall][0],
                false => geometry.start_tangent(),
            },
            side: self.side,
            correction: self.correction,
            rounding: self.rounding,
        }
    }

    /// The same of one piece, where it is known only of what of it reaches beyond an earlier pass.
    pub(super) fn holds_beyond(
        &self,
        element: &Element,
        beyond: Option<[Option<Segment>; 2]>,
    ) -> Result<(), Unproved> {
        let Some([begin, end]) = beyond else {
            return self.piece_holds(&element.geometry, element.wall);
        };
        let begin = begin.map(|part| (part, part.start()));
        let end = end.map(|part| (part, part.end()));
        let mut parts = begin.into_iter().chain(end);
        parts.try_for_each(|(part, outer)| self.part_holds(&part, outer, element.wall))
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

/// The pieces of the path that lie on one of the offsets, and those before and after them.
pub(super) struct There<'p> {
    pub(super) pieces: &'p [Element],
    pub(super) before: Option<&'p Element>,
    pub(super) behind: Option<&'p Element>,
}

impl Proof<'_> {
    /// Nothing that was cut off is a place of the path: what is left out of the raw elements `range` is too near to some wall.
    /// `by_raw` are all pieces of the path in the order of the raw elements.
    pub(crate) fn nothing_is_missing(
        &self,
        raw: &Raw,
        by_raw: &Pieces,
        range: Range<usize>,
    ) -> Result<(), Unproved> {
        let Pieces {
            elements: path,
            raw: of,
        } = by_raw;
        let mut next = of.partition_point(|raw| (*raw as usize) < range.start);
        for index in range {
            let first = next;
            while of.get(next).is_some_and(|raw| *raw as usize == index) {
                next += 1;
            }
            let before = first.checked_sub(1).unwrap_or(path.len().saturating_sub(1));
            let behind = if next < path.len() { next } else { 0 };
            let there = There {
                pieces: &path[first..next],
                before: path.get(before),
                behind: path.get(behind),
            };
            let key = raw.key(index);
            if let [piece] = there.pieces
                && (self.offsets).is_all_of_roll(key, &piece.geometry, self.rounding)
            {
                continue;
            }
            if self.is_any_missing(key, &self.offsets.geometry(key), &there) {
                return Err(Unproved { wall: key / 2 });
            }
        }
        Ok(())
    }

    /// True where what is left out of one of the offsets has places of the path in it.
    pub(super) fn is_any_missing(&self, key: usize, raw: &Segment, there: &There) -> bool {
        let walls = [there.before, there.behind].map(|beside| beside.map(|element| element.wall));
        self.left_out(raw, there.pieces)
            .any(|(stretch, is_at_end)| {
                !self.is_taken(&stretch, walls, is_at_end) && self.is_missing(key, stretch, there)
            })
    }

    /// What pieces leave out of a raw element, and whether it goes up to its end.
    pub(super) fn left_out<'r>(
        &self,
        raw: &'r Segment,
        pieces: &'r [Element],
    ) -> impl Iterator<Item = (Segment, bool)> + use<'r> {
        let is_whole = match pieces {
            [piece] => self.is_whole(&piece.geometry, raw),
            _ => false,
        };
        let (length, most) = (raw.length(), 2.0 * self.rounding);
        let shares = move |piece: &Segment| {
            let share = |point| raw.share_of(point).clamp(0.0, 1.0);
            match (piece, raw) {
                // Both ends of a full turn are one point.
                (Segment::Arc(arc), _) if arc.is_full_turn() => [0.0, 1.0],
                (Segment::Arc(arc), Segment::Arc(raw)) if raw.sweep != 0.0 => {
                    let from = (arc.start_angle - raw.start_angle) / raw.sweep;
                    [from, from + arc.sweep / raw.sweep].map(|share| share.clamp(0.0, 1.0))
                }
                (geometry, _) => [share(geometry.start()), share(geometry.end())],
            }
        };
        let places = pieces.iter().map(move |piece| {
            let ([from, to], geometry) = (shares(&piece.geometry), &piece.geometry);
            [(from, geometry.start()), (to, geometry.end())]
        });
        let places = places.chain([[(1.0, raw.end()); 2]]);
        let mut done = (0.0, raw.start());
        let left_out = places.filter_map(move |[from, to]| {
            let before = std::mem::replace(&mut done, to);
            let is_any = (from.0 - before.0) * length > most;
            is_any.then(|| (stretch_of(raw, before, from), from.0 == 1.0))
        });
        left_out.take(if is_whole { 0 } else { usize::MAX })
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

    /// True for a stretch that is seen to be too near to the wall of the path before or after it: most is cut off at a corner, by the wall that
    /// comes next.
    pub(super) fn is_taken(
        &self,
        stretch: &Segment,
        [before, behind]: [Option<usize>; 2],
        is_at_end: bool,
    ) -> bool {
        let takes_all = |wall: usize| {
            let wall = &self.walls[wall].geometry;
            is_all_about_foot(stretch, wall, self.correction)
                || is_all_within(stretch, wall, self.correction)
        };
        let (first, other) = match is_at_end {
            true => (behind, before),
            false => (before, behind),
        };
        first.into_iter().chain(other).any(takes_all)
    }

    /// True when a stretch of a raw element has places of the path in it that lie beside what is there of the path.
    fn is_missing(&self, key: usize, stretch: Segment, there: &There) -> bool {
        let is_there = |point: Point| {
            let beside = there.before.into_iter().chain(there.behind);
            let of_path = beside.chain(there.pieces);
            let mut distances = of_path.map(|element| element.geometry.distance_to(point));
            distances.any(|distance| distance <= 2.0 * self.rounding)
        };
        let cuts = self.cuts(key, &stretch);
        cuts.windows(2).any(|pair| {
            let middle = stretch.point_at((pair[0] + pair[1]) / 2.0);
            (pair[1] - pair[0]) * stretch.length() > 2.0 * self.rounding
                && self.own.nearer(middle, self.correction - 1e-3 * self.rounding).is_none()
                && !is_there(middle)
                // A crumb in the contour may turn a corner inside out.
                && self.is_on_wire_side(middle)
        })
    }

    /// Shares of a stretch of one of the offsets at which others cross it or end on it, with 0 and 1, rising. Between two of them either all
    /// places keep clear of the walls or none.
    fn cuts(&self, key: usize, stretch: &Segment) -> Vec<f64> {
        self.cut_by(stretch, |area, cut_by| {
            // A raw element is as far as the correction from its wall.
            let reach = area.grown(self.correction + self.rounding);
            self.own.find(&reach, |wall| {
                let back = (!self.closed).then(|| self.walls.len() - 1 - wall);
                for other in [Some(wall), back].into_iter().flatten() {
                    for other in self.offsets.of_wall(other) {
                        let segment = self.offsets.geometry(other);
                        if other != key && segment.bounds().touches(area) {
                            cut_by(&segment);
                        }
                    }
                }
                false
            });
        })
    }

    /// The same of one of all raw elements, which are at hand.
    pub(crate) fn cuts_among(&self, all: &Walls, own: usize) -> Vec<f64> {
        self.cut_by(all.segment(own), |area, cut_by| {
            all.find(area, |other| {
                if other != own {
                    cut_by(all.segment(other));
                }
                false
            });
        })
    }

    fn cut_by(
        &self,
        stretch: &Segment,
        others: impl FnOnce(&Bounds, &mut dyn FnMut(&Segment)),
    ) -> Vec<f64> {
        let mut cuts = vec![0.0, 1.0];
        let slack = self.rounding * 1e-2;
        let is_on = |segment: &Segment, point: Point| {
            let is_at = |end: Point| (point - end).norm() <= slack;
            segment.spans(point) || is_at(segment.start()) || is_at(segment.end())
        };
        let mut cut_by = |segment: &Segment| {
            if segment.length() == 0.0 {
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
        if stretch.length() > 0.0 {
            others(&stretch.bounds().grown(slack), &mut cut_by);
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
