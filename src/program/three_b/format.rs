//! Brings the text of a program into a layout: the same blocks, words and comments, with the same effect.
//!
//! A line is rewritten from what the reader finds in it and read back before it counts. Damaged lines, headings and
//! lines whose new form would differ in meaning stay byte for byte as they are.

mod line;

use self::line::{Line, Writer};
use crate::program::edits::{self, AT_ONCE, LineEdits};
use crate::program::three_b::layout::layout_in;
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::words::{Word, Words};
use crate::settings::Layout;
use crate::text::{SourceText, TextEdit};
use rayon::prelude::*;
use std::ops::Range;

/// Blocks that are read to find the layout of a text.
const LOOKED_AT: usize = 1000;

/// The edits that bring `lines` into a layout, sorted and disjoint; without a layout, into that of most blocks.
///
/// Blocks, words, block numbers, end points, comments and the header with the start stay, and none is added. Each block
/// gets a line of its own. Formatting twice equals formatting once.
pub(crate) fn format(
    text: &SourceText,
    layout: Option<Layout>,
    words: &Words<'_>,
    lines: Range<usize>,
) -> Vec<TextEdit> {
    let end = lines.end.min(text.line_count());
    let read = (0..end).into_par_iter().with_min_len(AT_ONCE);
    let read = read.map(|line| Line::read(line, text.line(line), words));
    let mut all: Vec<Line> = read.collect();
    // Nothing after the end word is formatted.
    let ends = |item: &Item| matches!(item, Item::Word { word, .. } if *word == Word::End);
    let is_end = |line: &Line| line.items.iter().any(ends);
    if let Some(last) = all.iter().position(is_end) {
        all.truncate(last + 1);
    }
    let layout = layout.unwrap_or_else(|| layout_of(text, words));
    let writer = Writer { words, layout };
    let chunks: Vec<&[Line]> = all
        .get(lines.start..)
        .unwrap_or_default()
        .chunks(AT_ONCE)
        .collect();
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
    let (mut compact, mut aligned) = (0, 0);
    for line in 0..text.line_count() {
        let bytes = text.line(line);
        read_line(bytes, 0, words, |item| {
            if let Item::Block { range, .. } = item {
                match layout_in(bytes.get(range).unwrap_or_default()) {
                    Layout::Compact => compact += 1,
                    Layout::Aligned | Layout::Checking => aligned += 1,
                }
            }
        });
        if compact + aligned >= LOOKED_AT {
            break;
        }
    }
    match compact >= aligned {
        true => Layout::Compact,
        false => Layout::Aligned,
    }
}

#[cfg(test)]
mod tests;
