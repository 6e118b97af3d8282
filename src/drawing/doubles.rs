//! Open entities that lie in one place: which of them is chained, whatever their order in the drawing.

use super::{Drawing, EntityId, Geometry};
use crate::geometry::{Point, Segment};
use std::cmp::Ordering;

/// Two entities within this share of the distance at which ends certainly meet lie in the same place, see `Tolerances::same_place`.
pub(super) const SAME_PLACE: f64 = 0.5;

/// True when each segment of one entity lies within `tolerance` of its counterpart in the other; with `turned` the
/// other is travelled against its own direction. `flat`: a segment that rises less above its chord is a line.
pub(crate) fn run_together(
    one: &Geometry,
    other: &Geometry,
    turned: bool,
    tolerance: f64,
    flat: f64,
) -> bool {
    let count = one.segment_count();
    let same = |index: usize| {
        let beside = if turned { count - 1 - index } else { index };
        let (Some(a), Some(b)) = (one.segment_of(index, flat), other.segment_of(beside, flat))
        else {
            return false;
        };
        let b = if turned { b.reversed() } else { b };
        let close = |share: f64| (a.point_at(share) - b.point_at(share)).norm() <= tolerance;
        let kinds = matches!(
            (a, b),
            (Segment::Line(_), Segment::Line(_)) | (Segment::Arc(_), Segment::Arc(_))
        );
        kinds && [0.0, 0.25, 0.5, 0.75, 1.0].into_iter().all(close)
    };
    count == other.segment_count() && (0..count).all(same)
}

/// True where two entities with their ends in the same places are doubles.
pub(super) fn are_doubles(
    drawing: &Drawing,
    one: EntityId,
    other: EntityId,
    tolerance: f64,
) -> bool {
    let (Some(one), Some(other)) = (drawing.get(one), drawing.get(other)) else {
        return false;
    };
    [false, true].into_iter().any(|turned| {
        run_together(
            &one.geometry,
            &other.geometry,
            turned,
            tolerance,
            drawing.flat(),
        )
    })
}

/// Orders entities by their kind and place, not by when they were drawn: by their ends, by what
/// lies between, and finally by their handles.
pub(super) fn by_place(drawing: &Drawing, one: EntityId, other: EntityId) -> Ordering {
    if one == other {
        return Ordering::Equal;
    }
    let (Some(a), Some(b)) = (drawing.get(one), drawing.get(other)) else {
        return one.cmp(&other);
    };
    let flat = drawing.flat();
    let ends = |geometry: &Geometry| {
        let (start, end) = geometry
            .ends()
            .unwrap_or((Point::origin(), Point::origin()));
        match by_coordinates(&end, &start).is_lt() {
            true => ([end, start], true),
            false => ([start, end], false),
        }
    };
    // What lies between is worked out where the ends do not tell them apart.
    let ((of_a, turned_a), (of_b, turned_b)) = (ends(&a.geometry), ends(&b.geometry));
    let between = |geometry: &Geometry, low: Point, turned: bool| {
        let count = geometry.segment_count();
        let shares = if turned {
            [0.75, 0.5, 0.25]
        } else {
            [0.25, 0.5, 0.75]
        };
        shares.map(|share| {
            // The segment at a share of the whole, and the share within it.
            let along = share * count as f64;
            let index = (along as usize).min(count.saturating_sub(1));
            geometry
                .segment_of(index, flat)
                .map_or(low, |segment| segment.point_at(along - index as f64))
        })
    };
    let compare = |one: &[Point], other: &[Point]| {
        let mut orders = one.iter().zip(other).map(|(p, q)| by_coordinates(p, q));
        orders
            .find(|order| order.is_ne())
            .unwrap_or(Ordering::Equal)
    };
    let count = |geometry: &Geometry| geometry.segment_count();
    compare(&of_a, &of_b)
        .then_with(|| {
            compare(
                &between(&a.geometry, of_a[0], turned_a),
                &between(&b.geometry, of_b[0], turned_b),
            )
        })
        .then_with(|| count(&a.geometry).cmp(&count(&b.geometry)))
        .then_with(|| {
            a.handle
                .len()
                .cmp(&b.handle.len())
                .then_with(|| (*a.handle).cmp(&*b.handle))
        })
        .then(one.cmp(&other))
}

pub(super) fn by_coordinates(a: &Point, b: &Point) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
}
