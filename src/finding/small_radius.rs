//! An arc that is too tight to cut: its numbers and their sentence.

use super::lengths::{Telling, told_apart};
use crate::geometry::{Arc, Point, Side};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// From this turn on (radians) the walls beside an arc run side by side: what stays between them is a slot as deep as
/// they are long, and no arc says how long that is.
const SIDE_BY_SIDE: f64 = 170.0 / 180.0 * PI;

/// Why an arc that is too tight has no fix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NoFix {
    /// A slot, hole or pocket narrower than twice the correction: no arc of the required radius fits (`narrow-slot`).
    NarrowSlot,
    /// The arc that fits would move the contour by more than the correction, or remove more of it than a short neighbour.
    SealsContour,
    /// The arc ends an open contour: there is no neighbour to be tangent to.
    NoNeighbour,
    /// The entity cannot be edited (part of a block, or of a kind that has no such edit).
    NotEditable,
    /// The arc that fits would leave a segment too short to cut.
    ShortSegment,
    /// The arc that fits would bring another fault: it crosses another outline, or puts another arc at fault.
    Spoils,
    /// It is in a program: the drawing has to change.
    Program,
}

/// An arc tighter than the correction, in drawing units. The message converts lengths to mm.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallRadius {
    pub radius: f64,
    /// The correction that the radius must reach.
    pub(crate) required: f64,
    pub center: Point,
    pub(crate) start: Point,
    pub(crate) end: Point,
    /// Signed sweep in the entity's own direction, radians.
    pub(crate) sweep: f64,
    /// Wire side in the entity's own direction.
    pub(crate) side: Side,
    /// What an untrimmed offset cuts beyond the wire's contour: `(c − r)(1 − cos θ)`, at most `2 (c − r)`.
    pub(crate) overcut: f64,
    /// What stays when the control trims: `(c − r)(1 / cos(θ/2) − 1)`; infinite where that is not known: towards a half
    /// turn, and where the walls end before their offsets meet.
    pub(crate) stock_left: f64,
    /// The pass (1-based) whose correction is the largest, where several passes are set.
    pub(crate) pass: Option<usize>,
    /// A later pass can follow the arc and takes what this one leaves.
    pub(crate) taken_by_skims: bool,
    /// Why there is no fix; `None` where there is one.
    pub no_fix: Option<NoFix>,
}

impl SmallRadius {
    /// The numbers of an arc that is taken to have the radius `radius`; all lengths are divided by
    /// `unit`.
    pub(crate) fn of(arc: &Arc, radius: f64, required: f64, unit: f64) -> SmallRadius {
        let (short, turn) = ((required - radius).max(0.0) / unit, arc.sweep.abs().min(PI));
        let stock_left = if turn < SIDE_BY_SIDE {
            short * (1.0 / (turn / 2.0).cos() - 1.0)
        } else {
            f64::INFINITY
        };
        SmallRadius {
            radius: radius / unit,
            required: required / unit,
            center: arc.center / unit,
            start: arc.start / unit,
            end: arc.end / unit,
            sweep: arc.sweep,
            side: if arc.sweep > 0.0 {
                Side::Left
            } else {
                Side::Right
            },
            overcut: short * (1.0 - turn.cos()),
            stock_left,
            pass: None,
            taken_by_skims: false,
            no_fix: None,
        }
    }

    /// The same beside walls of which the shorter has this length. The offsets of the walls meet beside points of them
    /// `(c − r) tan(θ/2)` from the arc; a wall that ends before is lost with it, and more stays than the arc says.
    pub(crate) fn beside_walls_of(mut self, length: f64) -> SmallRadius {
        let turn = self.sweep.abs().min(PI);
        if (self.required - self.radius) * (turn / 2.0).tan() > length {
            self.stock_left = f64::INFINITY;
        }
        self
    }

    /// True where the wire cuts beyond the contour; else it leaves stock, for later passes or for good.
    pub(crate) fn overcuts(&self, unit_mm: f64) -> bool {
        !self.taken_by_skims && self.overcut * unit_mm >= 0.5e-6
    }

    /// What is too small, what it does to the part, and why there is no fix.
    pub(super) fn sentence(&self, telling: Telling) -> String {
        let unit_mm = telling.unit_mm;
        let (radius, required) = told_apart(self.radius * unit_mm, self.required * unit_mm);
        let pass = self.pass.map_or(String::new(), |pass| say!(of_pass, pass));
        let stock_left = self
            .stock_left
            .is_finite()
            .then(|| telling.mm(self.stock_left));
        let mut text = say!(arc_r_mm_is_below_the_correction_mm, radius, required, pass);
        if self.taken_by_skims {
            text += &match &stock_left {
                Some(stock) => say!(the_later_passes_find_mm_more_stock, stock),
                None => say!(the_later_passes_find_more_stock).to_owned(),
            };
        } else if self.overcuts(unit_mm) {
            let overcut = telling.mm(self.overcut);
            text += &say!(the_wire_overcuts_the_contour_by_mm, overcut, telling.tool());
            text += &stock_left.map_or_else(String::new, |stock| say!(or_leaves_stock, stock));
        } else {
            text += say!(the_control_loses_the_arc);
        }
        text += &self.no_fix.map_or_else(String::new, |why| match why {
            NoFix::NarrowSlot => {
                let least = telling.mm(2.0 * self.required);
                say!(
                    no_arc_of_the_required_radius_fits_here,
                    least,
                    telling.tool()
                )
            }
            NoFix::SealsContour => say!(the_arc_that_fits_would_seal_the_slot).into(),
            NoFix::ShortSegment => say!(the_arc_that_fits_would_leave_a_segment_too_short).into(),
            NoFix::Spoils => say!(the_arc_that_fits_here_would_bring_another_fault).into(),
            NoFix::NoNeighbour => say!(no_neighbours_for_a_larger_arc).into(),
            NoFix::Program => say!(repair_it_in_the_drawing_and_make_the_program_again).into(),
            NoFix::NotEditable => say!(it_is_part_of_an_entity_that_cannot_be_edited_here).into(),
        });
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Arc;
    use proptest::prelude::*;

    proptest! {
        /// Beside an arc nothing stays standing that reaches farther than the walls do.
        #[test]
        fn what_stays_is_no_more_than_the_walls_reach(
            radius in 0.0..0.1, sweep in 0.0..std::f64::consts::TAU, length in 0.0..20.0, clockwise: bool
        ) {
            let sweep = if clockwise { -sweep } else { sweep };
            let arc = Arc::from_center(Point::origin(), radius, 0.0, sweep);
            let told = SmallRadius::of(&arc, radius, 0.1, 1.0);
            prop_assert!(told.stock_left < 1.2 || told.stock_left.is_infinite());
            let left = told.beside_walls_of(length).stock_left;
            prop_assert!(left <= length || left.is_infinite());
        }
    }
}
