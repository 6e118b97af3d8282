//! The part of an ISO program's cut in one stretch, how it lies relative to itself, and its arcs that may be too tight.

use super::moves::{Bend, Move, Place, Reading, added, apart};
use crate::geometry::{Point, Side};
use crate::program::path::{HeldWay, Lay, Node, mixed};

/// Consecutive moves that cut, without a rapid or a stop between: those of a cut, or those of them in one stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part {
    /// The first two and the last two moves with a length; they may coincide.
    pub(crate) first: [Move; 2],
    pub(crate) last: [Move; 2],
    pub(crate) moves: u32,
    pub(crate) arcs: u32,
    /// Twice the signed area in nm², relative to the part's start.
    pub(crate) twice_area: i128,
    /// The line that begins it, bytes from the start of the stretch.
    pub(crate) range: (u32, u32),
    /// The line that ends it.
    pub(crate) last_range: (u32, u32),
    /// No line of it was unreadable.
    pub(crate) whole: bool,
    /// One of its lines, or of those between, has a fault.
    pub(crate) faulty: bool,
    /// It goes on in the next stretch.
    pub(crate) open: bool,
    /// It continues the one before.
    pub(crate) continues: bool,
    /// The stop after it, before any other move, bytes from the start of the stretch; [`SEVERAL`] for more than one.
    pub(crate) stop: Option<u32>,
    /// Another stop follows the one after it without a move between: an open cut is meant to end there.
    pub(crate) ends_open: bool,
    /// The side on which the control let the wire run, where it is the same from the second move to the one before the
    /// last.
    pub(crate) side: WireSide,
    /// Moves that switch the correction on.
    pub(crate) switched_on: u32,
    /// Where the wire was first sent to the other side, and the line that did so.
    pub(crate) flip: Option<(Place, (u32, u32))>,
}

/// Stands for more than one stop.
pub(crate) const SEVERAL: u32 = u32::MAX;

/// On which side of a part the wire was sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WireSide {
    None,
    One(Side),
    Both,
}

impl Part {
    pub(crate) fn begin(
        first: Move,
        cap: f64,
        range: (u32, u32),
        continues: bool,
        whole: bool,
    ) -> Part {
        let side = first.side.map_or(WireSide::None, WireSide::One);
        let twice_area = cap as i128;
        Part {
            first: [first; 2],
            last: [first; 2],
            moves: 1,
            arcs: u32::from(first.is_arc()),
            twice_area,
            range,
            last_range: range,
            whole,
            faulty: false,
            open: true,
            continues,
            stop: None,
            ends_open: false,
            side,
            switched_on: u32::from(first.switches == Some(true)),
            flip: None,
        }
    }

    pub(crate) fn start(&self) -> Place {
        self.first[0].from
    }

    /// What a move adds to twice the area.
    fn term(&self, step: &Move, cap: f64) -> i128 {
        let origin = self.start();
        let [from, to] = [step.from, step.to].map(|place| apart(place, origin));
        cross(from, to).wrapping_add(cap as i128)
    }

    pub(crate) fn push(&mut self, step: Move, cap: f64, range: (u32, u32)) {
        self.twice_area = self.twice_area.wrapping_add(self.term(&step, cap));
        if self.moves == 1 {
            self.first[1] = step;
        }
        if changes_side(&self.last[1], &step) {
            self.flip.get_or_insert((step.from, range));
        }
        self.last = [self.last[1], step];
        self.moves += 1;
        self.arcs += u32::from(step.is_arc());
        self.switched_on += u32::from(step.switches == Some(true));
        self.last_range = range;
        self.side = joined(self.side, step.side.map_or(WireSide::None, WireSide::One));
    }

    /// Appends the continuation of a part; the ranges stay those of the beginning.
    pub(crate) fn append(&mut self, next: &Part) {
        // The area of the continuation was relative to its own beginning.
        let (origin, its) = (self.start(), next.start());
        let between = cross(apart(its, origin), apart(next.last[1].to, its));
        self.twice_area = self
            .twice_area
            .wrapping_add(next.twice_area)
            .wrapping_add(between);
        if self.moves == 1 {
            self.first[1] = next.first[0];
        }
        self.last = if next.moves == 1 {
            [self.last[1], next.last[1]]
        } else {
            next.last
        };
        self.moves += next.moves;
        self.arcs += next.arcs;
        self.switched_on += next.switched_on;
        self.whole &= next.whole;
        self.faulty |= next.faulty;
        self.open = next.open;
        self.stop = next.stop;
        self.ends_open = next.ends_open;
        self.side = joined(self.side, next.side);
    }

    pub(crate) fn shift(&mut self, by: Place) {
        for step in self.first.iter_mut().chain(&mut self.last) {
            *step = step.shifted(by);
        }
        if let Some((at, _)) = &mut self.flip {
            *at = added(*at, by);
        }
    }
}

fn cross(a: Place, b: Place) -> i128 {
    let [[ax, ay], [bx, by]] = [a, b].map(|place| place.map(i128::from));
    (ax * by).wrapping_sub(ay * bx)
}

/// The second move has the wire on the other side than the first.
pub(crate) fn changes_side(one: &Move, other: &Move) -> bool {
    matches!((one.side, other.side), (Some(one), Some(other)) if one != other)
}

fn joined(a: WireSide, b: WireSide) -> WireSide {
    match (a, b) {
        (WireSide::None, other) | (other, WireSide::None) => other,
        (one, other) if one == other => one,
        _ => WireSide::Both,
    }
}

/// Called for every move of a part: the part's index, the move, the place of its words.
pub(crate) type Hears<'a> = dyn FnMut(usize, &Move, (u32, u32)) + 'a;

/// The moves of a part as they are made.
#[derive(Default)]
pub(crate) struct Ways(Vec<Move>);

impl Ways {
    pub(crate) fn push(&mut self, step: Move) {
        self.0.push(step);
    }

    /// How the part lies relative to itself; the lays of those before it, and of some that are
    /// gone, may be reused.
    pub(crate) fn lay<'a>(
        self,
        reading: &Reading,
        is_whole: bool,
        before: &[Lay],
        old: impl Iterator<Item = &'a Lay>,
    ) -> Lay {
        let mark = self.mark(reading);
        let known = Lay::known(before.iter().rev(), old, mark, is_whole);
        known.unwrap_or_else(|| Lay::of(&self.way(reading), mark, is_whole))
    }

    fn way(&self, reading: &Reading) -> HeldWay {
        let start = self.0.first().map_or([0, 0], |step| step.from);
        let mut way = HeldWay::from(Node::at(Point::origin()), reading.writing());
        for step in &self.0 {
            let piece = step.seen_from(start).segment(reading);
            way.push(piece, step.is_arc(), Node::at(piece.end()));
        }
        way
    }

    fn mark(&self, reading: &Reading) -> u64 {
        let mix = |mark: u64, field: i64| mixed(mark, field as u64);
        let with = |mark: u64, step: &Move| {
            let along = step.at_origin();
            let bend = match along.bend {
                Bend::Center { .. } => along
                    .center(reading.rule(along.incremental))
                    .unwrap_or_default(),
                Bend::Radius(radius) => [radius, i64::MIN],
                Bend::Nothing => [0, i64::MAX],
            };
            let fields = [
                along.to[0],
                along.to[1],
                bend[0],
                bend[1],
                along.motion as i64,
            ];
            fields.into_iter().fold(
                mark.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(1),
                mix,
            )
        };
        self.0.iter().fold(0, with)
    }
}

/// An arc that may be tighter than a correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tight {
    pub(crate) arc: Move,
    /// µm, relative to its own start: the same anywhere.
    pub(crate) radius: f64,
    /// Bytes from the start of the stretch; the whole line's words.
    pub(crate) range: (u32, u32),
    /// The part that it belongs to, by its index in the stretch.
    pub(crate) part: u32,
}

/// A way out and back at whose tip a move begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spur {
    pub(crate) tip: Place,
    /// µm.
    pub(crate) length: f64,
    /// Bytes from the start of the stretch: the whole line's words.
    pub(crate) range: (u32, u32),
    /// The part that it belongs to, by its index in the stretch.
    pub(crate) part: u32,
}

/// The smallest radii among some arcs, µm; infinite where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tightest {
    /// Of the arcs beside which the control lets the wire run on a side, and of the others.
    pub(crate) offset: f64,
    pub(crate) plain: f64,
}

impl Default for Tightest {
    fn default() -> Self {
        Tightest {
            offset: f64::INFINITY,
            plain: f64::INFINITY,
        }
    }
}
