//! A difference between a program and its drawing, as it is reported.

use super::traced::{Block, Traced};
use crate::drawing::EntityId;
use crate::finding::DifferenceKind;
use std::ops::Range;

/// A block that does not follow its drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Bytes of the block.
    pub range: Range<usize>,
    /// Its line, from 0.
    pub line: usize,
    /// The segment of the drawing that it should follow, where that is known.
    pub segment: Option<(EntityId, usize)>,
    /// Its deviation, mm.
    pub off: f64,
    pub kind: DifferenceKind,
}

impl Difference {
    /// The difference of a block, which is `off` µm from its place.
    pub(super) fn of(
        block: &Block,
        segment: Option<(EntityId, usize)>,
        off: f64,
        kind: DifferenceKind,
    ) -> Difference {
        Difference {
            range: block.range.clone(),
            line: block.line,
            segment,
            off: off / 1e3,
            kind,
        }
    }

    /// The same at the line that switches the correction of a block before another one of its pass, where there is one.
    pub(super) fn at_switch(
        traced: &Traced,
        block: &Block,
        index: usize,
        kind: DifferenceKind,
    ) -> Difference {
        let mut found = Difference::of(block, None, 0.0, kind);
        let switch = block.side.and_then(|_| traced.switch_before(index));
        if let Some((range, line)) = switch {
            (found.range, found.line) = (range, line);
        }
        found
    }
}

/// The result of comparing a program with its drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The differences, in the order of the program.
    pub differences: Vec<Difference>,
    /// Bytes of the blocks of contours that lead where the drawing says.
    pub follows: Vec<Range<usize>>,
}
