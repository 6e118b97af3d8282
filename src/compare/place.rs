//! Where a program, or a part of it, lies on its drawing: where most of its blocks find a segment of their direction and
//! length, or an arc of their radius.
//!
//! Each pair of a block and such a segment votes for the shift that lays one on the other, at most a correction from the
//! right one. Where many votes meet, the blocks that cast them are laid beside the contours at one distance, exactly.

use super::budget::Budget;
use super::drawn::Drawn;
use super::level::{Run, runs};
use super::traced::{Cut, Traced};
use crate::geometry::{Point, Segment, Vector, left_normal};
use nalgebra::{Matrix3, Vector3};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// So many blocks vote, and so many of them are laid exactly.
const VOTERS: usize = 200;
const LOOKED_AT: usize = 64;
/// So many sides do not say where they lie.
const FEW: usize = 3;
/// By how much the lengths of a block and of its segment, or their radii, may differ, µm.
const LONGER: f64 = 1_000.0;
/// Votes meet within this, µm.
const NEAR: f64 = 1_000.0;
/// So many places are tried.
const PLACES: usize = 3;
/// A place is right where so much of the contours of the first cuts lies beside it at one distance: of the place that a
/// program states half as much does, since a wrong block may move all that follows it.
const CUTS: usize = 3;
const RIGHT: f64 = 0.06;
/// Distances that do not fit count less from so far off on, µm: first as far as a corner may shift them.
const SCALES: [f64; 6] = [300.0, 100.0, 30.0, 10.0, 4.0, 4.0];

/// From a program's places to those of the drawing, and whether the program says so; `None` where it lies nowhere on it.
pub(super) fn place(drawn: &Drawn, traced: &Traced, budget: &Budget) -> Option<(Vector, bool)> {
    let cuts = traced.cuts.iter().map(|cut| cut.contour.clone());
    let cuts: Vec<Range<usize>> = cuts.filter(|cut| !cut.is_empty()).take(CUTS).collect();
    let right = |shift: Vector| {
        let longest = |cut: &Range<usize>| {
            let runs = runs(traced, drawn.walls(), cut.clone(), shift, budget);
            runs.iter().map(|run: &Run| run.share).fold(0.0, f64::max)
        };
        cuts.iter().map(longest).sum::<f64>() / cuts.len().max(1) as f64
    };
    let stated = traced.is_placed.then(|| right(Vector::zeros()));
    let stated = stated.filter(|share| *share >= RIGHT / 2.0);
    // What begins at zero may as well count from where the wire is threaded.
    let is_zero = traced.begin().is_none_or(|begin| begin == Point::origin());
    if stated.is_some() && !is_zero {
        return Some((Vector::zeros(), true));
    }
    let all = places(drawn, traced, 0..traced.blocks.len(), budget);
    let of_all = all.into_iter().map(|shift| (right(shift), shift));
    let best = of_all.reduce(|best, other| if other.0 > best.0 + 0.1 { other } else { best });
    let best = best.filter(|(share, _)| *share >= RIGHT);
    match (stated, best) {
        (Some(stated), Some((share, shift))) if stated < share / 2.0 => Some((shift, false)),
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

/// The places of some blocks, the most likely first: that of all that agree, and of those that are cut at once.
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
        let own = all
            .iter()
            .filter_map(|index| traced.blocks.get(*index)?.segment());
        let is_told = all.len() > FEW || own.clone().any(|own| own.as_arc().is_some());
        // A few sides alone do not say where they lie: the blocks about them do.
        if let (Some(first), Some(last), false) = (all.first(), all.last(), is_told) {
            all = (first.saturating_sub(1)..last + 2).collect();
        }
        // What is cut at once has one offset, and a wrong block may lie between its halves, or be a side that tells it.
        let of_cut = |cut: &Cut| -> Vec<usize> {
            let is_in = |index: &&usize| cut.blocks.contains(index);
            all.iter().filter(is_in).copied().collect()
        };
        let cut = traced.cuts.iter().map(of_cut).max_by_key(Vec::len);
        let cut = cut.unwrap_or_default();
        let (half, quarter) = (cut.len() / 2, cut.len() / 4);
        let (before, behind) = cut.split_at(half);
        let (most, least) = (&cut[..cut.len() - quarter], &cut[quarter..]);
        let parts = [&all[..], before, behind, &cut, most, least];
        let parts = parts.into_iter().take(if cut.len() > 3 { 6 } else { 1 });
        places.extend(parts.map(|part| refined(drawn, traced, part, meeting, budget)));
    }
    places
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
        let shifts: Vec<Vector> = match own {
            Segment::Arc(arc) => {
                let radii = arc.radius - LONGER / 2.0..arc.radius + LONGER / 2.0;
                let alike = drawn
                    .walls()
                    .of_radius(radii)
                    .take_while(|_| budget.take(1));
                alike.map(|other| other.center - arc.center).collect()
            }
            Segment::Line { .. } => {
                let alike = drawn
                    .walls()
                    .like(own, LONGER)
                    .take_while(|_| budget.take(1));
                alike
                    .map(|other| other.point_at(0.5) - own.point_at(0.5))
                    .collect()
            }
        };
        votes.extend(shifts.into_iter().map(|shift| Vote {
            block,
            shift,
            weight: own.length(),
        }));
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
        for cell in [(x, y), (x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)] {
            let empty = || (0.0, Vector::zeros(), usize::MAX);
            let (weight, sum, last) = cells.entry(cell).or_insert_with(empty);
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
    let segments = blocks
        .iter()
        .filter_map(|index| traced.blocks.get(*index)?.segment());
    let segments: Vec<&Segment> = segments.collect();
    let step = segments.len().div_ceil(LOOKED_AT).max(1);
    let looked_at = segments.iter().step_by(step);
    let places = looked_at.flat_map(|segment| [0.25, 0.75].map(|share| segment.point_at(share)));
    let places: Vec<Point> = places.collect();
    for scale in SCALES {
        let near = |place: &Point| drawn.walls().near(place + shift, None, budget);
        let measured = places.iter().filter_map(near);
        let mut measured: Vec<(f64, Vector)> = measured
            .map(|near| (near.left, left_normal(near.way)))
            .collect();
        measured.sort_by(|one, other| one.0.total_cmp(&other.0));
        let Some((middle, _)) = measured.get(measured.len() / 2).copied() else {
            return shift;
        };
        let (mut sums, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for (left, normal) in &measured {
            let off = left - middle;
            let weight = 1.0 / (1.0 + (off / scale).powi(2));
            let row = Vector3::new(normal.x, normal.y, -1.0);
            sums += weight * row * row.transpose();
            right += -weight * off * row;
        }
        let Some(solved) = sums.try_inverse().map(|inverse| inverse * right) else {
            return shift;
        };
        let by = solved.xy();
        if by.norm() > NEAR || !by.x.is_finite() {
            return shift;
        }
        shift += by;
    }
    shift
}
