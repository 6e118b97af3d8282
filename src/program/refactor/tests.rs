//! What the tests of refactorings ask in every language. The cursor is `|` in a text; without one it is at its start.

use crate::program::{Document, Language, Proposal, refactorings, scaled};
use crate::settings::Effective;
use crate::text::{TextEdit, edited};
use proptest::prelude::*;
use std::ops::Range;

fn read(language: Language, text: &str) -> Document {
    Document::read(language, text.as_bytes().to_vec(), &Effective::default())
}

/// A text after some edits.
pub(in crate::program) fn made(text: &str, edits: &[TextEdit]) -> String {
    String::from_utf8(edited(text.as_bytes(), edits).unwrap()).unwrap()
}

/// What is offered at the cursor under an id without `refactor.rewrite.`
pub(in crate::program) fn proposed(language: Language, id: &str, text: &str) -> Vec<Proposal> {
    let offset = text.find('|').unwrap_or(0);
    let document = read(language, &text.replacen('|', "", 1));
    let is_wanted = |its: &str| its.strip_prefix("refactor.rewrite.") == Some(id);
    refactorings(&document, &Effective::default(), offset..offset, is_wanted)
}

/// The program after a refactoring; the reason where it is refused.
pub(in crate::program) fn refactored(
    language: Language,
    id: &str,
    text: &str,
) -> Result<String, String> {
    let found = proposed(language, id, text).into_iter().next();
    let text = text.replacen('|', "", 1);
    match found {
        None => Ok(text),
        Some(proposal) => Ok(made(&text, &proposal.edits?)),
    }
}

#[track_caller]
pub(in crate::program) fn check(language: Language, id: &str, text: &str, expected: &str) {
    let found = refactored(language, id, text);
    assert_eq!(found.as_deref(), Ok(expected), "{id} of {text}");
}

#[track_caller]
pub(in crate::program) fn refused(language: Language, id: &str, text: &str, reason: &str) {
    let found = refactored(language, id, text).expect_err(text);
    assert!(found.contains(reason), "{id} of {text}: {found}");
}

/// The program scaled; the reason where that is refused.
pub(in crate::program) fn scaled_by(
    language: Language,
    text: &str,
    factor: f64,
) -> Result<String, String> {
    let edits = scaled(&read(language, text), &Effective::default(), factor)?;
    Ok(made(text, &edits))
}

/// Whether whatever is offered at a selection is edits that can be made, or a reason.
pub(in crate::program) fn are_edits_or_reasons(
    language: Language,
    text: &str,
    selection: Range<usize>,
) -> Result<(), TestCaseError> {
    let document = read(language, text);
    let settings = Effective::default();
    let selection = selection.start.min(text.len())..selection.end.min(text.len());
    for proposal in refactorings(&document, &settings, selection, |_| true) {
        let (id, Ok(edits)) = (proposal.id, proposal.edits) else {
            continue;
        };
        let are_disjoint = |pair: &[TextEdit]| pair[0].range.end <= pair[1].range.start;
        prop_assert!(edits.windows(2).all(are_disjoint), "{}: {:?}", id, edits);
        let is_in_text =
            |edit: &TextEdit| edit.range.start <= edit.range.end && edit.range.end <= text.len();
        prop_assert!(edits.iter().all(is_in_text), "{}", id);
    }
    let _ = scaled(&document, &settings, 2.0);
    Ok(())
}
