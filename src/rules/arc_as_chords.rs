//! `arc-as-chords`: five or more lines in a row whose ends lie on one circle.
//!
//! Somewhere on its way an arc of the drawing was broken into chords. The wire cuts the facets, and
//! the program has a block for each. Fix: one arc.
//!
//! An observation at a segment depends on two windows of [`LEAST`] chords: the one that starts there and the one that
//! starts a segment earlier. A sequence begins where the first fits one circle and the second does not. Its length is
//! worked out only when it is shown.

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
    together: Some(together),
    ..LocalRule::PLAIN
};

/// The number of chords that make an arc.
const LEAST: usize = 5;

/// The most chords in one finding. Further chords make a second finding once the first are an arc.
const MOST: usize = 4096;

/// Tangent of the largest turn (25°) from chord to chord: a hexagon stays a hexagon, 16 chords to the full circle are
/// an arc.
const STEEPEST: f64 = 0.466_307_658;

/// The circle through some points in a row.
#[derive(Clone, Copy, Debug)]
struct Fit {
    center: Point,
    radius: f64,
    deviation: f64,
    counter_clockwise: bool,
}

/// The circle through the ends of chords in a row. `None` unless they all turn the same way by a small angle, lie
/// within `tolerance` of one circle, and fit it clearly better than a straight line.
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
    // On a full circle both ends are one point.
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

/// Corners of at most `count` segments from `first` on, as long as they are lines.
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
    // Starts at the segment before the range.
    let fits = windows(outlook, range.start as isize - 1..range.end as isize);
    for (index, pair) in range.zip(fits.windows(2)) {
        // A full circle of chords has no beginning, so the first segment may serve as the
        // beginning.
        if pair[1] && (!pair[0] || (outlook.contour.closed && index == 0)) {
            observations.push(Observation::at(index));
        }
    }
}

/// For each of some segments: whether [`LEAST`] chords of one circle in a row begin with it.
fn windows(outlook: &Outlook, starts: Range<isize>) -> Vec<bool> {
    if outlook.contour.len() < LEAST {
        return vec![false; starts.len()];
    }
    // `None` for a segment that is not a line.
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

/// For each of some segments: whether the corner at its start lies between chords that are reported as an arc.
pub(crate) fn are_between_chords(outlook: &Outlook, range: Range<usize>) -> Vec<bool> {
    // One window holds the chord before the corner and the chord after it.
    let starts = range.start as isize - (LEAST as isize - 1)..range.end as isize - 1;
    windows(outlook, starts)
        .windows(LEAST - 1)
        .map(|windows| windows.contains(&true))
        .collect()
}

/// The answer at a corner depends on at most this many segments before and after it.
pub(crate) const REACH: usize = LEAST;

/// A corner that turns by more than this (radians) does not lie between chords.
pub(crate) fn steepest() -> f64 {
    STEEPEST.atan()
}

/// Whether, at the first segment of a closed contour, the sequence begins there or has no beginning at all.
fn holds(outlook: &Outlook, observation: Observation) -> bool {
    let most = outlook.contour.len().min(MOST) as isize;
    let first = observation.index as isize;
    !window_fits(outlook, first - 1) || (2..most).all(|back| window_fits(outlook, first - back))
}

/// The longest sequence from `first` on that fits one circle.
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
    let (chords, fit, points) = sequence(outlook, observation.index as usize)?;
    Some(Detail::ArcAsChords {
        facet: facet(&points, fit.radius),
        chords,
        center: fit.center,
        radius: fit.radius,
        deviation: fit.deviation,
    })
}

/// The longest run of chords stands for all; where they are too many to be followed, those that were.
fn together(
    _: &Outlook,
    some: &[(Observation, Detail)],
    _count: usize,
) -> Option<(Observation, Detail)> {
    let chords_of = |detail: &Detail| match detail {
        Detail::ArcAsChords { chords, .. } => *chords,
        _ => 0,
    };
    let longest = some.iter().max_by_key(|(_, detail)| chords_of(detail))?;
    let Detail::ArcAsChords {
        center,
        radius,
        deviation,
        ..
    } = longest.1
    else {
        return None;
    };
    let chords = some.iter().map(|(_, detail)| chords_of(detail)).sum();
    let arcs = some.len();
    Some((
        longest.0,
        Detail::ArcsAsChords {
            chords,
            arcs,
            center,
            radius,
            deviation,
        },
    ))
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
        // A full circle takes two arcs.
        add(0..chords / 2, &fit, &points);
        add(chords / 2..chords, &fit, &points);
    } else {
        add(0..chords, &fit, &points);
        // Chords beyond the limit are left after the new arc: they would be the next finding.
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

/// The distance of an arc from the chords that it replaces: at the middle of the longest chord, and at its ends.
fn moved(points: &[Point], arc: &Arc) -> f64 {
    let deviation = points
        .iter()
        .map(|point| ((point - arc.center).norm() - arc.radius).abs())
        .fold(0.0, f64::max);
    facet(points, arc.radius) + deviation
}

/// How far the middle of the longest chord lies from its circle.
fn facet(points: &[Point], radius: f64) -> f64 {
    let longest = points
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).norm())
        .fold(0.0, f64::max);
    let half = (longest / (2.0 * radius)).min(1.0).asin();
    radius * (1.0 - half.cos())
}

/// Each arc takes over the first vertex of its chords; the other vertices go.
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
        let (first, last) = (own.first()?, own.last()?);
        let (start, end, bulge) = match first.reversed {
            false => (first.segment, last.segment, arc.bulge()),
            true => (last.segment, first.segment, -arc.bulge()),
        };
        let steps = (end + vertices.len() - start) % vertices.len();
        let vertex = Vertex {
            bulge,
            ..*vertices.get(start)?
        };
        changes.push(Change::SetVertex {
            entity,
            index: start,
            vertex,
        });
        changes.extend((1..=steps).map(|along| Change::RemoveVertex {
            entity,
            index: (start + along) % vertices.len(),
        }));
    }
    Some(changes)
}

/// An ARC is added after the first LINE, and the LINEs go.
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
