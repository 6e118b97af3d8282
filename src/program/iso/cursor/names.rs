//! What has no number: names, and conditions of macros.

use super::super::names::{Unfollowed, meaning};
use super::super::word::{Token, WordFault};
use super::Cursor;

impl Cursor<'_> {
    /// Whether `<` at `start` begins the name of a program, `<PLATE-1>`, alone in its line.
    pub(super) fn is_name(&self, start: usize) -> bool {
        let behind = self.line[start..].trim_ascii_end();
        self.line[..start].iter().all(u8::is_ascii_whitespace)
            && behind.len() > 2
            && behind.iter().position(|byte| *byte == b'>') == Some(behind.len() - 1)
    }

    /// Whether a name at `start` has an O where a number may have a zero: `LOOP`.
    #[inline]
    pub(super) fn begins_with_a_name(&self, start: usize) -> bool {
        matches!(self.line.get(start + 1), Some(b'O' | b'o'))
            && meaning(self.letters_at(start)).is_some()
    }

    fn letters_at(&self, start: usize) -> &[u8] {
        let rest = &self.line[start..];
        let count = rest
            .iter()
            .take_while(|byte| byte.is_ascii_alphabetic())
            .count();
        &rest[..count]
    }

    /// A letter without a number: the name of something, an expression, or a fault.
    pub(super) fn without_number(&mut self, letter: u8, start: usize) -> Token {
        match self.peek() {
            Some(b'=') => {
                self.skip_to_space();
                return match b"GXYIJR".contains(&letter) {
                    true => Token::Fault(WordFault::Expression { letter }),
                    false => Token::Foreign,
                };
            }
            _ => self.at = start + 1,
        }
        let name = self.letters_at(start);
        let letters = name.len();
        if let Some(what) = meaning(name) {
            if matches!(
                what,
                Some(Unfollowed::Jump | Unfollowed::Repeat | Unfollowed::Call)
            ) {
                self.variables.forget();
            }
            self.at = start + letters;
            self.skip(|byte| !matches!(byte, b'(' | b';' | b'%'));
            self.leave_space(start);
            return Token::Foreign;
        }
        // `RA90.` turns what follows. `TP0.0`: a name of two letters that no word of the path begins with.
        if letters == 2 && (name.eq_ignore_ascii_case(b"RA") || b"ABCEQSTUVWZ".contains(&letter)) {
            self.at = start + 2;
            if matches!(self.number(letter), Ok(Some(_))) {
                return Token::Foreign;
            }
            self.at = start + 1;
        }
        if letters >= 3 {
            self.at = start;
            self.skip(|byte| {
                byte.is_ascii_alphanumeric()
                    || matches!(byte, b'_' | b',' | b'.' | b'-' | b'+' | b'=')
            });
            return match letter {
                // `XABC5`: it may well be a coordinate.
                b'X' | b'Y' => Token::Fault(WordFault::NoNumber { letter }),
                _ => Token::Foreign,
            };
        }
        Token::Fault(WordFault::NoNumber { letter })
    }
}
