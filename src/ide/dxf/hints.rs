//! The radius and the sweep of each arc, beside the number that makes it one.

use crate::drawing::{Geometry, Unit};
use crate::dxf::Document;
use crate::finding::Place;
use crate::geometry::Segment;
use crate::ide::amounts::rounded;
use crate::ide::{HINT_LINES, Hint};
use std::ops::Range;

/// Hints for a range of bytes, in the order of the text.
pub(crate) fn hints(document: &Document, range: Range<usize>, unit: Unit) -> Vec<Hint> {
    let text = document.text();
    let end = text
        .line_start(text.line_of(range.start) + HINT_LINES)
        .min(range.end);
    let mut found = Vec::new();
    for (id, segment) in document.segments_at(range.start..end.max(range.start)) {
        let Some(entity) = document.drawing().get(id) else {
            continue;
        };
        let arc = match (&entity.geometry, document.drawing().segment(id, segment)) {
            (Geometry::Polyline { .. } | Geometry::Arc { .. }, Some(Segment::Arc(arc))) => arc,
            _ => continue,
        };
        let place = document.range_of(&Place::Segment {
            entity: id,
            segment,
        });
        if place.start < range.start || place.end > end {
            continue;
        }
        let sweep = rounded_to(arc.sweep.to_degrees(), 3);
        let radius = rounded_to(arc.radius * unit.mm, 4);
        let text = match entity.geometry {
            Geometry::Polyline { .. } => format!("R {radius} mm, {sweep}°"),
            _ if unit.mm == 1.0 => format!("{sweep}°"),
            _ => format!("{radius} mm, {sweep}°"),
        };
        found.push(Hint {
            offset: place.end,
            text,
        });
    }
    found
}

fn rounded_to(value: f64, decimals: i32) -> String {
    let scale = 10f64.powi(decimals);
    rounded((value * scale).round() / scale, 6)
}
