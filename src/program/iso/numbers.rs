//! Block numbers: how they are written; calls follow.

use super::document::Document;
use super::order::labels;
use super::plain::word_at;
use crate::program::numbering::{NumberedBlock, Numbers};
use crate::text::{SourceText, TextEdit};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Words of some controls that name a block and are not followed here.
const UNKNOWN_CALLS: [&str; 5] = ["M97", "G25", "GOTO", "CALL", "M96"];

impl Numbers for Document {
    const STEP: u32 = 10;

    fn blocks(&self) -> Result<Vec<NumberedBlock>, String> {
        refuse_unknown_calls(self)?;
        let text = self.text();
        let block = |line: usize| {
            let block = self.block(line);
            NumberedBlock {
                start: text.line_start(line),
                word: block.number.and_then(|_| number_word(text, line)),
                is_counted: !block.empty && block.program.is_none(),
                is_called: block.number.is_some_and(|number| self.calls(number)),
            }
        };
        Ok((0..text.line_count()).map(block).collect())
    }

    fn written(&self, block: &NumberedBlock, number: u32) -> Result<TextEdit, String> {
        let number = format!("N{number}");
        match &block.word {
            Some(word) => Ok(TextEdit::new(word.clone(), number)),
            None => {
                let line = self.text().line_of(block.start);
                let edit = self.with_word(line, &number);
                edit.ok_or_else(|| say!(that_line_is_in_another_code_page, line + 1))
            }
        }
    }

    /// Those of called programs and of calls that lead elsewhere: a block with one would be called in its place.
    fn taken(&self) -> Vec<u32> {
        let Some(order) = self.order() else {
            return Vec::new();
        };
        let is_program = |line: &usize| self.block(*line).program.is_some();
        let is_taken = |called: &&u32| order.labels.get(called).is_none_or(is_program);
        order.called.iter().filter(is_taken).copied().collect()
    }

    fn other_with(&self, number: u32, own: usize) -> Result<Option<usize>, String> {
        refuse_unknown_calls(self)?;
        let other = labels(self.text()).get(&number).copied();
        Ok(other.filter(|line| *line != own))
    }

    fn calls_follow(&self, own: usize, old: u32, new: u32) -> Vec<TextEdit> {
        match self.called_line(old) == Some(own) {
            true => calls(self, |called| (called == old).then_some(new)),
            false => Vec::new(),
        }
    }

    /// Where a line gets its number and holds a call, both are one edit.
    fn followed(&self, mut edits: Vec<TextEdit>, given: &[(NumberedBlock, u32)]) -> Vec<TextEdit> {
        let text = self.text();
        // From old to new numbers, by the line that a call of them leads to.
        let renamed = given.iter().filter_map(|(block, new)| {
            block.word.as_ref()?;
            let line = text.line_of(block.start);
            let old = self.block(line).number?;
            (self.called_line(old) == Some(line)).then_some((old, *new))
        });
        let renamed: FxHashMap<u32, u32> = renamed.collect();
        for call in calls(self, |called| renamed.get(&called).copied()) {
            let holds = |edit: &&mut TextEdit| {
                edit.range.start <= call.range.start && call.range.end <= edit.range.end
            };
            match edits.iter_mut().find(holds) {
                Some(whole) => {
                    let old = text.bytes().get(whole.range.clone()).unwrap_or_default();
                    let grown = whole.text.len() - String::from_utf8_lossy(old).len();
                    let place = |byte: usize| byte - whole.range.start + grown;
                    let within = place(call.range.start)..place(call.range.end);
                    whole.text.replace_range(within, &call.text);
                }
                None => edits.push(call),
            }
        }
        edits
    }
}

/// The P words of calls, with the numbers that `renamed` gives them.
fn calls(document: &Document, renamed: impl Fn(u32) -> Option<u32>) -> Vec<TextEdit> {
    let text = document.text();
    let mut edits = Vec::new();
    for line in 0..text.line_count() {
        if let Some(new) = document.block(line).call.and_then(&renamed)
            && let Some(word) = word_at(text, line, |letter, _| letter == b'P')
        {
            edits.push(TextEdit::new(word, format!("P{new}")));
        }
    }
    edits
}

pub(super) fn number_word(text: &SourceText, line: usize) -> Option<Range<usize>> {
    word_at(text, line, |letter, _| letter == b'N')
}

fn refuse_unknown_calls(document: &Document) -> Result<(), String> {
    let text = document.text().bytes().to_ascii_uppercase();
    match UNKNOWN_CALLS
        .iter()
        .find(|word| memchr::memmem::find(&text, word.as_bytes()).is_some())
    {
        Some(word) => Err(say!(a_word_may_call_a_block_by_its_number, word)),
        None => Ok(()),
    }
}
