//! Reading 3B and 4B text line by line: compact, spaced, aligned and checking layouts, with comments, block numbers and coordinates.
//!
//! What a line says hangs on no other line. A block that cannot be read gives one fault, and reading goes on behind it; where it is
//! plain what was meant (a lost `B`, `B25` for `N25`), the block is read and the fault said beside it. Text that looks like no block
//! is handed out as [`Item::Text`]: only its place among the blocks tells a heading from a fault.

#![warn(clippy::indexing_slicing)]

use super::around::{
    StatedPoint, before_comment, has_decimal_commas, is_remark, label, looks_like_a_block, n_word,
    point_in, row_number, row_of_word, start_point, stated_point, wants_to_be_a_block,
};
use super::block::{Block, PartArc};
use super::fault::{Flaw, SyntaxFault};
use super::fields;
use super::words::{Word, Words, word_of};
use crate::program::alike::{Likeness, alike, in_plain_letters, with_plain_marks};
use crate::text::{self, SourceText, head};
use std::ops::Range;

/// One thing that a line says.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    Block {
        block: Block,
        /// From the first `B` to the quadrant.
        range: Range<usize>,
        /// `N12`, or the number of a row.
        number: Option<u32>,
        /// Absolute end point in mm that stands behind the block.
        stated_end: Option<StatedPoint>,
        /// What a 4B block says beside a 3B block.
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
    /// Neither block, word nor comment, and nothing that wants to be a block.
    Text {
        range: Range<usize>,
        column: usize,
    },
    /// A comment, from its mark on, in which a sound block stands: the controller skips it.
    CommentedBlock {
        range: Range<usize>,
        column: usize,
    },
    Fault(SyntaxFault),
}

/// Reads a whole text; line ends are LF, CR LF and CR. Text that is no block, word or comment is a fault behind the first block.
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

/// Reads one line, without its line end, and hands out what it says. Ranges are counted from `offset`.
///
/// Marks and spaces as wide as a Chinese character are read as the plain ones; letters and digits that only look like those of a block
/// are a fault.
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
    let with_plain_marks = with_plain_marks(line);
    let readable = match &with_plain_marks {
        Some(plain) => plain,
        None => line,
    };
    if let Some(fault) = not_plain(line, readable, words) {
        let range = fault.range.start + offset + from..fault.range.end + offset + from;
        return each(Item::Fault(SyntaxFault { range, ..fault }));
    }
    read_plain_line(readable, offset + from, words, &mut each);
}

/// The fault of a line that only in plain letters and digits is a block or a word.
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
    let mut cursor = Cursor {
        line,
        at: 0,
        offset,
        behind_block: false,
    };
    // A block waits for the next token, because its coordinates stand behind it.
    let mut waiting: Option<Item> = None;
    let mut number = None;
    loop {
        match cursor.token(words) {
            Ok(Some(Token::Number(read))) => number = Some(read),
            Ok(Some(Token::Coordinates(end))) => {
                if let Some(Item::Block { stated_end, .. }) = &mut waiting {
                    *stated_end = Some(end);
                }
            }
            Ok(Some(Token::Item(mut item, faults))) => {
                waiting.take().into_iter().for_each(&mut *each);
                faults.into_iter().map(Item::Fault).for_each(&mut *each);
                if let Item::Block { number: own, .. } | Item::Word { number: own, .. } = &mut item
                {
                    *own = number.take().or(*own);
                }
                if matches!(item, Item::Block { .. }) {
                    waiting = Some(item);
                    cursor.behind_block = true;
                } else {
                    each(item);
                }
            }
            Ok(None) => break,
            Err(fault) => {
                waiting.take().into_iter().for_each(&mut *each);
                each(Item::Fault(SyntaxFault {
                    number: number.take(),
                    ..fault
                }));
                if !cursor.skip_broken_block() {
                    break;
                }
            }
        }
    }
    waiting.into_iter().for_each(each);
}

enum Token {
    /// `N12` before a block.
    Number(u32),
    Coordinates(StatedPoint),
    /// With what is wrong in a block that is read all the same. The number of a block is that of the row, which stands before its first
    /// `B`.
    Item(Item, Vec<SyntaxFault>),
}

impl From<Item> for Token {
    fn from(item: Item) -> Token {
        Token::Item(item, Vec::new())
    }
}

struct Cursor<'a> {
    line: &'a [u8],
    at: usize,
    offset: usize,
    /// A block has been read in this line.
    behind_block: bool,
}

impl<'a> Cursor<'a> {
    fn from(&self, at: usize) -> &'a [u8] {
        self.line.get(at..).unwrap_or_default()
    }

    fn peek(&self) -> Option<u8> {
        self.line.get(self.at).copied()
    }

    fn skip_space(&mut self) {
        // 0x1A ends a text of DOS; bars and commas part the columns of a table.
        while matches!(
            self.peek(),
            Some(b' ' | b'\t' | 0x0b | 0x0c | 0x1a | b'|' | b',')
        ) {
            self.at += 1;
        }
    }

    fn token(&mut self, words: &Words<'_>) -> Result<Option<Token>, SyntaxFault> {
        self.skip_space();
        let start = self.at;
        let Some(byte) = self.peek() else {
            return Ok(None);
        };
        let rest = self.from(start);
        match byte {
            b'B' | b'b' => {}
            // A column of names before the blocks: `AB`, `1-2`, a word in another script.
            _ if !self.behind_block
                && !matches!(byte, b'N' | b'n')
                && label(rest, words).is_some() =>
            {
                self.at += label(rest, words).unwrap_or(0)
            }
            b';' => {
                self.at = self.line.len();
                let comment = rest.get(1..).unwrap_or_default();
                if let Some(at) = start_point(comment) {
                    let range = self.range(start);
                    return Ok(Some(Item::StartPoint { at, range }.into()));
                }
                // Nothing else of the line is looked at behind this: the numbers may be as long as they are.
                let end = memchr::memchr(b';', comment).unwrap_or(comment.len());
                let coordinates = head(comment, end);
                if has_decimal_commas(coordinates) {
                    return Ok(Some(self.decimal_commas(start + 1).into()));
                }
                return match point_in(coordinates) {
                    Some(end) => Ok(Some(Token::Coordinates(end))),
                    None => Ok(self.comment_at(start)),
                };
            }
            // Some writers open with a heading between rows of stars; brackets and slashes open comments elsewhere.
            b'*' | b'#' | b'%' | b'\'' | b'"' | b'/' => return Ok(self.comment_at(start)),
            0x80.. if looks_like_a_block(before_comment(rest)) => {
                return Err(self.fault(say!(a_block_in_plain_letters_and_digits)));
            }
            0x80.. => return Ok(self.comment()),
            b'(' => match row_number(rest) {
                Some((number, length)) if !self.behind_block => {
                    self.at += length;
                    return Ok(Some(Token::Number(number)));
                }
                _ => return Ok(self.comment_at(start)),
            },
            b'0'..=b'9' | b'-' | b'+' | b'.' => {
                if self.behind_block
                    && let Some(end) = stated_point(before_comment(rest))
                {
                    self.at = self.line.len();
                    return Ok(Some(Token::Coordinates(end)));
                }
                if self.behind_block && has_decimal_commas(before_comment(rest)) {
                    return Ok(Some(self.decimal_commas(start).into()));
                }
                if !self.behind_block
                    && let Some((number, length)) =
                        row_number(rest).or_else(|| row_of_word(rest, words))
                {
                    self.at += length;
                    return Ok(Some(Token::Number(number)));
                }
            }
            _ => {}
        }
        self.word_or_block(words)
    }

    fn comment(&mut self) -> Option<Token> {
        self.at = self.line.len();
        None
    }

    /// A comment from its mark on; one that holds a block is said to.
    fn comment_at(&mut self, start: usize) -> Option<Token> {
        self.at = self.line.len();
        let rest = self.from(start);
        let end = start + rest.trim_ascii_end().len();
        let holds_block = memchr::memchr2_iter(b'B', b'b', rest)
            .take(MOST_LOOKS)
            .any(|at| rest.get(at..).and_then(fields::strict).is_some());
        let comment = Item::CommentedBlock {
            range: self.offset + start..self.offset + end,
            column: start + 1,
        };
        holds_block.then_some(comment.into())
    }

    /// Coordinates with commas for points, from a byte of the line on.
    fn decimal_commas(&mut self, from: usize) -> Item {
        self.at = self.line.len();
        let code = before_comment(self.from(from));
        let (start, end) = (
            from + code.len() - code.trim_ascii_start().len(),
            from + code.trim_ascii_end().len(),
        );
        let range = self.offset + start..self.offset + end;
        Item::Fault(SyntaxFault::new(range, Flaw::DecimalCommas))
    }

    fn word_or_block(&mut self, words: &Words<'_>) -> Result<Option<Token>, SyntaxFault> {
        let start = self.at;
        let rest = self.from(start);
        if let Some((block, part, length)) = fields::strict(rest) {
            self.at += length;
            let block = Item::Block {
                block,
                part,
                range: self.range(start),
                number: None,
                stated_end: None,
            };
            return Ok(Some(block.into()));
        }
        let letters = word_of(rest);
        if !letters.is_empty()
            && let Some(word) = words.meaning(letters)
        {
            let is_own = words.is_own(letters);
            self.at += letters.len();
            let word = Item::Word {
                word,
                is_own,
                range: self.range(start),
                number: None,
            };
            return Ok(Some(word.into()));
        }
        if let Some(at) = start_point(rest) {
            self.at = self.line.len();
            let range = self.range(start);
            return Ok(Some(Item::StartPoint { at, range }.into()));
        }
        if matches!(rest.first(), Some(b'N' | b'n'))
            && let Some((number, length)) = n_word(rest)
        {
            self.at += length;
            return Ok(Some(Token::Number(number)));
        }
        if !wants_to_be_a_block(rest) {
            self.at = self.line.len();
            if self.behind_block && is_remark(self.line, start, words) {
                return Ok(None);
            }
            if !rest.iter().any(u8::is_ascii_alphanumeric) {
                return Ok(None);
            }
            let end = start + rest.trim_ascii_end().len();
            let text = Item::Text {
                range: self.offset + start..self.offset + end,
                column: start + 1,
            };
            return Ok(Some(text.into()));
        }
        match fields::lenient(rest) {
            Ok(found) => {
                self.at += found.fields.end;
                let faults = found
                    .faults
                    .into_iter()
                    .map(|fault| self.placed(fault, start))
                    .collect();
                let first = self.offset + start + found.fields.first;
                let block = Item::Block {
                    block: found.block,
                    part: found.part,
                    range: first..self.offset + self.at,
                    number: found.row,
                    stated_end: None,
                };
                Ok(Some(Token::Item(block, faults)))
            }
            Err((at, expected)) => {
                self.at = start + at;
                Err(self.fault(expected))
            }
        }
    }

    fn placed(&self, fault: SyntaxFault, start: usize) -> SyntaxFault {
        let shift = self.offset + start;
        let flaw = match fault.flaw {
            Flaw::MissingB { at } => Flaw::MissingB { at: at + shift },
            flaw => flaw,
        };
        SyntaxFault {
            range: fault.range.start + shift..fault.range.end + shift,
            flaw,
            number: fault.number,
        }
    }

    fn range(&self, start: usize) -> Range<usize> {
        self.offset + start..self.offset + self.at
    }

    /// The fault at the cursor; its range is what stands there up to the next space. There is nothing to underline behind the end, so the
    /// last byte stands for it.
    fn fault(&self, expected: &str) -> SyntaxFault {
        let (column, rest) = (self.at + 1, self.from(self.at));
        let length = rest.iter().position(u8::is_ascii_whitespace);
        let length = length
            .unwrap_or(rest.len())
            .clamp(rest.len().min(1), rest.len());
        let (start, found) = if rest.is_empty() {
            (self.at.saturating_sub(1), say!(the_line_ends).to_owned())
        } else {
            (self.at, say!(found_something, shown(head(rest, length))))
        };
        let range = self.offset + start..self.offset + self.at + length;
        let sentence = say!(expected_in_a_column, column, found, expected);
        SyntaxFault::new(range, Flaw::Unreadable(sentence))
    }

    /// Goes behind the quadrant that the broken block ends in, where more blocks may stand; false where there is none.
    fn skip_broken_block(&mut self) -> bool {
        let rest = self.from(self.at);
        let comment = memchr::memchr(b';', rest).unwrap_or(rest.len());
        let is_end = |window: &[u8]| matches!(window, [b'L' | b'R' | b'l' | b'r', b'1'..=b'4']);
        match head(rest, comment).windows(2).position(is_end) {
            Some(at) => {
                self.at += at + 2;
                self.behind_block = true;
                true
            }
            None => false,
        }
    }
}

/// The first characters of what was found.
fn shown(bytes: &[u8]) -> String {
    let mut words = bytes.split(u8::is_ascii_whitespace);
    text::shown(words.next().unwrap_or_default())
}

/// Places in a comment at which a block is looked for.
const MOST_LOOKS: usize = 64;

#[cfg(test)]
mod tests;
