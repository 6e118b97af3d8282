//! Moves one end of an entity while the other end stays.

use crate::drawing::{Change, ContourSegment, Drawing, Geometry, Vertex};
use crate::geometry::{Arc, Point, Segment};
use std::f64::consts::PI;

/// The change that moves the end (or, with `at_end` false, the start) of a contour's segment to `to`. A line swings
/// about its other end, an arc keeps its sweep. `None` where the segment is not the last of its entity on that side,
/// for a circle, and for an arc of nearly a full turn, whose ends hardly determine it.
pub(crate) fn end_moved(
    drawing: &Drawing,
    place: &ContourSegment,
    at_end: bool,
    to: Point,
) -> Option<Change> {
    let entity = place.entity;
    let own_end = at_end != place.reversed;
    let geometry = &drawing.get(entity)?.geometry;
    match geometry {
        Geometry::Line { start, end } => {
            let (start, end) = if own_end { (*start, to) } else { (to, *end) };
            let geometry = Geometry::Line { start, end };
            Some(Change::Reshape { entity, geometry })
        }
        Geometry::Arc { .. } => {
            let Segment::Arc(own) = drawing.segment(entity, 0)? else {
                return None;
            };
            let (start, end) = if own_end {
                (own.start, to)
            } else {
                (to, own.end)
            };
            let moved = (own.sweep < 1.9 * PI)
                .then(|| Arc::from_bulge(start, end, own.bulge()))
                .flatten()?;
            let geometry = Geometry::of_arc(&moved);
            Some(Change::Reshape { entity, geometry })
        }
        Geometry::Polyline {
            closed: false,
            vertices,
        } => {
            let index = if own_end {
                vertices.len().checked_sub(1)?
            } else {
                0
            };
            let at_this_end = if own_end {
                place.segment + 2 == vertices.len()
            } else {
                place.segment == 0
            };
            let vertex = Vertex {
                point: to,
                ..*vertices.get(index)?
            };
            at_this_end.then_some(Change::SetVertex {
                entity,
                index,
                vertex,
            })
        }
        Geometry::Polyline { .. } | Geometry::Circle { .. } | Geometry::Text { .. } => None,
    }
}

/// The change that joins two ends which should meet: the start of the later segment moves to the end of the earlier
/// one. Where only the earlier one is straight, that one moves instead: a line tolerates that
/// better than an arc.
pub(crate) fn joined(
    drawing: &Drawing,
    before: &ContourSegment,
    behind: &ContourSegment,
) -> Option<Change> {
    let is_line = |place: &ContourSegment| place.geometry.as_arc().is_none();
    let (end, start) = (before.geometry.end(), behind.geometry.start());
    let of_behind = || end_moved(drawing, behind, false, end);
    let of_before = || end_moved(drawing, before, true, start);
    if is_line(before) && !is_line(behind) {
        of_before().or_else(of_behind)
    } else {
        of_behind().or_else(of_before)
    }
}
