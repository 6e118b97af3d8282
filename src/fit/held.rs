//! Two outlines, one held in the other.
//!
//! A place of the punch binds where it is farther from the way of the wire that cut the plate than half a kerf, and the other way round. Along
//! walls that both wires follow the clearance is what the kerfs leave. It is missing where a wire turned in a point and left its own
//! radius: there the farthest place of the other part that is nearest to that point says how much.

use super::{Pair, Spot, segments};
use crate::geometry::{Bounds, Few, Point, Segment, Vector, cross};
use crate::toolpath::Part;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use rayon::slice::ParallelSlice;
use std::sync::Arc;

/// What the clearance is held against. Drawing units.
pub(super) struct Limits {
    pub clearance: f64,
    pub rounding: f64,
    /// What is left beside walls that are followed on both sides; `None` where both parts are drawn, and each place is looked at.
    pub along_walls: Option<f64>,
    /// It is asked how much is left where nothing is missing, too.
    pub asks_least: bool,
}

/// A corner is looked round up to so many half kerfs from where the wire turned.
const FARTHEST: f64 = 16.0;

/// The most looks at one edge for how deep it stands in the other part.
const MOST: usize = 2_000;

/// Edges that one core takes at a time.
const AT_A_TIME: usize = 256;

/// How often twice as much clearance is asked for to see how much is left: partners lie within five of each other.
const DOUBLINGS: u32 = 6;

/// Lays the punch in the plate. `names` are what the two are called.
pub(super) fn held(punch: &Part, plate: &Part, names: [Arc<str>; 2], limits: &Limits) -> Pair {
    let mut spots = corners([punch, plate], &names, false, limits);
    let both = names.clone();
    let [of_punch, of_plate] = names;
    let turned = [of_plate.clone(), of_punch.clone()];
    spots.extend(corners([plate, punch], &turned, true, limits));
    let mut least = limits.clearance;
    match limits.along_walls {
        Some(apart) if apart < limits.clearance - limits.rounding => {
            least = apart;
            let first = punch.edges.first().map(|edge| edge.geometry.point_at(0.5));
            if let Some(at) = first
                && let (Some(segment), Some(other)) =
                    (punch.segment_at(0, at), segment_near(plate, at))
            {
                spots.insert(
                    0,
                    Spot {
                        at,
                        turn: 0.0,
                        clearance: apart,
                        is_of_plate: false,
                        segment,
                        of: of_punch,
                        other,
                        partner: of_plate,
                    },
                );
            }
        }
        Some(_) => {}
        None => spots.extend(walls(punch, plate, [of_punch, of_plate], limits)),
    }
    least = spots
        .iter()
        .map(|spot| spot.clearance)
        .fold(least, f64::min);
    if limits.asks_least && spots.is_empty() {
        least = more_than_wanted(punch, plate, both, limits);
    }
    Pair {
        least,
        spots,
        punch: segments(punch),
        plate: segments(plate),
    }
}

/// How much is left where it is tightest, of parts that have the clearance everywhere: so much more is asked for that it is missing.
fn more_than_wanted(punch: &Part, plate: &Part, names: [Arc<str>; 2], limits: &Limits) -> f64 {
    let least = |clearance: f64| {
        let more = Limits {
            clearance,
            asks_least: false,
            ..*limits
        };
        let pair = held(punch, plate, names.clone(), &more);
        (pair.least < clearance).then_some(pair.least)
    };
    match limits.along_walls {
        Some(apart) if apart > limits.clearance => least(apart).unwrap_or(apart),
        Some(_) => limits.clearance,
        None => {
            let mut asked = (1..=DOUBLINGS).map(|nth| limits.clearance * f64::from(1 << nth));
            asked.find_map(least).unwrap_or(limits.clearance)
        }
    }
}

/// The places where the wire turned in a point, and left less than the clearance to the other part.
fn corners(
    [one, other]: [&Part; 2],
    names: &[Arc<str>; 2],
    is_of_plate: bool,
    limits: &Limits,
) -> Vec<Spot> {
    let spot = |(index, turned): (usize, Point)| {
        let (far, at, on) = farthest(one, index, turned, other, limits)?;
        let at_own = turned + (at - turned) * (one.half / far);
        Some(Spot {
            at: at_own,
            turn: one.edges[index].geometry.as_arc()?.sweep.abs(),
            clearance: one.half - far,
            is_of_plate,
            segment: one.segment_at(index, at_own)?,
            of: names[0].clone(),
            other: other.segment_at(on, at)?,
            partner: names[1].clone(),
        })
    };
    let turns = one.edges.par_iter().enumerate().with_min_len(AT_A_TIME);
    turns
        .filter_map(|(index, edge)| Some((index, edge.turned_about?)))
        .filter_map(spot)
        .collect()
}

/// Of the places of the other part that are nearest to where the wire turned the farthest: how far, where, and on which edge. `None` where
/// the clearance is kept.
fn farthest(
    one: &Part,
    index: usize,
    turned: Point,
    other: &Part,
    limits: &Limits,
) -> Option<(f64, Point, usize)> {
    let arc = one.edges[index].geometry.as_arc()?;
    let (from, to) = (arc.start - turned, arc.end - turned);
    let sense = arc.sweep.signum();
    let is_whole = arc.is_full_turn();
    let slack = limits.rounding * one.half;
    let is_within = |way: Vector| {
        is_whole || cross(from, way) * sense >= -slack && cross(way, to) * sense >= -slack
    };
    let kept = one.half - limits.clearance + limits.rounding;
    let widest = (arc.sweep / 2.0).cos().max(1.0 / FARTHEST);
    let reach = (one.half + 2.0 * limits.clearance) / widest;
    let mut places: Vec<(f64, Point, usize)> = Vec::new();
    other.near.find(&Bounds::of_disc(turned, reach), |edge| {
        let geometry = &other.edges[edge].geometry;
        let mut shares: Few<f64, 8> = [0.0, 1.0].into_iter().collect();
        if !is_whole {
            shares.extend(
                [from, to]
                    .into_iter()
                    .flat_map(|ray| crossed(geometry, turned, ray)),
            );
        }
        if let Segment::Arc(round) = geometry
            && let Some(axis) = (round.center - turned).try_normalize(0.0)
        {
            shares.extend(
                [axis, -axis].map(|axis| round.share_of(round.center + axis * round.radius)),
            );
        }
        for share in shares
            .into_iter()
            .filter(|share| (0.0..=1.0).contains(share))
        {
            let at = geometry.point_at(share);
            let far = (at - turned).norm();
            if far > kept && is_within(at - turned) {
                places.push((far, at, edge));
            }
        }
        false
    });
    places.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.2.cmp(&b.2)));
    let is_nearest =
        |&(far, at, _): &(f64, Point, usize)| one.path.nearer(at, far - limits.rounding).is_none();
    places.into_iter().find(is_nearest)
}

/// Where a segment meets a ray, as shares of the segment; some may lie beyond its ends.
fn crossed(segment: &Segment, from: Point, ray: Vector) -> Few<f64, 2> {
    let found: Few<Point, 2> = match segment {
        Segment::Line(line) => {
            crate::geometry::line_line(line.start, line.end - line.start, from, ray)
                .into_iter()
                .collect()
        }
        Segment::Arc(arc) => crate::geometry::line_circle(from, ray, arc.center, arc.radius),
    };
    found.into_iter().map(|at| segment.share_of(at)).collect()
}

/// Walls of two drawn parts that lie too near to each other, or run into each other.
fn walls(punch: &Part, plate: &Part, names: [Arc<str>; 2], limits: &Limits) -> Vec<Spot> {
    let edges: Vec<usize> = (0..punch.edges.len()).collect();
    let some = edges.par_chunks(AT_A_TIME);
    some.flat_map_iter(|edges| walls_of(edges, punch, plate, &names, limits))
        .collect()
}

/// Those of some edges of the punch.
fn walls_of(
    edges: &[usize],
    punch: &Part,
    plate: &Part,
    names: &[Arc<str>; 2],
    limits: &Limits,
) -> Vec<Spot> {
    let mut spots = Vec::new();
    let plain = |part: &Part, index: usize| part.edges[index].turned_about.is_none();
    let mut beside = None;
    for &index in edges.iter().filter(|index| plain(punch, **index)) {
        let edge = &punch.edges[index];
        let geometry = &edge.geometry;
        let mut nearest = (limits.clearance - limits.rounding, None);
        plate
            .near
            .find(&geometry.bounds().grown(limits.clearance), |other| {
                let nearer = || plate.near.distance_below(geometry, other, nearest.0);
                if plain(plate, other)
                    && let Some(apart) = nearer()
                {
                    nearest = (apart, Some(other));
                }
                false
            });
        let depth = |at: Point| plate.path.distance_to(at, plate.half) - plate.half;
        // What lies beyond the other's edge, or crosses it, is as deep as it is away from what the wire has cut.
        let mut is_deep = |at: Point| {
            beside = plate
                .path
                .nearer_from(beside, at, plate.half + limits.rounding);
            beside.is_none()
        };
        let deepest =
            if nearest.1.is_some() && nearest.0 <= limits.rounding || is_deep(geometry.start()) {
                deepest(geometry, &depth, limits.rounding)
            } else {
                None
            };
        let (clearance, at, other) = match (deepest, nearest) {
            (Some((depth, at)), (_, other)) => (-depth, at, other),
            (None, (apart, Some(other))) => {
                let at = nearest_place(geometry, &plate.edges[other].geometry);
                (apart, at, Some(other))
            }
            (None, (_, None)) => continue,
        };
        let other = other.and_then(|other| plate.segment_at(other, at));
        if let (Some(segment), Some(other)) = (
            punch.segment_at(index, at),
            other.or_else(|| segment_near(plate, at)),
        ) {
            spots.push(Spot {
                at,
                turn: 0.0,
                clearance,
                is_of_plate: false,
                segment,
                of: names[0].clone(),
                other,
                partner: names[1].clone(),
            });
        }
    }
    spots
}

/// The drawn segment of the edge that is nearest to a point.
fn segment_near(part: &Part, at: Point) -> Option<super::SegmentOf> {
    let (_, nearest) = part.near.nearest_to(at, part.half)?;
    part.segment_at(nearest, at)
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

/// The deepest place of a segment: `depth` changes by no more than the way along it. `None` where nothing of it is deep.
fn deepest(
    segment: &Segment,
    depth: &dyn Fn(Point) -> f64,
    tolerance: f64,
) -> Option<(f64, Point)> {
    let length = segment.length();
    let mut worst: Option<(f64, Point)> = None;
    let mut look = |share: f64| {
        let at = segment.point_at(share);
        let found = depth(at);
        if found > tolerance && worst.is_none_or(|(most, _)| found > most) {
            worst = Some((found, at));
        }
        (found, worst.map_or(0.0, |(most, _)| most))
    };
    let ends = (look(0.0).0, look(1.0).0);
    let mut waiting = vec![(0.0, ends.0, 1.0, ends.1)];
    for _ in 0..MOST {
        let Some((from, at_from, to, at_to)) = waiting.pop() else {
            break;
        };
        let middle = (from + to) / 2.0;
        let (at_middle, most) = look(middle);
        for (from, at_from, to, at_to) in [
            (from, at_from, middle, at_middle),
            (middle, at_middle, to, at_to),
        ] {
            if (at_from + at_to + (to - from) * length) / 2.0 > most + tolerance.max(1e-5) {
                waiting.push((from, at_from, to, at_to));
            }
        }
    }
    worst
}
