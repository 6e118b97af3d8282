//! Words of settings: the allowed ones, the one likely meant, keys in another spelling, lists in a sentence.

use serde::de::value::{Error, StrDeserializer};
use serde::de::{DeserializeOwned, IntoDeserializer};

/// The word of a list that was most likely meant: a few letters differ, no more than a third of them.
pub(crate) fn nearest<'a>(word: &str, words: &'a str) -> Option<&'a str> {
    let plain = |word: &str| snake_case(word).to_lowercase();
    let (word, most) = (plain(word), word.chars().count() / 3);
    let letter = |letter: char| !(letter.is_alphanumeric() || letter == '-');
    let near = words
        .split(letter)
        .filter(|known| known.chars().count() > 1)
        .map(|known| (distance(&word, &plain(known)), known))
        .filter(|(distance, _)| (1..=most).contains(distance));
    near.min_by_key(|(distance, _)| *distance)
        .map(|(_, known)| known)
}

/// Whether a single letter was missed.
pub(super) fn is_slip(word: &str, meant: &str) -> bool {
    distance(&snake_case(word), &snake_case(meant)) == 1
}

/// The number of letters added, removed, replaced or swapped between two words.
fn distance(one: &str, other: &str) -> usize {
    let other: Vec<char> = other.chars().collect();
    let mut before: Vec<usize> = Vec::new();
    let mut row: Vec<usize> = (0..=other.len()).collect();
    let mut last = None;
    for (at, letter) in one.chars().enumerate() {
        let (mut left, mut their_last) = (at + 1, None);
        let mut next = vec![left];
        for (column, (&their, above)) in other.iter().zip(row.windows(2)).enumerate() {
            let &[up_left, up] = above else { continue };
            let changed = up_left + usize::from(letter != their);
            let mut best = changed.min(up + 1).min(left + 1);
            let turned = last == Some(their) && their_last == Some(letter);
            if let Some(two_back) = before.get(column.wrapping_sub(1)).filter(|_| turned) {
                best = best.min(two_back + 1);
            }
            next.push(best);
            (left, their_last) = (best, Some(their));
        }
        before = std::mem::replace(&mut row, next);
        last = Some(letter);
    }
    row.last().copied().unwrap_or_default()
}

/// The words of a closed set's type.
pub(super) fn words_of<T: DeserializeOwned>() -> Vec<String> {
    let names = named::<T>("").err().unwrap_or_default();
    let is_letter = |letter: char| letter.is_ascii_alphanumeric() || "-_".contains(letter);
    let words = names.split(|letter| !is_letter(letter));
    let words = words.filter(|word| !word.is_empty() && !["one", "of", "or"].contains(word));
    words.map(str::to_owned).collect()
}

/// Begins the list of more than two words.
const ONE_OF: &str = "one of ";

/// A word out of a closed set; the error lists the words.
pub(super) fn named<T: DeserializeOwned>(word: &str) -> Result<T, String> {
    let deserializer: StrDeserializer<'_, Error> = word.into_deserializer();
    T::deserialize(deserializer).map_err(|error| {
        let error = error.to_string();
        let names = error.split_once("expected ").map_or("", |(_, names)| names);
        let names = names.replace('`', "");
        match names.strip_prefix(ONE_OF) {
            Some(words) => say!(one_of, words.replace(", ", say!(comma_between_words))),
            None => names.replace(" or ", say!(or_between_words)),
        }
    })
}

/// `wireDiameter` and `wire-diameter` as `wire_diameter`; both spellings are accepted everywhere.
pub(super) fn snake_case(key: &str) -> String {
    let mut snake = String::with_capacity(key.len() + 2);
    for letter in key.chars() {
        match letter {
            '-' => snake.push('_'),
            'A'..='Z' => snake.extend(['_', letter.to_ascii_lowercase()]),
            // The name of a field is not a spelling of its key.
            '_' => snake.push('-'),
            _ => snake.push(letter),
        }
    }
    snake
}

/// `one, two or three`.
pub(super) fn listed(keys: &[String]) -> String {
    match keys {
        [first @ .., last] if !first.is_empty() => {
            say!(one_or_other, first.join(", "), last)
        }
        keys => keys.concat(),
    }
}
