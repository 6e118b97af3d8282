//! `short-segment`: a segment shorter than 0.005 mm.
//!
//! Controllers compute corners and compensation between neighbours: over a segment of a few microns they jerk, stop, or turn
//! the offset the wrong way. Fix: the segment goes, its neighbours meet.

use super::{Fact, LocalRule, Outlook};
use crate::drawing::{Change, DrawingEdit, Geometry};
use crate::finding::{Detail, Fix, FixKind, Rule};
use std::ops::Range;

pub const RULE: LocalRule =
    LocalRule { rule: Rule::ShortSegment, look, reach: |_, _| (0, 0), detail, fixes, one_hint_when_side_unknown: false };

fn look(outlook: &Outlook, range: Range<usize>, facts: &mut Vec<Fact>) {
    for index in range {
        let short = outlook.segment(index as isize).is_some_and(|segment| segment.geometry.length() < outlook.limits.tolerances.short);
        if short {
            facts.push(Fact { index: index as u32, side: None });
        }
    }
}

fn detail(outlook: &Outlook, fact: Fact, _count: usize) -> Option<Detail> {
    Some(Detail::ShortSegment { length: outlook.segment(fact.index as isize)?.geometry.length() })
}

/// In a polyline the segment's start vertex goes and its own stays the end of what came before.
fn fixes(outlook: &Outlook, fact: Fact) -> Vec<Fix> {
    let Some(place) = outlook.segment(fact.index as isize) else { return Vec::new() };
    let entity = place.entity;
    let count = outlook.drawing.get(entity).map_or(0, |entity| entity.geometry.segment_count());
    let changes = match outlook.drawing.get(entity).map(|entity| &entity.geometry) {
        Some(Geometry::Polyline { closed, .. }) if count > if *closed { 3 } else { 1 } => {
            // The last segment of an open polyline gives up its end, so that the vertex it starts in stays.
            let index = if !closed && place.segment + 1 == count { place.segment + 1 } else { place.segment };
            vec![Change::RemoveVertex { entity, index }]
        }
        _ => return Vec::new(),
    };
    vec![Fix { kind: FixKind::Merge, preferred: true, in_fix_all: true, edit: DrawingEdit { changes } }]
}
