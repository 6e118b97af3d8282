//! `duplicate-entity`: two entities in the same place, within 0.005 mm, whichever way they run.
//!
//! The wire would cut the same way twice, or the chaining would branch there. Fix: delete the later one.

use super::short_segment::is_point;
use super::wall::Wall;
use super::{PairRule, Sight};
use crate::drawing::{Change, DrawingEdit, Geometry};
use crate::finding::{Detail, Fix, FixKind, Rule};
use crate::geometry::Segment;

pub const RULE: PairRule = PairRule {
    rule: Rule::DuplicateEntity,
    reach: |limits| limits.tolerances.same_place,
    look,
    detail: |_, _, _| Some(Detail::DuplicateEntity),
    fixes,
    one_per_place: false,
    silent_for_doubles: false,
    warning_when_side_unknown: false,
};

/// Seen at the first segment of each of the two entities, once for a pair of entities.
fn look(one: &Wall, other: &Wall, _same_contour: bool) -> Option<Sight> {
    let (a, b) = (one.segment, other.segment);
    if a.entity == b.entity || a.segment != 0 {
        return None;
    }
    // A point is cut no times.
    if [a, b].into_iter().all(|point| is_point(&one.outlook, &point)) {
        return None;
    }
    let (first, second) = (&one.outlook.drawing.get(a.entity)?.geometry, &other.outlook.drawing.get(b.entity)?.geometry);
    let (count, tolerance) = (first.segment_count(), one.outlook.limits.tolerances.same_place);
    if count != second.segment_count() {
        return None;
    }
    let forward = b.segment == 0 && (0..count).all(|k| same(first, k, second, k, false, tolerance));
    let backward = b.segment + 1 == count && (0..count).all(|k| same(first, k, second, count - 1 - k, true, tolerance));
    (forward || backward).then(Sight::default)
}

fn same(one: &Geometry, k: usize, other: &Geometry, l: usize, turned: bool, tolerance: f64) -> bool {
    let (Some(a), Some(b)) = (one.segment(k), other.segment(l)) else { return false };
    let b = if turned { b.reversed() } else { b };
    let close = |s: f64| (a.point_at(s) - b.point_at(s)).norm() <= tolerance;
    let kinds = matches!((a, b), (Segment::Line(_), Segment::Line(_)) | (Segment::Arc(_), Segment::Arc(_)));
    kinds && [0.0, 0.25, 0.5, 0.75, 1.0].into_iter().all(close)
}

fn fixes(one: &Wall, other: &Wall) -> Vec<Fix> {
    let (a, b) = (one.segment, other.segment);
    let rank = |id| one.outlook.drawing.rank(id);
    let entity = if rank(a.entity) > rank(b.entity) { a.entity } else { b.entity };
    let edit = DrawingEdit { changes: vec![Change::RemoveEntity { entity }] };
    vec![Fix { kind: FixKind::DeleteDouble, preferred: true, in_fix_all: true, edit }]
}
