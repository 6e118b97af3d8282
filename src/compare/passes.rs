//! Which blocks of a cut are passes round a contour, and how far beside it they lie.
//!
//! A block lies beside a contour where it is as far from it at both ends as in its middle. Blocks in sequence that lie
//! equally far beside the same contour, in one direction, are a pass; a way in or out lies beside none.

use super::budget::Budget;
use super::traced::{Cut, Motion, Traced};
use super::walls::Walls;
use crate::geometry::{Segment, Vector};
use std::ops::Range;

/// Where along a block its distance is measured.
const SHARES: [f64; 3] = [0.5, 0.1, 0.9];
/// Distances are the same within this, µm: blocks are rounded to the grid at both ends.
const LEVEL: f64 = 3.0;
/// A shorter block says nothing of a distance, µm.
const SHORTEST: f64 = 20.0;
/// A pass goes round at least this much of its contour; the longest one of a cut at least round so much.
const PASS: f64 = 0.4;
const ONLY: f64 = 0.1;

/// Blocks that lie at one distance beside one contour.
#[derive(Clone, Debug)]
pub(super) struct Pass {
    /// All blocks from the end of the pass before, or of the cut, to the begin of the next one.
    pub(super) blocks: Range<usize>,
    /// The first and the last of them that lies so far beside the contour.
    pub(super) first: usize,
    pub(super) last: usize,
    pub(super) contour: usize,
    /// µm, positive to the left of the contour's direction.
    pub(super) offset: f64,
    /// It goes against the direction of the contour.
    pub(super) back: bool,
    /// It goes round, and is not what is left of a tab.
    pub(super) is_whole: bool,
}

/// A block beside a contour.
#[derive(Clone, Copy, Debug)]
struct Lies {
    contour: usize,
    left: f64,
    back: bool,
}

/// Blocks in sequence that lie alike.
struct Group {
    lies: Lies,
    stretch: usize,
    first: usize,
    last: usize,
    length: f64,
    lefts: Vec<(f64, f64)>,
}

fn lies(walls: &Walls, segment: &Segment, budget: &Budget) -> Option<Lies> {
    if segment.length() < SHORTEST {
        return None;
    }
    let [middle, first, last] = SHARES.map(|share| segment.point_at(share));
    let near = walls.near(middle, None, budget)?;
    let is_level = [first, last].into_iter().all(|place| {
        let other = walls.near(place, Some(near.contour), budget);
        other.is_some_and(|other| {
            (other.distance - near.distance).abs() <= LEVEL
                && (near.distance <= LEVEL || other.left * near.left > 0.0)
        })
    });
    let wall = walls.segment(&near)?;
    let share = wall.share_of(middle).clamp(0.0, 1.0);
    let along = wall.tangent_at(share).dot(&segment.tangent_at(0.5));
    is_level.then_some(Lies {
        contour: near.contour,
        left: near.left,
        back: along < 0.0,
    })
}

fn groups(
    traced: &Traced,
    walls: &Walls,
    (blocks, shift): (Range<usize>, Vector),
    budget: &Budget,
) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for index in blocks {
        let Some(block) = traced.blocks.get(index) else {
            continue;
        };
        let Motion::Cut(segment) = block.motion else {
            continue;
        };
        let Some(lies) = lies(walls, &segment.moved(shift), budget) else {
            continue;
        };
        let length = segment.length();
        let is_one = |group: &&mut Group| {
            let of = &group.lies;
            (of.contour, of.back) == (lies.contour, lies.back)
                && group.stretch == block.stretch
                && (of.left - lies.left).abs() <= LEVEL
        };
        match groups.iter_mut().rev().take(4).find(is_one) {
            Some(group) => {
                group.last = index;
                group.length += length;
                group.lefts.push((lies.left, length));
            }
            None => groups.push(Group {
                lies,
                stretch: block.stretch,
                first: index,
                last: index,
                length,
                lefts: vec![(lies.left, length)],
            }),
        }
    }
    groups
}

/// The passes of a cut, where it lies `shift` from its stated places.
pub(super) fn passes(
    traced: &Traced,
    walls: &Walls,
    cut: &Cut,
    shift: Vector,
    budget: &Budget,
) -> Vec<Pass> {
    let mut all = groups(traced, walls, (cut.blocks.clone(), shift), budget);
    let is_round = |group: &Group| group.length >= PASS * walls.length(group.lies.contour);
    let longest = all.iter().map(|group| group.length).fold(0.0, f64::max);
    let whole: Vec<Lies> = all
        .iter()
        .filter(|group| is_round(group))
        .map(|it| it.lies)
        .collect();
    let is_pass = |group: &Group| match whole.is_empty() {
        true => group.length == longest && longest >= ONLY * walls.length(group.lies.contour),
        // What is left of a tab is cut at the distances of the passes before it.
        false => whole.iter().any(|pass| {
            pass.contour == group.lies.contour && (pass.left - group.lies.left).abs() <= LEVEL
        }),
    };
    all.retain(is_pass);
    all.sort_by_key(|group| group.first);
    let starts: Vec<usize> = all.iter().map(|group| group.first).collect();
    let mut from = cut.blocks.start;
    let mut passes = Vec::new();
    for (number, group) in all.into_iter().enumerate() {
        // A group within another is a part of that pass that was changed.
        if group.first < from {
            continue;
        }
        let next = starts
            .iter()
            .skip(number + 1)
            .find(|start| **start > group.last);
        let to = next.copied().unwrap_or(cut.blocks.end);
        passes.push(Pass {
            blocks: from..to,
            first: group.first,
            last: group.last,
            contour: group.lies.contour,
            offset: median(group.lefts),
            back: group.lies.back,
            is_whole: group.length >= PASS * walls.length(group.lies.contour),
        });
        from = group.last + 1;
    }
    passes
}

/// How much of some blocks lies at one distance beside one contour, as a share of all; and the sum of their
/// lengths.
pub(super) fn share(
    traced: &Traced,
    walls: &Walls,
    blocks: Range<usize>,
    shift: Vector,
    budget: &Budget,
) -> f64 {
    let segments = traced.blocks.get(blocks.clone()).unwrap_or_default().iter();
    let segments = segments.filter_map(super::traced::Block::segment);
    let whole: f64 = segments.map(Segment::length).sum();
    let groups = groups(traced, walls, (blocks, shift), budget);
    let longest = groups.iter().map(|group| group.length).fold(0.0, f64::max);
    longest / whole.max(1.0)
}

/// The middle one of some values with their weights.
fn median(mut all: Vec<(f64, f64)>) -> f64 {
    all.sort_by(|one, other| one.0.total_cmp(&other.0));
    let half: f64 = all.iter().map(|(_, weight)| weight / 2.0).sum();
    let mut sum = 0.0;
    let middle = all.iter().find(|(_, weight)| {
        sum += weight;
        sum >= half
    });
    middle.map_or(0.0, |(value, _)| *value)
}
