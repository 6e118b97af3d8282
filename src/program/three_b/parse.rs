//! Reads 3B and 4B text line by line: compact, spaced, aligned and checking layouts, with comments, block numbers and
//! coordinates.
//!
//! Lines are independent. An unreadable block gives one fault, and reading goes on after it; where the meaning is
//! plain (a lost `B`, `B25` for `N25`), the block is read and the fault reported beside it. Text that does not look
//! like a block is handed out as [`Item::Text`]: only its place among the blocks distinguishes a heading from a fault.

#![warn(clippy::indexing_slicing)]

use super::around::{StatedPoint, before_comment};
use super::block::{Block, PartArc};
use super::fault::{Flaw, SyntaxFault};
use super::tokens::{Token, Tokens, readable};
use super::words::{Word, Words};
use crate::program::lookalikes::{Likeness, alike, in_plain_letters};
use crate::text::{self, SourceText, head};
use std::ops::Range;

/// One item of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    Block {
        block: Block,
        /// From the first `B` to the quadrant.
        range: Range<usize>,
        /// `N12`, or the number of a row.
        number: Option<u32>,
        /// Absolute end point in mm after the block.
        stated_end: Option<StatedPoint>,
        /// The additional part of a 4B block.
        part: Option<PartArc>,
    },
    Word {
        word: Word,
        /// The word that the settings name, not one of another controller.
        is_own: bool,
        range: Range<usize>,
        number: Option<u32>,
    },
    /// `Start Point = x , y`, mm.
    StartPoint {
        at: [f64; 2],
        range: Range<usize>,
    },
    /// Neither block, word nor comment, nor a damaged block.
    Text {
        range: Range<usize>,
        column: usize,
    },
    /// A comment, from its mark on, with a sound block in it: the controller skips it.
    CommentedBlock {
        range: Range<usize>,
        column: usize,
    },
    Fault(SyntaxFault),
}

/// Reads a whole text; line ends are LF, CR LF and CR. Other text after the first block is a fault.
pub fn read(text: &[u8], words: &Words<'_>) -> (Vec<Item>, Vec<SyntaxFault>) {
    let (mut items, mut faults) = (Vec::new(), Vec::new());
    let mut has_block = false;
    let source = SourceText::new(text.to_vec());
    for line in 0..source.line_count() {
        let start = source.line_start(line);
        read_line(source.line(line), start, words, |item| match item {
            Item::Fault(fault) => faults.push(fault),
            Item::Text { range, column } if has_block => {
                faults.push(unexpected(text, range, column))
            }
            Item::Text { .. } | Item::CommentedBlock { .. } => {}
            item => {
                has_block |= matches!(item, Item::Block { .. });
                items.push(item);
            }
        });
    }
    (items, faults)
}

/// The fault of text between the blocks.
pub(super) fn unexpected(text: &[u8], range: Range<usize>, column: usize) -> SyntaxFault {
    let found = shown(text.get(range.clone()).unwrap_or_default());
    let sentence = say!(
        found_in_a_column,
        column,
        found,
        say!(a_block_or_word_or_comment_of_3b)
    );
    SyntaxFault::new(range, Flaw::Unreadable(sentence))
}

/// Reads one line, without its line end, and hands out its items. Ranges are counted from `offset`.
///
/// Full-width marks and spaces are read as the plain ones; letters and digits that only look like those of a block are
/// a fault.
pub fn read_line(line: &[u8], offset: usize, words: &Words<'_>, mut each: impl FnMut(Item)) {
    if line.is_ascii() {
        return read_plain_line(line, offset, words, &mut each);
    }
    let from = if offset == 0 && line.starts_with(b"\xef\xbb\xbf") {
        3
    } else {
        0
    };
    let line = line.get(from..).unwrap_or_default();
    let plain = readable(line);
    match not_plain(line, &plain, words) {
        Some(fault) => each(Item::Fault(fault.shifted(offset + from))),
        None => read_plain_line(&plain, offset + from, words, &mut each),
    }
}

/// The fault of a line that is a block or a word only in plain letters and digits.
fn not_plain(line: &[u8], readable: &[u8], words: &Words<'_>) -> Option<SyntaxFault> {
    let alike = alike(line);
    let code = before_comment(readable).len();
    let first = alike
        .iter()
        .find(|found| found.likeness.is_letter() && found.at < code)?;
    let says = |line: &[u8]| {
        let (mut says, mut number) = (false, None);
        read_plain_line(line, 1, words, &mut |item| match item {
            Item::Block { .. } | Item::Word { .. } => says = true,
            Item::Fault(fault) => number = number.or(fault.number),
            _ => {}
        });
        (says, number)
    };
    let plain = in_plain_letters(line, &alike);
    let (is_said, number) = says(readable);
    if is_said || !says(&plain).0 {
        return None;
    }
    let end = head(line, code).trim_ascii_end().len();
    let script = if matches!(first.likeness, Likeness::Foreign(_)) {
        say!(cyrillic_or_greek)
    } else {
        say!(full_width)
    };
    let found = shown(line.get(first.at..)?);
    let expected = say!(a_block_in_plain_letters_and_digits);
    let sentence = say!(
        found_letters_of_another_script,
        first.at + 1,
        found,
        expected,
        script
    );
    let range = first.at..end.max(first.at + first.length);
    Some(SyntaxFault {
        number,
        ..SyntaxFault::new(range, Flaw::NotPlain(sentence))
    })
}

fn read_plain_line(line: &[u8], offset: usize, words: &Words<'_>, each: &mut dyn FnMut(Item)) {
    let mut tokens = Tokens::of(line);
    // A block waits for the next token, because its coordinates stand after it.
    let mut waiting: Option<Item> = None;
    let mut number = None;
    while let Some((token, range)) = tokens.next(words) {
        let column = range.start + 1;
        let range = range.start + offset..range.end + offset;
        let item = match token {
            Token::Comment { holds_block: false } => continue,
            Token::Number(read) => {
                number = Some(read);
                continue;
            }
            Token::Coordinates(end) => {
                if let Some(Item::Block { stated_end, .. }) = &mut waiting {
                    *stated_end = Some(end);
                }
                continue;
            }
            Token::Block {
                block,
                part,
                row,
                faults,
            } => {
                waiting.take().into_iter().for_each(&mut *each);
                let placed = faults.into_iter().map(|fault| fault.shifted(offset));
                placed.map(Item::Fault).for_each(&mut *each);
                waiting = Some(Item::Block {
                    block,
                    range,
                    number: number.take().or(row),
                    stated_end: None,
                    part,
                });
                continue;
            }
            Token::Word { word, is_own } => Item::Word {
                word,
                is_own,
                range,
                number: number.take(),
            },
            Token::StartPoint(at) => Item::StartPoint { at, range },
            Token::Text => Item::Text { range, column },
            Token::Comment { .. } => Item::CommentedBlock { range, column },
            Token::FarStart => Item::Fault(SyntaxFault::new(range, Flaw::FarStart)),
            Token::DecimalCommas => Item::Fault(SyntaxFault::new(range, Flaw::DecimalCommas)),
            Token::Broken(expected) => {
                tokens.skip_broken_block();
                let found = line.get(range.start - offset..).unwrap_or_default();
                Item::Fault(SyntaxFault {
                    number: number.take(),
                    ..broken(found, column, range.start, expected)
                })
            }
        };
        waiting.take().into_iter().for_each(&mut *each);
        each(item);
    }
    waiting.into_iter().for_each(each);
}

/// The fault of a broken block; its range is the text there up to the next space. After the end there is nothing to
/// underline, so the last byte stands for it.
fn broken(rest: &[u8], column: usize, at: usize, expected: &str) -> SyntaxFault {
    let length = rest.iter().position(u8::is_ascii_whitespace);
    let length = length
        .unwrap_or(rest.len())
        .clamp(rest.len().min(1), rest.len());
    let (start, found) = if rest.is_empty() {
        let before = at - usize::from(column > 1);
        (before, say!(the_line_ends).to_owned())
    } else {
        (at, say!(found_something, shown(head(rest, length))))
    };
    let sentence = say!(expected_in_a_column, column, found, expected);
    SyntaxFault::new(start..at + length, Flaw::Unreadable(sentence))
}

/// The first characters of what was found.
fn shown(bytes: &[u8]) -> String {
    let mut words = bytes.split(u8::is_ascii_whitespace);
    text::shown(words.next().unwrap_or_default())
}

#[cfg(test)]
mod tests;
