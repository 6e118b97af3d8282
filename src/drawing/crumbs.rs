//! What is shorter than the resolution: nobody can measure it and no control can follow it, so it is no part of any contour.
//!
//! A segment is left out where it, and all that was left out just before it, lies within the resolution of where the last one that
//! stays ends: however many short ones follow each other, the contour never moves by more.

use super::{Geometry, Vertex};
use crate::geometry::{Point, positive_angle};
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// A segment of an entity that is no part of the contour through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LeftOut {
    /// The place of its piece in the contour.
    piece: u32,
    /// Its number in the entity.
    segment: u32,
    /// The number of those before it in the entity that stay.
    stay_before: u32,
}

impl LeftOut {
    pub(super) fn piece(&self) -> usize {
        self.piece as usize
    }

    /// By piece, and in the direction of the entity.
    pub(super) fn place(&self) -> (u32, u32) {
        (self.piece, self.segment)
    }

    /// The same in a contour that runs the other way, the last piece of which is `last`.
    pub(super) fn turned(self, last: usize) -> LeftOut {
        LeftOut {
            piece: last as u32 - self.piece,
            ..self
        }
    }

    /// The number in the entity of the `nth` segment that stays.
    pub(super) fn segment(all: &[LeftOut], nth: usize) -> usize {
        nth + all.partition_point(|it| it.stay_before as usize <= nth)
    }

    /// The other way round; `None` for one that does not stay.
    pub(super) fn nth(all: &[LeftOut], segment: usize) -> Option<usize> {
        let before = all.partition_point(|it| (it.segment as usize) < segment);
        let stays = all
            .get(before)
            .is_none_or(|it| it.segment as usize != segment);
        stays.then(|| segment - before)
    }
}

/// Adds the segments of an entity that are no part of a contour in which it is the piece at `place`.
pub(super) fn left_out(geometry: &Geometry, least: f64, place: usize, all: &mut Vec<LeftOut>) {
    let mut add = |segment: usize, stay_before: usize| {
        all.push(LeftOut {
            piece: place as u32,
            segment: segment as u32,
            stay_before: stay_before as u32,
        });
    };
    let Geometry::Polyline { vertices, .. } = geometry else {
        if is_crumb(geometry, least) {
            add(0, 0);
        }
        return;
    };
    let Some(mut last) = vertices.first().map(|first| first.point) else {
        return;
    };
    let mut stay = 0;
    for (segment, ends) in segments(geometry, vertices) {
        if is_short(ends, least) && is_near(last, ends.1.point, least) {
            add(segment, stay);
        } else {
            last = ends.1.point;
            stay += 1;
        }
    }
}

/// True where nothing of an entity is part of a contour.
pub(super) fn is_crumb(geometry: &Geometry, least: f64) -> bool {
    match geometry {
        Geometry::Polyline { vertices, .. } => vertices.first().is_some_and(|first| {
            segments(geometry, vertices)
                .all(|(_, ends)| is_short(ends, least) && is_near(first.point, ends.1.point, least))
        }),
        Geometry::Line { start, end } => is_near(*start, *end, least),
        Geometry::Arc {
            radius,
            start_angle,
            end_angle,
            ..
        } => {
            let half = match positive_angle(end_angle - start_angle) / 2.0 {
                0.0 => TAU / 2.0,
                half => half,
            };
            let width = if half < PI / 2.0 { half.sin() } else { 1.0 };
            2.0 * radius * width < least && radius * (1.0 - half.cos()) < least
        }
        Geometry::Circle { radius, .. } => 2.0 * radius < least,
        Geometry::Text { .. } => false,
    }
}

/// Whether some of the segments of an entity in `ranges` are short enough to be left out.
pub(super) fn has_short(geometry: &Geometry, ranges: &[Range<usize>], least: f64) -> bool {
    let Geometry::Polyline { vertices, .. } = geometry else {
        return is_crumb(geometry, least);
    };
    let is_asked = |segment: usize| ranges.iter().any(|range| range.contains(&segment));
    segments(geometry, vertices).any(|(segment, ends)| is_asked(segment) && is_short(ends, least))
}

/// The segments of a polyline by number, each with the vertices at its ends.
fn segments<'a>(
    geometry: &Geometry,
    vertices: &'a [Vertex],
) -> impl Iterator<Item = (usize, (&'a Vertex, &'a Vertex))> {
    let behind = vertices.iter().cycle().skip(1);
    let pairs = vertices.iter().zip(behind);
    pairs.take(geometry.segment_count()).enumerate()
}

fn is_short((from, to): (&Vertex, &Vertex), least: f64) -> bool {
    // What an arc rises above its chord is half the chord times the bulge.
    is_near(from.point, to.point, least)
        && from.bulge.abs() * (to.point - from.point).norm() / 2.0 < least
}

fn is_near(one: Point, other: Point, least: f64) -> bool {
    let apart = other - one;
    apart.x.abs() < least && apart.y.abs() < least && apart.norm() < least
}
