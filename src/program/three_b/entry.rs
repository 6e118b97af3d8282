//! The content of a line of a 3B program, and the end of a block.

use super::around::StatedPoint;
use super::block::{self, Block, CountingAxis, Motion, PartArc};
use super::decode::meant;
use super::machine::travel;
use super::words::Word;
use crate::finding::Side;
use crate::geometry::Point;
use crate::program::path::Node;
use std::ops::Range;

/// A displacement: the integer machine's in µm, the blocks' own in nm. Whole numbers, so that sums are exact in any
/// order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::program) struct Move {
    pub(crate) machine: [i64; 2],
    pub(crate) meant: [i64; 2],
}

impl Move {
    pub(crate) fn plus(self, other: Move) -> Move {
        let sum = |a: [i64; 2], b: [i64; 2]| [a[0].saturating_add(b[0]), a[1].saturating_add(b[1])];
        Move {
            machine: sum(self.machine, other.machine),
            meant: sum(self.meant, other.meant),
        }
    }

    /// True where machine or meaning return within `tolerance` µm.
    pub(crate) fn is_within(&self, tolerance: f64) -> bool {
        let near =
            |[x, y]: [i64; 2], unit: f64| (x as f64 * unit).hypot(y as f64 * unit) <= tolerance;
        near(self.machine, 1.0) || near(self.meant, 1e-3)
    }

    /// Its end, from the origin.
    pub(crate) fn node(&self) -> Node {
        let ([x, y], [a, b]) = (self.meant_um(), self.machine);
        Node {
            machine: Point::new(a as f64, b as f64),
            ideal: Point::new(x, y),
        }
    }

    /// What the blocks mean, µm.
    pub(crate) fn meant_um(&self) -> [f64; 2] {
        self.meant.map(|nm| nm as f64 * 1e-3)
    }
}

/// A block as it stands in the text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BlockEntry {
    /// X, Y and J; those of a block with larger ones are in `extra`.
    numbers: [u32; 3],
    axis: CountingAxis,
    motion: Motion,
    /// Parts that only some blocks have.
    extra: Option<Box<Extra>>,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Extra {
    part: Option<PartArc>,
    stated_end: Option<StatedPoint>,
    /// X, Y and J.
    large: Option<Box<[i64; 3]>>,
}

impl BlockEntry {
    pub(crate) fn new(
        block: Block,
        part: Option<PartArc>,
        stated_end: Option<StatedPoint>,
    ) -> BlockEntry {
        let written = [block.x, block.y, block.j];
        let numbers = written.map(|number| u32::try_from(number).unwrap_or(0));
        let large = (numbers.map(i64::from) != written).then(|| Box::new(written));
        let is_plain = part.is_none() && stated_end.is_none() && large.is_none();
        let extra = Extra {
            part,
            stated_end,
            large,
        };
        BlockEntry {
            numbers,
            axis: block.axis,
            motion: block.motion,
            extra: (!is_plain).then(|| Box::new(extra)),
        }
    }

    pub(crate) fn block(&self) -> Block {
        let large = self.extra.as_ref().and_then(|extra| extra.large.as_deref());
        let [x, y, j] = large.copied().unwrap_or(self.numbers.map(i64::from));
        Block {
            x,
            y,
            j,
            axis: self.axis,
            motion: self.motion,
        }
    }

    /// Its displacement.
    pub(crate) fn travel(&self) -> Move {
        travel_of(&self.block())
    }

    /// The additional part of a 4B block.
    pub(crate) fn part(&self) -> Option<PartArc> {
        self.extra.as_ref().and_then(|extra| extra.part)
    }

    /// The side of travel on which the wire runs, as an arc of 4B says it.
    pub(crate) fn side_of_wire(&self) -> Option<Side> {
        let turns_left = match self.motion {
            Motion::Line(_) => return None,
            Motion::Clockwise(_) => false,
            Motion::CounterClockwise(_) => true,
        };
        let is_left = self.part()?.concave == turns_left;
        Some(if is_left { Side::Left } else { Side::Right })
    }

    pub(crate) fn stated_end(&self) -> Option<StatedPoint> {
        self.extra.as_ref().and_then(|extra| extra.stated_end)
    }

    pub(crate) fn is_line(&self) -> bool {
        matches!(self.motion, Motion::Line(_))
    }
}

/// The end of a block.
pub(super) fn travel_of(block: &Block) -> Move {
    let machine = travel(block).map_or([0, 0], |block::Node { x, y }| [x, y]);
    let meant = match meant(block, Point::origin()) {
        Some(segment) => [segment.end().x, segment.end().y].map(|um| (um * 1e3).round() as i64),
        None => machine.map(|um| um.saturating_mul(1000)),
    };
    Move { machine, meant }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum What {
    Block(BlockEntry),
    Word {
        word: Word,
        is_own: bool,
    },
    /// mm.
    StartPoint([f64; 2]),
    Text {
        column: usize,
    },
    /// A comment that holds a block.
    CommentedBlock {
        column: usize,
    },
    /// An unreadable block.
    Unread,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub(crate) start: u32,
    pub(crate) length: u32,
    pub(crate) line: u32,
    pub(crate) number: u32,
    pub(crate) what: What,
}

pub(super) const NO_NUMBER: u32 = u32::MAX;

impl Entry {
    /// Bytes from that from which the cut's places count.
    pub(crate) fn range(&self) -> Range<usize> {
        self.start as usize..(self.start + self.length) as usize
    }

    pub(crate) fn number(&self) -> Option<u32> {
        (self.number != NO_NUMBER).then_some(self.number)
    }

    pub(crate) fn block(&self) -> Option<&BlockEntry> {
        match &self.what {
            What::Block(block) => Some(block),
            _ => None,
        }
    }
}
