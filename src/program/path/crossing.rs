//! `path-crosses-itself`: the way of one contour goes through itself.
//!
//! A touch is no crossing: lead-in and lead-out may coincide and end on the contour, and a contour may touch itself. So
//! where two pieces meet, the way is followed from that place on both sides, across the joints of its blocks, until the
//! four ends are apart; it crosses if they alternate round the place. The drift of a counting machine makes no
//! crossing: anything within [`margin`] is only a touch.

use super::way::tolerance;
use crate::geometry::{Bounds, Boxes, Point, Segment, Vector, meetings, positive_angle};
use std::cell::Cell;

mod leads;

/// Two pieces, by their index, and where they cross.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct Crossing {
    pub(crate) first: usize,
    pub(crate) second: usize,
    pub(crate) at: Point,
}

/// The most crossings that are reported for one contour.
const MOST: usize = 50;

/// The most pairs of pieces of one contour that are compared: where much lies on one place all of them are near each
/// other.
const MOST_PAIRS: usize = 1_000;

/// The most pieces of one contour that are read to follow the way from its meeting places: where it coincides with
/// itself for long, its branches never part.
const MOST_STEPS: usize = 1_000_000;

/// The most consecutive pieces along another one for which a crossing is still that of the first of them.
const MOST_ALONG: usize = 8;

/// The largest distance of a place from another piece through it, µm: nodes are on whole µm or ends of arcs.
const ON: f64 = 0.01;

/// The same for a first look from elsewhere, where rounding differs, µm.
const NEARLY_ON: f64 = 0.05;

/// The largest distance between the boxes of two passes of one contour on each side, µm: more than any two corrections
/// differ.
pub(super) const BESIDE: f64 = 1_000.0;

/// How often the followed distance is doubled to see two branches part.
const DOUBLINGS: usize = 10;

/// The largest deviation of a way with this many arcs, µm: each arc adds up to 1 µm to either side, by chance. Counts
/// that are nearly equal give the same, so that a block more or less does not matter.
pub(super) fn margin(arcs: usize) -> f64 {
    tolerance(arcs.next_power_of_two())
}

/// The length of a step from one pass to the side, for another beside it, µm; `None` where it is none.
pub(super) fn step_across(before: &Segment, step: &Segment) -> Option<f64> {
    let (by, along) = (step.end() - step.start(), before.end_tangent());
    let is_across =
        step.as_arc().is_none() && by.norm() <= BESIDE && 2.0 * by.dot(&along).abs() < by.norm();
    is_across.then(|| by.norm())
}

/// A way by its pieces, each of which begins where the one before ends.
pub(super) struct Tangle<'a> {
    pub(crate) pieces: &'a [Segment],
    pub(crate) margin: f64,
    /// The piece after the last one, where that is of another pass.
    pub(crate) next: Option<Segment>,
    /// How far beside the last pass its tab is cut, µm.
    pub(crate) aside: f64,
    /// Pieces that have been gone through.
    pub(crate) steps: Cell<usize>,
}

/// The crossings of a way that is held as a whole. No more than `left` pieces are read to follow it, and at most [`MOST_STEPS`]: what was
/// read is taken from `left`.
pub(in crate::program) fn crossings(
    pieces: &[Segment],
    arcs: usize,
    left: &mut usize,
) -> Vec<Crossing> {
    let read_already = MOST_STEPS.saturating_sub(*left);
    let way = Tangle {
        aside: 0.0,
        next: None,
        pieces,
        margin: margin(arcs),
        steps: Cell::new(read_already),
    };
    let found = way.all_crossings().0;
    *left = left.saturating_sub(way.steps.get() - read_already);
    found
}

/// The most boxes that are compared with each other among this many pieces. A way that does not coincide with itself
/// takes a few for each.
fn most_looks(pieces: usize) -> usize {
    500_000 + 32 * pieces
}

/// Pairs of pieces that come near each other, without neighbours, in the order of the later one: up
/// to `most`, completed by those of one more piece; and whether these are all.
fn near_each_other(pieces: &[Segment], most: usize) -> (Vec<(usize, usize)>, bool) {
    let (mut near, mut looks) = (Vec::new(), 0);
    let (mut boxes, mut before) = (Boxes::default(), Vec::new());
    for (second, piece) in pieces.iter().enumerate() {
        let own = piece.bounds();
        let mut look = |first: usize| {
            if come_near(&pieces[first], &before[first], piece, &own) {
                near.push((first, second));
            }
        };
        let end = second.saturating_sub(1);
        looks += boxes.touching(&own.grown(NEARLY_ON), end, &mut look);
        boxes.push(own);
        before.push(own);
        if near.len() > most || looks > most_looks(second) {
            return (near, false);
        }
    }
    (near, true)
}

/// True where two pieces have a place in common, or nearly.
fn come_near(a: &Segment, box_of_a: &Bounds, b: &Segment, box_of_b: &Bounds) -> bool {
    let on = |piece: &Segment, other: &Segment| {
        [other.start(), other.end()]
            .iter()
            .any(|&end| piece.distance_to(end) <= NEARLY_ON)
    };
    box_of_a.grown(NEARLY_ON).touches(box_of_b)
        && (on(a, b) || on(b, a) || !meetings(a, b).is_empty())
}

impl Tangle<'_> {
    fn at(&self, index: usize) -> Option<Segment> {
        self.steps.set(self.steps.get() + 1);
        self.pieces.get(index).copied()
    }

    fn is_exhausted(&self) -> bool {
        self.steps.get() > MOST_STEPS
    }

    /// The crossings of the way, and whether all of it was looked at. No more of it is read than is
    /// needed.
    pub(crate) fn all_crossings(&self) -> (Vec<Crossing>, bool) {
        let (near, is_all) = near_each_other(self.pieces, MOST_PAIRS);
        let (found, are_followed) = self.crossings(near);
        (found, is_all && are_followed)
    }

    /// The crossings among pairs of pieces that come near each other, in the order of the way; and whether all pairs were looked at.
    fn crossings(&self, mut near: Vec<(usize, usize)>) -> (Vec<Crossing>, bool) {
        near.sort_unstable_by_key(|&(first, second)| (second, first));
        near.dedup();
        let is_all = near.len() <= MOST_PAIRS;
        let mut found: Vec<Crossing> = Vec::new();
        for (first, second) in near.into_iter().take(MOST_PAIRS) {
            if found.len() == MOST || self.is_exhausted() {
                break;
            }
            // At a joint of two blocks one crossing is met by each of them, and at both ends of a stretch that the two share.
            let is_known = |at: Point| {
                let same = |known: &&Crossing| {
                    known.first.abs_diff(first) <= 1 && second - known.second <= MOST_ALONG
                };
                let lies_on = |index: usize, at: Point| {
                    self.at(index)
                        .is_some_and(|piece| piece.distance_to(at) <= self.margin)
                };
                let runs_along = |index: usize| {
                    self.at(index).is_some_and(|piece| {
                        lies_on(first, piece.start()) && lies_on(first, piece.end())
                    })
                };
                let is_one = |known: &Crossing| {
                    if second - known.second > 1 {
                        return (known.second + 1..second).all(runs_along);
                    }
                    let middle = nalgebra::center(&known.at, &at);
                    (known.at - at).norm() <= 4.0 * self.margin
                        || (lies_on(first, middle)
                            && (lies_on(second, middle) || lies_on(known.second, middle)))
                };
                found.iter().rev().take(8).filter(same).any(is_one)
            };
            let at = self
                .common(first, second)
                .into_iter()
                .find(|&at| !is_known(at) && self.crosses(first, second, at));
            found.extend(at.map(|at| Crossing { first, second, at }));
        }
        let is_all = is_all && !self.is_exhausted();
        (found, is_all)
    }

    /// The places that two pieces have in common, each once.
    fn common(&self, first: usize, second: usize) -> Vec<Point> {
        let (Some(a), Some(b)) = (self.at(first), self.at(second)) else {
            return Vec::new();
        };
        let mut places = meetings(&a, &b);
        places.extend(
            [b.start(), b.end()]
                .into_iter()
                .filter(|&end| a.distance_to(end) <= ON),
        );
        places.extend(
            [a.start(), a.end()]
                .into_iter()
                .filter(|&end| b.distance_to(end) <= ON),
        );
        let mut distinct: Vec<Point> = Vec::with_capacity(places.len());
        for place in places {
            if !distinct.contains(&place) {
                distinct.push(place);
            }
        }
        distinct
    }

    /// Whether the way through `at` in one piece crosses the way there in another.
    fn crosses(&self, first: usize, second: usize, at: Point) -> bool {
        if self.is_of_leads(first, second, at) {
            return false;
        }
        let (Some(one), Some(other)) = (self.stand(first, at), self.stand(second, at)) else {
            return false;
        };
        let mut reach = 4.0 * self.margin;
        for _ in 0..DOUBLINGS {
            // Beyond a third of the loop between the two it is another part of the loop.
            if self.is_shorter(&one, &other, 3.0 * reach) {
                return false;
            }
            let (Some(one), Some(other)) = (self.ends(&one, reach), self.ends(&other, reach))
            else {
                return false;
            };
            if let Some(alternate) = alternate(at, one, other, self.margin) {
                return alternate;
            }
            reach *= 2.0;
        }
        false
    }

    /// A place on a piece.
    fn stand(&self, index: usize, at: Point) -> Option<Stand> {
        let piece = self.at(index)?;
        Some(Stand {
            index,
            share: piece.share_of(at).clamp(0.0, 1.0),
            length: piece.length(),
            piece,
        })
    }

    /// Whether the way from a place on one piece to a place on a later one is shorter than `length`.
    fn is_shorter(&self, one: &Stand, other: &Stand, length: f64) -> bool {
        let mut sum = one.length * (1.0 - one.share) + other.length * other.share;
        for index in one.index + 1..other.index {
            if sum >= length {
                return false;
            }
            if self.is_exhausted() {
                return true;
            }
            sum += self.at(index).map_or(0.0, |piece| piece.length());
        }
        sum < length
    }

    /// The way `reach` before and after a place on one of its pieces, or its ends; `None` where an end is at the
    /// place.
    fn ends(&self, stand: &Stand, reach: f64) -> Option<[Point; 2]> {
        Some([
            self.along(stand, reach, false)?,
            self.along(stand, reach, true)?,
        ])
    }

    fn along(&self, stand: &Stand, reach: f64, is_forward: bool) -> Option<Point> {
        let mut stand = *stand;
        let mut left = reach;
        loop {
            let Stand {
                index,
                piece,
                share,
                length,
            } = stand;
            let rest = length * if is_forward { 1.0 - share } else { share };
            if rest >= left && length > 0.0 {
                let by = left / length;
                return Some(piece.point_at(if is_forward { share + by } else { share - by }));
            }
            if self.is_exhausted() {
                return None;
            }
            left -= rest;
            let next = if is_forward {
                index.checked_add(1)
            } else {
                index.checked_sub(1)
            };
            match next.and_then(|next| Some((next, self.at(next)?))) {
                Some((index, piece)) => {
                    stand = Stand {
                        index,
                        share: if is_forward { 0.0 } else { 1.0 },
                        length: piece.length(),
                        piece,
                    };
                }
                None => {
                    let end = if is_forward {
                        piece.end()
                    } else {
                        piece.start()
                    };
                    return (reach - left > self.margin).then_some(end);
                }
            }
        }
    }
}

/// A place on a piece of a way.
#[derive(Clone, Copy)]
struct Stand {
    index: usize,
    piece: Segment,
    /// Of its length, 0 … 1.
    share: f64,
    length: f64,
}

/// Whether the ends of two branches alternate round a place; `None` where two are too near each other to tell.
fn alternate(at: Point, one: [Point; 2], other: [Point; 2], margin: f64) -> Option<bool> {
    let one = one.map(|end| end - at);
    let other = other.map(|end| end - at);
    let lie_together = |a: &Vector, b: &Vector| {
        let across = crate::geometry::cross(*a, *b).abs() / a.norm().max(b.norm()).max(margin);
        a.dot(b) > 0.0 && across <= margin
    };
    let is_near = |end: &Vector| end.norm() <= margin;
    if one.iter().chain(&other).any(is_near)
        || one.iter().any(|a| other.iter().any(|b| lie_together(a, b)))
    {
        return None;
    }
    let angle = |end: Vector| positive_angle(end.y.atan2(end.x) - one[0].y.atan2(one[0].x));
    let between = other.map(|end| angle(end) < angle(one[1]));
    Some(between[0] != between[1])
}

#[cfg(test)]
mod tests;
