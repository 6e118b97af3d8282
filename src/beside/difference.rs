//! A difference between a program and its drawing, as it is reported.

use super::traced::Block;
use super::walk::Kind;
use crate::drawing::EntityId;
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
    pub kind: Kind,
}

impl Difference {
    /// The difference of a block, which is `off` µm from its place.
    pub(super) fn of(
        block: &Block,
        segment: Option<(EntityId, usize)>,
        off: f64,
        kind: Kind,
    ) -> Difference {
        Difference {
            range: block.range.clone(),
            line: block.line,
            segment,
            off: off / 1e3,
            kind,
        }
    }

    /// It is in the words for the side of the wire.
    pub(super) fn is_of_side(&self) -> bool {
        matches!(self.kind, Kind::Side { .. } | Kind::Turned { .. })
    }
}

/// The result of comparing a program with its drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The differences, in the order of the program.
    pub differences: Vec<Difference>,
    /// Bytes of the blocks that end where the drawing says.
    pub follows: Vec<Range<usize>>,
}
