//! Where a program, or a part of it, lies on its drawing: where most of its blocks find a segment of their direction and
//! length, or an arc of their radius.
//!
//! Each pair of a block and such a segment votes for the shift that lays one on the other, at most a correction from the
//! right one. Where many votes meet, the blocks that cast them are laid beside the contours at one distance, exactly.

use super::budget::Budget;
use super::drawn::Drawn;
use super::level::share;
use super::traced::{Cut, Traced};
use crate::geometry::{Point, Segment, Vector, left_normal};
use nalgebra::{Matrix3, Vector3};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// So many blocks vote, and so many of them are laid exactly.
const VOTERS: usize = 600;
const LOOKED_AT: usize = 64;
/// By how much the lengths of a block and of its segment, or their radii, may differ, µm.
const LONGER: f64 = 1_000.0;
/// Votes meet within this, µm.
const NEAR: f64 = 1_000.0;
/// So many places are tried.
const PLACES: usize = 3;
/// A place is right where so much of the first cuts lies at one distance beside a contour.
const CUTS: usize = 3;
const RIGHT: f64 = 0.06;
/// The place that a program states is right where so much of them does: a wrong block may move all that follows it.
const STATED: f64 = 0.03;
/// Distances that do not fit count less from so far off on, µm: first as far as a corner may shift them.
const SCALES: [f64; 6] = [300.0, 100.0, 30.0, 10.0, 4.0, 4.0];

/// From a program's places to those of the drawing, and whether the program says so; `None` where it lies nowhere on it.
pub(super) fn place(drawn: &Drawn, traced: &Traced, budget: &Budget) -> Option<(Vector, bool)> {
    let cuts = traced.cuts.iter().map(|cut| cut.contour.clone());
    let cuts: Vec<Range<usize>> = cuts.filter(|cut| !cut.is_empty()).take(CUTS).collect();
    let right = |shift: Vector| {
        let own = cuts
            .iter()
            .map(|cut| share(traced, drawn.walls(), cut.clone(), shift, budget));
        own.sum::<f64>() / cuts.len().max(1) as f64
    };
    let stated = traced.is_placed.then(|| right(Vector::zeros()));
    let stated = stated.filter(|own| *own >= STATED);
    // What begins at zero may as well count from where the wire is threaded.
    let is_zero = traced.begin().is_none_or(|begin| begin == Point::origin());
    if stated.is_some() && !is_zero {
        return Some((Vector::zeros(), true));
    }
    let all = places(drawn, traced, 0..traced.blocks.len(), budget);
    let of_all = all.into_iter().map(|shift| (right(shift), shift));
    let best = of_all.reduce(|best, other| if other.0 > best.0 + 0.1 { other } else { best });
    let best = best.filter(|(own, _)| *own >= RIGHT);
    match (stated, best) {
        (Some(stated), Some((own, shift))) if stated < own / 2.0 => Some((shift, false)),
        (Some(_), _) => Some((Vector::zeros(), true)),
        (None, best) => best.map(|(_, shift)| (shift, traced.is_placed)),
    }
}

/// A block that lies on a segment where the program is shifted so.
struct Vote {
    block: usize,
    shift: Vector,
    weight: f64,
}

/// The places of some blocks, the most likely first: that of all that agree, of the first and of the last half of them,
/// between which a wrong block may lie, and of those that are cut at once.
pub(super) fn places(
    drawn: &Drawn,
    traced: &Traced,
    blocks: Range<usize>,
    budget: &Budget,
) -> Vec<Vector> {
    let mut votes = votes(drawn, traced, blocks, budget);
    let mut places = Vec::new();
    for _ in 0..PLACES {
        let Some(meeting) = densest(&votes) else {
            break;
        };
        let is_near = |vote: &Vote| (vote.shift - meeting).norm() <= NEAR;
        let (near, rest): (Vec<Vote>, Vec<Vote>) = votes.into_iter().partition(is_near);
        votes = rest;
        let mut all: Vec<usize> = near.iter().map(|vote| vote.block).collect();
        all.dedup();
        let is_arc = |index: &usize| {
            let own = traced.blocks.get(*index).and_then(|block| block.segment());
            own.is_some_and(|own| own.as_arc().is_some())
        };
        // Two sides alone do not say where they lie: the blocks about them do.
        if let (Some(first), Some(last), false) = (all.first(), all.last(), all.iter().any(is_arc))
            && all.len() < 3
        {
            all = (first.saturating_sub(1)..last + 2).collect();
        }
        let (before, behind) = all.split_at(all.len() / 2);
        let parts = if all.len() > 3 { 3 } else { 1 };
        let parts = [&all[..], before, behind].into_iter().take(parts);
        // What is cut at once has one offset.
        let of_cut = |cut: &Cut| -> Vec<usize> {
            let is_in = |index: &&usize| cut.blocks.contains(index);
            all.iter().filter(is_in).copied().collect()
        };
        let longest = traced.cuts.iter().map(of_cut).max_by_key(Vec::len);
        let longest = longest.filter(|cut| cut.len() > 2 && cut.len() < all.len());
        let parts = parts.chain(longest.as_deref());
        places.extend(parts.map(|part| refined(drawn, traced, part, meeting, budget)));
    }
    places
}

/// The offsets that arcs tell of some blocks, whatever moves them: by how much their radii differ from those of the
/// drawing, and the radii of those that go round its corners. The most frequent first, µm, without a sign.
pub(super) fn told_by_arcs(drawn: &Drawn, traced: &Traced, blocks: Range<usize>) -> Vec<f64> {
    let mut told: FxHashMap<i64, (usize, f64)> = FxHashMap::default();
    let blocks = traced.blocks.get(blocks).unwrap_or_default();
    for arc in blocks
        .iter()
        .filter_map(|block| block.segment()?.as_arc())
        .take(VOTERS)
    {
        let walls = drawn
            .walls()
            .of_radius(arc.radius - LONGER / 2.0..arc.radius + LONGER / 2.0);
        let of_walls = walls
            .iter()
            .take(LOOKED_AT)
            .map(|(radius, _)| (radius - arc.radius).abs());
        for offset in of_walls.chain(Some(arc.radius).filter(|radius| *radius < LONGER / 2.0)) {
            let (count, sum) = told
                .entry((offset / 2.0).round() as i64)
                .or_insert((0, 0.0));
            (*count, *sum) = (*count + 1, *sum + offset);
        }
    }
    let mut all: Vec<(usize, f64)> = told
        .into_values()
        .map(|(count, sum)| (count, sum / count as f64))
        .collect();
    all.sort_by(|one, other| other.0.cmp(&one.0).then(one.1.total_cmp(&other.1)));
    all.into_iter()
        .map(|(_, offset)| offset)
        .take(PLACES)
        .collect()
}

fn votes(drawn: &Drawn, traced: &Traced, blocks: Range<usize>, budget: &Budget) -> Vec<Vote> {
    let mut votes = Vec::new();
    let all = traced
        .blocks
        .iter()
        .enumerate()
        .take(blocks.end)
        .skip(blocks.start);
    let voters = all.filter_map(|(index, block)| Some((index, block.segment()?)));
    for (block, own) in voters.take(VOTERS) {
        let length = own.length();
        let mut vote = |shift: Vector| {
            votes.push(Vote {
                block,
                shift,
                weight: length,
            })
        };
        match own {
            Segment::Arc(arc) => {
                let radii = arc.radius - LONGER / 2.0..arc.radius + LONGER / 2.0;
                let alike = drawn.walls().of_radius(radii).iter();
                for (_, other) in alike.take_while(|_| budget.take(1)) {
                    vote(other.center - arc.center);
                }
            }
            Segment::Line { .. } => {
                let alike = drawn.walls().like(own, LONGER);
                for other in alike.take_while(|_| budget.take(1)) {
                    vote(other.point_at(0.5) - own.point_at(0.5));
                }
            }
        }
    }
    votes
}

/// Where the votes of most blocks meet.
fn densest(votes: &[Vote]) -> Option<Vector> {
    let mut cells: FxHashMap<(i64, i64), (f64, Vector, usize)> = FxHashMap::default();
    for vote in votes {
        // Each counts in the cells about it, whose middles lie within half of what is near.
        let at = |by: f64| ((by * 2.0) / NEAR).round() as i64;
        let (x, y) = (at(vote.shift.x), at(vote.shift.y));
        for (x, y) in [(x, y), (x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)] {
            let (weight, sum, last) =
                cells
                    .entry((x, y))
                    .or_insert((0.0, Vector::zeros(), usize::MAX));
            // A block votes once.
            if *last != vote.block {
                *weight += vote.weight;
                *sum += vote.weight * vote.shift;
                *last = vote.block;
            }
        }
    }
    let best = cells
        .into_iter()
        .max_by(|one, other| one.1.0.total_cmp(&other.1.0).then(other.0.cmp(&one.0)));
    best.map(|(_, (weight, sum, _))| sum / weight)
}

/// The place near another one from which some blocks lie at one distance.
fn refined(
    drawn: &Drawn,
    traced: &Traced,
    blocks: &[usize],
    mut shift: Vector,
    budget: &Budget,
) -> Vector {
    let walls = drawn.walls();
    let segments = blocks
        .iter()
        .filter_map(|index| traced.blocks.get(*index)?.segment());
    let segments: Vec<&Segment> = segments.collect();
    let step = segments.len().div_ceil(LOOKED_AT).max(1);
    for scale in SCALES {
        let measured = segments.iter().step_by(step).flat_map(|segment| {
            let places = [0.25, 0.75].map(|share| segment.point_at(share));
            places.into_iter().filter_map(|place: Point| {
                let near = walls.near(place + shift, None, budget)?;
                let wall = walls.segment(&near)?;
                let share = wall.share_of(place + shift).clamp(0.0, 1.0);
                Some((left_normal(wall.tangent_at(share)), near.left))
            })
        });
        let measured: Vec<(Vector, f64)> = measured.collect();
        let mut lefts: Vec<f64> = measured.iter().map(|(_, left)| *left).collect();
        lefts.sort_by(f64::total_cmp);
        let Some(middle) = lefts.get(lefts.len() / 2) else {
            return shift;
        };
        let (mut sums, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for (normal, left) in &measured {
            let off = left - middle;
            let weight = 1.0 / (1.0 + (off / scale).powi(2));
            let row = Vector3::new(normal.x, normal.y, -1.0);
            sums += weight * row * row.transpose();
            right += -weight * off * row;
        }
        let Some(solved) = sums.try_inverse().map(|inverse| inverse * right) else {
            return shift;
        };
        let by = Vector::new(solved.x, solved.y);
        if by.norm() > NEAR || !by.x.is_finite() {
            return shift;
        }
        shift += by;
    }
    shift
}
