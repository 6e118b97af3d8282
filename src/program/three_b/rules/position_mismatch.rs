//! `position-mismatch`: the coordinates behind a block are not where it leads from those before.
//!
//! Each end point is held against the one before it and the block between them, so that one wrong block is one finding.

use super::super::parse::StatedPoint;
use super::super::run::Move;

/// How far coordinates of three decimals may lie off, µm: both ends are rounded, and J of an arc moves its end by two µm on each axis.
const TOLERANCE: f64 = 4.0;

/// Where the stated end lies from where the block leads, µm, on an axis on which that is too far.
pub(in super::super) fn mismatch(before: &StatedPoint, travel: &Move, stated: &StatedPoint) -> Option<[f64; 2]> {
    let rounding = 10_f64.powi(3 - i32::from(before.decimals.min(stated.decimals)));
    let allowed = TOLERANCE.max(TOLERANCE / 2.0 + rounding);
    let off = |moved: [f64; 2]| {
        let along = |axis: usize| (stated.at[axis] - before.at[axis]) * 1000.0 - moved[axis];
        [along(0), along(1)]
    };
    let is_far = |[x, y]: [f64; 2]| x.abs() > allowed || y.abs() > allowed;
    let (meant, machine) = (off(travel.meant_um()), off(travel.machine.map(|um| um as f64)));
    (is_far(meant) && is_far(machine)).then_some(meant)
}

/// More of the end points than this share are off: the numbers are something else than end points.
pub(in super::super) const FOREIGN: f64 = 0.5;
