//! Reads one block letter by letter: the places of its parts, and what it was meant to be where one is damaged. The one
//! reader of numbers, axis and motion.

#![warn(clippy::indexing_slicing)]

use super::block::{Block, CountingAxis, Motion, PartArc, Quadrant};
use super::fault::{Flaw, SyntaxFault};
use crate::program::lookalikes::wide_space;
use crate::text::TextEdit;
use std::ops::Range;

/// Longer digit strings than any controller takes are not numbers.
const MOST_DIGITS: usize = 12;
const LARGEST: i64 = 999_999_999_999;

/// Four of a 4B block, and that of its row.
const MOST_NUMBERS: usize = 5;

/// The place where reading stopped, and the expectation there.
pub(super) type Expected = (usize, &'static str);

/// A number of the block as it stands.
#[derive(Clone, Debug, Default)]
pub(super) struct Number {
    /// Place of its `B`, where it has one.
    pub(crate) b: Option<usize>,
    /// Empty where the number is not there.
    pub(crate) digits: Range<usize>,
    pub(crate) value: Option<i64>,
}

impl Number {
    fn start(&self) -> usize {
        self.b.unwrap_or(self.digits.start)
    }
}

/// The parts of one block, as far as they are there. Places are bytes of the text.
#[derive(Default)]
pub(super) struct Scan<'a> {
    text: &'a [u8],
    /// The next byte.
    at: usize,
    /// Reading goes on after damage.
    goes_on: bool,
    all: [Number; MOST_NUMBERS],
    /// The number of those that belong to this block.
    count: usize,
    has_letter_o: bool,
    /// Keys that are missing, and marks among the digits that no number has.
    pub(crate) keys: usize,
    /// A number has more digits than any has, or there are more numbers.
    pub(crate) is_too_long: bool,
    pub(crate) axis: Option<CountingAxis>,
    /// `GX`.
    pub(crate) axis_range: Range<usize>,
    /// `D` and `DD` of a 4B block: whether it is concave.
    pub(crate) side: Option<bool>,
    pub(crate) side_range: Range<usize>,
    /// The possible meanings of the motion's letters.
    pub(crate) kinds: &'static [fn(Quadrant) -> Motion],
    pub(crate) quadrant: Option<Quadrant>,
    /// `NR1`.
    pub(crate) motion_range: Range<usize>,
    /// After the last part.
    pub(crate) end: usize,
    /// The place where it stops being a sound block.
    stopped: Option<Expected>,
}

const ALL: &[fn(Quadrant) -> Motion] = &[Motion::Line, Motion::CounterClockwise, Motion::Clockwise];

impl<'a> Scan<'a> {
    /// Reads from a byte on, up to anything foreign to a block.
    pub(super) fn at(text: &'a [u8], at: usize) -> Scan<'a> {
        Scan::read(text, at, false)
    }

    /// The same; with `goes_on` also after damage.
    pub(super) fn read(text: &'a [u8], at: usize, goes_on: bool) -> Scan<'a> {
        let mut scan = Scan {
            text,
            at,
            goes_on,
            kinds: ALL,
            end: at,
            ..Scan::default()
        };
        // What is left of it is in the scan.
        let _ = scan.take_all();
        scan
    }

    pub(crate) fn numbers(&self) -> &[Number] {
        self.all.get(..self.count).unwrap_or_default()
    }

    /// Foreign text in place of a part of the block; `None` where reading ends there.
    fn stops(&mut self, at: usize, expected: &'static str) -> Option<()> {
        self.stopped = self.stopped.or(Some((at, expected)));
        self.goes_on.then_some(())
    }

    fn take_all(&mut self) -> Option<()> {
        while self.take_number()? {}
        self.take_axis()?;
        let at = self.at_next();
        if self.take(b'D') {
            self.side = Some(self.take_next(b'D'));
            self.side_range = at..self.at;
            self.end = self.at;
        }
        self.take_motion()
    }

    /// A number with or without its `B`; false where there is none.
    #[inline]
    fn take_number(&mut self) -> Option<bool> {
        let at = self.at_next();
        let b = self.take(b'B').then_some(at);
        let start = self.at_next();
        let (mut value, mut marks) = (0_i64, 0);
        while let Some(&byte) = self.text.get(self.at) {
            let digit = match byte {
                b'0'..=b'9' => byte - b'0',
                b'O' | b'o' => {
                    self.has_letter_o = true;
                    0
                }
                b'-' | b'+' | b'.' | b',' if self.goes_on => {
                    marks += 1;
                    self.at += 1;
                    continue;
                }
                _ => break,
            };
            // One too large is too large, however far it goes on.
            value = (value * 10 + i64::from(digit)).min(LARGEST + 1);
            self.at += 1;
        }
        let digits = self.at - start - marks;
        self.keys += marks;
        self.is_too_long |= digits > MOST_DIGITS;
        if value > LARGEST {
            self.stops(start, say!(at_most_12_digits))?;
        }
        if b.is_none() && self.at == start {
            return Some(false);
        }
        let Some(place) = self.all.get_mut(self.count) else {
            self.is_too_long = true;
            let fourth = self.all.get(3).map_or(start, Number::start);
            self.stops(fourth, say!(g_and_the_counting_axis));
            return None;
        };
        *place = Number {
            b,
            digits: start..self.at,
            value: (digits > 0).then_some(value),
        };
        self.count += 1;
        self.end = self.at;
        Some(true)
    }

    fn take_axis(&mut self) -> Option<()> {
        let at = self.at_next();
        let has_g = self.take(b'G');
        if !has_g {
            let expected = match self.count {
                0 => say!(b_and_the_numbers),
                1 => say!(digits_of_x_or_b_before_y),
                2 => say!(digits_of_y_or_b_before_j),
                _ => say!(g_and_the_counting_axis),
            };
            self.stops(at, expected)?;
        }
        self.at_next();
        let letter = self.here();
        self.axis = match letter {
            Some(b'X') => Some(CountingAxis::X),
            Some(b'Y') => Some(CountingAxis::Y),
            _ => None,
        };
        let mut is_taken = self.axis.is_some();
        self.keys += usize::from(!has_g) + usize::from(!is_taken);
        if has_g && !is_taken {
            self.stops(self.at, say!(x_or_y_after_g))?;
            // Another letter in its place.
            is_taken = letter.is_some_and(|letter| letter.is_ascii_alphabetic())
                && !matches!(letter, Some(b'L' | b'S' | b'N' | b'R' | b'D'));
        }
        self.at += usize::from(is_taken);
        if has_g || is_taken {
            self.axis_range = at..self.at;
            self.end = self.at;
        }
        Some(())
    }

    fn take_motion(&mut self) -> Option<()> {
        let at = self.at_next();
        let letter = self.here();
        self.kinds = match letter {
            Some(b'L') => &[Motion::Line],
            Some(b'S') => &[Motion::Clockwise],
            Some(b'N') => &[Motion::CounterClockwise],
            Some(b'R') => &[Motion::CounterClockwise, Motion::Clockwise],
            _ => ALL,
        };
        let is_arc = matches!(letter, Some(b'S' | b'N'));
        if self.kinds.len() > 1 {
            self.keys += 1;
            self.stops(at, say!(the_motion_and_a_quadrant))?;
        }
        self.at += usize::from(self.kinds.len() < ALL.len());
        if is_arc && !self.take_next(b'R') {
            let is_clockwise = letter == Some(b'S');
            self.keys += 1;
            self.stops(
                self.at,
                if is_clockwise {
                    say!(r_of_sr)
                } else {
                    say!(r_of_nr)
                },
            )?;
        }
        let end = self.at;
        self.at_next();
        // A number that stands apart is no quadrant, but the first of the coordinates after the block.
        let next = self.text.get(self.at + 1);
        let goes_on = next.is_some_and(|next| next.is_ascii_digit() || *next == b'.');
        let is_quadrant = self.at == end || !goes_on;
        let digit = self.here().filter(u8::is_ascii_digit);
        let digit = digit.filter(|_| is_quadrant);
        self.quadrant = digit.and_then(|digit| Quadrant::from_number(digit - b'0'));
        if self.quadrant.is_none() {
            self.keys += 1;
            self.stops(self.at, say!(a_quadrant_from_1_to_4))?;
        }
        self.at = if digit.is_some() { self.at + 1 } else { end };
        if self.at > at {
            self.motion_range = at..self.at;
            self.end = self.at;
        }
        Some(())
    }

    /// The place after space and the bars of a table.
    #[inline]
    fn at_next(&mut self) -> usize {
        while let Some(byte) = self.text.get(self.at) {
            self.at += match byte {
                b' ' | b'\t' | b'|' => 1,
                0xc2.. => match self.text.get(self.at..).map_or(0, wide_space) {
                    0 => break,
                    wide => wide,
                },
                _ => break,
            };
        }
        self.at
    }

    /// The next byte, as a capital letter.
    #[inline]
    fn here(&self) -> Option<u8> {
        self.text.get(self.at).map(u8::to_ascii_uppercase)
    }

    /// Takes the letter, where it is the next byte.
    #[inline]
    fn take(&mut self, letter: u8) -> bool {
        let found = self.here() == Some(letter);
        self.at += usize::from(found);
        found
    }

    /// Takes the letter after space.
    fn take_next(&mut self, letter: u8) -> bool {
        self.at_next();
        self.take(letter)
    }

    /// The block with at most one damaged number; else the place where reading stopped, and the expectation there.
    pub(super) fn meaning(&self) -> Result<Found, Expected> {
        let axis_at = self.axis_range.start;
        let motion = match self.kinds {
            [kind] => self.quadrant.map(kind),
            _ => None,
        };
        let (None, Some((axis, motion))) = (self.stopped, self.axis.zip(motion)) else {
            let stopped = self.stopped;
            return Err(stopped.unwrap_or((axis_at, say!(g_and_the_counting_axis))));
        };
        let mut faults = self.letters_o();
        let (row, mut numbers) = self.row(&mut faults)?;
        let mut radius = None;
        if let ([own @ .., last], 4) = (numbers, numbers.len()) {
            (numbers, radius) = (own, Some(last));
        }
        let (parted, mut merged) = (self.parted(numbers, axis, motion), None);
        if let [one, _] = numbers {
            merged = Some(one.start()..axis_at);
            let [way] = &parted[..] else {
                return Err((axis_at, say!(digits_of_y_or_b_before_j)));
            };
            numbers = way;
        }
        let [x, y, j] = numbers else {
            let at = numbers.get(3).map_or(axis_at, Number::start);
            return Err((at, say!(g_and_the_counting_axis)));
        };
        if let Some(bare) = numbers.iter().find(|number| number.b.is_none()) {
            let at = bare.digits.start;
            let range = merged.unwrap_or(bare.digits.clone());
            faults.push(SyntaxFault::new(range, Flaw::MissingB { at }));
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
            part: self.side.map(|concave| PartArc {
                radius: radius.and_then(|radius| radius.value).unwrap_or(0),
                concave,
            }),
            fields: Fields {
                first: x.start(),
                x: x.digits.clone(),
                y: y.digits.clone(),
                j: j.digits.clone(),
                radius: radius.map(|radius| radius.digits.clone()),
                axis: self.axis_range.clone(),
                side: self.side.map(|_| self.side_range.clone()),
                motion: self.motion_range.clone(),
                end: self.end,
            },
            row,
            faults,
        })
    }

    fn letters_o(&self) -> Vec<SyntaxFault> {
        if !self.has_letter_o {
            return Vec::new();
        }
        let is_letter = |at: &usize| self.text.get(*at).is_some_and(u8::is_ascii_alphabetic);
        let digits = self.numbers().iter();
        let digits = digits.flat_map(|number| number.digits.clone());
        let fault = |at| SyntaxFault::new(at..at + 1, Flaw::LetterO);
        digits.filter(is_letter).map(fault).collect()
    }

    /// The number of the row, and the numbers of the block behind it.
    fn row(&self, faults: &mut Vec<SyntaxFault>) -> Result<(Option<u32>, &[Number]), Expected> {
        let numbers = self.numbers();
        let own = if self.side.is_some() { 4 } else { 3 };
        let (first, rest) = match numbers {
            [first, rest @ ..] if rest.len() == own => (first, rest),
            _ => return Ok((None, numbers)),
        };
        let without_b = numbers.iter().filter(|number| number.b.is_none()).count();
        let value = first.value.and_then(|value| u32::try_from(value).ok());
        // A bare number before all numbers of a block is that of a row, even where one of them has lost its B.
        if first.b.is_none() && without_b <= 2 {
            return Ok((value, rest));
        }
        if own == 4 {
            return Ok((None, numbers));
        }
        let Some((b, number)) = first.b.zip(value) else {
            return Err((first.digits.start, say!(b_before_the_number)));
        };
        let flaw = Flaw::BlockNumberAsB { number };
        faults.push(SyntaxFault::new(b..first.digits.end, flaw));
        Ok((Some(number), rest))
    }

    /// Three numbers out of two, one of which has lost its `B` and merged with the other: the ways that make a sound
    /// line.
    fn parted(&self, numbers: &[Number], axis: CountingAxis, motion: Motion) -> Vec<[Number; 3]> {
        let [first, second] = numbers else {
            return Vec::new();
        };
        let part = |b: Option<usize>, digits: Range<usize>| {
            let text = std::str::from_utf8(self.text.get(digits.clone())?).ok()?;
            let value = Some(text.parse().ok()?);
            Some(Number { b, digits, value })
        };
        let cut = |number: &Number, at: usize| {
            let left = part(number.b, number.digits.start..at)?;
            Some((left, part(None, at..number.digits.end)?))
        };
        let cuts = |number: &Number| number.digits.start + 1..number.digits.end;
        // Nobody writes a leading zero except in J.
        let leads_with_zero =
            |at: usize| self.text.get(at) == Some(&b'0') && at + 1 < first.digits.end;
        let of_first = cuts(first).filter(|at| !leads_with_zero(*at));
        let of_first = of_first.filter_map(|at| {
            let (x, y) = cut(first, at)?;
            Some([x, y, second.clone()])
        });
        let of_second = cuts(second).filter_map(|at| {
            let (y, j) = cut(second, at)?;
            Some([first.clone(), y, j])
        });
        let is_line = |numbers: &[Number; 3]| {
            let [Some(x), Some(y), Some(j)] = numbers.each_ref().map(|number| number.value) else {
                return false;
            };
            motion.is_line() && axis.of([x, y]) == j && j >= x.max(y) && j > 0
        };
        of_first.chain(of_second).filter(is_line).collect()
    }
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

impl Found {
    /// It is written as it should be. Nearly all blocks are.
    pub(super) fn is_sound(&self) -> bool {
        let is_whole = self.fields.radius.is_some() == self.part.is_some();
        is_whole && self.row.is_none() && self.faults.is_empty()
    }
}

/// Whether a block that is written as it should be stands at a byte.
pub(super) fn is_sound(text: &[u8], at: usize) -> bool {
    Scan::at(text, at)
        .meaning()
        .is_ok_and(|found| found.is_sound())
}

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
        let is_lower = first.is_some_and(u8::is_ascii_lowercase);
        let cased = |text: String| if is_lower { text.to_lowercase() } else { text };
        let words = |block: &Block| {
            [
                block.x.to_string(),
                block.y.to_string(),
                block.j.to_string(),
                cased(format!("G{}", block.axis.letter())),
                cased(block.motion.name().into()),
            ]
        };
        let places = [&self.x, &self.y, &self.j, &self.axis, &self.motion];
        let both = words(old).into_iter().zip(words(new));
        let changed = places.into_iter().zip(both);
        let changed = changed.filter(|(_, (old, new))| old != new);
        changed
            .map(|(place, (_, new))| TextEdit::new(place.clone(), new))
            .collect()
    }
}

/// The fields of the block that begins at `range.start` of a text, as the reader gave its range.
pub fn fields_of(text: &[u8], range: Range<usize>) -> Option<Fields> {
    let text = text.get(..range.end)?;
    Some(Scan::at(text, range.start).meaning().ok()?.fields)
}
