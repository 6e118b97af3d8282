//! Runs: arcs in a row that one new arc replaces.

use super::Travel;
use crate::geometry::{Arc, Segment, turn};
use crate::rules::Limits;
use std::ops::RangeInclusive;

/// A corner that turns away from the wire by more than this (radians) is a corner of the part; less is rounding.
const CONVEX_KINK: f64 = 1e-6;

/// The run that holds the arc at `position`: the maximal chain of arcs concave to the wire with r ≤ R, split at every
/// vertex that is convex to the wire. `None` when that segment is no such arc.
pub fn run_of(travel: &Travel, position: isize, limits: &Limits) -> Option<RangeInclusive<isize>> {
    member(travel, position, limits)?;
    let count = travel.len() as isize;
    let (mut first, mut last) = (position, position);
    while last - first + 1 < count && joins(travel, first - 1, limits) {
        first -= 1;
    }
    while last - first + 1 < count && joins(travel, last, limits) {
        last += 1;
    }
    Some(first..=last)
}

fn member(travel: &Travel, position: isize, limits: &Limits) -> Option<Arc> {
    match travel.segment(position)?.geometry {
        Segment::Arc(arc) if arc.sweep > 0.0 && arc.radius <= limits.fix_radius + limits.tolerances.report => Some(arc),
        _ => None,
    }
}

/// True when the segments at `position` and behind it are of one run.
fn joins(travel: &Travel, position: isize, limits: &Limits) -> bool {
    let (Some(one), Some(other)) = (member(travel, position, limits), member(travel, position + 1, limits)) else { return false };
    turn(one.tangent_at(1.0), other.tangent_at(0.0)) >= -CONVEX_KINK
}
