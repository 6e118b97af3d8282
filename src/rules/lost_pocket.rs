//! `lost-pocket` and `offset-collapse`: what the offset of a whole contour loses.
//!
//! The wire's centre runs along the contour's offset by the correction. Where that offset falls into several loops, the
//! wire is threaded into one of them and never reaches the others: those pockets behind a neck are lost. Where the
//! offset is empty, the wire does not fit at all. Both need a closed contour with a known wire side.
//!
//! A dead end that is too narrow all along has no loop of its own and is only `narrow-slot`; a hole made of arcs below
//! the correction is only `small-radius`. The library `cavalier_contours` makes the offset. It is
//! trusted only where its loops keep clear of the contour, and its empty result only if no disc of
//! the correction fits.

use super::{Outlook, small_radius};
use crate::finding::Side;
use crate::geometry::{Bounds, Point, Segment, left_normal, looks_of_offset};
use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Contours with more segments are skipped: their offset would take longer than an edit may take.
/// `narrow-slot` still works there.
pub(crate) const MOST_SEGMENTS: usize = 5_000;

/// What the offset of a contour loses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Lost {
    /// All of it: the offset is empty.
    All,
    /// A part: the deepest point of its loop, and the index of the segment beside that point.
    Pocket { near: Point, index: usize },
}

/// What is known of the offset of a contour.
#[derive(Clone, Debug)]
pub(crate) struct Checked {
    /// The looks that it takes, beyond the granted ones one more than these.
    pub(crate) looks: u64,
    /// What it loses; `None` where it would have taken more looks than were left.
    pub(crate) lost: Option<Vec<Lost>>,
}

impl Checked {
    /// Nothing is lost, and nothing had to be looked at.
    const SOUND: Checked = Checked {
        looks: 0,
        lost: Some(Vec::new()),
    };
}

/// What the offset to `side` of a contour loses. `has_neck` says that two of its walls form a narrow slot; without one
/// the offset is lost as a whole or not at all. Of the looks `granted` to all contours, `left` are left for this one.
pub(crate) fn check(
    outlook: &Outlook,
    side: Side,
    has_neck: bool,
    (granted, left): (u64, u64),
) -> Checked {
    let contour = outlook.contour;
    if !contour.closed || contour.len() > MOST_SEGMENTS {
        return Checked::SOUND;
    }
    let segments: Vec<Segment> = contour
        .segments(outlook.drawing)
        .map(|segment| segment.geometry)
        .collect();
    let (correction, twice_area) = (outlook.limits.correction, outlook.index.twice_area());
    let inward = twice_area * side.sign() > 0.0;
    let length: f64 = segments.iter().map(Segment::length).sum();
    // An outline that holds no disc of radius c has less area than its length times c.
    let may_collapse = inward && twice_area.abs() / 2.0 <= length * correction;
    if !has_neck && !may_collapse {
        return Checked::SOUND;
    }
    let looks = looks_of_offset(&segments, correction * side.sign(), granted);
    let lost = (looks <= left).then(|| lost(outlook, side, &segments));
    Checked { looks, lost }
}

fn lost(outlook: &Outlook, side: Side, segments: &[Segment]) -> Vec<Lost> {
    let correction = outlook.limits.correction;
    let inward = outlook.index.twice_area() * side.sign() > 0.0;
    let Some(loops) = offset(segments, correction * side.sign()) else {
        return Vec::new();
    };
    let clear = |point: Point| clearance(outlook, point, correction).is_none();
    let real = |(points, area): &(Vec<Point>, f64)| {
        let bounds = Bounds::of_points(points);
        *area != 0.0
            && bounds.width().max(bounds.height()) > outlook.limits.tolerances.touch
            && points.iter().all(|&point| clear(point))
    };
    let mut loops: Vec<(Vec<Point>, f64)> = loops.into_iter().filter(real).collect();
    if loops.is_empty() {
        let tight = |segment: &Segment| {
            segment
                .as_arc()
                .is_some_and(|arc| small_radius::is_too_small(arc.radius, outlook.limits))
        };
        let fits = |segment: &Segment| {
            [0.0, 0.25, 0.5, 0.75].iter().any(|&share| {
                clear(
                    segment.point_at(share)
                        + left_normal(segment.tangent_at(share)) * (correction * side.sign()),
                )
            })
        };
        let lost = inward && !segments.iter().all(tight) && !segments.iter().any(fits);
        return if lost { vec![Lost::All] } else { Vec::new() };
    }
    // The wire is threaded into the largest loop; outside a punch that is the loop around it.
    loops.sort_by(|a, b| b.1.total_cmp(&a.1));
    let largest = Bounds::of_points(&loops[0].0);
    let threaded = nalgebra::center(&largest.min, &largest.max);
    let pocket = |(points, _): &(Vec<Point>, f64)| {
        // Only away from the neck, which has its own finding.
        let depth = |point: &Point| nalgebra::distance(point, &threaded);
        let near = *points.iter().max_by(|a, b| depth(a).total_cmp(&depth(b)))?;
        Some(Lost::Pocket {
            near,
            index: nearest(outlook, near, 1.01 * correction)?,
        })
    };
    loops[1..].iter().filter_map(pocket).collect()
}

/// The loops of an offset, each by its vertices and its area; `None` where the library fails.
fn offset(segments: &[Segment], by: f64) -> Option<Vec<(Vec<Point>, f64)>> {
    // Relative to the contour, so that far-off coordinates cost no digits.
    let origin = segments.first()?.start();
    let mut outline = Polyline::new_closed();
    let mut add = |segment: &Segment| {
        let start = segment.start() - origin;
        outline.add(start.x, start.y, segment.bulge());
    };
    for segment in segments.iter().filter(|segment| segment.length() > 1e-9) {
        // The library takes arcs up to a half turn only.
        if segment.bulge().abs() > 0.9 {
            [segment.part(0.0, 0.5), segment.part(0.5, 1.0)]
                .iter()
                .for_each(&mut add);
        } else {
            add(segment);
        }
    }
    if outline.vertex_count() < 2 {
        return None;
    }
    let loops = catch_unwind(AssertUnwindSafe(|| outline.parallel_offset(by))).ok()?;
    let told = |found: &Polyline<f64>| {
        let points = found
            .iter_vertexes()
            .map(|vertex| origin + crate::geometry::Vector::new(vertex.x, vertex.y))
            .collect();
        (points, found.area().abs())
    };
    Some(loops.iter().map(told).collect())
}

/// The segment that comes nearer to `point` than `distance` by more than the library's rounding, if one does.
fn clearance(outlook: &Outlook, point: Point, distance: f64) -> Option<usize> {
    const ROUNDING: f64 = 1e-3;
    nearest(outlook, point, distance * (1.0 - ROUNDING))
}

/// The segment nearest to a point, within a distance.
fn nearest(outlook: &Outlook, point: Point, within: f64) -> Option<usize> {
    let area = Bounds::of_disc(point, within);
    let indices = outlook.index.near(&area).flatten();
    let near = indices.filter_map(|index| {
        Some((
            outlook.segment(index as isize)?.geometry.distance_to(point),
            index,
        ))
    });
    near.filter(|(distance, _)| *distance < within)
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, index)| index)
}
