//! Names in a program: lines by their number, and rows of the control's tables. Where a name is defined, and where it
//! is used.

use super::at_byte;
use crate::ide::occurrence::{Occurrence, Role, Stop, Stopped};
use crate::program::iso::block::read_line;
use crate::program::iso::document::Document;
use crate::program::iso::plain::words;
use crate::program::iso::word::Token;
use std::ops::Range;

/// This many lines are searched for rows of a program's own tables when the user points at a word:
/// these rows are at its head.
const HEAD: usize = 10_000;

/// A name that something in a program has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Name {
    /// A line, `N12` or `O12`, which `M98 P12` calls.
    Line(u32),
    /// A row of a table: `H1 = .0085`, `C001 = ON 8 …`, `E1 = …`; `H1`, `C001` and `E1` choose it.
    Row { letter: u8, index: u32 },
}

impl Name {
    /// True where a line has the letter that begins each place of the name; other lines need not be
    /// read.
    fn is_in(self, line: &[u8]) -> bool {
        let has = |letters: &[u8]| {
            line.iter()
                .any(|byte| !byte.is_ascii() || letters.contains(&byte.to_ascii_uppercase()))
        };
        match self {
            Name::Line(_) => has(b"NO:P"),
            Name::Row { letter, .. } => has(&[letter]),
        }
    }
}

/// The name at a byte.
fn name_at(document: &Document, offset: usize) -> Option<Name> {
    let text = document.text();
    let line = text.line_of(offset);
    let mut names = Vec::new();
    each_in(text.line(line), text.line_start(line), |name, range, _| {
        names.push((name, range));
    });
    Some(at_byte(names, offset)?.0)
}

/// Every place of the name at a byte, in the order of the text, at most `limit`.
pub(in crate::ide::program) fn named(
    document: &Document,
    offset: usize,
    limit: usize,
    stop: Stop<'_>,
) -> Result<Vec<Occurrence>, Stopped> {
    let Some(wanted) = name_at(document, offset) else {
        return Ok(Vec::new());
    };
    let text = document.text();
    let mut found = Vec::new();
    for line in 0..text.line_count() {
        if line % 4096 == 0 && stop() {
            return Err(Stopped);
        }
        let bytes = text.line(line);
        if wanted.is_in(bytes) {
            each_in(bytes, text.line_start(line), |name, range, role| {
                if name == wanted && found.len() < limit {
                    found.push(Occurrence { range, role });
                }
            });
        }
    }
    Ok(found)
}

/// The line that defines a row of a table, from 0.
pub(super) fn line_of_row(document: &Document, letter: u8, index: u32) -> Option<usize> {
    let text = document.text();
    let wanted = Name::Row { letter, index };
    (0..text.line_count().min(HEAD)).find(|&line| {
        let bytes = text.line(line);
        let mut defines = false;
        if bytes.contains(&b'=') && wanted.is_in(bytes) {
            each_in(bytes, 1, |name, _, role| {
                defines |= name == wanted && role == Role::Defines;
            });
        }
        defines
    })
}

/// Hands each name of a line to `each`.
fn each_in(line: &[u8], offset: usize, mut each: impl FnMut(Name, Range<usize>, Role)) {
    let call = read_line(line, offset, |_| {}).call;
    words(line, offset, |token, range| match token {
        Token::Word {
            letter: b'N' | b'O',
            number,
        } => {
            if let Some(number) = number.index() {
                each(Name::Line(number), range, Role::Defines);
            }
        }
        Token::Word {
            letter: b'P',
            number,
        } => {
            if let Some(number) = number.index().filter(|number| call == Some(*number)) {
                each(Name::Line(number), range, Role::Uses);
            }
        }
        Token::Word { letter, number } if is_of_table(letter) => {
            if let Some(index) = number.index() {
                each(Name::Row { letter, index }, range, Role::Uses);
            }
        }
        Token::Definition { letter, index, .. } | Token::Sum { letter, index, .. }
            if is_of_table(letter) =>
        {
            let of_row = line.get(range.start - offset..range.end - offset);
            let Some((row, of_row)) = index.index().zip(of_row) else {
                return;
            };
            // The word before the sign is the name; places after it are used.
            let sign = of_row.iter().position(|byte| *byte == b'=').unwrap_or(0);
            let name = of_row[..sign].trim_ascii_end().len();
            let place = range.start..range.start + name;
            each(Name::Row { letter, index: row }, place, Role::Defines);
            let behind = range.start + sign + 1;
            for (letter, index, place) in places_in(&of_row[sign + 1..]) {
                let place = behind + place.start..behind + place.end;
                each(Name::Row { letter, index }, place, Role::Uses);
            }
        }
        _ => {}
    });
}

/// The rows that a sum names, `.0085 + H175`.
fn places_in(sum: &[u8]) -> Vec<(u8, u32, Range<usize>)> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(&byte) = sum.get(at) {
        let letter = byte.to_ascii_uppercase();
        let digits = sum[at + 1..]
            .iter()
            .take_while(|byte| byte.is_ascii_digit())
            .count();
        let end = at + 1 + digits;
        if matches!(letter, b'D' | b'H')
            && let Some(index) = std::str::from_utf8(&sum[at + 1..end])
                .ok()
                .and_then(|digits| digits.parse().ok())
        {
            found.push((letter, index, at..end));
            at = end;
        } else {
            at += 1;
        }
    }
    found
}

/// Corrections, conditions of the generator, machining conditions.
fn is_of_table(letter: u8) -> bool {
    matches!(letter, b'D' | b'H' | b'C' | b'E')
}
