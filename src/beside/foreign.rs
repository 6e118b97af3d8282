//! Cuts and passes of a program that follow nothing of its drawing.

use super::traced::{Block, Traced};
use super::walk::Walked;
use super::{BETWEEN, LEADS};
use crate::geometry::Segment;
use std::ops::Range;

/// Blocks of contours, and of passes, that follow nothing of the drawing.
pub(super) fn foreign(traced: &Traced, walked: &Walked) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    for [all, contour] in &traced.cuts {
        let runs = |range: Range<usize>| walked.runs[range].iter().any(|runs| *runs);
        if !runs(all.clone()) {
            let is_contour = !contour.is_empty() && closes(traced, contour);
            // One that does not come back is more than a way there and away.
            let is_more = || segments(&traced.blocks[all.clone()]).count() > LEADS;
            if is_contour {
                found.push(contour.clone());
            } else if contour.is_empty() && is_more() {
                found.push(all.start + 1..all.end);
            }
            continue;
        }
        let mut from = all.start;
        for index in all.clone().chain([all.end]) {
            let is_end = index == all.end || walked.runs[index];
            if is_end {
                let is_named = walked.unlike.iter().any(|unlike| {
                    (from..index).contains(&unlike.block) || unlike.block + 1 == from
                });
                let is_switched =
                    || traced.blocks[from].stretch != traced.blocks[index - 1].stretch;
                if index - from > BETWEEN + 2 && !is_named && !is_switched() {
                    found.push(from..index);
                }
                from = index + 1;
            }
        }
        found.extend(switched(traced, walked, all.clone()));
    }
    found
}

/// Among these blocks those between which the correction is on, and of which none follows anything or is named: the
/// text itself says that they are a pass.
fn switched(traced: &Traced, walked: &Walked, all: Range<usize>) -> Vec<Range<usize>> {
    let blocks = &traced.blocks[all.clone()];
    let mut at = all.start;
    let passes = blocks.chunk_by(|one, other| one.stretch == other.stretch);
    let passes = passes.map(|pass| {
        at += pass.len();
        at - pass.len()..at
    });
    let is_foreign = |pass: &Range<usize>| {
        let cut = segments(&traced.blocks[pass.clone()]).count();
        traced.blocks[pass.start].is_offset()
            && cut > LEADS
            && !walked.runs[pass.clone()].iter().any(|runs| *runs)
    };
    // Without the way in.
    let passes = passes.filter(is_foreign);
    passes.map(|pass| pass.start + 1..pass.end).collect()
}

/// A way from one place to another is no contour.
fn closes(traced: &Traced, contour: &Range<usize>) -> bool {
    let mut own = segments(&traced.blocks[contour.clone()]);
    let Some(first) = own.next() else {
        return false;
    };
    let (count, last) = own.fold((1, first), |(count, _), segment| (count + 1, segment));
    count > 2 || first.as_arc().is_some() || last.as_arc().is_some()
}

pub(super) fn segments(blocks: &[Block]) -> impl Iterator<Item = Segment> {
    blocks.iter().filter_map(|block| block.segment().copied())
}
