//! What the proof of an earlier pass implies for a later one.
//!
//! About a place of the earlier path, a disc of the larger correction holds nothing of the contour. It contains the disc of the smaller
//! correction about the place on the same normal of the wall: there the later path is clear as well, and only what reaches beyond the earlier
//! path is left to prove.

use super::corners::Element;
use crate::geometry::{Arc, Point, Segment, Vector, left_normal};

/// The proved path of an earlier pass, beside the same walls on the same side, at a correction that is not smaller.
#[derive(Clone, Copy)]
pub(super) struct Before<'a> {
    pub(crate) path: &'a [Element],
    pub(crate) correction: f64,
}

/// How the later path runs beside one wall.
#[derive(Clone, Copy)]
pub(super) struct BesideWall<'a> {
    pub(crate) wall: &'a Segment,
    /// The direction in which the wall begins.
    pub(crate) along: Vector,
    pub(crate) side: f64,
    pub(crate) correction: f64,
    /// How far a path may be off by rounding.
    pub(crate) rounding: f64,
}

/// Which pieces of a path run beside the same wall as a piece of an earlier pass.
pub(super) struct Nest<'a> {
    before: Before<'a>,
    /// For each wall, the first piece of the earlier path beside it.
    first: Vec<u32>,
}

/// No piece of a path runs beside a wall.
const NOWHERE: u32 = u32::MAX;

impl<'a> Nest<'a> {
    /// `walls` is the number of walls.
    pub(crate) fn new(before: Before<'a>, walls: usize) -> Nest<'a> {
        let mut first = vec![NOWHERE; walls];
        for (piece, element) in before.path.iter().enumerate().rev() {
            first[element.wall] = piece as u32;
        }
        Nest { before, first }
    }

    /// The part of a piece that reaches beyond the piece of the earlier path beside the same wall. `None` where there is none, or it is not known.
    pub(crate) fn beyond(
        &self,
        beside: BesideWall,
        element: &Element,
    ) -> Option<[Option<Segment>; 2]> {
        let path = self.before.path;
        let first = *self.first.get(element.wall)? as usize;
        let of_wall = path.get(first..)?.iter();
        let mut of_wall = of_wall.take_while(|other| other.wall == element.wall);
        let earlier = of_wall.find(|other| other.is_roll() == element.is_roll())?;
        self.before.beyond(beside, element, earlier)
    }
}

impl Before<'_> {
    /// The same for two pieces beside one wall, the later one and the earlier one.
    pub(crate) fn beyond(
        &self,
        beside: BesideWall,
        element: &Element,
        earlier: &Element,
    ) -> Option<[Option<Segment>; 2]> {
        let correction = self.correction;
        let by = correction - beside.correction;
        let slack = 1e-3 * beside.rounding;
        if by < 0.0 {
            return None;
        }
        let mut parts = [None; 2];
        match (element.geometry, earlier.geometry) {
            (Segment::Line(inner), Segment::Line(outer)) => {
                let own = beside.wall;
                let along = beside.along;
                let out = left_normal(along) * beside.side;
                let place = |point: Point, correction: f64| {
                    let from = point - own.start();
                    let is_on = (from.dot(&out) - correction).abs() <= slack;
                    is_on.then(|| from.dot(&along))
                };
                let (begin, end) = (
                    place(inner.start, beside.correction)?,
                    place(inner.end, beside.correction)?,
                );
                let (first, last) = (
                    place(outer.start, correction)?,
                    place(outer.end, correction)?,
                );
                if !matches!(own, Segment::Line(_)) || begin >= last || first >= end {
                    return None;
                }
                if begin < first - slack {
                    let there = inner.start + along * (first - begin);
                    parts[0] = Some(Segment::line(inner.start, there));
                }
                if end > last + slack {
                    let there = inner.end - along * (end - last);
                    parts[1] = Some(Segment::line(there, inner.end));
                }
            }
            (Segment::Arc(inner), Segment::Arc(outer)) => {
                let is_on = |arc: &Arc, point: Point| {
                    let squared = (point - arc.center).norm_squared();
                    (squared - arc.radius * arc.radius).abs() <= slack * arc.radius
                };
                let is_exact = |arc: &Arc| {
                    !arc.is_shallow()
                        && !arc.is_full_turn()
                        && arc.radius > beside.rounding
                        && is_on(arc, arc.start)
                        && is_on(arc, arc.end)
                };
                let is_beside = inner.center == outer.center
                    && inner.sweep * outer.sweep > 0.0
                    && ((inner.radius - outer.radius).abs() - by).abs() <= slack;
                if !is_beside || !is_exact(&inner) || !is_exact(&outer) {
                    return None;
                }
                let (sense, extent) = (inner.sweep.signum(), inner.sweep.abs());
                let ahead = (outer.start_angle - inner.start_angle) * sense;
                let behind = extent - ahead - outer.sweep.abs();
                if ahead >= extent || behind >= extent {
                    return None;
                }
                let least = slack / inner.radius;
                let share = inner.radius / outer.radius;
                let foot_of = |end: Point| inner.center + (end - inner.center) * share;
                if ahead > least {
                    parts[0] = Some(Segment::Arc(Arc {
                        sweep: sense * ahead,
                        end: foot_of(outer.start),
                        ..inner
                    }));
                }
                if behind > least {
                    parts[1] = Some(Segment::Arc(Arc {
                        start_angle: inner.start_angle + inner.sweep - sense * behind,
                        sweep: sense * behind,
                        start: foot_of(outer.end),
                        ..inner
                    }));
                }
            }
            _ => return None,
        }
        Some(parts)
    }
}

#[cfg(test)]
mod tests {
    use super::super::clearance::Walls;
    use super::super::corners::{Joining, Offsets, Raw};
    use super::super::offset::Wall;
    use super::super::path::Source;
    use super::super::rounds::rounds;
    use super::*;
    use crate::drawing::{ContourSegment, EntityId};
    use crate::geometry::Side;
    use crate::settings::Effective;
    use std::f64::consts::TAU;

    fn walls(vertices: &[[f64; 3]]) -> Vec<Wall> {
        let next = vertices.iter().cycle().skip(1);
        let wall = |(segment, (from, to)): (usize, (&[f64; 3], &[f64; 3]))| Wall {
            geometry: Segment::from_bulge(
                Point::new(from[0], from[1]),
                Point::new(to[0], to[1]),
                from[2],
            ),
            source: Source::Segment {
                entity: EntityId(0),
                segment,
            },
        };
        vertices.iter().zip(next).enumerate().map(wall).collect()
    }

    /// In the corners of an opening each side of the later path is longer by the difference of the corrections; at its round end
    /// nothing is longer.
    #[test]
    fn what_reaches_beyond_an_earlier_pass_is_told() {
        let walls = walls(&[
            [0.0, 0.0, 0.0],
            [10.0, 0.0, 1.0],
            [10.0, 4.0, 0.0],
            [0.0, 4.0, 0.0],
        ]);
        let own = Walls::of(&walls);
        let laid = |correction: f64| {
            let joining = Joining {
                correction,
                side: 1.0,
                touch: 1e-7,
                tolerance: 1e-6,
            };
            let raw = Raw::new(Offsets {
                walls: &walls,
                tangents: own.tangents(),
                joining: &joining,
            });
            super::super::ring::trimmed(&raw).unwrap().elements
        };
        let (outer, inner) = (laid(0.3), laid(0.1));
        let beside = |element: &Element| BesideWall {
            wall: &walls[element.wall].geometry,
            along: own.tangents()[element.wall][0],
            side: 1.0,
            correction: 0.1,
            rounding: 1e-6,
        };
        let beyond = |correction: f64| {
            let before = Before {
                path: &outer,
                correction,
            };
            let nest = Nest::new(before, walls.len());
            let parts = inner
                .iter()
                .map(|element| nest.beyond(beside(element), element));
            let lengths = |parts: [Option<Segment>; 2]| {
                parts.map(|part| part.map_or(0.0, |part| (part.length() * 1e6).round() / 1e6))
            };
            parts.map(|parts| parts.map(lengths)).collect::<Vec<_>>()
        };
        let expected = [[0.2, 0.0], [0.0, 0.0], [0.0, 0.2], [0.2, 0.2]];
        assert_eq!(beyond(0.3), expected.map(Some));
        // A path that does not lie at the correction that is given for it implies nothing.
        assert_eq!(beyond(0.4), [None; 4]);
    }

    #[test]
    fn passes_are_the_same_behind_others_and_alone() {
        let mut state = 5_u64;
        let mut number = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        let settings = Effective::default();
        let (mut paths, mut refused) = (0, 0);
        for _ in 0..100 {
            let count = 4 + (number() * 24.0) as usize;
            let radius = 0.3 + count as f64 * 0.06 * number();
            let vertex = |at: usize| {
                let (sin, cos) = (TAU * at as f64 / count as f64).sin_cos();
                let away = radius * (1.0 - 0.5 * number());
                let bulge = if number() < 0.4 {
                    0.0
                } else {
                    1.4 * number() - 0.7
                };
                [away * cos, away * sin, bulge]
            };
            let vertices: Vec<[f64; 3]> = (0..count).map(vertex).collect();
            let segments: Vec<ContourSegment> = walls(&vertices)
                .iter()
                .enumerate()
                .map(|(segment, wall)| ContourSegment {
                    entity: EntityId(0),
                    segment,
                    reversed: false,
                    geometry: wall.geometry,
                })
                .collect();
            for side in [Side::Left, Side::Right] {
                let laid = |all: &[f64]| rounds(&segments, (side, true), all, &settings, 1.0);
                let all = [0.1, 0.08, 0.03];
                let together = laid(&all);
                for (correction, path) in all.iter().zip(&together) {
                    assert_eq!(*path, laid(&[*correction])[0], "{correction} {vertices:?}");
                    paths += usize::from(path.is_some());
                    refused += usize::from(path.is_none());
                }
            }
        }
        assert!(paths > 300 && refused > 10, "{paths} {refused}");
    }
}
