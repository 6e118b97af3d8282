//! An arc that is too tight to cut, in numbers.

use crate::geometry::{Arc, Point, Side};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Why no fix is offered for an arc that is too tight.
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
    /// It stands in a program: the drawing that it was made of has to change.
    Program,
}

/// An arc tighter than the correction, in drawing units. Lengths for people are made in mm by the message.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallRadius {
    pub radius: f64,
    /// The correction that the radius is held against.
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
    /// What stays when the control trims: `(c − r)(1 / cos(θ/2) − 1)`; infinite at a half turn and beyond.
    pub(crate) stock_left: f64,
    /// The pass (1-based) whose correction is the largest, where several passes are set.
    pub(crate) pass: Option<usize>,
    /// A later pass can follow the arc: what this one leaves of it is that pass's stock.
    pub(crate) taken_by_skims: bool,
    /// Why no fix is offered; `None` where one is.
    pub no_fix: Option<NoFix>,
}

impl SmallRadius {
    /// The numbers of an arc whose radius counts as `radius`; of a length in them there are `unit` in one of theirs.
    pub(crate) fn of(arc: &Arc, radius: f64, required: f64, unit: f64) -> SmallRadius {
        let (short, turn) = ((required - radius).max(0.0) / unit, arc.sweep.abs().min(PI));
        let stock_left = if turn < PI {
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
}
