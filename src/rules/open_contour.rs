//! `open-contour`: a contour that does not come back to its start.
//!
//! The wire has no side on an open contour, and nothing drops out of the plate. Fix: close it with a line; ends that
//! lie near each other, and near no other one, are brought together.

use super::ends::{end_moved, joined};
use super::{ContourRule, Outlook};
use crate::drawing::{Change, ContourSegment, Geometry};
use crate::finding::{Detail, Fix, FixKind, Place, Rule, Severity};
use crate::geometry::{Point, Segment, line_line};
use crate::settings::{Compensation, Effective};

pub(crate) const RULE: ContourRule = ContourRule {
    rule: Rule::OpenContour,
    holds,
    mildest,
    places,
    detail,
    fixes,
    many: MANY,
};

/// So many open contours are no slips: the drawing holds more than what is cut, as a sheet of several views.
const MANY: usize = 8;

/// A gap below this share of the contour, or below this many join tolerances (1 mm), was most likely meant to be
/// closed.
const SHARE: f64 = 0.05;
const JOINS: f64 = 100.0;

fn holds(outlook: &Outlook) -> bool {
    !outlook.contour.closed
}

/// Where the contour itself is the wire's path, or the middle of a milled slot, it may well be open.
fn mildest(settings: &Effective) -> Option<Severity> {
    let is_path = settings.compensation == Compensation::None || settings.mills;
    is_path.then_some(Severity::Information)
}

fn places(outlook: &Outlook) -> Option<(Place, Vec<Place>)> {
    let last = outlook.contour.len().checked_sub(1)?;
    let first = if last > 0 { outlook.place(0) } else { None };
    Some((outlook.place(last)?, first.into_iter().collect()))
}

/// The last segment and the first one.
fn ends(outlook: &Outlook) -> Option<(ContourSegment, ContourSegment)> {
    let last = outlook.segment(outlook.contour.len() as isize - 1)?;
    Some((last, outlook.segment(0)?))
}

fn detail(outlook: &Outlook) -> Option<Detail> {
    let (last, first) = ends(outlook)?;
    Some(Detail::OpenContour {
        distance: (first.geometry.start() - last.geometry.end()).norm(),
    })
}

fn fixes(outlook: &Outlook) -> Vec<Fix> {
    let Some((last, first)) = ends(outlook) else {
        return Vec::new();
    };
    let (from, to) = (last.geometry.end(), first.geometry.start());
    let length = (to - from).norm();
    let contour = outlook.contour;
    // Closing a single line with another would only cut it twice.
    let encloses = contour.len() > 1 || last.geometry.as_arc().is_some();
    let Some(piece) = contour
        .pieces
        .last()
        .filter(|_| encloses && !contour.closed && length > outlook.limits.tolerances.join)
    else {
        return Vec::new();
    };
    // A spline has no vertices of its own with which to close it.
    let own = outlook.drawing.is_editable(piece.entity)
        && matches!(
            outlook
                .drawing
                .get(piece.entity)
                .map(|entity| &entity.geometry),
            Some(Geometry::Polyline { .. })
        );
    let change = match contour.pieces.len() {
        1 if own => Change::SetClosed {
            entity: piece.entity,
            closed: true,
        },
        _ => Change::AddEntity {
            after: piece.entity,
            geometry: Geometry::Line {
                start: from,
                end: to,
            },
        },
    };
    let along: f64 = contour
        .segments(outlook.drawing)
        .map(|segment| segment.geometry.length())
        .sum();
    // No wire passes an opening so narrow, and nothing else can have been meant.
    let is_slip = length < SHARE * along && length < outlook.limits.correction;
    let is_sure = contour.len() > 1 && is_slip && are_alone(outlook, [from, to]);
    let snapped = is_sure.then(|| brought_together(outlook, &last, &first));
    let snap = |changes| Fix::new(FixKind::Snap { distance: length }, changes);
    let snap = snapped.flatten().map(snap);
    let is_near = length < (SHARE * along).max(JOINS * outlook.limits.tolerances.join);
    let close = Fix {
        preferred: is_near && snap.is_none(),
        in_fix_all: false,
        ..Fix::new(FixKind::Close { length }, vec![change])
    };
    snap.into_iter().chain([close]).collect()
}

/// The changes after which the last segment ends where the first one begins: straight ones keep their directions, where
/// these meet near by.
fn brought_together(
    outlook: &Outlook,
    last: &ContourSegment,
    first: &ContourSegment,
) -> Option<Vec<Change>> {
    let drawing = outlook.drawing;
    let corner = met(last, first).and_then(|corner| {
        let both = [
            end_moved(drawing, last, true, corner),
            end_moved(drawing, first, false, corner),
        ];
        both.into_iter().collect()
    });
    corner.or_else(|| joined(drawing, last, first).map(|change| vec![change]))
}

/// Where two straight segments that follow each other would meet, no farther from either end than these are from each
/// other.
fn met(last: &ContourSegment, first: &ContourSegment) -> Option<Point> {
    let (Segment::Line(last), Segment::Line(first)) = (&last.geometry, &first.geometry) else {
        return None;
    };
    let (from, to) = (last.end, first.start);
    let corner = line_line(from, last.direction(), to, first.direction())?;
    let reach = (to - from).norm();
    let is_near = |end: Point| (corner - end).norm() <= reach;
    (is_near(from) && is_near(to)).then_some(corner)
}

/// Whether no entity of another contour ends as near to one of these ends as a wire is wide.
fn are_alone(outlook: &Outlook, ends: [Point; 2]) -> bool {
    let reach = 2.0 * outlook.limits.correction;
    let is_near = |point: Point| ends.iter().any(|end| (point - end).norm() < reach);
    let own = &outlook.contour.pieces;
    // Few are near: the pieces of the contour are looked through for these alone.
    outlook.drawing.entities().all(|(id, entity)| {
        let ends = entity.geometry.ends();
        !ends.is_some_and(|(start, end)| is_near(start) || is_near(end))
            || own.iter().any(|piece| piece.entity == id)
    })
}
