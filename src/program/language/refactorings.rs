//! Refactorings of a program, whatever its language.

use super::numbers::{numbered, without_numbers};
use crate::program::trace::Trace;
use crate::program::{Document, three_b};
use crate::settings::Effective;
use crate::text::TextEdit;
use std::ops::Range;

/// A refactoring as it is offered at a selection.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// Kind of its code action.
    pub id: &'static str,
    pub title: String,
    /// The edits, sorted and disjoint, or why it cannot be done: lower-case, no final dot.
    pub edits: Result<Vec<TextEdit>, String>,
}

/// What can be done with a program at a selection of bytes; what would change nothing is left out. `wanted` chooses by id.
pub fn refactorings(document: &Document, settings: &Effective, selection: Range<usize>, wanted: impl Fn(&str) -> bool) -> Vec<Proposal> {
    match document {
        Document::ThreeB(program) => three_b::refactor::proposals(program, settings, selection, wanted),
        Document::Iso(_) => of_iso(document, settings, wanted),
    }
}

/// The edits that scale a program.
pub fn scaled(document: &Document, settings: &Effective, factor: f64) -> Result<Vec<TextEdit>, String> {
    match document {
        Document::ThreeB(program) => three_b::refactor::scaled(&three_b::refactor::Sheet::new(program, settings, 0..0), factor),
        Document::Iso(_) => Err("ISO programs are not scaled, expected 3B".into()),
    }
}

fn of_iso(document: &Document, settings: &Effective, wanted: impl Fn(&str) -> bool) -> Vec<Proposal> {
    let lines = 0..document.text().line_count();
    let propose = |id: &'static str, title: &str, edits: &dyn Fn() -> Vec<TextEdit>| {
        if !wanted(id) {
            return None;
        }
        let edits = if calls_numbers(document) {
            Err("the program may call subprograms or blocks by their numbers".to_owned())
        } else {
            let edits = edits();
            is_same_way(document, settings, &edits)
                .then_some(edits)
                .ok_or_else(|| "the numbers are part of what the machine does".to_owned())
        };
        let changes = edits.as_ref().map_or(true, |edits| !edits.is_empty());
        changes.then(|| Proposal { id, title: title.to_owned(), edits })
    };
    let number = propose("refactor.rewrite.number", "Number the blocks in tens", &|| numbered(document, lines.clone(), 10, 10));
    let without = propose("refactor.rewrite.withoutNumbers", "Leave the block numbers out", &|| without_numbers(document, lines.clone()));
    number.into_iter().chain(without).collect()
}

/// True where a word may name a block's number.
fn calls_numbers(document: &Document) -> bool {
    let text = document.text().bytes().to_ascii_uppercase();
    ["M98", "M97", "G25", "GOTO", "CALL"].iter().any(|word| memchr::memmem::find(&text, word.as_bytes()).is_some())
}

fn is_same_way(document: &Document, settings: &Effective, edits: &[TextEdit]) -> bool {
    let mut bytes = document.text().bytes().to_vec();
    for edit in edits.iter().rev() {
        bytes.splice(edit.range.clone(), edit.text.bytes());
    }
    let after = Document::read(document.language(), bytes, settings);
    let way = |trace: &Trace| trace.steps.iter().map(|step| (step.kind, step.line, step.ideal)).collect::<Vec<_>>();
    way(&after.trace()) == way(&document.trace())
}
