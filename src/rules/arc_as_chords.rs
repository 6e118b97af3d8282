//! `arc-as-chords`: five or more lines in a row whose ends lie on one circle.
//!
//! Somewhere on its way an arc of the drawing was broken into chords. The wire cuts the facets, and
//! the program has a block for each. Fix: one arc.
//!
//! The arcs are found by `geometry::chords`.
//!
//! An observation at a segment depends on the windows of chords that start there or hold it. A sequence begins where a
//! window at the first fits one circle, none at the second does, and no longer window holds it: at the end of an arc
//! only short ones still fit. Its length is worked out only when it is shown.

use super::{LocalRule, Observation, Outlook};
use crate::drawing::{Change, ContourSegment, Geometry, Vertex};
use crate::finding::{Detail, Fix, FixKind, Rule};
pub(crate) use crate::geometry::chords::steepest;
use crate::geometry::chords::{FittedCircle, LEAST, STRIDES, Within, longest, longest_window};
use crate::geometry::{Arc, Point, Segment, positive_angle};
use std::f64::consts::TAU;
use std::ops::Range;

pub(crate) const RULE: LocalRule = LocalRule {
    rule: Rule::ArcAsChords,
    check,
    reach: |_, _| (REACH, REACH),
    holds,
    detail,
    fixes,
    together: Some(together),
    ..LocalRule::PLAIN
};

/// The answer at a segment or a corner depends on at most this many segments before and after it.
pub(crate) const REACH: usize = LEAST * STRIDES[STRIDES.len() - 1];

/// The most chords in one finding. Further chords make a second finding once the first are an arc.
const MOST: usize = 4096;

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

fn check(outlook: &Outlook, range: Range<usize>, observations: &mut Vec<Observation>) {
    let begins = beginnings(outlook, range.start as isize..range.end as isize);
    observations.extend(begins.map(|index| Observation::at(index as usize)));
    // A full circle of chords has no beginning, so the first segment may serve as the beginning.
    let is_first = |its: &Observation| its.index == 0;
    if range.start == 0
        && outlook.contour.closed
        && !observations.iter().any(is_first)
        && windows(outlook, 0..1)[0] > 0
    {
        observations.insert(0, Observation::at(0));
    }
}

/// Those of some segments at which a sequence of chords begins.
fn beginnings<'a>(outlook: &'a Outlook, range: Range<isize>) -> impl Iterator<Item = isize> + 'a {
    let own = windows(outlook, range.start - 1..range.end);
    let begins = move |(nth, index): (usize, isize)| {
        let chords = own[nth + 1];
        // A longer window that begins earlier and holds it.
        let is_held = || {
            let before = windows(outlook, index - (REACH as isize - 1)..index);
            let mut behind = (1..REACH).rev().zip(before);
            behind.any(|(back, window)| window > chords.max(back))
        };
        (chords > 0 && own[nth] == 0 && !is_held()).then_some(index)
    };
    range.enumerate().filter_map(begins)
}

/// For each of some segments: how many chords of one circle in a row begin with it, at least; 0 where none do.
fn windows(outlook: &Outlook, starts: Range<isize>) -> Vec<usize> {
    // `None` for a segment that is not a line.
    let line = |index: isize| match outlook.segment(index)?.geometry {
        Segment::Line(line) => Some(line),
        Segment::Arc(_) => None,
    };
    let lines: Vec<_> = (starts.start..starts.end + REACH as isize - 1)
        .map(line)
        .collect();
    // The lines in a row from each on.
    let mut in_a_row = vec![0; lines.len() + 1];
    for (index, line) in lines.iter().enumerate().rev() {
        in_a_row[index] = line.map_or(0, |_| in_a_row[index + 1] + 1);
    }
    let window = |first: usize| {
        let most = in_a_row[first].min(outlook.contour.len());
        let end = |index: usize, chords: usize| match index == chords {
            true => lines[first + index - 1].map(|line| line.end),
            false => lines[first + index].map(|line| line.start),
        };
        let point = |index, chords| end(index, chords).unwrap_or_default();
        longest_window(point, most, within(outlook))
    };
    (0..starts.len())
        .map(|first| window(first).unwrap_or(0))
        .collect()
}

/// For each of some segments: whether the corner at its start lies between chords that are reported as an arc.
pub(crate) fn are_between_chords(outlook: &Outlook, range: Range<usize>) -> Vec<bool> {
    // A window holds the chord before the corner and the chord after it.
    let first = range.start as isize - (REACH as isize - 1);
    let windows = windows(outlook, first..range.end as isize - 1);
    let mut inside = 0;
    let mut between = Vec::with_capacity(windows.len());
    for (start, chords) in windows.iter().enumerate() {
        inside = inside.max(start + chords);
        between.push(inside > start + 1);
    }
    between.split_off(between.len().saturating_sub(range.len()))
}

/// Whether, at the first segment of a closed contour, the sequence begins there or has no beginning at all.
fn holds(outlook: &Outlook, observation: Observation) -> bool {
    let most = outlook.contour.len().min(MOST) as isize;
    let first = observation.index as isize;
    let begins = |range| beginnings(outlook, range).next().is_some();
    begins(first..first + 1) || !begins(first + 1..first + most)
}

/// The longest sequence from `first` on that fits one circle.
fn sequence(outlook: &Outlook, first: usize) -> Option<(usize, FittedCircle, Vec<Point>)> {
    let mut points = corners(outlook, first as isize, outlook.contour.len().min(MOST));
    let most = points.len().saturating_sub(1);
    let (chords, best) = longest(|index| points[index], most, within(outlook))?;
    points.truncate(chords + 1);
    Some((chords, best, points))
}

fn within(outlook: &Outlook) -> Within {
    Within {
        corners: outlook.limits.tolerances.chords,
        chords: f64::INFINITY,
    }
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
    let mut add = |range: Range<usize>, fit: &FittedCircle, points: &[Point]| {
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
        in_fix_all: moved <= outlook.limits.tolerances.certain,
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
