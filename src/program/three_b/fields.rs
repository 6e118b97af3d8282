//! The fields of one block: where each stands, and what was meant where one is damaged.

#![warn(clippy::indexing_slicing)]

use super::block::{Block, CountingAxis, Motion, PartArc, Quadrant};
use super::fault::{Flaw, SyntaxFault};
use crate::program::alike::wide_space;
use crate::text::TextEdit;
use std::ops::Range;

/// More digits than any controller takes are not read as a number; [`numbers`] says how many.
const MOST_DIGITS: usize = 12;

/// Where the fields of a block stand, in bytes of the text that it was read from. A number that is not there is an empty range
/// where it would stand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fields {
    /// The first byte of the block.
    pub(crate) first: usize,
    pub x: Range<usize>,
    pub y: Range<usize>,
    pub j: Range<usize>,
    /// Radius of a 4B block.
    pub(crate) radius: Option<Range<usize>>,
    /// `GX` or `GY`.
    pub axis: Range<usize>,
    /// `D` or `DD` of a 4B block.
    pub(crate) side: Option<Range<usize>>,
    /// `L1`, `SR2`, `NR3`.
    pub motion: Range<usize>,
    /// Behind the last byte.
    pub(crate) end: usize,
}

impl Fields {
    /// The edits that make another block of the one that stands here, in its letter case.
    pub(super) fn changed(&self, text: &[u8], old: &Block, new: &Block) -> Vec<TextEdit> {
        let first = text.get(self.motion.start);
        let cased = |text: String| match first.is_some_and(u8::is_ascii_lowercase) {
            true => text.to_lowercase(),
            false => text,
        };
        let all = [
            (&self.x, new.x.to_string(), new.x == old.x),
            (&self.y, new.y.to_string(), new.y == old.y),
            (&self.j, new.j.to_string(), new.j == old.j),
            (
                &self.axis,
                cased(format!("G{}", new.axis.letter())),
                new.axis == old.axis,
            ),
            (
                &self.motion,
                cased(new.motion.name().into()),
                new.motion == old.motion,
            ),
        ];
        let changed = all.into_iter().filter(|(.., is_same)| !is_same);
        changed
            .map(|(range, text, _)| TextEdit::new(range.clone(), text))
            .collect()
    }

    fn shifted(self, by: usize) -> Fields {
        let shift = |range: Range<usize>| range.start + by..range.end + by;
        Fields {
            first: self.first + by,
            x: shift(self.x),
            y: shift(self.y),
            j: shift(self.j),
            radius: self.radius.map(shift),
            axis: shift(self.axis),
            side: self.side.map(shift),
            motion: shift(self.motion),
            end: self.end + by,
        }
    }
}

/// The fields of the block that begins at `range.start` of a text, as the reader gave its range.
pub fn fields_of(text: &[u8], range: Range<usize>) -> Option<Fields> {
    let found = lenient(text.get(range.clone())?).ok()?;
    Some(found.fields.shifted(range.start))
}

/// A block that is written as it should be, and how many bytes it takes. The way of nearly all of them.
pub(super) fn strict(text: &[u8]) -> Option<(Block, Option<PartArc>, usize)> {
    let mut reader = Reader { text, at: 0 };
    let numbers = [reader.number()?, reader.number()?, reader.number()?];
    let radius = if reader.next_is(b'B') {
        Some(reader.number()?.unwrap_or(0))
    } else {
        None
    };
    let j = numbers[2]?;
    let axis = axis_of(&mut reader, 3).ok()?;
    let side = reader.side();
    if radius.is_some() != side.is_some() {
        return None;
    }
    let motion = motion_of(&mut reader).ok()?;
    let part = radius
        .zip(side)
        .map(|(radius, concave)| PartArc { radius, concave });
    Some((
        Block {
            x: numbers[0].unwrap_or(0),
            y: numbers[1].unwrap_or(0),
            j,
            axis,
            motion,
        },
        part,
        reader.at,
    ))
}

struct Reader<'a> {
    text: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    #[inline]
    fn skip(&mut self) {
        while let Some(byte) = self.text.get(self.at) {
            match byte {
                b' ' | b'\t' | b'|' => self.at += 1,
                0xc2.. => match self.text.get(self.at..).map_or(0, wide_space) {
                    0 => break,
                    wide => self.at += wide,
                },
                _ => break,
            }
        }
    }

    #[inline]
    fn next_is(&mut self, letter: u8) -> bool {
        self.skip();
        self.text
            .get(self.at)
            .is_some_and(|byte| byte.to_ascii_uppercase() == letter)
    }

    #[inline]
    fn take(&mut self, letter: u8) -> bool {
        let found = self.next_is(letter);
        self.at += usize::from(found);
        found
    }

    /// `B` and the digits behind it; `Some(None)` where there are none.
    #[inline]
    fn number(&mut self) -> Option<Option<i64>> {
        if !self.take(b'B') {
            return None;
        }
        self.skip();
        let start = self.at;
        let mut value: i64 = 0;
        while let Some(digit @ b'0'..=b'9') = self.text.get(self.at) {
            value = value
                .checked_mul(10)?
                .checked_add(i64::from(digit - b'0'))?;
            self.at += 1;
        }
        if value >= 10_i64.pow(MOST_DIGITS as u32) {
            return None;
        }
        Some((self.at > start).then_some(value))
    }

    /// `D` convex, `DD` concave.
    fn side(&mut self) -> Option<bool> {
        self.take(b'D').then(|| self.take(b'D'))
    }
}

/// Where reading stopped, and what was expected there.
type Expected = (usize, &'static str);

/// A block in which what was meant is plain.
pub(super) struct Found {
    pub(crate) block: Block,
    pub(crate) part: Option<PartArc>,
    pub(crate) fields: Fields,
    /// Number of the row that stands before the first `B`.
    pub(crate) row: Option<u32>,
    pub(crate) faults: Vec<SyntaxFault>,
}

/// A number of the block as it stands.
#[derive(Clone, Debug)]
struct Number {
    /// Place of its `B`, where it has one.
    b: Option<usize>,
    digits: Range<usize>,
    value: Option<i64>,
}

/// Reads a block with at most one number damaged; else the place where reading stopped, and what was expected there.
pub(super) fn lenient(text: &[u8]) -> Result<Found, Expected> {
    let mut reader = Reader { text, at: 0 };
    let mut faults = Vec::new();
    let mut numbers = numbers(&mut reader, &mut faults)?;
    let with_b = numbers.iter().filter(|number| number.b.is_some()).count();
    let mut row = None;
    let axis_at = {
        reader.skip();
        reader.at
    };
    let axis = axis_of(&mut reader, numbers.len())?;
    let axis_range = axis_at..reader.at;
    let side_at = {
        reader.skip();
        reader.at
    };
    let side = reader.side();
    let side_range = side.map(|_| side_at..reader.at);
    let motion_at = {
        reader.skip();
        reader.at
    };
    let motion = motion_of(&mut reader)?;
    // A bare number before all numbers of a block is that of a row, also where one of them has lost its B.
    let own = if side.is_some() { 4 } else { 3 };
    let first_has_b = numbers.first().is_some_and(|number| number.b.is_some());
    if !first_has_b && numbers.len() == own + 1 && with_b + 1 >= own {
        row = numbers
            .remove(0)
            .value
            .and_then(|value| u32::try_from(value).ok());
    }
    let mut radius = None;
    if let ([meant, _, _, _], None) = (&numbers[..], side) {
        let number = meant.value.and_then(|value| u32::try_from(value).ok());
        let Some((b, number)) = meant.b.zip(number) else {
            return Err((meant.digits.start, say!(b_before_the_number)));
        };
        let flaw = Flaw::BlockNumberAsB { number };
        faults.push(SyntaxFault::new(b..meant.digits.end, flaw));
        row = Some(number);
        numbers.remove(0);
    } else if numbers.len() == 4 {
        radius = numbers.pop();
    }
    if numbers.len() == 2 {
        numbers = split_numbers(text, numbers, axis, motion, axis_at, &mut faults)?;
    }
    let [x, y, j] = &numbers[..] else {
        let at = numbers
            .get(3)
            .map_or(axis_at, |number| number.b.unwrap_or(number.digits.start));
        return Err((at, say!(g_and_the_counting_axis)));
    };
    for number in [x, y, j].into_iter().filter(|number| number.b.is_none()) {
        // What was split has been said already.
        if !faults
            .iter()
            .any(|fault| matches!(fault.flaw, Flaw::MissingB { .. }))
        {
            let at = number.digits.start;
            faults.push(SyntaxFault::new(
                number.digits.clone(),
                Flaw::MissingB { at },
            ));
        }
    }
    let Some(length) = j.value else {
        return Err((j.digits.start, say!(the_counting_length_j)));
    };
    let first = x.b.unwrap_or(x.digits.start);
    let block = Block {
        x: x.value.unwrap_or(0),
        y: y.value.unwrap_or(0),
        j: length,
        axis,
        motion,
    };
    let part = side.map(|concave| PartArc {
        radius: radius.as_ref().and_then(|radius| radius.value).unwrap_or(0),
        concave,
    });
    let fields = Fields {
        first,
        x: x.digits.clone(),
        y: y.digits.clone(),
        j: j.digits.clone(),
        radius: radius.map(|radius| radius.digits),
        axis: axis_range,
        side: side_range,
        motion: motion_at..reader.at,
        end: reader.at,
    };
    Ok(Found {
        block,
        part,
        fields,
        row,
        faults,
    })
}

/// Numbers with and without `B` up to the counting axis.
fn numbers(
    reader: &mut Reader<'_>,
    faults: &mut Vec<SyntaxFault>,
) -> Result<Vec<Number>, Expected> {
    let mut numbers: Vec<Number> = Vec::new();
    loop {
        reader.skip();
        let at = reader.at;
        let b = reader.take(b'B').then_some(at);
        reader.skip();
        let start = reader.at;
        let mut value: i64 = 0;
        let mut significant = 0;
        loop {
            let digit = match reader.text.get(reader.at) {
                Some(digit @ b'0'..=b'9') => *digit,
                Some(b'O' | b'o') => {
                    faults.push(SyntaxFault::new(reader.at..reader.at + 1, Flaw::LetterO));
                    b'0'
                }
                _ => break,
            };
            significant += usize::from(significant > 0 || digit != b'0');
            if significant <= MOST_DIGITS {
                value = value * 10 + i64::from(digit - b'0');
            }
            reader.at += 1;
        }
        if significant > MOST_DIGITS {
            return Err((start, say!(at_most_12_digits)));
        }
        if b.is_none() && reader.at == start {
            return Ok(numbers);
        }
        if let [_, _, _, fourth, _] = &numbers[..] {
            return Err((
                fourth.b.unwrap_or(fourth.digits.start),
                say!(g_and_the_counting_axis),
            ));
        }
        numbers.push(Number {
            b,
            digits: start..reader.at,
            value: (reader.at > start).then_some(value),
        });
    }
}

fn axis_of(reader: &mut Reader<'_>, numbers: usize) -> Result<CountingAxis, Expected> {
    let expected = match numbers {
        0 => say!(b_and_the_numbers),
        1 => say!(digits_of_x_or_b_before_y),
        2 => say!(digits_of_y_or_b_before_j),
        _ => say!(g_and_the_counting_axis),
    };
    if !reader.take(b'G') {
        return Err((reader.at, expected));
    }
    match (reader.take(b'X'), reader.take(b'Y')) {
        (true, _) => Ok(CountingAxis::X),
        (false, true) => Ok(CountingAxis::Y),
        (false, false) => Err((reader.at, say!(x_or_y_after_g))),
    }
}

fn motion_of(reader: &mut Reader<'_>) -> Result<Motion, Expected> {
    let kind: fn(Quadrant) -> Motion = if reader.take(b'L') {
        Motion::Line
    } else if reader.take(b'S') {
        if !reader.take(b'R') {
            return Err((reader.at, say!(r_of_sr)));
        }
        Motion::Clockwise
    } else if reader.take(b'N') {
        if !reader.take(b'R') {
            return Err((reader.at, say!(r_of_nr)));
        }
        Motion::CounterClockwise
    } else {
        return Err((reader.at, say!(the_motion_and_a_quadrant)));
    };
    reader.skip();
    let quadrant = reader
        .text
        .get(reader.at)
        .and_then(|byte| Quadrant::from_number(byte.wrapping_sub(b'0')));
    let Some(quadrant) = quadrant else {
        return Err((reader.at, say!(a_quadrant_from_1_to_4)));
    };
    reader.at += 1;
    Ok(kind(quadrant))
}

/// Three numbers out of two, one of which lost its `B` and hangs on the other: the one way that makes a sound line.
fn split_numbers(
    text: &[u8],
    numbers: Vec<Number>,
    axis: CountingAxis,
    motion: Motion,
    axis_at: usize,
    faults: &mut Vec<SyntaxFault>,
) -> Result<Vec<Number>, Expected> {
    let expected = || (axis_at, say!(digits_of_y_or_b_before_j));
    let [first, second] = &numbers[..] else {
        return Err(expected());
    };
    let value = |range: Range<usize>| -> Option<i64> {
        std::str::from_utf8(text.get(range)?).ok()?.parse().ok()
    };
    let mut ways: Vec<Vec<Number>> = Vec::new();
    for (index, number) in [first, second].into_iter().enumerate() {
        for cut in number.digits.start + 1..number.digits.end {
            let (left, right) = (number.digits.start..cut, cut..number.digits.end);
            // Nobody writes a number with a zero in front of it but J.
            if index == 0 && text.get(right.start) == Some(&b'0') && right.len() > 1 {
                continue;
            }
            let halves = [
                Number {
                    b: number.b,
                    value: value(left.clone()),
                    digits: left,
                },
                Number {
                    b: None,
                    value: value(right.clone()),
                    digits: right,
                },
            ];
            let all: Vec<Number> = if index == 0 {
                halves.into_iter().chain([second.clone()]).collect()
            } else {
                [first.clone()].into_iter().chain(halves).collect()
            };
            let values: Vec<_> = all.iter().map(|number| number.value).collect();
            let [Some(x), Some(y), Some(j)] = values[..] else {
                continue;
            };
            let counted = if axis == CountingAxis::X { x } else { y };
            if matches!(motion, Motion::Line(_)) && counted == j && counted >= x.max(y) && j > 0 {
                ways.push(all);
            }
        }
    }
    match ways.pop() {
        Some(way) if ways.is_empty() => {
            let at = way
                .iter()
                .find(|number| number.b.is_none())
                .map_or(axis_at, |number| number.digits.start);
            let start = first.b.unwrap_or(first.digits.start);
            faults.push(SyntaxFault::new(start..axis_at, Flaw::MissingB { at }));
            Ok(way)
        }
        _ => Err(expected()),
    }
}
