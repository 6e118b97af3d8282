//! Pieces of a way as a polyline of a drawing, in mm.

use crate::drawing::{Geometry, Vertex};
use crate::geometry::{Arc, Point, Segment};
use std::f64::consts::TAU;

/// An arc of more is written in two: near a full turn a bulge does not hold it well.
pub(in crate::program) const MOST_BY_BULGE: f64 = TAU * 0.75;

/// Whether a piece becomes two segments of the polyline.
pub(super) fn is_halved(piece: &Segment) -> bool {
    let is_long = |arc: &Arc| arc.sweep.abs() > MOST_BY_BULGE;
    piece.as_arc().is_some_and(is_long)
}

/// The pieces, µm, as a polyline in mm; arcs near a full turn in two halves. `None` for less than two vertices.
pub(in crate::program) fn polyline(pieces: &[Segment], closed: bool) -> Option<Geometry> {
    let last = pieces.last()?;
    let mut vertices = Vec::with_capacity(pieces.len() + 1);
    let mut push = |at: Point, bulge: f64| {
        vertices.push(Vertex {
            point: at / 1e3,
            bulge,
        })
    };
    for piece in pieces {
        match piece {
            Segment::Arc(arc) if is_halved(piece) => {
                let bulge = (arc.sweep / 8.0).tan();
                push(arc.start, bulge);
                push(arc.point_at(0.5), bulge);
            }
            piece => push(piece.start(), piece.bulge()),
        }
    }
    if !closed {
        push(last.end(), 0.0);
    }
    (vertices.len() >= 2).then_some(Geometry::Polyline { closed, vertices })
}
