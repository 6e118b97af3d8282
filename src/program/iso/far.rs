//! Lengths beyond any machine: in the words of the wire's way, of its upper end, and of heights. Those of the table of
//! corrections are judged with that.

#![warn(clippy::indexing_slicing)]

use super::block::{Block, Code};
use super::moves::{FARTHEST_MM, Reading};
use super::plain::words_in;
use super::read::Run;
use super::word::{Number, Token};
use crate::finding::{Fault, Finding, Rule};
use crate::text::shown;
use std::ops::Range;

impl Code {
    /// A length stands in it that leads something beside the wire's lower end.
    pub(super) fn measures(self) -> bool {
        self.is_of_guide() || self.is_height()
    }
}

impl Run<'_> {
    /// What is said of a line that leads farther than any machine.
    pub(super) fn too_far(&self, block: &Block, range: (u32, u32)) -> Option<Finding> {
        let range = range.0 as usize..range.1 as usize;
        let letter = self.after.leads_too_far(block, &self.reading)?;
        let sentence = say!(coordinate_beyond_any_machine, letter, FARTHEST_MM);
        Some(Finding::of(
            Fault::said(Rule::TooManyDigits, sentence),
            range,
        ))
    }

    /// The same of the first word of a line that leads something else; the line begins at `offset`.
    pub(super) fn beside_too_far(
        &self,
        line: &[u8],
        offset: usize,
        block: &Block,
    ) -> Option<Finding> {
        let inch = block.inch.unwrap_or(self.after.inch);
        let mut found: Option<Range<usize>> = None;
        words_in(line, |token, own| {
            if found.is_none() && is_too_far(&token, line.get(own.clone()), &self.reading, inch) {
                found = Some(own);
            }
        });
        let found = found?;
        let word = shown(line.get(found.clone()).unwrap_or_default());
        let sentence = say!(word_beyond_any_machine, word, FARTHEST_MM);
        let range = offset + found.start..offset + found.end;
        Some(Finding::of(
            Fault::said(Rule::TooManyDigits, sentence),
            range,
        ))
    }
}

/// Whether a token that does not lead the wire's lower end holds a length that is too large.
fn is_too_far(token: &Token, text: Option<&[u8]>, reading: &Reading, inch: bool) -> bool {
    let is_far = |number: &Number| reading.is_too_far(*number, inch);
    match token {
        Token::Word { letter, number } => matches!(letter, b'U' | b'V' | b'Z') && is_far(number),
        // `: X… Y…`, `TP…`, `TN…`: the words after the first letter.
        Token::Foreign => {
            let Some([first @ (b':' | b'T' | b't'), rest @ ..]) = text else {
                return false;
            };
            let letters: &[u8] = if *first == b':' { b"XYIJRUV" } else { b"PN" };
            let mut is_any = false;
            words_in(rest, |token, _| {
                if let Token::Word { letter, number } = token {
                    is_any |= letters.contains(&letter) && is_far(&number);
                }
            });
            is_any
        }
        _ => false,
    }
}
