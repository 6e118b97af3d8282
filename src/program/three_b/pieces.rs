//! The field of each byte of a line, in damaged lines too: an editor asks for the field at the cursor while a block is
//! being written.

#![warn(clippy::indexing_slicing)]

use super::fault::Flaw;
use super::fields::{Number, Scan, fields_of};
use super::line::{Item, Token, Tokens, readable};
use super::words::{Word, Words};
use std::ops::Range;

/// The kind of a piece of a line.
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
    /// Absolute end point after a block, with its `;` if any.
    Coordinates,
    /// `Start Point = x , y`, with its `;` if any.
    StartPoint,
    /// From `;` or `*` on.
    Comment,
    /// Not a field.
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
    let plain = readable(line);
    let mut cutter = Cutter {
        line: &plain,
        raw: line,
        begun: 0,
        found: Vec::with_capacity(12),
    };
    let mut tokens = Tokens::of(&plain, 0, words);
    loop {
        tokens.skip_space();
        let before = tokens;
        let start = tokens.at;
        let Some(token) = tokens.next() else {
            return cutter.found;
        };
        let field = match token {
            Token::Number(_) => Field::Number,
            Token::Coordinates(_) => Field::Coordinates,
            Token::Comment => Field::Comment,
            Token::Item(Item::Block { range, number, .. }, _) => {
                let before = number.map_or(Field::Strange, |_| Field::Number);
                cutter.push(before, start..range.start);
                cutter.push_block(range);
                cutter.begun = 0;
                continue;
            }
            Token::Item(item, _) => field_of(&item),
        };
        if field == Field::Strange {
            tokens = before;
            tokens.at = cutter.push_broken(start);
        } else {
            cutter.begun = 0;
            cutter.push(field, start..tokens.at);
        }
    }
}

fn field_of(item: &Item) -> Field {
    match item {
        Item::Word { word, .. } if *word == Word::End => Field::End,
        Item::Word { .. } => Field::Pause,
        Item::StartPoint { .. } => Field::StartPoint,
        Item::CommentedBlock { .. } => Field::Comment,
        Item::Fault(fault) if fault.flaw == Flaw::DecimalCommas => Field::Coordinates,
        Item::Fault(fault) if fault.flaw == Flaw::FarStart => Field::StartPoint,
        Item::Block { .. } | Item::Text { .. } | Item::Fault(_) => Field::Strange,
    }
}

struct Cutter<'a> {
    line: &'a [u8],
    /// As it stands.
    raw: &'a [u8],
    /// Numbers of a broken block so far.
    begun: usize,
    found: Vec<Piece>,
}

impl Cutter<'_> {
    /// A piece without the space at its end; before a block, without the bars of its table.
    fn push(&mut self, field: Field, range: Range<usize>) {
        let is_before = matches!(field, Field::Number | Field::Strange);
        let is_own = |byte: &u8| match byte {
            b' ' | b'\t' | 0x0b | 0x0c | 0x1a => false,
            b'|' | b',' => !is_before,
            _ => true,
        };
        let text = self.line.get(range.clone()).unwrap_or_default();
        let Some(last) = text.iter().rposition(is_own) else {
            return;
        };
        let mut end = range.start + last + 1;
        // A wide mark takes more bytes than the one that it is read as.
        let raw = |at: usize| self.raw.get(at).copied().unwrap_or(b' ');
        while raw(end - 1) >= 0x80 && self.line.get(end) == Some(&b' ') && raw(end) != b' ' {
            end += 1;
        }
        self.add(field, range.start..end);
    }

    /// A piece, where it is not empty.
    fn add(&mut self, field: Field, range: Range<usize>) {
        if !range.is_empty() {
            self.found.push(Piece { field, range });
        }
    }

    /// The pieces of a block that can be read.
    fn push_block(&mut self, range: Range<usize>) {
        let Some(fields) = fields_of(self.line, range) else {
            return;
        };
        let first = self.push_number(fields.first, Field::X, fields.x);
        let second = self.push_number(first, Field::Y, fields.y);
        let third = self.push_number(second, Field::J, fields.j);
        if let Some(radius) = fields.radius {
            self.push_number(third, Field::Radius, radius);
        }
        self.add(Field::Axis, fields.axis);
        self.add(Field::Convexity, fields.side.unwrap_or_default());
        self.add(Field::Motion, fields.motion);
    }

    /// A number with any `B` from a byte on; and its end.
    fn push_number(&mut self, from: usize, field: Field, digits: Range<usize>) -> usize {
        let before = self.line.get(from..digits.start).unwrap_or_default();
        if let Some(b) = memchr::memchr2(b'B', b'b', before) {
            self.add(Field::Separator, from + b..from + b + 1);
        }
        let end = digits.end;
        self.add(field, digits);
        end
    }

    /// The pieces of an unfinished or unreadable block, as far as its numbers lead with their `B`, and after them one
    /// that is none, up to the next space or comment; and their end.
    fn push_broken(&mut self, start: usize) -> usize {
        const FIELDS: [Field; 4] = [Field::X, Field::Y, Field::J, Field::Radius];
        let scan = Scan::at(self.line, start);
        let mut numbers = scan.numbers();
        let mut end = start;
        if let [row @ Number { b: None, .. }, rest @ ..] = numbers
            && let [Number { b: Some(b), .. }, ..] = rest
            && *b > row.digits.end
        {
            end = row.digits.end;
            self.push(Field::Number, start..end);
            numbers = rest;
        }
        for number in numbers.iter().take_while(|number| number.b.is_some()) {
            let field = FIELDS.get(self.begun).copied().unwrap_or(Field::X);
            end = self.push_number(end, field, number.digits.clone());
            self.begun = (self.begun + 1) % FIELDS.len();
        }
        if numbers.iter().all(|number| number.b.is_some()) && scan.axis.is_some() {
            self.add(Field::Axis, scan.axis_range);
            self.add(Field::Convexity, scan.side_range);
            self.add(Field::Motion, scan.motion_range);
            end = scan.end;
        }
        let rest = self.line.get(end..).unwrap_or_default();
        let is_over = |byte: &u8| byte.is_ascii_whitespace() || *byte == b';';
        let length = rest.iter().position(is_over).unwrap_or(rest.len());
        // At least one byte, so that there is an end.
        let behind = (end + length).max(start + 1);
        self.push(Field::Strange, end..behind);
        behind
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
    fn rows_of_tables_and_wide_marks_are_cut_as_they_are_read() {
        check(
            "| 1 | B | 9900 | B | 0 | B | 9900 | GX | L1 |",
            "Number 1 | Separator B | X 9900 | Separator B | Y 0 | Separator B | J 9900 | Axis GX | Motion L1",
        );
        check(
            "AB B1B2B2GYL1；1，2",
            "Strange AB | Separator B | X 1 | Separator B | Y 2 | Separator B | J 2 | Axis GY | Motion L1 | Coordinates ；1，2",
        );
        check("N3：B1B", "Number N3： | Separator B | X 1 | Separator B");
        check(
            "B25B1B2B2GYL1",
            "Number B25 | Separator B | X 1 | Separator B | Y 2 | Separator B | J 2 | Axis GY | Motion L1",
        );
        check(
            "2 B 0 Y B 000 B 5000 GY L2",
            "Number 2 | Separator B | X 0 | Strange Y | Separator B | Y 000 | Separator B | J 5000 | Axis GY | Motion L2",
        );
    }

    #[test]
    fn what_is_unfinished_or_damaged_is_cut_as_far_as_it_goes() {
        check("B1B", "Separator B | X 1 | Separator B");
        check(
            "B1B2B3G",
            "Separator B | X 1 | Separator B | Y 2 | Separator B | J 3 | Strange G",
        );
        check(
            "9900B0B9900GXL1",
            "X 9900 | Separator B | Y 0 | Separator B | J 9900 | Axis GX | Motion L1",
        );
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
