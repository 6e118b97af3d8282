//! A difference between a program and its drawing, as it is reported.

use super::traced::Block;
use crate::drawing::EntityId;
use crate::geometry::Side;
use std::ops::Range;

/// What is different at a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DifferenceKind {
    /// The block leads elsewhere than its segment.
    Block,
    /// Its contour lies elsewhere.
    Moved,
    /// The contour goes on where the program does not.
    Unfinished,
    /// No contour of the drawing matches it.
    Foreign,
    /// A way in or out, or between contours, of a program of ours.
    Lead,
    /// The coordinates after a block of such a program differ from its end.
    Stated,
    /// The control lets the wire run on one side, or none, and should on another.
    Side {
        stated: Option<Side>,
        ideal: Option<Side>,
    },
    /// A pass takes its correction from the place of another one.
    Register { stated: u32, ideal: u32 },
    /// A contour is cut at another correction than the others of its program, nm.
    Correction { stated: u32, ideal: u32 },
    /// The machine should stop before this block.
    Unstopped,
    /// The wire runs on the other side of an arc of 4B; it should run inside of it, or outside.
    Turned { inside: bool },
    /// A way in ends this far beside the path of its contour, which goes on from there.
    Astray,
    /// The wire runs on the other side of its contour than the settings say.
    OtherSide,
    /// From here on nothing is compared: the steps of the comparison are used up.
    Beyond,
}

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
}

/// The result of comparing a program with its drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The differences, in the order of the program.
    pub differences: Vec<Difference>,
    /// Bytes of the blocks of contours that lead where the drawing says.
    pub follows: Vec<Range<usize>>,
}
