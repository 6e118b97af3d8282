//! Numbers that differ by one wrong keystroke.

/// The numbers that may have been meant, each one keystroke away. `pointed` says whether numbers
/// have a point, if known. Nobody writes an additional leading zero, but a padded number keeps its length.
pub(in crate::program) fn meant(text: &str, pointed: Option<bool>) -> Vec<String> {
    let digits: Vec<(usize, &str)> = text
        .match_indices(|letter: char| letter.is_ascii_digit())
        .collect();
    let mut meant: Vec<String> = Vec::new();
    let mut put = |at: usize, end: usize, other: &str| {
        let mut changed = text.to_owned();
        changed.replace_range(at..end, other);
        meant.push(changed);
    };
    let all: [&str; 10] = ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9"];
    for (nth, &(at, own)) in digits.iter().enumerate() {
        let before = nth.checked_sub(1).map(|nth| digits[nth]);
        let last = before.map(|(_, digit)| digit);
        let is_behind = before.is_some_and(|(before, _)| before + 1 == at);
        for digit in all {
            if digit != own {
                put(at, at + 1, digit);
            }
            // After an equal digit the result is the same.
            if !(is_behind && last == Some(digit)) {
                put(at, at, digit);
            }
        }
        if digits.len() > 1 {
            put(at, at + 1, "");
        }
        if let Some(&(next, other)) = digits.get(nth + 1)
            && other != own
        {
            let between = text.get(at + 1..next).unwrap_or_default();
            put(at, next + 1, &format!("{other}{between}{own}"));
        }
    }
    // Behind the last digit, and the last one before the point, or the one that is lost there.
    let ends = text.find('.').into_iter().chain([text.len()]);
    for at in ends {
        all.iter().for_each(|digit| put(at, at, digit));
    }
    match text.starts_with(['-', '+']) {
        true => put(0, 1, ""),
        false => put(0, 0, "-"),
    }
    match (text.find('.'), pointed) {
        (None, Some(true)) => {
            let places = digits.iter().map(|(at, _)| *at);
            let places = places
                .clone()
                .skip(1)
                .chain([text.len()])
                .chain(places.take(1));
            places.for_each(|at| put(at, at, "."));
        }
        (Some(at), Some(false)) => put(at, at + 1, ""),
        _ => {}
    }
    let most = zeros(text);
    let is_padded = most > 0;
    meant.retain(|other| zeros(other) <= most || is_padded && other.len() == text.len());
    meant
}

/// The whole numbers that may have been meant by some digits, each one keystroke away; without zeros in front, but where
/// numbers are filled up with them.
pub(in crate::program) fn numbers(digits: &str, is_padded: bool) -> Vec<i64> {
    let is_plain = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    let value = digits.parse::<i64>().ok();
    let Some(value) = value.filter(|_| is_plain && digits.len() < 18) else {
        return Vec::new();
    };
    let count = digits.len() as u32;
    let power = |place: u32| 10_i64.pow(place);
    let digit = |place: u32| value / power(place) % 10;
    let mut found = Vec::new();
    for place in 0..=count {
        let (behind, before) = (value % power(place), value / power(place));
        for other in 0..10 {
            found.push(((before * 10 + other) * power(place) + behind, count + 1));
            if place < count && other != digit(place) {
                found.push((value + (other - digit(place)) * power(place), count));
            }
        }
        if place < count && count > 1 {
            let without = value / power(place + 1) * power(place) + behind;
            found.push((without, count - 1));
        }
        if place + 1 < count {
            let by = digit(place) - digit(place + 1);
            found.push((value + by * (power(place + 1) - power(place)), count));
        }
    }
    let has_no_zero_more = |(number, long): &(i64, u32)| {
        is_padded && *long == count || *long == 1 || *number >= power(*long - 1)
    };
    found.retain(has_no_zero_more);
    let mut found: Vec<i64> = found.into_iter().map(|(number, _)| number).collect();
    found.retain(|number| *number != value);
    found.sort_unstable();
    found.dedup();
    found
}

/// Superfluous leading zeros of a number.
fn zeros(text: &str) -> usize {
    let digits = text.trim_start_matches(['-', '+']);
    let rest = digits.trim_start_matches('0');
    let is_needed = rest.is_empty() || rest.starts_with('.');
    (digits.len() - rest.len()).saturating_sub(usize::from(is_needed))
}

/// True where adding, removing, replacing or swapping one character turns one text into the other.
pub(in crate::program) fn is_slip(found: &[u8], meant: &[u8]) -> bool {
    let head = found.iter().zip(meant).take_while(|(a, b)| a == b).count();
    let (a, b) = (&found[head..], &meant[head..]);
    let tail = a
        .iter()
        .rev()
        .zip(b.iter().rev())
        .take_while(|(a, b)| a == b)
        .count();
    match (&a[..a.len() - tail], &b[..b.len() - tail]) {
        ([_], [] | [_]) | ([], [_]) => true,
        ([one, two], [other, another]) => one == another && two == other,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_is_one_key() {
        for (found, meant, expected) in [
            ("5000", "500", true),
            ("500", "5000", true),
            ("5000", "5100", true),
            ("1500", "5100", true),
            ("", "7", true),
            ("5000", "5000", false),
            ("5000", "3100", false),
            ("12", "2100", false),
        ] {
            assert_eq!(
                is_slip(found.as_bytes(), meant.as_bytes()),
                expected,
                "{found} {meant}"
            );
        }
    }

    #[test]
    fn a_padded_digit_and_one_lost_before_the_point_are_meant() {
        for (text, other, expected) in [
            ("01016", "00016", true),
            (".6217", "3.6217", true),
            ("-.6", "-1.6", true),
            ("1016", "0016", false),
            ("500", "0500", false),
        ] {
            let is_meant = meant(text, None).iter().any(|meant| meant == other);
            assert_eq!(is_meant, expected, "{text} {other}");
        }
    }

    #[test]
    fn whatever_may_be_meant_is_one_key_away() {
        for (text, pointed) in [
            ("0", None),
            ("5000", Some(true)),
            ("-12.50", Some(false)),
            ("1100", None),
            ("", None),
        ] {
            for meant in meant(text, pointed) {
                // The digits on both sides of a point may change places.
                let without = |text: &str| text.replace('.', "");
                let [one, other] = [text, &meant].map(without);
                let is_one = is_slip(text.as_bytes(), meant.as_bytes())
                    || is_slip(one.as_bytes(), other.as_bytes());
                assert!(is_one, "{text}: {meant}");
            }
        }
    }

    proptest::proptest! {
        /// Text and numbers agree on what a keystroke makes.
        #[test]
        fn numbers_one_key_away_are_those_that_keys_make(digits in "0|[1-9][0-9]{0,7}") {
            let all = meant(&digits, None).into_iter();
            let all = all.filter(|text| {
                let is_led = text.len() > 1 && text.starts_with('0');
                !text.starts_with('-') && !is_led
            });
            let mut expected: Vec<i64> = all.filter_map(|text| text.parse().ok()).collect();
            expected.retain(|number| number.to_string() != digits);
            expected.sort_unstable();
            expected.dedup();
            proptest::prop_assert_eq!(numbers(&digits, false), expected);
        }
    }

    #[test]
    fn what_is_lost_may_have_stood_alone_before_the_point() {
        for (text, lost) in [(".910", "4.910"), ("-.910", "-4.910"), ("4.", "4.5")] {
            let meant = meant(text, Some(true));
            assert!(meant.contains(&lost.into()), "{meant:?}");
        }
    }

    #[test]
    fn what_is_meant_has_no_zero_more_in_front() {
        let meant = meant("500", None);
        for (other, is_meant) in [
            ("0500", false),
            ("050", false),
            ("-500", true),
            ("1500", true),
        ] {
            assert_eq!(
                meant.iter().any(|meant| meant == other),
                is_meant,
                "{other}"
            );
        }
    }
}
