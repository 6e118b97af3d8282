//! How a way goes on from block to block: `spur`, where it goes out and back, and `reversed-arc`, where an arc runs the other way round.
//!
//! Four blocks tell a joint: the two before it, the one that begins at it, and what follows.

use crate::finding::Fault;
use crate::geometry::{Point, Segment, Vector, cross, left_normal};

/// Two blocks that turn by less are tangent, radians; for a small arc rounding adds to it.
const TANGENT: f64 = 0.0175;

/// What rounding of a centre moves it by, µm.
const ROUNDING: f64 = 3.0;

/// A turn of which nobody says that it is meant to be none, radians.
const CLEAR: f64 = 0.35;

/// From this turn on the way goes back on itself, radians.
const BACK: f64 = 3.09;

/// Two places within this are one, µm.
const MET: f64 = 2.0;

/// A way out and back of no more than this comes of rounding, µm.
const SHORTEST: f64 = 4.0;

/// Where a block leads, as far as its joints tell.
pub(crate) trait Heading {
    fn is_arc(&self) -> bool;
    /// Its directions at its start and at its end, of any length; `None` where it leads nowhere.
    fn directions(&self) -> Option<[Vector; 2]>;
    /// Those of the arc that runs the other way round between its ends.
    fn exchanged(&self) -> Option<[Vector; 2]>;
    /// From its start to its end, µm.
    fn chord(&self) -> Vector;
    /// From the start of an arc to its centre, µm.
    fn to_center(&self) -> Option<Vector>;
    /// It says where its centre is; else the centre hangs on how it turns.
    fn says_center(&self) -> bool;
    /// It leads to a contour or away from it, and says so.
    fn is_lead(&self) -> bool;
}

impl Heading for Segment {
    fn is_arc(&self) -> bool {
        self.as_arc().is_some()
    }

    fn directions(&self) -> Option<[Vector; 2]> {
        let Segment::Arc(arc) = self else {
            let along = self.chord();
            return (along != Vector::zeros()).then_some([along, along]);
        };
        let across = |from: Point| left_normal(from - arc.center) * arc.sweep.signum();
        Some([across(arc.start), across(arc.end)])
    }

    fn exchanged(&self) -> Option<[Vector; 2]> {
        Some(self.directions()?.map(|direction| -direction))
    }

    fn chord(&self) -> Vector {
        self.end() - self.start()
    }

    fn to_center(&self) -> Option<Vector> {
        Some(self.as_arc()?.center - self.start())
    }

    fn says_center(&self) -> bool {
        true
    }

    fn is_lead(&self) -> bool {
        false
    }
}

/// A joint that may be a fault: what comes next says so.
#[derive(Debug)]
pub(crate) enum Joint<H> {
    /// An arc that would go on from the block before without a corner if it ran the other way round.
    Reversed { made: H, is_back: bool },
    /// Out, and back on the same way; how the wire came to where that began, and how it went out.
    Spur {
        made: H,
        came: Vector,
        out: Vector,
        length: f64,
    },
}

/// How a block goes on from the two before it; `None` where nothing is odd about it.
pub(crate) fn joint<H: Heading>(came: Option<H>, before: &H, made: H) -> Option<Joint<H>> {
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
            let [_, came] = came?.directions()?;
            let is_spur = length > SHORTEST && !before.is_lead() && !made.is_lead();
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
    (turn(heading, start) < tangent(&made)?).then_some(Joint::Reversed {
        made,
        is_back: turned > BACK,
    })
}

impl<H: Heading> Joint<H> {
    /// What is wrong, seen with the next block of the same contour.
    pub(crate) fn fault(&self, next: Option<&H>) -> Option<Fault> {
        let [ahead, _] = next?.directions()?;
        match self {
            Joint::Reversed { made, is_back } => {
                let ([_, end], [_, other]) = (made.directions()?, made.exchanged()?);
                let now = turn(end, ahead);
                let found = now > CLEAR && turn(other, ahead) < tangent(made)?;
                let is_sure = *is_back && now > BACK && made.says_center();
                found.then_some(Fault::ReversedArc { is_sure })
            }
            Joint::Spur {
                made,
                came,
                out,
                length,
            } => {
                let [_, end] = made.directions()?;
                // A way that is gone back all along, as a second pass does, is no spur.
                let goes_back = turn(-came, ahead) < TANGENT
                    || turn(end, ahead) < TANGENT
                    || turn(*came, *out) < TANGENT;
                (!goes_back).then_some(Fault::Spur { length: *length })
            }
        }
    }
}

/// What is wrong at the joint at which `made` begins, in a language whose blocks say where their centres are.
pub(crate) fn odd_joint(
    came: Option<Segment>,
    before: Segment,
    made: Segment,
    next: &Segment,
) -> Option<Fault> {
    if !may_be_odd(&before, &made) {
        return None;
    }
    joint(came, &before, made)?.fault(Some(next))
}

/// Whether a joint may be odd: it turns back on itself, or nearly. Costs next to nothing.
pub(crate) fn may_be_odd(before: &Segment, made: &Segment) -> bool {
    let (Some([_, heading]), Some([start, _])) = (before.directions(), made.directions()) else {
        return false;
    };
    let dot = heading.dot(&start);
    dot < 0.0 && dot * dot > 0.87 * heading.norm_squared() * start.norm_squared()
}

fn has_one_center<H: Heading>(before: &H, made: &H) -> bool {
    let of_before = before.to_center().map(|center| center - before.chord());
    matches!((of_before, made.to_center()), (Some(a), Some(b)) if (a - b).norm() <= MET)
}

/// What counts as no turn beside an arc, radians; `None` where it is so small that rounding tells its direction.
fn tangent<H: Heading>(made: &H) -> Option<f64> {
    let radius = made
        .to_center()
        .map_or(f64::INFINITY, |center| center.norm());
    Some(TANGENT + ROUNDING / radius).filter(|tangent| *tangent < CLEAR)
}

/// The turn between two directions, radians.
pub(crate) fn turn(from: Vector, to: Vector) -> f64 {
    cross(from, to).atan2(from.dot(&to)).abs()
}
