//! `narrow-slot`: two facing walls on the wire side, closer together than the wire is wide.
//!
//! An observation is a local minimum of the width: a disc with a diameter below twice the correction that touches two
//! walls from opposite sides, holds no other part of the outlines, and could only grow by moving along the slot. A
//! corner is not a slot: between its walls the disc can always shrink. The mouth of a run of arcs below the correction
//! is left to `small-radius`.
//!
//! Walls of two contours that lie on one another leave no room at all. Whether the wire of one then runs in the part of the other depends on
//! both contours: that is decided where the sides are known.
//!
//! What an electrode mills along the middle of an open contour reaches one correction to either side. Within that there may be no wall of
//! a closed contour, on whichever side of it; and where the middles of two slots come nearer to each other than a slot is wide, no wall is
//! left between them. Slots that meet are one cavity.

use super::wall::{Corner, Joints, Wall, side_of};
use super::{Limits, NEIGHBOURS, PairObservation, PairRule, small_radius};
use crate::finding::{Detail, Rule, Severity, Side};
use crate::geometry::{Point, Segment, Vector, curvature, facing, foot_inside, shared_length};

pub(crate) const RULE: PairRule = PairRule {
    rule: Rule::NarrowSlot,
    reach: |limits| 2.0 * limits.correction,
    check: |one, other, same_contour| {
        // How near a cut on the line comes to others, its path says.
        if one.outlook.on_line || other.outlook.on_line {
            return Vec::new();
        }
        let middles = middles(one, other);
        let observation = |slot: Slot| {
            let center = slot.from + (slot.to - slot.from) * 0.5;
            PairObservation {
                sides: match middles {
                    0 => slot.sides,
                    _ => (None, None),
                },
                disc: Some((center, slot.width / 2.0)),
                // A slot that comes back beside itself may be the way to clear an area.
                mildest: (same_contour && middles > 0).then_some(Severity::Warning),
                ..PairObservation::default()
            }
        };
        let slot = narrowest(one, other, same_contour).or_else(|| on_the_wall(one, other));
        let slot = slot.map(observation);
        let without_room = match same_contour || middles > 0 {
            true => None,
            false => sides_without_room(one, other),
        };
        let all = without_room.into_iter().flatten();
        let sides = all.map(|(own, theirs)| (Some(own), Some(theirs)));
        let is_seen = |sides: &(Option<Side>, Option<Side>)| {
            slot.is_some_and(|slot: PairObservation| slot.sides == *sides)
        };
        let without_room = sides
            .filter(|sides| !is_seen(sides))
            .map(|sides| PairObservation {
                sides,
                ..PairObservation::default()
            });
        slot.into_iter().chain(without_room).collect()
    },
    detail: |one, other, same_contour| {
        let slot = narrowest(one, other, same_contour).or_else(|| on_the_wall(one, other));
        let width = match (slot, same_contour) {
            (Some(slot), _) => slot.width,
            (None, true) => return None,
            (None, false) => sides_without_room(one, other).map(|_| 0.0)?,
        };
        Some(Detail::NarrowSlot {
            width,
            required: required(one, other),
            middles: middles(one, other),
        })
    },
    one_per_place: true,
    silent_where_they_part: true,
    warning_when_side_unknown: true,
    ..PairRule::PLAIN
};

/// Of two walls, those that are the middle of a milled slot.
fn middles(one: &Wall, other: &Wall) -> usize {
    let is_middle = |wall: &&Wall| wall.outlook.is_middle();
    [one, other].iter().filter(|wall| is_middle(wall)).count()
}

/// How far from each other two walls are at least, where nothing of what they bound is cut.
fn required(one: &Wall, other: &Wall) -> f64 {
    let correction = one.outlook.limits.correction;
    match middles(one, other) {
        1 => correction,
        _ => 2.0 * correction,
    }
}

/// True where a slot ends in another one: the two are one cavity.
fn is_joined(one: &Wall, other: &Wall, from: Point, to: Point) -> bool {
    // Up to 60° beside the way on which the slot would go on.
    const AHEAD: f64 = 0.5;
    let way = to - from;
    let ends = |wall: &Wall, at: Point, toward: Vector| {
        wall.corners().any(|corner| {
            let ahead = match (corner.incoming, corner.outgoing) {
                (Some(incoming), None) => incoming.end_tangent(),
                (None, Some(outgoing)) => -outgoing.start_tangent(),
                _ => return false,
            };
            corner.at == at && ahead.dot(&toward) > AHEAD * toward.norm()
        })
    };
    middles(one, other) == 2
        && way.norm() <= one.outlook.limits.correction
        && (ends(one, from, way) || ends(other, to, -way))
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Slot {
    from: Point,
    to: Point,
    width: f64,
    sides: (Option<Side>, Option<Side>),
}

/// The sides of travel on which two wires run on different sides of walls that lie on one another, one way and the other. `None` where the
/// two do not.
fn sides_without_room(one: &Wall, other: &Wall) -> Option<[(Side, Side); 2]> {
    let (a, b) = (one.geometry(), other.geometry());
    let run_alike = match (a, b) {
        (Segment::Line(a), Segment::Line(b)) => a.direction().dot(&b.direction()) > 0.0,
        (Segment::Arc(a), Segment::Arc(b)) => a.sweep * b.sweep > 0.0,
        _ => return None,
    };
    lie_on_one_another(one, other).then_some(match run_alike {
        true => [(Side::Left, Side::Right), (Side::Right, Side::Left)],
        false => [(Side::Left, Side::Left), (Side::Right, Side::Right)],
    })
}

fn lie_on_one_another(one: &Wall, other: &Wall) -> bool {
    let tolerances = &one.outlook.limits.tolerances;
    let shared = shared_length(one.geometry(), other.geometry(), tolerances.same_place);
    shared > tolerances.same_place.max(tolerances.resolution)
}

/// The middle of a slot that lies on a wall.
fn on_the_wall(one: &Wall, other: &Wall) -> Option<Slot> {
    let at = one.geometry().point_at(0.5);
    let lies_there = middles(one, other) == 1 && lie_on_one_another(one, other);
    lies_there.then_some(Slot {
        from: at,
        to: at,
        width: 0.0,
        sides: (None, None),
    })
}

/// The narrowest place between two segments that is a local minimum of the width.
fn narrowest(one: &Wall, other: &Wall, same_contour: bool) -> Option<Slot> {
    let limits = one.outlook.limits;
    let tolerances = &limits.tolerances;
    let joints = Joints::of(one, other, same_contour, tolerances.touch);
    // Ends that do not quite meet are one place.
    let about_joint = joints.gap + tolerances.touch;
    let (a, b) = (one.geometry(), other.geometry());
    let mut best: Option<Slot> = None;
    let mut consider =
        |from: Point, to: Point, sides: &dyn Fn(Vector) -> Option<(Option<Side>, Option<Side>)>| {
            let width = (to - from).norm();
            let narrow =
                width > tolerances.touch && width < required(one, other) - tolerances.report;
            if narrow
                && best.is_none_or(|best| width < best.width)
                && !(joints.are_at(from, about_joint) && joints.are_at(to, about_joint))
                && !is_joined(one, other, from, to)
                && let Some(sides) = sides((to - from) / width)
            {
                best = Some(Slot {
                    from,
                    to,
                    width,
                    sides,
                });
            }
        };
    let wall_side = |segment: &Segment, at: Point, toward| {
        Some(side_of(
            segment.tangent_at(segment.share_of(at).clamp(0.0, 1.0)),
            toward,
        ))
    };
    for (from, to) in facing(a, b) {
        consider(from, to, &|toward| {
            let width = (to - from).norm();
            is_minimum(width, curvature(a, from, toward), curvature(b, to, -toward))
                .then(|| (wall_side(a, from, toward), wall_side(b, to, -toward)))
        });
    }
    let foot_on = |wall: &Wall, corner: &Corner| {
        let foot = foot_inside(wall.geometry(), corner.at);
        foot.filter(|foot| !(same_contour && is_opening(corner, *foot, wall)))
    };
    for corner in one.corners() {
        if let Some(foot) = foot_on(other, &corner) {
            consider(corner.at, foot, &|toward| {
                (corner.is_nearest(toward)
                    && is_minimum(
                        (foot - corner.at).norm(),
                        f64::NEG_INFINITY,
                        curvature(b, foot, -toward),
                    ))
                .then(|| (corner.side(toward), wall_side(b, foot, -toward)))
            });
        }
        // Between the two ends of an open contour lies its opening, which `open-contour` reports.
        for met in other
            .corners()
            .filter(|met| !(same_contour && corner.is_free_end() && met.is_free_end()))
        {
            consider(corner.at, met.at, &|toward| {
                (corner.is_nearest(toward) && met.is_nearest(-toward))
                    .then(|| (corner.side(toward), met.side(-toward)))
            });
        }
    }
    for corner in other.corners() {
        if let Some(foot) = foot_on(one, &corner) {
            consider(foot, corner.at, &|toward| {
                (corner.is_nearest(-toward)
                    && is_minimum(
                        (foot - corner.at).norm(),
                        curvature(a, foot, toward),
                        f64::NEG_INFINITY,
                    ))
                .then(|| (wall_side(a, foot, toward), corner.side(-toward)))
            });
        }
    }
    best.filter(|_| {
        !(same_contour && (is_mouth(one, other, limits) || is_mouth(other, one, limits)))
    })
}

/// Whether a place lies between the two ends of an open contour, nearer to the other end than to this one: that is the
/// opening, which `open-contour` reports.
fn is_opening(end: &Corner, foot: Point, wall: &Wall) -> bool {
    let reach = (foot - end.at).norm();
    let is_other = |other: Corner| other.is_free_end() && (other.at - foot).norm() <= reach;
    end.is_free_end() && wall.corners().any(is_other)
}

/// True when the distance of two walls has a minimum or stays constant, where they are `width`
/// apart and curve towards each other with these curvatures (the second derivatives of the
/// distance; −∞ for a vertex, which cannot be moved).
fn is_minimum(width: f64, one: f64, other: f64) -> bool {
    const ROUNDING: f64 = 1e-6;
    let (u, v) = (1.0 - width * one, 1.0 - width * other);
    match (one.is_finite(), other.is_finite()) {
        (true, true) => u >= 0.0 && v >= 0.0 && u * v >= 1.0 - ROUNDING,
        (true, false) => u > 0.0,
        (false, true) => v > 0.0,
        (false, false) => true,
    }
}

/// True when only arcs below the correction, all bent the same way, lead from `one` to `other`.
fn is_mouth(one: &Wall, other: &Wall, limits: &Limits) -> bool {
    let mut bend = 0.0;
    let is_tight = |segment: &Segment, bend: &mut f64| match segment {
        Segment::Arc(arc)
            if small_radius::is_too_small(arc.radius, limits)
                && (*bend == 0.0 || *bend == arc.sweep.signum()) =>
        {
            *bend = arc.sweep.signum();
            true
        }
        _ => false,
    };
    let count = one.outlook.contour.len();
    let own = is_tight(one.geometry(), &mut bend);
    for steps in 1..=NEIGHBOURS {
        let index = one.index + steps;
        let index = if one.outlook.contour.closed {
            index % count
        } else {
            index
        };
        if index == other.index {
            // Two straight walls with a round end are still a slot: the observation is between the walls.
            return own;
        }
        let Some(segment) = one.beside(steps as isize) else {
            return false;
        };
        if !is_tight(&segment, &mut bend) {
            return false;
        }
    }
    false
}
