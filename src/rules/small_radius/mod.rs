//! `small-radius`: an arc that curves round the wire more tightly than the correction.
//!
//! An arc is at fault when its centre lies on the wire side and `r < c − tolerance`. Its offset would have a negative
//! radius: the control drops the arc or cuts into the part. `r = c` is the limit and passes.
//!
//! The fix replaces a run of such arcs by one arc of radius `R = c + margin`. From foot to foot the new outline is the
//! boundary of the morphological opening of the wire's region by a disc of radius R; elsewhere
//! nothing changes.

mod edit;
mod in_the_way;
mod refillet;
mod run;
mod stretch;
mod travel;

pub(crate) use edit::fillet;
pub(crate) use edit::{drawing_edit, keep_end_points};
pub(crate) use refillet::Replacement;
pub(crate) use refillet::{made_tangent, refillet};
pub(crate) use run::{rounded_run_of, run_of};
pub(crate) use stretch::depth;
pub(crate) use travel::Travel;

use super::Limits;
use crate::drawing::ContourSegment;
use crate::finding::{Side, SmallRadius};

/// Side of travel on which an arc's centre lies.
pub(crate) fn center_side(sweep: f64) -> Side {
    if sweep > 0.0 { Side::Left } else { Side::Right }
}

/// True when a radius is below the correction by more than rounding.
pub(crate) fn is_too_small(radius: f64, limits: &Limits) -> bool {
    radius < limits.correction - limits.tolerances.report
}

/// The numbers of an arc at fault, `None` when the segment is no arc, is wide enough, or curves away from the wire.
/// `wire_side` is that of the contour's travel; `None` where the arc must survive both sides.
pub(crate) fn check(
    segment: &ContourSegment,
    wire_side: Option<Side>,
    limits: &Limits,
) -> Option<SmallRadius> {
    let arc = segment.geometry.as_arc()?;
    let side = center_side(arc.sweep);
    if !is_too_small(arc.radius, limits) || wire_side.is_some_and(|wire| wire != side) {
        return None;
    }
    let own = if segment.reversed {
        arc.reversed()
    } else {
        *arc
    };
    let detail = SmallRadius::of(&own, arc.radius, limits.correction, 1.0);
    // Stock that a later pass takes away does no harm in this one.
    Some(SmallRadius {
        overcut: (detail.overcut - limits.taken_later).max(0.0),
        pass: limits.pass,
        taken_by_skims: limits.is_for_skims(arc.radius),
        ..detail
    })
}
