//! The results of a search through the faulty cuts.

use super::shape::Passes;
use crate::finding::FixKind;
use crate::program::iso::evidence::UsualDecimals;
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::Reading;
use crate::program::iso::style::Style;
use crate::program::repair::slip;
use crate::text::TextEdit;
use std::ops::Range;
use std::sync::Arc;

/// A possible intended line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Meant {
    pub(crate) line: Vec<u8>,
    /// The present text, and the intended one.
    pub(crate) found: String,
    pub(crate) meant: String,
    /// The number was calculated from the others, which may be wrong instead.
    pub(crate) is_calculated: bool,
    /// What the other numbers of the cut say against it.
    pub(crate) evidence: f64,
}

impl Meant {
    pub(super) fn new(line: Vec<u8>, found: &str, meant: &str) -> Meant {
        Meant {
            line,
            found: found.to_owned(),
            meant: meant.to_owned(),
            is_calculated: false,
            evidence: 0.0,
        }
    }
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
    /// No fault is left, and no other change does as well.
    pub(crate) is_sure: bool,
    /// The faults themselves support it: a cut that only crosses itself may be meant to run elsewhere altogether.
    pub(crate) explains: bool,
}

impl Repair {
    /// True for a line that only closes the cut: it would do so at any place.
    pub(crate) fn closes_anywhere(&self) -> bool {
        self.closes && matches!(self.kind, FixKind::InsertBlock { .. })
    }
}

/// The repairs of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Repairs {
    /// By the lines of the cuts that they belong to.
    pub(crate) of_cuts: Vec<(Range<usize>, Vec<Repair>)>,
    /// The searches for them.
    pub(super) searched: Vec<Searched>,
}

/// A search through a cut, and its result.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Searched {
    pub(crate) of: LookedAt,
    pub(crate) found: Vec<slip::Repair<Meant>>,
    /// Lines that may still be run after it.
    pub(crate) left: usize,
}

/// All that a search looks at: equal searches have equal results.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LookedAt {
    /// The lines of the cut and those about it in which numbers of blocks are looked for, and how many of them stand before it.
    pub(crate) text: Vec<u8>,
    pub(crate) lines_before: usize,
    pub(crate) lines: usize,
    /// The lines of its faults, from its first.
    pub(crate) faults: Vec<usize>,
    pub(crate) before: Machine,
    pub(crate) begins_astray: bool,
    pub(crate) reading: Reading,
    pub(crate) decimals: Option<UsualDecimals>,
    pub(crate) pointed: Option<bool>,
    pub(crate) is_parted: bool,
    pub(crate) styles: [Style; 2],
    pub(crate) passes: Option<Arc<Passes>>,
    /// Lines that may be run for it.
    pub(crate) left: usize,
}
