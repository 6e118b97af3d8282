//! What a language and the search for a slip say to each other: slips, what they read, and a cut that gives them.

use super::cut::{Piece, Pieces};
use crate::geometry::{Segment, Vector};

/// A change of the pieces of a cut, by their index.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) enum Change<M> {
    Replace {
        index: usize,
        meant: M,
    },
    /// One of two equal blocks goes, or one that leads astray.
    Delete {
        index: usize,
    },
    /// The block changes places with the next one.
    Exchange {
        index: usize,
    },
    /// A block comes before another one.
    Insert {
        index: usize,
        meant: M,
    },
}

impl<M> Change<M> {
    pub(crate) fn index(&self) -> usize {
        match self {
            Change::Replace { index, .. }
            | Change::Delete { index }
            | Change::Exchange { index }
            | Change::Insert { index, .. } => *index,
        }
    }
}

/// What a slip is, as far as the rule asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) enum Sort {
    /// A character, or a word.
    Key,
    /// Two equal numbers of a block, typed alike.
    Alike,
    /// A line for an arc, an arc for a line, or another letter.
    Kind,
    /// A number that is calculated from all others: it is offered, and explains nothing.
    Calculated,
    /// What coordinates state, where that is sure by itself.
    Stated,
    /// A verbatim copy of the block before.
    Twin,
    /// A block that is too many.
    Deletion,
    Exchange,
    /// The way out backwards is missing as way in.
    WayIn,
    /// Any other block is missing.
    Insertion,
}

/// A slip, undone.
#[derive(Clone, Debug)]
pub(in crate::program) struct Slip<M> {
    pub(crate) change: Change<M>,
    /// How many pieces it changes, and those in their place.
    pub(crate) count: usize,
    pub(crate) pieces: Vec<Piece>,
    pub(crate) sort: Sort,
    /// The characters that it changes.
    pub(crate) keys: i32,
}

/// A change that makes a cut sound, or sounder.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct Repair<M> {
    pub(crate) change: Change<M>,
    /// Nothing else explains the text.
    pub(crate) is_sure: bool,
    /// Nothing contradicts the cut any more.
    pub(crate) is_whole: bool,
}

/// A faulty cut, as a language holds it.
pub(in crate::program) trait Cut {
    /// A possible intended block.
    type Meant: Clone;

    fn pieces(&self) -> &Pieces;

    /// The blocks one slip away from one, and what each reads; without those that do not lead to one of these ends.
    fn slips(&self, index: usize, ends: &Ends) -> Vec<Slip<Self::Meant>>;

    /// The removal of a block; `None` where it stays.
    fn deleted(&self, index: usize) -> Option<Slip<Self::Meant>>;

    /// The exchange of a block and the next one; `None` where they stay.
    fn exchanged(&self, index: usize) -> Option<Slip<Self::Meant>>;

    /// The block along a way from the origin, before another one; `None` where it cannot be written.
    fn inserted(&self, index: usize, way: &Segment) -> Option<Slip<Self::Meant>>;

    /// How many blocks from one on a change of it changes.
    fn reach(&self, _index: usize) -> usize {
        1
    }
}

/// Where a piece in the place of another one must end, seen from the other one's end, for the cut to close, µm.
#[derive(Clone, Debug, Default)]
pub(in crate::program) struct Ends {
    pub(super) gaps: Vec<Vector>,
    pub(super) drift: Vector,
    pub(super) within: f64,
    /// Any end will do.
    pub(crate) is_any: bool,
}

impl Ends {
    /// Whether pieces that end so much elsewhere, by their meaning and as a control counts, may close the cut.
    pub(crate) fn may_be(&self, by: Vector, machine: Vector) -> bool {
        self.is_any
            || self.gaps.iter().any(|gap| {
                (gap - by).norm() <= self.within
                    || (gap - self.drift - machine).norm() <= self.within
            })
    }

    /// How near to one of them, µm.
    pub(crate) fn within(&self) -> f64 {
        self.within
    }

    /// The ends themselves.
    pub(crate) fn all(&self) -> &[Vector] {
        &self.gaps
    }
}

/// The characters of a block that somebody has typed, or left out.
pub(in crate::program) const BLOCK_KEYS: i32 = 20;

impl<M> Slip<M> {
    /// The removal of a block, which leaves some of the pieces that it changes; of a copy of the block before where it `is_twin`.
    pub(crate) fn deletion(
        index: usize,
        is_twin: bool,
        (count, pieces): (usize, Vec<Piece>),
    ) -> Slip<M> {
        let (sort, keys) = match is_twin {
            true => (Sort::Twin, 1),
            false => (Sort::Deletion, BLOCK_KEYS),
        };
        Slip {
            change: Change::Delete { index },
            count,
            pieces,
            sort,
            keys,
        }
    }

    /// The exchange of a block and the next one.
    pub(crate) fn exchange(index: usize, (count, pieces): (usize, Vec<Piece>)) -> Slip<M> {
        let (change, sort) = (Change::Exchange { index }, Sort::Exchange);
        Slip {
            change,
            count,
            pieces,
            sort,
            keys: 1,
        }
    }

    /// Whether it explains the text.
    pub(super) fn is_text(&self) -> bool {
        !matches!(
            self.sort,
            Sort::Calculated | Sort::Stated | Sort::Deletion | Sort::Insertion
        )
    }
}
