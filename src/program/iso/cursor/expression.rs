//! A number that is worked out: `#1`, `-#1`, `[#1+2.5]`, `#2*[#1-3.]`. It takes from the line what belongs to it, whether
//! its value is known or not.

use super::super::word::{Number, Token, WordFault};
use super::{Cursor, MOST_DIGITS};

/// Brackets within each other; more than controls take.
const DEEPEST: u32 = 16;

/// Values are worked out in parts of one.
const PARTS: i128 = 1_000_000_000;

/// The value of an expression as far as it is known.
#[derive(Clone, Copy)]
struct Value {
    parts: i128,
}

impl Value {
    fn of(number: Number) -> Option<Value> {
        let scale = PARTS / 10_i128.checked_pow(u32::from(number.decimals))?;
        Some(Value {
            parts: i128::from(number.mantissa) * scale,
        })
    }

    /// The result of an operation; `None` where it has more digits than a number may have.
    fn joined(self, sign: u8, other: Value) -> Option<Value> {
        let parts = match sign {
            b'+' => self.parts + other.parts,
            b'-' => self.parts - other.parts,
            b'*' => rounded(self.parts * other.parts, PARTS)?,
            _ => rounded(self.parts * PARTS, other.parts)?,
        };
        let most = PARTS * 10_i128.pow(MOST_DIGITS);
        (parts.abs() < most).then_some(Value { parts })
    }

    /// With as many decimals as it needs. What is worked out is no whole number of steps, with or without a point.
    fn number(self) -> Option<Number> {
        let (mut mantissa, mut decimals) = (self.parts, 9);
        while decimals > 0 && mantissa % 10 == 0 {
            (mantissa, decimals) = (mantissa / 10, decimals - 1);
        }
        Some(Number {
            mantissa: i64::try_from(mantissa).ok()?,
            decimals,
            point: true,
        })
    }
}

/// A quotient, rounded; `None` where it is divided by 0.
fn rounded(parts: i128, by: i128) -> Option<i128> {
    let half = by.abs() / 2 * parts.signum() * by.signum();
    (parts + half * by.signum()).checked_div(by)
}

/// A word with this letter says where the wire goes, or what of the program runs: without its number nobody knows.
fn decides(letter: u8) -> bool {
    b"GXYIJRDHM".contains(&letter)
}

/// Its number is not worked out: blocks are found, called and ended by those that the text states, and a lean of the wire
/// is read elsewhere.
fn is_stated(letter: u8) -> bool {
    b"NOMLPTUVA".contains(&letter)
}

impl Cursor<'_> {
    /// Whether a variable or a bracket stands at the cursor, behind its signs.
    #[inline]
    pub(super) fn begins_expression(&self) -> bool {
        match self.peek() {
            Some(b'#' | b'[') => true,
            Some(b'+' | b'-') => {
                let rest = self.line.get(self.at..).unwrap_or_default();
                let is_sign = |byte: &&u8| matches!(byte, b'+' | b'-' | b' ' | b'\t');
                let signs = rest.iter().take_while(is_sign).count();
                matches!(rest.get(signs), Some(b'#' | b'['))
            }
            _ => false,
        }
    }

    /// Whether the number before the cursor is the first of several: `X10.-#1`.
    #[inline]
    pub(super) fn goes_on_as_expression(&self, letter: u8) -> bool {
        matches!(self.peek(), Some(b'+' | b'-' | b'*' | b'/'))
            && matches!(self.line.get(self.at + 1), Some(b'#' | b'['))
            && !matches!(letter, b'N' | b'O')
    }

    /// A word whose number is worked out.
    pub(super) fn computed(&mut self, letter: u8) -> Token {
        match self.expression(0).filter(|_| !is_stated(letter)) {
            Some(number) => Token::Word { letter, number },
            None if decides(letter) => Token::Fault(WordFault::Expression { letter }),
            None => Token::Foreign,
        }
    }

    /// `#1=10.` after its `#`.
    pub(super) fn assignment(&mut self) {
        let number = self.variable();
        let end = self.at;
        self.skip_space();
        if self.peek() != Some(b'=') {
            self.at = end;
            return self.skip_to_space();
        }
        self.at += 1;
        self.skip_space();
        let mut value = self.expression(1);
        let is_name = |from: usize| {
            let next = self.line.get(from..from + 2);
            next.is_some_and(|next| next.iter().all(u8::is_ascii_alphabetic))
        };
        // `#3=#1MOD2`, `#1="A"`.
        let is_over = match self.peek() {
            Some(byte) if byte.is_ascii_alphabetic() => !is_name(self.at),
            Some(byte) => matches!(byte, b' ' | b'\t' | b'(' | b';' | b'%' | b'#'),
            None => true,
        };
        if !is_over {
            value = None;
            self.skip_to_space();
        }
        if let Some(number) = number {
            self.variables.set(number, value);
        }
    }

    /// The number of a variable after its `#`.
    fn variable(&mut self) -> Option<u16> {
        let begun = self.at;
        self.skip(|byte| byte.is_ascii_digit());
        let digits = self.line.get(begun..self.at)?;
        std::str::from_utf8(digits).ok()?.parse().ok()
    }

    /// The value of what stands at the cursor; `None` where it is not known. Within brackets, and behind `=`, spaces belong
    /// to it.
    pub(super) fn expression(&mut self, depth: u32) -> Option<Number> {
        self.sum_of(depth)?.number()
    }

    fn sum_of(&mut self, depth: u32) -> Option<Value> {
        let mut value = self.product(depth);
        while let Some(sign) = self.operator(b"+-", depth) {
            let other = self.product(depth);
            value = value.zip(other).and_then(|(a, b)| a.joined(sign, b));
        }
        value
    }

    fn product(&mut self, depth: u32) -> Option<Value> {
        let mut value = self.factor(depth);
        while let Some(sign) = self.operator(b"*/", depth) {
            let other = self.factor(depth);
            value = value.zip(other).and_then(|(a, b)| a.joined(sign, b));
        }
        value
    }

    fn operator(&mut self, among: &[u8], depth: u32) -> Option<u8> {
        let begun = self.at;
        if depth > 0 {
            self.skip_space();
        }
        let found = self.peek().filter(|byte| among.contains(byte));
        match found {
            Some(_) if depth > 0 => {
                self.at += 1;
                self.skip_space();
            }
            Some(_) => self.at += 1,
            None => self.at = begun,
        }
        found
    }

    fn factor(&mut self, depth: u32) -> Option<Value> {
        let mut is_negative = false;
        while let Some(sign @ (b'+' | b'-' | b' ' | b'\t')) = self.peek() {
            is_negative ^= sign == b'-';
            self.at += 1;
        }
        let value = match self.peek()? {
            b'#' => {
                self.at += 1;
                if self.peek() == Some(b'[') {
                    self.bracket(depth);
                    return None;
                }
                let number = self.variable();
                Value::of(self.variables.value(number?)?)
            }
            b'[' => self.bracket(depth),
            b'.' | b'0'..=b'9' => self.plain_number(),
            _ => self.function(depth),
        };
        value.map(|Value { parts }| Value {
            parts: if is_negative { -parts } else { parts },
        })
    }

    /// `[ … ]`, however its inside is read.
    fn bracket(&mut self, depth: u32) -> Option<Value> {
        let begun = self.at;
        self.at += 1;
        let value = match depth < DEEPEST {
            true => self.sum_of(depth + 1),
            false => None,
        };
        self.skip_space();
        if self.peek() == Some(b']') {
            self.at += 1;
            return value;
        }
        self.at = begun;
        let mut open = 0_usize;
        while let Some(byte) = self.peek() {
            self.at += 1;
            match byte {
                b'[' => open += 1,
                b']' => open -= 1,
                _ => {}
            }
            if open == 0 {
                break;
            }
        }
        None
    }

    /// `SQRT[ … ]`: nobody works it out here.
    fn function(&mut self, depth: u32) -> Option<Value> {
        let begun = self.at;
        self.skip(|byte| byte.is_ascii_alphabetic());
        match self.at > begun + 1 && self.peek() == Some(b'[') {
            true => _ = self.bracket(depth),
            false => self.at = begun,
        }
        None
    }

    fn plain_number(&mut self) -> Option<Value> {
        let number = self.number(b'#');
        Value::of(number.ok().flatten()?)
    }
}
