//! Group codes and numbers: read from bytes, written as text. Knows nothing of tags or entities.

use std::ops::Range;

/// The range of `bytes` without padding on either side: spaces, tabs, and the end mark of old systems (^Z).
pub(super) fn trimmed_range(bytes: &[u8]) -> Range<usize> {
    let padding = |byte: &u8| matches!(byte, b' ' | b'\t' | 0x1a);
    let start = bytes
        .iter()
        .position(|byte| !padding(byte))
        .unwrap_or(bytes.len());
    let end = bytes
        .iter()
        .rposition(|byte| !padding(byte))
        .map_or(start, |last| last + 1);
    start..end
}

pub(super) fn trimmed(bytes: &[u8]) -> &[u8] {
    bytes.get(trimmed_range(bytes)).unwrap_or_default()
}

/// The result of reading a line that should be a group code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Code {
    Known(i16),
    /// A whole number that is not a valid group code.
    OutOfRange,
    NotANumber,
}

/// Reads a group code; padding is allowed.
pub(crate) fn code(line: &[u8]) -> Code {
    // Nearly all code lines are one to four digits after spaces.
    let mut at = 0;
    while let Some(b' ' | b'\t') = line.get(at) {
        at += 1;
    }
    let mut value = 0i32;
    let first = at;
    while let Some(digit @ b'0'..=b'9') = line.get(at)
        && at - first < 6
    {
        value = value * 10 + i32::from(digit - b'0');
        at += 1;
    }
    if at == line.len() && at > first {
        return in_range(value);
    }
    let text = trimmed(line);
    let (negative, digits) = match text {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return Code::NotANumber;
    }
    let value = digits.iter().fold(0i32, |sum, digit| {
        (sum * 10 + i32::from(digit - b'0')).min(1_000_000)
    });
    in_range(if negative { -value } else { value })
}

fn in_range(value: i32) -> Code {
    if (-10..=1071).contains(&value) {
        Code::Known(value as i16)
    } else {
        Code::OutOfRange
    }
}

/// The result of reading a value that should be a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Number {
    Exact(f64),
    /// A number with a blemish worth a finding.
    Blemished(f64, &'static str),
    Bad,
}

const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Reads a decimal number; padding is allowed. Only finite numbers in decimal notation are numbers.
pub(crate) fn number(line: &[u8]) -> Number {
    let text = trimmed(line);
    if let Some(value) = decimal(text) {
        return Number::Exact(value);
    }
    let without_nul = text
        .iter()
        .rposition(|&byte| byte != 0)
        .and_then(|last| text.get(..=last))
        .unwrap_or_default();
    if without_nul.len() < text.len() {
        return match decimal(trimmed(without_nul)) {
            Some(value) => Number::Blemished(value, say!(is_followed_by_nul_bytes)),
            None => Number::Bad,
        };
    }
    let mut plain = text.to_vec();
    let mut letters = plain.iter_mut();
    if let Some(exponent) = letters.find(|byte| matches!(byte, b'd' | b'D')) {
        *exponent = b'e';
        if let Some(value) = decimal(&plain) {
            return Number::Blemished(value, say!(has_a_fortran_exponent_expected_e));
        }
    }
    Number::Bad
}

/// The number `[-] digits [. digits]` at the start of the bytes, and its length. `None` also where
/// it is too long to be read in one step.
fn leading(bytes: &[u8]) -> Option<(f64, usize)> {
    let digit = |at: usize| {
        bytes
            .get(at)
            .map(|byte| byte.wrapping_sub(b'0'))
            .filter(|&digit| digit < 10)
    };
    let negative = bytes.first() == Some(&b'-');
    let first = usize::from(negative);
    let (mut at, mut mantissa, mut decimals) = (first, 0u64, 0);
    while let Some(digit) = digit(at) {
        mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        at += 1;
    }
    let mut digits = at - first;
    if bytes.get(at) == Some(&b'.') {
        let point = at + 1;
        at = point;
        if let Some(eight) = bytes
            .get(at..)
            .and_then(<[u8]>::first_chunk)
            .and_then(|chunk| eight_digits(*chunk))
        {
            mantissa = mantissa.wrapping_mul(100_000_000).wrapping_add(eight);
            at += 8;
        }
        while let Some(digit) = digit(at) {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
            at += 1;
        }
        decimals = at - point;
        digits += decimals;
    }
    if !(1..=19).contains(&digits) || mantissa > 1 << 53 {
        return None;
    }
    // Both factors are exact, so the only rounding is correct (Clinger, "How to read floating point numbers
    // accurately").
    let value = mantissa as f64 / POWERS.get(decimals)?;
    // Zero has no sign here.
    Some((if negative { 0.0 - value } else { value }, at))
}

/// The number that eight digits make, by pairs and then pairs of pairs.
fn eight_digits(digits: [u8; 8]) -> Option<u64> {
    let word = u64::from_le_bytes(digits);
    let high = 0xf0f0_f0f0_f0f0_f0f0;
    let are_digits = word & high == 0x3030_3030_3030_3030
        && word.wrapping_add(0x0606_0606_0606_0606) & high == 0x3030_3030_3030_3030;
    let pairs = (word & 0x0f0f_0f0f_0f0f_0f0f).wrapping_mul((10 << 8) + 1) >> 8;
    let fours = (pairs & 0x00ff_00ff_00ff_00ff).wrapping_mul((100 << 16) + 1) >> 16;
    let eight = (fours & 0x0000_ffff_0000_ffff).wrapping_mul((10_000 << 32) + 1) >> 32;
    are_digits.then_some(eight)
}

fn digit(text: &[u8], at: usize) -> Option<u8> {
    let digit = text.get(at)?.wrapping_sub(b'0');
    (digit < 10).then_some(digit)
}

/// `[+-] digits [. digits] [e [+-] digits]` with at least one digit before the exponent.
fn decimal(text: &[u8]) -> Option<f64> {
    if let Some((value, _)) = leading(text).filter(|&(_, length)| length == text.len()) {
        return Some(value);
    }
    let (negative, start) = match text.first()? {
        b'-' => (true, 1),
        b'+' => (false, 1),
        _ => (false, 0),
    };
    let mut at = start;
    let (mut mantissa, mut digits, mut scale) = (0u64, 0u32, 0i32);
    while let Some(digit) = digit(text, at) {
        mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        digits += 1;
        at += 1;
    }
    if text.get(at) == Some(&b'.') {
        at += 1;
        while let Some(digit) = digit(text, at) {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
            digits += 1;
            scale -= 1;
            at += 1;
        }
    }
    if digits == 0 {
        return None;
    }
    if let Some(b'e' | b'E') = text.get(at) {
        at += 1;
        let negative_exponent = match text.get(at) {
            Some(b'-') => {
                at += 1;
                true
            }
            Some(b'+') => {
                at += 1;
                false
            }
            _ => false,
        };
        let first = at;
        let mut exponent = 0i32;
        while let Some(digit) = digit(text, at) {
            exponent = (exponent * 10 + i32::from(digit)).min(100_000);
            at += 1;
        }
        if at == first {
            return None;
        }
        scale = scale.saturating_add(if negative_exponent {
            -exponent
        } else {
            exponent
        });
    }
    if at != text.len() {
        return None;
    }
    // Both factors are exact, so the only rounding is correct (Clinger, "How to read floating point numbers
    // accurately").
    if digits <= 19
        && mantissa <= 1 << 53
        && let Some(power) = POWERS.get(scale.unsigned_abs() as usize)
    {
        let value = if scale < 0 {
            mantissa as f64 / power
        } else {
            mantissa as f64 * power
        };
        // Zero has no sign here.
        return Some(if negative { 0.0 - value } else { value });
    }
    std::str::from_utf8(text)
        .ok()?
        .parse::<f64>()
        .ok()
        .filter(|value| value.is_finite())
        .map(|value| value + 0.0)
}

/// A number as DXF text: no exponent, at most `decimals` decimals and at least one.
pub(crate) fn written(value: f64, decimals: usize) -> String {
    let mut text = format!("{value:.decimals$}");
    if text.contains('.') {
        while text.ends_with('0') && !text.ends_with(".0") {
            text.pop();
        }
    } else {
        text.push_str(".0");
    }
    if text == "-0.0" { "0.0".into() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn a_number_is_what_the_standard_library_reads(text in "[-+]?[0-9]{0,12}(\\.[0-9]{0,20})?([eE][-+]?[0-9]{1,3})?") {
            let expected = text.parse::<f64>().ok().filter(|value| value.is_finite()).map(|value| value + 0.0);
            let found = match number(text.as_bytes()) {
                Number::Exact(value) => Some(value),
                _ => None,
            };
            prop_assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{}", text);
        }
    }

    #[test]
    fn codes() {
        for (line, expected) in [
            ("0", Code::Known(0)),
            (" 10", Code::Known(10)),
            ("\t-5 ", Code::Known(-5)),
            ("0010", Code::Known(10)),
            ("1071", Code::Known(1071)),
            ("1072", Code::OutOfRange),
            ("99999999999", Code::OutOfRange),
            ("", Code::NotANumber),
            ("1.0", Code::NotANumber),
            ("LINE", Code::NotANumber),
            ("1 0", Code::NotANumber),
        ] {
            assert_eq!(code(line.as_bytes()), expected, "{line:?}");
        }
    }

    #[test]
    fn numbers() {
        for (line, expected) in [
            ("1.e1", Some(10.0)),
            ("+.5", Some(0.5)),
            ("-1E-3", Some(-0.001)),
            (" 00012.5000\t", Some(12.5)),
            ("0.1", Some(0.1)),
            ("12.345678901234567", Some(12.345678901234567)),
            (
                "123456789012345678901234567890",
                Some(123456789012345678901234567890.0),
            ),
            ("1e-300", Some(1e-300)),
            ("1e999", None),
            ("1,5", None),
            ("nan", None),
            ("inf", None),
            ("1e", None),
            (".", None),
            ("", None),
            ("0x10", None),
            ("1.2.3", None),
        ] {
            let value = match number(line.as_bytes()) {
                Number::Exact(value) => Some(value),
                _ => None,
            };
            assert_eq!(value, expected, "{line:?}");
        }
        assert!(matches!(number(b"1D2"), Number::Blemished(100.0, _)));
        assert!(matches!(number(b"10\0"), Number::Blemished(10.0, _)));
        assert_eq!(number(b"D2"), Number::Bad);
    }

    #[test]
    fn written_numbers_are_short_and_without_exponent() {
        for (value, decimals, expected) in [
            (1.0, 12, "1.0"),
            (0.1 + 0.2, 12, "0.3"),
            (-1e-15, 12, "0.0"),
            (1e-9, 12, "0.000000001"),
            (1e20, 12, "100000000000000000000.0"),
            (-0.25, 15, "-0.25"),
        ] {
            assert_eq!(written(value, decimals), expected);
        }
    }
}
