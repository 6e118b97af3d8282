//! The start of the cut on a contour.

use super::corners::Element;
use super::job::{Job, ROUNDING};
use super::offset::{Wall, normal};
use super::path::{Refusal, Source};
use super::requested::Requested;
use crate::drawing::EntityId;
use crate::geometry::{Arc, Point, Segment};
use crate::settings::Lead;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use std::f64::consts::TAU;

/// The deepest point of an opening is found to less than this, mm: walls that differ by no more in their distance from it are as near as
/// each other.
const DEEPEST: f64 = 2e-3;

/// Pieces of a path that one core looks at at a time.
const AT_A_TIME: usize = 4096;

/// A place on the walls.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(crate) wall: usize,
    pub(crate) share: f64,
    pub(crate) point: Point,
}

/// The place on the walls nearest to `point`, and its distance. Among equally near ones, within `tie`, one that is no end of a wall,
/// then the one with the largest x, so that a thread hole in the centre of a circle leads to its +X-most point.
pub(super) fn nearest(walls: &[Wall], point: Point, tie: f64) -> Option<(Entry, f64)> {
    let mut best: Option<(Entry, f64)> = None;
    for (wall, segment) in walls.iter().map(|wall| &wall.geometry).enumerate() {
        let share = match segment {
            Segment::Arc(arc) if (point - arc.center).norm() <= tie => furthest_x(arc),
            segment => segment.share_of(point).clamp(0.0, 1.0),
        };
        let at = segment.point_at(share);
        let distance = (at - point).norm();
        let is_within = |share: f64| share > 0.0 && share < 1.0;
        let better = best.is_none_or(|(entry, least)| {
            let is_as_near = distance <= least + tie;
            match (is_within(share), is_within(entry.share)) {
                (true, false) => is_as_near,
                (false, true) => distance < least - tie,
                _ => distance < least - tie || is_as_near && at.x > entry.point.x + tie,
            }
        });
        if better {
            best = Some((
                Entry {
                    wall,
                    share,
                    point: at,
                },
                distance,
            ));
        }
    }
    best
}

/// Where a wall was drawn.
fn rank(wall: &Wall) -> (EntityId, usize) {
    match wall.source {
        Source::Segment { entity, segment } | Source::Corner { entity, segment } => {
            (entity, segment)
        }
        _ => (EntityId(u32::MAX), 0),
    }
}

/// The entry of a wall: its middle, or the +X-most point of an arc.
fn entry_of(walls: &[Wall], wall: usize) -> Entry {
    let segment = &walls[wall].geometry;
    let share = segment.as_arc().map_or(0.5, furthest_x);
    Entry {
        wall,
        share,
        point: segment.point_at(share),
    }
}

/// The entries after the default one, as likely: those of the other lines, then of the arcs, the longest first.
pub(super) fn other_entries(walls: &[Wall]) -> impl Iterator<Item = Entry> {
    let length = |wall: usize| walls[wall].geometry.length();
    let is_arc = |wall: usize| walls[wall].geometry.as_arc().is_some();
    let default = default_entry(walls).map(|entry| entry.wall);
    let mut all: Vec<usize> = (0..walls.len())
        .filter(|wall| Some(*wall) != default)
        .collect();
    all.sort_by(|&a, &b| {
        let by_length = || length(b).total_cmp(&length(a));
        let by_rank = || rank(&walls[a]).cmp(&rank(&walls[b]));
        is_arc(a)
            .cmp(&is_arc(b))
            .then_with(by_length)
            .then_with(by_rank)
    });
    all.into_iter().map(|wall| entry_of(walls, wall))
}

/// The middle of the longest line, else the +X-most point of the longest arc, or its middle. Of several equally long
/// ones the first drawn.
pub(super) fn default_entry(walls: &[Wall]) -> Option<Entry> {
    let longest = |arcs: bool| {
        let mut best: Option<(usize, f64)> = None;
        for (index, wall) in walls
            .iter()
            .enumerate()
            .filter(|(_, wall)| wall.geometry.as_arc().is_some() == arcs)
        {
            let length = wall.geometry.length();
            let better = best.is_none_or(|(best, least)| {
                let equal = (length - least).abs() <= 1e-9 * least;
                if equal {
                    rank(wall) < rank(&walls[best])
                } else {
                    length > least
                }
            });
            if better {
                best = Some((index, length));
            }
        }
        best.map(|(best, _)| best)
    };
    let wall = longest(false).or_else(|| longest(true))?;
    Some(entry_of(walls, wall))
}

/// The share at which an arc's circle has its largest x; 0.5 for an arc that does not reach there, since its ends may
/// be corners that the wire does not enter.
fn furthest_x(arc: &Arc) -> f64 {
    let share = arc.share_of(arc.center + crate::geometry::Vector::x() * arc.radius);
    if (0.0..=1.0).contains(&share) {
        share
    } else {
        0.5
    }
}

/// The element of a closed path and the point on it for an entry. Where the entry's own offset is cut off or left out,
/// the nearest remaining point, or the point that stands for it.
pub(super) fn path_point(
    path: &[Element],
    walls: &[Wall],
    entry: &Entry,
    correction: f64,
    side: f64,
) -> Option<(usize, Point)> {
    let wall = &walls.get(entry.wall)?.geometry;
    let wanted = entry.point + normal(wall, entry.share, side) * correction;
    let own = |element: &Element| {
        element.wall == entry.wall && !matches!(element.source, Source::Corner { .. })
    };
    let all = path.par_iter().enumerate().with_min_len(AT_A_TIME);
    let own = all.filter(|(_, element)| own(element));
    let own = own.map(|(index, element)| (element.geometry.distance_to(wanted), index));
    let own = own.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let Some((_, index)) = own else {
        // Elements stand in the order of their walls.
        let index = path
            .iter()
            .position(|element| element.wall > entry.wall)
            .unwrap_or(0);
        return Some((index, path.get(index)?.geometry.start()));
    };
    let element = &path[index].geometry;
    let point = match element.share_of(wanted) {
        _ if path.len() == 1 => wanted,
        share if share <= 0.0 => element.start(),
        share if share >= 1.0 => element.end(),
        _ => wanted,
    };
    Some((index, point))
}

/// The centre of walls that are one circle.
pub(super) fn circle_center(walls: &[Wall], tolerance: f64) -> Option<Point> {
    let first = *walls.first()?.geometry.as_arc()?;
    let same = |arc: &&Arc| {
        (arc.center - first.center).norm() <= tolerance
            && (arc.radius - first.radius).abs() <= tolerance
    };
    let arcs: Vec<&Arc> = walls
        .iter()
        .map_while(|wall| wall.geometry.as_arc())
        .filter(same)
        .collect();
    let sweep: f64 = arcs.iter().map(|arc| arc.sweep).sum();
    (arcs.len() == walls.len() && (sweep.abs() - TAU).abs() * first.radius <= tolerance)
        .then_some(first.center)
}

impl Job<'_> {
    /// The requested entry, the one beside the mark, the start of the entity that was picked first, or the point
    /// nearest to the thread hole; `None` where none of these is given.
    pub(super) fn entry(
        &self,
        index: usize,
        walls: &[Wall],
        wanted: &Requested,
    ) -> Result<Option<Entry>, Refusal> {
        let tie = self.units(ROUNDING);
        if let Some(point) = wanted.entry {
            return match nearest(walls, point, tie) {
                Some((entry, distance))
                    if distance <= self.tolerances().join.max(self.tolerances().chord_fit) =>
                {
                    Ok(Some(entry))
                }
                found => {
                    let distance_mm =
                        found.map_or(f64::INFINITY, |(_, distance)| distance * self.unit_mm);
                    let point = self.in_mm(point);
                    Err(Refusal::Sentence(say!(
                        the_entry_lies_from_contour,
                        point.x,
                        point.y,
                        distance_mm,
                        self.name(index)
                    )))
                }
            };
        }
        let near_within = |point: Option<Point>, tie: f64| {
            let (entry, _) = nearest(walls, point?, tie)?;
            Some(entry)
        };
        let near = |point: Option<Point>| near_within(point, tie);
        let picked = || {
            let first = self.picks.get(&index)?.first;
            let is_of = |wall: &Wall| matches!(wall.source, Source::Segment { entity, .. } if entity == first);
            let begins = |&at: &usize| {
                is_of(&walls[at]) && !is_of(&walls[(at + walls.len() - 1) % walls.len()])
            };
            let wall = (0..walls.len()).find(begins)?;
            Some(Entry {
                wall,
                share: 0.0,
                point: walls[wall].geometry.start(),
            })
        };
        let proposed = wanted
            .proposed
            .filter(|_| self.settings.lead != Lead::Straight);
        Ok(near(wanted.beside)
            .or_else(picked)
            .or_else(|| near(wanted.thread))
            .or_else(|| near_within(proposed, self.units(DEEPEST))))
    }
}
