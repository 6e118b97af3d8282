//! How deep an edge stands in the other part.

use crate::geometry::{Bounds, Point, Segment};
use crate::toolpath::Nearby;

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
/// where nothing of it is deeper than the rounding. `asked` grows by everything on which this
/// depends.
///
/// The depth changes by no more than the distance along the segment. And it is never more than the distance from any one piece of the wire's
/// way allows: no place of a straight stretch is farther from a straight piece than one of its ends.
pub(super) fn deepest(
    segment: &Segment,
    way: &mut Nearby,
    [half, rounding]: [f64; 2],
    asked: &mut Bounds,
) -> Option<(f64, Point)> {
    let length = segment.length();
    let walls = way.walls();
    let mut worst: Option<(f64, Point)> = None;
    let mut look = |share: f64, near: Option<usize>| {
        let at = segment.point_at(share);
        let reach = near.map_or(half, |near| walls.segment(near).distance_to(at));
        let (away, nearest) = way.nearest_to(at, reach)?;
        asked.merge(&Bounds::of_disc(at, away));
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
