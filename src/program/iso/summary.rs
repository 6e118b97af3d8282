//! The moves of a cut, summed up.

use super::moves::{Move, Place};
use crate::geometry::Side;
use std::ops::Range;

/// Consecutive moves that cut, without a rapid or a stop between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Summary {
    /// The first two and the last two moves with a length; they may coincide.
    pub(crate) first: [Move; 2],
    pub(crate) last: [Move; 2],
    pub(crate) moves: u32,
    /// The line that begins it, bytes from the start of the cut.
    pub(crate) range: (u32, u32),
    /// The line that ends it.
    pub(crate) last_range: (u32, u32),
    /// No line of it was unreadable.
    pub(crate) whole: bool,
    /// One of its lines, or of those between, has a fault.
    pub(crate) faulty: bool,
    /// Nothing has ended it.
    pub(crate) open: bool,
    /// The side on which the control let the wire run, where it is the same from the second move to the one before the
    /// last.
    pub(crate) side: WireSide,
    /// Moves that switch the correction on.
    pub(crate) switched_on: u32,
}

/// On which side of a cut the wire was sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WireSide {
    None,
    One(Side),
    Both,
}

impl Summary {
    pub(crate) fn begin(first: Move, range: (u32, u32), whole: bool) -> Summary {
        Summary {
            first: [first; 2],
            last: [first; 2],
            moves: 1,
            range,
            last_range: range,
            whole,
            faulty: false,
            open: true,
            side: first.side.map_or(WireSide::None, WireSide::One),
            switched_on: u32::from(first.switches == Some(true)),
        }
    }

    pub(crate) fn start(&self) -> Place {
        self.first[0].from
    }

    pub(crate) fn push(&mut self, step: Move, range: (u32, u32)) {
        if self.moves == 1 {
            self.first[1] = step;
        }
        self.last = [self.last[1], step];
        self.moves += 1;
        self.switched_on += u32::from(step.switches == Some(true));
        self.last_range = range;
        self.side = joined(self.side, step.side.map_or(WireSide::None, WireSide::One));
    }

    /// The lines that begin it and end it, where its bytes are those of the text.
    pub(crate) fn ends(&self) -> [Range<usize>; 2] {
        [self.range, self.last_range].map(|(start, end)| start as usize..end as usize)
    }

    /// Appends the moves behind a stop.
    pub(crate) fn append(&mut self, next: &Summary) {
        if self.moves == 1 {
            self.first[1] = next.first[0];
        }
        self.last = if next.moves == 1 {
            [self.last[1], next.last[1]]
        } else {
            next.last
        };
        self.moves += next.moves;
        self.last_range = next.last_range;
        self.switched_on += next.switched_on;
        self.whole &= next.whole;
        self.faulty |= next.faulty;
        self.open = next.open;
        self.side = joined(self.side, next.side);
    }

    /// The same elsewhere, so many bytes on.
    pub(crate) fn shifted(mut self, by: Place, bytes: usize) -> Summary {
        for step in self.first.iter_mut().chain(&mut self.last) {
            *step = step.shifted(by);
        }
        let behind = |(start, end): (u32, u32)| (start + bytes as u32, end + bytes as u32);
        (self.range, self.last_range) = (behind(self.range), behind(self.last_range));
        self
    }
}

fn joined(a: WireSide, b: WireSide) -> WireSide {
    match (a, b) {
        (WireSide::None, other) | (other, WireSide::None) => other,
        (one, other) if one == other => one,
        _ => WireSide::Both,
    }
}

/// A way out and back at whose tip a move begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spur {
    pub(crate) tip: Place,
    /// µm.
    pub(crate) length: f64,
    /// Bytes from the start of the cut: the whole line's words.
    pub(crate) range: (u32, u32),
}
