//! Reads 3B and 4B text line by line: compact, spaced, aligned and checking layouts, with comments, block numbers and
//! coordinates.
//!
//! Lines are independent. An unreadable block gives one fault, and reading goes on after it; where the meaning is
//! plain (a lost `B`, `B25` for `N25`), the block is read and the fault reported beside it. Text that does not look
//! like a block is handed out as [`Item::Text`]: only its place among the blocks distinguishes a heading from a fault.

#![warn(clippy::indexing_slicing)]

use super::around::before_comment;
use super::fault::{Flaw, SyntaxFault};
pub use super::line::Item;
use super::line::{BYTE_ORDER_MARK, Token, Tokens, readable, shown};
use super::words::Words;
use crate::program::lookalikes::{Likeness, alike, in_plain_letters};
use crate::text::{SourceText, head};
use std::ops::Range;

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
    let marked = line.strip_prefix(BYTE_ORDER_MARK).filter(|_| offset == 0);
    let offset = offset + marked.map_or(0, |_| BYTE_ORDER_MARK.len());
    let line = marked.unwrap_or(line);
    let plain = readable(line);
    match not_plain(line, &plain, words) {
        Some(mut fault) => {
            fault.shift(offset);
            each(Item::Fault(fault))
        }
        None => read_plain_line(&plain, offset, words, &mut each),
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
        read_plain_line(line, 0, words, &mut |item| match item {
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
    let script = match first.likeness {
        Likeness::Foreign(_) => say!(cyrillic_or_greek),
        _ => say!(full_width),
    };
    let (column, found) = (first.at + 1, shown(line.get(first.at..)?));
    let expected = say!(a_block_in_plain_letters_and_digits);
    let sentence = say!(
        found_letters_of_another_script,
        column,
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
    let mut tokens = Tokens::of(line, offset, words);
    // A block waits for the next item, because its coordinates stand after it.
    let mut waiting: Option<Item> = None;
    let mut number = None;
    while let Some(token) = tokens.next() {
        match token {
            Token::Comment => {}
            Token::Number(read) => number = Some(read),
            Token::Coordinates(end) => {
                if let Some(Item::Block { stated_end, .. }) = &mut waiting {
                    *stated_end = Some(end);
                }
                break;
            }
            Token::Item(mut item, faults) => {
                waiting.take().into_iter().for_each(&mut *each);
                faults.into_iter().map(Item::Fault).for_each(&mut *each);
                match &mut item {
                    Item::Block { number: own, .. } | Item::Word { number: own, .. } => {
                        *own = number.take().or(*own);
                    }
                    Item::Fault(fault) => match fault.flaw {
                        Flaw::Unreadable(_) => fault.number = number.take(),
                        // The rest of the line belongs to the place.
                        _ => return each(item),
                    },
                    _ => {}
                }
                waiting = Some(item);
            }
        }
    }
    waiting.into_iter().for_each(each);
}

#[cfg(test)]
mod tests;
