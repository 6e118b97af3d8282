//! Block numbers: which blocks have one, and how it is written.

use super::document::Document;
use super::layout::number_edit;
use super::pieces::{Field, pieces};
use crate::program::numbering::{NumberedBlock, Numbers};
use crate::program::path::Step;
use crate::text::TextEdit;
use std::ops::Range;

impl Numbers for Document {
    const STEP: u32 = 1;

    /// Those that move, each with the number before it.
    fn blocks(&self) -> Result<Vec<NumberedBlock>, String> {
        let text = self.text();
        let mut steps = self.trace().steps;
        steps.retain(Step::moves);
        let mut at = 0;
        let block = |step: Step| {
            let start = text.line_start(step.line);
            let words = pieces(text.line(step.line), &self.words()).into_iter();
            let numbers = words.filter(|piece| piece.field == Field::Number);
            let mut numbers =
                numbers.map(|piece| start + piece.range.start..start + piece.range.end);
            let word = numbers.find(|word| word.start >= at && word.start < step.range.end);
            at = step.range.end;
            NumberedBlock {
                start: step.range.start,
                word,
                is_counted: true,
                is_called: false,
            }
        };
        Ok(steps.into_iter().map(block).collect())
    }

    fn written(&self, block: &NumberedBlock, number: u32) -> Result<TextEdit, String> {
        let digits = block.word.as_ref();
        let digits = digits.and_then(|word| self.text().digits_in(word));
        Ok(self.with_number(digits, block.start, number))
    }

    fn other_with(&self, number: u32, own: usize) -> Result<Option<usize>, String> {
        let steps = self.trace().steps.into_iter();
        let mut others = steps.filter(|step| step.number == Some(number) && step.line != own);
        Ok(others.next().map(|step| step.line))
    }
}

impl Document {
    /// The edit that writes a number in the place of these digits, or before a block that has none.
    pub(super) fn with_number(
        &self,
        digits: Option<Range<usize>>,
        start: usize,
        number: u32,
    ) -> TextEdit {
        match digits {
            Some(digits) => number_edit(self.text().bytes(), digits, number),
            None => TextEdit::new(start..start, format!("N{number} ")),
        }
    }
}
