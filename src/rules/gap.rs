//! `gap`: the ends of two entities that follow each other do not meet, but come within the join tolerance.
//!
//! They are one contour, and the path is laid as if they met; the control sees a step in the coordinates. Fix: one end
//! moves onto the other, or both lead on to where they meet.

use super::ends::joined;
use super::{LocalRule, Observation, Outlook};
use crate::finding::{Detail, Fix, FixKind, Place, Rule};
use std::ops::Range;

pub(crate) const RULE: LocalRule = LocalRule {
    rule: Rule::Gap,
    check,
    reach: |_, _| (0, 1),
    related,
    detail,
    fixes,
    ..LocalRule::PLAIN
};

/// A gap can only occur where an entity begins.
fn check(outlook: &Outlook, range: Range<usize>, observations: &mut Vec<Observation>) {
    let pieces = &outlook.contour.pieces;
    let first = pieces.partition_point(|piece| piece.first() < range.start);
    for piece in pieces[first..]
        .iter()
        .take_while(|piece| piece.first() < range.end)
    {
        if distance(outlook, piece.first()).is_some_and(|distance| distance > least(outlook)) {
            observations.push(Observation::at(piece.first()));
        }
    }
}

/// Ends up to this distance apart count as meeting: the distance rounds to no more than the
/// resolution.
fn least(outlook: &Outlook) -> f64 {
    let tolerances = &outlook.limits.tolerances;
    tolerances.report.max(1.5 * tolerances.resolution)
}

fn distance(outlook: &Outlook, index: usize) -> Option<f64> {
    let (before, behind) = (
        outlook.segment(index as isize - 1)?,
        outlook.segment(index as isize)?,
    );
    Some((behind.geometry.start() - before.geometry.end()).norm())
}

/// The segment before the gap.
fn related(outlook: &Outlook, observation: Observation) -> Vec<Place> {
    let before = outlook.segment(observation.index as isize - 1);
    before.iter().map(Place::from).collect()
}

fn detail(outlook: &Outlook, observation: Observation, _count: Option<usize>) -> Option<Detail> {
    Some(Detail::Gap {
        distance: distance(outlook, observation.index as usize)?,
    })
}

fn fixes(outlook: &Outlook, observation: Observation) -> Vec<Fix> {
    let index = observation.index as isize;
    let (Some(before), Some(behind)) = (outlook.segment(index - 1), outlook.segment(index)) else {
        return Vec::new();
    };
    let distance = (behind.geometry.start() - before.geometry.end()).norm();
    let changes = joined(outlook.drawing, &before, &behind).filter(|_| distance > least(outlook));
    let fix = |changes| Fix::new(FixKind::Snap { distance }, changes);
    changes.map(fix).into_iter().collect()
}
