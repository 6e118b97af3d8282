//! Reading 3B text line by line: compact, spaced, aligned and checking layouts, with comments, block numbers and coordinates.
//!
//! A line that cannot be read gives one fault; what was read of it before counts, and the next line is read as if nothing had been.

use super::block::{Block, CountingAxis, Motion, Quadrant};
use std::ops::Range;

/// What a word between the blocks does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Word {
    /// The machine stops until the wire is threaded.
    Pause,
    End,
}

/// The words between blocks of one controller. The usual ones of other controllers are read as well.
#[derive(Clone, Copy, Debug)]
pub struct Words<'a> {
    pub pause: &'a str,
    pub end: &'a str,
}

impl Default for Words<'_> {
    fn default() -> Self {
        Words { pause: "D", end: "DD" }
    }
}

impl Words<'_> {
    /// What a word does; `None` for what is no word of a program. Letter case does not matter.
    pub(super) fn meaning(&self, word: &[u8]) -> Option<Word> {
        let is = |known: &str| word.eq_ignore_ascii_case(known.as_bytes());
        if is(self.end) || ["DD", "E", "FF", "MJ"].into_iter().any(is) {
            // A setting may have made one of these the pause.
            return Some(if is(self.pause) && !is(self.end) { Word::Pause } else { Word::End });
        }
        (is(self.pause) || is("D") || is("A")).then_some(Word::Pause)
    }
}

/// One thing that a line says.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    Block {
        block: Block,
        /// From the first `B` to the quadrant.
        range: Range<usize>,
        /// `N12`.
        number: Option<u32>,
        /// Absolute end point in mm that stands behind the block.
        stated_end: Option<[f64; 2]>,
    },
    Word {
        word: Word,
        range: Range<usize>,
    },
    /// `Start Point = x , y`, mm.
    StartPoint {
        at: [f64; 2],
        range: Range<usize>,
    },
}

/// A place that cannot be read, and the sentence that says what was found and what was expected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SyntaxFault {
    pub range: Range<usize>,
    pub sentence: String,
}

/// Reads a whole text; line ends are LF, CR LF and CR.
pub fn read(text: &[u8], words: &Words<'_>) -> (Vec<Item>, Vec<SyntaxFault>) {
    let (mut items, mut faults) = (Vec::new(), Vec::new());
    for range in lines(text) {
        let start = range.start;
        faults.extend(read_line(&text[range], start, words, |item| items.push(item)).err());
    }
    (items, faults)
}

/// The bytes of each line without its end.
fn lines(text: &[u8]) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut next = Some(0);
    std::iter::from_fn(move || {
        let start = next?;
        match memchr::memchr2(b'\n', b'\r', &text[start..]) {
            None => {
                next = None;
                Some(start..text.len())
            }
            Some(length) => {
                let end = start + length;
                next = Some(end + if text[end..].starts_with(b"\r\n") { 2 } else { 1 });
                Some(start..end)
            }
        }
    })
}

/// Reads one line, without its line end, and hands out what it says. Ranges are counted from `offset`.
pub fn read_line(line: &[u8], offset: usize, words: &Words<'_>, mut each: impl FnMut(Item)) -> Result<(), SyntaxFault> {
    let mut cursor = Cursor { line, at: 0, offset };
    if offset == 0 && line.starts_with(b"\xef\xbb\xbf") {
        cursor.at = 3;
    }
    // A block waits for the next token, because its coordinates stand behind it.
    let mut waiting: Option<Item> = None;
    let mut number = None;
    let outcome = loop {
        match cursor.token(words) {
            Ok(Some(Token::Number(read))) => number = Some(read),
            Ok(Some(Token::Coordinates(end))) => {
                if let Some(Item::Block { stated_end, .. }) = &mut waiting {
                    *stated_end = Some(end);
                }
            }
            Ok(Some(Token::Block(block, range))) => {
                waiting.take().into_iter().for_each(&mut each);
                waiting = Some(Item::Block { block, range, number: number.take(), stated_end: None });
            }
            Ok(Some(Token::Other(item))) => {
                waiting.take().into_iter().for_each(&mut each);
                each(item);
            }
            Ok(None) => break Ok(()),
            Err(fault) => break Err(fault),
        }
    };
    waiting.into_iter().for_each(&mut each);
    outcome
}

/// More digits than any controller takes are not read as a number.
const MOST_DIGITS: usize = 12;

enum Token {
    /// `N12` before a block.
    Number(u32),
    Block(Block, Range<usize>),
    Coordinates([f64; 2]),
    Other(Item),
}

struct Cursor<'a> {
    line: &'a [u8],
    at: usize,
    offset: usize,
}

impl Cursor<'_> {
    fn peek(&self) -> Option<u8> {
        self.line.get(self.at).copied()
    }

    fn skip_space(&mut self) {
        // 0x1A ends a text of DOS.
        while matches!(self.peek(), Some(b' ' | b'\t' | 0x0b | 0x0c | 0x1a)) {
            self.at += 1;
        }
    }

    /// Skips space and takes one letter, given in upper case, in either case.
    fn take(&mut self, letter: u8) -> bool {
        self.skip_space();
        let found = self.peek().is_some_and(|byte| byte.to_ascii_uppercase() == letter);
        self.at += usize::from(found);
        found
    }

    fn token(&mut self, words: &Words<'_>) -> Result<Option<Token>, SyntaxFault> {
        self.skip_space();
        let start = self.at;
        let Some(byte) = self.peek() else { return Ok(None) };
        let rest = &self.line[start..];
        match byte {
            b';' => {
                self.at = self.line.len();
                if let Some(at) = start_point(&rest[1..]) {
                    return Ok(Some(Token::Other(Item::StartPoint { at, range: self.range(start) })));
                }
                Ok(two_numbers(before_comment(&rest[1..])).map(Token::Coordinates))
            }
            // Some writers open with a heading between rows of stars.
            b'*' => {
                self.at = self.line.len();
                Ok(None)
            }
            b'0'..=b'9' | b'-' | b'+' | b'.' if start > 0 => match two_numbers(before_comment(rest)) {
                Some(end) => {
                    self.at = self.line.len();
                    Ok(Some(Token::Coordinates(end)))
                }
                None => Err(self.fault("a block or a comment after `;`")),
            },
            _ => self.word_or_block(words),
        }
    }

    fn word_or_block(&mut self, words: &Words<'_>) -> Result<Option<Token>, SyntaxFault> {
        let start = self.at;
        let rest = &self.line[start..];
        let length = rest.iter().position(|byte| !byte.is_ascii_alphanumeric()).unwrap_or(rest.len());
        if length > 0
            && let Some(word) = words.meaning(&rest[..length])
        {
            self.at += length;
            return Ok(Some(Token::Other(Item::Word { word, range: self.range(start) })));
        }
        if let Some(at) = start_point(rest) {
            self.at = self.line.len();
            return Ok(Some(Token::Other(Item::StartPoint { at, range: self.range(start) })));
        }
        if self.take(b'N') {
            let number = self.digits("a block number after N")?;
            self.take(b':');
            return Ok(Some(Token::Number(number.and_then(|number| u32::try_from(number).ok()).unwrap_or(u32::MAX))));
        }
        if !self.take(b'B') {
            return Err(self.fault("a block (B X B Y B J G Z), a pause or end word, or a comment after `;`"));
        }
        let block = self.block()?;
        Ok(Some(Token::Block(block, self.range(start))))
    }

    /// The block behind its first `B`.
    fn block(&mut self) -> Result<Block, SyntaxFault> {
        let x = self.digits("")?.unwrap_or(0);
        self.expect(b'B', "digits of X, or B before Y")?;
        let y = self.digits("")?.unwrap_or(0);
        self.expect(b'B', "digits of Y, or B before J")?;
        let j = self.digits("the counting length J in µm")?.unwrap_or(0);
        self.expect(b'G', "G and the counting axis, GX or GY")?;
        let axis = match (self.take(b'X'), self.at) {
            (true, _) => CountingAxis::X,
            (false, _) if self.take(b'Y') => CountingAxis::Y,
            _ => return Err(self.fault("X or Y after G")),
        };
        let kind: fn(Quadrant) -> Motion = if self.take(b'L') {
            Motion::Line
        } else if self.take(b'S') {
            self.expect(b'R', "R of SR")?;
            Motion::Clockwise
        } else if self.take(b'N') {
            self.expect(b'R', "R of NR")?;
            Motion::CounterClockwise
        } else {
            return Err(self.fault("L, SR or NR and a quadrant"));
        };
        self.skip_space();
        let quadrant = self.peek().and_then(|byte| Quadrant::from_number(byte.wrapping_sub(b'0')));
        let Some(quadrant) = quadrant else { return Err(self.fault("a quadrant from 1 to 4")) };
        self.at += 1;
        Ok(Block { x, y, j, axis, motion: kind(quadrant) })
    }

    fn expect(&mut self, letter: u8, expected: &str) -> Result<(), SyntaxFault> {
        if self.take(letter) { Ok(()) } else { Err(self.fault(expected)) }
    }

    /// A number without sign; `None` for no digit, which is a fault where `required` says what it would be.
    fn digits(&mut self, required: &str) -> Result<Option<i64>, SyntaxFault> {
        self.skip_space();
        let start = self.at;
        let mut value: i64 = 0;
        let mut significant = 0;
        while let Some(digit @ b'0'..=b'9') = self.peek() {
            significant += usize::from(significant > 0 || digit != b'0');
            if significant <= MOST_DIGITS {
                value = value * 10 + i64::from(digit - b'0');
            }
            self.at += 1;
        }
        if significant > MOST_DIGITS {
            let sentence = format!("column {}: found a number of {significant} digits, expected at most {MOST_DIGITS}", start + 1);
            return Err(SyntaxFault { range: self.range(start), sentence });
        }
        if self.at == start && !required.is_empty() {
            return Err(self.fault(required));
        }
        Ok((self.at > start).then_some(value))
    }

    fn range(&self, start: usize) -> Range<usize> {
        self.offset + start..self.offset + self.at
    }

    /// The fault at the cursor; its range is what stands there up to the next space.
    fn fault(&self, expected: &str) -> SyntaxFault {
        let column = self.at + 1;
        let rest = &self.line[self.at..];
        if rest.is_empty() {
            // There is nothing to underline behind the end, so the last byte stands for it.
            let range = self.offset + self.at.saturating_sub(1)..self.offset + self.at;
            return SyntaxFault { range, sentence: format!("column {column}: the line ends, expected {expected}") };
        }
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len()).max(1);
        let shown: String = String::from_utf8_lossy(&rest[..length.min(48)]).chars().take(12).collect();
        let range = self.offset + self.at..self.offset + self.at + length;
        SyntaxFault { range, sentence: format!("column {column}: found `{shown}`, expected {expected}") }
    }
}

/// The point of `Start Point = x , y`.
pub(super) fn start_point(text: &[u8]) -> Option<[f64; 2]> {
    let text = text.trim_ascii_start();
    let name = b"start point";
    if !text.get(..name.len())?.eq_ignore_ascii_case(name) {
        return None;
    }
    let value = text[name.len()..].trim_ascii_start().strip_prefix(b"=")?;
    two_numbers(before_comment(value))
}

/// What stands before a `;`.
pub(super) fn before_comment(text: &[u8]) -> &[u8] {
    text.split(|&byte| byte == b';').next().unwrap_or_default()
}

/// `x , y` or `x y`, and nothing else.
pub(super) fn two_numbers(text: &[u8]) -> Option<[f64; 2]> {
    let text = std::str::from_utf8(text).ok()?;
    let mut fields = text.split(|c: char| c == ',' || c.is_ascii_whitespace()).filter(|field| !field.is_empty());
    let mut number = || fields.next()?.parse::<f64>().ok().filter(|value| value.is_finite());
    let numbers = [number()?, number()?];
    fields.next().is_none().then_some(numbers)
}
