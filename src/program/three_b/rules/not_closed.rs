//! `not-closed`: a contour does not come back to where it began, nor to the end of its lead-in.
//!
//! Where a contour closes is said by [`crate::program::path`]; its sums alone tell that for nearly all of them.

use super::super::entry::Move;
use super::super::run::Sum;
use crate::finding::Fault;
use crate::program::path::tolerance;

/// Up to this many blocks are a fragment: they may well be all that was meant.
pub(in super::super) const FRAGMENT: usize = 2;

/// True where the sums alone tell that the way comes back to its start or to the end of a lead-in of one or two blocks; a lead-out that
/// goes elsewhere counts as one only where it runs neither back along the lead-in nor on in its direction.
pub(in super::super) fn is_closed(sum: &Sum) -> bool {
    let tolerance = tolerance(sum.arcs);
    if sum.blocks == 0 || sum.travel.is_within(tolerance) {
        return true;
    }
    let (Some(first), Some(last)) = (sum.first, sum.last) else {
        return false;
    };
    if sum.blocks >= 3 && sum.travel.minus(first).is_within(tolerance) {
        return true;
    }
    // A lead-in may be two blocks, the second round to the contour.
    if sum.blocks >= 6
        && sum
            .second
            .is_some_and(|second| sum.travel.minus(first).minus(second).is_within(tolerance))
    {
        return true;
    }
    sum.blocks >= 5
        && sum.travel.minus(first).minus(last).is_within(tolerance)
        && !runs_along(first, last)
}

/// True where the second move runs against the first, or on in its direction, through the contour; within a few degrees.
fn runs_along(first: Move, last: Move) -> bool {
    let (a, b) = (first.meant_um(), last.meant_um());
    let dot = a[0] * b[0] + a[1] * b[1];
    dot.abs() >= 0.99 * a[0].hypot(a[1]) * b[0].hypot(b[1])
}

/// From the end of the way to the nearer of its start and the end of its lead-in, µm.
pub(in super::super) fn gap(sum: &Sum) -> [f64; 2] {
    let to_start = sum.travel.meant_um().map(|um| -um);
    let to_lead_in = match sum.first {
        Some(first) if sum.blocks >= 3 => sum.travel.minus(first).meant_um().map(|um| -um),
        _ => to_start,
    };
    let length = |[x, y]: [f64; 2]| x.hypot(y);
    if length(to_lead_in) < length(to_start) {
        to_lead_in
    } else {
        to_start
    }
}

/// `gap` leads from the end of the way to where it should be.
pub(in super::super) fn fault([x, y]: [f64; 2], sum: &Sum) -> Fault {
    Fault::NotClosed {
        x: -x,
        y: -y,
        blocks: sum.blocks,
    }
}
