//! Cuts a line of 3B or 4B into tokens: blocks, words, numbers of rows, coordinates, comments. Every line falls into
//! tokens, damaged ones too; [`super::parse`] gives their meaning for a program, [`super::pieces`] for an editor.

#![warn(clippy::indexing_slicing)]

use super::around::{
    StartPoint, StatedPoint, before_comment, has_decimal_commas, is_remark, label,
    looks_like_a_block, n_word, point_in, row_number, row_of_word, start_point, stated_point,
    wants_to_be_a_block,
};
use super::block::{Block, PartArc};
use super::fault::SyntaxFault;
use super::fields::found_in;
use super::scan::Scan;
use super::words::{Word, Words, switch, word_of};
use crate::program::lookalikes::with_plain_marks;
use crate::text::head;
use std::borrow::Cow;
use std::ops::Range;

/// Places in a comment at which a block is tried.
const MOST_LOOKS: usize = 64;

pub(super) enum Token {
    /// `N12` before a block.
    Number(u32),
    /// Absolute end point after a block.
    Coordinates(StatedPoint),
    /// Coordinates with commas for points.
    DecimalCommas,
    /// `Start Point = x , y` at no place of a machine.
    FarStart,
    /// A block, with any fault with which it is read all the same; its range goes from the first `B` to the quadrant.
    Block {
        block: Block,
        part: Option<PartArc>,
        /// The row number before the first `B`.
        row: Option<u32>,
        faults: Vec<SyntaxFault>,
    },
    Word {
        word: Word,
        is_own: bool,
    },
    /// `Start Point = x , y`, mm.
    StartPoint([f64; 2]),
    Comment {
        holds_block: bool,
    },
    /// Neither block, word nor comment, nor a damaged block.
    Text,
    /// An unreadable block: reading stopped at its place, with this expectation.
    Broken(&'static str),
}

/// A line as it is read: full-width marks become plain ones, each at its place.
pub(super) fn readable(line: &[u8]) -> Cow<'_, [u8]> {
    if line.is_ascii() {
        return Cow::Borrowed(line);
    }
    with_plain_marks(line).map_or(Cow::Borrowed(line), Cow::Owned)
}

/// The position in a line.
pub(super) struct Tokens<'a> {
    line: &'a [u8],
    /// After the last token.
    pub(crate) at: usize,
    /// A block has been read in this line.
    behind_block: bool,
    /// Of the last token that may have been a block, from its place on.
    pub(crate) scan: Scan,
}

impl<'a> Tokens<'a> {
    pub(super) fn of(line: &'a [u8]) -> Tokens<'a> {
        Tokens {
            line,
            at: 0,
            behind_block: false,
            scan: Scan::default(),
        }
    }

    fn from(&self, at: usize) -> &'a [u8] {
        self.line.get(at..).unwrap_or_default()
    }

    fn peek(&self) -> Option<u8> {
        self.line.get(self.at).copied()
    }

    pub(super) fn skip_space(&mut self) {
        // 0x1A ends a text of DOS; bars and commas part the columns of a table.
        while matches!(
            self.peek(),
            Some(b' ' | b'\t' | 0x0b | 0x0c | 0x1a | b'|' | b',')
        ) {
            self.at += 1;
        }
    }

    /// The next token and its place. After coordinates the rest of the line is ignored.
    pub(super) fn next(&mut self, words: &Words<'_>) -> Option<(Token, Range<usize>)> {
        self.skip_space();
        let start = self.at;
        let byte = self.peek()?;
        let rest = self.from(start);
        if let Some(length) = switch(rest) {
            return Some(self.taken(length, Token::Comment { holds_block: false }));
        }
        // A column of names before the blocks: `AB`, `1-2`, a word in another script.
        if !self.behind_block && !matches!(byte, b'B' | b'b' | b'N' | b'n') {
            self.at += label(rest, words).unwrap_or(0);
        }
        match byte {
            _ if self.at > start => {}
            b';' => return Some(self.behind_semicolon(start)),
            // Some writers open with a heading between rows of stars; brackets and slashes open comments elsewhere.
            b'*' | b'#' | b'%' | b'\'' | b'"' | b'/' => return Some(self.comment(start)),
            0x80.. if looks_like_a_block(before_comment(rest)) => {
                return Some(self.broken(start, say!(a_block_in_plain_letters_and_digits)));
            }
            0x80.. => return Some(self.rest_of_line(start, Token::Comment { holds_block: false })),
            b'(' => match row_number(rest) {
                Some((number, length)) if !self.behind_block => {
                    return Some(self.taken(length, Token::Number(number)));
                }
                _ => return Some(self.comment(start)),
            },
            b'0'..=b'9' | b'-' | b'+' | b'.' if self.behind_block => {
                let code = before_comment(rest);
                if let Some(end) = stated_point(code) {
                    return Some(self.within(start, code, Token::Coordinates(end)));
                }
                if has_decimal_commas(code) {
                    return Some(self.within(start, code, Token::DecimalCommas));
                }
            }
            b'0'..=b'9' | b'-' | b'+' | b'.' => {
                if let Some((number, length)) =
                    row_number(rest).or_else(|| row_of_word(rest, words))
                {
                    return Some(self.taken(length, Token::Number(number)));
                }
            }
            _ => {}
        }
        Some(self.word_or_block(words))
    }

    fn behind_semicolon(&mut self, start: usize) -> (Token, Range<usize>) {
        let comment = self.from(start + 1);
        if let Some(stated) = start_point(comment) {
            return self.header(start, stated);
        }
        // The numbers may be as long as they are.
        let end = memchr::memchr(b';', comment).unwrap_or(comment.len());
        let coordinates = head(comment, end);
        if has_decimal_commas(coordinates) {
            let code = before_comment(comment);
            return self.within(start + 1, code, Token::DecimalCommas);
        }
        match point_in(coordinates) {
            Some(point) => {
                let code = head(self.from(start), end + 1);
                self.within(start, code, Token::Coordinates(point))
            }
            None => self.comment(start),
        }
    }

    fn header(&mut self, start: usize, stated: StartPoint) -> (Token, Range<usize>) {
        match stated {
            StartPoint::At(at) => self.rest_of_line(start, Token::StartPoint(at)),
            StartPoint::Far => self.rest_of_line(start, Token::FarStart),
            StartPoint::DecimalCommas => self.rest_of_line(start, Token::DecimalCommas),
        }
    }

    /// A token of this many bytes.
    fn taken(&mut self, length: usize, token: Token) -> (Token, Range<usize>) {
        let start = self.at;
        self.at += length;
        (token, start..self.at)
    }

    /// A token that stands in `code`, without the space about it; the rest of the line is ignored.
    fn within(&mut self, from: usize, code: &[u8], token: Token) -> (Token, Range<usize>) {
        self.at = self.line.len();
        let before = code.len() - code.trim_ascii_start().len();
        (token, from + before..from + code.trim_ascii_end().len())
    }

    /// A token up to the end of the line.
    fn rest_of_line(&mut self, start: usize, token: Token) -> (Token, Range<usize>) {
        self.at = self.line.len();
        (token, start..self.at)
    }

    /// A comment from its mark on, and whether a sound block stands in it.
    fn comment(&mut self, start: usize) -> (Token, Range<usize>) {
        let rest = self.from(start);
        let holds_block = memchr::memchr2_iter(b'B', b'b', rest)
            .take(MOST_LOOKS)
            .any(|at| {
                rest.get(at..)
                    .and_then(|text| Scan::of(text).sound())
                    .is_some()
            });
        self.within(start, rest, Token::Comment { holds_block })
    }

    fn word_or_block(&mut self, words: &Words<'_>) -> (Token, Range<usize>) {
        let start = self.at;
        let rest = self.from(start);
        self.scan.read(rest, false);
        if let Some((block, part, length)) = self.scan.sound() {
            self.behind_block = true;
            let token = Token::Block {
                block,
                part,
                row: None,
                faults: Vec::new(),
            };
            return self.taken(length, token);
        }
        let letters = word_of(rest);
        if !letters.is_empty()
            && let Some(word) = words.meaning(letters)
        {
            let is_own = words.is_own(letters);
            return self.taken(letters.len(), Token::Word { word, is_own });
        }
        if let Some(stated) = start_point(rest) {
            return self.header(start, stated);
        }
        if matches!(rest.first(), Some(b'N' | b'n'))
            && let Some((number, length)) = n_word(rest)
        {
            return self.taken(length, Token::Number(number));
        }
        if !wants_to_be_a_block(rest) {
            let is_comment = self.behind_block && is_remark(self.line, start, words)
                || !rest.iter().any(u8::is_ascii_alphanumeric);
            let token = match is_comment {
                true => Token::Comment { holds_block: false },
                false => Token::Text,
            };
            return self.within(start, rest, token);
        }
        match found_in(rest, &self.scan) {
            Ok(found) => {
                self.at += found.fields.end;
                self.behind_block = true;
                let shifted = |fault: SyntaxFault| fault.shifted(start);
                let token = Token::Block {
                    block: found.block,
                    part: found.part,
                    row: found.row,
                    faults: found.faults.into_iter().map(shifted).collect(),
                };
                (token, start + found.fields.first..self.at)
            }
            Err((at, expected)) => self.broken(start + at, expected),
        }
    }

    /// Reading of a block stops at a byte.
    fn broken(&mut self, at: usize, expected: &'static str) -> (Token, Range<usize>) {
        self.at = at;
        (Token::Broken(expected), at..at)
    }

    /// Goes past the quadrant at the end of a broken block, where more blocks may follow, or to the end.
    pub(super) fn skip_broken_block(&mut self) {
        let rest = self.from(self.at);
        let comment = memchr::memchr(b';', rest).unwrap_or(rest.len());
        let is_end = |window: &[u8]| matches!(window, [b'L' | b'R' | b'l' | b'r', b'1'..=b'4']);
        match head(rest, comment).windows(2).position(is_end) {
            Some(end) => {
                self.at += end + 2;
                self.behind_block = true;
            }
            None => self.at = self.line.len(),
        }
    }
}
