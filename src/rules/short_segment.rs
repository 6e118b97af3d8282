//! `short-segment`: a segment shorter than 0.005 mm.
//!
//! Controllers compute corners and compensation between neighbours: over a segment of a few microns they jerk, stop, or
//! turn the offset the wrong way. Fix: the segment goes and its neighbours meet. What is shorter than the resolution is
//! no part of a contour.

use super::ends::joined;
use super::{LocalRule, Observation, Outlook};
use crate::drawing::{Change, ContourSegment, Geometry, Vertex};
use crate::finding::{Detail, Fix, FixKind, Rule};

pub(crate) const RULE: LocalRule = LocalRule {
    rule: Rule::ShortSegment,
    check: |outlook, range, observations| {
        let tolerances = &outlook.limits.tolerances;
        let least = tolerances.resolution.max(tolerances.zero_length);
        let is_short = |index: &usize| {
            let segment = outlook.segment(*index as isize);
            segment.is_some_and(|it| (least..tolerances.short).contains(&it.geometry.length()))
        };
        observations.extend(range.filter(is_short).map(Observation::at));
    },
    detail,
    fixes,
    ..LocalRule::PLAIN
};

fn detail(outlook: &Outlook, observation: Observation, _count: Option<usize>) -> Option<Detail> {
    let length = outlook
        .segment(observation.index as isize)?
        .geometry
        .length();
    Some(Detail::ShortSegment { length })
}

fn fixes(outlook: &Outlook, observation: Observation) -> Vec<Fix> {
    let Some(place) = outlook.segment(observation.index as isize) else {
        return Vec::new();
    };
    let changes = match outlook
        .drawing
        .get(place.entity)
        .map(|entity| &entity.geometry)
    {
        Some(Geometry::Polyline { closed, vertices }) => in_polyline(&place, *closed, vertices),
        Some(Geometry::Line { .. } | Geometry::Arc { .. }) => {
            in_chain(outlook, observation.index as isize, &place)
        }
        _ => None,
    };
    let fix = |changes| Fix::new(FixKind::Merge, changes);
    changes.map(fix).into_iter().collect()
}

/// The segment's start vertex goes, and the segment before it then ends where this one did. The
/// ends of an open polyline stay.
fn in_polyline(place: &ContourSegment, closed: bool, vertices: &[Vertex]) -> Option<Vec<Change>> {
    let (entity, count) = (
        place.entity,
        if closed {
            vertices.len()
        } else {
            vertices.len().checked_sub(1)?
        },
    );
    if count <= if closed { 3 } else { 1 } {
        return None;
    }
    if !closed && place.segment == 0 {
        let vertex = Vertex {
            bulge: vertices.get(1)?.bulge,
            ..*vertices.first()?
        };
        return Some(vec![
            Change::SetVertex {
                entity,
                index: 0,
                vertex,
            },
            Change::RemoveVertex { entity, index: 1 },
        ]);
    }
    Some(vec![Change::RemoveVertex {
        entity,
        index: place.segment,
    }])
}

/// The entity goes and a neighbour's end moves to the other neighbour; a line's end rather than an arc's.
fn in_chain(outlook: &Outlook, index: isize, place: &ContourSegment) -> Option<Vec<Change>> {
    let (before, behind) = (outlook.segment(index - 1)?, outlook.segment(index + 1)?);
    if [before.entity, behind.entity].contains(&place.entity)
        || before.entity == behind.entity && outlook.contour.len() < 3
    {
        return None;
    }
    let mut changes = joined(outlook.drawing, &before, &behind)?;
    changes.push(Change::RemoveEntity {
        entity: place.entity,
    });
    Some(changes)
}
