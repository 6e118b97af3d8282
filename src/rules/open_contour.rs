//! `open-contour`: a contour that does not come back to its start.
//!
//! The wire has no side on an open contour, and nothing drops out of the plate. Fix: close it with a line.

use super::{ContourRule, Outlook};
use crate::drawing::{Change, Geometry};
use crate::finding::{Detail, Fix, FixKind, Place, Rule, Severity};
use crate::geometry::Segment;
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

fn ends(outlook: &Outlook) -> Option<(Segment, Segment)> {
    let last = outlook.segment(outlook.contour.len() as isize - 1)?;
    Some((last.geometry, outlook.segment(0)?.geometry))
}

fn detail(outlook: &Outlook) -> Option<Detail> {
    let (last, first) = ends(outlook)?;
    Some(Detail::OpenContour {
        distance: (first.start() - last.end()).norm(),
    })
}

fn fixes(outlook: &Outlook) -> Vec<Fix> {
    let Some((last, first)) = ends(outlook) else {
        return Vec::new();
    };
    let (from, to) = (last.end(), first.start());
    let length = (to - from).norm();
    let contour = outlook.contour;
    // Closing a single line with another would only cut it twice.
    let encloses = contour.len() > 1 || last.as_arc().is_some();
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
    let preferred = length < (SHARE * along).max(JOINS * outlook.limits.tolerances.join);
    vec![Fix {
        preferred,
        in_fix_all: false,
        ..Fix::new(FixKind::Close { length }, vec![change])
    }]
}
