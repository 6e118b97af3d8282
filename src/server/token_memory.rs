//! The semantic tokens that the client was sent last for a document, so that after an edit only the difference is sent.
//!
//! Owns their packing and the difference. Knows nothing of texts or of how tokens are found.

use ls_types::{SemanticToken, SemanticTokensEdit};
use std::sync::{Mutex, PoisonError};

/// Bits of a packed token: lines forward, characters forward, length, kind.
const BITS: [u32; 4] = [16, 20, 20, 8];

/// Numbers of a token in the protocol.
const FIELDS: usize = 5;

/// Eight bytes a token; a document whose tokens do not fit into that is sent whole each time.
fn packed(token: &SemanticToken) -> Option<u64> {
    let fields = [
        token.delta_line,
        token.delta_start,
        token.length,
        token.token_type,
    ];
    if token.token_modifiers_bitset != 0 {
        return None;
    }
    fields.iter().zip(BITS).try_fold(0, |word, (&field, bits)| {
        (field >> bits == 0).then(|| word << bits | u64::from(field))
    })
}

#[derive(Default)]
struct Sent {
    stamp: u64,
    tokens: Vec<u64>,
}

/// What the client holds of one document. Shared with the workers that answer.
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

    /// Takes note of the tokens that are sent for `stamp`. Where the client holds those that are named `previous`, the edit that
    /// makes these of them; `None` where that is not known any more. The result id of the answer comes with it, if one can be given.
    pub(crate) fn replace(
        &self,
        previous: Option<&str>,
        stamp: u64,
        tokens: &[SemanticToken],
    ) -> (Option<String>, Option<SemanticTokensEdit>) {
        let now: Option<Vec<u64>> = tokens.iter().map(packed).collect();
        let mut sent = self.sent.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(now) = now else {
            *sent = None;
            return (None, None);
        };
        let before = sent
            .as_ref()
            .filter(|sent| previous.is_some_and(|previous| previous == sent.stamp.to_string()));
        let edit = before.map(|before| difference(&before.tokens, &now, tokens));
        *sent = Some(Sent { stamp, tokens: now });
        (Some(stamp.to_string()), edit)
    }
}

/// The one edit that makes `now` of `before`: what is alike at both ends stays. Positions are relative to the token before, so an edit
/// of a text changes tokens in one place, wherever its lines move to.
fn difference(before: &[u64], now: &[u64], tokens: &[SemanticToken]) -> SemanticTokensEdit {
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
    let data = tokens
        .get(front..tokens.len() - back)
        .unwrap_or_default()
        .to_vec();
    let number = |count: usize| u32::try_from(FIELDS * count).unwrap_or(u32::MAX);
    SemanticTokensEdit {
        start: number(front),
        delete_count: number(old.len() - back),
        data: Some(data),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn token(length: u32) -> SemanticToken {
        SemanticToken {
            delta_line: 1,
            delta_start: 0,
            length,
            token_type: 2,
            token_modifiers_bitset: 0,
        }
    }

    fn applied(before: &[SemanticToken], edit: &SemanticTokensEdit) -> Vec<SemanticToken> {
        let (start, count) = (
            edit.start as usize / FIELDS,
            edit.delete_count as usize / FIELDS,
        );
        let mut tokens = before.to_vec();
        tokens.splice(start..start + count, edit.data.clone().unwrap_or_default());
        tokens
    }

    proptest! {
        #[test]
        fn the_edit_makes_the_new_tokens_of_the_old_ones(before in prop::collection::vec(0u32..3, 0..12), now in prop::collection::vec(0u32..3, 0..12)) {
            let (before, now): (Vec<_>, Vec<_>) = (before.into_iter().map(token).collect(), now.into_iter().map(token).collect());
            let memory = TokenMemory::default();
            prop_assert_eq!(memory.replace(None, 1, &before), (Some("1".into()), None));
            let (id, edit) = memory.replace(Some("1"), 2, &now);
            prop_assert_eq!(id.as_deref(), Some("2"));
            prop_assert_eq!(applied(&before, &edit.unwrap()), now);
        }
    }

    #[test]
    fn one_token_in_the_middle_costs_one_token() {
        let memory = TokenMemory::default();
        memory.replace(None, 1, &[token(1), token(2), token(3)]);
        let (_, edit) = memory.replace(Some("1"), 2, &[token(1), token(7), token(3)]);
        assert_eq!(
            edit,
            Some(SemanticTokensEdit {
                start: 5,
                delete_count: 5,
                data: Some(vec![token(7)])
            })
        );
    }

    #[test]
    fn what_is_not_known_or_does_not_fit_is_sent_whole() {
        let memory = TokenMemory::default();
        memory.replace(None, 1, &[token(1)]);
        assert!(
            memory.is_current("1", 1) && !memory.is_current("1", 2) && !memory.is_current("x", 1)
        );
        assert_eq!(
            memory.replace(Some("0"), 2, &[token(1)]),
            (Some("2".into()), None),
            "another answer"
        );
        assert_eq!(
            memory.replace(Some("2"), 3, &[token(1 << 20)]),
            (None, None),
            "a line of a megabyte"
        );
        assert_eq!(
            memory.replace(Some("2"), 4, &[token(1)]),
            (Some("4".into()), None),
            "after it"
        );
    }
}
