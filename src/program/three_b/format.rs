//! Brings the text of a program into a layout: the same blocks, words and comments, with the same effect.
//!
//! A line is rewritten from what the reader finds in it and read back before it counts. Damaged lines, headings and
//! lines whose new form would differ in meaning stay byte for byte as they are.

mod chunk;
mod guard;
mod line;
mod stand;

pub(crate) use self::guard::guarded;

use self::chunk::{Chunk, Line, count_blocks, has_end};
use self::line::{Formed, Writer};
use self::stand::Walk;
use crate::program::edits::{self, AT_ONCE, LineEdits};
use crate::program::three_b::layout::layout_in;
use crate::program::three_b::parse::{Item, read_line};
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
    let end = if layout == Layout::Checking {
        text.line_count()
    } else {
        lines.end.min(text.line_count())
    };
    let read = |first: usize| Chunk::read(text, words, first..(first + AT_ONCE).min(end));
    let firsts: Vec<usize> = (0..end).step_by(AT_ONCE).collect();
    let mut chunks: Vec<Chunk> = if firsts.len() > 2 {
        firsts.into_par_iter().map(read).collect()
    } else {
        firsts.into_iter().map(read).collect()
    };
    let numbers_count_blocks = numbers_count_blocks(&chunks);
    let mut walk = Walk::new(layout, ends);
    chunks.iter_mut().for_each(|chunk| walk.go_through(chunk));
    edits::formed(text, &chunks, |chunk| {
        chunk.form(text, words, (layout, ends), numbers_count_blocks, &lines)
    })
}

/// The layout in which most of the first blocks stand.
fn layout_of(text: &SourceText, words: &Words<'_>) -> Layout {
    // Compact, aligned, checking.
    let mut votes = [0_usize; 3];
    for line in 0..text.line_count() {
        let bytes = text.line(line);
        read_line(bytes, 0, words, |item| {
            let Item::Block {
                range, stated_end, ..
            } = item
            else {
                return;
            };
            let layout = match stated_end {
                Some(_) => Layout::Checking,
                None => layout_in(bytes.get(range).unwrap_or_default()),
            };
            votes[layout as usize] += 1;
        });
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
fn numbers_count_blocks(chunks: &[Chunk]) -> bool {
    let numbers = chunks
        .iter()
        .flat_map(|chunk| &chunk.items)
        .filter_map(|item| match item {
            Item::Block { number, .. } => Some(*number),
            _ => None,
        });
    numbers
        .zip(1_u32..)
        .all(|(number, ordinal)| number.is_none_or(|number| number == ordinal))
}

impl Chunk {
    /// The edits of those of its lines that are asked for.
    fn form(
        &self,
        text: &SourceText,
        words: &Words<'_>,
        (layout, ends): (Layout, Ends),
        numbers_count_blocks: bool,
        lines: &Range<usize>,
    ) -> LineEdits {
        let mut edits = LineEdits::default();
        let (mut ordinal, mut is_over, mut first) = (self.ordinal, self.is_over, 0);
        for (line, Line { end, is_sound }) in (self.first_line..).zip(&self.lines) {
            let (items, stated) = (&self.items[first..*end], &self.stated[first..*end]);
            if lines.contains(&line) {
                let pieces = Vec::new();
                let mut writer = Writer {
                    words,
                    layout,
                    ends,
                    numbers_count_blocks,
                    ordinal,
                    is_over,
                    items,
                    stated,
                    pieces,
                    is_sound: *is_sound,
                };
                if let Some(formed) = writer.form(text.line(line), text.line_end(line)) {
                    replace(&mut edits, text, line, formed);
                }
            }
            ordinal += count_blocks(items);
            is_over |= has_end(items);
            first = *end;
        }
        edits
    }
}

fn replace(edits: &mut LineEdits, text: &SourceText, line: usize, formed: Formed) {
    let range = text.line_range(line);
    let old = text.bytes().get(range.clone()).unwrap_or_default();
    let Formed { from, head, kept } = formed;
    let behind = TextEdit::new(range.start + kept.end..range.end, "");
    match std::str::from_utf8(old.get(kept.clone()).unwrap_or_default()) {
        // Only space at the end goes.
        Ok(_) if from >= old.len() => edits.push(text, 0..0, behind),
        Ok(kept) => {
            let new = TextEdit::new(range.start + from..range.end, head + kept);
            edits.push(text, line..line + 1, new);
        }
        // Bytes in another code page are not touched, so they are in no edit.
        Err(_) => {
            let before = range.start + from.min(kept.start)..range.start + kept.start;
            edits.push(text, 0..0, TextEdit::new(before, head));
            edits.push(text, 0..0, behind);
        }
    }
}

#[cfg(test)]
mod tests;
