//! Finds one changed block that explains all differences.
//!
//! A walk names a changed block where it can tell it from a lead, a tab or another pass. Where it is unsure, each block
//! near the named ones is tried: if it is laid as the drawing has it, does all the rest follow?

use super::edits::edits;
use super::members::Members;
use super::placement::Placement;
use super::rounds::Rounds;
use super::traced::Traced;
use super::walk::{Kind, Unlike, Walked};
use crate::geometry::Vector;

/// Blocks before and after a named one that are tried, and the blocks that all tries together may read.
const ABOUT: usize = 3;
const MOST: usize = 60_000;
/// Two explanations after which the rest is off by less than this more or less leave it as well explained, µm.
const AS_WELL: f64 = 0.5;

/// The one block that explains all.
pub(super) struct Only {
    pub unlike: Unlike,
    /// The program with that block as it should be, on its drawing.
    pub repaired: Traced,
    pub walked: Walked,
    /// How far all other blocks are off together, µm: the less, the likelier.
    rest: f64,
}

impl Only {
    /// Whether it is likelier than another: where the rest follows as well, the smaller change.
    pub(super) fn is_likelier(&self, other: &Only) -> bool {
        match (self.rest - other.rest).abs() < AS_WELL {
            true => self.unlike.off < other.unlike.off,
            false => self.rest < other.rest,
        }
    }
}

/// A program of which every block follows, and the sum of their deviations, µm.
type Whole<'a> = &'a dyn Fn(&Traced, Placement) -> Option<(Walked, f64)>;

/// The one block that explains it best, by no more than `most` µm; `None` where none does.
pub(super) fn single(
    traced: &Traced,
    rounds: &Rounds,
    placement: Placement,
    named: &[Unlike],
    most: f64,
    whole: Whole,
) -> Option<Only> {
    let mut tried: Vec<usize> = Vec::new();
    for away in 0..=ABOUT {
        for unlike in named {
            for index in [unlike.block.checked_sub(away), Some(unlike.block + away)] {
                let is_cut = |index: &usize| {
                    let block = traced.blocks.get(*index);
                    block.is_some_and(|block| block.segment().is_some())
                };
                tried.extend(index.filter(is_cut));
            }
        }
    }
    tried.extend(Members::breaks(traced, rounds, placement));
    tried.sort_unstable();
    tried.dedup();
    let mut members = Members::new(traced, placement);
    let mut at = 0;
    let mut before = std::collections::BTreeMap::new();
    for &index in &tried {
        (at..index).for_each(|block| members.take(traced, rounds, block));
        at = index;
        before.insert(index, members.clone());
    }
    tried.sort_by_key(|index| named.iter().all(|unlike| unlike.block != *index));
    let mut fuel = MOST / traced.blocks.len().max(1);
    let mut best: Option<Only> = None;
    'tries: for index in tried {
        let members = &before[&index];
        for edit in edits(traced, rounds, members, index) {
            if edit.off > most {
                continue;
            }
            if fuel == 0 {
                break 'tries;
            }
            fuel -= 1;
            let repaired = edit.of(traced);
            // Where the program lies may have been found before the change, or after it.
            let there = (!members.is_broken).then_some(placement);
            let is_moved = edit.by != Vector::zeros();
            let moved = is_moved.then(|| placement.moved(edit.by));
            let mut places = there.into_iter().chain(moved);
            let Some((walked, rest)) = places.find_map(|place| whole(&repaired, place)) else {
                continue;
            };
            let unlike = Unlike {
                block: edit.named(),
                source: edit.source,
                off: edit.off,
                kind: Kind::Block,
            };
            let only = Only {
                unlike,
                repaired,
                walked,
                rest,
            };
            if best.as_ref().is_none_or(|best| only.is_likelier(best)) {
                best = Some(only);
            }
        }
    }
    best
}
