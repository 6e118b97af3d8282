//! The words of a line in whatever characters: look-alikes are read as what they look like.

#![warn(clippy::indexing_slicing)]

use super::cursor::scan;
use super::variables::Variables;
use super::word::{Number, Token, WordFault};
use crate::program::lookalikes::{Alike, alike};
use crate::text::{SourceText, shown};
use std::ops::Range;

/// Hands each token of a line, without its line end, to `each`, with its range counted from `offset`.
pub(crate) fn words(line: &[u8], offset: usize, each: impl FnMut(Token, Range<usize>)) {
    words_under(&mut Variables::default(), line, offset, each);
}

/// The same where the lines before have given values to variables, as this one may.
pub(super) fn words_under(
    variables: &mut Variables,
    line: &[u8],
    offset: usize,
    each: impl FnMut(Token, Range<usize>),
) {
    tokens(line, offset, offset == 0, variables, each);
}

/// The same for a line that may not begin with a byte order mark; ranges are counted from its start.
pub(crate) fn words_in(line: &[u8], each: impl FnMut(Token, Range<usize>)) {
    tokens(line, 0, false, &mut Variables::default(), each);
}

/// The text of a word of a line, in upper case.
pub(super) fn text_of(line: &[u8], range: &Range<usize>) -> String {
    let text = line.get(range.clone()).unwrap_or_default();
    shown(text.trim_ascii()).to_ascii_uppercase()
}

/// Hands the letter and the number of each word of a line to `each`, with its bytes in the text.
pub(super) fn words_at(
    text: &SourceText,
    line: usize,
    mut each: impl FnMut(u8, Number, Range<usize>),
) {
    let start = text.line_start(line);
    let mut variables = Variables::default();
    tokens(
        text.line(line),
        start,
        false,
        &mut variables,
        |token, range| {
            if let Token::Word { letter, number } = token {
                each(letter, number, range);
            }
        },
    );
}

/// The last of the words of a line that are wanted.
pub(crate) fn word_at(
    text: &SourceText,
    line: usize,
    wanted: impl Fn(u8, Number) -> bool,
) -> Option<Range<usize>> {
    let start = text.line_start(line);
    word_in(text.line(line), wanted).map(|word| start + word.start..start + word.end)
}

/// The same in a line by itself; its range is counted from the line's start.
pub(crate) fn word_in(line: &[u8], wanted: impl Fn(u8, Number) -> bool) -> Option<Range<usize>> {
    let mut found = None;
    words_in(line, |token, range| match token {
        Token::Word { letter, number } if wanted(letter, number) => found = Some(range),
        _ => {}
    });
    found
}

fn tokens(
    line: &[u8],
    offset: usize,
    may_have_mark: bool,
    variables: &mut Variables,
    mut each: impl FnMut(Token, Range<usize>),
) {
    if !line.is_ascii()
        && let Some(plain) = Plain::of(line)
    {
        let first = offset + plain.first.start..offset + plain.first.end;
        each(Token::Fault(WordFault::Lookalike), first);
        scan(&plain.bytes, 0, may_have_mark, variables, |token, range| {
            each(token, plain.placed(range, offset))
        });
        return;
    }
    scan(line, offset, may_have_mark, variables, each);
}

/// A line with its look-alikes replaced, and the place of each character in the text.
struct Plain {
    bytes: Vec<u8>,
    /// The place in the line of each byte, and of the end.
    places: Vec<usize>,
    /// The first look-alikes.
    first: Range<usize>,
}

impl Plain {
    /// `None` where the line's words have no look-alikes.
    fn of(line: &[u8]) -> Option<Plain> {
        let mut plain = Plain {
            bytes: Vec::with_capacity(line.len()),
            places: Vec::with_capacity(line.len() + 1),
            first: 0..0,
        };
        // A byte order mark is not one of them.
        let is_mark = |found: &Alike| {
            line.get(found.at..)
                .unwrap_or_default()
                .starts_with(b"\xef\xbb\xbf")
        };
        let mut others = alike(line)
            .into_iter()
            .filter(|found| !is_mark(found))
            .peekable();
        let (mut at, mut depth, mut is_wide) = (0, 0_usize, false);
        while let Some(own) = line.get(at) {
            let other = others.next_if(|found| found.at == at);
            let other =
                other.filter(|found| depth == 0 || (is_wide && found.likeness.ascii() == b')'));
            let length = other.map_or(1, |found| found.length);
            let byte = other.map_or(*own, |found| found.likeness.ascii());
            if other.is_some() {
                if plain.first.is_empty() {
                    plain.first = at..at + length;
                } else if plain.first.end == at {
                    plain.first.end = at + length;
                }
            }
            match byte {
                b'(' if depth == 0 => (depth, is_wide) = (1, other.is_some()),
                b'(' if !is_wide => depth += 1,
                b')' => depth = depth.saturating_sub(1),
                b';' if depth == 0 => depth = usize::MAX / 2,
                _ => {}
            }
            plain.bytes.push(byte);
            plain.places.push(at);
            at += length;
        }
        plain.places.push(line.len());
        (!plain.first.is_empty()).then_some(plain)
    }

    fn placed(&self, range: Range<usize>, offset: usize) -> Range<usize> {
        let at = |at: usize| self.places.get(at).copied().unwrap_or_default();
        offset + at(range.start)..offset + at(range.end)
    }
}

/// A line with its look-alikes replaced; `None` where it has none.
pub(crate) fn plain(line: &[u8]) -> Option<Vec<u8>> {
    Plain::of(line).map(|plain| plain.bytes)
}
