//! Walls of a drawn punch and its drawn plate that lie too near to each other, or run into each other.

use super::Sharper;
use super::about::{About, FitLimits, TIE};
use super::observations::{Lies, Verdict};
use super::penetration::deepest;
use crate::geometry::{Point, Segment, facing, turn};
use crate::toolpath::{Nearby, Part};
use std::f64::consts::PI;

/// A tip is looked for within half a kerf and this many clearances about a wall: partners lie within five clearances of each other.
const AROUND: f64 = 16.0;

/// An outline that turns by less has no corner there, radians.
const LEAST_TURN: f64 = 0.01;

/// A wall longer than this many half kerfs is long: it is no part of a corner.
const LONG: f64 = 4.0;

/// A place this near to the end of a line lies in its corner, drawing units.
const IN_CORNER: f64 = 1e-4;

/// A wall of a drawn punch that lies too near to one of the plate, or runs into it.
pub(super) fn wall(
    [punch, plate]: [&Part; 2],
    index: usize,
    about: &mut About,
    limits: &FitLimits,
) -> Option<Verdict> {
    let plain = |part: &Part, index: usize| part.edges[index].turned_about.is_none();
    if !plain(punch, index) {
        return None;
    }
    let geometry = &punch.edges[index].geometry;
    let mut nearest: (f64, Option<usize>) = (limits.clearance - limits.rounding, None);
    let area = geometry.bounds().grown(limits.clearance);
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
    // What lies beyond the other's edge, or crosses it, is as deep as its distance from what the wire has cut.
    let mut is_deep = |at: Point| {
        let reach = plate.half + limits.rounding;
        about.beside = plate.path.nearer_from(about.beside, at, reach);
        about.beside.is_none()
    };
    let is_through = nearest.1.is_some() && nearest.0 <= limits.rounding;
    let stands_out = match is_through || is_deep(geometry.start()) {
        true => {
            let reach = [plate.half, limits.rounding];
            deepest(geometry, &mut about.way, reach)
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
            lies: Lies::OnTip,
        });
    }
    let (clearance, at, other) = match (stands_out, nearest) {
        (Some((depth, at)), _) => (-depth, at, None),
        (None, (apart, Some(other))) => {
            let (at, _) = nearest_places(geometry, &plate.edges[other].geometry);
            (apart, at, Some(other))
        }
        (None, (_, None)) => return None,
    };
    let lies = lies(geometry, (clearance, at), plate, about, limits);
    let nearest_edge = || {
        let (_, edge) = about.edges.nearest_to(at, plate.half)?;
        Some(edge)
    };
    Some(Verdict {
        edge: index as u32,
        at,
        clearance,
        other: other.or_else(nearest_edge)? as u32,
        at_other: at,
        lies,
    })
}

/// The corner that stands beyond an arc of the other part, if a place on a wall is one.
pub(super) fn sharper(verdict: &Verdict, [punch, plate]: [&Part; 2]) -> Option<Sharper> {
    let (edge, other) = (verdict.edge as usize, verdict.other as usize);
    let is_of_plate = verdict.lies == Lies::OnTip;
    let [(sharp, at_sharp), (round, at_round)] = match is_of_plate {
        true => [(plate, other), (punch, edge)],
        false => [(punch, edge), (plate, other)],
    };
    let round = &round.edges[at_round];
    let arc = round
        .geometry
        .as_arc()
        .filter(|_| round.turned_about.is_none())?;
    let is_beyond = (verdict.at - arc.center).norm() > arc.radius;
    let turn = turn_at(sharp, at_sharp, verdict.at)?;
    is_beyond.then_some(Sharper { is_of_plate, turn })
}

/// By how much an outline turns along an arc, or at the end of a line that lies at a place.
fn turn_at(part: &Part, index: usize, at: Point) -> Option<f64> {
    let geometry = &part.edges[index].geometry;
    if let Some(arc) = geometry.as_arc() {
        return Some(arc.sweep.abs()).filter(|turn| *turn < PI);
    }
    let count = part.edges.len();
    let [from_start, from_end] = [geometry.start(), geometry.end()].map(|end| (end - at).norm());
    let is_last = from_end < from_start;
    if from_end.min(from_start) > IN_CORNER {
        return None;
    }
    let [before, behind] = match is_last {
        true => [index, (index + 1) % count],
        false => [(index + count - 1) % count, index],
    };
    let [before, behind] = [before, behind].map(|edge| &part.edges[edge].geometry);
    let angle = turn(before.tangent_at(1.0), behind.tangent_at(0.0)).abs();
    (angle > LEAST_TURN).then_some(angle)
}

/// Whether a wall is deepest at one of its ends, or all along.
fn lies(
    wall: &Segment,
    (clearance, at): (f64, Point),
    plate: &Part,
    about: &mut About,
    limits: &FitLimits,
) -> Lies {
    let reach = plate.half + limits.clearance;
    let mut is_as_deep = |share: f64| {
        let place = wall.point_at(share);
        let away = about.way.nearest_to(place, reach).map(|(away, _)| away);
        away.is_some_and(|away| plate.half - away <= clearance + limits.rounding)
    };
    let is_even = is_as_deep(0.5) && is_as_deep(0.0) && is_as_deep(1.0);
    let ends = [wall.start(), wall.end()];
    match ends
        .iter()
        .position(|end| (end - at).norm() <= limits.rounding)
    {
        _ if is_even && wall.length() > LONG * plate.half => Lies::AllAlong,
        Some(is_last) if !is_even => Lies::AtEnd {
            is_last: is_last == 1,
        },
        _ => Lies::OnWall,
    }
}

/// A tip of the plate that stands deeper in the punch, beyond one of its walls, than that wall stands in the plate: how deep, where, and its
/// edge.
fn tip(
    [punch, plate]: [&Part; 2],
    index: usize,
    depth: f64,
    about: &mut About,
    limits: &FitLimits,
) -> Option<(f64, Point, usize)> {
    let wall = &punch.edges[index].geometry;
    let mut way = Nearby::of(&punch.path);
    let area = wall.bounds().grown(punch.half + AROUND * limits.clearance);
    let mut found = None;
    let mut most = depth + limits.rounding;
    about.edges.find(&area, |other| {
        let edge = &plate.edges[other];
        let reach = [punch.half, limits.rounding];
        if edge.turned_about.is_none()
            && let Some((deep, at)) = deepest(&edge.geometry, &mut way, reach)
            && deep > most
            && wall.distance_to(at) <= deep + limits.rounding
        {
            most = deep;
            found = Some((deep, at, other));
        }
        false
    });
    found
}

/// The places of two segments that are nearest to each other.
pub(super) fn nearest_places(segment: &Segment, other: &Segment) -> (Point, Point) {
    let foot = |on: &Segment, at: Point| on.point_at(on.share_of(at).clamp(0.0, 1.0));
    let ends = [segment.start(), segment.end()].map(|end| (end, foot(other, end)));
    let feet = [other.start(), other.end()].map(|end| (foot(segment, end), end));
    let places = ends.into_iter().chain(feet).chain(facing(segment, other));
    let away = |(one, other): &(Point, Point)| (one - other).norm();
    places
        .min_by(|one, two| away(one).total_cmp(&away(two)))
        .unwrap_or((segment.start(), other.start()))
}
