//! A contour of a drawing that is cut.

use crate::drawing::ContourSegment;
use crate::geometry::Side;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Contour {
    /// In the direction of travel, in the drawing's unit.
    pub(super) segments: Vec<ContourSegment>,
    pub(super) closed: bool,
    /// Side of the direction of travel on which the wire runs, where that is known.
    pub(super) side: Option<Side>,
    /// The wire's centre runs on it.
    pub(super) on_line: bool,
}
