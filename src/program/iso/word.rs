//! The words of a line: a letter and its number, each with its place; comments, marks and what cannot be read.
//!
//! Nothing here knows what a word means, and nothing that one line says hangs on another.

use super::cursor::scan;
use crate::finding::{Detail, Finding, Rule, Severity};
use crate::program::alike::{Alike, alike};
use std::ops::Range;

/// A number as it is written: `mantissa · 10^−decimals`. Whether it had a decimal point tells millimetres from micrometres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Number {
    pub mantissa: i64,
    pub decimals: u8,
    pub point: bool,
}

impl Number {
    /// The number where it is a whole one, such as that of G01 or N10.
    pub fn whole(self) -> Option<i64> {
        let factor = 10_i64.checked_pow(u32::from(self.decimals))?;
        (self.mantissa % factor == 0).then_some(self.mantissa / factor)
    }
}

/// One thing that stands in a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Token {
    /// `G01`, `X-1.5`: the letter in upper case.
    Word {
        letter: u8,
        number: Number,
        range: Range<usize>,
    },
    /// `H001=110`, a value for the control's table; what stands behind the sign may be a list.
    Definition {
        letter: u8,
        index: Number,
        value: Option<Number>,
        range: Range<usize>,
    },
    /// `H001=.0085+H175`: a value for the control's table that is reckoned from numbers and other places of it.
    Sum {
        letter: u8,
        index: Number,
        terms: Vec<Term>,
        range: Range<usize>,
    },
    /// `,R2.` or `,C1.`: the corner at the end of the move is rounded, or chamfered.
    Corner {
        round: bool,
        number: Number,
        range: Range<usize>,
    },
    /// `STOP`, or a word with a variable or an expression in the place of its number: a matter of the machine.
    Foreign { range: Range<usize> },
    /// `( … )`, or `;` to the end of the line.
    Comment { range: Range<usize> },
    /// `%`: where a program begins and ends on tape.
    Tape { range: Range<usize> },
    /// `/`: a block that the operator may have left out.
    Skip { range: Range<usize> },
    /// Not readable; the rest of the line is read all the same.
    Fault {
        fault: WordFault,
        range: Range<usize>,
    },
}

impl Token {
    /// Where it stands.
    pub fn range_mut(&mut self) -> &mut Range<usize> {
        match self {
            Token::Word { range, .. }
            | Token::Definition { range, .. }
            | Token::Sum { range, .. }
            | Token::Corner { range, .. }
            | Token::Foreign { range }
            | Token::Comment { range }
            | Token::Tape { range }
            | Token::Skip { range }
            | Token::Fault { range, .. } => range,
        }
    }

    /// The same in another place.
    pub fn moved(mut self, place: impl Fn(Range<usize>) -> Range<usize>) -> Token {
        let range = self.range_mut();
        *range = place(range.clone());
        self
    }
}

/// A term of a sum, with its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Term {
    pub is_negative: bool,
    pub value: Value,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    Number(Number),
    /// What another place of the control's table holds.
    Place {
        letter: u8,
        index: u32,
    },
}

/// What is wrong with a place of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordFault {
    /// A letter without its number.
    NoNumber {
        letter: u8,
    },
    /// `X1.2.3`.
    NotANumber {
        letter: u8,
    },
    /// `X1O.5`: read as the zero that is meant.
    LetterO,
    /// `X1,5`: read as the point that is meant.
    DecimalComma,
    /// Full-width characters, or letters and spaces of other scripts: read as those that they look like.
    Lookalike,
    TooManyDigits {
        digits: u32,
    },
    /// `(` without `)`.
    OpenComment,
    /// A character that begins no word.
    NoWord,
}

impl WordFault {
    /// What is told of it: it stands at `start` of its line, and at `range` of the text.
    pub fn finding(self, line: &[u8], start: usize, range: Range<usize>) -> Finding {
        let column = start + 1;
        let bytes = line.get(start..start + range.len()).unwrap_or_default();
        let shown: String = String::from_utf8_lossy(&bytes[..bytes.len().min(48)])
            .chars()
            .take(12)
            .collect();
        let sentence = match self {
            WordFault::NoNumber { letter } => say!(word_without_number, column, letter as char),
            WordFault::NotANumber { letter } => say!(
                word_is_no_number,
                column,
                letter as char,
                shown.get(1..).unwrap_or_default()
            ),
            WordFault::TooManyDigits { digits } => say!(number_of_too_many_digits, column, digits),
            WordFault::OpenComment => say!(comment_is_not_closed, column),
            WordFault::LetterO => say!(letter_o_in_a_number, column),
            WordFault::DecimalComma => say!(comma_in_a_number, column),
            WordFault::Lookalike => say!(only_looks_like_ascii, column, shown),
            WordFault::NoWord => say!(no_word, column, shown),
        };
        let severity = match self {
            WordFault::OpenComment => Severity::Warning,
            _ => Rule::Syntax.default_severity(),
        };
        let rule = match self {
            WordFault::TooManyDigits { .. } => Rule::TooManyDigits,
            _ => Rule::Syntax,
        };
        Finding::in_text(rule, range, Detail::Syntax(sentence)).with(severity)
    }
}

impl WordFault {
    /// What it means is read all the same.
    pub fn is_read(self) -> bool {
        matches!(
            self,
            WordFault::OpenComment
                | WordFault::LetterO
                | WordFault::DecimalComma
                | WordFault::Lookalike
        )
    }
}

/// Hands each token of a line, which is without its line end, to `each`. Ranges are counted from `offset`.
pub fn words(line: &[u8], offset: usize, mut each: impl FnMut(Token)) {
    if !line.is_ascii()
        && let Some(plain) = Plain::of(line)
    {
        each(Token::Fault {
            fault: WordFault::Lookalike,
            range: offset + plain.first.start..offset + plain.first.end,
        });
        scan(&plain.bytes, 0, offset == 0, |token| {
            each(plain.placed(token, offset))
        });
        return;
    }
    scan(line, offset, offset == 0, each);
}

/// A line in which characters stand as those that they look like, each with its place in the text.
struct Plain {
    bytes: Vec<u8>,
    /// Of each byte, and of the end, where it stands in the line.
    places: Vec<usize>,
    /// The first characters that are others.
    first: Range<usize>,
}

impl Plain {
    /// `None` where no word of the line is written in other characters.
    fn of(line: &[u8]) -> Option<Plain> {
        let mut plain = Plain {
            bytes: Vec::with_capacity(line.len()),
            places: Vec::with_capacity(line.len() + 1),
            first: 0..0,
        };
        // A byte order mark is none of them.
        let is_mark = |found: &Alike| line[found.at..].starts_with(b"\xef\xbb\xbf");
        let mut others = alike(line)
            .into_iter()
            .filter(|found| !is_mark(found))
            .peekable();
        let (mut at, mut depth, mut is_wide) = (0, 0_usize, false);
        while at < line.len() {
            let other = others.next_if(|found| found.at == at);
            let other =
                other.filter(|found| depth == 0 || (is_wide && found.likeness.ascii() == b')'));
            let length = other.map_or(1, |found| found.length);
            let byte = other.map_or(line[at], |found| found.likeness.ascii());
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

    fn placed(&self, token: Token, offset: usize) -> Token {
        let place = |range: Range<usize>| {
            let at = |at: usize| self.places.get(at).copied().unwrap_or_default();
            offset + at(range.start)..offset + at(range.end)
        };
        token.moved(place)
    }
}

/// A line with the characters of its words as those that they look like; `None` where none is another.
pub fn plain(line: &[u8]) -> Option<Vec<u8>> {
    Plain::of(line).map(|plain| plain.bytes)
}
