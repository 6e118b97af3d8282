//! `open-contour`: a contour that does not come back to its start.
//!
//! The wire has no side on an open contour, and nothing drops out of the plate. Fix: close it with a line; ends that
//! lie near each other, and near no other one, are brought together.

use super::ends::{joined, led_together};
use super::{ContourRule, Limits, Outlook};
use crate::drawing::{Change, ContourSegment, Geometry};
use crate::finding::{Detail, Fix, FixKind, Place, Rule, Severity};
use crate::geometry::{Bounds, Grid, Point, Tolerances};
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

/// A gap below this share of the contour, or below this many times the distance at which ends certainly meet (1 mm), was most likely meant to be
/// closed.
const SHARE: f64 = 0.05;
const JOINS: f64 = 100.0;

/// Ends within this many times the distance at which ends certainly meet (0.1 mm) may have been rounded apart.
const JOINABLE: f64 = 10.0;
/// In a drawing of more entities, each contour is not compared with all of them.
const LOOKED_THROUGH: usize = 4_000;

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
    let own = [last.geometry.end(), first.geometry.start()];
    let is_small = outlook.drawing.len() <= LOOKED_THROUGH;
    Some(Detail::OpenContour {
        distance: (own[1] - own[0]).norm(),
        next: is_small.then(|| next_end(outlook, own)).flatten(),
    })
}

/// The distance, more than what is joined, at which the ends of this contour lie from the next ones that are free; the larger of both.
fn next_end(outlook: &Outlook, own: [Point; 2]) -> Option<f64> {
    let pieces = &outlook.contour.pieces;
    let others = outlook.drawing.entities().filter_map(|(id, entity)| {
        let (start, end) = entity.geometry.ends()?;
        let is_near = [start, end].iter().any(|point| {
            let reach = JOINABLE * outlook.limits.tolerances.certain;
            own.iter().any(|end| (point - end).norm() <= reach)
        });
        let is_other = is_near && !pieces.iter().any(|piece| piece.entity == id);
        is_other.then_some([start, end])
    });
    let others: Vec<Point> = others.flatten().collect();
    farthest([(own, outlook.contour.len())], outlook.limits, |_, _| {
        others.clone()
    })
}

/// The same of many contours, among their ends.
pub(crate) fn ends_apart(met: &[Outlook]) -> Option<f64> {
    let limits = met.first()?.limits;
    let all = met.iter().filter_map(|outlook| {
        let (last, first) = ends(outlook)?;
        let own = [last.geometry.end(), first.geometry.start()];
        Some((own, outlook.contour.len()))
    });
    let all: Vec<([Point; 2], usize)> = all.collect();
    let mut grid = Grid::default();
    for (number, (ends, _)) in all.iter().enumerate() {
        let insert = |&end: &Point| grid.insert((number, end), Bounds::of_points(&[end]));
        ends.iter().for_each(insert);
    }
    let reach = JOINABLE * limits.tolerances.certain;
    farthest(all.iter().copied(), limits, |own, at| {
        let mut near = Vec::new();
        grid.near(&Bounds::of_disc(at, reach), |(number, end), _| {
            near.extend((number != own).then_some(end));
        });
        near
    })
}

/// The largest distance from an end of contours, each with its number of segments, to the next one that is free: among `others` near it
/// and, of more than a segment, the contour's own.
fn farthest(
    contours: impl IntoIterator<Item = ([Point; 2], usize)>,
    limits: &Limits,
    others: impl Fn(usize, Point) -> Vec<Point>,
) -> Option<f64> {
    let Tolerances { join, certain, .. } = limits.tolerances;
    let mut farthest = None;
    for (number, (ends, segments)) in contours.into_iter().enumerate() {
        for (end, own) in [(ends[0], ends[1]), (ends[1], ends[0])] {
            let others = others(number, end);
            let is_free = |(at, other): &(usize, &Point)| {
                let mut rest = others.iter().enumerate().filter(|(rest, _)| rest != at);
                rest.all(|(_, rest)| (rest - *other).norm() > certain)
            };
            let free = others
                .iter()
                .enumerate()
                .filter(is_free)
                .map(|(_, other)| *other);
            let own = (segments > 1).then_some(own);
            let distances = free.chain(own).map(|other| (other - end).norm());
            let next = distances.fold(f64::INFINITY, f64::min);
            if next > join && next <= JOINABLE * certain {
                farthest = Some(farthest.map_or(next, |farthest: f64| farthest.max(next)));
            }
        }
    }
    farthest
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
    // Both keep their directions where they can.
    let snapped = is_sure.then(|| {
        let led = led_together(outlook.drawing, &last, &first);
        led.or_else(|| joined(outlook.drawing, &last, &first))
    });
    let snap = |changes| Fix::new(FixKind::Snap { distance: length }, changes);
    let snap = snapped.flatten().map(snap);
    let is_near = length < (SHARE * along).max(JOINS * outlook.limits.tolerances.certain);
    let close = Fix {
        preferred: is_near && snap.is_none(),
        in_fix_all: false,
        ..Fix::new(FixKind::Close { length }, vec![change])
    };
    snap.into_iter().chain([close]).collect()
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
