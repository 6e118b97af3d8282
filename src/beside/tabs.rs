//! The lengths of a program's tabs, measured along the drawing's walls, and where the program begins beside them.

use super::drawn::Drawn;
use super::reference::Reference;
use super::traced::{Motion, Traced};
use crate::geometry::{Bounds, Grid, Point, Segment, Vector};
use crate::program::write::scaled;
use crate::settings::PointSetting;
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::ops::Range;

/// Blocks on either side of a stop, and at the ends of a cut, that may begin or end at a tab.
const ABOUT: usize = 4;
/// The most blocks of a cut that vote for its place, and the most votes of each.
const ASKED: usize = 200;
const VOTES: usize = 64;
/// Votes for one place lie within this, µm.
const ONE: f64 = 3.0;
/// The most walls that are measured.
const WALLS: usize = 50_000;
/// The largest deviation of a place of the path from the path's distance from its wall, µm.
const NEAR: f64 = 4.0;
/// A length is taken for the round number within this distance, in µm: a block before it may have been changed by 3 µm.
const ROUND: [f64; 5] = [500.0, 100.0, 50.0, 10.0, 1.0];
const ROUNDED: f64 = 5.0;
/// The most lengths that are returned.
const TOLD: usize = 16;

/// The possible lengths of a program's tabs, mm, found by another program that was written for the drawing with the
/// same corrections: none, and the distances from a place where the wire stops or begins again to an entry.
pub(super) fn tabs(
    drawn: &Drawn,
    traced: &Traced,
    reference: &Reference,
    corrections: &[f64],
) -> Vec<f64> {
    let mut found = vec![0.0];
    if !traced
        .blocks
        .iter()
        .any(|block| block.motion == Motion::Stop)
    {
        return found;
    }
    let walls = Walls::of(drawn, corrections);
    let Some(walls) = walls else { return found };
    let pieces = Pieces::of(reference);
    // By contour where the cuts of either program begin along it.
    let mut entries: Vec<Vec<f64>> = vec![Vec::new(); walls.contours.len()];
    let own = laid(traced, &pieces);
    for (of, all) in [
        (&reference.traced, &laid(&reference.traced, &pieces)),
        (traced, &own),
    ] {
        for ([_, contour], by) in of.cuts.iter().zip(all) {
            let at = by.and_then(|by| entry(of, contour, |place| walls.foot(place + by)));
            if let Some((contour, along)) = at
                && let Some(entries) = entries.get_mut(contour)
            {
                entries.push(along);
            }
        }
    }
    let mut lengths: Vec<f64> = Vec::new();
    for ([cut, _], by) in traced.cuts.iter().zip(&own) {
        let Some(by) = *by else { continue };
        for place in places(traced, cut) {
            let Some((contour, at)) = walls.foot(place + by) else {
                continue;
            };
            let whole = walls.contours[contour].1;
            for entry in entries.get(contour).into_iter().flatten() {
                let away = (entry - at).rem_euclid(whole);
                lengths.extend([away, whole - away]);
            }
        }
    }
    // Its transitions are no pieces of the path, but all of a tab is cut in one pass after its stop.
    if traced.four_b {
        lengths.extend(
            traced
                .cuts
                .iter()
                .flat_map(|[cut, _]| behind_stops(traced, cut)),
        );
    }
    // That which most stops and entries speak for first, and of these the rounder number.
    let mut rounded: Vec<(usize, usize, f64)> = Vec::new();
    let mut known: FxHashMap<u64, usize> = FxHashMap::default();
    for um in lengths {
        for (rank, to) in ROUND.iter().enumerate() {
            let round = (um / to).round() * to;
            if (round - um).abs() > ROUNDED || round <= 20.0 {
                continue;
            }
            let at = *known.entry(round.to_bits()).or_insert(rounded.len());
            match rounded.get_mut(at) {
                Some((count, ..)) => *count += 1,
                None => rounded.push((1, rank, round)),
            }
        }
    }
    rounded.sort_by_key(|(count, rank, _)| (Reverse(*count), *rank));
    found.extend(rounded.into_iter().map(|(.., um)| um / 1e3).take(TOLD));
    found
}

/// Where the wire is threaded for each contour, and where its cut begins, in mm, by handles; `None` for
/// a program that does not state its place.
pub(super) fn threads(
    drawn: &Drawn,
    traced: &Traced,
    corrections: &[f64],
) -> Option<[PointSetting; 2]> {
    if !traced.is_placed {
        return None;
    }
    let walls = Walls::of(drawn, corrections)?;
    let names: Vec<&str> = drawn
        .cut()
        .map(|outline| Some(drawn.handle(outline.contour.pieces.first()?.entity)))
        .collect::<Option<_>>()?;
    let (mut threads, mut entries) = (BTreeMap::new(), BTreeMap::new());
    for [all, contour] in &traced.cuts {
        let segment = |index: usize| traced.blocks.get(index)?.segment();
        let entry = entry(traced, contour, |place| walls.foot(place));
        let (Some(begin), Some((index, along))) = (segment(all.start), entry) else {
            continue;
        };
        let wall = walls.at(index, along)?;
        let name = (*names.get(index)?).to_owned();
        let in_mm = |place: Point| [place.x / 1e3, place.y / 1e3];
        threads.entry(name.clone()).or_insert(in_mm(begin.start()));
        entries.entry(name).or_insert(in_mm(wall));
    }
    let by_handle = [threads, entries].map(PointSetting::ByHandle);
    Some(by_handle)
}

/// The walls of each contour, in the direction of travel, each with the way to its start; and the length of the
/// contour.
struct Walls {
    contours: Vec<(Vec<(Segment, f64)>, f64)>,
    /// The distances of the path from them, µm.
    away: Vec<f64>,
    /// The walls by contour and place in it.
    boxes: Grid<(usize, usize)>,
}

impl Walls {
    fn of(drawn: &Drawn, corrections: &[f64]) -> Option<Walls> {
        let scale = drawn.unit_mm * 1e3;
        let contours = drawn.contours();
        let sum: usize = contours.iter().map(|contour| contour.segments.len()).sum();
        let of_contours = contours.iter().map(|contour| {
            let mut way = 0.0;
            let segments = contour.segments.iter().map(|segment| {
                let own = scaled(&segment.geometry, scale);
                way += own.length();
                (own, way - own.length())
            });
            (segments.collect(), way)
        });
        let on_it = std::iter::once(0.0);
        if sum > WALLS {
            return None;
        }
        let contours: Vec<(Vec<(Segment, f64)>, f64)> = of_contours.collect();
        let mut boxes = Grid::default();
        for (index, (segments, _)) in contours.iter().enumerate() {
            for (at, (wall, _)) in segments.iter().enumerate() {
                boxes.insert((index, at), wall.bounds());
            }
        }
        Some(Walls {
            contours,
            away: on_it.chain(corrections.iter().map(|mm| mm * 1e3)).collect(),
            boxes,
        })
    }

    /// The place at this distance along a contour.
    fn at(&self, contour: usize, along: f64) -> Option<Point> {
        let (segments, _) = self.contours.get(contour)?;
        let own = segments.iter().rev().find(|(_, begin)| *begin <= along);
        let (wall, begin) = own.or(segments.first())?;
        Some(wall.point_at(((along - begin) / wall.length()).clamp(0.0, 1.0)))
    }

    /// The contour beside which a place of the path lies, and how far along it.
    fn foot(&self, place: Point) -> Option<(usize, f64)> {
        let reach = self.away.iter().fold(0.0, |most: f64, own| most.max(*own)) + NEAR;
        let mut best: Option<(f64, (usize, usize))> = None;
        let about = Bounds::of_disc(place, reach);
        // Of walls that are as near the first one.
        self.boxes.near(&about, |key @ (index, at), _| {
            let Some((wall, _)) = self.wall(index, at) else {
                return;
            };
            let away = wall.distance_to(place);
            let is_beside = self.away.iter().any(|own| (away - own).abs() <= NEAR);
            if is_beside && best.is_none_or(|known| (away, key) < known) {
                best = Some((away, key));
            }
        });
        let (_, (index, at)) = best?;
        let (wall, begin) = self.wall(index, at)?;
        let share = wall.share_of(place).clamp(0.0, 1.0);
        Some((index, begin + share * wall.length()))
    }

    fn wall(&self, contour: usize, at: usize) -> Option<&(Segment, f64)> {
        self.contours.get(contour)?.0.get(at)
    }
}

/// Where a cut reaches its wall: with its first block, or with one of the next, after an arc that leads there.
fn entry(
    traced: &Traced,
    contour: &Range<usize>,
    foot: impl Fn(Point) -> Option<(usize, f64)>,
) -> Option<(usize, f64)> {
    let blocks = traced.blocks.get(contour.clone())?.iter().take(ABOUT);
    blocks
        .filter_map(|block| block.segment())
        .find_map(|own| foot(own.start()))
}

/// Where a tab may begin: at the ends of blocks about the stops of a cut, and about its own ends.
fn places(traced: &Traced, cut: &Range<usize>) -> Vec<Point> {
    let is_near = |index: usize| {
        let about = index.saturating_sub(ABOUT)..=index + ABOUT;
        index < cut.start + ABOUT
            || index + ABOUT >= cut.end
            || about.into_iter().any(|near| {
                let block = traced.blocks.get(near);
                block.is_some_and(|block| block.motion == Motion::Stop)
            })
    };
    let near = cut.clone().filter(|index| is_near(*index));
    let segments = near.filter_map(|index| traced.blocks.get(index)?.segment());
    segments.map(Segment::end).collect()
}

/// How far the wire goes from each stop of a cut to the ends of the next blocks, µm.
fn behind_stops(traced: &Traced, cut: &Range<usize>) -> Vec<f64> {
    let mut lengths = Vec::new();
    let is_stop = |index: &usize| {
        let block = traced.blocks.get(*index);
        block.is_some_and(|block| block.motion == Motion::Stop)
    };
    for stop in cut.clone().filter(is_stop) {
        let behind = traced.blocks.get(stop + 1..cut.end).unwrap_or_default();
        let mut way = 0.0;
        for segment in behind.iter().map_while(|block| block.segment()).take(ABOUT) {
            way += segment.length();
            lengths.push(way);
        }
    }
    lengths
}

/// The pieces of a written program's path, by what stays the same wherever they lie.
struct Pieces(FxHashMap<(i64, i64), Vec<Point>>);

impl Pieces {
    fn of(reference: &Reference) -> Pieces {
        let mut pieces: FxHashMap<(i64, i64), Vec<Point>> = FxHashMap::default();
        for piece in reference.on_walls() {
            let own = pieces.entry(Pieces::key(piece)).or_default();
            own.push(Pieces::stands_for(piece));
        }
        Pieces(pieces)
    }

    fn key(segment: &Segment) -> (i64, i64) {
        let steps = |um: f64| um.round() as i64;
        match segment {
            Segment::Line(line) => {
                let by = line.end - line.start;
                let by = if (by.y, by.x) < (0.0, 0.0) { -by } else { by };
                (steps(by.x), steps(by.y))
            }
            Segment::Arc(arc) => (steps(arc.radius), i64::MIN),
        }
    }

    /// Of a line its middle stands for it, whichever way it is gone.
    fn stands_for(segment: &Segment) -> Point {
        match segment {
            Segment::Line(line) => line.start + (line.end - line.start) / 2.0,
            Segment::Arc(arc) => arc.center,
        }
    }

    /// From a block to the first pieces that are as long, or as round.
    fn votes(&self, segment: &Segment, votes: &mut Vec<Vector>) {
        let (x, y) = Pieces::key(segment);
        let about = if y == i64::MIN { 0..=0 } else { -1..=1 };
        for (x, y) in (-1..=1).flat_map(|by| about.clone().map(move |more| (x + by, y + more))) {
            let own = self.0.get(&(x, y)).into_iter().flatten();
            let by = own
                .take(VOTES)
                .map(|place| place - Pieces::stands_for(segment));
            votes.extend(by);
        }
    }
}

/// For each cut, from its places to those of the drawing, by which most of its blocks are pieces of the path.
fn laid(traced: &Traced, pieces: &Pieces) -> Vec<Option<Vector>> {
    let cuts = traced.cuts.iter();
    cuts.map(|[cut, _]| laid_cut(traced, cut, pieces)).collect()
}

fn laid_cut(traced: &Traced, cut: &Range<usize>, pieces: &Pieces) -> Option<Vector> {
    let blocks = traced.blocks.get(cut.clone())?;
    let segments: Vec<&Segment> = blocks.iter().filter_map(|block| block.segment()).collect();
    let step = segments.len().div_ceil(ASKED).max(1);
    let mut votes: Vec<Vector> = Vec::new();
    for segment in segments.into_iter().step_by(step) {
        pieces.votes(segment, &mut votes);
    }
    votes.sort_by(|one, other| one.x.total_cmp(&other.x));
    // Of each vote, those that lie near it in x stand about it.
    let count = |of: usize| {
        let is_near = |other: &&Vector| (*other - votes[of]).amax() <= ONE;
        let in_x = |other: &&Vector| (other.x - votes[of].x).abs() <= ONE;
        let behind = votes[of..].iter().take_while(in_x).filter(is_near);
        let before = votes[..of].iter().rev().take_while(in_x).filter(is_near);
        behind.count() + before.count()
    };
    let most = (0..votes.len()).max_by_key(|of| count(*of))?;
    let near = votes
        .iter()
        .filter(|vote| (*vote - votes[most]).amax() <= ONE);
    let (sum, count) = near.fold((Vector::zeros(), 0.0), |(sum, count), vote| {
        (sum + vote, count + 1.0)
    });
    Some(sum / count)
}
