//! The path of the wire's centre: offset, corners, leads, order.

use crate::drawing::{Drawing, EntityId, Outline};
use crate::finding::Finding;
use crate::geometry::{Point, Segment};
use crate::settings::Effective;

/// Where a piece of the path comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The offset of this segment of an entity.
    Segment {
        entity: EntityId,
        segment: usize,
    },
    /// The way round the convex corner at the end of this segment.
    Corner {
        entity: EntityId,
        segment: usize,
    },
    LeadIn,
    LeadOut,
}

/// One piece of the path of the wire's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSegment {
    pub geometry: Segment,
    pub source: Source,
}

/// The path of the wire's centre for one contour in one pass, in drawing units.
#[derive(Clone, Debug, PartialEq)]
pub struct WirePath {
    /// Index of the outline in the drawing's list.
    pub outline: usize,
    /// How far the path lies from the contour, drawing units; 0 where the contour is the path.
    pub correction: f64,
    /// Where the wire is threaded and comes back to.
    pub thread_hole: Point,
    /// In order of travel, lead-in and lead-out included.
    pub segments: Vec<PathSegment>,
}

/// Why no path can be made; a plain sentence for the user, lower-case, no final dot.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    Sentence(String),
    /// Findings that the drawing gets only when a path is asked for, such as `lead-in`.
    Findings(Vec<Finding>),
}

/// The paths of all `outlines`, or of those that hold one of `handles`, in machining order.
pub fn plan(
    _drawing: &Drawing,
    _outlines: &[Outline],
    _settings: &Effective,
    _handles: Option<&[String]>,
) -> Result<Vec<WirePath>, Refusal> {
    Ok(Vec::new())
}
