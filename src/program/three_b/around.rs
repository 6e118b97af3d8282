//! The text around the blocks of a line: numbers of rows, names, coordinates, remarks.

#![warn(clippy::indexing_slicing)]

use super::scan::Scan;
use super::words::{Words, word_of};
use crate::text::head;

/// A point after a block, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedPoint {
    pub(crate) at: [f64; 2],
    /// The fewest decimals of its two numbers.
    pub(crate) decimals: u8,
}

/// `N12`, `N 12`, `N12:`: the number, and its length in bytes.
pub(super) fn n_word(text: &[u8]) -> Option<(u32, usize)> {
    let digits = 1 + spaces(text, 1);
    let (number, length) = digits_of(text.get(digits..)?)?;
    let mut end = digits + length;
    let space = spaces(text, end);
    if text.get(end + space) == Some(&b':') {
        end += space + 1;
    }
    Some((number, end))
}

/// Spaces from a byte on.
fn spaces(text: &[u8], at: usize) -> usize {
    let rest = text.iter().skip(at);
    rest.take_while(|byte| matches!(byte, b' ' | b'\t')).count()
}

/// A marked row number: `(1)`, `1)`, `1.`, `1:`, `1、`.
pub(super) fn row_number(text: &[u8]) -> Option<(u32, usize)> {
    let opens = text.first() == Some(&b'(');
    let open = if opens { 1 + spaces(text, 1) } else { 0 };
    let (number, mut length) = digits_of(text.get(open..)?)?;
    if opens {
        length += spaces(text, open + length);
    }
    let behind = text.get(open + length..)?;
    let mark = match (opens, behind.first()?) {
        (_, b')') => 1,
        (false, b':') => 1,
        (false, b',') if !behind.get(1).is_some_and(u8::is_ascii_digit) => 1,
        (false, b'.') if !behind.get(1).is_some_and(u8::is_ascii_digit) => 1,
        _ => return None,
    };
    Some((number, open + length + mark))
}

/// The bare number of a row with a word in it.
pub(super) fn row_of_word(text: &[u8], words: &Words<'_>) -> Option<(u32, usize)> {
    let (number, length) = digits_of(text)?;
    let behind = text.get(length..)?;
    let is_between = |byte: &&u8| matches!(byte, b' ' | b'\t' | b'|' | b',');
    let between = behind.iter().take_while(is_between).count();
    let word = word_of(behind.get(between..)?);
    (between > 0 && words.meaning(word).is_some()).then_some((number, length))
}

fn digits_of(text: &[u8]) -> Option<(u32, usize)> {
    let length = text.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let digits = std::str::from_utf8(text.get(..length)?)
        .ok()
        .filter(|digits| !digits.is_empty())?;
    Some((digits.parse().unwrap_or(u32::MAX), length))
}

/// Two numbers with commas for points, as some languages write them.
pub(super) fn has_decimal_commas(text: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(text) else {
        return false;
    };
    if text.bytes().filter(|byte| *byte == b',').count() < 2 || text.contains('.') {
        return false;
    }
    let is_number = |word: &str| {
        let digits = word.trim_start_matches(['-', '+']);
        digits.split_once(',').is_some_and(|(whole, places)| {
            let all = |digits: &str| digits.bytes().all(|byte| byte.is_ascii_digit());
            !whole.is_empty() && !places.is_empty() && all(whole) && all(places)
        })
    };
    let words: Vec<&str> = text
        .split(|c: char| c.is_ascii_whitespace() || c == ';')
        .filter(|word| !word.is_empty() && *word != ",")
        .collect();
    matches!(words[..], [x, y] if is_number(x.trim_end_matches(',')) && is_number(y))
}

/// The bytes before a sound block where they name it: they are neither a word nor part of a block.
pub(super) fn label(text: &[u8], words: &Words<'_>) -> Option<usize> {
    // The mark of a comment comments a block out.
    let opens_comment = matches!(
        text.first(),
        Some(b';' | b'*' | b'#' | b'%' | b'\'' | b'"' | b'/')
    ) || [";", "(", "\u{ff1b}", "\u{ff08}"]
        .iter()
        .any(|mark| text.starts_with(mark.as_bytes()));
    if opens_comment {
        return None;
    }
    let code = before_comment(text);
    let at = memchr::memchr2_iter(b'B', b'b', code).take(4).find(|&at| {
        code.get(at..)
            .and_then(|text| Scan::of(text).sound())
            .is_some()
    })?;
    let name = code.get(..at)?.trim_ascii();
    let is_word = name
        .split(|byte| !byte.is_ascii_alphanumeric())
        .any(|word| !word.is_empty() && words.meaning(word).is_some());
    // A number alone is that of the row, or of the block.
    let is_number = name.strip_suffix(b",").unwrap_or(name).iter().all(|byte| {
        byte.is_ascii_digit() || matches!(byte, b'N' | b'n' | b' ' | b'|' | b':' | b'.' | b')')
    });
    (at > 0 && !is_word && !is_number && !has_block_parts(name)).then_some(at)
}

/// Whether a text has anything of a block: `B` and a digit, `G` and an axis, a quadrant.
fn has_block_parts(text: &[u8]) -> bool {
    let is_part = |pair: &[u8]| {
        matches!(
            pair,
            [b'B' | b'b', b'0'..=b'9']
                | [b'G' | b'g', b'X' | b'Y' | b'x' | b'y']
                | [b'R' | b'r', b'1'..=b'4']
        )
    };
    text.windows(2).any(is_part)
}

/// Words after a block without the mark of a comment: a remark on the block. At least two letters that begin nothing
/// of a block, after a space.
pub(super) fn is_remark(line: &[u8], at: usize, words: &Words<'_>) -> bool {
    let rest = line.get(at..).unwrap_or_default();
    let is_letter = |byte: &&u8| byte.is_ascii_alphabetic();
    let letters = rest.iter().take_while(is_letter).count();
    let stands_apart = at
        .checked_sub(1)
        .and_then(|before| line.get(before))
        .is_some_and(|byte| matches!(byte, b' ' | b'\t' | b'|'));
    let is_bare =
        stands_apart && letters >= 2 && !rest.get(letters).is_some_and(u8::is_ascii_digit);
    is_bare
        && words.meaning(head(rest, letters)).is_none()
        && !wants_to_be_a_block(rest)
        && Scan::of(rest).sound().is_none()
}

/// Whether text has enough of a block to be a broken one.
pub(super) fn wants_to_be_a_block(text: &[u8]) -> bool {
    let code = before_comment(head(text, 160));
    // Letters B, and those with a digit after them; axes; quadrants.
    let (mut letters, mut numbers, mut axes, mut ends) = (0, 0, 0, 0);
    let is_letter =
        |byte: &u8| matches!(byte, b'B' | b'b' | b'G' | b'g' | b'L' | b'l' | b'R' | b'r');
    for (at, letter) in code.iter().enumerate().filter(|(_, byte)| is_letter(byte)) {
        let mut behind = code.iter().skip(at + 1);
        let next = behind.find(|byte| !matches!(byte, b' ' | b'\t' | b'|'));
        let is_digit = next.is_some_and(u8::is_ascii_digit);
        match letter {
            b'B' | b'b' => {
                letters += 1;
                numbers += usize::from(is_digit);
            }
            b'G' | b'g' => axes += usize::from(matches!(next, Some(b'X' | b'Y' | b'x' | b'y'))),
            _ => ends += usize::from(is_digit),
        }
    }
    let begins = matches!(code.first(), Some(b'B' | b'b' | b'0'..=b'9'));
    let kinds = usize::from(numbers > 0) + usize::from(axes > 0) + usize::from(ends > 0);
    kinds >= 2 || begins && (numbers >= 2 || kinds == 1 && letters >= 2)
}

/// Whether a text in look-alike letters has the parts of a block: three numbers, an axis and a quadrant.
pub(super) fn looks_like_a_block(text: &[u8]) -> bool {
    let text = head(text, 160);
    let follows = |first: &[u8], second: fn(u8) -> bool| {
        let mut pairs = text.iter().zip(text.iter().skip(1));
        pairs.any(|(one, other)| first.contains(&one.to_ascii_uppercase()) && second(*other))
    };
    let numbers = text
        .chunk_by(|a, b| a.is_ascii_digit() == b.is_ascii_digit())
        .filter(|run| run.first().is_some_and(u8::is_ascii_digit))
        .count();
    numbers >= 4
        && follows(b"G", |byte| matches!(byte, b'X' | b'x' | b'Y' | b'y'))
        && follows(b"LR", |byte| matches!(byte, b'1'..=b'4'))
}

/// The point of a header.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum StartPoint {
    At([f64; 2]),
    /// Two numbers, of which one is no place of a machine.
    Far,
    DecimalCommas,
}

/// The point of `Start Point = x , y`.
pub(super) fn start_point(text: &[u8]) -> Option<StartPoint> {
    const NAME: &[u8] = b"start point";
    let (name, value) = text.trim_ascii_start().split_at_checked(NAME.len())?;
    if !name.eq_ignore_ascii_case(NAME) {
        return None;
    }
    let value = value.trim_ascii_start();
    let value = value
        .strip_prefix(b"=")
        .or_else(|| value.strip_prefix(b":"))?;
    let value = before_comment(value);
    if has_decimal_commas(value) {
        return Some(StartPoint::DecimalCommas);
    }
    let [x, y] = numbers_in(value).filter(|_| value.len() < FARTHEST)?.0;
    Some(match is_reached(x) && is_reached(y) {
        true => StartPoint::At([x, y]),
        false => StartPoint::Far,
    })
}

/// The most bytes that are searched from one place of a line, names and coordinates among spaces included: a line of a
/// megabyte is read as fast for its length as any other.
const FARTHEST: usize = 1024;

/// The text before a `;`, at most its first [`FARTHEST`] bytes.
pub(super) fn before_comment(text: &[u8]) -> &[u8] {
    let near = head(text, FARTHEST);
    head(near, memchr::memchr(b';', near).unwrap_or(near.len()))
}

/// `x , y` or `x y`, and nothing else, mm.
pub(super) fn two_numbers(text: &[u8]) -> Option<[f64; 2]> {
    stated_point(text).map(|point| point.at)
}

/// A coordinate beyond this, mm, is none: no machine is so large, and sums of it in µm stay far from overflow.
const FARTHEST_COORDINATE: f64 = 1e9;

/// `x , y`, `x y`, `X=x Y=y`, in brackets or not, and nothing else.
pub(super) fn stated_point(text: &[u8]) -> Option<StatedPoint> {
    if text.len() < FARTHEST {
        point_in(text)
    } else {
        None
    }
}

pub(super) fn point_in(text: &[u8]) -> Option<StatedPoint> {
    let (at, decimals) = numbers_in(text)?;
    at.into_iter()
        .all(is_reached)
        .then_some(StatedPoint { at, decimals })
}

fn is_reached(coordinate: f64) -> bool {
    coordinate.abs() <= FARTHEST_COORDINATE
}

/// The two numbers of a text that holds nothing else, and the fewest decimals of them.
fn numbers_in(text: &[u8]) -> Option<([f64; 2], u8)> {
    let text = std::str::from_utf8(text).ok()?;
    let is_between = |c: char| {
        matches!(
            c,
            ',' | '(' | ')' | '[' | ']' | '=' | ':' | 'X' | 'Y' | 'x' | 'y' | '|'
        ) || c.is_ascii_whitespace()
    };
    let mut fields = text.split(is_between).filter(|field| !field.is_empty());
    let mut decimals = usize::MAX;
    let mut number = || {
        let field = fields.next()?.trim_end_matches("mm");
        decimals = decimals.min(field.split_once('.').map_or(0, |(_, places)| places.len()));
        field.parse::<f64>().ok()
    };
    let at = [number()?, number()?];
    fields
        .next()
        .is_none()
        .then_some((at, decimals.min(9) as u8))
}
