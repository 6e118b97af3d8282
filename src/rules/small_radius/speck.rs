//! Arcs that nobody can measure: what a drawing program leaves where it joins two segments.

use super::Limits;
use crate::drawing::{Contour, ContourSegment};
use crate::geometry::Segment;

/// At most this many specks beside each other are passed over.
const MOST_BESIDE: usize = 8;

/// A speck is no longer than this share of the correction, whatever the resolution.
const SMALLEST: f64 = 0.05;

/// An arc whose ends lie nearer to each other than the resolution, and which nowhere leaves its chord by that.
fn is_speck(segment: &Segment, limits: &Limits) -> bool {
    let resolution = limits
        .tolerances
        .resolution
        .min(SMALLEST * limits.correction);
    let chord = (segment.end() - segment.start()).norm();
    let height = match segment {
        Segment::Line(_) => 0.0,
        Segment::Arc(arc) if arc.is_full_turn() => return false,
        Segment::Arc(arc) => arc.radius * (1.0 - (arc.sweep.abs() / 2.0).cos()),
    };
    chord < resolution && height < resolution
}

/// True for such an arc where the contour goes on after it as it came, so that its chord is cut and there is no corner in which the
/// wire leaves anything that could be measured; its radius then means nothing.
pub(crate) fn is_noise(
    contour: &Contour,
    index: usize,
    segment: impl Fn(usize) -> Option<ContourSegment>,
    limits: &Limits,
) -> bool {
    let geometry = |at: usize| Some(segment(at)?.geometry);
    let is_of_noise = |own: &Segment| is_speck(own, limits);
    if !geometry(index).is_some_and(|own| is_of_noise(&own)) {
        return false;
    }
    let count = contour.len();
    let beside = |forward: bool| {
        let mut at = index;
        for _ in 0..MOST_BESIDE {
            at = match (forward, contour.closed) {
                (true, true) => (at + 1) % count,
                (false, true) => (at + count - 1) % count,
                (true, false) => at + 1,
                (false, false) => at.checked_sub(1)?,
            };
            match geometry(at)? {
                own if is_of_noise(&own) => {}
                own => return Some(own),
            }
        }
        None
    };
    let (Some(before), Some(behind)) = (beside(false), beside(true)) else {
        return false;
    };
    let (from, to) = (before.end_tangent(), behind.start_tangent());
    let turn = (from.x * to.y - from.y * to.x).atan2(from.dot(&to)).abs();
    let left = limits.correction * (1.0 / (turn / 2.0).cos() - 1.0);
    left.abs() < limits.tolerances.resolution
}
