//! The contours of a drawing in µm, and which of their segments are near a place, or like a block.

use super::budget::Budget;
use super::contour::Contour;
use crate::geometry::{Arc, Bounds, Grid, Point, Segment, Vector, cross, left_normal};
use crate::program::write::scaled;
use rustc_hash::FxHashMap;
use std::f64::consts::PI;
use std::ops::Range;

/// No wire runs farther beside its contour, µm.
pub(super) const FARTHEST: f64 = 2_000.0;
/// The distances within which a segment is looked for, one after the other, µm.
const REACHES: [f64; 4] = [30.0, 120.0, 480.0, FARTHEST];
/// The widest part of an arc that has one box, radians: the box of a circle holds all circles within it.
const WIDEST: f64 = 0.3;
/// Distances from two segments that meet are alike within this, µm.
const SAME: f64 = 1e-3;

/// Lines run alike within this, radians; and so many directions are told apart, each twice as wide.
const TURNED: f64 = 5e-3;
const DIRECTIONS: i32 = (PI / (2.0 * TURNED)) as i32;

/// All segments with their index.
#[derive(Debug)]
pub(super) struct Walls {
    contours: Vec<Vec<Segment>>,
    index: Grid<(u32, u32)>,
    /// Lines of each direction by their lengths, and arcs by their radii.
    lines: FxHashMap<i32, Vec<(f64, Segment)>>,
    arcs: Vec<(f64, Arc)>,
}

/// The segment that is nearest to a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    pub(super) contour: usize,
    /// The direction of the contour there.
    pub(super) way: Vector,
    /// µm, positive to the left of it.
    pub(super) left: f64,
    pub(super) distance: f64,
}

impl Walls {
    pub(super) fn of(contours: &[Contour], scale: f64) -> Walls {
        let of = |contour: &Contour| -> Vec<Segment> {
            let all = contour.segments.iter();
            all.map(|own| scaled(&own.geometry, scale)).collect()
        };
        let mut walls = Walls {
            contours: contours.iter().map(of).collect(),
            index: Grid::default(),
            lines: FxHashMap::default(),
            arcs: Vec::new(),
        };
        for (contour, segments) in walls.contours.iter().enumerate() {
            for (number, segment) in segments.iter().enumerate() {
                let sweep = segment.as_arc().map_or(0.0, |arc| arc.sweep.abs());
                let parts = (sweep / WIDEST).ceil().max(1.0);
                for part in 0..parts as u32 {
                    let share = |part: u32| f64::from(part) / parts;
                    let bounds = segment.part(share(part), share(part + 1)).bounds();
                    walls.index.insert((contour as u32, number as u32), bounds);
                }
                match segment {
                    Segment::Arc(arc) => walls.arcs.push((arc.radius, *arc)),
                    Segment::Line { .. } => {
                        let alike = walls.lines.entry(direction(segment)).or_default();
                        alike.push((segment.length(), *segment));
                    }
                }
            }
        }
        let lines = walls.lines.values_mut();
        lines.for_each(|alike| alike.sort_by(|one, other| one.0.total_cmp(&other.0)));
        walls.arcs.sort_by(|one, other| one.0.total_cmp(&other.0));
        walls
    }

    /// Lines that run as another one does, or against it, within [`TURNED`], and are as long within `longer`.
    pub(super) fn like(&self, own: &Segment, longer: f64) -> impl Iterator<Item = &Segment> {
        let (middle, length) = (direction(own), own.length());
        let about = (middle - 1..=middle + 1).map(|bucket| bucket.rem_euclid(DIRECTIONS));
        let alike = about.filter_map(|bucket| self.lines.get(&bucket));
        let all = alike.flat_map(move |alike| within(alike, length - longer..length + longer));
        let way = own.start_tangent();
        all.map(|(_, other)| other)
            .filter(move |other| cross(way, other.start_tangent()).abs() <= TURNED)
    }

    pub(super) fn of_radius(&self, radii: Range<f64>) -> impl Iterator<Item = &Arc> {
        within(&self.arcs, radii).iter().map(|(_, arc)| arc)
    }

    pub(super) fn length(&self, contour: usize) -> f64 {
        let segments = self.contours.get(contour).into_iter().flatten();
        segments.map(Segment::length).sum()
    }

    /// The nearest segment of all, or of one contour, within [`FARTHEST`].
    pub(super) fn near(&self, place: Point, only: Option<usize>, budget: &Budget) -> Option<Near> {
        let mut reaches = REACHES.into_iter();
        reaches.find_map(|reach| self.within(place, reach, only, budget))
    }

    fn within(
        &self,
        place: Point,
        reach: f64,
        only: Option<usize>,
        budget: &Budget,
    ) -> Option<Near> {
        let mut best: Option<Near> = None;
        self.index
            .near(&Bounds::of_disc(place, reach), |(contour, segment), _| {
                let (contour, segment) = (contour as usize, segment as usize);
                if only.is_some_and(|only| only != contour) || !budget.take(1) {
                    return;
                }
                let own = self.contours.get(contour).and_then(|all| all.get(segment));
                let Some(own) = own else { return };
                let distance = own.distance_to(place);
                let share = own.share_of(place).clamp(0.0, 1.0);
                let way = own.tangent_at(share);
                let left = left_normal(way).dot(&(place - own.point_at(share)));
                // At a corner the side is told by the segment that it is farther beside.
                let is_nearer = best.is_none_or(|best| {
                    distance < best.distance - SAME
                        || distance < best.distance + SAME && left.abs() > best.left.abs()
                });
                if distance <= reach && is_nearer {
                    best = Some(Near {
                        contour,
                        way,
                        left,
                        distance,
                    });
                }
            });
        best.map(|near| Near {
            left: near.distance.copysign(near.left),
            ..near
        })
    }
}

/// Which of the [`DIRECTIONS`] a line has, whichever way it runs.
fn direction(line: &Segment) -> i32 {
    let way = line.start_tangent();
    let angle = way.y.atan2(way.x).rem_euclid(PI);
    ((angle / PI * f64::from(DIRECTIONS)) as i32).min(DIRECTIONS - 1)
}

/// Those of a sorted list whose key is in a range.
fn within<T>(all: &[(f64, T)], range: Range<f64>) -> &[(f64, T)] {
    let from = all.partition_point(|(key, _)| *key < range.start);
    let to = all.partition_point(|(key, _)| *key < range.end);
    all.get(from..to.max(from)).unwrap_or_default()
}
