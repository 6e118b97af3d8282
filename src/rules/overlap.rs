//! `overlap`: two segments on one line or one circle that coincide over more than 0.005 mm.
//!
//! The wire would go along the same wall twice, and how the contour goes on is ambiguous. Two
//! entities that duplicate each other as a whole are `duplicate-entity`. Fix: an entity that lies
//! wholly within another one goes.

use super::wall::{Joints, Wall};
use super::{PairObservation, PairRule};
use crate::drawing::Change;
use crate::finding::{Detail, Fix, FixKind, Rule};
use crate::geometry::shared_length;

pub(crate) const RULE: PairRule = PairRule {
    rule: Rule::Overlap,
    reach: |limits| limits.tolerances.same_place,
    check,
    detail: |one, other, _| {
        Some(Detail::Overlap {
            length: shared(one, other),
        })
    },
    fixes,
    silent_for_doubles: true,
    ..PairRule::PLAIN
};

fn check(one: &Wall, other: &Wall, same_contour: bool) -> Vec<PairObservation> {
    let tolerances = &one.outlook.limits.tolerances;
    let length = shared(one, other);
    if length <= tolerances.same_place.max(tolerances.resolution) {
        return Vec::new();
    }
    // Ends that are joined within the tolerance may reach past each other.
    let joints = Joints::of(one, other, same_contour, tolerances.touch);
    let joined = joints.neighbours && length <= tolerances.certain.max(joints.gap);
    if joined {
        Vec::new()
    } else {
        vec![PairObservation::default()]
    }
}

fn shared(one: &Wall, other: &Wall) -> f64 {
    shared_length(
        one.geometry(),
        other.geometry(),
        one.outlook.limits.tolerances.same_place,
    )
}

fn fixes(one: &Wall, other: &Wall) -> Vec<Fix> {
    let is_of_one = std::ptr::eq(one.outlook.contour, other.outlook.contour);
    if !is_of_one && one.is_edge() && other.is_edge() {
        return Vec::new();
    }
    let tolerance = one.outlook.limits.tolerances.same_place;
    let lies_within = |inner: &Wall, outer: &Wall| {
        let entity = inner.segment.entity;
        let alone = inner
            .outlook
            .drawing
            .get(entity)
            .is_some_and(|entity| entity.geometry.segment_count() == 1);
        alone
            && entity != outer.segment.entity
            && shared(inner, outer) >= inner.geometry().length() - tolerance
    };
    let inner = [(other, one), (one, other)]
        .into_iter()
        .find(|(inner, outer)| lies_within(inner, outer));
    let delete = |(inner, _): (&Wall, &Wall)| {
        let entity = inner.segment.entity;
        Fix::new(FixKind::DeleteDouble, vec![Change::RemoveEntity { entity }])
    };
    inner.map(delete).into_iter().collect()
}
