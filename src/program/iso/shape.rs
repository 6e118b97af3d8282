//! How a cut goes on from the one before: where the way turns back on itself, an arc runs the other way round, or a spur goes out and back.

use super::block::Motion;
use super::machine::{Bend, Course, Move, Reading, Trail, distance, micrometres};
use crate::finding::Fault;
use crate::geometry::{Segment, Vector, cross};

/// Two cuts that turn by less are tangent, radians; for a small arc rounding adds to it.
const TANGENT: f64 = 0.0175;

/// What rounding of a centre moves it by, µm.
const ROUNDING: f64 = 3.0;

/// A turn of which nobody says that it is meant to be none, radians.
const CLEAR: f64 = 0.35;

/// From this turn on the way goes back on itself, radians.
const BACK: f64 = 3.09;

/// Two places within this are one, nm.
const MET: f64 = 2_000.0;

/// A joint that may be a fault: what comes next says so.
pub enum Joint {
    /// An arc that would go on from the cut before without a corner if it ran the other way round.
    Reversed { made: Move, is_back: bool },
    /// Out, and back on the same way; how the wire came to where that began, and how it went out.
    Spur {
        made: Move,
        came: Vector,
        out: Vector,
        length: f64,
    },
}

/// How a cut goes on from those before; `None` where nothing is odd about it.
pub fn joint(trail: &Trail, made: &Move, reading: &Reading) -> Option<Joint> {
    let before = trail.last[0]?;
    // Seen from where it begins, so that it comes to the same wherever it lies.
    let made = made.at_origin();
    let (out, heading) = directions(&before, reading)?;
    let (start, _) = directions(&made, reading)?;
    let turned = turn(heading, start);
    if turned < CLEAR {
        return None;
    }
    if turned > BACK && before.is_arc() == made.is_arc() {
        let length = distance(before.from, before.to).min(distance(made.from, made.to)) / 1e3;
        if !made.is_arc()
            || (distance(before.from, made.to) <= MET && has_one_center(&before, &made, reading))
        {
            let (_, came) = directions(&trail.last[1]?, reading)?;
            return Some(Joint::Spur {
                made,
                came,
                out,
                length,
            });
        }
    }
    if !made.is_arc() || made.from == made.to {
        return None;
    }
    let (start, _) = directions(&exchanged(&made), reading)?;
    (turn(heading, start) < tangent(&made, reading)).then_some(Joint::Reversed {
        made,
        is_back: turned > BACK,
    })
}

impl Joint {
    /// What is wrong, seen with the next cut of the same contour.
    pub fn fault(&self, next: Option<&Move>, reading: &Reading) -> Option<Fault> {
        let ahead = next.and_then(|next| Some(directions(&next.at_origin(), reading)?.0));
        match self {
            Joint::Reversed { made, is_back } => {
                let (_, end) = directions(made, reading)?;
                let (_, other) = directions(&exchanged(made), reading)?;
                let ahead = ahead?;
                let now = turn(end, ahead);
                let found = now > CLEAR && turn(other, ahead) < tangent(made, reading);
                let is_sure = *is_back && now > BACK && matches!(made.bend, Bend::Center { .. });
                found.then_some(Fault::ReversedArc { is_sure })
            }
            Joint::Spur {
                made,
                came,
                out,
                length,
            } => {
                let ahead = ahead?;
                let (_, end) = directions(made, reading)?;
                // A way that is gone back all along, as a second pass does, is no spur.
                let goes_back = turn(-came, ahead) < TANGENT
                    || turn(end, ahead) < TANGENT
                    || turn(*came, *out) < TANGENT;
                (!goes_back).then_some(Fault::Spur { length: *length })
            }
        }
    }
}

/// G02 for G03, and the other way round.
pub fn exchanged(made: &Move) -> Move {
    let motion = match made.motion {
        Motion::Clockwise => Motion::CounterClockwise,
        Motion::CounterClockwise => Motion::Clockwise,
        other => other,
    };
    Move { motion, ..*made }
}

fn has_one_center(one: &Move, other: &Move, reading: &Reading) -> bool {
    let center = |made: &Move| match made.course(reading) {
        Course::Arc(arc) => Some(arc.center),
        _ => None,
    };
    // Both are seen from where the first one ends.
    matches!((center(one), center(other)), (Some(a), Some(b)) if (a - b).norm() <= MET / 1e3)
}

/// What counts as no turn beside an arc, radians.
pub fn tangent(made: &Move, reading: &Reading) -> f64 {
    let radius = match made.course(reading) {
        Course::Arc(arc) => arc.radius,
        _ => f64::INFINITY,
    };
    TANGENT + ROUNDING / radius
}

/// The turn between two directions, radians.
pub fn turn(from: Vector, to: Vector) -> f64 {
    cross(from, to).atan2(from.dot(&to)).abs()
}

/// Where a move leads at its start and at its end, of any length; `None` where it leads nowhere.
pub fn directions(made: &Move, reading: &Reading) -> Option<(Vector, Vector)> {
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
    match made.course(reading) {
        Course::Arc(arc) => Some((
            Segment::Arc(arc).start_tangent(),
            Segment::Arc(arc).end_tangent(),
        )),
        _ => None,
    }
}
