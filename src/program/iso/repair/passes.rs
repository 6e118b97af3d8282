//! The other passes of a contour as evidence: a move that one of them has, too, is hardly wrong.

use super::around::{LONGEST, cut_around};
use super::scan::{Line, Way};
use crate::program::iso::block::{Block, Compensation, Motion};
use crate::program::iso::document::Document;
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::{Bend, Move, Place, Reading, apart};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// How much another pass says for a change after which one more move is one of its moves, or against one after which one
/// less is.
const SAYS: f64 = 2.5;

/// The least moves of a cut that has passes.
const FEWEST: usize = 4;

/// From its start to its end, nm, and how it bends: from its start to its centre, or its radius, and whether it turns
/// left.
type Shape = (Place, Option<(Place, bool)>);

/// The moves of a contour's other passes, in either direction.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Passes {
    counts: FxHashMap<Shape, usize>,
    /// The moves of the cut itself are among them: its passes have no stop between them.
    holds_own: bool,
}

impl Passes {
    /// Those of the cuts before and after some lines, or of the lines themselves where the correction is switched on in
    /// them several times; `None` where they are no passes of one contour.
    pub(super) fn beside(
        document: &Document,
        lines: &Range<usize>,
        way: &Way<'_>,
    ) -> Option<Passes> {
        let own = shapes(way.reading, *way.machine_before(0), way.blocks());
        if own.len() < FEWEST {
            return None;
        }
        let is_on = |block: &&Block| {
            matches!(
                block.compensation,
                Some(Compensation::Left | Compensation::Right)
            )
        };
        let holds_own = way.blocks().filter(is_on).count() > 1;
        let mut counts = FxHashMap::default();
        let mut take = |shape: &Shape| {
            *counts.entry(*shape).or_default() += 1;
            *counts.entry(backwards(shape)).or_default() += 1;
        };
        if holds_own {
            own.iter().for_each(&mut take);
        } else {
            let last = document.text().line_count();
            let before = lines.start.checked_sub(1);
            let behind = (lines.end < last).then_some(lines.end);
            for line in [before, behind].into_iter().flatten() {
                let other = cut_around(document, line);
                let Some(machine) = document.machine_before(other.start) else {
                    continue;
                };
                if other.len() > LONGEST {
                    continue;
                }
                let blocks: Vec<Block> = other.map(|line| document.block(line)).collect();
                let its = shapes(way.reading, machine, blocks.iter());
                if its.len().abs_diff(own.len()) <= 1 {
                    its.iter().for_each(&mut take);
                }
            }
        }
        let passes = Passes { counts, holds_own };
        let known = own.iter().filter(|shape| passes.has(shape, true)).count();
        // Nearly all of it is as in another pass.
        (4 * known >= 3 * own.len() && known < own.len()).then_some(passes)
    }

    /// Whether another pass has a move; one that stands in the text is not its own witness.
    fn has(&self, shape: &Shape, stands: bool) -> bool {
        let count = self.counts.get(shape).copied().unwrap_or(0);
        count > usize::from(self.holds_own && stands)
    }

    /// What they say against other lines in the place of `count` ones, and how many lines were run for it.
    pub(super) fn against(
        &self,
        way: &Way<'_>,
        index: usize,
        count: usize,
        lines: &[Line],
    ) -> (f64, usize) {
        let rest = (index + count).min(way.lines.len());
        let before = *way.machine_before(index);
        let unlike = |own: &[Line], stands: bool| {
            let mut machine = before;
            let (mut found, mut runs) = (0_i32, 0);
            let mut take = |line: &Line| {
                runs += 1;
                let made = machine.run(&line.block, way.reading);
                let shape = made.as_ref().and_then(|made| shape(made, way.reading));
                found += i32::from(shape.is_some_and(|shape| !self.has(&shape, stands)));
                shape.is_some()
            };
            own.iter().for_each(|line| _ = take(line));
            // An absolute place decides about the next move as well.
            _ = way.lines[rest..].iter().any(&mut take);
            (found, runs)
        };
        let (was, one) = unlike(&way.lines[index..rest], true);
        let (is, other) = unlike(lines, false);
        (SAYS * f64::from((is - was).clamp(-2, 2)), one + other)
    }
}

fn shapes<'a>(
    reading: &Reading,
    mut machine: Machine,
    blocks: impl Iterator<Item = &'a Block>,
) -> Vec<Shape> {
    let made = blocks.filter_map(|block| machine.run(block, reading));
    made.filter_map(|made| shape(&made, reading)).collect()
}

/// `None` for a move without a cut or without a length.
fn shape(made: &Move, reading: &Reading) -> Option<Shape> {
    if !made.is_cut() || !made.goes_anywhere() {
        return None;
    }
    let turns_left = made.motion == Motion::CounterClockwise;
    let bend = made.is_arc().then(|| {
        let center = made.center(reading.rule(made.incremental));
        let bend = match (center, made.bend) {
            (Some(center), _) => apart(center, made.from),
            (None, Bend::Radius(radius)) => [radius, i64::MAX],
            (None, _) => [0, i64::MAX],
        };
        (bend, turns_left)
    });
    Some((apart(made.to, made.from), bend))
}

fn backwards((by, bend): &Shape) -> Shape {
    let bend = bend.map(|(center, turns_left)| {
        let is_radius = center[1] == i64::MAX;
        let center = if is_radius {
            center
        } else {
            apart(center, *by)
        };
        (center, !turns_left)
    });
    (apart([0, 0], *by), bend)
}
