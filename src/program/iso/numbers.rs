//! Block numbers: renumbered, removed, renamed; calls follow.
//!
//! ```text
//! M98 P7                     M98 P40
//! M02                   →    N30 M02
//! N7 G01 X1.                 N40 G01 X1.
//! ```

use super::block::Block;
use super::document::Document;
use super::layout::is_parted;
use super::line::with_word;
use super::order::{called, labels};
use super::plain::word_at;
use crate::text::{SourceText, TextEdit};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Words of some controls that name a block and are not followed here.
const UNKNOWN_CALLS: [&str; 5] = ["M97", "G25", "GOTO", "CALL", "M96"];

/// Numbers in steps of `step`, for every line with a word for the machine.
pub(super) fn numbered(document: &Document, step: u32) -> Result<Vec<TextEdit>, String> {
    refuse_unknown_calls(document)?;
    let text = document.text();
    let parted = is_parted(text);
    let mut edits = Vec::new();
    // From old to new numbers, by the line that a call of them leads to.
    let labels = labels(text);
    let mut renamed: FxHashMap<u32, u32> = FxHashMap::default();
    // A block with the number of a called program, or of a block elsewhere that is called, would be
    // called instead.
    let taken: Vec<u32> = called(text)
        .into_iter()
        .filter(|called| {
            labels
                .get(called)
                .is_none_or(|&line| is_program(text, line))
        })
        .collect();
    let mut number = step;
    for line in 0..text.line_count() {
        let block = document.block(line);
        if block.empty || block.program.is_some() {
            continue;
        }
        while taken.contains(&number) && number < u32::MAX {
            number = number.saturating_add(step);
        }
        match (block.number, number_word(text, line)) {
            (Some(old), Some(word)) => {
                if labels.get(&old) == Some(&line) {
                    renamed.insert(old, number);
                }
                edits.push(TextEdit::new(word, format!("N{number}")));
            }
            _ => {
                let new = with_word(text.line(line), &format!("N{number}"), parted);
                let new = String::from_utf8(new)
                    .map_err(|_| say!(that_line_is_in_another_code_page, line + 1))?;
                edits.push(TextEdit::new(text.line_range(line), new));
            }
        }
        number = number.saturating_add(step);
    }
    // Where a line gets its number and holds a call, both are one edit.
    let calls = calls(document, |called| renamed.get(&called).copied());
    for call in calls {
        match edits
            .iter_mut()
            .find(|edit| edit.range.start <= call.range.start && call.range.end <= edit.range.end)
        {
            Some(whole) => {
                let old = String::from_utf8_lossy(
                    text.bytes().get(whole.range.clone()).unwrap_or_default(),
                )
                .into_owned();
                let within =
                    call.range.start - whole.range.start..call.range.end - whole.range.start;
                let grown = whole.text.len() - old.len();
                whole
                    .text
                    .replace_range(within.start + grown..within.end + grown, &call.text);
            }
            None => edits.push(call),
        }
    }
    Ok(text.changing(edits))
}

/// True where a line begins a program (`O`).
fn is_program(text: &SourceText, line: usize) -> bool {
    Block::of(text.line(line)).program.is_some()
}

/// Removes all numbers that are not called.
pub(super) fn without_numbers(document: &Document) -> Result<Vec<TextEdit>, String> {
    refuse_unknown_calls(document)?;
    let text = document.text();
    let called = called(text);
    let mut edits = Vec::new();
    for line in 0..text.line_count() {
        let number = document.block(line).number;
        if let (Some(number), Some(word)) = (number, number_word(text, line))
            && !called.contains(&number)
        {
            edits.push(text.without_word(&word));
        }
    }
    Ok(edits)
}

/// The edits that give a block another number, whose digits stand at `digits`; calls of it follow.
///
/// Errors: a name that is no number, or one that another block has.
pub(crate) fn renamed(
    document: &Document,
    digits: Range<usize>,
    old: u32,
    name: &str,
    new: u32,
) -> Result<Vec<TextEdit>, String> {
    refuse_unknown_calls(document)?;
    let (text, labels) = (document.text(), labels(document.text()));
    let own = text.line_of(digits.start);
    if let Some(line) = labels.get(&new).filter(|line| **line != own) {
        return Err(say!(the_number_is_that_of_another_block, new, line + 1));
    }
    let mut edits = vec![TextEdit::new(digits, name.to_owned())];
    if labels.get(&old) == Some(&own) {
        edits.extend(calls(document, |called| (called == old).then_some(new)));
    }
    edits.sort_by_key(|edit| edit.range.start);
    Ok(edits)
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
