//! Goes along a ring with the blocks of a program.

use super::budget::Budget;
use super::ring::Ring;
use super::traced::{Block, Motion};
use crate::geometry::{Point, Segment, Vector};
use std::ops::Range;

/// How far a block may be from the ring, µm: [`TOLERANCE`](super::TOLERANCE), and what the rounding of both to the grid
/// explains.
pub(super) const WITHIN: f64 = 4.0;
/// The same where transitions of 4B are rounded otherwise, or a counting machine has drifted along arcs.
pub(super) const WITHIN_FOUR_B: f64 = 6.0;
/// By how much a block may be longer than its part of the ring, which is cut off at its corners: µm, and a share.
const LONGER: f64 = 12.0;
const SHARE: f64 = 0.005;
/// Where along a block it is compared.
const SHARES: [f64; 3] = [0.25, 0.5, 0.75];
/// A block runs along the way where the cosine between them is at least this.
const ALONG: f64 = 0.98;
/// A corner turns at least by this, radians.
const SHARP: f64 = 0.1;
/// An arc that rounds a corner is tangent to both sides within this, radians.
const TANGENT: f64 = 0.03;
/// What is shorter of a ring counts as cut, µm.
pub(super) const COVERED: f64 = 8.0;

/// A place of the program on its ring.
#[derive(Clone, Copy, Debug)]
pub(super) struct At {
    /// Along the ring, which is counted on after its end.
    pub(super) along: f64,
    /// From the program's places to those of the drawing.
    pub(super) shift: Vector,
}

/// What follows from a block on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Followed {
    pub(super) count: usize,
    /// Where the last of these ends along the ring.
    pub(super) along: f64,
}

/// The blocks of a pass and the ring that they follow.
pub(super) struct Walk<'a> {
    pub(super) ring: &'a Ring,
    pub(super) blocks: &'a [Block],
    /// The blocks of the pass, by their numbers.
    pub(super) range: Range<usize>,
    pub(super) within: f64,
    /// The machine counts from block to block, and so drifts along arcs.
    pub(super) counts: bool,
    /// Every block begins where the one before ended, wherever that is.
    pub(super) is_relative: bool,
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
        let stops = rest
            .take_while(|block| block.motion == Motion::Stop)
            .count();
        let next = index + stops;
        self.segment(next).map(|_| next)
    }

    /// Where along the ring a block ends that begins at a place and lies on the ring.
    pub(super) fn follow(&self, index: usize, at: At) -> Option<f64> {
        let block = self.blocks.get(index)?;
        let own = self.segment(index)?.moved(at.shift);
        let slack = LONGER + SHARE * own.length();
        let to = at.along + own.length();
        let steps = 4 + self.ring.between(at.along, to + slack).count();
        if !self.budget.take(steps) {
            return None;
        }
        let (end, away) = self.ring.nearest(own.end(), to - slack, to + slack)?;
        let is_backward = end < at.along - self.within;
        if away > self.within || is_backward {
            return None;
        }
        let (from, until) = (at.along - slack, end + slack);
        let lies = |share: f64| {
            let middle = own.point_at(share);
            let near = at.along + share * (end - at.along);
            let [from, until] = [
                (near - 3.0 * slack).max(from),
                (near + 3.0 * slack).min(until),
            ];
            let near = self.ring.nearest(middle, from, until);
            near.is_some_and(|(_, away)| away <= self.within)
        };
        // A radius that is rounded moves the middle of its arc by more.
        let is_on = block.by_radius || SHARES.into_iter().all(lies);
        let passes = || {
            let inside = self.ring.between(at.along + slack, end - slack);
            let mut corners =
                inside.filter(|(before, _)| *before > at.along + slack && *before < end - slack);
            corners.all(|(_, piece)| {
                own.distance_to(piece.segment.start()) <= self.within || block.by_radius
            })
        };
        (is_on && passes()).then_some(end.max(at.along))
    }

    /// How many blocks follow from one on, at most so many, or to where `complete` is reached along the ring.
    pub(super) fn count(&self, index: usize, at: At, most: usize, complete: f64) -> Followed {
        let mut followed = Followed {
            count: 0,
            along: at.along,
        };
        let mut index = index;
        while followed.count < most && followed.along < complete {
            let Some(next) = self.next(index) else {
                break;
            };
            let along = followed.along;
            let Some(end) = self.follow(next, At { along, ..at }) else {
                break;
            };
            (followed.along, index) = (end, next + 1);
            followed.count += 1;
        }
        followed
    }

    /// The point at a place along the ring.
    pub(super) fn place(&self, along: f64) -> Point {
        let piece = self.ring.between(along, along).last();
        piece.map_or(Point::origin(), |(before, piece)| {
            let share = (along - before) / piece.segment.length();
            piece.segment.point_at(share.clamp(0.0, 1.0))
        })
    }

    /// Whether a block that begins at a place runs along the ring, as far as its first length tells.
    pub(super) fn runs_along(&self, block: usize, at: At) -> bool {
        // Where it leads is not known.
        if self.blocks.get(block).is_some_and(|block| block.is_lost) {
            return true;
        }
        let Some((own, (_, piece))) = self
            .segment(block)
            .zip(self.ring.between(at.along, at.along).last())
        else {
            return false;
        };
        let share = piece
            .segment
            .share_of(own.start() + at.shift)
            .clamp(0.0, 1.0);
        let mut ways = vec![piece.segment.tangent_at(share)];
        // At a corner also on from there.
        let next = self
            .ring
            .between(at.along + self.within, at.along + self.within)
            .last();
        ways.extend(next.map(|(_, next)| next.segment.tangent_at(0.0)));
        let along = ways.into_iter().map(|way| way.dot(&own.start_tangent()));
        along.fold(-1.0, f64::max) >= ALONG
    }

    /// Where the program goes on after an arc that rounds a sharp corner of the ring, tangent to both of its sides.
    pub(super) fn round_corner(&self, block: usize, at: At, deepest: f64) -> Option<f64> {
        let own = self.segment(block)?.moved(at.shift);
        own.as_arc()?;
        let piece = self.ring.pieces.get(self.ring.index(at.along))?;
        let share = piece.segment.share_of(own.start()).clamp(0.0, 1.0);
        let to = at.along + 2.0 * own.length() + 10.0;
        let (along, away) = self.ring.nearest(own.end(), at.along, to)?;
        let behind = self.ring.pieces.get(self.ring.index(along))?;
        let end = behind.segment.share_of(own.end()).clamp(0.0, 1.0);
        // A corner lies between two pieces in sequence.
        let count = self.ring.pieces.len();
        if (self.ring.index(at.along) + 1) % count != self.ring.index(along) {
            return None;
        }
        let turn = |one: Vector, other: Vector| {
            (one.x * other.y - one.y * other.x)
                .atan2(one.dot(&other))
                .abs()
        };
        let corner = turn(piece.segment.end_tangent(), behind.segment.start_tangent());
        if corner < SHARP {
            return None;
        }
        let is_tangent = turn(piece.segment.tangent_at(share), own.start_tangent()) <= TANGENT
            && turn(behind.segment.tangent_at(end), own.end_tangent()) <= TANGENT;
        let (_, depth) = self.ring.nearest(own.point_at(0.5), at.along, to)?;
        let is_ahead = along > at.along + self.within;
        (is_tangent && is_ahead && away <= self.within && depth <= deepest).then_some(along)
    }

    /// Whether a block that ends at a place runs along the ring there, as far as its last length tells.
    pub(super) fn runs_into(&self, block: &Segment, at: At) -> bool {
        let along = at.along
            + if self.ring.closed {
                self.ring.length
            } else {
                0.0
            }
            - self.within;
        let Some((before, piece)) = self.ring.between(along, along).last() else {
            return false;
        };
        let share = ((along - before) / piece.segment.length()).clamp(0.0, 1.0);
        piece.segment.tangent_at(share).dot(&block.end_tangent()) >= ALONG
    }

    /// How far a point is from the whole ring.
    pub(super) fn away(&self, point: Point) -> f64 {
        let near = self
            .ring
            .nearest(point, 0.0, self.ring.length * (1.0 - 1e-12));
        near.map_or(0.0, |(_, away)| away)
    }
}
