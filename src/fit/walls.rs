//! Walls of a drawn punch and its drawn plate that lie too near to each other, or run into each other.

use super::about::{About, Limits, TIE};
use super::observations::Verdict;
use super::penetration::deepest;
use crate::geometry::{Bounds, Point, Segment};
use crate::toolpath::{Nearby, Part};

/// A tip is looked for within half a kerf and this many clearances about a wall: partners lie within five of each other.
const AROUND: f64 = 16.0;

/// A wall of a drawn punch that lies too near to one of the plate, or runs into it.
pub(super) fn wall(
    [punch, plate]: [&Part; 2],
    index: usize,
    about: &mut About,
    limits: &Limits,
) -> Option<Verdict> {
    let plain = |part: &Part, index: usize| part.edges[index].turned_about.is_none();
    if !plain(punch, index) {
        return None;
    }
    let geometry = &punch.edges[index].geometry;
    let mut nearest: (f64, Option<usize>) = (limits.clearance - limits.rounding, None);
    let area = geometry.bounds().grown(limits.clearance);
    about.asked.merge(&area);
    about.edges.find(&area, |other| {
        let most = nearest.0 + TIE * limits.rounding;
        if plain(plate, other)
            && let Some(apart) = plate.near.distance_below(geometry, other, most)
            && (apart < nearest.0
                || apart == nearest.0 && nearest.1.is_some_and(|known| other < known))
        {
            nearest = (apart, Some(other));
        }
        false
    });
    // What lies beyond the other's edge, or crosses it, is as deep as it is away from what the wire has cut.
    let mut is_deep = |at: Point| {
        let reach = plate.half + limits.rounding;
        about.asked.merge(&Bounds::of_disc(at, reach));
        about.beside = plate.path.nearer_from(about.beside, at, reach);
        about.beside.is_none()
    };
    let is_through = nearest.1.is_some() && nearest.0 <= limits.rounding;
    let stands_out = match is_through || is_deep(geometry.start()) {
        true => {
            let reach = [plate.half, limits.rounding];
            deepest(geometry, &mut about.way, reach, &mut about.asked)
        }
        false => None,
    };
    let tip = stands_out.and_then(|(depth, _)| tip([punch, plate], index, depth, about, limits));
    if let Some((depth, at, other)) = tip {
        return Some(Verdict {
            edge: index as u32,
            at,
            clearance: -depth,
            other: other as u32,
            at_other: at,
        });
    }
    let (clearance, at, other) = match (stands_out, nearest) {
        (Some((depth, at)), (_, other)) => (-depth, at, other),
        (None, (apart, Some(other))) => {
            let at = nearest_place(geometry, &plate.edges[other].geometry);
            (apart, at, Some(other))
        }
        (None, (_, None)) => return None,
    };
    let nearest_edge = || {
        let (away, edge) = about.edges.nearest_to(at, plate.half)?;
        about.asked.merge(&Bounds::of_disc(at, away));
        Some(edge)
    };
    Some(Verdict {
        edge: index as u32,
        at,
        clearance,
        other: other.or_else(nearest_edge)? as u32,
        at_other: at,
    })
}

/// A tip of the plate that stands deeper in the punch, beyond one of its walls, than that wall stands in the plate: how deep, where, and its
/// edge.
fn tip(
    [punch, plate]: [&Part; 2],
    index: usize,
    depth: f64,
    about: &mut About,
    limits: &Limits,
) -> Option<(f64, Point, usize)> {
    let wall = &punch.edges[index].geometry;
    let mut way = Nearby::of(&punch.path);
    let area = wall.bounds().grown(punch.half + AROUND * limits.clearance);
    about.asked.merge(&area);
    let (mut found, mut asked) = (None, Bounds::EMPTY);
    let mut most = depth + limits.rounding;
    about.edges.find(&area, |other| {
        let edge = &plate.edges[other];
        let reach = [punch.half, limits.rounding];
        if edge.turned_about.is_none()
            && let Some((deep, at)) = deepest(&edge.geometry, &mut way, reach, &mut asked)
            && deep > most
            && wall.distance_to(at) <= deep + limits.rounding
        {
            most = deep;
            found = Some((deep, at, other));
        }
        false
    });
    about.asked.merge(&asked);
    found
}

/// The point of a segment that is nearest to another one, of the ends of both.
fn nearest_place(segment: &Segment, other: &Segment) -> Point {
    let feet = [other.start(), other.end()]
        .map(|end| segment.point_at(segment.share_of(end).clamp(0.0, 1.0)));
    let ends = [segment.start(), segment.end()];
    let places = ends.into_iter().chain(feet);
    places
        .min_by(|a, b| other.distance_to(*a).total_cmp(&other.distance_to(*b)))
        .unwrap_or_else(|| segment.start())
}
