//! Where a block does not follow the way of the wire: which block is wrong, and where the program goes on.
//!
//! A block may be wrong, lost, there twice, or exchanged with the next one. A machine that counts goes on from wherever it
//! then stands, an absolute program from its next coordinate. So each of the next blocks is laid at each corner of the way
//! that is near, and the right place is the one that leaves out the fewest blocks and pieces, and from which the next
//! blocks follow.

use super::TOLERANCE;
use super::walk::{At, Walk};
use crate::geometry::{Point, Vector};

/// So many blocks have to follow, or all that are left.
const ENOUGH: usize = 3;
/// Corners that are tried before the place, and behind it.
const BEFORE: usize = 2;
const BEHIND: usize = 8;
/// Blocks that are left out at most: where a corner of the drawing is elsewhere, two sides and what goes round between.
const LEFT_OUT: usize = 4;
/// A radius is that of an arc of the way within this, µm.
const RADIUS: f64 = 3.0;

/// How a program goes on after a wrong block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Resumed {
    /// The wrong block, and how far it is off, µm.
    pub(super) wrong: usize,
    pub(super) off: f64,
    /// The block that follows again, and where.
    pub(super) next: usize,
    pub(super) at: At,
}

impl Walk<'_> {
    /// From a block on that does not follow at a place. `last`: the block before it, which does.
    pub(super) fn resume(
        &self,
        block: usize,
        at: At,
        last: Option<usize>,
        complete: f64,
    ) -> Option<Resumed> {
        let mut best: Option<((usize, usize), f64, usize, At)> = None;
        let mut next = Some(block);
        for left_out in 0..=LEFT_OUT {
            let Some(index) = next else { break };
            for place in self.places(index, at, left_out) {
                let is_still =
                    left_out == 0 && (place.shift - at.shift).norm() <= self.within / 2.0;
                if is_still && (place.along - at.along).abs() <= self.within {
                    continue;
                }
                let [from, to] = [
                    at.along.min(place.along) + self.within,
                    at.along.max(place.along) + self.within,
                ];
                let pieces = self.corners(from, to).len();
                let edits = (left_out.max(pieces).max(1), left_out);
                let off = (place.shift - at.shift).norm();
                let is_better = best.is_none_or(|(least, least_off, ..)| {
                    edits < least || edits == least && off < least_off - 1e-6
                });
                if is_better && self.goes_on(index, place, complete) {
                    best = Some((edits, off, index, place));
                }
            }
            // After a stop the wire goes over to another pass.
            next = self.next(index + 1).filter(|next| *next == index + 1);
        }
        let (_, off, next, place) = best?;
        // What follows from elsewhere is right: the block before it led there, or one between is lost.
        let is_lost = place.along > at.along + self.within && self.is_corner(at);
        let ends_amid =
            !self.is_corner(at) && (!self.runs_along(block, at) || self.begins_aside(block, at));
        let before = last.filter(|_| if next == block { !is_lost } else { ends_amid });
        let wrong = before.unwrap_or(block);
        // Where the next one lies as before, it is the block itself that is off.
        let off = if off > self.within {
            off
        } else {
            self.off(wrong, at)
        };
        Some(Resumed {
            wrong,
            off,
            next,
            at: place,
        })
    }

    /// An arc begins beside its place on the way by as much as its centre does: what leads to it is wrong.
    fn begins_aside(&self, block: usize, at: At) -> bool {
        if self.blocks.get(block).is_some_and(|block| block.is_lost) {
            return true;
        }
        let piece = self.ring.between(at.along, at.along).last();
        let is_arc = self
            .segment(block)
            .is_some_and(|own| own.as_arc().is_some());
        let centre = piece.and_then(|(_, piece)| Some(piece.segment.as_arc()?.center));
        let own = self
            .segment(block)
            .filter(|_| is_arc)
            .and_then(|own| Some((own.start(), own.as_arc()?.center)));
        let Some((centre, (start, own))) = centre.zip(own) else {
            return false;
        };
        let shift = centre - own;
        let begins = self
            .ring
            .nearest(start + shift, at.along - 1e5, at.along + 1e5);
        (shift - at.shift).norm() > self.within
            && begins.is_some_and(|(_, away)| away <= self.within)
    }

    /// Enough blocks follow from one on.
    pub(super) fn goes_on(&self, index: usize, at: At, complete: f64) -> bool {
        // Of four sides two may be wrong.
        let enough = ENOUGH.min(self.ring.pieces.len() / 2).max(1);
        let followed = self.count(index, at, enough, complete);
        followed.count >= enough || followed.count > 0 && followed.along >= complete
    }

    /// The corners between two places along the way, each with how far along it is.
    pub(super) fn corners(&self, from: f64, to: f64) -> Vec<(f64, Point)> {
        let all = self
            .ring
            .between(from, to)
            .filter(|(along, _)| *along >= from);
        all.map(|(along, piece)| (along, piece.segment.start()))
            .collect()
    }

    /// Where a block may be laid, of those that are near a place.
    fn places(&self, index: usize, at: At, left_out: usize) -> Vec<At> {
        let mut all = Vec::new();
        let Some(own) = self.segment(index) else {
            return all;
        };
        let here = self.ring.index(at.along);
        let before = self.ring.pieces.iter().take(here + 1).rev().take(BEFORE);
        let from = at.along - before.map(|piece| piece.segment.length()).sum::<f64>() - self.within;
        let near = self.ring.between(from, f64::INFINITY).take(BEFORE + BEHIND);
        let near: Vec<_> = near.collect();
        let to = near.last().map_or(at.along, |(along, _)| *along);
        if let Some((along, away)) =
            self.ring
                .nearest(own.start() + at.shift, at.along - self.within, to)
            && away <= self.within
        {
            all.push(At { along, ..at });
        }
        if !self.is_relative || left_out > 2 {
            return all;
        }
        for (along, piece) in near {
            all.extend(self.laid(index, along, piece));
        }
        all.retain(|place| place.along >= from);
        all
    }

    /// A block laid with its begin or its end on the corner where a piece begins, or about the centre of the piece.
    pub(super) fn laid(&self, index: usize, along: f64, piece: &super::ring::Piece) -> Vec<At> {
        let Some(own) = self.segment(index) else {
            return Vec::new();
        };
        let corner = piece.segment.start();
        let mut all = vec![
            At {
                along,
                shift: corner - own.start(),
            },
            At {
                along: along - own.length(),
                shift: corner - own.end(),
            },
        ];
        if let (Some(arc), Some(other)) = (own.as_arc(), piece.segment.as_arc())
            && (other.radius - arc.radius).abs() <= RADIUS
            && other.sweep * arc.sweep > 0.0
        {
            let shift = other.center - arc.center;
            let share = piece.segment.share_of(own.start() + shift).clamp(0.0, 1.0);
            all.push(At {
                along: along + share * piece.segment.length(),
                shift,
            });
        }
        let begins =
            |at: &At| (self.place(at.along) - own.start() - at.shift).norm() <= self.within;
        all.retain(begins);
        all
    }

    /// A corner of the way is at a place.
    pub(super) fn is_corner(&self, at: At) -> bool {
        !self
            .corners(at.along - self.within, at.along + self.within)
            .is_empty()
    }

    /// By how much a block that follows has drifted from the way at its end: a machine that counts ends beside its place.
    pub(super) fn drift(&self, block: usize, at: At) -> Vector {
        let Some(own) = self.segment(block) else {
            return Vector::zeros();
        };
        // Along an arc; a line ends where it says.
        let most = match own.as_arc() {
            Some(_) => self.within,
            None => TOLERANCE,
        };
        let drift = self.place(at.along) - (own.end() + at.shift);
        if drift.norm() <= most {
            drift
        } else {
            Vector::zeros()
        }
    }

    /// How far a block is off that begins at a place: its end or its middle from the way, or its end from the next
    /// corner.
    pub(super) fn off(&self, block: usize, at: At) -> f64 {
        let Some(own) = self.segment(block).map(|own| own.moved(at.shift)) else {
            return 0.0;
        };
        let (from, to) = (
            at.along - 2.0 * own.length(),
            at.along + 2.0 * own.length() + 100.0,
        );
        let away = |place: Point| {
            self.ring
                .nearest(place, from, to)
                .map_or(0.0, |(_, away)| away)
        };
        let aside = away(own.end()).max(away(own.point_at(0.5)));
        if aside > self.within {
            return aside;
        }
        let corners = self.corners(from, to);
        let apart = |(_, corner): &(f64, Point)| (corner - own.end()).norm();
        let nearest = corners.iter().map(apart).fold(f64::INFINITY, f64::min);
        if nearest.is_finite() {
            aside.max(nearest)
        } else {
            aside
        }
    }
}
