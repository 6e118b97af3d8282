//! The words of a line: a letter and its number, each with its place; comments, marks and what cannot be read.
//!
//! Nothing here knows what a word means, and nothing that one line says hangs on another.

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
    Word { letter: u8, number: Number, range: Range<usize> },
    /// `H001=110`, a value for the control's table; what stands behind the sign may be a list.
    Definition { letter: u8, index: Number, value: Option<Number>, range: Range<usize> },
    /// `STOP`, or a word with a variable or an expression in the place of its number: a matter of the machine.
    Foreign { range: Range<usize> },
    /// `( … )`, or `;` to the end of the line.
    Comment { range: Range<usize> },
    /// `%`: where a program begins and ends on tape.
    Tape { range: Range<usize> },
    /// `/`: a block that the operator may have left out.
    Skip { range: Range<usize> },
    /// Not readable; the rest of the line is read all the same.
    Fault { fault: WordFault, range: Range<usize> },
}

/// What is wrong with a place of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordFault {
    /// A letter without its number.
    NoNumber {
        letter: u8,
    },
    /// `X1,5` or `X1.2.3`.
    NotANumber {
        letter: u8,
    },
    TooManyDigits {
        digits: u32,
    },
    /// `(` without `)`.
    OpenComment,
    /// A character that begins no word.
    NoWord,
}

/// Hands each token of a line, which is without its line end, to `each`. Ranges are counted from `offset`.
pub fn words(line: &[u8], offset: usize, mut each: impl FnMut(Token)) {
    let mut cursor = Cursor { line, at: 0, offset };
    if offset == 0 && line.starts_with(b"\xef\xbb\xbf") {
        cursor.at = 3;
    }
    while let Some(token) = cursor.token() {
        each(token);
    }
}

struct Cursor<'a> {
    line: &'a [u8],
    at: usize,
    offset: usize,
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
                Token::Comment { range: self.range(start) }
            }
            b'%' => Token::Tape { range: self.range(start) },
            b'/' => {
                if self.peek().is_some_and(|byte| byte.is_ascii_digit()) {
                    self.at += 1;
                }
                Token::Skip { range: self.range(start) }
            }
            // A program's number as Fanuc's tapes have it.
            b':' => match self.number(b'O') {
                Ok(Some(number)) => Token::Word { letter: b'O', number, range: self.range(start) },
                _ => self.stray(start),
            },
            b'*' if self.line[self.at..].iter().all(u8::is_ascii_whitespace) => {
                self.at = self.line.len();
                return None;
            }
            b'#' => {
                self.skip_to_space();
                Token::Foreign { range: self.range(start) }
            }
            _ => self.stray(start),
        })
    }

    /// What begins no word, up to the next space or letter.
    fn stray(&mut self, start: usize) -> Token {
        while self.peek().is_some_and(|byte| !byte.is_ascii_alphabetic() && !matches!(byte, b' ' | b'\t' | b'(' | b';' | b'%')) {
            self.at += 1;
        }
        Token::Fault { fault: WordFault::NoWord, range: self.range(start) }
    }

    fn skip_to_space(&mut self) {
        while self.peek().is_some_and(|byte| !matches!(byte, b' ' | b'\t' | b'(' | b';')) {
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
                return Token::Comment { range: self.range(start) };
            }
        }
        // Writers that nest an opening bracket without closing it mean the first closing one.
        if let Some(closing) = self.line[start..].iter().position(|&byte| byte == b')') {
            self.at = start + closing + 1;
            return Token::Comment { range: self.range(start) };
        }
        Token::Fault { fault: WordFault::OpenComment, range: self.range(start) }
    }

    #[inline]
    fn word(&mut self, letter: u8) -> Token {
        let start = self.at;
        self.at += 1;
        self.skip_space();
        match self.number(letter) {
            Ok(Some(number)) => {
                if matches!(letter, b'C' | b'D' | b'E' | b'H' | b'T' | b'S' | b'F') && self.is_definition() {
                    return self.definition(letter, number, start);
                }
                Token::Word { letter, number, range: self.range(start) }
            }
            Ok(None) => self.without_number(letter, start),
            Err(fault) => Token::Fault { fault, range: self.range(start) },
        }
    }

    /// A letter that no number follows: the name of something, an expression, or a fault.
    fn without_number(&mut self, letter: u8, start: usize) -> Token {
        match self.peek() {
            Some(b'#' | b'[' | b'=') => {
                self.skip_to_space();
                return Token::Foreign { range: self.range(start) };
            }
            _ => self.at = start + 1,
        }
        let letters = self.line[start..].iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
        if letters >= 3 {
            self.at = start;
            while self.peek().is_some_and(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b',' | b'.' | b'-' | b'+' | b'=')) {
                self.at += 1;
            }
            return Token::Foreign { range: self.range(start) };
        }
        Token::Fault { fault: WordFault::NoNumber { letter }, range: self.range(start) }
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
        let value = self.number(letter).ok().flatten();
        let end = self.at;
        let mut listed = false;
        while self.peek().is_some_and(|byte| !byte.is_ascii_alphabetic() && !matches!(byte, b'(' | b';')) {
            listed |= self.peek().is_some_and(|byte| !matches!(byte, b' ' | b'\t'));
            self.at += 1;
        }
        if !listed {
            self.at = end;
        }
        Token::Definition { letter, index, value: value.filter(|_| !listed), range: self.range(start) }
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
            } else {
                break;
            }
            at += 1;
        }
        if at - digits_from == usize::from(point) {
            return Ok(None);
        }
        self.at = at;
        if matches!(self.peek(), Some(b'.' | b',')) {
            self.skip_to_space();
            return Err(WordFault::NotANumber { letter });
        }
        if whole > MOST_DIGITS {
            return Err(WordFault::TooManyDigits { digits: whole });
        }
        let mantissa = if sign == Some(b'-') { -mantissa } else { mantissa };
        Ok(Some(Number { mantissa, decimals: decimals as u8, point }))
    }
}
