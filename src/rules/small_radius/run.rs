//! Runs: arcs in a row that one new arc replaces.

use super::Travel;
use crate::geometry::{Arc, Segment, turn};
use crate::rules::Limits;
use std::ops::RangeInclusive;

/// A corner that turns away from the wire by more than this (radians) is a corner of the part; less is rounding.
const CONVEX_KINK: f64 = 1e-6;

/// Rounding to three decimals may turn the joint of an arc that is drawn in two by up to this angle (radians), and move
/// their centres apart by this share of the radius.
const ROUNDED_KINK: f64 = 0.1;
const ROUNDED_CENTER: f64 = 0.1;

/// The run that holds the arc at `position`: the longest chain of arcs concave to the wire with r ≤ R, split at every
/// vertex convex to the wire. `None` when that segment is not such an arc.
pub(crate) fn run_of(
    travel: &Travel,
    position: isize,
    limits: &Limits,
) -> Option<RangeInclusive<isize>> {
    run_within(travel, position, limits, false)
}

/// The same run, with an arc that is drawn in two and rounded counted as one arc.
pub(crate) fn rounded_run_of(
    travel: &Travel,
    position: isize,
    limits: &Limits,
) -> Option<RangeInclusive<isize>> {
    run_within(travel, position, limits, true)
}

fn run_within(
    travel: &Travel,
    position: isize,
    limits: &Limits,
    is_rounded: bool,
) -> Option<RangeInclusive<isize>> {
    member(travel, position, limits)?;
    let count = travel.len() as isize;
    let (mut first, mut last) = (position, position);
    while last - first + 1 < count && joins(travel, first - 1, limits, is_rounded) {
        first -= 1;
    }
    while last - first + 1 < count && joins(travel, last, limits, is_rounded) {
        last += 1;
    }
    Some(first..=last)
}

fn member(travel: &Travel, position: isize, limits: &Limits) -> Option<Arc> {
    match travel.segment(position)?.geometry {
        Segment::Arc(arc)
            if arc.sweep > 0.0 && arc.radius <= limits.fix_radius + limits.tolerances.report =>
        {
            Some(arc)
        }
        _ => None,
    }
}

/// True when the segments at `position` and after it are in one run.
fn joins(travel: &Travel, position: isize, limits: &Limits, is_rounded: bool) -> bool {
    let (Some(one), Some(other)) = (
        member(travel, position, limits),
        member(travel, position + 1, limits),
    ) else {
        return false;
    };
    let kink = turn(one.tangent_at(1.0), other.tangent_at(0.0));
    let are_one =
        || (one.center - other.center).norm() <= ROUNDED_CENTER * one.radius.min(other.radius);
    kink >= -CONVEX_KINK || (is_rounded && kink >= -ROUNDED_KINK && are_one())
}
