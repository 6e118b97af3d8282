//! Brings the text of a program into a layout: the same blocks, words and comments, with the same effect.
//!
//! A line is rewritten from what the reader finds in it and read back before it counts. Damaged lines, headings and
//! lines whose new form would differ in meaning stay byte for byte as they are.

mod guard;
mod line;
mod stand;

pub(crate) use self::guard::guarded;

use self::line::{Line, What, Writer};
use self::stand::Walk;
use crate::program::edits::{self, AT_ONCE, LineEdits};
use crate::program::three_b::layout::layout_in;
use crate::program::three_b::words::Words;
use crate::settings::Layout;
use crate::text::{SourceText, TextEdit};
use rayon::prelude::*;
use std::ops::Range;

/// Blocks that are read to find the layout of a text.
const LOOKED_AT: usize = 1000;

/// What becomes of end points and block numbers.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ends {
    /// They come and go with the layout.
    OfLayout,
    /// They stay as they stand, and none is added.
    Kept,
}

/// The edits that bring `lines` into a layout, sorted and disjoint.
///
/// Blocks, words, block numbers, comments and the header with the start stay. The other two layouts drop the block
/// numbers and end points of the checking layout together; an end point that is not the block's own is a fault and
/// stays in every layout. Each block gets a line of its own. Formatting twice equals formatting once.
fn format(
    text: &SourceText,
    layout: Layout,
    ends: Ends,
    words: &Words<'_>,
    lines: Range<usize>,
) -> Vec<TextEdit> {
    // The numbers of the checking layout depend on all blocks, everything else on those before.
    let end = match layout {
        Layout::Checking => text.line_count(),
        Layout::Compact | Layout::Aligned => lines.end.min(text.line_count()),
    };
    let read = (0..end).into_par_iter().with_min_len(AT_ONCE);
    let read = read.map(|line| Line::read(line, text.line(line), words));
    let mut all: Vec<Line> = read.collect();
    let mut walk = Walk::new(layout, ends);
    all.iter_mut().for_each(|line| walk.go_through(line));
    let writer = Writer {
        words,
        layout,
        ends,
        numbers_count_blocks: numbers_count_blocks(&all),
    };
    let asked = all.get(lines.start.min(end)..lines.end.min(end));
    let chunks: Vec<&[Line]> = asked.unwrap_or_default().chunks(AT_ONCE).collect();
    edits::formed(text, &chunks, |chunk| {
        let mut edits = LineEdits::default();
        chunk
            .iter()
            .for_each(|line| writer.form(line, text, &mut edits));
        edits
    })
}

/// The layout in which most of the first blocks stand.
fn layout_of(text: &SourceText, words: &Words<'_>) -> Layout {
    // Compact, aligned, checking.
    let mut votes = [0_usize; 3];
    for line in 0..text.line_count() {
        let bytes = text.line(line);
        for part in Line::read(line, bytes, words).parts {
            let layout = match part.stated_end {
                Some(_) => Layout::Checking,
                None => layout_in(bytes.get(part.range).unwrap_or_default()),
            };
            votes[layout as usize] += usize::from(matches!(part.what, What::Block(..)));
        }
        if votes.iter().sum::<usize>() >= LOOKED_AT {
            break;
        }
    }
    let most = votes.iter().copied().max().unwrap_or(0);
    match votes {
        [compact, ..] if compact == most => Layout::Compact,
        [_, aligned, _] if aligned == most => Layout::Aligned,
        _ => Layout::Checking,
    }
}

/// True where every block that has a number has its own ordinal.
fn numbers_count_blocks(lines: &[Line]) -> bool {
    let parts = lines.iter().flat_map(|line| &line.parts);
    let blocks = parts.filter(|part| matches!(part.what, What::Block(..)));
    let mut numbers = blocks.map(|block| block.number).zip(1_u32..);
    numbers.all(|(number, ordinal)| number.is_none_or(|number| number == ordinal))
}

#[cfg(test)]
mod tests;
