//! Reads a line word by word.

mod expression;
mod names;
mod semicolon;

use super::variables::Variables;
use super::word::{Number, Term, Token, Value, WordFault};
use semicolon::{Behind, behind};
use std::ops::Range;

/// The digits that a number may have before its decimal point, and those that are read after it; more than any control
/// takes.
const MOST_DIGITS: u32 = 9;

/// Hands out the tokens of a line in plain characters, each with its place; what it says of `variables` holds from there
/// on. A byte order mark may begin the first line.
pub(super) fn scan(
    line: &[u8],
    offset: usize,
    is_first: bool,
    variables: &mut Variables,
    mut each: impl FnMut(Token, Range<usize>),
) {
    let mut cursor = Cursor {
        line,
        at: 0,
        offset,
        fault: None,
        variables,
    };
    if is_first && line.starts_with(b"\xef\xbb\xbf") {
        cursor.at = 3;
    }
    while let Some((token, range)) = cursor.token() {
        each(token, range);
        if let Some((fault, range)) = cursor.fault.take() {
            each(Token::Fault(fault), range);
        }
    }
}

struct Cursor<'a> {
    line: &'a [u8],
    at: usize,
    offset: usize,
    /// A fault in the token that was read all the same.
    fault: Option<(WordFault, Range<usize>)>,
    variables: &'a mut Variables,
}

impl Cursor<'_> {
    #[inline]
    fn peek(&self) -> Option<u8> {
        self.line.get(self.at).copied()
    }

    #[inline]
    fn skip_space(&mut self) {
        // 0x1A ends a text of DOS.
        self.skip(|byte| matches!(byte, b' ' | b'\t' | 0x0b | 0x0c | 0x1a));
    }

    #[inline]
    fn skip(&mut self, wanted: impl Fn(u8) -> bool) {
        while self.peek().is_some_and(&wanted) {
            self.at += 1;
        }
    }

    fn range(&self, start: usize) -> Range<usize> {
        self.offset + start..self.offset + self.at
    }

    #[inline]
    fn token(&mut self) -> Option<(Token, Range<usize>)> {
        self.skip_space();
        let start = self.at;
        let byte = self.peek()?;
        if byte.is_ascii_alphabetic() {
            let token = self.word(byte.to_ascii_uppercase());
            return Some((token, self.range(start)));
        }
        self.at += 1;
        let token = match byte {
            b'(' => self.comment(start),
            b';' => {
                match behind(self.line, start) {
                    Behind::Words => {}
                    Behind::Dwell { end } => self.at = end,
                    Behind::Comment => self.at = self.line.len(),
                    Behind::Block => {
                        self.at = self.line.len();
                        self.fault = Some((WordFault::CommentedBlock, self.range(start)));
                    }
                }
                Token::Comment
            }
            b'<' if self.is_name(start) => {
                self.at = self.line.len();
                Token::Comment
            }
            // `%00001`: with the program's number.
            b'%' => {
                self.skip(|byte| byte.is_ascii_digit());
                Token::Tape
            }
            b'/' => {
                if self.peek().is_some_and(|byte| byte.is_ascii_digit()) {
                    self.at += 1;
                }
                Token::Skip
            }
            // A program's number as Fanuc's tapes have it.
            b':' => match self.number(b'O') {
                Ok(Some(number)) => Token::Word {
                    letter: b'O',
                    number,
                },
                _ => self.other_plane(start),
            },
            b',' => self.corner(start),
            b'*' if self.line[self.at..].iter().all(u8::is_ascii_whitespace) => {
                self.at = self.line.len();
                return None;
            }
            b'#' => {
                self.assignment();
                Token::Foreign
            }
            _ => self.stray(),
        };
        Some((token, self.range(start)))
    }

    /// Text that begins no word, up to the next space or letter.
    fn stray(&mut self) -> Token {
        self.skip(|byte| {
            !byte.is_ascii_alphabetic() && !matches!(byte, b' ' | b'\t' | b'(' | b';' | b'%')
        });
        Token::Fault(WordFault::NoWord)
    }

    /// `: G01 X… Y…`: the move of the wire's upper end meanwhile.
    fn other_plane(&mut self, start: usize) -> Token {
        self.skip_space();
        if !self.peek().is_some_and(|byte| byte.is_ascii_alphabetic()) {
            self.at = start + 1;
            return self.stray();
        }
        self.skip(|byte| !matches!(byte, b'(' | b';' | b'%'));
        self.leave_space(start);
        Token::Foreign
    }

    /// Goes back over the spaces at the end of what begins at `start`.
    fn leave_space(&mut self, start: usize) {
        while self.at > start && matches!(self.line[self.at - 1], b' ' | b'\t') {
            self.at -= 1;
        }
    }

    /// `,R2.` after its comma.
    fn corner(&mut self, start: usize) -> Token {
        self.skip_space();
        if let Some(letter @ (b'R' | b'C')) = self.peek().map(|byte| byte.to_ascii_uppercase()) {
            self.at += 1;
            self.skip_space();
            if let Ok(Some(number)) = self.number(letter) {
                let round = letter == b'R';
                return Token::Corner { round, number };
            }
        }
        self.at = start + 1;
        self.stray()
    }

    fn skip_to_space(&mut self) {
        self.skip(|byte| !matches!(byte, b' ' | b'\t' | b'(' | b';'));
    }

    /// A comment after its `(`; those within it are part of it.
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
                return Token::Comment;
            }
        }
        // Writers that nest an opening bracket without closing it mean the first closing one.
        if let Some(closing) = self.line[start..].iter().position(|&byte| byte == b')') {
            self.at = start + closing + 1;
            return Token::Comment;
        }
        Token::Fault(WordFault::OpenComment)
    }

    #[inline]
    fn word(&mut self, letter: u8) -> Token {
        let start = self.at;
        if self.begins_with_a_name(start) {
            return self.without_number(letter, start);
        }
        self.at += 1;
        self.skip_space();
        if self.begins_expression() {
            return self.computed(letter);
        }
        let begun = self.at;
        match self.number(letter) {
            Ok(Some(number)) => {
                if self.goes_on_as_expression(letter) {
                    self.at = begun;
                    return self.computed(letter);
                }
                if matches!(letter, b'C' | b'D' | b'E' | b'H' | b'T' | b'S' | b'F')
                    && self.is_definition()
                {
                    return self.definition(letter, number);
                }
                Token::Word { letter, number }
            }
            Ok(None) => self.without_number(letter, start),
            Err(fault) => Token::Fault(fault),
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

    /// The value after `H001=`: one number, or a list up to the next letter, comment or end.
    fn definition(&mut self, letter: u8, index: Number) -> Token {
        self.at += 1;
        self.skip_space();
        if let Some(terms) = self.sum(letter) {
            return Token::Sum {
                letter,
                index,
                terms,
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
        }
    }

    /// Numbers and places of the table with signs between them; `None` where one number stands alone, or something
    /// else.
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
                    let number = self.number(place).ok().flatten();
                    let index = number.and_then(Number::index);
                    index.map(|index| Value::Place {
                        letter: place,
                        index,
                    })
                }
                Some(b'+' | b'-') => None,
                Some(b'#' | b'[') => self.expression(0).map(Value::Number),
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

    /// Whether the letter O at `at` stands for a zero in the number of `letter`, of which this many digits have been
    /// read.
    fn is_zero(&self, letter: u8, at: usize, digits: usize) -> bool {
        let behind = self.line.get(at + 1).copied();
        let is_number = |byte: Option<u8>| {
            byte.is_some_and(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'O' | b'o'))
        };
        // `N10O0001`: the number of a program after that of a block.
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
                    // Further digits lie far below the resolution of a control.
                    mantissa = mantissa * 10 + i64::from(digit);
                    decimals += 1;
                }
            } else if byte == b'.' && !point {
                point = true;
            } else if matches!(byte, b'O' | b'o') && self.is_zero(letter, at, at - digits_from) {
                // From the first to the last of them.
                let own = self.offset + at..self.offset + at + 1;
                match &mut self.fault {
                    Some((WordFault::LetterO, range)) => range.end = own.end,
                    Some(_) => {}
                    None => self.fault = Some((WordFault::LetterO, own)),
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
                self.fault.get_or_insert((WordFault::DecimalComma, own));
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

    /// A corner's word stands after the comma at the cursor.
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
