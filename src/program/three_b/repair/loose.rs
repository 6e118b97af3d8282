//! The remains of an unreadable block: its numbers, its axis and its motion, as far as they are there.

use super::super::around::number;
use super::super::block::{Block, CountingAxis, Motion, Quadrant};
use super::super::fields::{self, Scan};
use std::ops::Range;

/// A number of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Number {
    X,
    Y,
    J,
}

impl Number {
    /// That of a block, µm.
    pub(in super::super) fn of(self, block: &Block) -> i64 {
        match self {
            Number::X => block.x,
            Number::Y => block.y,
            Number::J => block.j,
        }
    }
}

/// A broken block.
#[derive(Clone, Debug, PartialEq)]
pub(in super::super) struct Loose {
    /// From its first number to the last part of it that is there.
    pub(crate) range: Range<usize>,
    numbers: Vec<Vec<u8>>,
    axis: Option<CountingAxis>,
    motions: Vec<Motion>,
    /// Keys that are missing, and marks that no number has.
    keys: usize,
}

/// One way to read it; `unknown` is the missing number, 0 in the block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reading {
    pub(crate) block: Block,
    pub(crate) unknown: Option<Number>,
    pub(crate) keys: usize,
}

/// The parts of one block in a text that holds nothing else but a number before it and a comment after it.
pub(in super::super) fn loose(text: &[u8]) -> Option<Loose> {
    let is_between = |byte: &u8| matches!(byte, b' ' | b'\t' | b'|');
    let mut start = text.iter().position(|byte| !is_between(byte))?;
    if let own @ [b'N' | b'n', ..] = text.get(start..)? {
        // Its digits may be lost.
        start += number(own).map_or(1, |(_, length)| length);
        let behind = text.get(start..)?.iter();
        start += behind
            .take_while(|byte| is_between(byte) || **byte == b':')
            .count();
    }
    let scan = Scan::read(text, start, true);
    let behind = text.get(scan.end..)?.iter().find(|byte| !is_between(byte));
    let is_over = behind.is_none_or(|byte| !byte.is_ascii_alphanumeric());
    let is_block = !scan.axis_range.is_empty() || !scan.motion_range.is_empty();
    let is_four_b = scan.side.is_some() || !(2..=3).contains(&scan.numbers().len());
    if !is_over || !is_block || is_four_b || scan.is_too_long {
        return None;
    }
    let digits = |number: &fields::Number| {
        let bytes = text.get(number.digits.clone()).unwrap_or_default();
        let digit = |byte: &u8| match byte {
            b'0'..=b'9' => Some(*byte),
            byte => byte.is_ascii_alphabetic().then_some(b'0'),
        };
        bytes.iter().filter_map(digit).collect()
    };
    let quadrants = scan.quadrant.as_slice();
    let quadrants = if quadrants.is_empty() {
        &Quadrant::ALL
    } else {
        quadrants
    };
    let motions = |kind: &fn(Quadrant) -> Motion| quadrants.iter().copied().map(*kind);
    Some(Loose {
        range: start..scan.end,
        numbers: scan.numbers().iter().map(digits).collect(),
        axis: scan.axis,
        motions: scan.kinds.iter().flat_map(motions).collect(),
        keys: scan.keys,
    })
}

impl Loose {
    /// The ways in which it can be read with at most one number unknown.
    pub(super) fn readings(&self) -> Vec<Reading> {
        let mut readings = Vec::new();
        let axes: &[CountingAxis] = match self.axis {
            Some(CountingAxis::X) => &[CountingAxis::X],
            Some(CountingAxis::Y) => &[CountingAxis::Y],
            None => &[CountingAxis::X, CountingAxis::Y],
        };
        for (numbers, unknown, more) in self.triples() {
            for axis in axes {
                for motion in &self.motions {
                    let [x, y, j] = numbers;
                    readings.push(Reading {
                        block: Block {
                            x,
                            y,
                            j,
                            axis: *axis,
                            motion: *motion,
                        },
                        unknown,
                        keys: self.keys + more,
                    });
                }
            }
        }
        readings
    }

    /// X, Y and J, which of them is unknown, and how many keys that takes.
    fn triples(&self) -> Vec<([i64; 3], Option<Number>, usize)> {
        let value = |digits: &[u8]| {
            digits
                .iter()
                .fold(0_i64, |value, digit| value * 10 + i64::from(digit - b'0'))
        };
        let mut triples = Vec::new();
        match &self.numbers[..] {
            [x, y, j] => {
                let unknown = j.is_empty().then_some(Number::J);
                triples.push((
                    [value(x), value(y), value(j)],
                    unknown,
                    usize::from(unknown.is_some()),
                ));
            }
            [one, other] => {
                let (a, b) = (value(one), value(other));
                triples.push(([0, a, b], Some(Number::X), 2));
                triples.push(([a, 0, b], Some(Number::Y), 2));
                triples.push(([a, b, 0], Some(Number::J), 2));
                // Nobody writes a leading zero except in J.
                let is_zero_led = |digits: &[u8]| digits.len() > 1 && digits[0] == b'0';
                for cut in (1..one.len()).filter(|cut| !is_zero_led(&one[*cut..])) {
                    triples.push(([value(&one[..cut]), value(&one[cut..]), b], None, 1));
                }
                for cut in 1..other.len() {
                    triples.push(([a, value(&other[..cut]), value(&other[cut..])], None, 1));
                }
            }
            _ => {}
        }
        triples
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: &str) {
        let Some(loose) = loose(text.as_bytes()) else {
            assert_eq!("nothing", expected, "{text}");
            return;
        };
        let numbers: Vec<String> = loose
            .numbers
            .iter()
            .map(|digits| String::from_utf8_lossy(digits).into_owned())
            .collect();
        let said = format!(
            "{} {:?} {} of {:?}",
            numbers.join(" "),
            loose.axis,
            loose.motions.len(),
            &text[loose.range.clone()]
        );
        assert_eq!(said, expected, "{text}");
    }

    #[test]
    fn what_is_missing_and_what_is_parted_cost_keys() {
        let keys = |text: &str| {
            let readings = loose(text.as_bytes()).unwrap().readings();
            let mut keys: Vec<usize> = readings.iter().map(|reading| reading.keys).collect();
            keys.sort_unstable();
            keys.dedup();
            keys
        };
        assert_eq!(keys("B9900B0B9900XL1"), [1]);
        assert_eq!(keys("B9900B0B9900L1"), [2]);
        // The B between two numbers, or a number of three.
        assert_eq!(keys("B9900B9900XL1"), [2, 3]);
    }

    #[test]
    fn what_is_there_of_a_broken_block_is_read() {
        check(
            "B9900B0B9900XL1",
            "9900 0 9900 Some(X) 1 of \"B9900B0B9900XL1\"",
        );
        check(
            "N  7: B 9.900 B 0 B 9900 GX  L1  ; 1 , 2",
            "9900 0 9900 Some(X) 1 of \"B 9.900 B 0 B 9900 GX  L1\"",
        );
        check(
            "B9900B0B9900GL1",
            "9900 0 9900 None 1 of \"B9900B0B9900GL1\"",
        );
        check("B9900B0B9900L1", "9900 0 9900 None 1 of \"B9900B0B9900L1\"");
        check(
            "B9900B0B9900GX",
            "9900 0 9900 Some(X) 12 of \"B9900B0B9900GX\"",
        );
        check(
            "B9900B0B9900GXN",
            "9900 0 9900 Some(X) 4 of \"B9900B0B9900GXN\"",
        );
        check(
            "B9900B0B9900GXS2",
            "9900 0 9900 Some(X) 1 of \"B9900B0B9900GXS2\"",
        );
        check(
            "B9900B0B9900GXR2",
            "9900 0 9900 Some(X) 2 of \"B9900B0B9900GXR2\"",
        );
        check(
            "B9900B-9900GXL2 ; a remark",
            "9900 9900 Some(X) 1 of \"B9900B-9900GXL2\"",
        );
        check(
            "B9900B0B9900GXL7",
            "9900 0 9900 Some(X) 4 of \"B9900B0B9900GXL7\"",
        );
        check(
            "B9900B0B9900GZL1",
            "9900 0 9900 None 1 of \"B9900B0B9900GZL1\"",
        );
        check("B9900GXL1", "nothing");
        check("9900", "nothing");
        check("B1B2B3B4B5", "nothing");
        check("B9900B0B9900GXL1 B9900B0B9900GXL1", "nothing");
    }
}
