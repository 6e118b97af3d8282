//! A line of 3B cut into its pieces: which byte belongs to which field, damaged lines too.
//!
//! The reader in [`super::parse`] says what a sound line means. Here nothing is judged: an editor asks where the cursor stands
//! while a block is still being written.

use crate::program::three_b::around::{before_comment, is_remark, start_point, two_numbers};
use crate::program::three_b::words::{Word, Words};
use std::ops::Range;

/// What a piece of a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Field {
    /// `N12`, with the colon where one stands.
    Number,
    /// The letter `B` before a number.
    Separator,
    X,
    Y,
    J,
    /// The fourth number of a 4B block: the radius.
    Radius,
    /// `GX` or `GY`.
    Axis,
    /// `D` or `DD` within a 4B block: convex or concave.
    Convexity,
    /// `L1` … `L4`, `SR1` … `SR4`, `NR1` … `NR4`.
    Motion,
    Pause,
    End,
    /// Absolute end point behind a block, with the `;` where one stands.
    Coordinates,
    /// `Start Point = x , y`, with the `;` where one stands.
    StartPoint,
    /// From `;` or `*` on.
    Comment,
    /// What no field is.
    Strange,
}

/// A piece of a line; bytes from the beginning of the line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Piece {
    pub(crate) field: Field,
    pub(crate) range: Range<usize>,
}

/// Cuts a line, without its line end, into pieces. Space between them belongs to none.
pub(crate) fn pieces(line: &[u8], words: &Words<'_>) -> Vec<Piece> {
    let mut cutter = Cutter {
        line,
        at: if line.starts_with(b"\xef\xbb\xbf") {
            3
        } else {
            0
        },
        block: Expected::Nothing,
        is_behind_block: false,
    };
    let mut found = Vec::with_capacity(12);
    while let Some(piece) = cutter.next(words) {
        found.push(piece);
    }
    found
}

/// How far a block has come.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Expected {
    /// No block is under way.
    Nothing,
    /// So many numbers have begun.
    Numbers(u8),
    /// G has been read.
    Motion,
}

struct Cutter<'a> {
    line: &'a [u8],
    at: usize,
    block: Expected,
    /// A block has begun in this line.
    is_behind_block: bool,
}

impl Cutter<'_> {
    fn skip_space(&mut self) {
        while matches!(
            self.line.get(self.at),
            Some(b' ' | b'\t' | 0x0b | 0x0c | 0x1a | b'|')
        ) {
            self.at += 1;
        }
    }

    /// The next byte behind space that is one of `wanted`, in either case; the cursor moves only then.
    fn take_behind_space(&mut self, wanted: &[u8]) -> bool {
        let before = self.at;
        self.skip_space();
        match self.line.get(self.at) {
            Some(byte) if wanted.contains(&byte.to_ascii_uppercase()) => {
                self.at += 1;
                true
            }
            _ => {
                self.at = before;
                false
            }
        }
    }

    fn digits(&mut self) -> bool {
        let start = self.at;
        while matches!(self.line.get(self.at), Some(b'0'..=b'9')) {
            self.at += 1;
        }
        self.at > start
    }

    fn next(&mut self, words: &Words<'_>) -> Option<Piece> {
        self.skip_space();
        let start = self.at;
        let byte = *self.line.get(start)?;
        let rest = &self.line[start..];
        if self.is_behind_block
            && self.block == Expected::Nothing
            && is_remark(self.line, start, words)
        {
            self.run_to_end();
            return Some(Piece {
                field: Field::Comment,
                range: start..self.at,
            });
        }
        let field = match byte.to_ascii_uppercase() {
            b';' => self.behind_semicolon(rest),
            b'0'..=b'9' | b'(' if !self.is_behind_block && self.row_number() => Field::Number,
            b'*' | b'#' | b'%' | b'\'' | b'"' | b'/' | b'(' | 0x80.. => {
                self.run_to_end();
                Field::Comment
            }
            b'B' if !self.is_word(words) => {
                self.at += 1;
                self.is_behind_block = true;
                self.block = match self.block {
                    Expected::Numbers(count) if count < 4 => Expected::Numbers(count + 1),
                    _ => Expected::Numbers(1),
                };
                Field::Separator
            }
            b'0'..=b'9'
                if self.block_number_field().is_some() && self.number_is_missing_before() =>
            {
                self.digits();
                self.block_number_field().unwrap_or(Field::Strange)
            }
            b'0'..=b'9' | b'-' | b'+' | b'.'
                if start > 0 && two_numbers(before_comment(rest)).is_some() =>
            {
                self.at = start + before_comment(rest).trim_ascii_end().len();
                Field::Coordinates
            }
            b'G' if matches!(self.block, Expected::Numbers(_)) => {
                self.at += 1;
                if self.take_behind_space(b"XY") {
                    self.block = Expected::Motion;
                    Field::Axis
                } else {
                    self.strange(start)
                }
            }
            b'L' if self.block == Expected::Motion => self.motion(start, 1),
            b'S' | b'N' if self.block == Expected::Motion && self.next_is(b'R') => {
                self.motion(start, 2)
            }
            b'D' if self.block == Expected::Motion && self.is_convexity() => {
                self.at += if self.next_is(b'D') { 2 } else { 1 };
                Field::Convexity
            }
            b'N' if !self.is_word(words) => {
                self.at += 1;
                self.skip_space();
                if self.digits() {
                    self.take_behind_space(b":");
                    self.block = Expected::Nothing;
                    Field::Number
                } else {
                    self.at = start;
                    self.strange(start)
                }
            }
            _ => self.word(words, rest, start),
        };
        Some(Piece {
            field,
            range: start..self.at,
        })
    }

    /// The number that the last separator opened.
    fn block_number_field(&self) -> Option<Field> {
        match self.block {
            Expected::Numbers(1) => Some(Field::X),
            Expected::Numbers(2) => Some(Field::Y),
            Expected::Numbers(3) => Some(Field::J),
            Expected::Numbers(4) => Some(Field::Radius),
            _ => None,
        }
    }

    /// True when nothing but space stands between the last `B` and the cursor.
    fn number_is_missing_before(&self) -> bool {
        self.line[..self.at]
            .trim_ascii_end()
            .last()
            .is_some_and(|byte| byte.eq_ignore_ascii_case(&b'B'))
    }

    fn next_is(&self, letter: u8) -> bool {
        self.line
            .get(self.at + 1)
            .is_some_and(|byte| byte.eq_ignore_ascii_case(&letter))
    }

    /// `D` or `DD` with the motion of a 4B block behind it.
    fn is_convexity(&self) -> bool {
        let rest = &self.line[self.at..];
        let letters = rest
            .iter()
            .take_while(|byte| byte.eq_ignore_ascii_case(&b'D'))
            .count();
        let behind = rest[letters..].trim_ascii_start().first();
        letters <= 2
            && behind.is_some_and(|byte| matches!(byte.to_ascii_uppercase(), b'L' | b'S' | b'N'))
    }

    /// True when the letters and digits at the cursor are a pause or end word.
    fn is_word(&self, words: &Words<'_>) -> bool {
        words
            .meaning(words.letters_of(&self.line[self.at..]))
            .is_some()
    }

    /// The number of a row: `12 `, `12.`, `12:`, `12)`, `(12)`, with a block behind it.
    fn row_number(&mut self) -> bool {
        let start = self.at;
        self.at += usize::from(self.line.get(start) == Some(&b'('));
        let has_digits = self.digits();
        let mark = self.line.get(self.at).copied();
        self.at += usize::from(matches!(mark, Some(b')' | b':' | b'.')));
        // A bare number that hangs on the block is one of its own that lost its B.
        let has_digits = has_digits && !mark.is_some_and(|byte| byte.eq_ignore_ascii_case(&b'B'));
        let (end, mut behind) = (self.at, self.line[self.at..].iter());
        let is_number = has_digits
            && behind
                .find(|byte| !matches!(byte, b' ' | b'\t'))
                .is_some_and(|byte| byte.eq_ignore_ascii_case(&b'B'));
        self.at = if is_number { end } else { start };
        is_number
    }

    fn motion(&mut self, start: usize, letters: usize) -> Field {
        self.at += letters;
        if self.take_behind_space(b"1234") {
            self.block = Expected::Nothing;
            Field::Motion
        } else {
            self.at = start;
            self.strange(start)
        }
    }

    fn word(&mut self, words: &Words<'_>, rest: &[u8], start: usize) -> Field {
        let letters = words.letters_of(rest);
        if let Some(word) = words.meaning(letters) {
            self.at += letters.len();
            self.block = Expected::Nothing;
            return match word {
                Word::Pause => Field::Pause,
                Word::End => Field::End,
            };
        }
        if start_point(rest).is_some() {
            self.run_to_end();
            return Field::StartPoint;
        }
        self.strange(start)
    }

    fn behind_semicolon(&mut self, rest: &[u8]) -> Field {
        if start_point(&rest[1..]).is_some() {
            self.run_to_end();
            return Field::StartPoint;
        }
        let numbers = before_comment(&rest[1..]);
        if two_numbers(numbers).is_some() {
            self.at += 1 + numbers.trim_ascii_end().len();
            return Field::Coordinates;
        }
        self.run_to_end();
        Field::Comment
    }

    /// To the end of the line, space left out.
    fn run_to_end(&mut self) {
        let rest = &self.line[self.at..];
        let length = rest
            .iter()
            .rposition(|byte| !matches!(byte, b' ' | b'\t' | 0x0b | 0x0c | 0x1a))
            .map_or(0, |last| last + 1);
        self.at += length.max(1);
    }

    /// To the next space or comment.
    fn strange(&mut self, start: usize) -> Field {
        let rest = &self.line[start..];
        let length = rest
            .iter()
            .position(|byte| byte.is_ascii_whitespace() || *byte == b';')
            .unwrap_or(rest.len());
        // At least one byte, so that there is an end.
        self.at = start + length.max(1);
        Field::Strange
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn check(line: &str, expected: &str) {
        let found = pieces(line.as_bytes(), &Words::default());
        let shown: Vec<String> = found
            .iter()
            .map(|piece| format!("{:?} {}", piece.field, &line[piece.range.clone()]))
            .collect();
        assert_eq!(shown.join(" | "), expected, "{line}");
    }

    #[test]
    fn lines_fall_into_their_fields() {
        check(
            "B9900B0B39600GYNR1",
            "Separator B | X 9900 | Separator B | Y 0 | Separator B | J 39600 | Axis GY | Motion NR1",
        );
        check(
            "BBB9900GXL1",
            "Separator B | Separator B | Separator B | J 9900 | Axis GX | Motion L1",
        );
        check(
            "n 12: b 1 b2 b 3 g x l 1",
            "Number n 12: | Separator b | X 1 | Separator b | Y 2 | Separator b | J 3 | Axis g x | Motion l 1",
        );
        check(
            "B1B0B1GXL1 ; 1.0 , -2 ; so",
            "Separator B | X 1 | Separator B | Y 0 | Separator B | J 1 | Axis GX | Motion L1 | Coordinates ; 1.0 , -2 | Comment ; so",
        );
        check(
            "B1B0B1GXL1 1 2",
            "Separator B | X 1 | Separator B | Y 0 | Separator B | J 1 | Axis GX | Motion L1 | Coordinates 1 2",
        );
        check(
            "B1B2B3B4GXDDSR3",
            "Separator B | X 1 | Separator B | Y 2 | Separator B | J 3 | Separator B | Radius 4 | Axis GX | Convexity DD | Motion SR3",
        );
        check("(12) B1", "Number (12) | Separator B | X 1");
        check("12 B1", "Number 12 | Separator B | X 1");
        check("|B 1|B 2|", "Separator B | X 1 | Separator B | Y 2");
        check("(plate)", "Comment (plate)");
        check("; Start Point = 1 , 2", "StartPoint ; Start Point = 1 , 2");
        check(
            "B1B0B1GXL1 block N2",
            "Separator B | X 1 | Separator B | Y 0 | Separator B | J 1 | Axis GX | Motion L1 | Comment block N2",
        );
        check("D ; thread", "Pause D | Comment ; thread");
        check(
            "B1B2B3GXL1DD",
            "Separator B | X 1 | Separator B | Y 2 | Separator B | J 3 | Axis GX | Motion L1 | End DD",
        );
    }

    #[test]
    fn what_is_unfinished_or_damaged_is_cut_as_far_as_it_goes() {
        check("B1B", "Separator B | X 1 | Separator B");
        check(
            "B1B2B3G",
            "Separator B | X 1 | Separator B | Y 2 | Separator B | J 3 | Strange G",
        );
        check("9900B0B9900GXL1", "Strange 9900B0B9900GXL1");
        check("B1x2 D", "Separator B | X 1 | Strange x2 | Pause D");
        check("N", "Strange N");
    }

    proptest! {
        #[test]
        fn pieces_lie_one_behind_the_other_within_the_line(line in "([NBGXYLSRD0-9;:,. *é-]|start point = ){0,24}") {
            let mut at = 0;
            for piece in pieces(line.as_bytes(), &Words::default()) {
                prop_assert!(piece.range.start >= at && piece.range.end > piece.range.start && piece.range.end <= line.len());
                at = piece.range.end;
            }
        }
    }
}
