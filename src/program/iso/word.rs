//! The words of a line: a letter and its number, each with its place; comments, marks and what cannot be read.
//!
//! Nothing here knows what a word means, and nothing that one line says hangs on another.

use crate::finding::{Detail, Finding, Place, Rule, Severity};
use crate::program::alike::{Alike, alike};
use std::ops::Range;

/// The digits that a number may have before its decimal point, and those that are read behind it; more than any control takes.
const MOST_DIGITS: u32 = 9;

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
        Finding {
            rule: Rule::Syntax,
            severity,
            place: Place::Text { range },
            detail: Detail::Syntax(sentence),
            related: Vec::new(),
        }
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

fn scan(line: &[u8], offset: usize, is_first: bool, mut each: impl FnMut(Token)) {
    let mut cursor = Cursor {
        line,
        at: 0,
        offset,
        fault: None,
    };
    if is_first && line.starts_with(b"\xef\xbb\xbf") {
        cursor.at = 3;
    }
    while let Some(token) = cursor.token() {
        each(token);
        if let Some(fault) = cursor.fault.take() {
            each(fault);
        }
    }
}

struct Cursor<'a> {
    line: &'a [u8],
    at: usize,
    offset: usize,
    /// Something is wrong in the token that was read all the same.
    fault: Option<Token>,
}

impl Cursor<'_> {
    #[inline]
    fn peek(&self) -> Option<u8> {
        self.line.get(self.at).copied()
    }

    #[inline]
    fn skip_space(&mut self) {
        // 0x1A ends a text of DOS.
        while matches!(self.peek(), Some(b' ' | b'\t' | 0x0b | 0x0c | 0x1a)) {
            self.at += 1;
        }
    }

    fn range(&self, start: usize) -> Range<usize> {
        self.offset + start..self.offset + self.at
    }

    #[inline]
    fn token(&mut self) -> Option<Token> {
        self.skip_space();
        let start = self.at;
        let byte = self.peek()?;
        if byte.is_ascii_alphabetic() {
            return Some(self.word(byte.to_ascii_uppercase()));
        }
        self.at += 1;
        Some(match byte {
            b'(' => self.comment(start),
            b';' => {
                self.at = self.line.len();
                Token::Comment {
                    range: self.range(start),
                }
            }
            b'%' => Token::Tape {
                range: self.range(start),
            },
            b'/' => {
                if self.peek().is_some_and(|byte| byte.is_ascii_digit()) {
                    self.at += 1;
                }
                Token::Skip {
                    range: self.range(start),
                }
            }
            // A program's number as Fanuc's tapes have it.
            b':' => match self.number(b'O') {
                Ok(Some(number)) => Token::Word {
                    letter: b'O',
                    number,
                    range: self.range(start),
                },
                _ => self.other_plane(start),
            },
            b',' => self.corner(start),
            b'*' if self.line[self.at..].iter().all(u8::is_ascii_whitespace) => {
                self.at = self.line.len();
                return None;
            }
            b'#' => {
                self.skip_to_space();
                Token::Foreign {
                    range: self.range(start),
                }
            }
            _ => self.stray(start),
        })
    }

    /// What begins no word, up to the next space or letter.
    fn stray(&mut self, start: usize) -> Token {
        while self.peek().is_some_and(|byte| {
            !byte.is_ascii_alphabetic() && !matches!(byte, b' ' | b'\t' | b'(' | b';' | b'%')
        }) {
            self.at += 1;
        }
        Token::Fault {
            fault: WordFault::NoWord,
            range: self.range(start),
        }
    }

    /// `: G01 X… Y…`: what the wire's upper end does meanwhile.
    fn other_plane(&mut self, start: usize) -> Token {
        self.skip_space();
        if !self.peek().is_some_and(|byte| byte.is_ascii_alphabetic()) {
            self.at = start + 1;
            return self.stray(start);
        }
        while self
            .peek()
            .is_some_and(|byte| !matches!(byte, b'(' | b';' | b'%'))
        {
            self.at += 1;
        }
        while self.at > start && matches!(self.line[self.at - 1], b' ' | b'\t') {
            self.at -= 1;
        }
        Token::Foreign {
            range: self.range(start),
        }
    }

    /// `,R2.` behind its comma.
    fn corner(&mut self, start: usize) -> Token {
        self.skip_space();
        if let Some(letter @ (b'R' | b'C')) = self.peek().map(|byte| byte.to_ascii_uppercase()) {
            self.at += 1;
            self.skip_space();
            if let Ok(Some(number)) = self.number(letter) {
                return Token::Corner {
                    round: letter == b'R',
                    number,
                    range: self.range(start),
                };
            }
        }
        self.at = start + 1;
        self.stray(start)
    }

    fn skip_to_space(&mut self) {
        while self
            .peek()
            .is_some_and(|byte| !matches!(byte, b' ' | b'\t' | b'(' | b';'))
        {
            self.at += 1;
        }
    }

    /// A comment behind its `(`; those within it are part of it.
    fn comment(&mut self, start: usize) -> Token {
        let mut depth = 1_usize;
        while let Some(byte) = self.peek() {
            self.at += 1;
            match byte {
                b'(' => depth += 1,
                b')' => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return Token::Comment {
                    range: self.range(start),
                };
            }
        }
        // Writers that nest an opening bracket without closing it mean the first closing one.
        if let Some(closing) = self.line[start..].iter().position(|&byte| byte == b')') {
            self.at = start + closing + 1;
            return Token::Comment {
                range: self.range(start),
            };
        }
        Token::Fault {
            fault: WordFault::OpenComment,
            range: self.range(start),
        }
    }

    #[inline]
    fn word(&mut self, letter: u8) -> Token {
        let start = self.at;
        self.at += 1;
        self.skip_space();
        match self.number(letter) {
            Ok(Some(number)) => {
                if matches!(letter, b'C' | b'D' | b'E' | b'H' | b'T' | b'S' | b'F')
                    && self.is_definition()
                {
                    return self.definition(letter, number, start);
                }
                Token::Word {
                    letter,
                    number,
                    range: self.range(start),
                }
            }
            Ok(None) => self.without_number(letter, start),
            Err(fault) => Token::Fault {
                fault,
                range: self.range(start),
            },
        }
    }

    /// A letter that no number follows: the name of something, an expression, or a fault.
    fn without_number(&mut self, letter: u8, start: usize) -> Token {
        match self.peek() {
            Some(b'#' | b'[' | b'=') => {
                self.skip_to_space();
                return Token::Foreign {
                    range: self.range(start),
                };
            }
            _ => self.at = start + 1,
        }
        let letters = self.line[start..]
            .iter()
            .take_while(|byte| byte.is_ascii_alphabetic())
            .count();
        // `TP0.0`: a name of two letters that no word of the path begins with.
        if letters == 2
            && matches!(
                letter,
                b'A' | b'B' | b'C' | b'E' | b'Q' | b'S' | b'T' | b'U' | b'V' | b'W' | b'Z'
            )
        {
            self.at = start + 2;
            if matches!(self.number(letter), Ok(Some(_))) {
                return Token::Foreign {
                    range: self.range(start),
                };
            }
            self.at = start + 1;
        }
        if letters >= 3 {
            self.at = start;
            while self.peek().is_some_and(|byte| {
                byte.is_ascii_alphanumeric()
                    || matches!(byte, b'_' | b',' | b'.' | b'-' | b'+' | b'=')
            }) {
                self.at += 1;
            }
            return Token::Foreign {
                range: self.range(start),
            };
        }
        Token::Fault {
            fault: WordFault::NoNumber { letter },
            range: self.range(start),
        }
    }

    fn is_definition(&mut self) -> bool {
        let at = self.at;
        self.skip_space();
        let found = self.peek() == Some(b'=');
        if !found {
            self.at = at;
        }
        found
    }

    /// The value behind `H001=`: one number, or a list up to the next letter, comment or end.
    fn definition(&mut self, letter: u8, index: Number, start: usize) -> Token {
        self.at += 1;
        self.skip_space();
        if let Some(terms) = self.sum(letter) {
            return Token::Sum {
                letter,
                index,
                terms,
                range: self.range(start),
            };
        }
        let value = self.number(letter).ok().flatten();
        let end = self.at;
        let mut listed = false;
        while self
            .peek()
            .is_some_and(|byte| !byte.is_ascii_alphabetic() && !matches!(byte, b'(' | b';'))
        {
            listed |= self
                .peek()
                .is_some_and(|byte| !matches!(byte, b' ' | b'\t'));
            self.at += 1;
        }
        if !listed {
            self.at = end;
        }
        Token::Definition {
            letter,
            index,
            value: value.filter(|_| !listed),
            range: self.range(start),
        }
    }

    /// Numbers and places of the table with signs between them; `None` where one number stands alone, or something else.
    fn sum(&mut self, letter: u8) -> Option<Vec<Term>> {
        let begun = self.at;
        let mut terms: Vec<Term> = Vec::new();
        loop {
            let is_negative = match self.peek() {
                Some(sign @ (b'+' | b'-')) => {
                    self.at += 1;
                    self.skip_space();
                    sign == b'-'
                }
                _ if terms.is_empty() => false,
                _ => break,
            };
            let value = match self.peek().map(|byte| byte.to_ascii_uppercase()) {
                Some(place @ (b'D' | b'H')) => {
                    self.at += 1;
                    let index = self
                        .number(place)
                        .ok()
                        .flatten()
                        .and_then(Number::whole)
                        .and_then(|whole| u32::try_from(whole).ok());
                    index.map(|index| Value::Place {
                        letter: place,
                        index,
                    })
                }
                Some(b'+' | b'-') => None,
                _ => self.number(letter).ok().flatten().map(Value::Number),
            };
            let Some(value) = value else {
                self.at = begun;
                return None;
            };
            terms.push(Term { is_negative, value });
            let end = self.at;
            self.skip_space();
            if !matches!(self.peek(), Some(b'+' | b'-')) {
                self.at = end;
                break;
            }
        }
        let is_sum = terms.len() > 1
            || terms
                .iter()
                .any(|term| matches!(term.value, Value::Place { .. }));
        if !is_sum {
            self.at = begun;
        }
        is_sum.then_some(terms)
    }

    /// The letter O at `at` stands for a zero of the number of `letter`, of which so many digits have been read.
    fn is_zero(&self, letter: u8, at: usize, digits: usize) -> bool {
        let behind = self.line.get(at + 1).copied();
        let is_number = |byte: Option<u8>| {
            byte.is_some_and(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'O' | b'o'))
        };
        // `N10O0001`: the number of a program behind that of a block.
        if letter == b'N'
            && digits > 0
            && self.line[at + 1..]
                .iter()
                .take_while(|byte| byte.is_ascii_digit())
                .count()
                >= 2
        {
            return false;
        }
        let is_word = matches!(
            letter,
            b'X' | b'Y' | b'I' | b'J' | b'R' | b'G' | b'M' | b'N' | b'D' | b'H' | b'P' | b'L'
        );
        is_word
            && (digits > 0
                || is_number(behind)
                || !behind.is_some_and(|byte| byte.is_ascii_alphabetic()))
    }

    /// The number at the cursor; `None` where there is none, and the cursor stays.
    #[inline]
    fn number(&mut self, letter: u8) -> Result<Option<Number>, WordFault> {
        let mut at = self.at;
        let sign = self.line.get(at).copied();
        at += usize::from(matches!(sign, Some(b'-' | b'+')));
        let digits_from = at;
        let (mut mantissa, mut whole, mut decimals, mut point) = (0_i64, 0_u32, 0_u32, false);
        while let Some(&byte) = self.line.get(at) {
            let digit = byte.wrapping_sub(b'0');
            if digit <= 9 {
                if !point {
                    whole += u32::from(whole > 0 || digit != 0);
                    if whole <= MOST_DIGITS {
                        mantissa = mantissa * 10 + i64::from(digit);
                    }
                } else if decimals < MOST_DIGITS {
                    // Further ones lie far below what a control resolves.
                    mantissa = mantissa * 10 + i64::from(digit);
                    decimals += 1;
                }
            } else if byte == b'.' && !point {
                point = true;
            } else if matches!(byte, b'O' | b'o') && self.is_zero(letter, at, at - digits_from) {
                // From the first to the last of them.
                let own = self.offset + at..self.offset + at + 1;
                match &mut self.fault {
                    Some(Token::Fault {
                        fault: WordFault::LetterO,
                        range,
                    }) => range.end = own.end,
                    Some(_) => {}
                    None => {
                        self.fault = Some(Token::Fault {
                            fault: WordFault::LetterO,
                            range: own,
                        })
                    }
                }
                if point && decimals < MOST_DIGITS {
                    mantissa *= 10;
                    decimals += 1;
                } else if !point {
                    whole += u32::from(whole > 0);
                    mantissa = if whole <= MOST_DIGITS {
                        mantissa * 10
                    } else {
                        mantissa
                    };
                }
            } else if byte == b','
                && !point
                && at > digits_from
                && self.line.get(at + 1).is_some_and(u8::is_ascii_digit)
            {
                point = true;
                let own = self.offset + at..self.offset + at + 1;
                self.fault.get_or_insert(Token::Fault {
                    fault: WordFault::DecimalComma,
                    range: own,
                });
            } else {
                break;
            }
            at += 1;
        }
        if at - digits_from == usize::from(point) {
            return Ok(None);
        }
        self.at = at;
        if self.peek() == Some(b'.') || self.peek() == Some(b',') && !self.is_corner() {
            self.skip_to_space();
            self.fault = None;
            return Err(WordFault::NotANumber { letter });
        }
        if whole > MOST_DIGITS {
            self.fault = None;
            return Err(WordFault::TooManyDigits { digits: whole });
        }
        let mantissa = if sign == Some(b'-') {
            -mantissa
        } else {
            mantissa
        };
        Ok(Some(Number {
            mantissa,
            decimals: decimals as u8,
            point,
        }))
    }

    /// A corner's word stands behind the comma at the cursor.
    fn is_corner(&self) -> bool {
        let mut rest = self
            .line
            .get(self.at + 1..)
            .unwrap_or_default()
            .iter()
            .skip_while(|byte| matches!(byte, b' ' | b'\t'));
        matches!(rest.next(), Some(b'R' | b'r' | b'C' | b'c'))
    }
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
