//! Differences between a program and its drawing, as numbers.

use std::sync::Arc;

/// A difference between a program and its drawing. `other` is the name of the other document.
#[derive(Clone, Debug, PartialEq)]
pub enum Unlike {
    /// A block of the program does not lead to the end of a segment of the drawing; `off` is in mm.
    Block {
        other: Arc<str>,
        handle: String,
        segment: usize,
        off: f64,
    },
    /// A contour of the program begins `off` mm beside the drawing's.
    Moved {
        other: Arc<str>,
        handle: String,
        off: f64,
    },
    /// The program leaves a contour before it is complete, where this segment of the drawing would be next.
    Unfinished {
        other: Arc<str>,
        handle: String,
        segment: usize,
    },
    /// A contour, or a pass, of the program matches nothing in the drawing.
    Foreign { other: Arc<str> },
    /// A way in or out, or between contours, does not lead where the drawing and its settings want it; `off` is in mm.
    Lead { other: Arc<str>, off: f64 },
    /// The coordinates behind a block differ from the end in the drawing; `off` is in mm.
    Stated { other: Arc<str>, off: f64 },
    /// A block of the program, on a line from 1, does not follow this segment of the drawing; `off` is in the drawing's
    /// unit.
    Segment {
        other: Arc<str>,
        line: usize,
        off: f64,
    },
    /// The program, on a line from 1, begins this contour elsewhere, this far off in the drawing's unit.
    Begin {
        other: Arc<str>,
        line: usize,
        off: f64,
    },
    /// The program leaves this contour behind a line, from 1, before it has cut this segment.
    Left { other: Arc<str>, line: usize },
    /// The two have nothing in common.
    Nothing { other: Arc<str> },
    /// An electrode mills it otherwise than the settings of the drawing say, so its blocks are not compared.
    Milled { other: Arc<str> },
    /// The other document cannot be read.
    Unreadable { other: Arc<str>, reason: String },
    /// The program may belong to `more` as well.
    Several { other: Arc<str>, more: String },
}

impl Unlike {
    /// The distance, in the unit of its document.
    pub fn off(&self) -> Option<f64> {
        match self {
            Unlike::Block { off, .. }
            | Unlike::Moved { off, .. }
            | Unlike::Lead { off, .. }
            | Unlike::Stated { off, .. }
            | Unlike::Segment { off, .. }
            | Unlike::Begin { off, .. } => Some(*off),
            _ => None,
        }
    }

    /// Concerns both documents as a whole, which is no error of either.
    pub(crate) fn is_of_whole(&self) -> bool {
        matches!(
            self,
            Unlike::Nothing { .. }
                | Unlike::Milled { .. }
                | Unlike::Unreadable { .. }
                | Unlike::Several { .. }
        )
    }
}
