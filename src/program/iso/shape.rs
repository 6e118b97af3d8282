//! A move as its joints see it.

use super::block::Motion;
use super::moves::{Bend, Course, Move, Reading, micrometres};
use crate::geometry::Vector;
use crate::program::path::Heading;

/// A move and the reading of its numbers. It is moved to the zero of the plane, so that the result is the same
/// anywhere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape<'a> {
    pub(crate) made: Move,
    pub(crate) reading: &'a Reading,
}

impl Heading for Shape<'_> {
    fn is_arc(&self) -> bool {
        self.made.is_arc()
    }

    fn directions(&self) -> Option<[Vector; 2]> {
        directions(&self.made, self.reading).map(Into::into)
    }

    /// With G02 for G03, and the other way round.
    fn exchanged(&self) -> Option<[Vector; 2]> {
        let motion = self.made.motion.reversed();
        let made = Move {
            motion,
            ..self.made
        };
        directions(&made, self.reading).map(Into::into)
    }

    fn chord(&self) -> Vector {
        micrometres(self.made.to) - micrometres(self.made.from)
    }

    fn to_center(&self) -> Option<Vector> {
        match self.made.course(self.reading) {
            Course::Arc(arc) => Some(arc.center - micrometres(self.made.from)),
            _ => None,
        }
    }

    fn says_center(&self) -> bool {
        matches!(self.made.bend, Bend::Center { .. })
    }

    fn is_lead(&self) -> bool {
        self.made.switches.is_some()
    }
}

/// The directions of a move at its start and end, of any length; `None` for a move without length.
pub(crate) fn directions(made: &Move, reading: &Reading) -> Option<(Vector, Vector)> {
    if !made.is_arc() {
        let along = micrometres(made.to) - micrometres(made.from);
        return (made.from != made.to).then_some((along, along));
    }
    if let Some(center) = made.center(reading.rule(made.incremental)) {
        let across = |from: [i64; 2]| {
            let out = micrometres(from) - micrometres(center);
            if made.motion == Motion::CounterClockwise {
                Vector::new(-out.y, out.x)
            } else {
                Vector::new(out.y, -out.x)
            }
        };
        let (start, end) = (across(made.from), across(made.to));
        return (start.norm() > 0.0 && end.norm() > 0.0).then_some((start, end));
    }
    let arc = made.curve(reading)?;
    Some((arc.start_tangent(), arc.end_tangent()))
}
