//! What stands before the first `%`: a control reads tape from there on, and nothing before it.

#![warn(clippy::indexing_slicing)]

use super::block::Block;
use crate::text::SourceText;

/// Lines among which the first `%` is searched for, and those behind it among which its program begins.
const LOOKED_AT: usize = 64;

/// How many lines stand before the `%` with which the program begins; 0 where they are only comments, or one of them
/// moves the wire, sets its place, calls or ends: such a text ends with its first `%`, or is cut in two by it.
pub(super) fn leader(text: &SourceText) -> usize {
    let count = text.line_count();
    let begins = |line: &usize| {
        let bytes = text.line(*line);
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        bytes.trim_ascii_start().starts_with(b"%")
    };
    let Some(tape) = (0..count.min(LOOKED_AT)).find(begins) else {
        return 0;
    };
    let block = |line: usize| Block::of(text.line(line));
    // In a remark something always cannot be read: `PLATE 10 X 20 MM`.
    let runs = |block: &Block| {
        let acts = block.leads()
            || block.motion.is_some()
            || block.stop.is_some()
            || block.call.is_some()
            || block.returns
            || block.sets_position
            || block.program.is_some();
        acts && !block.broken
    };
    let before: Vec<Block> = (0..tape).map(block).collect();
    let says_anything = before.iter().any(|block| !block.empty);
    let mut behind = (tape..count.min(tape + LOOKED_AT)).map(block);
    let is_leader = says_anything && !before.iter().any(runs) && behind.any(|block| !block.empty);
    if is_leader { tape } else { 0 }
}
