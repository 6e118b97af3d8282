//! Semantic tokens as they are sent: packed, as JSON text, and remembered for each document, so that after an edit only
//! the difference is sent.
//!
//! Knows nothing of texts or of how tokens are found.

use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// A token relative to the one before, as in the protocol: lines forward, characters forward, length, type. It has no
/// modifiers.
pub(in crate::server) type Fields = [u32; 4];

/// Bits of each field in a packed token.
const BITS: [u32; 4] = [16, 20, 20, 8];

/// Marks a token that does not fit; no type has this number.
const WIDE: u64 = u64::MAX;

/// Numbers of a token in the protocol.
const FIELDS: usize = 5;

/// Beyond this many tokens several cores write the text, each this many at a time.
const AT_ONCE: usize = 1 << 15;

/// The tokens of a document, eight bytes each.
#[derive(Debug, Default)]
pub(in crate::server) struct Packed {
    words: Vec<u64>,
    /// Those that do not fit, in their order, such as those of a text with a single line of megabytes.
    wide: Vec<Fields>,
}

impl Packed {
    pub(crate) fn with_capacity(count: usize) -> Packed {
        Packed {
            words: Vec::with_capacity(count),
            wide: Vec::new(),
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.words.len()
    }

    pub(crate) fn push(&mut self, fields: Fields) {
        let mut word = 0;
        let mut fits = true;
        for (field, bits) in fields.into_iter().zip(BITS) {
            fits &= field >> bits == 0;
            word = word << bits | u64::from(field);
        }
        if !fits {
            self.wide.push(fields);
        }
        self.words.push(if fits { word } else { WIDE });
    }

    /// The numbers of some tokens as a JSON array; of all, where some are wide.
    pub(crate) fn write(&self, range: Range<usize>, json: &mut Vec<u8>) {
        let words = self.words.get(range).unwrap_or_default();
        json.push(b'[');
        if self.wide.is_empty() && words.len() > AT_ONCE {
            let pieces: Vec<Vec<u8>> = words
                .par_chunks(AT_ONCE)
                .map(|words| {
                    let mut piece = Vec::new();
                    push_tokens(words, &[], &mut piece);
                    piece
                })
                .collect();
            json.reserve(pieces.iter().map(Vec::len).sum::<usize>() + 1);
            pieces
                .iter()
                .for_each(|piece| json.extend_from_slice(piece));
        } else {
            push_tokens(words, &self.wide, json);
        }
        if !words.is_empty() {
            json.pop();
        }
        json.push(b']');
    }
}

/// The numbers of some tokens, with a comma after each; `wide` are those of the tokens that are wide.
fn push_tokens(words: &[u64], wide: &[Fields], json: &mut Vec<u8>) {
    json.reserve(words.len() * 10 + 1);
    let mut wide = wide.iter();
    for &word in words {
        let mut rest = word;
        let mut fields = [0; 4];
        for (field, bits) in fields.iter_mut().zip(BITS).rev() {
            *field = (rest & ((1 << bits) - 1)) as u32;
            rest >>= bits;
        }
        if word == WIDE {
            fields = wide.next().copied().unwrap_or(fields);
        }
        let digit = |number: u32| b'0' + (number % 10) as u8;
        for field in fields {
            // Nearly all numbers have one digit or two.
            match field {
                0..10 => json.extend_from_slice(&[digit(field), b',']),
                10..100 => json.extend_from_slice(&[digit(field / 10), digit(field), b',']),
                _ => {
                    json.extend_from_slice(field.to_string().as_bytes());
                    json.push(b',');
                }
            }
        }
        json.extend_from_slice(b"0,");
    }
}

/// Turns the tokens of one answer into those of another: numbers to remove, and tokens to insert.
#[derive(Debug, PartialEq, Eq)]
pub(in crate::server) struct Difference {
    pub(crate) start: usize,
    pub(crate) delete_count: usize,
    pub(crate) tokens: Range<usize>,
}

struct Sent {
    stamp: u64,
    tokens: Arc<Packed>,
}

/// The tokens of one document that the client holds. Shared with the workers that answer.
#[derive(Default)]
pub(in crate::server) struct TokenMemory {
    sent: Mutex<Option<Sent>>,
}

impl TokenMemory {
    /// True where the client, which names the tokens of `previous`, holds those of `stamp` already.
    pub(crate) fn is_current(&self, previous: &str, stamp: u64) -> bool {
        let sent = self.sent.lock().unwrap_or_else(PoisonError::into_inner);
        sent.as_ref()
            .is_some_and(|sent| sent.stamp == stamp && previous == stamp.to_string())
    }

    /// Remembers the tokens sent for `stamp`. Returns the edit from those named `previous`, or
    /// `None` where they are no longer known; and the result id, if there can be one: wide tokens
    /// are sent whole each time.
    pub(crate) fn replace(
        &self,
        previous: Option<&str>,
        stamp: u64,
        tokens: &Arc<Packed>,
    ) -> (Option<String>, Option<Difference>) {
        let mut sent = self.sent.lock().unwrap_or_else(PoisonError::into_inner);
        if !tokens.wide.is_empty() {
            *sent = None;
            return (None, None);
        }
        let before = sent
            .as_ref()
            .filter(|sent| previous.is_some_and(|previous| previous == sent.stamp.to_string()));
        let edit = before.map(|before| difference(&before.tokens.words, &tokens.words));
        *sent = Some(Sent {
            stamp,
            tokens: tokens.clone(),
        });
        (Some(stamp.to_string()), edit)
    }
}

/// The one edit from `before` to `now`: equal tokens at both ends stay. Positions are relative to the token before, so
/// an edit of a text changes tokens in one place, wherever its lines move to.
fn difference(before: &[u64], now: &[u64]) -> Difference {
    let alike = |pair: &(&u64, &u64)| pair.0 == pair.1;
    let front = before.iter().zip(now).take_while(alike).count();
    let (old, new) = (
        before.get(front..).unwrap_or_default(),
        now.get(front..).unwrap_or_default(),
    );
    let back = old
        .iter()
        .rev()
        .zip(new.iter().rev())
        .take_while(alike)
        .count();
    Difference {
        start: FIELDS * front,
        delete_count: FIELDS * (old.len() - back),
        tokens: front..now.len() - back,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn token(length: u32) -> Fields {
        [1, 0, length, 2]
    }

    fn packed(tokens: &[Fields]) -> Arc<Packed> {
        let mut packed = Packed::with_capacity(tokens.len());
        tokens.iter().for_each(|&fields| packed.push(fields));
        Arc::new(packed)
    }

    fn written(tokens: &Packed, range: Range<usize>) -> Vec<u32> {
        let mut json = Vec::new();
        tokens.write(range, &mut json);
        serde_json::from_slice(&json).unwrap()
    }

    proptest! {
        #[test]
        fn the_edit_makes_the_new_tokens_of_the_old_ones(before in prop::collection::vec(0u32..3, 0..12), now in prop::collection::vec(0u32..3, 0..12)) {
            let pack = |lengths: Vec<u32>| packed(&lengths.into_iter().map(token).collect::<Vec<_>>());
            let (before, now) = (pack(before), pack(now));
            let memory = TokenMemory::default();
            prop_assert_eq!(memory.replace(None, 1, &before), (Some("1".into()), None));
            let (id, edit) = memory.replace(Some("1"), 2, &now);
            prop_assert_eq!(id.as_deref(), Some("2"));
            let Difference { start, delete_count, tokens } = edit.unwrap();
            let mut numbers = written(&before, 0..before.len());
            numbers.splice(start..start + delete_count, written(&now, tokens));
            prop_assert_eq!(numbers, written(&now, 0..now.len()));
        }

        #[test]
        fn tokens_are_written_as_they_were_packed(tokens in prop::collection::vec([0u32..1 << 18, 0u32..1 << 22, 0u32..1 << 22, 0u32..9], 0..12)) {
            let expected: Vec<u32> = tokens.iter().flat_map(|&[a, b, c, d]| [a, b, c, d, 0]).collect();
            prop_assert_eq!(written(&packed(&tokens), 0..tokens.len()), expected);
        }
    }

    #[test]
    fn many_tokens_are_written_as_few_are() {
        let numbers = |at: usize| [1, at as u32 % 13, at as u32 % 1_000, 2];
        let tokens: Vec<Fields> = (0..2 * AT_ONCE + 3).map(numbers).collect();
        let expected: Vec<u32> = tokens
            .iter()
            .flat_map(|&[a, b, c, d]| [a, b, c, d, 0])
            .collect();
        assert_eq!(written(&packed(&tokens), 0..tokens.len()), expected);
    }

    #[test]
    fn one_token_in_the_middle_costs_one_token() {
        let memory = TokenMemory::default();
        memory.replace(None, 1, &packed(&[token(1), token(2), token(3)]));
        let now = packed(&[token(1), token(7), token(3)]);
        let (_, edit) = memory.replace(Some("1"), 2, &now);
        let expected = Difference {
            start: 5,
            delete_count: 5,
            tokens: 1..2,
        };
        assert_eq!(edit, Some(expected));
        assert_eq!(written(&now, 1..2), [1, 0, 7, 2, 0]);
    }

    #[test]
    fn what_is_not_known_or_does_not_fit_is_sent_whole() {
        let memory = TokenMemory::default();
        let one = packed(&[token(1)]);
        memory.replace(None, 1, &one);
        assert!(
            memory.is_current("1", 1) && !memory.is_current("1", 2) && !memory.is_current("x", 1)
        );
        assert_eq!(
            memory.replace(Some("0"), 2, &one),
            (Some("2".into()), None),
            "another answer"
        );
        assert_eq!(
            memory.replace(Some("2"), 3, &packed(&[token(1 << 20)])),
            (None, None),
            "a line of a megabyte"
        );
        assert_eq!(
            memory.replace(Some("2"), 4, &one),
            (Some("4".into()), None),
            "after it"
        );
    }
}
