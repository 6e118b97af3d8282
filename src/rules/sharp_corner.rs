//! `sharp-corner`: a corner with the wire on its inside.
//!
//! A round wire leaves at least its own radius and the spark gap there, whatever the drawing says. Fix: a fillet of
//! that radius, so that the drawing shows what comes off the machine. Corners between chords that `arc-as-chords` takes
//! for an arc do not count.

use super::arc_as_chords::{self, are_between_chords};
use super::disc::{loci, slack, touch};
use super::small_radius::{Travel, fillet};
use super::wall::Wall;
use super::{LocalRule, Observation, Outlook, other_at_joint};
use crate::finding::{Detail, Fix, FixKind, Rule, Side};
use crate::geometry::Locus;
use crate::geometry::{Point, turn};
use std::ops::Range;

pub(crate) const RULE: LocalRule = LocalRule {
    rule: Rule::SharpCorner,
    check,
    reach: |_, _| (arc_as_chords::REACH, arc_as_chords::REACH),
    related: other_at_joint,
    detail,
    fixes,
    one_hint_when_side_unknown: true,
    together: Some(together),
    ..LocalRule::PLAIN
};

/// Turns (radians) above this are corners.
const LEAST: f64 = 1.0 * std::f64::consts::PI / 180.0;

/// A joint below this is nearly tangent and left to `near-tangent`, unless the wire is known to run inside.
pub(crate) const CLEAR: f64 = 2.0 * std::f64::consts::PI / 180.0;

/// mm; what stays of a corner below this, nobody sees on a part.
const LEAST_UNCUT: f64 = 0.005;

/// The side on which the wire runs inside a corner that turns by `turn`; `None` where there is no corner.
pub(crate) fn inner_side(turn: f64) -> Option<Side> {
    (turn.abs() > LEAST).then_some(if turn > 0.0 { Side::Left } else { Side::Right })
}

fn check(outlook: &Outlook, range: Range<usize>, observations: &mut Vec<Observation>) {
    // Worked out only where some corner is flat enough.
    let mut between: Option<Vec<bool>> = None;
    let (first, steepest) = (range.start, arc_as_chords::steepest());
    for index in range.clone() {
        if let Some(turn) = outlook.turn_at(index)
            && let Some(side) = inner_side(turn)
            && leaves_some(outlook, turn)
        {
            let mut is_between = || {
                between
                    .get_or_insert_with(|| are_between_chords(outlook, range.clone()))
                    .get(index - first)
                    .copied()
            };
            if turn.abs() <= steepest && is_between().unwrap_or(false) {
                continue;
            }
            observations.push(Observation {
                side: Some(side),
                needs_side: turn.abs() < CLEAR,
                weight: turn.abs() as f32,
                ..Observation::at(index)
            });
        }
    }
}

/// The last pass leaves R; `uncut` is what stays between the arc and this corner: `R (1 / cos(θ/2) − 1)` between
/// straight walls, less where they are short. Anything beyond that is `lost-pocket`: the wire does not get there.
fn detail(outlook: &Outlook, observation: Observation, count: Option<usize>) -> Option<Detail> {
    let index = observation.index as usize;
    let turn = outlook.turn_at(index)?;
    let radius = outlook.limits.corner_radius;
    let uncut = corner_depth(outlook, index, radius)?;
    let behind = outlook.segment(index as isize)?;
    Some(Detail::SharpCorner {
        turn: if behind.reversed { -turn } else { turn },
        radius,
        uncut,
        count,
    })
}

/// The corner of which most stays stands for all.
fn together(
    outlook: &Outlook,
    some: &[(Observation, Detail)],
    count: usize,
) -> Option<(Observation, Detail)> {
    let uncut_of = |detail: &Detail| match detail {
        Detail::SharpCorner { uncut, .. } => *uncut,
        _ => 0.0,
    };
    let worst = some
        .iter()
        .max_by(|one, other| uncut_of(&one.1).total_cmp(&uncut_of(&other.1)))?;
    let Detail::SharpCorner { radius, uncut, .. } = worst.1 else {
        return None;
    };
    let at = outlook.segment(worst.0.index as isize)?.geometry.start();
    Some((
        worst.0,
        Detail::SharpCorners {
            radius,
            uncut,
            at,
            count,
        },
    ))
}

/// How many segments on either side of a corner may hold the disc in it.
const HOLDING: isize = 8;

/// How much of the corner at the start of the segment at `index` a disc of `radius` leaves, on the
/// side to which the contour turns. Between long walls that is what the disc that touches both
/// leaves. Where the walls are short or fall back it is at most `R (1 / cos(θ/2) − 1)`, the
/// corner's own share of the loss. `None` at the end of an open contour.
fn corner_depth(outlook: &Outlook, index: usize, radius: f64) -> Option<f64> {
    let count = outlook.contour.len();
    let wall = |index: isize| {
        let index = if outlook.contour.closed {
            index.rem_euclid(count as isize)
        } else {
            index
        };
        Wall::new(outlook, usize::try_from(index).ok()?)
    };
    let index = index as isize;
    let (before, behind) = (wall(index - 1)?, wall(index)?);
    let turned = turn(
        before.geometry().end_tangent(),
        behind.geometry().start_tangent(),
    );
    let (side, at) = (
        if turned > 0.0 {
            Side::Left
        } else {
            Side::Right
        },
        behind.geometry().start(),
    );
    let least = radius - slack(outlook.limits, radius);
    let reach = HOLDING.min(count as isize / 2);
    let depth_of = |one: &Wall, other: &Wall, center: Point| {
        let depth = (at - center).norm() - radius;
        let is_held = depth >= 0.0
            && touch(one, side, center, radius).is_some()
            && touch(other, side, center, radius).is_some();
        let is_clear = || {
            (-2 * reach..=2 * reach)
                .filter_map(|steps| behind.beside(steps))
                .all(|near| near.distance_to(center) >= least)
        };
        (is_held && is_clear()).then_some(depth)
    };
    // Most corners have walls that are long enough.
    let along = |wall: &Wall| {
        Locus::beside(
            wall.geometry(),
            side.sign(),
            radius,
            outlook.limits.tolerances.zero_length,
        )
    };
    // Inside of a tight arc the disc runs nowhere.
    let both = along(&before).zip(along(&behind));
    if let Some(depth) = both
        .into_iter()
        .flat_map(|(one, other)| one.meet(&other))
        .filter_map(|center| depth_of(&before, &behind, center))
        .min_by(f64::total_cmp)
    {
        return Some(depth);
    }
    // A wall holds the disc, or the tip at its start does: after the corner a tip may end the last wall.
    let early: Vec<Wall> = (1..=reach)
        .filter_map(|steps| wall(index - steps))
        .collect();
    let late: Vec<Wall> = (0..=reach)
        .filter_map(|steps| wall(index + steps))
        .collect();
    let pairs = early
        .iter()
        .flat_map(|one| late.iter().map(move |other| (one, other)));
    let depths = pairs.flat_map(|(one, other)| {
        let (own, theirs) = (loci(one, side, radius), loci(other, side, radius));
        let centers = own.into_iter().flatten().flat_map(move |own| {
            theirs
                .into_iter()
                .flatten()
                .flat_map(move |locus| own.meet(&locus))
        });
        centers
            .filter_map(|center| depth_of(one, other, center))
            .collect::<Vec<_>>()
    });
    let shorter = before.geometry().length().min(behind.geometry().length());
    let least = depths.min_by(f64::total_cmp).unwrap_or(shorter);
    Some(least.min(own_share(radius, turned)))
}

/// Whether enough stays of a corner to be seen on the part.
pub(crate) fn leaves_some(outlook: &Outlook, turn: f64) -> bool {
    let limits = outlook.limits;
    let least = (LEAST_UNCUT / limits.unit_mm).max(limits.tolerances.resolution);
    own_share(limits.corner_radius, turn) >= least
}

/// What a wire that leaves `radius` leaves of a corner between long walls.
fn own_share(radius: f64, turn: f64) -> f64 {
    radius * (1.0 / (turn / 2.0).cos() - 1.0)
}

fn fixes(outlook: &Outlook, observation: Observation) -> Vec<Fix> {
    let Some(side) = outlook
        .turn_at(observation.index as usize)
        .and_then(inner_side)
    else {
        return Vec::new();
    };
    let travel = Travel {
        drawing: outlook.drawing,
        contour: outlook.contour,
        index: outlook.index,
        side,
    };
    let index = observation.index as usize;
    // The corner lies at the start of the segment at `index`; against the contour's direction, at its end.
    let before = match side {
        Side::Left => travel.position_of(index) - 1,
        Side::Right => travel.position_of(index),
    };
    let Some((edit, moved)) = fillet(&travel, before, outlook.limits) else {
        return Vec::new();
    };
    let kind = FixKind::Fillet {
        radius: outlook.limits.fix_radius,
        moved,
    };
    vec![Fix {
        kind,
        preferred: true,
        in_fix_all: false,
        edit,
    }]
}
