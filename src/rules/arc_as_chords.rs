//! `arc-as-chords`: five or more lines in a row whose ends lie on one circle.
//!
//! Somewhere on its way the drawing's arc was broken into chords. The wire cuts the facets, and the program has a block for
//! each. Fix: one arc.
//!
//! What is seen at a segment depends on a window of [`LEAST`] chords from there on and from the one before: a sequence begins
//! where a window fits one circle and that before does not. How far the sequence reaches is found when it is shown.

use super::{LocalRule, Observation, Outlook};
use crate::drawing::{Change, ContourSegment, Geometry, Vertex};
use crate::finding::{Detail, Fix, FixKind, Rule};
use crate::geometry::{Arc, Line, Point, Segment, cross, left_normal, line_line, positive_angle};
use std::f64::consts::TAU;
use std::ops::Range;

pub(crate) const RULE: LocalRule = LocalRule {
    rule: Rule::ArcAsChords,
    check,
    reach: |_, _| (LEAST, 1),
    holds,
    detail,
    fixes,
    ..LocalRule::PLAIN
};

/// Chords that make an arc.
const LEAST: usize = 5;

/// Chords of one finding; more of them are a second one once the first are an arc.
const MOST: usize = 4096;

/// Tangent of the largest turn (25°) from chord to chord: a hexagon is a hexagon, 16 chords to the round are an arc.
const STEEPEST: f64 = 0.466_307_658;

/// The circle that some points in a row lie on.
#[derive(Clone, Copy, Debug)]
struct Fit {
    center: Point,
    radius: f64,
    deviation: f64,
    counter_clockwise: bool,
}

/// The circle of the ends of chords in a row; `None` where they do not all turn the same way, by little enough, within
/// `tolerance` of one circle, and clearly more so than of a straight line.
fn fit(points: &[Point], tolerance: f64) -> Option<Fit> {
    let (&first, &last) = (points.first()?, points.last()?);
    let mut side = 0.0;
    for corner in points.windows(3) {
        let (one, other) = (corner[1] - corner[0], corner[2] - corner[1]);
        let (sine, cosine) = (cross(one, other), one.dot(&other));
        if sine == 0.0 || sine * side < 0.0 || cosine <= 0.0 || sine.abs() > STEEPEST * cosine {
            return None;
        }
        side = sine;
    }
    let chords = points.len() - 1;
    // All the way round, the ends are one point.
    let round = (last - first).norm() < (points[1] - first).norm() * 0.5;
    let (middle, end) = if round {
        (points[chords / 3], points[2 * chords / 3])
    } else {
        (points[chords / 2], last)
    };
    let center = center_through(first, middle, end)?;
    let radius = (first - center).norm();
    let deviation = points
        .iter()
        .map(|point| ((point - center).norm() - radius).abs())
        .fold(0.0, f64::max);
    let (axis, straight) = (last - first, (last - first).norm());
    let rise = if round {
        radius
    } else {
        points
            .iter()
            .map(|point| cross(axis, point - first).abs())
            .fold(0.0, f64::max)
            / straight
    };
    (deviation <= tolerance && rise > 4.0 * deviation).then_some(Fit {
        center,
        radius,
        deviation,
        counter_clockwise: side > 0.0,
    })
}

fn center_through(a: Point, b: Point, c: Point) -> Option<Point> {
    let (one, other) = (b - a, c - b);
    line_line(
        a + one * 0.5,
        left_normal(one),
        b + other * 0.5,
        left_normal(other),
    )
}

/// Corners of the segments from `first` on, as far as they are lines, at most `count` of them.
fn corners(outlook: &Outlook, first: isize, count: usize) -> Vec<Point> {
    let mut points = Vec::with_capacity(count.min(MOST) + 1);
    let mut end = None;
    for index in first..first + count as isize {
        let Some(Segment::Line(line)) = outlook.segment(index).map(|segment| segment.geometry)
        else {
            break;
        };
        points.push(line.start);
        end = Some(line.end);
    }
    points.extend(end);
    points
}

fn window_fits(outlook: &Outlook, first: isize) -> bool {
    let points = corners(outlook, first, LEAST);
    points.len() > LEAST && fit(&points, outlook.limits.tolerances.chords).is_some()
}

fn check(outlook: &Outlook, range: Range<usize>, observations: &mut Vec<Observation>) {
    // From the segment before the range on.
    let fits = windows(outlook, range.start as isize - 1..range.end as isize);
    for (index, pair) in range.zip(fits.windows(2)) {
        // A round of nothing but chords has no beginning: it may be given one at the first segment.
        if pair[1] && (!pair[0] || (outlook.contour.closed && index == 0)) {
            observations.push(Observation::at(index));
        }
    }
}

/// Whether [`LEAST`] chords of one circle follow each other from each of some segments on.
fn windows(outlook: &Outlook, starts: Range<isize>) -> Vec<bool> {
    if outlook.contour.len() < LEAST {
        return vec![false; starts.len()];
    }
    // `None` for what is no line.
    let line = |index: isize| match outlook.segment(index)?.geometry {
        Segment::Line(line) => Some(line),
        Segment::Arc(_) => None,
    };
    let lines: Vec<_> = (starts.start..starts.end + LEAST as isize - 1)
        .map(line)
        .collect();
    let mut points = [Point::origin(); LEAST + 1];
    let fits = |window: &[Option<Line>]| {
        for (chord, slot) in window.iter().enumerate() {
            let Some(line) = slot else { return false };
            (points[chord], points[chord + 1]) = (line.start, line.end);
        }
        fit(&points, outlook.limits.tolerances.chords).is_some()
    };
    lines.windows(LEAST).map(fits).collect()
}

/// For each of some segments: whether the corner where it begins is one between chords that are told as an arc.
pub(crate) fn are_between_chords(outlook: &Outlook, range: Range<usize>) -> Vec<bool> {
    // The chord before the corner and the one behind it lie in one window.
    let starts = range.start as isize - (LEAST as isize - 1)..range.end as isize - 1;
    windows(outlook, starts)
        .windows(LEAST - 1)
        .map(|windows| windows.contains(&true))
        .collect()
}

/// What is told of a corner may depend on so many segments before and behind it.
pub(crate) const REACH: usize = LEAST;

/// Corners that turn by more (radians) are none between chords.
pub(crate) fn steepest() -> f64 {
    STEEPEST.atan()
}

/// At the first segment of a closed contour: whether the sequence begins there, or is one that has no beginning.
fn holds(outlook: &Outlook, observation: Observation) -> bool {
    let most = outlook.contour.len().min(MOST) as isize;
    let first = observation.index as isize;
    !window_fits(outlook, first - 1) || (2..most).all(|back| window_fits(outlook, first - back))
}

/// The longest sequence from `first` on that one circle holds.
fn sequence(outlook: &Outlook, first: usize) -> Option<(usize, Fit, Vec<Point>)> {
    let tolerance = outlook.limits.tolerances.chords;
    let mut points = corners(outlook, first as isize, outlook.contour.len().min(MOST));
    let mut chords = LEAST;
    while chords + 1 < points.len()
        && fit(&points[chords + 1 - LEAST..=chords + 1], tolerance).is_some()
    {
        chords += 1;
    }
    points.truncate(chords + 1);
    if let Some(whole) = fit(&points, tolerance) {
        return Some((chords, whole, points));
    }
    let (mut fitting, mut too_many) = (LEAST, chords);
    while too_many - fitting > 1 {
        let middle = fitting.midpoint(too_many);
        match fit(&points[..=middle], tolerance) {
            Some(_) => fitting = middle,
            None => too_many = middle,
        }
    }
    points.truncate(fitting + 1);
    let best = fit(&points, tolerance)?;
    Some((fitting, best, points))
}

fn detail(outlook: &Outlook, observation: Observation, _count: Option<usize>) -> Option<Detail> {
    let (chords, fit, _) = sequence(outlook, observation.index as usize)?;
    Some(Detail::ArcAsChords {
        chords,
        center: fit.center,
        radius: fit.radius,
        deviation: fit.deviation,
    })
}

fn fixes(outlook: &Outlook, observation: Observation) -> Vec<Fix> {
    let first = observation.index as usize;
    let count = outlook.contour.len();
    let Some((mut chords, fit, mut points)) = sequence(outlook, first) else {
        return Vec::new();
    };
    let mut arcs: Vec<(Range<usize>, Arc)> = Vec::new();
    let mut add = |range: Range<usize>, fit: &Fit, points: &[Point]| {
        let arc = Arc::about(
            fit.center,
            points[range.start],
            points[range.end],
            fit.counter_clockwise,
        );
        arcs.push((range, arc));
    };
    if chords == count && outlook.contour.closed {
        // All the way round, it takes two arcs.
        add(0..chords / 2, &fit, &points);
        add(chords / 2..chords, &fit, &points);
    } else {
        add(0..chords, &fit, &points);
        // What one finding does not hold goes on behind it: it would be the next finding.
        let (mut last, limit) = (
            chords,
            if outlook.contour.closed {
                count
            } else {
                count - first
            },
        );
        while last == MOST
            && chords < limit
            && let Some((more, further, behind)) = sequence(outlook, (first + chords) % count)
        {
            last = more;
            let more = more.min(limit - chords);
            points.extend(behind.iter().skip(1).take(more));
            add(chords..chords + more, &further, &points);
            chords += more;
        }
    }
    let places: Vec<ContourSegment> = (first..first + chords)
        .filter_map(|index| outlook.segment(index as isize))
        .collect();
    let Some(changes) =
        in_polyline(outlook, &places, &arcs).or_else(|| in_chain(outlook, &places, &arcs))
    else {
        return Vec::new();
    };
    let moved = arcs
        .iter()
        .map(|(range, arc)| moved(&points[range.start..=range.end], arc))
        .fold(0.0, f64::max);
    let kind = FixKind::OneArc {
        chords,
        radius: fit.radius,
    };
    vec![Fix {
        in_fix_all: moved <= outlook.limits.tolerances.join,
        ..Fix::new(kind, changes)
    }]
}

/// How far an arc lies from the chords that it takes the place of: at the middle of the longest chord, and at its ends.
fn moved(points: &[Point], arc: &Arc) -> f64 {
    let longest = points
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).norm())
        .fold(0.0, f64::max);
    let half = (longest / (2.0 * arc.radius)).min(1.0).asin();
    let deviation = points
        .iter()
        .map(|point| ((point - arc.center).norm() - arc.radius).abs())
        .fold(0.0, f64::max);
    arc.radius * (1.0 - half.cos()) + deviation
}

/// Each arc takes the place of its chords' first vertex, the others go.
fn in_polyline(
    outlook: &Outlook,
    places: &[ContourSegment],
    arcs: &[(Range<usize>, Arc)],
) -> Option<Vec<Change>> {
    let entity = places.first()?.entity;
    let Geometry::Polyline { vertices, .. } = &outlook.drawing.get(entity)?.geometry else {
        return None;
    };
    if places.iter().any(|place| place.entity != entity) {
        return None;
    }
    let mut changes = Vec::new();
    for (range, arc) in arcs {
        let own = &places[range.clone()];
        let (start, bulge) = match own.first()?.reversed {
            false => (own.first()?.segment, arc.bulge()),
            true => (own.last()?.segment, -arc.bulge()),
        };
        let vertex = Vertex {
            bulge,
            ..*vertices.get(start)?
        };
        changes.push(Change::SetVertex {
            entity,
            index: start,
            vertex,
        });
        changes.extend((1..own.len()).map(|along| Change::RemoveVertex {
            entity,
            index: (start + along) % vertices.len(),
        }));
    }
    Some(changes)
}

/// An ARC comes in behind the first LINE, the LINEs go.
fn in_chain(
    outlook: &Outlook,
    places: &[ContourSegment],
    arcs: &[(Range<usize>, Arc)],
) -> Option<Vec<Change>> {
    let is_line = |place: &ContourSegment| {
        matches!(
            outlook
                .drawing
                .get(place.entity)
                .map(|entity| &entity.geometry),
            Some(Geometry::Line { .. })
        )
    };
    if !places.iter().all(is_line) {
        return None;
    }
    let mut changes = Vec::new();
    for (range, arc) in arcs {
        let forward = if arc.sweep > 0.0 {
            *arc
        } else {
            arc.reversed()
        };
        let geometry = Geometry::Arc {
            center: arc.center,
            radius: arc.radius,
            start_angle: positive_angle(forward.start_angle),
            end_angle: positive_angle(forward.start_angle + forward.sweep.min(TAU)),
        };
        changes.push(Change::AddEntity {
            after: places.get(range.start)?.entity,
            geometry,
        });
    }
    changes.extend(places.iter().map(|place| Change::RemoveEntity {
        entity: place.entity,
    }));
    Some(changes)
}
