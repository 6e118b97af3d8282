//! Refactorings of a program, whatever its language.

use crate::program::{Document, iso, three_b};
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
pub fn refactorings(
    document: &Document,
    settings: &Effective,
    selection: Range<usize>,
    wanted: impl Fn(&str) -> bool,
) -> Vec<Proposal> {
    match document {
        Document::ThreeB(program) => {
            three_b::refactor::proposals(program, settings, selection, wanted)
        }
        Document::Iso(program) => iso::refactor::proposals(program, settings, selection, wanted),
    }
}

/// The edits that scale a program.
pub fn scaled(
    document: &Document,
    settings: &Effective,
    factor: f64,
) -> Result<Vec<TextEdit>, String> {
    match document {
        Document::ThreeB(program) => three_b::refactor::scaled(
            &three_b::refactor::Sheet::new(program, settings, 0..0),
            factor,
        ),
        Document::Iso(program) => iso::refactor::scaled(program, settings, factor),
    }
}
