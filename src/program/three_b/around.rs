//! The text around the blocks of a line: numbers of rows, names, coordinates, and what only looks like a block.

#![warn(clippy::indexing_slicing)]

use super::fields::is_sound;
use super::words::{Words, word_of};
use crate::text::head;

/// A point after a block, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedPoint {
    pub(crate) at: [f64; 2],
    /// The fewest decimals of its two numbers.
    pub(crate) decimals: u8,
}

/// The number of a block or of a row, and its length in bytes: `N12`, `N 12:`, `(1)`, `1)`, `1.`, `1:`, `1、`.
pub(super) fn number(text: &[u8]) -> Option<(u32, usize)> {
    let opens = text
        .first()
        .filter(|byte| matches!(byte, b'N' | b'n' | b'('));
    let spaces = |at: usize| {
        let space = text.iter().skip(at);
        let space = space.take_while(|byte| matches!(byte, b' ' | b'\t'));
        at + opens.map_or(0, |_| space.count())
    };
    let start = spaces(usize::from(opens.is_some()));
    let (number, length) = digits_of(text.get(start..)?)?;
    let mark = spaces(start + length);
    let goes_on = text.get(mark + 1).is_some_and(u8::is_ascii_digit);
    let is_marked = match (opens, text.get(mark)) {
        (Some(b'(') | None, Some(b')')) => true,
        (Some(b'N' | b'n') | None, Some(b':')) => true,
        (None, Some(b',' | b'.')) => !goes_on,
        _ => false,
    };
    match opens {
        _ if is_marked => Some((number, mark + 1)),
        Some(b'N' | b'n') => Some((number, start + length)),
        _ => None,
    }
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
    let digits = text.iter().take_while(|byte| byte.is_ascii_digit());
    let length = digits.clone().count();
    let with = |number: u32, digit: &u8| {
        let digit = u32::from(digit - b'0');
        number.saturating_mul(10).saturating_add(digit)
    };
    (length > 0).then(|| (digits.fold(0, with), length))
}

/// The place of the sound block before which the bytes from `start` on only name it: they are neither a word nor part
/// of a block.
pub(super) fn named_block(line: &[u8], start: usize, words: &Words<'_>) -> Option<usize> {
    let code = before_comment(line.get(start..)?);
    let line = head(line, start + code.len());
    let mut letters = memchr::memchr2_iter(b'B', b'b', code).take(4);
    let at = letters.find(|at| is_sound(line, start + at))?;
    let name = code.get(..at)?.trim_ascii();
    let mut parts = name.split(|byte| !byte.is_ascii_alphanumeric());
    let is_word = parts.any(|word| words.meaning(word).is_some());
    // A number alone is that of the row, or of the block.
    let is_number = name.strip_suffix(b",").unwrap_or(name).iter().all(|byte| {
        byte.is_ascii_digit() || matches!(byte, b'N' | b'n' | b' ' | b'|' | b':' | b'.' | b')')
    });
    let is_of_block = |pair: &[u8]| {
        let is_number = matches!(pair, [b'B' | b'b', b'0'..=b'9']);
        is_number || is_axis(pair) || matches!(pair, [b'R' | b'r', b'1'..=b'4'])
    };
    // Wide marks stay in a line that is no text of one encoding.
    let is_comment =
        name.starts_with("\u{ff1b}".as_bytes()) || name.starts_with("\u{ff08}".as_bytes());
    let is_name = !is_word && !is_number && !is_comment && !name.windows(2).any(is_of_block);
    is_name.then_some(start + at)
}

fn is_axis(pair: &[u8]) -> bool {
    matches!(pair, [b'G' | b'g', b'X' | b'Y' | b'x' | b'y'])
}

/// The end of a motion.
pub(super) fn is_end(pair: &[u8]) -> bool {
    matches!(pair, [b'L' | b'R' | b'l' | b'r', b'1'..=b'4'])
}

/// Whether text has enough of a block to be a broken one.
pub(super) fn wants_to_be_a_block(text: &[u8]) -> bool {
    let code = before_comment(head(text, 160));
    // Letters B, and those with a digit after them; axes; quadrants.
    let (mut letters, mut numbers, mut axes, mut ends) = (0, 0, 0, 0);
    for (at, letter) in code.iter().enumerate() {
        let mut behind = code.iter().skip(at + 1);
        let mut next = || behind.find(|byte| !matches!(byte, b' ' | b'\t' | b'|'));
        let is_digit = |next: Option<&u8>| usize::from(next.is_some_and(u8::is_ascii_digit));
        match letter {
            b'B' | b'b' => {
                letters += 1;
                numbers += is_digit(next());
            }
            b'G' | b'g' => axes += usize::from(matches!(next(), Some(b'X' | b'Y' | b'x' | b'y'))),
            b'L' | b'l' | b'R' | b'r' => ends += is_digit(next()),
            _ => {}
        }
    }
    let begins = matches!(code.first(), Some(b'B' | b'b' | b'0'..=b'9'));
    let kinds = usize::from(numbers > 0) + usize::from(axes > 0) + usize::from(ends > 0);
    kinds >= 2 || begins && (numbers >= 2 || kinds == 1 && letters >= 2)
}

/// Whether a text in look-alike letters has the parts of a block: three numbers, an axis and a quadrant.
pub(super) fn looks_like_a_block(text: &[u8]) -> bool {
    let text = head(text, 160);
    let runs = text.chunk_by(|a, b| a.is_ascii_digit() == b.is_ascii_digit());
    let numbers = runs.filter(|run| run.first().is_some_and(u8::is_ascii_digit));
    numbers.count() >= 4 && text.windows(2).any(is_axis) && text.windows(2).any(is_end)
}

/// The most bytes that are searched from one place of a line, names and coordinates among spaces included: a line of a
/// megabyte is read as fast for its length as any other.
const FARTHEST: usize = 1024;

/// The text before a `;`, at most its first [`FARTHEST`] bytes.
pub(super) fn before_comment(text: &[u8]) -> &[u8] {
    let near = head(text, FARTHEST);
    head(near, memchr::memchr(b';', near).unwrap_or(near.len()))
}

/// A coordinate beyond this, mm, is none: no machine is so large, and sums of it in µm stay far from overflow.
const FARTHEST_COORDINATE: f64 = 1e9;

/// Two numbers, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    At(StatedPoint),
    /// One of them is no place of a machine.
    Far,
    /// Commas stand for points, as some languages write them.
    DecimalCommas,
}

/// `x , y`, `x y`, `X=x Y=y`, in brackets or not, and nothing else.
pub(super) fn place_in(text: &[u8]) -> Option<Place> {
    let text = std::str::from_utf8(text).ok()?;
    let is_reached = |coordinate: &f64| coordinate.abs() <= FARTHEST_COORDINATE;
    match numbers_in(text) {
        Some(point) if point.at.iter().all(is_reached) => Some(Place::At(point)),
        Some(_) => Some(Place::Far),
        None => has_decimal_commas(text).then_some(Place::DecimalCommas),
    }
}

fn numbers_in(text: &str) -> Option<StatedPoint> {
    let is_mark = |c: char| matches!(c, ',' | '(' | ')' | '[' | ']' | '=' | ':' | '|');
    let is_letter = |c: char| matches!(c, 'X' | 'Y' | 'x' | 'y');
    let is_between = |c: char| is_mark(c) || is_letter(c) || c.is_ascii_whitespace();
    let mut fields = text.split(is_between).filter(|field| !field.is_empty());
    let mut decimals = usize::MAX;
    let mut number = || {
        let field = fields.next()?.trim_end_matches("mm");
        decimals = decimals.min(field.split_once('.').map_or(0, |(_, places)| places.len()));
        field.parse::<f64>().ok()
    };
    let at = [number()?, number()?];
    let decimals = decimals.min(9) as u8;
    fields
        .next()
        .is_none()
        .then_some(StatedPoint { at, decimals })
}

/// The same in a text that ends before [`FARTHEST`].
pub(super) fn near_place(text: &[u8]) -> Option<Place> {
    place_in(text).filter(|_| text.len() < FARTHEST)
}

fn has_decimal_commas(text: &str) -> bool {
    let is_whole = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let is_number = |word: &str| {
        let parts = word.trim_start_matches(['-', '+']).split_once(',');
        parts.is_some_and(|(whole, places)| is_whole(whole) && is_whole(places))
    };
    let words = text.split(|c: char| c.is_ascii_whitespace() || c == ';');
    let mut words = words.filter(|word| !word.is_empty() && *word != ",");
    let x = words.next().map(|x| x.trim_end_matches(','));
    x.is_some_and(is_number) && words.next().is_some_and(is_number) && words.next().is_none()
}

/// The point of `Start Point = x , y`.
pub(super) fn start_point(text: &[u8]) -> Option<Place> {
    const NAME: &[u8] = b"start point";
    let (name, value) = text.trim_ascii_start().split_at_checked(NAME.len())?;
    match value.trim_ascii_start() {
        [b'=' | b':', value @ ..] if name.eq_ignore_ascii_case(NAME) => {
            near_place(before_comment(value))
        }
        _ => None,
    }
}

/// `x , y` or `x y`, and nothing else, mm.
pub(super) fn two_numbers(text: &[u8]) -> Option<[f64; 2]> {
    match near_place(text)? {
        Place::At(point) => Some(point.at),
        Place::Far | Place::DecimalCommas => None,
    }
}
