//! Contours with arcs just at the correction: what rounding leaves of these is neither an arc nor a point.

use super::clearance::Walls;
use super::contour_path::{Along, Laid, Outcome};
use super::job::Job;
use super::nest::Before;
use super::offset::Wall;
use super::path::Refusal;
use crate::geometry::Segment;

/// An arc whose radius is this near to the correction, mm, is at the limit.
const LIMIT: f64 = 3e-6;

/// A path farther away by one of these, mm, is as good: beside it every such arc is too tight, and its neighbours are
/// cut with each other. Where one meets another arc of the contour, the next does not.
const BESIDE: [f64; 3] = [3e-6, 8e-6, 2e-5];

impl Job<'_> {
    /// The path along a contour, as `laid_within` has it, of which nothing has been proved before.
    pub(super) fn laid(
        &self,
        walls: &[Wall],
        own: &Walls,
        along: Along,
    ) -> Result<Outcome, Refusal> {
        self.laid_within(walls, own, along, None)
    }

    /// The path along a contour, proved; `walls` have the wire on the side of that sign. That of an open one runs from
    /// beside the beginning of the first wall to beside the end of the last. What the path of the pass `before` proves is not looked at again.
    pub(super) fn laid_within(
        &self,
        walls: &[Wall],
        own: &Walls,
        along: Along,
        before: Option<Before>,
    ) -> Result<Outcome, Refusal> {
        let laid = self.laid_at(walls, own, along, before)?;
        let limit = self.units(LIMIT);
        let is_at_limit = || walls.iter().any(|wall| along.is_at_limit(wall, limit));
        if matches!(laid, Ok(Laid::Path(_))) || !is_at_limit() {
            return Ok(laid);
        }
        for beside in BESIDE {
            let wider = Along {
                correction: along.correction + self.units(beside),
                ..along
            };
            let other = self.laid_at(walls, own, wider, None)?;
            if matches!(other, Ok(Laid::Path(_))) {
                return Ok(other);
            }
        }
        Ok(laid)
    }
}

impl Along {
    /// Whether a wall is an arc round the wire's side of just the correction.
    fn is_at_limit(&self, wall: &Wall, within: f64) -> bool {
        matches!(&wall.geometry, Segment::Arc(arc)
            if arc.sweep * self.side > 0.0 && (arc.radius - self.correction).abs() <= within)
    }
}
