//! Reads one block letter by letter, as far as possible: the one reader of numbers, axis and motion. [`super::fields`]
//! and [`super::repair`] derive from it what a damaged block was meant to be.

#![warn(clippy::indexing_slicing)]

use super::block::{Block, CountingAxis, Motion, PartArc, Quadrant};
use crate::program::lookalikes::wide_space;
use std::ops::{Deref, DerefMut, Range};

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
    pub(crate) fn start(&self) -> usize {
        self.b.unwrap_or(self.digits.start)
    }
}

/// The parts of one block. Places are bytes of the text.
#[derive(Default)]
pub(super) struct Scan {
    all: [Number; MOST_NUMBERS],
    /// The number of those that belong to this block.
    count: usize,
    found: Found,
}

/// The parts besides the numbers.
#[derive(Default)]
pub(super) struct Found {
    /// A number has no `B` before it.
    lacks_b: bool,
    /// A letter O stands for a zero.
    pub(crate) has_letter_o: bool,
    /// Marks among the digits that no number has.
    pub(crate) marks: usize,
    /// A number has more digits than any has, or there are more numbers.
    pub(crate) is_too_long: bool,
    pub(crate) has_g: bool,
    pub(crate) axis: Option<CountingAxis>,
    /// `GX`.
    pub(crate) axis_range: Range<usize>,
    /// `D` and `DD` of a 4B block: whether it is concave.
    pub(crate) side: Option<bool>,
    pub(crate) side_range: Range<usize>,
    /// The possible meanings of the motion's letters.
    pub(crate) kinds: &'static [fn(Quadrant) -> Motion],
    pub(crate) lacks_r: bool,
    pub(crate) quadrant: Option<Quadrant>,
    /// `NR1`.
    pub(crate) motion_range: Range<usize>,
    /// After the last byte read.
    pub(crate) end: usize,
    /// The place where it stops being a sound block.
    pub(crate) stopped: Option<Expected>,
    /// Reading goes on after damage.
    goes_on: bool,
}

impl Deref for Scan {
    type Target = Found;

    fn deref(&self) -> &Found {
        &self.found
    }
}

impl DerefMut for Scan {
    fn deref_mut(&mut self) -> &mut Found {
        &mut self.found
    }
}

const LINE: &[fn(Quadrant) -> Motion] = &[Motion::Line];
const CLOCKWISE: &[fn(Quadrant) -> Motion] = &[Motion::Clockwise];
const COUNTER_CLOCKWISE: &[fn(Quadrant) -> Motion] = &[Motion::CounterClockwise];
const ARCS: &[fn(Quadrant) -> Motion] = &[Motion::CounterClockwise, Motion::Clockwise];
const ALL: &[fn(Quadrant) -> Motion] = &[Motion::Line, Motion::CounterClockwise, Motion::Clockwise];

impl Scan {
    /// Reads up to anything foreign to a block.
    pub(super) fn of(text: &[u8]) -> Scan {
        let mut scan = Scan::default();
        scan.read(text, false);
        scan
    }

    /// Reads on after damage.
    pub(super) fn all_of(text: &[u8]) -> Scan {
        let mut scan = Scan::default();
        scan.read(text, true);
        scan
    }

    /// Reads another block in place of this one.
    pub(super) fn read(&mut self, text: &[u8], goes_on: bool) {
        self.count = 0;
        self.found = Found {
            goes_on,
            kinds: ALL,
            ..Found::default()
        };
        let mut reader = Reader { text, at: 0 };
        // What is left of it is in the scan.
        let _ = self.take(&mut reader);
    }

    pub(crate) fn numbers(&self) -> &[Number] {
        self.all.get(..self.count).unwrap_or_default()
    }

    /// The one motion that it can mean.
    pub(crate) fn motion(&self) -> Option<Motion> {
        match self.kinds {
            [kind] => self.quadrant.map(kind),
            _ => None,
        }
    }

    pub(crate) fn part(&self, radius: Option<&Number>) -> Option<PartArc> {
        self.side.map(|concave| PartArc {
            radius: radius.and_then(|radius| radius.value).unwrap_or(0),
            concave,
        })
    }

    /// The block if it is written as it should be, and its length in bytes. Nearly all blocks are read this way.
    #[inline]
    pub(super) fn sound(&self) -> Option<(Block, Option<PartArc>, usize)> {
        let (x, y, j, radius) = match self.numbers() {
            [x, y, j] => (x, y, j, None),
            [x, y, j, radius] => (x, y, j, Some(radius)),
            _ => return None,
        };
        let is_sound = self.stopped.is_none() && !self.lacks_b && !self.has_letter_o;
        if !is_sound || radius.is_some() != self.side.is_some() {
            return None;
        }
        let block = Block {
            x: x.value.unwrap_or(0),
            y: y.value.unwrap_or(0),
            j: j.value?,
            axis: self.axis?,
            motion: self.motion()?,
        };
        Some((block, self.part(radius), self.end))
    }

    /// Foreign text in place of a part of the block; `None` where reading ends there.
    fn stops(&mut self, at: usize, expected: &'static str) -> Option<()> {
        self.stopped = self.stopped.or(Some((at, expected)));
        self.goes_on.then_some(())
    }

    fn take(&mut self, reader: &mut Reader<'_>) -> Option<()> {
        while self.take_number(reader)? {}
        self.take_axis(reader)?;
        let at = reader.at_next();
        if reader.take(b'D') {
            self.side = Some(reader.take_next(b'D'));
            self.side_range = at..reader.at;
            self.end = reader.at;
        }
        self.take_motion(reader)
    }

    /// A number with or without its `B`; false where there is none.
    #[inline]
    fn take_number(&mut self, reader: &mut Reader<'_>) -> Option<bool> {
        let at = reader.at_next();
        let (b, start) = match reader.text.get(at) {
            Some(b'B' | b'b') => {
                reader.at += 1;
                (Some(at), reader.at_next())
            }
            Some(b'0'..=b'9' | b'O' | b'o' | b'-' | b'+' | b'.' | b',') => (None, at),
            _ => return Some(false),
        };
        let (mut value, mut marks) = (reader.take_digits(), 0);
        while let Some(&byte) = reader.text.get(reader.at) {
            let digit = match byte {
                b'0'..=b'9' => byte - b'0',
                b'O' | b'o' => {
                    self.has_letter_o = true;
                    0
                }
                b'-' | b'+' | b'.' | b',' if self.goes_on => {
                    marks += 1;
                    reader.at += 1;
                    continue;
                }
                _ => break,
            };
            value = value.saturating_mul(10).saturating_add(i64::from(digit));
            reader.at += 1;
        }
        let digits = reader.at - start - marks;
        self.marks += marks;
        self.is_too_long |= digits > MOST_DIGITS;
        if value > LARGEST {
            self.stops(start, say!(at_most_12_digits))?;
        }
        if b.is_none() && reader.at == start {
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
            digits: start..reader.at,
            value: (digits > 0).then_some(value),
        };
        self.count += 1;
        self.lacks_b |= b.is_none();
        self.end = reader.at;
        Some(true)
    }

    fn take_axis(&mut self, reader: &mut Reader<'_>) -> Option<()> {
        let at = reader.at_next();
        self.has_g = reader.take(b'G');
        if !self.has_g {
            let expected = match self.count {
                0 => say!(b_and_the_numbers),
                1 => say!(digits_of_x_or_b_before_y),
                2 => say!(digits_of_y_or_b_before_j),
                _ => say!(g_and_the_counting_axis),
            };
            self.stops(at, expected)?;
        }
        reader.at_next();
        let letter = reader.here();
        self.axis = match letter {
            Some(b'X') => Some(CountingAxis::X),
            Some(b'Y') => Some(CountingAxis::Y),
            _ => None,
        };
        if self.axis.is_some() {
            reader.at += 1;
        } else if self.has_g {
            self.stops(reader.at, say!(x_or_y_after_g))?;
            // Another letter in its place.
            let is_other = |letter: u8| {
                letter.is_ascii_alphabetic() && !matches!(letter, b'L' | b'S' | b'N' | b'R' | b'D')
            };
            reader.at += usize::from(letter.is_some_and(is_other));
        }
        if self.has_g || self.axis.is_some() {
            self.axis_range = at..reader.at;
            self.end = reader.at;
        }
        Some(())
    }

    fn take_motion(&mut self, reader: &mut Reader<'_>) -> Option<()> {
        let at = reader.at_next();
        let r = match reader.here() {
            Some(b'L') => {
                self.kinds = LINE;
                None
            }
            Some(b'S') => {
                self.kinds = CLOCKWISE;
                Some(say!(r_of_sr))
            }
            Some(b'N') => {
                self.kinds = COUNTER_CLOCKWISE;
                Some(say!(r_of_nr))
            }
            letter => {
                self.stops(at, say!(the_motion_and_a_quadrant))?;
                if letter == Some(b'R') {
                    self.kinds = ARCS;
                }
                None
            }
        };
        reader.at += usize::from(self.kinds.len() < ALL.len());
        if let Some(expected) = r
            && !reader.take_next(b'R')
        {
            self.lacks_r = true;
            self.stops(reader.at, expected)?;
        }
        let end = reader.at;
        reader.at_next();
        // A number that stands apart is no quadrant, but the first of the coordinates after the block.
        let next = reader.text.get(reader.at + 1);
        let goes_on = next.is_some_and(|next| next.is_ascii_digit() || *next == b'.');
        let is_quadrant = reader.at == end || !goes_on;
        let digit = reader
            .here()
            .filter(|digit| digit.is_ascii_digit() && is_quadrant);
        self.quadrant = digit.and_then(|digit| Quadrant::from_number(digit - b'0'));
        if self.quadrant.is_none() {
            self.stops(reader.at, say!(a_quadrant_from_1_to_4))?;
        }
        reader.at = if digit.is_some() { reader.at + 1 } else { end };
        if reader.at > at {
            self.motion_range = at..reader.at;
            self.end = reader.at;
        }
        Some(())
    }
}

struct Reader<'a> {
    text: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    /// The place after space and the bars of a table.
    #[inline]
    fn at_next(&mut self) -> usize {
        while let Some(byte) = self.text.get(self.at) {
            match byte {
                // The usual text.
                b'!'..=b'{' => break,
                b' ' | b'\t' | b'|' => self.at += 1,
                0xc2.. => match self.text.get(self.at..).map_or(0, wide_space) {
                    0 => break,
                    wide => self.at += wide,
                },
                _ => break,
            }
        }
        self.at
    }

    /// As many digits as cannot overflow.
    #[inline]
    fn take_digits(&mut self) -> i64 {
        let (mut value, most) = (0, self.at + 18);
        while self.at < most
            && let Some(digit) = self.text.get(self.at).map(|byte| byte.wrapping_sub(b'0'))
            && digit <= 9
        {
            value = value * 10 + i64::from(digit);
            self.at += 1;
        }
        value
    }

    /// The byte at the cursor, as a capital letter.
    #[inline]
    fn here(&self) -> Option<u8> {
        self.text.get(self.at).map(u8::to_ascii_uppercase)
    }

    /// Takes the letter at the cursor.
    #[inline]
    fn take(&mut self, letter: u8) -> bool {
        let found = self.here() == Some(letter);
        self.at += usize::from(found);
        found
    }

    /// Takes the letter after space.
    #[inline]
    fn take_next(&mut self, letter: u8) -> bool {
        self.at_next();
        self.take(letter)
    }
}
