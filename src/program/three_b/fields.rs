//! The fields of one block: their places, and the intended ones where one is damaged.

#![warn(clippy::indexing_slicing)]

use super::block::{Block, CountingAxis, Motion, PartArc};
use super::fault::{Flaw, SyntaxFault};
use super::scan::{Expected, Number, Scan};
use crate::text::TextEdit;
use std::ops::Range;

/// The places of a block's fields, in bytes of the text that it was read from. A missing number is an empty range at
/// its place.
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
    /// After the last byte.
    pub(crate) end: usize,
}

impl Fields {
    /// The edits that turn the block here into another one, in its letter case.
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
    let text = text.get(range.clone())?;
    let found = found_in(text, &Scan::of(text)).ok()?;
    Some(found.fields.shifted(range.start))
}

/// A block with a clear meaning.
pub(super) struct Found {
    pub(crate) block: Block,
    pub(crate) part: Option<PartArc>,
    pub(crate) fields: Fields,
    /// Number of the row that stands before the first `B`.
    pub(crate) row: Option<u32>,
    pub(crate) faults: Vec<SyntaxFault>,
}

/// A block with at most one damaged number; else the place where reading stopped, and the expectation there.
pub(super) fn found_in(text: &[u8], scan: &Scan) -> Result<Found, Expected> {
    let axis_at = scan.axis_range.start;
    let (axis, motion) = match (scan.stopped, scan.axis.zip(scan.motion())) {
        (None, Some(both)) => both,
        (stopped, _) => return Err(stopped.unwrap_or((axis_at, say!(g_and_the_counting_axis)))),
    };
    let mut numbers = scan.numbers().to_vec();
    let mut faults = Vec::new();
    for number in &numbers {
        let places = number.digits.clone();
        let is_letter = |at: &usize| text.get(*at).is_some_and(u8::is_ascii_alphabetic);
        let fault = |at: usize| SyntaxFault::new(at..at + 1, Flaw::LetterO);
        faults.extend(places.filter(is_letter).map(fault));
    }
    let with_b = numbers.iter().filter(|number| number.b.is_some()).count();
    let mut row = None;
    // A bare number before all numbers of a block is that of a row, even where one of them has lost its B.
    let own = if scan.side.is_some() { 4 } else { 3 };
    let first_has_b = numbers.first().is_some_and(|number| number.b.is_some());
    if !first_has_b && numbers.len() == own + 1 && with_b + 1 >= own {
        row = numbers
            .remove(0)
            .value
            .and_then(|value| u32::try_from(value).ok());
    }
    let mut radius = None;
    if let ([meant, _, _, _], None) = (&numbers[..], scan.side) {
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
        let at = numbers.get(3).map_or(axis_at, Number::start);
        return Err((at, say!(g_and_the_counting_axis)));
    };
    // The split has been reported already.
    let is_said = |faults: &[SyntaxFault]| {
        let mut flaws = faults.iter().map(|fault| &fault.flaw);
        flaws.any(|flaw| matches!(flaw, Flaw::MissingB { .. }))
    };
    for number in [x, y, j].into_iter().filter(|number| number.b.is_none()) {
        if !is_said(&faults) {
            let at = number.digits.start;
            let flaw = Flaw::MissingB { at };
            faults.push(SyntaxFault::new(number.digits.clone(), flaw));
        }
    }
    let Some(length) = j.value else {
        return Err((j.digits.start, say!(the_counting_length_j)));
    };
    Ok(Found {
        block: Block {
            x: x.value.unwrap_or(0),
            y: y.value.unwrap_or(0),
            j: length,
            axis,
            motion,
        },
        part: scan.part(radius.as_ref()),
        fields: Fields {
            first: x.start(),
            x: x.digits.clone(),
            y: y.digits.clone(),
            j: j.digits.clone(),
            radius: radius.map(|radius| radius.digits),
            axis: scan.axis_range.clone(),
            side: scan.side.map(|_| scan.side_range.clone()),
            motion: scan.motion_range.clone(),
            end: scan.end,
        },
        row,
        faults,
    })
}

/// Three numbers out of two, one of which has lost its `B` and merged with the other: the one way that makes a sound
/// line.
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
            // Nobody writes a leading zero except in J.
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
            let counted = axis.of([x, y]);
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
