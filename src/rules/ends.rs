//! Moves one end of an entity while the other end stays.

use crate::drawing::{Change, ContourSegment, Drawing, Geometry, Vertex};
use crate::geometry::{Arc, Point, Segment, corner_between, led_to, turn};
use std::f64::consts::PI;

/// The change that moves the end (or, with `at_end` false, the start) of a contour's segment to `to`. A line swings
/// about its other end, an arc keeps its sweep. `None` where the segment is not the last of its entity on that side,
/// for a circle, for an arc of nearly a full turn, whose ends hardly determine it, and for arcs that stand for a curve.
pub(crate) fn end_moved(
    drawing: &Drawing,
    place: &ContourSegment,
    at_end: bool,
    to: Point,
) -> Option<Change> {
    let entity = place.entity;
    let own_end = at_end != place.reversed;
    let geometry = &drawing.get(entity)?.geometry;
    if !drawing.is_editable(entity) {
        return None;
    }
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

/// A move that turns a segment by less than this (radians) is none that a control, or a hand on the part, could find.
const SLIGHT: f64 = 1e-3;

/// The changes that join two ends which should meet: one of them moves onto the other. Where that would turn a segment, both
/// are made longer or shorter up to where they meet, if that is near; else the segment that turns least is moved. Where only one
/// is straight, that one moves as long as it hardly turns: a line tolerates that better than an arc.
pub(crate) fn joined(
    drawing: &Drawing,
    before: &ContourSegment,
    behind: &ContourSegment,
) -> Option<Vec<Change>> {
    let is_line = |place: &ContourSegment| place.geometry.as_arc().is_none();
    let (end, start) = (before.geometry.end(), behind.geometry.start());
    let turned = |place: &ContourSegment, from: Point, to: Point| {
        let fixed = match from == place.geometry.end() {
            true => place.geometry.start(),
            false => place.geometry.end(),
        };
        turn(from - fixed, to - fixed).abs()
    };
    let of_behind = (
        end_moved(drawing, behind, false, end),
        turned(behind, start, end),
    );
    let of_before = (
        end_moved(drawing, before, true, start),
        turned(before, end, start),
    );
    let moves = match is_line(before) && !is_line(behind) {
        true => [of_before, of_behind],
        false => [of_behind, of_before],
    };
    let possible = moves.into_iter();
    let mut possible = possible.filter_map(|(change, turned)| Some((vec![change?], turned)));
    let first = possible.next();
    if let Some((change, turned)) = &first
        && *turned <= SLIGHT
    {
        return Some(change.clone());
    }
    let moved = || {
        let moves = first.into_iter().chain(possible);
        moves.min_by(|(_, one), (_, other)| one.total_cmp(other))
    };
    led_together(drawing, before, behind).or_else(|| Some(moved()?.0))
}

/// The changes after which two segments that follow each other meet, each made longer or shorter on its own line or circle by no
/// more than their ends are apart: all directions stay.
pub(crate) fn led_together(
    drawing: &Drawing,
    before: &ContourSegment,
    behind: &ContourSegment,
) -> Option<Vec<Change>> {
    let corner = corner_between(&before.geometry, &behind.geometry)?;
    let led = |place: &ContourSegment, at_end: bool| {
        let entity = place.entity;
        match drawing.get(entity)?.geometry {
            Geometry::Arc { .. } if drawing.is_editable(entity) => {
                let own = drawing.segment(entity, 0)?;
                let led = led_to(&own, at_end != place.reversed, corner);
                let geometry = Geometry::of_arc(led.as_arc()?);
                Some(Change::Reshape { entity, geometry })
            }
            // The bulge of an arc would change with its length.
            _ if place.geometry.as_arc().is_some() => None,
            _ => end_moved(drawing, place, at_end, corner),
        }
    };
    Some(vec![led(before, true)?, led(behind, false)?])
}
