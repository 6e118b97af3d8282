//! The part's contour as 4B wants it: every corner a tangent arc that stays an arc when the controller adds its correction.
//!
//! The controller changes the radius of each arc by its correction and runs lines as they are written. The wire's path therefore
//! only joins where the contour turns nowhere but in arcs, each of which is larger than the correction where the wire runs inside of
//! it. The ways in and out are lines: they lead to where the wire's path begins, beside the contour.

use crate::finding::Side;
use crate::geometry::{Arc, Point, Segment, left_normal, turn};
use crate::program::grid::{point_of, snap};
use crate::program::write::{ProofError, scaled};
use crate::toolpath::{PathSegment, Source, WirePath};
use std::f64::consts::PI;

/// A joint that turns by less is tangent, radians: the wire's path has a step of less than 1 µm there for each millimetre of correction.
const TANGENT: f64 = 1e-3;

/// The path of a part's contour in µm: rounded at its corners with `radius`, moved beside the contour by the correction, µm both.
pub(super) fn rounded(path: &WirePath, scale: f64, correction: f64, radius: f64) -> Result<WirePath, ProofError> {
    let refused = |sentence: String| Err(ProofError::Refused(sentence));
    let Some(side) = path.side else {
        return refused("4B holds the part's contour: set compensation to controller, and say opening or punch".into());
    };
    let is_lead = |piece: &PathSegment| matches!(piece.source, Source::LeadIn | Source::LeadOut);
    let mut contour: Vec<PathSegment> = path.segments.iter().filter(|piece| !is_lead(piece)).copied().collect();
    contour.iter_mut().for_each(|piece| piece.geometry = scaled(&piece.geometry, scale));
    let (Some(first), Some(last)) = (contour.first().copied(), contour.last().copied()) else {
        return refused("there is no contour to cut".into());
    };
    for piece in &contour {
        if let Segment::Arc(arc) = piece.geometry
            && is_concave(&arc, side)
            && arc.radius <= correction
        {
            return refused(format!(
                "4B cannot have the arc R {:.3} mm at ({:.3}, {:.3}): the wire runs inside of it, expected more than the correction {:.3} mm",
                arc.radius / 1e3,
                arc.start.x / 1e3,
                arc.start.y / 1e3,
                correction / 1e3
            ));
        }
    }
    let entry = first.geometry.start();
    if turn(last.geometry.end_tangent(), first.geometry.start_tangent()).abs() > TANGENT {
        return refused(format!(
            "4B needs a transition arc at the corner ({:.3}, {:.3}), where the cut begins: give an entry on a line or an arc",
            entry.x / 1e3,
            entry.y / 1e3
        ));
    }
    let contour = with_transitions(&contour, radius)?;
    // The lines and arcs are those of the part, begun where the wire is.
    let beside = left_normal(first.geometry.start_tangent()) * (side.sign() * correction);
    let (Some(from), Some(to)) = (snap(entry), snap(entry + beside)) else {
        return Err(ProofError::Mismatch(format!("the path passes {entry:?} µm, too far out for a program")));
    };
    let by = point_of(to) - point_of(from);
    let thread = path.thread_hole * scale;
    let begin = entry + by;
    let mut segments = Vec::with_capacity(contour.len() + 2);
    let leads = (thread - begin).norm() > 1.0;
    segments.extend(leads.then(|| PathSegment { geometry: Segment::line(thread, begin), source: Source::LeadIn }));
    segments.extend(contour.iter().map(|piece| PathSegment { geometry: moved(&piece.geometry, by), ..*piece }));
    segments.extend(leads.then(|| PathSegment { geometry: Segment::line(begin, thread), source: Source::LeadOut }));
    Ok(WirePath { segments, thread_hole: thread, correction: 0.0, ..path.clone() })
}

/// The wire runs inside of an arc when the centre lies on its side.
pub(super) fn is_concave(arc: &Arc, side: Side) -> bool {
    (arc.sweep > 0.0) == (side == Side::Left)
}

/// Transition arcs of `radius` at the corners between lines; corners beside arcs are refused.
fn with_transitions(contour: &[PathSegment], radius: f64) -> Result<Vec<PathSegment>, ProofError> {
    let mut rounded: Vec<PathSegment> = Vec::with_capacity(contour.len() * 2);
    for piece in contour {
        let Some(before) = rounded.last().copied() else {
            rounded.push(*piece);
            continue;
        };
        let angle = turn(before.geometry.end_tangent(), piece.geometry.start_tangent());
        if angle.abs() <= TANGENT {
            rounded.push(*piece);
            continue;
        }
        let corner = piece.geometry.start();
        let at = format!("({:.3}, {:.3})", corner.x / 1e3, corner.y / 1e3);
        let (Segment::Line(a), Segment::Line(b)) = (before.geometry, piece.geometry) else {
            return Err(ProofError::Refused(format!(
                "4B needs a tangent transition at the corner {at}, which lies beside an arc: round it in the drawing with more than the correction"
            )));
        };
        let reach = radius * (angle.abs() / 2.0).tan();
        let room = a.length().min(b.length());
        if angle.abs() > PI - TANGENT || reach > room - 1.0 {
            return Err(ProofError::Refused(format!(
                "4B needs a transition arc of R {:.3} mm at the corner {at}, expected {:.3} mm of both lines, found {:.3} mm",
                radius / 1e3,
                reach / 1e3,
                room / 1e3
            )));
        }
        let (leaves, meets) = (a.end - a.direction() * reach, b.start + b.direction() * reach);
        let center: Point = leaves + left_normal(a.direction()) * (radius * angle.signum());
        let index = rounded.len() - 1;
        rounded[index].geometry = Segment::line(a.start, leaves);
        let transition = Segment::Arc(Arc { radius, ..Arc::about(center, leaves, meets, angle > 0.0) });
        rounded.push(PathSegment { geometry: transition, ..*piece });
        rounded.push(PathSegment { geometry: Segment::line(meets, b.end), ..*piece });
    }
    Ok(rounded)
}

fn moved(segment: &Segment, by: crate::geometry::Vector) -> Segment {
    match segment {
        Segment::Line(line) => Segment::line(line.start + by, line.end + by),
        Segment::Arc(arc) => Segment::Arc(Arc { center: arc.center + by, start: arc.start + by, end: arc.end + by, ..*arc }),
    }
}
