//! A program of ours: its blocks beside those of the program that is written again.
//!
//! Blocks are aligned by how far they lead, wherever the program lies: `B1000B0B1000GXL1` is the same block everywhere.
//! Where the two programs part, both are searched a few blocks ahead for where they agree again, so the work grows with
//! their length. Where nine of ten blocks agree the program is ours, and each of the others is named.

use super::TOLERANCE;
use super::aligned::{Aligned, PLACED, Row};
use super::difference::{Comparison, Difference};
use super::drawn::Drawn;
use super::leads::leads;
use super::traced::{Block, Motion, Traced};
use super::words::{Words, of_corrections};
use crate::finding::DifferenceKind;
use crate::geometry::Vector;

/// What differs in a program that we would write; `None` where we would not.
pub(super) fn compare(
    drawn: &Drawn,
    traced: &Traced,
    handles: Option<Vec<String>>,
) -> Option<Comparison> {
    // Each contour takes a block at least.
    let count = handles.as_ref().map_or(drawn.contours().len(), Vec::len);
    if traced.blocks.len() < count {
        return None;
    }
    let rewritten = &*drawn.rewritten(traced, handles)?;
    let aligned = Aligned::of(traced, rewritten)?;
    // Another depth, or another wear, is another number of layers: it is another program.
    let [own, ideal] = [traced, &rewritten.traced].map(|all| all.blocks.len());
    if traced.mills && own.abs_diff(ideal) > 1 {
        return None;
    }
    let mut differences = aligned.blocks();
    differences.extend(leads(&aligned)?);
    differences.extend(of_corrections(&aligned));
    differences.sort_by_key(|one| one.range.start);
    let follows = aligned.rows.iter().filter_map(|row| match row {
        Row::Both { own, ideal } if aligned.source(*ideal).is_some() => {
            Some(traced.blocks.get(*own)?.range.clone())
        }
        _ => None,
    });
    Some(Comparison {
        follows: follows.collect(),
        differences,
    })
}

impl Aligned<'_> {
    /// Blocks of contours, stops and coordinates after blocks that differ.
    fn blocks(&self) -> Vec<Difference> {
        let mut found: Vec<Difference> = Vec::new();
        // Where the last named block was, and how far from its place it began: until the program is back there, what
        // follows is a part of the same change.
        let mut change: Option<(usize, Vector)> = None;
        for (row, beside) in self.rows.iter().enumerate() {
            let is_next = |(named, _): &(usize, Vector)| row - named <= 2;
            match *beside {
                Row::Both { own, ideal } => {
                    let Some((block, meant)) = self.pair(own, ideal) else {
                        continue;
                    };
                    let words = Words::of(self, block, meant);
                    let off = words.off(block, meant);
                    if off <= TOLERANCE {
                        change = None;
                        if words.stated > TOLERANCE {
                            let kind = DifferenceKind::Stated;
                            found.push(Difference::of(block, None, words.stated, kind));
                        }
                        continue;
                    }
                    if words.are_same {
                        continue;
                    }
                    let [begins, ends] = self.ends_away(own, ideal).unwrap_or_default();
                    let is_back = |(_, away): &(usize, Vector)| (ends - away).norm() <= PLACED;
                    if change
                        .take_if(|change| is_next(change))
                        .is_some_and(|change| is_back(&change))
                    {
                        continue;
                    }
                    change = Some((row, begins));
                    let source = self.source(ideal);
                    if source.is_some() {
                        let kind = DifferenceKind::Block;
                        found.push(Difference::of(block, source, off, kind));
                    }
                }
                Row::Lost { own, ideal } => {
                    let last = self.traced.blocks.len() - 1;
                    let Some((block, meant)) = self.pair(own.min(last), ideal) else {
                        continue;
                    };
                    if meant.motion == Motion::Stop {
                        let before = own.checked_sub(1).and_then(|at| self.traced.blocks.get(at));
                        let is_bare =
                            before.is_some_and(|before| self.traced.is_bare_between(before, block));
                        if is_bare {
                            let kind = DifferenceKind::Unstopped;
                            found.push(Difference::of(block, None, 0.0, kind));
                        }
                        continue;
                    }
                    if change.take_if(|change| is_next(change)).is_some() {
                        continue;
                    }
                    found.push(self.gap(block, meant, ideal));
                }
                Row::More { own } => {
                    let Some(block) = self.traced.blocks.get(own) else {
                        continue;
                    };
                    if block.motion == Motion::Stop
                        || change.take_if(|change| is_next(change)).is_some()
                    {
                        continue;
                    }
                    found.push(self.gap(block, block, usize::MAX));
                }
            }
        }
        found
    }

    /// A block at which one is lost, or which is too many: `whole` long.
    fn gap(&self, block: &Block, whole: &Block, ideal: usize) -> Difference {
        let length = whole
            .motion
            .ends()
            .map_or(0.0, |[start, end]| (end - start).norm());
        let source = self.source(ideal);
        let kind = match source.is_some() || ideal == usize::MAX {
            true => DifferenceKind::Block,
            false => DifferenceKind::Lead,
        };
        Difference::of(block, source, length, kind)
    }
}
