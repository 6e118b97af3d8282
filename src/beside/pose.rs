//! Where a program stands beside its drawing, and whether a block follows a piece of it from there.

use super::TOLERANCE;
use super::rounds::{Rounds, Spot};
use super::traced::{Block, Motion, Traced};
use crate::geometry::{Arc, Point, Segment, Vector};
use crate::program::grid::{point_of, snap};
use crate::program::three_b;

/// How a program's places lead to those of the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    /// From the drawing to the program, µm.
    pub shift: Vector,
    /// The shift is of whole µm, and so are the program's nodes.
    pub on_grid: bool,
    /// What is added to the program's places: from where a chain of its blocks leads to the node that is meant.
    lag: Vector,
    /// What arcs have missed their nodes by, together.
    drift: Vector,
    arcs: usize,
}

/// What a block comes to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reached {
    /// Behind the block; `None` at the end of an open round.
    pub spot: Option<Spot>,
    /// It ends at the end of a piece, not within one.
    pub whole: bool,
    /// Along the round, µm.
    pub length: f64,
    /// From where the drawing has its end.
    pub off: Vector,
    end: Point,
}

/// What is left of a piece, or of a block on it, where it ends on the way, µm: less is a wrong length.
const LEAST_PART: f64 = 5.0;
/// An arc that rises by no more over its chord may be a line, µm.
const FLAT: f64 = 1.5;
/// Blocks and pieces of this length come and go with rounding, µm.
const CRUMB: f64 = 2.5;
/// A larger radius is written in chords, µm.
const HUGE: f64 = 1e6;
/// How far an arc may lie from where the drawing has it where its writer had no better one, µm.
const ROUNDED: f64 = 3.3;

impl Pose {
    pub fn at(shift: Vector) -> Pose {
        Pose {
            shift,
            on_grid: false,
            lag: Vector::zeros(),
            drift: Vector::zeros(),
            arcs: 0,
        }
    }

    /// The same by the nodes of a grid.
    pub fn gridded(self) -> Pose {
        Pose {
            on_grid: true,
            ..self
        }
    }

    /// The same where everything behind is moved by so much more.
    pub fn moved(&self, by: Vector) -> Pose {
        let by = if self.on_grid { by.map(f64::round) } else { by };
        Pose {
            shift: self.shift + by,
            drift: Vector::zeros(),
            arcs: 0,
            ..*self
        }
    }

    /// A place of the program in the drawing.
    pub fn place(&self, point: Point) -> Point {
        point + self.lag - self.shift
    }

    /// A place of the drawing in the program, on its grid.
    pub fn program(&self, point: Point) -> Point {
        let point = point + self.shift;
        let point = if self.on_grid {
            point.map(f64::round)
        } else {
            point
        };
        point - self.lag
    }

    /// Where a block begins, in the drawing.
    pub fn begin(&self, block: &Block) -> Option<Point> {
        match &block.motion {
            Motion::Cut(segment) => Some(self.place(segment.start())),
            Motion::Way(start, _) => Some(self.place(*start)),
            Motion::Stop => None,
        }
    }

    /// Goes along a round with one block, up to `entry` where the round comes back to it.
    pub fn follow(
        &mut self,
        rounds: &Rounds,
        traced: &Traced,
        index: usize,
        from: &Spot,
        entry: &Spot,
    ) -> Option<Reached> {
        let block = traced.blocks[index].segment()?;
        let counts = traced.counts && block.as_arc().is_some();
        let kind = (counts, traced.four_b);
        let reached = self.reach(rounds, block, kind, from, entry).or_else(|| {
            // Crumbs are left out by the one or by the other.
            if block.length() <= CRUMB {
                let end = self.place(block.end());
                return Some(Reached {
                    spot: Some(*from),
                    whole: true,
                    length: 0.0,
                    off: Vector::zeros(),
                    end,
                });
            }
            let is_crumb = rounds.whole(from).length() <= CRUMB;
            let next = rounds.next(from).filter(|_| is_crumb)?;
            self.reach(rounds, block, kind, &next, entry)
        })?;
        if counts && reached.whole {
            let meant = reached.end - reached.off;
            let node = if self.on_grid {
                (meant + self.shift).map(f64::round) - self.shift
            } else {
                meant
            };
            let miss = reached.end - node;
            self.lag -= miss;
            self.drift += miss;
            self.arcs += 1;
            let allowed = TOLERANCE + (self.arcs as f64).sqrt();
            if self.drift.norm() > allowed {
                return None;
            }
        }
        Some(reached)
    }

    fn reach(
        &self,
        rounds: &Rounds,
        block: &Segment,
        (counts, four_b): (bool, bool),
        from: &Spot,
        entry: &Spot,
    ) -> Option<Reached> {
        let way = block.moved(self.lag - self.shift);
        let (length, end) = (way.length(), way.end());
        let aside = if counts { ROUNDED } else { TOLERANCE };
        let (mut spot, mut share, mut travelled) = (*from, 0.0, 0.0);
        loop {
            let (rest, next) = stretch(rounds, &spot, entry);
            let off = end - rest.end();
            let goes_along = |to: f64| {
                let middle = way.point_at((share + to) / 2.0);
                rest.distance_to(middle) <= aside
            };
            let is_last = (1.0 - share) * length - rest.length();
            let merged = share > 0.0;
            if off.norm() <= ROUNDED && is_last.abs() <= 4.0 * ROUNDED + 1e-3 * length {
                let fits = alike(&way, &rest)
                    && goes_along(1.0)
                    && self.fits(&way, &rest, off, counts, (merged, four_b), spot.at);
                return fits.then_some(Reached {
                    spot: next,
                    whole: true,
                    length: travelled + rest.length(),
                    off,
                    end,
                });
            }
            if !alike(&way, &rest) && !is_chord(&way, &rest) {
                return None;
            }
            let behind = way.share_of(rest.end());
            if behind > share
                && (1.0 - behind) * length > LEAST_PART
                && rest.length() < (1.0 - share) * length + ROUNDED
                && way.distance_to(rest.end()) <= TOLERANCE
                && goes_along(behind)
                && let Some(behind_spot) = next
            {
                travelled += rest.length();
                (spot, share) = (behind_spot, behind);
                // Once round, and on.
                if travelled > 2.0 * length + rest.length() {
                    return None;
                }
                continue;
            }
            let within = rest.share_of(end);
            let (done, left) = (within * rest.length(), (1.0 - within) * rest.length());
            let ends_within = done > LEAST_PART
                && left > LEAST_PART
                && rest.distance_to(end) <= if counts { TOLERANCE + 0.5 } else { TOLERANCE }
                && ((1.0 - share) * length - done).abs() <= 4.0 * ROUNDED + 1e-3 * length
                && goes_along(1.0);
            let at = rest.point_at(within);
            return ends_within.then_some(Reached {
                spot: Some(Spot { at, ..spot }),
                whole: false,
                length: travelled + done,
                off: Vector::zeros(),
                end,
            });
        }
    }

    /// Whether a block that ends so far from the end of a piece stands for it.
    fn fits(
        &self,
        way: &Segment,
        rest: &Segment,
        off: Vector,
        counts: bool,
        (merged, four_b): (bool, bool),
        at: Point,
    ) -> bool {
        let middle = rest.distance_to(way.point_at(0.5));
        if !counts || merged {
            return off.norm() <= TOLERANCE + if counts { 0.3 } else { 0.0 };
        }
        if off.norm() <= 0.8 && middle <= TOLERANCE {
            return true;
        }
        // What the writer would have made of it: its own roundings are no fault.
        let written = || {
            let in_program = rest.moved(self.shift);
            let (from, to) = (snap(at + self.shift)?, snap(in_program.end())?);
            let mut blocks = Vec::new();
            three_b::encode::encode(&in_program, from, to, i64::MAX / 4, &mut blocks)?;
            let [only] = &blocks[..] else {
                return None;
            };
            three_b::decode(&only.block, point_of(from)).ok()
        };
        let limit = off.norm() <= TOLERANCE + 0.3 && middle <= ROUNDED;
        match written().filter(|_| !four_b) {
            Some(written) => {
                let differs = |share: f64| {
                    let own = way.point_at(share) - way.start();
                    let other = written.point_at(share) - written.start();
                    (own - other).norm()
                };
                limit && differs(1.0) <= TOLERANCE && differs(0.5) <= TOLERANCE
            }
            None => limit,
        }
    }
}

/// What is left of a spot's piece, up to `entry` where that lies ahead on it; and the spot behind that.
pub(super) fn stretch(rounds: &Rounds, spot: &Spot, entry: &Spot) -> (Segment, Option<Spot>) {
    let rest = rounds.rest(spot);
    let same = (spot.round, spot.piece, spot.back) == (entry.round, entry.piece, entry.back);
    if same && spot.at != entry.at {
        let share = rest.share_of(entry.at);
        if share * rest.length() > 1e-3 && share < 1.0 && rest.distance_to(entry.at) < 1e-2 {
            let part = match rest.part(0.0, share) {
                Segment::Line(line) => Segment::line(line.start, entry.at),
                arc => arc,
            };
            return (part, Some(*entry));
        }
    }
    (rest, rounds.next(spot))
}

/// Both straight, or both round in the same sense, as far as that can be told.
fn alike(way: &Segment, rest: &Segment) -> bool {
    let is_flat = |arc: &Arc| arc.sagitta() <= FLAT;
    match (way.as_arc(), rest.as_arc()) {
        (None, None) => true,
        (Some(arc), None) | (None, Some(arc)) => is_flat(arc),
        (Some(one), Some(other)) => one.sweep * other.sweep > 0.0 || is_flat(one) && is_flat(other),
    }
}

/// A line that stands for a part of a large arc.
fn is_chord(way: &Segment, rest: &Segment) -> bool {
    way.as_arc().is_none() && rest.as_arc().is_some_and(|arc| arc.radius > HUGE)
}
