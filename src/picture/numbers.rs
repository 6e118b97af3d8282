//! Numbers of a picture: at most three decimals, without trailing zeros and without a minus before zero.

/// A larger number, or none, is written as the language does it.
const LARGEST: f64 = 1e12;

/// A number as text.
pub(super) fn number(value: f64) -> String {
    let mut text = String::new();
    if value.abs() < LARGEST {
        push_thousandths(&mut text, thousandths(value));
    } else {
        text = format!("{value:.3}");
    }
    text
}

/// A number in thousandths, rounded as `{:.3}` does it: a half goes to the even side.
pub(super) fn thousandths(value: f64) -> i64 {
    let scaled = value * 1e3;
    if scaled.abs() < 1e9 {
        let nearest = (scaled + 0.5_f64.copysign(scaled)) as i64;
        // A product is off by its rounding: about the middle between two, digits decide.
        let from_middle = 0.5 - (scaled - nearest as f64).abs();
        if from_middle > 1e-6 {
            return nearest;
        }
    }
    let digits = format!("{:.3}", value.clamp(-LARGEST, LARGEST)).replace('.', "");
    digits.parse().unwrap_or_default()
}

/// Appends a number that is given in thousandths.
pub(super) fn push_thousandths(text: &mut String, thousandths: i64) {
    if thousandths < 0 {
        text.push('-');
    }
    let all = thousandths.unsigned_abs();
    let mut digits = [b'0'; 20];
    let (mut left, mut first) = (all / 1000, digits.len());
    for digit in digits.iter_mut().rev() {
        *digit = b'0' + (left % 10) as u8;
        (left, first) = (left / 10, first - 1);
        if left == 0 {
            break;
        }
    }
    let whole = digits.iter().skip(first);
    text.extend(whole.map(|digit| char::from(*digit)));
    let mut rest = all % 1000;
    if rest > 0 {
        text.push('.');
    }
    let mut place = 100;
    while rest > 0 {
        text.push(char::from(b'0' + (rest / place) as u8));
        (rest, place) = (rest % place, place / 10);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn value() -> impl Strategy<Value = f64> {
        let halves = (-4_000_000i64..4_000_000).prop_map(|it| it as f64 / 2e3);
        let eighths = (-80_000i64..80_000).prop_map(|it| it as f64 / 16.0);
        prop_oneof![-1e4..1e4, -1.0..1.0, -1e11..1e11, halves, eighths]
    }

    proptest! {
        #[test]
        fn numbers_are_rounded_as_the_language_does_it(value in value()) {
            let text = format!("{value:.3}");
            let text = text.trim_end_matches('0').trim_end_matches('.');
            prop_assert_eq!(number(value), if text == "-0" { "0" } else { text });
        }
    }
}
