//! The position of a program beside its drawing, and whether a block follows a piece of it from there.

use super::TOLERANCE;
use super::rounds::{Rounds, Spot};
use super::traced::{Block, Motion, Traced};
use crate::geometry::{Arc, Point, Segment, Vector};
use crate::program::grid::{point_of, snap};
use crate::program::three_b;

/// The map from a program's places to those of the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placement {
    /// From the drawing to the program, µm.
    pub shift: Vector,
    /// The shift is of whole µm, and so are the program's nodes.
    pub(crate) on_grid: bool,
    /// Blocks are compared with the output of our own writers for the drawing, without room for other writers'
    /// roundings.
    exact: bool,
    /// Added to the program's places: from the end of a chain of its blocks to the intended node.
    lag: Vector,
    /// The largest distance of the intended node from its assumed place, µm.
    unsure: f64,
    /// The same at the start of a run: its end returns there.
    begun: f64,
}

/// How the end and the centre of a block are stated.
#[derive(Clone, Copy, Debug)]
struct Manner {
    /// A machine counts to its end.
    counts: bool,
    four_b: bool,
    /// An arc states its radius.
    by_radius: bool,
}

/// The result of following a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reached {
    /// After the block; `None` at the end of an open round.
    pub spot: Option<Spot>,
    /// It ends at the end of a piece, not within one.
    pub whole: bool,
    /// Along the round, µm.
    pub length: f64,
    /// From the end in the drawing.
    pub off: Vector,
    end: Point,
}

/// The least rest of a piece, or of a block on it, that ends on the way, µm: a smaller rest is a wrong length.
const LEAST_PART: f64 = 5.0;
/// An arc that rises by no more over its chord may be a line, µm.
const FLAT: f64 = 1.5;
/// Blocks and pieces of this length come and go with rounding, µm.
const CRUMB: f64 = 2.5;
/// A larger radius is written in chords, µm.
const HUGE: f64 = 1e6;
/// The largest distance of an arc from that of the drawing where its writer had no better one, µm.
const ROUNDED: f64 = 3.3;
/// The largest distance of our own blocks' ends from their nodes: lines and arcs that name their ends, by the grid;
/// counting arcs, µm.
pub(super) const SNAPPED: f64 = 0.75;
const COUNTED: f64 = 1.52;
/// The largest distance of our own arcs' centres from those of the drawing, in X and in Y, and of the arcs themselves,
/// µm.
const CENTRED: f64 = 1.501;
const ASIDE: f64 = 2.6;
/// By how much the radius of an arc, and half of the distance of its ends, are rounded, µm.
const ROUNDED_RADIUS: f64 = 1.2;
/// The largest sum of the roundings of single steps, µm: what stands farther away has been moved.
const DRIFTED: f64 = 2.2;
/// The largest distance of a node from its assumed place: the program's place was found from rounded places; the arc
/// before it ended within a piece, µm.
const UNSURE: f64 = 1.0;
const WITHIN: f64 = 1.5;
/// This near to the middle between two nodes a place may be rounded either way, µm.
const TIE: f64 = 1e-3;

impl Placement {
    pub(super) fn at(shift: Vector) -> Placement {
        Placement {
            shift,
            on_grid: false,
            exact: false,
            lag: Vector::zeros(),
            unsure: 0.0,
            begun: 0.0,
        }
    }

    /// The same by the nodes of a grid.
    pub(crate) fn gridded(self) -> Placement {
        Placement {
            on_grid: true,
            ..self
        }
    }

    /// The same for a program whose every block we might have written; `None` where the grid is unknown.
    pub(super) fn exactly(self) -> Option<Placement> {
        self.on_grid.then_some(Placement {
            exact: true,
            ..self
        })
    }

    pub(crate) fn is_exact(&self) -> bool {
        self.exact
    }

    /// The same where everything after is moved by this much more.
    pub(super) fn moved(&self, by: Vector) -> Placement {
        let by = if self.on_grid { by.map(f64::round) } else { by };
        Placement {
            shift: self.shift + by,
            unsure: UNSURE,
            ..*self
        }
    }

    /// The same where the node is uncertain: its place was found by few blocks, or arcs have led beside the drawing.
    pub(crate) fn unsurely(self) -> Placement {
        Placement {
            unsure: self.unsure.max(UNSURE),
            ..self
        }
    }

    /// The same with another shift.
    pub(crate) fn shifted(&self, shift: Vector) -> Placement {
        self.moved(shift - self.shift)
    }

    /// A place of the program in the drawing.
    pub(super) fn place(&self, point: Point) -> Point {
        point + self.lag - self.shift
    }

    /// A place of the drawing in the program, on its grid.
    pub(super) fn program(&self, point: Point) -> Point {
        let point = point + self.shift;
        let point = if self.on_grid {
            point.map(f64::round)
        } else {
            point
        };
        point - self.lag
    }

    /// Where a block begins, in the drawing.
    pub(super) fn begin(&self, block: &Block) -> Option<Point> {
        match &block.motion {
            Motion::Cut(segment) => Some(self.place(segment.start())),
            Motion::Way(start, _) => Some(self.place(*start)),
            Motion::Stop => None,
        }
    }

    /// Goes along a round with one block, up to `entry` where the round comes back to it.
    pub(super) fn follow(
        &mut self,
        rounds: &Rounds,
        traced: &Traced,
        index: usize,
        from: &Spot,
        entry: &Spot,
    ) -> Option<Reached> {
        let block = traced.blocks[index].segment()?;
        let counts = traced.counts && block.as_arc().is_some();
        let manner = Manner {
            counts,
            four_b: traced.four_b,
            by_radius: traced.blocks[index].by_radius,
        };
        if from == entry {
            self.begun = self.begun.max(self.unsure);
        }
        let reached = self.reach(rounds, block, manner, from, entry);
        if reached.is_none()
            && let Some(drifted) = self.drifting(rounds, block, manner, from, entry)
        {
            return Some(drifted);
        }
        let reached = reached.or_else(|| {
            // Crumbs are left out by the one or by the other.
            if block.length() <= CRUMB {
                let end = self.place(block.end());
                return Some(Reached {
                    spot: Some(*from),
                    whole: true,
                    length: 0.0,
                    off: end - from.at,
                    end,
                });
            }
            let is_crumb = rounds.whole(from).length() <= CRUMB;
            let next = rounds.next(from).filter(|_| is_crumb)?;
            self.reach(rounds, block, manner, &next, entry)
        })?;
        self.stand(rounds, &reached, (from, entry), counts);
        Some(reached)
    }

    /// The same where each step of an incremental program has been rounded by itself: the program stands beside the
    /// node by the sum of that, and goes on from there as the drawing does. What it stands aside by stays.
    fn drifting(
        &mut self,
        rounds: &Rounds,
        block: &Segment,
        manner: Manner,
        from: &Spot,
        entry: &Spot,
    ) -> Option<Reached> {
        let by = self.place(block.start()) - from.at;
        if self.exact || manner.counts || manner.four_b || by.norm() > DRIFTED {
            return None;
        }
        let there = Placement {
            lag: self.lag - by,
            ..*self
        };
        let reached = there.reach(rounds, block, manner, from, entry)?;
        if !reached.whole || reached.off.norm() > SNAPPED {
            return None;
        }
        *self = there;
        Some(reached)
    }

    /// Moves to the node after a block: the counted position differs, which is no fault of the following blocks.
    fn stand(
        &mut self,
        rounds: &Rounds,
        reached: &Reached,
        (from, entry): (&Spot, &Spot),
        counts: bool,
    ) {
        let is_unsure = self.exact && self.unsure > 0.0;
        // Where a run began within a piece is as near to its node as its first block is.
        let at_entry = reached.spot == Some(*entry) && !rounds.is_begin(entry);
        let is_known = reached.whole && (!self.exact || !at_entry);
        let node = match (counts || is_unsure, is_known) {
            (true, true) => {
                let meant = reached.end - reached.off + self.shift;
                self.unsure = slack_of(meant);
                if self.on_grid {
                    meant.map(f64::round)
                } else {
                    meant
                }
            }
            (true, false) if self.exact && counts => {
                self.unsure = WITHIN;
                self.node_within(rounds, reached, from)
            }
            _ => return,
        };
        self.lag += node - (reached.end + self.shift);
    }

    /// The node at which a block ends within a piece: writers divide one into equal parts.
    fn node_within(&self, rounds: &Rounds, reached: &Reached, from: &Spot) -> Point {
        let stands = reached.end + self.shift;
        let whole = rounds.whole(&reached.spot.unwrap_or(*from));
        let parts = (whole.length() / reached.length).round();
        let share = (whole.share_of(reached.end) * parts).round() / parts;
        let part = whole.point_at(share) + self.shift;
        if (part - stands).norm() <= COUNTED + 0.75 {
            part.map(f64::round)
        } else {
            stands.map(f64::round)
        }
    }

    fn reach(
        &self,
        rounds: &Rounds,
        block: &Segment,
        manner: Manner,
        from: &Spot,
        entry: &Spot,
    ) -> Option<Reached> {
        let counts = manner.counts;
        let way = block.moved(self.lag - self.shift);
        let (length, end) = (way.length(), way.end());
        let unsure = if self.exact { self.unsure } else { 0.0 };
        let aside = unsure + if counts { ROUNDED } else { TOLERANCE };
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
            if off.norm() <= ROUNDED + unsure && is_last.abs() <= 4.0 * ROUNDED + 1e-3 * length {
                let fits = alike(&way, &rest)
                    // A single piece is compared at its middle below.
                    && (self.exact && !merged || goes_along(1.0))
                    && self.coming_back(rounds, next == Some(*entry), entry).fits(
                        &way,
                        &rest,
                        off,
                        manner,
                        merged,
                        spot.at,
                    );
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
                && way.distance_to(rest.end()) <= TOLERANCE + unsure
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
                && rest.distance_to(end) <= unsure + self.beside(counts)
                && (!self.exact || self.is_centred(&way, &rest, manner))
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

    /// The same where a run comes back to where it began within a piece.
    fn coming_back(&self, rounds: &Rounds, is_back: bool, entry: &Spot) -> Placement {
        let unsure = match is_back && !rounds.is_begin(entry) {
            true => self.unsure.max(self.begun),
            false => self.unsure,
        };
        Placement { unsure, ..*self }
    }

    /// The largest distance of a block's end from a piece within which it ends, µm.
    fn beside(&self, counts: bool) -> f64 {
        match (self.exact, counts) {
            (true, true) => COUNTED + SNAPPED,
            (true, false) => SNAPPED,
            (false, true) => TOLERANCE + 0.5,
            (false, false) => TOLERANCE,
        }
    }

    /// Whether an arc has its centre where the grid has one for that of the drawing.
    fn is_centred(&self, way: &Segment, rest: &Segment, manner: Manner) -> bool {
        match (way.as_arc(), rest.as_arc()) {
            (Some(own), Some(meant)) => {
                let lever = if manner.by_radius { lever(own) } else { 0.0 };
                let room = CENTRED + self.unsure + lever;
                (own.center - meant.center).amax() <= room
            }
            _ => true,
        }
    }

    /// Whether a block that ends this far from the end of a piece stands for it.
    fn fits(
        &self,
        way: &Segment,
        rest: &Segment,
        off: Vector,
        manner: Manner,
        merged: bool,
        at: Point,
    ) -> bool {
        let Manner { counts, four_b, .. } = manner;
        let middle = rest.distance_to(way.point_at(0.5));
        if self.exact {
            let end = rest.end() + self.shift;
            let away = if counts {
                let node = end.map(f64::round) - self.shift;
                (way.end() - node).norm() - COUNTED - slack_of(end)
            } else {
                off.norm() - SNAPPED
            };
            return away <= self.unsure
                && (merged || middle <= ASIDE + self.unsure)
                && self.is_centred(way, rest, manner);
        }
        if !counts || merged {
            return off.norm() <= TOLERANCE + if counts { 0.3 } else { 0.0 };
        }
        if off.norm() <= 0.8 && middle <= TOLERANCE {
            return true;
        }
        // Compared with the writer's own output: its roundings are no fault.
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

/// How far the rounding of its ends and its radius moves the centre of an arc that states its radius and spans less than
/// half a turn, µm: along the line between its ends by the more the shorter that is beside its radius, and across it by the more the nearer
/// it comes to the diameter.
pub(super) fn lever(arc: &Arc) -> f64 {
    let chord = (arc.end - arc.start).norm();
    if (arc.sweep.abs() - std::f64::consts::PI).abs() < 1e-9 {
        return 0.0;
    }
    if chord < LEAST_PART {
        return f64::INFINITY;
    }
    let height = (arc.radius.powi(2) - chord.powi(2) / 4.0).max(0.0).sqrt();
    let along = 2.0 * SNAPPED * (arc.radius / chord - 0.5).max(0.0);
    along + ROUNDED_RADIUS * (arc.radius / height.max(1.0) - 1.0)
}

/// The rest of a spot's piece, up to `entry` where that lies ahead on it; and the spot after that.
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

/// How far the node of a place may be from the nearest one, µm: in the middle between two it is either.
fn slack_of(place: Point) -> f64 {
    let is_tie = |at: &f64| (at - at.floor() - 0.5).abs() < TIE;
    f64::from(u8::from(place.iter().any(is_tie)))
}

/// Both straight, or both round in the same sense, as far as that can be decided.
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
