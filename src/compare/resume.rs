//! Where a block does not follow the ring: which block is wrong, and where the program goes on.
//!
//! A machine that counts goes on from wherever it stands, an absolute program from its next coordinate, and a block may be
//! lost, stand twice, or be exchanged. Each of these is tried, at the corners of the ring that are near; the first that
//! leaves the fewest blocks out, and of these the one with the smallest deviation, from which the next blocks follow.

use super::walk::{At, COVERED, Walk};
use crate::geometry::{Point, Segment, Vector};

/// So many blocks have to follow, or all that are left.
const ENOUGH: usize = 3;
/// Corners that are tried before the place, and behind it.
const BEFORE: usize = 2;
const BEHIND: usize = 8;
/// Blocks that are left out where a corner of the drawing is elsewhere: two sides, and what goes round between them.
const MOST_LEFT_OUT: usize = 4;
/// A block runs along the ring where the cosine between them is at least this.
const ALONG: f64 = 0.98;
/// A radius is that of an arc of the ring within this, µm.
const RADIUS: f64 = 3.0;
/// A corner turns at least by this, radians.
const SHARP: f64 = 0.1;
/// An arc that rounds a corner is tangent to both sides within this, radians.
const TANGENT: f64 = 0.03;

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

/// One way to explain it.
#[derive(Clone, Copy, Debug)]
struct Guess {
    next: usize,
    at: At,
    wrong: usize,
    off: f64,
    /// The contour is closed behind it.
    is_last: bool,
}

impl Walk<'_> {
    /// From a block on that does not follow at a place. `last`: the block before it, which does. `complete`: where along
    /// the ring the pass is done.
    pub(super) fn resume(
        &self,
        block: usize,
        at: At,
        last: Option<usize>,
        complete: f64,
    ) -> Option<Resumed> {
        let mut best: Option<(usize, f64, Guess)> = None;
        for guess in self.guesses(block, at, last, complete) {
            let followed = self.count(guess.next, guess.at, ENOUGH, complete);
            let is_done = followed.along >= complete && followed.count > 0 || guess.is_last;
            if followed.count < ENOUGH && !is_done {
                continue;
            }
            let left_out = guess.next - block;
            let is_better = best.is_none_or(|(least, off, _)| {
                left_out < least || left_out == least && guess.off < off - 1e-6
            });
            if is_better {
                best = Some((left_out, guess.off, guess));
            }
        }
        best.map(|(_, _, guess)| Resumed {
            wrong: guess.wrong,
            off: guess.off,
            next: guess.next,
            at: guess.at,
        })
    }

    /// Corners of the ring about a place, each with how far along it is.
    fn corners(&self, along: f64) -> Vec<(f64, Point)> {
        let here = self.ring.index(along);
        let before = self.ring.pieces.iter().take(here + 1).rev().take(BEFORE);
        let back: f64 = before.map(|piece| piece.segment.length()).sum();
        let all = self.ring.between(along - back - self.within, f64::INFINITY);
        let all = all.take(BEFORE + BEHIND);
        all.map(|(before, piece)| (before, piece.segment.start()))
            .collect()
    }

    fn guesses(&self, block: usize, at: At, last: Option<usize>, complete: f64) -> Vec<Guess> {
        let mut all = Vec::new();
        let corners = self.corners(at.along);
        let Some(own) = self.segment(block) else {
            return all;
        };
        let ends_within = self.ends_within(at, own);
        let wrong_before = last.filter(|_| ends_within);
        let next = self.next(block + 1);
        for (along, corner) in corners.iter().copied() {
            // This block is right, from another corner.
            let shift = corner - own.start();
            all.push(Guess {
                next: block,
                at: At { along, shift },
                wrong: wrong_before.unwrap_or(block),
                off: (shift - at.shift).norm(),
                is_last: false,
            });
            let Some((next, behind)) = next.and_then(|next| Some((next, self.segment(next)?)))
            else {
                continue;
            };
            // This block leads elsewhere than to this corner.
            let shift = corner - behind.start();
            if (shift - at.shift).norm() <= self.within {
                continue;
            }
            all.push(Guess {
                next,
                at: At { along, shift },
                wrong: block,
                off: (shift - at.shift).norm(),
                is_last: false,
            });
        }
        all.extend(self.last(block, at, complete));
        all.extend(self.by_centre(block, at, wrong_before.unwrap_or(block)));
        if let Some(next) = next {
            all.extend(self.by_centre(next, at, block));
            all.push(self.twice(block, next, at));
        }
        // The coordinates after it are right.
        let mut next = next;
        let mut length = own.length();
        for nth in 0..MOST_LEFT_OUT {
            let Some((index, behind)) = next.and_then(|next| Some((next, self.segment(next)?)))
            else {
                break;
            };
            let close = self.place(complete + COVERED) - (behind.end() + at.shift);
            if close.norm() <= self.within && complete - at.along <= 2.0 * length {
                all.push(Guess {
                    next: index + 1,
                    at: At {
                        along: complete,
                        ..at
                    },
                    wrong: block,
                    off: self.off(block, at),
                    is_last: true,
                });
            }
            length += behind.length();
            let to = at.along + 4.0 * own.length() + 4.0 * behind.length();
            let start = behind.start() + at.shift;
            if let Some((along, away)) = self.ring.nearest(start, at.along - self.within, to)
                && away <= self.within
            {
                let before = wrong_before.filter(|_| nth == 0);
                // It ends short of a corner, or beyond it.
                let aside = corners
                    .iter()
                    .map(|(_, corner)| (corner - own.start() - at.shift).norm());
                let aside = aside.fold(f64::INFINITY, f64::min);
                all.push(Guess {
                    next: index,
                    at: At { along, ..at },
                    wrong: before.unwrap_or(block),
                    off: if before.is_some() {
                        aside
                    } else {
                        self.off(block, at)
                    },
                    is_last: false,
                });
            }
            next = self.next(index + 1);
        }
        all
    }

    /// A block that should close the contour: it runs along it, and ends near where that began.
    fn last(&self, block: usize, at: At, complete: f64) -> Option<Guess> {
        let own = self.segment(block)?;
        let next = self.next(block + 1).unwrap_or(self.range.end);
        let close = complete + COVERED;
        let (_, piece) = self.ring.between(at.along, at.along).last()?;
        let share = piece
            .segment
            .share_of(own.start() + at.shift)
            .clamp(0.0, 1.0);
        let along = piece.segment.tangent_at(share).dot(&own.start_tangent());
        let off = self.place(close) - (own.end() + at.shift);
        let shift = at.shift + off;
        let is_last = along >= 1.0 - TANGENT && off.norm() <= own.length() / 4.0;
        is_last.then_some(Guess {
            next,
            at: At {
                along: complete,
                // What is left leads out; an absolute program lies where it did.
                shift: if self.counts { shift } else { at.shift },
            },
            wrong: block,
            off: off.norm(),
            is_last: true,
        })
    }

    /// A block that is the one before once more.
    fn twice(&self, block: usize, next: usize, at: At) -> Guess {
        let by = self
            .segment(block)
            .map_or(Vector::zeros(), |own| own.end() - own.start());
        let shift = at.shift - by;
        Guess {
            next,
            at: At { shift, ..at },
            wrong: block,
            off: by.norm(),
            is_last: false,
        }
    }

    /// Where an arc lies about the centre of one of the ring.
    fn by_centre(&self, next: usize, at: At, wrong: usize) -> Vec<Guess> {
        let Some(own) = self.segment(next) else {
            return Vec::new();
        };
        let Some(arc) = own.as_arc() else {
            return Vec::new();
        };
        let pieces = self.ring.between(at.along, f64::INFINITY).take(BEHIND);
        let near = pieces.filter_map(|(before, piece)| {
            let other = piece.segment.as_arc()?;
            let is_it =
                (other.radius - arc.radius).abs() <= RADIUS && other.sweep * arc.sweep > 0.0;
            let shift = other.center - arc.center;
            let share = piece.segment.share_of(own.start() + shift).clamp(0.0, 1.0);
            is_it.then_some(Guess {
                next,
                at: At {
                    along: before + share * piece.segment.length(),
                    shift,
                },
                wrong,
                off: (shift - at.shift).norm(),
                is_last: false,
            })
        });
        near.collect()
    }

    /// The place begins amid a piece of the ring, at no corner of it.
    fn ends_within(&self, at: At, own: &Segment) -> bool {
        let start = own.start() + at.shift;
        let corners = self.corners(at.along);
        corners
            .iter()
            .all(|(_, corner)| (corner - start).norm() > self.within)
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

    /// By how much a block that follows has drifted from the ring at its end: a machine that counts ends beside its place.
    pub(super) fn drift(&self, block: usize, at: At) -> Vector {
        let end = self.segment(block).map(|own| own.end() + at.shift);
        let drift = end.map(|end| self.place(at.along) - end);
        drift
            .filter(|drift| drift.norm() <= self.within)
            .unwrap_or_default()
    }

    /// How far a block is off that begins at a place: its end or its middle from the ring, or its end from the next
    /// corner.
    pub(super) fn off(&self, block: usize, at: At) -> f64 {
        let Some(own) = self.segment(block).map(|own| own.moved(at.shift)) else {
            return 0.0;
        };
        let to = at.along + 2.0 * own.length() + 100.0;
        let away = |place: Point| {
            let near = self.ring.nearest(place, at.along - self.within, to);
            near.map_or(0.0, |(_, away)| away)
        };
        let aside = away(own.end()).max(away(own.point_at(0.5)));
        if aside > self.within {
            return aside;
        }
        let corners = self.corners(at.along);
        let ends = [own.start(), own.end()].into_iter().map(|end| {
            let all = corners.iter().map(|(_, corner)| (corner - end).norm());
            all.fold(f64::INFINITY, f64::min)
        });
        ends.fold(
            aside,
            |off, end| if end.is_finite() { off.max(end) } else { off },
        )
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
}
