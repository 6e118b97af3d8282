//! Which blocks run along a contour, and how far beside it.
//!
//! A block runs along a contour where it is as far from it at both ends as in its middle. Blocks in sequence that run
//! equally far beside the same contour in one direction are a run: a pass, or what a wrong block leaves of one. A way in
//! or out runs along none.

use super::budget::Budget;
use super::traced::{Block, Traced};
use super::walls::Walls;
use crate::geometry::{Segment, Vector};
use std::ops::Range;

/// Where along a block its distance is measured.
const SHARES: [f64; 3] = [0.5, 0.1, 0.9];
/// Distances are the same within this, µm: blocks are rounded to the grid at both ends.
pub(super) const LEVEL: f64 = 3.0;
/// A shorter block says nothing of a distance, µm.
const SHORTEST: f64 = 20.0;
/// So many blocks are looked at, from the first on: a counting machine drifts over more of them.
const LOOKED_AT: usize = 1_000;
/// So many runs may lie between two parts of one.
const BETWEEN: usize = 4;

/// Blocks at one distance beside one contour.
#[derive(Clone, Debug)]
pub(super) struct Run {
    pub(super) contour: usize,
    /// It goes against the direction of the contour.
    pub(super) back: bool,
    stretch: usize,
    /// The first block.
    pub(super) first: usize,
    /// Of all of them, µm, and as a share of the contour's, or of what is looked at.
    pub(super) length: f64,
    pub(super) share: f64,
    /// The distance of each and its length, µm; positive to the left of the contour's direction.
    lefts: Vec<(f64, f64)>,
}

impl Run {
    /// Of how many blocks it is.
    pub(super) fn count(&self) -> usize {
        self.lefts.len()
    }

    /// How far beside the contour half of its length lies, µm.
    pub(super) fn offset(&self) -> f64 {
        let mut all = self.lefts.clone();
        all.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut left = self.length / 2.0;
        let middle = all.iter().find(|(_, length)| {
            left -= length;
            left <= 0.0
        });
        middle.map_or(0.0, |(left, _)| *left)
    }
}

/// A block as a run of its own.
fn alone(
    walls: &Walls,
    (first, block): (usize, &Block),
    by: Vector,
    budget: &Budget,
) -> Option<Run> {
    let segment: Segment = block.segment()?.moved(by);
    let length = segment.length();
    if length < SHORTEST {
        return None;
    }
    let [middle, begin, end] = SHARES.map(|share| segment.point_at(share));
    let near = walls.near(middle, None, budget)?;
    let is_level = [begin, end].into_iter().all(|place| {
        let other = walls.near(place, Some(near.contour), budget);
        other.is_some_and(|other| {
            (other.distance - near.distance).abs() <= LEVEL
                && (near.distance <= LEVEL || other.left * near.left > 0.0)
        })
    });
    is_level.then_some(Run {
        contour: near.contour,
        back: near.way.dot(&segment.tangent_at(0.5)) < 0.0,
        stretch: block.stretch,
        first,
        length,
        share: 0.0,
        lefts: vec![(near.left, length)],
    })
}

/// The runs of some blocks, in their order, where the program lies `by` from its stated places.
pub(super) fn runs(
    traced: &Traced,
    walls: &Walls,
    blocks: Range<usize>,
    by: Vector,
    budget: &Budget,
) -> Vec<Run> {
    let end = blocks.end.min(blocks.start + LOOKED_AT);
    let looked_at = || {
        traced
            .blocks
            .iter()
            .enumerate()
            .take(end)
            .skip(blocks.start)
    };
    let mut runs: Vec<Run> = Vec::new();
    for own in looked_at().filter_map(|block| alone(walls, block, by, budget)) {
        let is_one = |run: &&mut Run| {
            (run.contour, run.back, run.stretch) == (own.contour, own.back, own.stretch)
                && (run.lefts[0].0 - own.lefts[0].0).abs() <= LEVEL
        };
        match runs.iter_mut().rev().take(BETWEEN).find(is_one) {
            Some(run) => {
                run.length += own.length;
                run.lefts.extend(own.lefts);
            }
            None => runs.push(own),
        }
    }
    let lengths = looked_at().filter_map(|(_, block)| Some(block.segment()?.length()));
    let all = lengths.sum::<f64>().max(1.0);
    for run in &mut runs {
        let contour = walls.length(run.contour);
        // Of more than is looked at, the part.
        let whole = if end < blocks.end {
            contour.min(all)
        } else {
            contour
        };
        run.share = run.length / whole.max(1.0);
    }
    runs
}
