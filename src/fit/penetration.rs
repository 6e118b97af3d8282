//! How deep an edge, or a stretch of an outline, stands in the other part.

use super::about::FitLimits;
use crate::geometry::{Point, Segment, Vector, meetings};
use crate::toolpath::{Nearby, Part};

/// The most looks at one edge.
const MOST: usize = 2_000;

/// How much deeper than the deepest place found a place may be that is not looked for, drawing units.
const LEAST: f64 = 1e-5;

/// One place of the edge.
#[derive(Clone, Copy)]
struct Look {
    share: f64,
    at: Point,
    depth: f64,
    /// The piece of the way of the wire that is nearest.
    nearest: usize,
}

/// The deepest place of a segment beyond what the wire has cut, half a kerf about its way; `None`
/// where nothing of it is deeper than the rounding.
///
/// The depth changes by no more than the distance along the segment. And it is never more than the distance from any one piece of the wire's
/// way allows: no place of a straight stretch is farther from a straight piece than one of its ends.
pub(super) fn deepest(
    segment: &Segment,
    way: &mut Nearby,
    [half, rounding]: [f64; 2],
) -> Option<(f64, Point)> {
    let length = segment.length();
    let walls = way.walls();
    let mut worst: Option<(f64, Point)> = None;
    let mut look = |share: f64, near: Option<usize>| {
        let at = segment.point_at(share);
        let reach = near.map_or(half, |near| walls.segment(near).distance_to(at));
        let (away, nearest) = way.nearest_to(at, reach)?;
        let depth = away - half;
        if depth > rounding && worst.is_none_or(|(most, _)| depth > most) {
            worst = Some((depth, at));
        }
        let look = Look {
            share,
            at,
            depth,
            nearest,
        };
        Some((look, worst.map_or(0.0, |(most, _)| most)))
    };
    let (first, _) = look(0.0, None)?;
    let (last, _) = look(1.0, None)?;
    let mut waiting = vec![(first, last)];
    for _ in 0..MOST {
        let Some((from, to)) = waiting.pop() else {
            break;
        };
        let (middle, most) = look((from.share + to.share) / 2.0, Some(from.nearest))?;
        for (from, to) in [(from, middle), (middle, to)] {
            let along = (to.share - from.share) * length;
            let farthest = (from.depth + to.depth + along) / 2.0;
            let is_beside = |nearest: usize| {
                let piece = walls.segment(nearest);
                let is_within = |at: Point| piece.distance_to(at) - half <= most.max(rounding);
                piece.as_arc().is_none() && is_within(from.at) && is_within(to.at)
            };
            let is_seen =
                segment.as_arc().is_none() && (is_beside(from.nearest) || is_beside(to.nearest));
            if farthest > most + rounding.max(LEAST) && !is_seen {
                waiting.push((from, to));
            }
        }
    }
    worst
}

/// A place of an outline that stands in the other part.
#[derive(Clone, Copy)]
pub(super) struct Deep {
    pub(super) depth: f64,
    pub(super) at: Point,
    /// To it from the edge of what the other wire has cut.
    pub(super) way: Vector,
}

/// How deep an outline stands in another part, both ways from a share of an edge up to where it passes into that part or out of it again.
pub(super) fn depth(
    [own, other]: [&Part; 2],
    begins: (usize, f64),
    limits: &FitLimits,
) -> Option<Deep> {
    let mut way = Nearby::of(&other.path);
    let (half, count) = (other.half, own.edges.len());
    let mut found: Option<(f64, Point)> = None;
    for (step, goes_on) in [(1, true), (count - 1, false)] {
        let (mut edge, mut from) = begins;
        for _ in 0..count {
            let geometry = &own.edges[edge].geometry;
            let apart = limits.rounding / geometry.length();
            let mut passes = passes(geometry, other);
            let next = match goes_on {
                true => passes.find(|share| *share > from + apart),
                false => passes.rev().find(|share| *share < from - apart),
            };
            let to = next.unwrap_or(if goes_on { 1.0 } else { 0.0 });
            let stretch = geometry.part(from.min(to), from.max(to));
            let deep = deepest(&stretch, &mut way, [half, limits.rounding]);
            let is_deeper = |deep: &(f64, Point)| found.is_none_or(|(most, _)| deep.0 > most);
            found = deep.filter(is_deeper).or(found);
            if deep.is_none() || next.is_some() {
                break;
            }
            edge = (edge + step) % count;
            from = if goes_on { 0.0 } else { 1.0 };
        }
    }
    let (depth, at) = found?;
    let (_, piece) = way.nearest_to(at, half + depth)?;
    let piece = other.path.segment(piece);
    let foot = piece.point_at(piece.share_of(at).clamp(0.0, 1.0));
    let way = (at - foot).try_normalize(0.0).unwrap_or_default() * depth;
    Some(Deep { depth, at, way })
}

/// Where an edge passes the outline of another part, by shares of the edge, rising.
fn passes(edge: &Segment, other: &Part) -> impl DoubleEndedIterator<Item = f64> {
    let mut shares = Vec::new();
    other.near.find(&edge.bounds(), |on| {
        let met = meetings(edge, &other.edges[on].geometry);
        shares.extend(met.into_iter().map(|at| edge.share_of(at)));
        false
    });
    shares.sort_by(f64::total_cmp);
    shares.into_iter()
}
