//! What is taken of a drawing: its contours, and what holds for them.

use crate::drawing::{ContourSegment, Drawing, Outline};
use crate::geometry::Side;
use crate::settings::Effective;

/// A contour that is cut.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Contour {
    /// In the direction of travel, in the drawing's unit.
    pub segments: Vec<ContourSegment>,
    pub closed: bool,
    /// Side of the direction of travel on which the wire runs, where that is known.
    pub side: Option<Side>,
}

/// From what a program, or the way of the wire round a contour, is laid again.
#[derive(Clone, Copy)]
pub(super) struct Basis<'a> {
    pub(super) drawing: &'a Drawing,
    pub(super) outlines: &'a [Outline],
    pub(super) contours: &'a [Contour],
    pub(super) settings: &'a Effective,
    /// mm of the drawing's unit.
    pub(super) unit_mm: f64,
}
