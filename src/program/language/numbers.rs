//! Block numbers: renamed, counted anew, left out.

use super::words::{WordKind, words_of};
use crate::program::path::Step;
use crate::program::{Document, iso};
use crate::text::{TextEdit, WIDEST_COLUMN};
use std::ops::Range;

/// The block number at a byte: its bytes, and what it is.
pub fn number_at(document: &Document, offset: usize) -> Option<(Range<usize>, u32)> {
    let line = document.text().line_of(offset);
    let part = words_of(document, line).into_iter().find(|part| {
        part.kind == WordKind::Number && part.range.start <= offset && offset <= part.range.end
    })?;
    let digits = digits_in(document, &part.range)?;
    let text = std::str::from_utf8(document.text().bytes().get(digits.clone())?).ok()?;
    Some((digits, text.parse().ok()?))
}

/// The digits of a number word.
fn digits_in(document: &Document, word: &Range<usize>) -> Option<Range<usize>> {
    let bytes = document.text().bytes().get(word.clone())?;
    let start = bytes.iter().position(u8::is_ascii_digit)?;
    let length = bytes[start..]
        .iter()
        .take_while(|byte| byte.is_ascii_digit())
        .count();
    Some(word.start + start..word.start + start + length)
}

/// The edits that give the block at a byte another number, `20` or `N20`, and the calls of it.
///
/// Errors: no number there, a name that is no number, or one that another block has.
pub fn renamed(document: &Document, offset: usize, name: &str) -> Result<Vec<TextEdit>, String> {
    let (digits, number) = number_at(document, offset).ok_or("there is no block number here")?;
    if let Document::Iso(program) = document {
        return iso::refactor::renamed(program, digits, number, name);
    }
    let name = name.trim();
    let name = name.strip_prefix(['N', 'n']).unwrap_or(name).trim();
    let is_number =
        !name.is_empty() && name.len() <= 8 && name.bytes().all(|byte| byte.is_ascii_digit());
    let number: u32 = name
        .parse()
        .ok()
        .filter(|_| is_number)
        .ok_or_else(|| format!("{name:?} is no block number, expected up to 8 digits"))?;
    let line = document.text().line_of(offset);
    let trace = document.trace();
    if let Some(step) = trace
        .steps
        .iter()
        .find(|step| step.number == Some(number) && step.line != line)
    {
        return Err(format!("N{number} is the block in line {}", step.line + 1));
    }
    Ok(vec![TextEdit {
        range: digits,
        text: name.to_owned(),
    }])
}

/// The edits that number blocks from `first` on in steps of `step`, words left out: those of some lines, in the order of the text.
pub fn numbered(document: &Document, lines: Range<usize>, first: u32, step: u32) -> Vec<TextEdit> {
    let mut edits = Vec::new();
    let mut number = first;
    for (block, word) in blocks_of(document, lines) {
        match word.and_then(|word| digits_in(document, &word)) {
            Some(digits) => {
                let text = number.to_string();
                // Numbers that stand in columns keep them.
                let before = document
                    .text()
                    .bytes()
                    .get(..digits.start)
                    .unwrap_or_default();
                let room = before
                    .iter()
                    .rev()
                    .take_while(|byte| **byte == b' ')
                    .count();
                let start = digits.start
                    - text
                        .len()
                        .saturating_sub(digits.len())
                        .min(room.saturating_sub(1));
                let text = format!(
                    "{text:>width$}",
                    width = if room > 1 {
                        (digits.end - start).min(WIDEST_COLUMN)
                    } else {
                        0
                    }
                );
                edits.push(TextEdit {
                    range: start..digits.end,
                    text,
                });
            }
            None => edits.push(TextEdit {
                range: block.range.start..block.range.start,
                text: format!("N{number} "),
            }),
        }
        number = number.saturating_add(step);
    }
    let bytes = document.text().bytes();
    edits.retain(|edit| bytes.get(edit.range.clone()) != Some(edit.text.as_bytes()));
    edits
}

/// The edits that leave the block numbers of some lines out, with the space behind them.
pub fn without_numbers(document: &Document, lines: Range<usize>) -> Vec<TextEdit> {
    let edit = |(block, word): (Step, Option<Range<usize>>)| {
        let word = word?;
        let bytes = document
            .text()
            .bytes()
            .get(word.end..block.range.start.max(word.end))
            .unwrap_or_default();
        let space = bytes
            .iter()
            .take_while(|byte| matches!(byte, b' ' | b'\t'))
            .count();
        Some(TextEdit {
            range: word.start..word.end + space,
            text: String::new(),
        })
    };
    blocks_of(document, lines)
        .into_iter()
        .filter_map(edit)
        .collect()
}

/// The blocks of some lines in the order of the text, each with the number before it.
fn blocks_of(document: &Document, lines: Range<usize>) -> Vec<(Step, Option<Range<usize>>)> {
    let text = document.text();
    let bytes =
        text.line_start(lines.start)..text.line_start(lines.end).max(text.line_start(lines.start));
    let mut steps = document.steps_in(bytes);
    steps.retain(|step| lines.contains(&step.line) && step.moves());
    steps.sort_by_key(|step| step.range.start);
    // A subprogram runs more than once and stands once.
    steps.dedup_by_key(|step| step.range.start);
    let mut found = Vec::with_capacity(steps.len());
    let mut at = 0;
    for step in steps {
        let number = |part: &super::words::Part| {
            part.kind == WordKind::Number
                && part.range.start >= at
                && part.range.start < step.range.end
        };
        let word = words_of(document, step.line)
            .into_iter()
            .find(number)
            .map(|part| part.range);
        at = step.range.end;
        found.push((step, word));
    }
    found
}
