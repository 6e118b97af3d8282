//! `near-tangent`: two segments that look tangent but are not quite.
//!
//! The control takes the joint for a corner: it stops there or rolls the offset round it, and the wire leaves a mark.
//! Fix: the arc at the joint becomes tangent, or two nearly collinear lines become one.

use super::arc_as_chords::{self, are_between_chords};
use super::sharp_corner::{CLEAR, inner_side, leaves_some};
use super::small_radius::{Travel, center_side, drawing_edit, made_tangent};
use super::{LocalRule, Observation, Outlook, other_at_joint};
use crate::drawing::{Change, ContourSegment, DrawingEdit, Geometry};
use crate::finding::{Detail, Fix, FixKind, Rule, Side};
use crate::geometry::Segment;
use std::ops::Range;

pub(crate) const RULE: LocalRule = LocalRule {
    rule: Rule::NearTangent,
    check,
    reach: |_, _| (arc_as_chords::REACH, arc_as_chords::REACH),
    related: other_at_joint,
    detail,
    fixes,
    together: Some(together),
    ..LocalRule::PLAIN
};

/// Turns (radians) below this are rounding.
const LEAST: f64 = 0.02 * std::f64::consts::PI / 180.0;

fn check(outlook: &Outlook, range: Range<usize>, observations: &mut Vec<Observation>) {
    // Only asked where there is a kink.
    let mut between: Option<Vec<bool>> = None;
    for index in range.clone() {
        if let Some(turn) = outlook
            .turn_at(index)
            .filter(|turn| turn.abs() > LEAST && turn.abs() < CLEAR)
            && shows(outlook, index, turn)
        {
            let between = between.get_or_insert_with(|| are_between_chords(outlook, range.clone()));
            if between.get(index - range.start) == Some(&true) {
                continue;
            }
            // Where the wire runs inside, the larger kinks are sharp corners if they leave enough
            // stock to count.
            let is_corner = leaves_some(outlook, turn);
            observations.push(Observation {
                side: inner_side(turn).filter(|_| is_corner).map(Side::reversed),
                weight: turn.abs() as f32,
                ..Observation::at(index)
            });
        }
    }
}

/// Whether the kink before the segment at `index` is measurable: at its middle, the shorter of the
/// two segments is off the direction of the other by at least the resolution.
fn shows(outlook: &Outlook, index: usize, turn: f64) -> bool {
    let length = |index: isize| {
        outlook
            .segment(index)
            .map_or(0.0, |segment| segment.geometry.length())
    };
    let shorter = length(index as isize - 1).min(length(index as isize));
    shorter / 2.0 * turn.abs() >= outlook.limits.tolerances.resolution
}

fn detail(outlook: &Outlook, observation: Observation, _count: Option<usize>) -> Option<Detail> {
    let turn = outlook.turn_at(observation.index as usize)?;
    let reversed = outlook.segment(observation.index as isize)?.reversed;
    Some(Detail::NearTangent {
        turn: if reversed { -turn } else { turn },
    })
}

fn together(
    outlook: &Outlook,
    some: &[(Observation, Detail)],
    count: usize,
) -> Option<(Observation, Detail)> {
    let (observation, Detail::NearTangent { turn }) = some.first()? else {
        return None;
    };
    let at = outlook
        .segment(observation.index as isize)?
        .geometry
        .start();
    Some((
        *observation,
        Detail::NearTangents {
            turn: *turn,
            at,
            count,
        },
    ))
}

/// The change that moves the contour least, and by less than the distance within which two places count as one.
fn fixes(outlook: &Outlook, observation: Observation) -> Vec<Fix> {
    let index = observation.index as isize;
    let (Some(before), Some(behind)) = (outlook.segment(index - 1), outlook.segment(index)) else {
        return Vec::new();
    };
    let least = outlook.limits.tolerances.same_place;
    let mut found: Vec<(f64, DrawingEdit)> = match (&before.geometry, &behind.geometry) {
        (Segment::Line(_), Segment::Line(_)) => {
            one_line(outlook, &before, &behind).into_iter().collect()
        }
        _ => [(index - 1, &before, true), (index, &behind, false)]
            .into_iter()
            .flat_map(|(at, place, at_end)| arc_of(outlook, at, place, at_end))
            .collect(),
    };
    found.retain(|(moved, _)| *moved < least);
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let fix = |(place, (moved, edit))| Fix {
        kind: FixKind::MakeTangent { moved },
        preferred: place == 0,
        in_fix_all: false,
        edit,
    };
    found.into_iter().enumerate().map(fix).collect()
}

/// The arc at one side of the joint, of the same radius and tangent there. At its other end it stays tangent if it was;
/// otherwise it still goes through that end.
fn arc_of(
    outlook: &Outlook,
    index: isize,
    place: &ContourSegment,
    joint_at_end: bool,
) -> Vec<(f64, DrawingEdit)> {
    let Segment::Arc(arc) = place.geometry else {
        return Vec::new();
    };
    let side = center_side(arc.sweep);
    let travel = Travel {
        drawing: outlook.drawing,
        contour: outlook.contour,
        index: outlook.index,
        side,
    };
    let position = travel.position_of(index.rem_euclid(outlook.contour.len() as isize) as usize);
    let at_end = joint_at_end == (side == Side::Left);
    let found = made_tangent(&travel, position, at_end, outlook.limits);
    let edits = found.into_iter().filter_map(|replacement| {
        let moved = replacement.moved;
        Some((
            moved,
            drawing_edit(outlook.drawing, &[(travel, replacement)])?,
        ))
    });
    edits.collect()
}

/// Merges two lines in a row.
fn one_line(
    outlook: &Outlook,
    before: &ContourSegment,
    behind: &ContourSegment,
) -> Option<(f64, DrawingEdit)> {
    let whole = Segment::line(before.geometry.start(), behind.geometry.end());
    let moved = whole.distance_to(before.geometry.end());
    let geometry = &outlook.drawing.get(before.entity)?.geometry;
    let changes = match geometry {
        Geometry::Polyline { closed, vertices } if before.entity == behind.entity => {
            // In the entity's own direction; one vertex lies between them, and more where something was too short to be seen.
            let (early, late) = match before.reversed {
                true => (behind.segment, before.segment),
                false => (before.segment, behind.segment),
            };
            let steps = (late + vertices.len() - early) % vertices.len();
            let least = if *closed { 3 } else { 2 };
            if vertices.len() < least + steps {
                return None;
            }
            let index = |step| (early + step) % vertices.len();
            let gone = (1..=steps).map(|step| Change::RemoveVertex {
                entity: before.entity,
                index: index(step),
            });
            gone.collect()
        }
        Geometry::Line { .. } if before.entity != behind.entity => {
            let Geometry::Line { .. } = outlook.drawing.get(behind.entity)?.geometry else {
                return None;
            };
            let longer =
                super::ends::end_moved(outlook.drawing, before, true, behind.geometry.end())?;
            vec![
                longer,
                Change::RemoveEntity {
                    entity: behind.entity,
                },
            ]
        }
        _ => return None,
    };
    Some((moved, DrawingEdit { changes }))
}
