//! The other passes of a contour as evidence: a move that one of them has, too, is hardly wrong.

use super::around::{LONGEST, cut_around};
use super::scan::{Line, Scanned};
use super::shape::{Passes, Shape, backwards, shape, shapes};
use crate::program::iso::block::{Block, Compensation};
use crate::program::iso::document::Document;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// How much another pass says for a change after which one more move is one of its moves, or against one after which one
/// less is.
const SAYS: f64 = 2.5;

/// The least moves of a cut that has passes.
const FEWEST: usize = 4;

impl Passes {
    /// Those of the cuts before and after some lines, or of the lines themselves where the correction is switched on in
    /// them several times; `None` where they are no passes of one contour.
    pub(super) fn beside(
        document: &Document,
        lines: &Range<usize>,
        way: &Scanned<'_>,
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

    /// What they say against other lines in the place of `count` ones, and how many lines were run for it.
    pub(super) fn against(
        &self,
        way: &Scanned<'_>,
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
