//! Goes along a ring with the blocks of a program, and finds where it goes on behind a block that does not follow.
//!
//! An absolute program goes on from its next coordinate. One that counts goes on from where the wrong block has led it:
//! beside its place by as much as its cut ends beside where it begins, or so that its next block begins at a corner.

use super::TOLERANCE;
use super::budget::Budget;
use super::ring::{Piece, Ring};
use super::traced::{Block, Motion};
use crate::geometry::{Point, Segment, Vector};
use std::ops::Range;

/// How far a block may be from the ring, µm: [`TOLERANCE`], and what the rounding of both to the grid explains.
pub(super) const WITHIN: f64 = 4.0;
/// By how much a block may be longer than its part of the ring, which is cut off at its corners: µm, and a share.
const LONGER: f64 = 12.0;
const SHARE: f64 = 0.005;
/// Where along a block it is compared.
const SHARES: [f64; 3] = [0.25, 0.5, 0.75];
/// A block runs along the way where the cosine between them is at least this; an arc that rounds a corner more so.
const ALONG: f64 = 0.98;
const TANGENT: f64 = 0.9995;
/// What is shorter of a ring counts as cut, µm.
pub(super) const COVERED: f64 = 8.0;
/// So many blocks have to follow, or all that are left.
const ENOUGH: usize = 3;
/// Blocks that are left out at most: where a corner of the drawing is elsewhere, two sides and what goes round between.
const LEFT_OUT: usize = 4;
/// A side is off by this at most where a pass begins close to a corner, or lacks some in the end, µm.
const CLOSE: f64 = 1_000.0;
/// Pieces behind the place at which the program may go on.
const BEHIND: usize = 8;

/// A place of the program on its ring.
#[derive(Clone, Copy, Debug)]
pub(super) struct At {
    /// Along the ring, which is counted on after its end.
    pub(super) along: f64,
    /// From the program's places to those of the drawing.
    pub(super) shift: Vector,
}

/// The blocks of a pass and the ring that they follow.
pub(super) struct Walk<'a> {
    pub(super) ring: &'a Ring,
    pub(super) blocks: &'a [Block],
    /// The blocks of the pass, by their numbers.
    pub(super) range: Range<usize>,
    /// How deep an arc may be that rounds a corner, µm.
    pub(super) rounded: f64,
    /// The machine counts from block to block, and so drifts along arcs.
    pub(super) counts: bool,
    /// Where every block begins where the one before ended: how far the cut ends from where it begins.
    pub(super) opening: Option<Vector>,
    pub(super) budget: &'a Budget,
}

impl Walk<'_> {
    pub(super) fn segment(&self, index: usize) -> Option<&Segment> {
        self.blocks
            .get(index)
            .filter(|_| self.range.contains(&index))?
            .segment()
    }

    /// The next block of the pass from `index` on that is a line or an arc; `None` where the wire goes over.
    pub(super) fn next(&self, index: usize) -> Option<usize> {
        let rest = self.blocks.get(index..self.range.end)?.iter();
        let stops = rest.take_while(|block| block.motion == Motion::Stop);
        let next = index + stops.count();
        self.segment(next).map(|_| next)
    }

    /// Where along the ring a block ends that begins at a place and lies on the ring, or rounds its next corner.
    pub(super) fn follow(&self, index: usize, at: At) -> Option<f64> {
        let along = self.lies(index, at);
        along.or_else(|| self.rounds_corner(index, at))
    }

    fn lies(&self, index: usize, at: At) -> Option<f64> {
        let block = self.blocks.get(index)?;
        let own = self.segment(index)?.moved(at.shift);
        let slack = LONGER + SHARE * own.length();
        let to = at.along + own.length();
        let steps = 4 + self.ring.between(at.along, to + slack).count();
        if !self.budget.take(steps) {
            return None;
        }
        let (end, away) = self.ring.nearest(own.end(), to - slack, to + slack)?;
        if away > WITHIN || end < at.along - WITHIN {
            return None;
        }
        let lies = |share: f64| {
            let near = at.along + share * (end - at.along);
            let near =
                self.ring
                    .nearest(own.point_at(share), near - 3.0 * slack, near + 3.0 * slack);
            near.is_some_and(|(_, away)| away <= WITHIN)
        };
        let passes = |(_, corner): (f64, Point)| own.distance_to(corner) <= WITHIN;
        let mut corners = self.corners(at.along + slack, end - slack).into_iter();
        // A radius that is rounded moves the middle of its arc by more.
        let is_on = block.by_radius || SHARES.into_iter().all(lies) && corners.all(passes);
        is_on.then_some(end.max(at.along))
    }

    /// Where an arc ends that rounds a sharp corner of the ring, tangent to both of its sides.
    fn rounds_corner(&self, block: usize, at: At) -> Option<f64> {
        let own = self.segment(block)?.moved(at.shift);
        own.as_arc()?;
        // Where it turns sharply, both sides are longer than it.
        let to = at.along + 8.0 * own.length() + LONGER;
        let (along, away) = self.ring.nearest(own.end(), at.along, to)?;
        let (_, depth) = self.ring.nearest(own.point_at(0.5), at.along, to)?;
        let is_tangent = self.way(at.along).dot(&own.start_tangent()) >= TANGENT
            && self.way(along).dot(&own.end_tangent()) >= TANGENT;
        let is_one = self.corners(at.along, along).len() == 1;
        (is_tangent && is_one && away <= WITHIN && depth <= self.rounded).then_some(along)
    }

    /// How many blocks follow from one on is enough, or all to where the way is complete.
    fn goes_on(&self, mut index: usize, mut at: At, complete: f64) -> bool {
        // Of four sides two may be wrong.
        let enough = ENOUGH.min(self.ring.pieces.len() / 2).max(1);
        for count in 0..enough {
            let followed = self
                .next(index)
                .and_then(|next| Some((next, self.follow(next, at)?)));
            let Some((next, along)) = followed else {
                return count > 0 && at.along >= complete;
            };
            (index, at.along) = (next + 1, along);
        }
        true
    }

    /// The first of some blocks that begins a pass, and where: it begins on the way at one of some places where the
    /// program may lie, and goes on along it; it, or the next one, may be wrong.
    pub(super) fn entry(
        &self,
        blocks: &[usize],
        places: &[Vector],
        is_part: bool,
    ) -> Option<(usize, At)> {
        let whole = self.ring.whole();
        let begins = |index: usize, at: At, along: Option<f64>| {
            let complete = self.complete(at);
            let Some(along) = along else {
                return self.runs_along(index, at) && self.resume(index, at, complete).is_some();
            };
            let Some(next) = self.next(index + 1) else {
                return true;
            };
            let behind = At { along, ..at };
            is_part
                || self.goes_on(index, at, complete)
                || self.resume(next, behind, complete).is_some()
        };
        let mut alone = None;
        for (&index, place) in blocks
            .iter()
            .flat_map(|index| places.iter().map(move |at| (index, at)))
        {
            let Some(at) = self.begun(index, *place, whole) else {
                continue;
            };
            let along = self.follow(index, at);
            if begins(index, at, along) {
                return Some((index, at));
            }
            alone = alone.or(along.map(|_| (index, at)));
        }
        alone
    }

    /// From which block on, and where, the program goes on if a block does not follow at a place: with the fewest left
    /// out.
    pub(super) fn resume(&self, block: usize, at: At, complete: f64) -> Option<(usize, At)> {
        let near: Vec<(f64, &Piece)> = self
            .ring
            .between(at.along, complete + COVERED)
            .take(BEHIND)
            .collect();
        let to = near.last().map_or(at.along, |(along, _)| *along);
        let mut next = Some(block);
        for _ in 0..=LEFT_OUT {
            let index = next?;
            let start = self.segment(index)?.start();
            let corners = near.iter().map(|(_, piece)| piece.segment.start() - start);
            let moved = self.opening.map(|by| [at.shift - by, at.shift + by]);
            let moved = moved.map(|moved| moved.into_iter().chain(corners));
            let mut places = std::iter::once(at.shift).chain(moved.into_iter().flatten());
            let found = places.find_map(|place| {
                // Ahead of there, or where a block that was too long has led beyond.
                let back = at.along - WITHIN - (place - at.shift).norm();
                let ahead = [at.along - WITHIN, to];
                let begun = |part| self.begun(index, place, part);
                let place = begun(ahead).or_else(|| begun([back, at.along]))?;
                let moved = (place.shift - at.shift).norm();
                let is_at = (place.along - at.along).abs() <= WITHIN;
                let is_still = index == block && moved <= WITHIN / 2.0 && is_at;
                // Less than a wrong block leads astray, and more than a machine drifts.
                let is_doubtful = moved > WITHIN && moved <= 2.0 * WITHIN;
                // By as much as a side is off, what closes the pass lacks some.
                let complete = complete - if moved <= CLOSE { moved } else { 0.0 };
                let goes_on = !is_still && !is_doubtful && self.goes_on(index, place, complete);
                goes_on.then_some((index, place))
            });
            if found.is_some() {
                return found;
            }
            // After a stop the wire goes over to another pass.
            next = self.next(index + 1).filter(|next| *next == index + 1);
        }
        None
    }

    /// The place on a part of the way where a block begins.
    fn begun(&self, index: usize, shift: Vector, [from, to]: [f64; 2]) -> Option<At> {
        if !self.budget.take(self.ring.between(from, to).count()) {
            return None;
        }
        let start = self.segment(index)?.start() + shift;
        let (along, away) = self.ring.nearest(start, from, to)?;
        // A machine that counts has drifted there.
        let (reach, drift) = match self.counts {
            true => (2.0 * WITHIN, self.place(along) - start),
            false => (WITHIN, Vector::zeros()),
        };
        (away <= reach).then_some(At {
            along,
            shift: shift + drift,
        })
    }

    /// The corner close to which a block begins, where what comes before a block moves it.
    pub(super) fn at_corner(&self, index: usize, at: At) -> Option<At> {
        self.opening?;
        let start = self.segment(index)?.start();
        let corners = self.corners(at.along - CLOSE, at.along + CLOSE).into_iter();
        let near = corners.map(|(along, corner)| At {
            along,
            shift: corner - start,
        });
        let away = |place: &At| (place.shift - at.shift).norm();
        let near = near.min_by(|one, other| away(one).total_cmp(&away(other)))?;
        (WITHIN..CLOSE).contains(&away(&near)).then_some(near)
    }

    /// Where the way is complete that is begun at a place.
    pub(super) fn complete(&self, at: At) -> f64 {
        let from = if self.ring.closed { at.along } else { 0.0 };
        from + self.ring.length - COVERED
    }

    /// The point at a place along the ring, and which way it goes there.
    pub(super) fn place(&self, along: f64) -> Point {
        self.at(along)
            .map_or(Point::origin(), |(segment, share)| segment.point_at(share))
    }

    fn way(&self, along: f64) -> Vector {
        self.at(along).map_or(Vector::zeros(), |(segment, share)| {
            segment.tangent_at(share)
        })
    }

    fn at(&self, along: f64) -> Option<(&Segment, f64)> {
        let (before, piece) = self.ring.between(along, along).last()?;
        let share = (along - before) / piece.segment.length();
        Some((&piece.segment, share.clamp(0.0, 1.0)))
    }

    /// Whether a block that begins at a place runs along the ring, as far as its first length tells.
    pub(super) fn runs_along(&self, block: usize, at: At) -> bool {
        // Where it leads is not known.
        let is_lost = self.blocks.get(block).is_some_and(|block| block.is_lost);
        let runs = |own: &Segment| {
            // At a corner also on from there.
            let ways = [at.along, at.along + WITHIN].map(|along| self.way(along));
            ways.into_iter()
                .any(|way| way.dot(&own.start_tangent()) >= ALONG)
        };
        is_lost || self.segment(block).is_some_and(runs)
    }

    /// Whether a block runs along the ring where it ends, just before a place.
    pub(super) fn runs_into(&self, block: &Segment, at: At) -> bool {
        let turn = if self.ring.closed {
            self.ring.length
        } else {
            0.0
        };
        self.way(at.along + turn - WITHIN).dot(&block.end_tangent()) >= ALONG
    }

    /// The corners between two places along the way, each with how far along it is.
    pub(super) fn corners(&self, from: f64, to: f64) -> Vec<(f64, Point)> {
        let all = self
            .ring
            .between(from, to)
            .filter(|(along, _)| *along > from);
        all.map(|(along, piece)| (along, piece.segment.start()))
            .collect()
    }

    /// A corner of the way is at a place.
    pub(super) fn is_corner(&self, at: At) -> bool {
        let [from, to] = [-WITHIN, WITHIN].map(|by| at.along + by);
        !self.corners(from, to).is_empty()
    }

    /// By how much a block that follows has drifted from the way at its end: a machine that counts ends beside its place.
    pub(super) fn drift(&self, block: usize, at: At) -> Vector {
        let Some(own) = self.segment(block).filter(|_| self.counts) else {
            return Vector::zeros();
        };
        // Along an arc; a line ends where it says.
        let most = match own.as_arc() {
            Some(_) => WITHIN,
            None => TOLERANCE,
        };
        let drift = self.place(at.along) - (own.end() + at.shift);
        match drift.norm() <= most {
            true => drift,
            false => Vector::zeros(),
        }
    }

    /// How far a block is off that begins at a place: its end or its middle from the way, or its end from the next
    /// corner.
    pub(super) fn off(&self, block: usize, at: At) -> f64 {
        let Some(own) = self.segment(block).map(|own| own.moved(at.shift)) else {
            return 0.0;
        };
        let reach = 2.0 * own.length() + 100.0;
        let (from, to) = (at.along - reach, at.along + reach);
        let away = |place: Point| {
            self.ring
                .nearest(place, from, to)
                .map_or(0.0, |near| near.1)
        };
        let aside = away(own.end()).max(away(own.point_at(0.5)));
        let corners = self.corners(from, to).into_iter();
        let apart = corners.map(|(_, corner)| (corner - own.end()).norm());
        let nearest = apart.reduce(f64::min).filter(|_| aside <= WITHIN);
        aside.max(nearest.unwrap_or(0.0))
    }
}
