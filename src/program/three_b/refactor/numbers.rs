//! The numbers of blocks.

use crate::program::path::Step;
use crate::program::three_b::Document;
use crate::program::three_b::layout::number_edit;
use crate::program::three_b::pieces::{Field, pieces};
use crate::text::TextEdit;
use std::ops::Range;

/// The edits that number the blocks from 1; words get no number.
pub(super) fn numbered(document: &Document) -> Vec<TextEdit> {
    let mut edits = Vec::new();
    for ((block, word), number) in blocks_of(document).into_iter().zip(1_u32..) {
        match word.and_then(|word| document.text().digits_in(&word)) {
            Some(digits) => edits.push(number_edit(document.text().bytes(), digits, number)),
            None => {
                let place = block.range.start..block.range.start;
                edits.push(TextEdit::new(place, format!("N{number} ")));
            }
        }
    }
    document.text().changing(edits)
}

/// The edits that leave the block numbers out, with the space behind them.
pub(super) fn without_numbers(document: &Document) -> Vec<TextEdit> {
    let edit = |(_, word): (Step, Option<Range<usize>>)| Some(document.text().without_word(&word?));
    blocks_of(document).into_iter().filter_map(edit).collect()
}

/// The blocks, each with the number before it.
fn blocks_of(document: &Document) -> Vec<(Step, Option<Range<usize>>)> {
    let text = document.text();
    let mut steps = document.trace().steps;
    steps.retain(Step::moves);
    let mut at = 0;
    let block = |step: Step| {
        let (start, words) = (
            text.line_start(step.line),
            pieces(text.line(step.line), &document.words()),
        );
        let mut numbers = words
            .into_iter()
            .filter(|piece| piece.field == Field::Number)
            .map(|piece| start + piece.range.start..start + piece.range.end);
        let word = numbers.find(|word| word.start >= at && word.start < step.range.end);
        at = step.range.end;
        (step, word)
    };
    steps.into_iter().map(block).collect()
}
