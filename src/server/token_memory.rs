//! Semantic tokens as they were sent last, for each document, so that after an edit only the difference is sent.
//!
//! Knows nothing of texts or of how tokens are found.

use ls_types::{SemanticToken, SemanticTokensEdit};
use std::sync::{Arc, Mutex, PoisonError};

/// Numbers of a token in the protocol.
const FIELDS: usize = 5;

struct Sent {
    stamp: u64,
    tokens: Arc<Vec<SemanticToken>>,
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

    /// Remembers the tokens sent for `stamp`. Returns the edit from those named `previous`, or `None` where they are no longer known.
    pub(crate) fn replace(
        &self,
        previous: Option<&str>,
        stamp: u64,
        tokens: &Arc<Vec<SemanticToken>>,
    ) -> Option<SemanticTokensEdit> {
        let mut sent = self.sent.lock().unwrap_or_else(PoisonError::into_inner);
        let before = sent
            .as_ref()
            .filter(|sent| previous.is_some_and(|previous| previous == sent.stamp.to_string()));
        let edit = before.map(|before| difference(&before.tokens, tokens));
        let tokens = tokens.clone();
        *sent = Some(Sent { stamp, tokens });
        edit
    }
}

/// The one edit from `before` to `now`: equal tokens at both ends stay. Positions are relative to the token before, so
/// an edit of a text changes tokens in one place, wherever its lines move to.
fn difference(before: &[SemanticToken], now: &[SemanticToken]) -> SemanticTokensEdit {
    let alike = |pair: &(&SemanticToken, &SemanticToken)| pair.0 == pair.1;
    let front = before.iter().zip(now).take_while(alike).count();
    let [old, new] = [before, now].map(|tokens| tokens.get(front..).unwrap_or_default());
    let back = old
        .iter()
        .rev()
        .zip(new.iter().rev())
        .take_while(alike)
        .count();
    let number = |tokens: usize| u32::try_from(FIELDS * tokens).unwrap_or(u32::MAX);
    SemanticTokensEdit {
        start: number(front),
        delete_count: number(old.len() - back),
        data: Some(new.get(..new.len() - back).unwrap_or_default().to_vec()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn tokens(lengths: &[u32]) -> Arc<Vec<SemanticToken>> {
        let token = |&length: &u32| SemanticToken {
            delta_line: 1,
            delta_start: 0,
            length,
            token_type: 2,
            token_modifiers_bitset: 0,
        };
        Arc::new(lengths.iter().map(token).collect())
    }

    proptest! {
        #[test]
        fn the_edit_makes_the_new_tokens_of_the_old_ones(before in prop::collection::vec(0u32..3, 0..12), now in prop::collection::vec(0u32..3, 0..12)) {
            let (before, now) = (tokens(&before), tokens(&now));
            let memory = TokenMemory::default();
            prop_assert_eq!(memory.replace(None, 1, &before), None);
            let edit = memory.replace(Some("1"), 2, &now).unwrap();
            let mut made = before.to_vec();
            let [start, count] = [edit.start, edit.delete_count].map(|numbers| numbers as usize / FIELDS);
            made.splice(start..start + count, edit.data.unwrap());
            prop_assert_eq!(made, now.to_vec());
        }
    }

    #[test]
    fn one_token_in_the_middle_costs_one_token() {
        let memory = TokenMemory::default();
        memory.replace(None, 1, &tokens(&[1, 2, 3]));
        let edit = memory.replace(Some("1"), 2, &tokens(&[1, 7, 3]));
        let expected = SemanticTokensEdit {
            start: 5,
            delete_count: 5,
            data: Some(tokens(&[7]).to_vec()),
        };
        assert_eq!(edit, Some(expected));
    }

    #[test]
    fn what_is_not_known_is_sent_whole() {
        let memory = TokenMemory::default();
        let one = tokens(&[1]);
        memory.replace(None, 1, &one);
        assert!(
            memory.is_current("1", 1) && !memory.is_current("1", 2) && !memory.is_current("x", 1)
        );
        assert_eq!(memory.replace(Some("0"), 2, &one), None, "another answer");
    }
}
