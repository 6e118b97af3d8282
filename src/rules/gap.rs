//! `gap`: the ends of two entities that follow each other do not meet, but come within the join tolerance.
//!
//! They are one contour, and the path is laid as if they met; the control sees a step in the coordinates. Fix: the one end
//! moves onto the other.

use super::ends::joined;
use super::{Fact, LocalRule, Outlook};
use crate::drawing::DrawingEdit;
use crate::finding::{Detail, Fix, FixKind, Place, Rule};
use std::ops::Range;

pub const RULE: LocalRule = LocalRule {
    rule: Rule::Gap,
    look,
    reach: |_, _| (0, 1),
    holds: |_, _| true,
    related,
    detail,
    fixes,
    one_hint_when_side_unknown: false,
};

/// Only where a piece begins can there be a gap.
fn look(outlook: &Outlook, range: Range<usize>, facts: &mut Vec<Fact>) {
    let pieces = &outlook.contour.pieces;
    let first = pieces.partition_point(|piece| piece.first() < range.start);
    for piece in pieces[first..]
        .iter()
        .take_while(|piece| piece.first() < range.end)
    {
        if distance(outlook, piece.first())
            .is_some_and(|distance| distance > outlook.limits.tolerances.report)
        {
            facts.push(Fact {
                index: piece.first() as u32,
                side: None,
                needs_side: false,
            });
        }
    }
}

fn distance(outlook: &Outlook, index: usize) -> Option<f64> {
    let (before, behind) = (
        outlook.segment(index as isize - 1)?,
        outlook.segment(index as isize)?,
    );
    Some((behind.geometry.start() - before.geometry.end()).norm())
}

/// The segment before the gap.
fn related(outlook: &Outlook, fact: Fact) -> Vec<Place> {
    let before = outlook.segment(fact.index as isize - 1);
    before
        .map(|before| Place::Segment {
            entity: before.entity,
            segment: before.segment,
        })
        .into_iter()
        .collect()
}

fn detail(outlook: &Outlook, fact: Fact, _count: Option<usize>) -> Option<Detail> {
    Some(Detail::Gap {
        distance: distance(outlook, fact.index as usize)?,
    })
}

fn fixes(outlook: &Outlook, fact: Fact) -> Vec<Fix> {
    let index = fact.index as isize;
    let (Some(before), Some(behind)) = (outlook.segment(index - 1), outlook.segment(index)) else {
        return Vec::new();
    };
    let distance = (behind.geometry.start() - before.geometry.end()).norm();
    let change = joined(outlook.drawing, &before, &behind)
        .filter(|_| distance > outlook.limits.tolerances.report);
    let fix = |change| {
        let edit = DrawingEdit {
            changes: vec![change],
        };
        Fix {
            kind: FixKind::Snap { distance },
            preferred: true,
            in_fix_all: true,
            edit,
        }
    };
    change.map(fix).into_iter().collect()
}
