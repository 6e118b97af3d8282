//! `duplicate-entity`: two entities in the same place, within 0.005 mm, in either direction.
//!
//! The wire would cut the same path twice, or the chaining would branch there. Fix: delete the later one.

use super::wall::Wall;
use super::{PairObservation, PairRule};
use crate::drawing::{Change, Geometry, run_together};
use crate::finding::{Detail, Fix, FixKind, Rule};
use crate::geometry::{Point, Segment};

pub(crate) const RULE: PairRule = PairRule {
    rule: Rule::DuplicateEntity,
    reach: |limits| limits.tolerances.same_place,
    check: |one, other, same_contour| {
        // An edge that two outlines share is no double: one of them would be open without it.
        let is_shared = !same_contour && one.is_edge() && other.is_edge();
        if !is_shared && are_doubles(one, other).unwrap_or(false) {
            vec![PairObservation::default()]
        } else {
            Vec::new()
        }
    },
    detail: |_, _, _| Some(Detail::DuplicateEntity { count: 1 }),
    fixes,
    ..PairRule::PLAIN
};

/// Found at the first segments of the two entities, once for each pair. Closed entities may begin anywhere and have
/// their vertices elsewhere: they are found at the first segment of the earlier one and the segment of the later one on
/// which it begins.
fn are_doubles(one: &Wall, other: &Wall) -> Option<bool> {
    let (a, b) = (one.segment, other.segment);
    if a.entity == b.entity || !one.is_at_start() {
        return None;
    }
    let (first, second) = (
        &one.outlook.drawing.get(a.entity)?.geometry,
        &other.outlook.drawing.get(b.entity)?.geometry,
    );
    let tolerance = one.outlook.limits.tolerances.same_place;
    let flat = one.outlook.drawing.flat();
    // In the entities' own directions; most pairs have no end in common.
    let [(start, _), (their_start, their_end)] = [a, b].map(|segment| {
        let ends = (segment.geometry.start(), segment.geometry.end());
        if segment.reversed {
            (ends.1, ends.0)
        } else {
            ends
        }
    });
    let begins_at = |point: Point| (point - start).norm() <= tolerance;
    let forward = || {
        other.is_at_start()
            && begins_at(their_start)
            && run_together(first, second, false, tolerance, flat)
    };
    let backward = || {
        other.is_at_end()
            && begins_at(their_end)
            && run_together(first, second, true, tolerance, flat)
    };
    let rings = || {
        first.is_closed()
            && second.is_closed()
            && are_one_ring(first, second, b.segment, tolerance, flat)
    };
    Some(forward() || backward() || rings())
}

/// True when the first of two closed outlines begins on segment `at` of the other, and each lies on the other
/// everywhere.
fn are_one_ring(first: &Geometry, second: &Geometry, at: usize, tolerance: f64, flat: f64) -> bool {
    let (Some(begin), Some(under)) = (first.segment_of(0, flat), second.segment_of(at, flat))
    else {
        return false;
    };
    let start = begin.start();
    let share = under.share_of(start).clamp(0.0, 1.0);
    let is_on = |segment: &Segment, point: Point| segment.distance_to(point) <= tolerance;
    // A point where two segments meet belongs to the segment that begins there.
    let is_alone = second.segment_count() == 1;
    if !is_on(&under, start)
        || (!is_alone && (under.end() - start).norm() <= tolerance && share > 0.5)
    {
        return false;
    }
    // A little further on, the one must still lie on the other beside its start: this rejects most
    // outlines that only meet in a point.
    let Some(before) = second.segment_of(
        (at + second.segment_count() - 1) % second.segment_count().max(1),
        flat,
    ) else {
        return false;
    };
    let step = [&begin, &under, &before]
        .into_iter()
        .map(Segment::length)
        .fold(f64::INFINITY, f64::min)
        / 2.0;
    let further = begin.point_at((step / begin.length()).min(1.0));
    if !is_on(&under, further) && !is_on(&before, further) {
        return false;
    }
    let (one, other) = (Ring::of(first, flat), Ring::of(second, flat));
    let begins_at = other.distance_of(at, share);
    let stretch = other.length() / one.length();
    let lies_on = |ring: &Ring, point: Point, along: f64| {
        ring.at(along)
            .is_some_and(|met| (met - point).norm() <= tolerance)
    };
    [1.0, -1.0].into_iter().any(|direction| {
        one.samples()
            .all(|(point, along)| lies_on(&other, point, begins_at + direction * along * stretch))
            && other.samples().all(|(point, along)| {
                lies_on(&one, point, direction * (along - begins_at) / stretch)
            })
    })
}

/// A closed outline by the distance along it.
struct Ring {
    segments: Vec<Segment>,
    /// The distance at which each segment ends.
    ends: Vec<f64>,
}

impl Ring {
    fn of(geometry: &Geometry, flat: f64) -> Ring {
        let segments: Vec<Segment> = geometry.segments_of(flat).collect();
        let add = |sum: &mut f64, segment: &Segment| {
            *sum += segment.length();
            Some(*sum)
        };
        let ends = segments.iter().scan(0.0, add).collect();
        Ring { segments, ends }
    }

    fn length(&self) -> f64 {
        self.ends.last().copied().unwrap_or(0.0)
    }

    /// The distance along the outline at a share of one segment.
    fn distance_of(&self, index: usize, share: f64) -> f64 {
        let end = self.ends.get(index).copied().unwrap_or(0.0);
        end - self.segments.get(index).map_or(0.0, Segment::length) * (1.0 - share)
    }

    fn at(&self, along: f64) -> Option<Point> {
        let along = along.rem_euclid(self.length());
        let index = self
            .ends
            .partition_point(|&end| end < along)
            .min(self.segments.len().checked_sub(1)?);
        let segment = self.segments.get(index)?;
        let length = segment.length();
        let share = if length > 0.0 {
            1.0 - (self.ends.get(index)? - along) / length
        } else {
            0.0
        };
        Some(segment.point_at(share.clamp(0.0, 1.0)))
    }

    /// Each vertex, and three points between it and the next one, with their distance along.
    fn samples(&self) -> impl Iterator<Item = (Point, f64)> {
        self.segments
            .iter()
            .enumerate()
            .flat_map(|(index, segment)| {
                [0.0, 0.25, 0.5, 0.75]
                    .map(|share| (segment.point_at(share), self.distance_of(index, share)))
            })
    }
}

fn fixes(one: &Wall, other: &Wall) -> Vec<Fix> {
    let (a, b) = (one.segment, other.segment);
    let rank = |id| one.outlook.drawing.rank(id);
    let entity = if rank(a.entity) > rank(b.entity) {
        a.entity
    } else {
        b.entity
    };
    let changes = vec![Change::RemoveEntity { entity }];
    vec![Fix::new(FixKind::DeleteDouble, changes)]
}
