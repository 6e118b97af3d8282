//! The lexer of a line of 3B or 4B: blocks, words, numbers of rows, coordinates, comments. Every line falls into such
//! tokens, damaged ones too. What each is, is decided here and nowhere else: [`super::parse`] reads a program by them,
//! [`super::pieces`] cuts a line for an editor.

#![warn(clippy::indexing_slicing)]

use super::around::{
    Place, StatedPoint, before_comment, is_end, looks_like_a_block, named_block, near_place,
    number, place_in, row_of_word, start_point, wants_to_be_a_block,
};
use super::block::{Block, PartArc};
use super::fault::{Flaw, SyntaxFault};
use super::fields::{Scan, is_sound};
use super::words::{Word, Words, switch, word_of};
use crate::program::lookalikes::with_plain_marks;
use crate::text::{self, head};
use std::borrow::Cow;
use std::ops::Range;

/// Places in a comment at which a block is tried.
const MOST_LOOKS: usize = 64;

/// Before the first line of some texts.
pub(super) const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

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

pub(super) enum Token {
    /// `N12` before a block.
    Number(u32),
    /// Absolute end point after a block. A program ignores the rest of the line.
    Coordinates(StatedPoint),
    Comment,
    /// Anything else, and the faults with which a block is read all the same.
    Item(Item, Vec<SyntaxFault>),
}

/// A line as it is read: full-width marks become plain ones, each at its place.
pub(super) fn readable(line: &[u8]) -> Cow<'_, [u8]> {
    if let Some(behind) = line.strip_prefix(BYTE_ORDER_MARK) {
        return Cow::Owned([b"   ", &*readable(behind)].concat());
    }
    with_plain_marks(line).map_or(Cow::Borrowed(line), Cow::Owned)
}

/// The position in a line.
#[derive(Clone, Copy)]
pub(super) struct Tokens<'a> {
    line: &'a [u8],
    /// Where the line begins in the text that ranges are counted in.
    offset: usize,
    words: &'a Words<'a>,
    /// After the last token.
    pub(crate) at: usize,
    /// A block has been read in this line.
    behind_block: bool,
}

impl<'a> Tokens<'a> {
    pub(super) fn of(line: &'a [u8], offset: usize, words: &'a Words<'a>) -> Tokens<'a> {
        Tokens {
            line,
            offset,
            words,
            at: 0,
            behind_block: false,
        }
    }

    fn rest(&self) -> &'a [u8] {
        self.line.get(self.at..).unwrap_or_default()
    }

    pub(super) fn skip_space(&mut self) {
        // 0x1A ends a text of DOS; bars and commas part the columns of a table.
        let is_space = |byte: &&u8| matches!(byte, b' ' | b'\t' | 0x0b | 0x0c | 0x1a | b'|' | b',');
        self.at += self.rest().iter().take_while(is_space).count();
    }

    pub(super) fn next(&mut self) -> Option<Token> {
        self.skip_space();
        let rest = self.rest();
        let &byte = rest.first()?;
        match byte {
            b'T' | b't' => {
                if let Some(length) = switch(rest) {
                    return Some(self.taken(length, Token::Comment));
                }
            }
            b';' => return Some(self.behind_semicolon()),
            // Some writers open with a heading between rows of stars; brackets and slashes open comments elsewhere.
            b'*' | b'#' | b'%' | b'\'' | b'"' | b'/' => return Some(self.comment()),
            b'(' => {
                let number = number(rest).filter(|_| !self.behind_block);
                return Some(match number {
                    Some((number, length)) => self.taken(length, Token::Number(number)),
                    None => self.comment(),
                });
            }
            _ => {}
        }
        // A column of names before the blocks: `AB`, `1-2`, a word in another script.
        if !self.behind_block
            && !matches!(byte, b'B' | b'b' | b'N' | b'n')
            && let Some(block) = named_block(self.line, self.at, self.words)
        {
            self.at = block;
            return Some(self.word_or_block());
        }
        match byte {
            0x80.. if looks_like_a_block(before_comment(rest)) => {
                return Some(self.broken(self.at, say!(a_block_in_plain_letters_and_digits)));
            }
            0x80.. => return Some(self.taken(rest.len(), Token::Comment)),
            b'0'..=b'9' | b'-' | b'+' | b'.' if self.behind_block => {
                let code = before_comment(rest);
                if let Some(token) = near_place(code).and_then(|place| self.place(place, code)) {
                    return Some(token);
                }
            }
            b'0'..=b'9' => {
                if let Some((number, length)) =
                    number(rest).or_else(|| row_of_word(rest, self.words))
                {
                    return Some(self.taken(length, Token::Number(number)));
                }
            }
            _ => {}
        }
        Some(self.word_or_block())
    }

    fn behind_semicolon(&mut self) -> Token {
        let rest = self.rest();
        let comment = rest.get(1..).unwrap_or_default();
        if let Some(place) = start_point(comment) {
            return self.header(place);
        }
        // The numbers may be as long as they are.
        let end = memchr::memchr(b';', comment).unwrap_or(comment.len());
        let place = place_in(head(comment, end));
        let token = place.and_then(|place| self.place(place, head(rest, end + 1)));
        token.unwrap_or_else(|| self.comment())
    }

    /// The coordinates in `code`, which begins here; `None` where they are no place of a machine.
    fn place(&mut self, place: Place, code: &[u8]) -> Option<Token> {
        let start = self.at;
        self.at += code.trim_ascii_end().len();
        match place {
            Place::At(point) => Some(Token::Coordinates(point)),
            Place::DecimalCommas => {
                let is_between = |byte: &u8| *byte == b';' || byte.is_ascii_whitespace();
                let first = code.iter().position(|byte| !is_between(byte));
                Some(self.flawed(start + first.unwrap_or(0), self.at, Flaw::DecimalCommas))
            }
            Place::Far => {
                self.at = start;
                None
            }
        }
    }

    /// The start of a program, up to the end of the line.
    fn header(&mut self, place: Place) -> Token {
        let start = std::mem::replace(&mut self.at, self.line.len());
        match place {
            Place::At(StatedPoint { at, .. }) => {
                let range = self.placed(start, self.at);
                Token::Item(Item::StartPoint { at, range }, Vec::new())
            }
            Place::Far => self.flawed(start, self.at, Flaw::FarStart),
            Place::DecimalCommas => self.flawed(start, self.at, Flaw::DecimalCommas),
        }
    }

    /// A token of this many bytes.
    fn taken(&mut self, length: usize, token: Token) -> Token {
        self.at += length;
        token
    }

    /// What is left of the line, without the space at its end, and its column.
    fn take_rest(&mut self) -> (Range<usize>, usize) {
        let start = self.at;
        self.at = self.line.len();
        let end = self.line.trim_ascii_end().len();
        (self.placed(start, end), start + 1)
    }

    /// A comment from its mark on, and whether a sound block stands in it.
    fn comment(&mut self) -> Token {
        let mut looks = memchr::memchr2_iter(b'B', b'b', self.rest()).take(MOST_LOOKS);
        let holds_block = looks.any(|at| is_sound(self.line, self.at + at));
        let (range, column) = self.take_rest();
        match holds_block {
            true => Token::Item(Item::CommentedBlock { range, column }, Vec::new()),
            false => Token::Comment,
        }
    }

    fn word_or_block(&mut self) -> Token {
        let read = |tokens: &Tokens<'_>| Scan::at(tokens.line, tokens.at).meaning();
        // Nearly all blocks are sound; whatever else begins with a B may be a word as well.
        let begins = matches!(self.rest().first(), Some(b'B' | b'b'));
        let found = begins.then(|| read(self));
        if !matches!(&found, Some(Ok(found)) if found.is_sound())
            && let Some(word) = self.word()
        {
            return word;
        }
        match found.unwrap_or_else(|| read(self)) {
            Ok(mut found) => {
                self.at = found.fields.end;
                self.behind_block = true;
                let block = Item::Block {
                    block: found.block,
                    range: self.placed(found.fields.first, self.at),
                    number: found.row,
                    stated_end: None,
                    part: found.part,
                };
                let faults = found.faults.iter_mut();
                faults.for_each(|fault| fault.shift(self.offset));
                Token::Item(block, found.faults)
            }
            Err((at, expected)) => self.broken(at, expected),
        }
    }

    /// What is no block, not even a broken one.
    fn word(&mut self) -> Option<Token> {
        let rest = self.rest();
        let letters = word_of(rest);
        if let Some(word) = self.words.meaning(letters) {
            let word = Item::Word {
                word,
                is_own: self.words.is_own(letters),
                range: self.placed(self.at, self.at + letters.len()),
                number: None,
            };
            return Some(self.taken(letters.len(), Token::Item(word, Vec::new())));
        }
        if let Some(place) = start_point(rest) {
            return Some(self.header(place));
        }
        let number = number(rest).filter(|_| matches!(rest.first(), Some(b'N' | b'n')));
        if let Some((number, length)) = number {
            return Some(self.taken(length, Token::Number(number)));
        }
        if wants_to_be_a_block(rest) {
            return None;
        }
        if self.is_remark() || !rest.iter().any(u8::is_ascii_alphanumeric) {
            return Some(self.taken(rest.len(), Token::Comment));
        }
        let (range, column) = self.take_rest();
        Some(Token::Item(Item::Text { range, column }, Vec::new()))
    }

    /// Words after a block without the mark of a comment: at least two letters, after a space.
    fn is_remark(&self) -> bool {
        let rest = self.rest();
        let is_letter = |byte: &&u8| byte.is_ascii_alphabetic();
        let letters = rest.iter().take_while(is_letter).count();
        let before = self.at.checked_sub(1).and_then(|at| self.line.get(at));
        let stands_apart = matches!(before, Some(b' ' | b'\t' | b'|'));
        let is_bare = letters >= 2 && !rest.get(letters).is_some_and(u8::is_ascii_digit);
        self.behind_block && stands_apart && is_bare
    }

    /// The fault of a block that is broken at a byte; its range is the text there up to the next space. After the end
    /// there is nothing to underline, so the last byte stands for it. Reading goes on after the quadrant at the end of
    /// the block, where more blocks may follow.
    fn broken(&mut self, at: usize, expected: &str) -> Token {
        let rest = self.line.get(at..).unwrap_or_default();
        let length = rest.iter().position(u8::is_ascii_whitespace);
        let end = at + length.unwrap_or(rest.len()).max(rest.len().min(1));
        let (start, found) = match self.line.get(at..end) {
            Some(found @ [_, ..]) => (at, say!(found_something, shown(found))),
            _ => (at.saturating_sub(1), say!(the_line_ends).to_owned()),
        };
        let sentence = say!(expected_in_a_column, at + 1, found, expected);
        let comment = memchr::memchr(b';', rest).unwrap_or(rest.len());
        let quadrant = head(rest, comment).windows(2).position(is_end);
        self.at = at + quadrant.map_or(rest.len(), |before| before + 2);
        self.behind_block |= quadrant.is_some();
        self.flawed(start, end, Flaw::Unreadable(sentence))
    }

    fn flawed(&self, start: usize, end: usize, flaw: Flaw) -> Token {
        let fault = SyntaxFault::new(self.placed(start, end), flaw);
        Token::Item(Item::Fault(fault), Vec::new())
    }

    /// Places of the line in the whole text.
    fn placed(&self, start: usize, end: usize) -> Range<usize> {
        start + self.offset..end + self.offset
    }
}

/// The first characters of what was found.
pub(super) fn shown(bytes: &[u8]) -> String {
    let mut words = bytes.split(u8::is_ascii_whitespace);
    text::shown(words.next().unwrap_or_default())
}
