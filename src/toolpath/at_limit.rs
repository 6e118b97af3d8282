//! Contours with arcs just at the correction: what rounding leaves of these is neither an arc nor a point.

use super::clearance::Walls;
use super::contour_path::{Along, Known, Laid, Outcome};
use super::job::Job;
use super::offset::Wall;
use super::path::Refusal;
use crate::geometry::Segment;

/// A path farther away by this, mm, is as good: beside it every such arc is too tight, and its neighbours are cut with
/// each other.
const BESIDE: f64 = 3e-6;

impl Job<'_> {
    /// The path along a contour, as `laid_within` has it, of which nothing has been proved before.
    pub(super) fn laid(
        &self,
        walls: &[Wall],
        own: &Walls,
        along: Along,
    ) -> Result<Outcome, Refusal> {
        self.laid_within(walls, own, along, Known::default())
    }

    /// The path along a contour, proved; `walls` have the wire on the side of that sign. That of an open one runs from
    /// beside the beginning of the first wall to beside the end of the last. What is `known` is not looked at again.
    pub(super) fn laid_within(
        &self,
        walls: &[Wall],
        own: &Walls,
        along: Along,
        known: Known,
    ) -> Result<Outcome, Refusal> {
        let laid = self.laid_at(walls, own, along, known)?;
        let beside = self.units(BESIDE);
        if matches!(laid, Ok(Laid::Path(_)))
            || !walls.iter().any(|wall| along.is_at_limit(wall, beside))
        {
            return Ok(laid);
        }
        let wider = Along {
            correction: along.correction + beside,
            ..along
        };
        let other = self.laid_at(walls, own, wider, Known::default())?;
        Ok(match other {
            Ok(Laid::Path(_)) => other,
            _ => laid,
        })
    }
}

impl Along {
    /// Whether a wall is an arc round the wire's side of just the correction.
    fn is_at_limit(&self, wall: &Wall, within: f64) -> bool {
        matches!(&wall.geometry, Segment::Arc(arc)
            if arc.sweep * self.side > 0.0 && (arc.radius - self.correction).abs() <= within)
    }
}
