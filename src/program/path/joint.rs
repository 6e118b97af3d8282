//! The joint of two blocks: `spur`, where the way goes out and back, and `reversed-arc`, where an arc runs the wrong
//! way round.
//!
//! Four blocks decide about a joint: the two before it, the one that begins at it, and the next.

use crate::finding::Fault;
use crate::geometry::{Point, Segment, Vector, cross, left_normal};

/// Two blocks that turn by less are tangent, radians; for a small arc rounding adds to it.
pub(crate) const TANGENT: f64 = 0.0175;

/// The shift of a centre by rounding, µm.
pub(crate) const ROUNDING: f64 = 3.0;

/// A turn that nobody takes for a tangent joint, radians.
pub(crate) const CLEAR: f64 = 0.35;

/// From this turn on the way goes back on itself, radians.
pub(crate) const BACK: f64 = 3.09;

/// Two places within this are one, µm.
const MET: f64 = 2.0;

/// A way out and back of no more than this comes of rounding, µm.
const SHORTEST: f64 = 4.0;

/// A block as its joints see it.
#[derive(Clone, Copy, Debug)]
pub(in crate::program) struct Jointed {
    pub(crate) curve: Segment,
    /// An arc that gives its radius alone: its centre depends on its direction.
    pub(crate) by_radius: bool,
    /// It is marked as a lead of a contour.
    pub(crate) is_lead: bool,
}

impl Jointed {
    /// A block of a language whose arcs give their centres.
    pub(crate) fn of(curve: Segment) -> Jointed {
        Jointed {
            curve,
            by_radius: false,
            is_lead: false,
        }
    }

    fn is_arc(&self) -> bool {
        self.curve.as_arc().is_some()
    }

    /// From its start to its end, µm.
    fn chord(&self) -> Vector {
        self.curve.end() - self.curve.start()
    }

    /// Its directions at its start and at its end, of any length; `None` for a block without length.
    fn directions(&self) -> Option<[Vector; 2]> {
        let Segment::Arc(arc) = &self.curve else {
            let along = self.chord();
            return (along != Vector::zeros()).then_some([along, along]);
        };
        let across = |from: Point| left_normal(from - arc.center) * arc.sweep.signum();
        Some([across(arc.start), across(arc.end)])
    }

    /// Those of the arc in the other direction between its ends.
    fn exchanged(&self) -> Option<[Vector; 2]> {
        let chord = self.chord();
        let along = |way: Vector| chord * (2.0 * way.dot(&chord) / chord.norm_squared());
        // With its radius, it lies on the other side of its chord.
        Some(self.directions()?.map(|way| match self.by_radius {
            true => along(way) - way,
            false => -way,
        }))
    }

    /// From the start of an arc to its centre, µm.
    fn center_from_start(&self) -> Option<Vector> {
        Some(self.curve.as_arc()?.center - self.curve.start())
    }
}

/// The odd joints of a cut, in order: the block that begins at each, and what is wrong there. `None` stands for a block
/// whose way nobody knows.
pub(in crate::program) fn odd_joints(
    count: usize,
    block: impl Fn(usize) -> Option<Jointed>,
) -> Vec<(usize, Fault)> {
    let fault = |nth: usize| {
        let (before, made) = (block(nth - 1)?, block(nth)?);
        let came = || block(nth.checked_sub(2)?);
        let joint = may_be_odd(&before, &made).then(|| joint(came, &before, made))?;
        Some((nth, joint?.fault(&block(nth + 1)?)?))
    };
    // The next block decides: nobody knows at the last.
    (1..count.saturating_sub(1)).filter_map(fault).collect()
}

/// A joint that may be a fault: the next block decides.
#[derive(Debug)]
enum Joint {
    /// An arc that would continue the block before without a corner if it ran the other way round.
    Reversed {
        made: Jointed,
        is_back: bool,
        is_in_row: bool,
    },
    /// Out, and back on the same way; the way before that, and the way out.
    Spur {
        made: Jointed,
        came: Vector,
        out: Vector,
        length: f64,
    },
}

/// Whether a joint may be odd: it turns back on itself, or nearly. Costs next to nothing.
fn may_be_odd(before: &Jointed, made: &Jointed) -> bool {
    let (Some([_, heading]), Some([start, _])) = (before.directions(), made.directions()) else {
        return false;
    };
    let dot = heading.dot(&start);
    let turns_back = dot < 0.0 && dot * dot > 0.87 * heading.norm_squared() * start.norm_squared();
    turns_back || made.by_radius
}

/// The joint of a block with the two before it; `None` where nothing is odd about it.
fn joint(came: impl FnOnce() -> Option<Jointed>, before: &Jointed, made: Jointed) -> Option<Joint> {
    let [out, heading] = before.directions()?;
    let [start, _] = made.directions()?;
    let turned = turn(heading, start);
    if turned < CLEAR {
        return None;
    }
    if turned > BACK && before.is_arc() == made.is_arc() {
        let comes_back = (before.chord() + made.chord()).norm() <= MET;
        if !made.is_arc() || (comes_back && has_one_center(before, &made)) {
            let length = before.chord().norm().min(made.chord().norm());
            let [_, came] = came()?.directions()?;
            let is_spur = length > SHORTEST && !before.is_lead && !made.is_lead;
            return is_spur.then_some(Joint::Spur {
                made,
                came,
                out,
                length,
            });
        }
    }
    if !made.is_arc() || made.chord().norm() == 0.0 {
        return None;
    }
    let [start, _] = made.exchanged()?;
    let is_in_row = turned > BACK && are_of_a_row(before, &made);
    (turn(heading, start) < tangent(&made)?).then_some(Joint::Reversed {
        made,
        is_back: turned > BACK,
        is_in_row,
    })
}

impl Joint {
    /// The fault, given the next block of the same contour.
    fn fault(&self, next: &Jointed) -> Option<Fault> {
        let [ahead, _] = next.directions()?;
        match self {
            Joint::Reversed {
                made,
                is_back,
                is_in_row,
            } => {
                let ([_, end], [_, other]) = (made.directions()?, made.exchanged()?);
                let now = turn(end, ahead);
                // Equal half circles side by side are the edge of a shell, or the teeth of a rack.
                let is_in_row = *is_in_row || now > BACK && are_of_a_row(made, next);
                let found = now > CLEAR && turn(other, ahead) < tangent(made)? && !is_in_row;
                let is_sure = *is_back && now > BACK && !made.by_radius;
                found.then_some(Fault::ReversedArc { is_sure })
            }
            Joint::Spur {
                made,
                came,
                out,
                length,
            } => {
                let [_, end] = made.directions()?;
                // A way that is retraced completely, as a second pass does, is no spur.
                let goes_back = turn(-came, ahead) < TANGENT
                    || turn(end, ahead) < TANGENT
                    || turn(*came, *out) < TANGENT;
                (!goes_back).then_some(Fault::Spur { length: *length })
            }
        }
    }
}

fn has_one_center(before: &Jointed, made: &Jointed) -> bool {
    let of_before = before
        .center_from_start()
        .map(|center| center - before.chord());
    matches!((of_before, made.center_from_start()), (Some(a), Some(b)) if (a - b).norm() <= MET)
}

/// Two arcs of one radius that turn the same way.
fn are_of_a_row(one: &Jointed, other: &Jointed) -> bool {
    let turned = |arc: &Jointed| {
        let center = arc.center_from_start()?;
        let [start, _] = arc.directions()?;
        Some(center.norm() * cross(start, center).signum())
    };
    let radii = turned(one).zip(turned(other));
    radii.is_some_and(|(a, b)| (a - b).abs() <= 2.0 * ROUNDING)
}

/// The largest turn that counts as none beside an arc, radians; `None` where it is so small that rounding decides its
/// direction.
fn tangent(made: &Jointed) -> Option<f64> {
    let radius = made
        .center_from_start()
        .map_or(f64::INFINITY, |center| center.norm());
    Some(TANGENT + ROUNDING / radius).filter(|tangent| *tangent < CLEAR)
}

/// The turn between two directions, radians.
pub(crate) fn turn(from: Vector, to: Vector) -> f64 {
    cross(from, to).atan2(from.dot(&to)).abs()
}
