//! What is left of a block that cannot be read: its numbers, its axis and its motion, as far as they are there.

use super::super::block::{Block, CountingAxis, Motion, Quadrant};
use std::ops::Range;

/// More digits than a number of a block has.
const DIGITS: usize = 12;

/// A number of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Number {
    X,
    Y,
    J,
}

/// A broken block.
#[derive(Clone, Debug, PartialEq)]
pub(in super::super) struct Loose {
    /// From its first number to the last of it that is there.
    pub(crate) range: Range<usize>,
    numbers: Vec<Vec<u8>>,
    axis: Option<CountingAxis>,
    motions: Vec<Motion>,
    /// Marks among the digits that no number has.
    marks: usize,
    missing: usize,
}

/// One way to read it; `unknown` is the number that has to be found, 0 in the block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reading {
    pub(crate) block: Block,
    pub(crate) unknown: Option<Number>,
    pub(crate) keys: usize,
}

/// Reads what there is of one block in a text, which holds nothing else but a number before it and a comment behind it.
pub(in super::super) fn loose(text: &[u8]) -> Option<Loose> {
    let mut at = 0;
    let skip = |at: &mut usize| {
        while matches!(text.get(*at), Some(b' ' | b'\t' | b'|')) {
            *at += 1;
        }
    };
    let upper = |at: usize| text.get(at).map(u8::to_ascii_uppercase);
    skip(&mut at);
    if upper(at) == Some(b'N') {
        at += 1;
        skip(&mut at);
        while text.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        skip(&mut at);
        at += usize::from(upper(at) == Some(b':'));
        skip(&mut at);
    }
    let start = at;
    let (mut numbers, mut marks) = (Vec::new(), 0);
    loop {
        skip(&mut at);
        let has_b = upper(at) == Some(b'B');
        at += usize::from(has_b);
        skip(&mut at);
        let mut digits = Vec::new();
        let first = at;
        while let Some(byte) = text.get(at) {
            match byte {
                b'0'..=b'9' => digits.push(*byte),
                b'O' | b'o' => digits.push(b'0'),
                b'-' | b'+' | b'.' | b',' => marks += 1,
                _ => break,
            }
            at += 1;
        }
        if !has_b && at == first {
            break;
        }
        if digits.len() > DIGITS {
            return None;
        }
        numbers.push(digits);
    }
    let mut end = at;
    let mut missing = 0;
    let mut axis = None;
    let has_g = upper(at) == Some(b'G');
    at += usize::from(has_g);
    skip(&mut at);
    match upper(at) {
        Some(b'X') => axis = Some(CountingAxis::X),
        Some(b'Y') => axis = Some(CountingAxis::Y),
        // Another letter in its place.
        Some(letter)
            if has_g
                && letter.is_ascii_alphabetic()
                && !matches!(letter, b'L' | b'S' | b'N' | b'R' | b'D') => {}
        _ => at = at.wrapping_sub(1),
    }
    at = at.wrapping_add(1);
    missing += usize::from(!has_g) + usize::from(axis.is_none());
    if has_g || axis.is_some() {
        end = at;
    }
    skip(&mut at);
    let kinds: &[fn(Quadrant) -> Motion] = match (upper(at), upper(at + 1)) {
        (Some(b'L'), _) => &[Motion::Line],
        (Some(b'S'), _) => &[Motion::Clockwise],
        (Some(b'N'), _) => &[Motion::CounterClockwise],
        (Some(b'R'), _) => &[Motion::CounterClockwise, Motion::Clockwise],
        _ => &[Motion::Line, Motion::CounterClockwise, Motion::Clockwise],
    };
    let mut has_kind = kinds.len() < 3;
    at += usize::from(has_kind);
    skip(&mut at);
    if has_kind
        && !matches!(kinds, [only] if matches!(only(Quadrant::First), Motion::Line(_)))
        && upper(at) == Some(b'R')
    {
        at += 1;
    } else if matches!(kinds, [only] if !matches!(only(Quadrant::First), Motion::Line(_))) {
        missing += 1;
    }
    missing += usize::from(kinds.len() > 1);
    if has_kind {
        end = at;
    }
    skip(&mut at);
    let quadrant = text
        .get(at)
        .and_then(|byte| Quadrant::from_number(byte.wrapping_sub(b'0')));
    if text.get(at).is_some_and(u8::is_ascii_digit) {
        at += 1;
        end = at;
        has_kind = true;
    }
    missing += usize::from(quadrant.is_none());
    let rest = text.get(at..).unwrap_or_default();
    let is_over = rest
        .iter()
        .find(|byte| !matches!(byte, b' ' | b'\t' | b'|'))
        .is_none_or(|byte| !byte.is_ascii_alphanumeric());
    let is_block = has_g || axis.is_some() || has_kind;
    if !is_over || !is_block || !(2..=3).contains(&numbers.len()) {
        return None;
    }
    let kind_of = |motion: &Motion| kinds.iter().any(|kind| kind(motion.quadrant()) == *motion);
    let is_in = |motion: &Motion| quadrant.is_none_or(|quadrant| motion.quadrant() == quadrant);
    let motions = Motion::all()
        .filter(|motion| kind_of(motion) && is_in(motion))
        .collect();
    Some(Loose {
        range: start..end,
        numbers,
        axis,
        motions,
        marks,
        missing,
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
        let keys = self.marks + self.missing;
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
                        keys: keys + more,
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
                // Nobody writes a number with a zero in front of it but J.
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
