//! The results of a search through the faulty cuts.

use crate::finding::FixKind;
use crate::text::TextEdit;
use std::ops::Range;

/// A possible intended line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Meant {
    pub(crate) line: Vec<u8>,
    /// The present text, and the intended one.
    pub(crate) found: String,
    pub(crate) meant: String,
}

/// A change that makes a cut sound, or sounder.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Repair {
    pub(crate) kind: FixKind,
    pub(crate) edits: Vec<TextEdit>,
    /// The line that it changes first.
    pub(crate) line: usize,
    /// The present text, and the intended one.
    pub(crate) found: String,
    pub(crate) meant: String,
    /// The cut does not close without it.
    pub(crate) closes: bool,
    /// Nothing else explains the text.
    pub(crate) is_sure: bool,
    /// Something contradicts the cut: one that only crosses itself may be meant to run elsewhere altogether.
    pub(crate) explains: bool,
}

impl Repair {
    /// True for a line that only closes the cut: it would do so at any place.
    pub(crate) fn closes_anywhere(&self) -> bool {
        self.closes && matches!(self.kind, FixKind::InsertBlock { .. })
    }
}

/// The repairs of a program, by the lines of the cuts that they belong to.
pub(crate) type Repairs = Vec<(Range<usize>, Vec<Repair>)>;
