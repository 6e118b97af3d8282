//! Refactorings of a program in any language.

use crate::program::document::Document;
use crate::program::iso::refactor::Iso;
use crate::program::profile;
use crate::program::refactor::{self, Proposal, Sheet};
use crate::program::three_b::refactor::ThreeB;
use crate::settings::Effective;
use crate::text::TextEdit;
use std::ops::Range;

/// The possible refactorings of a program at a selection of bytes, except those that would change nothing. `wanted`
/// chooses by id.
pub fn refactorings(
    document: &Document,
    settings: &Effective,
    selection: Range<usize>,
    wanted: impl Fn(&str) -> bool,
) -> Vec<Proposal> {
    match document {
        Document::ThreeB(program) => {
            refactor::proposals::<ThreeB>(program, settings, selection, &wanted)
        }
        // The heights of an electrode belong to the moves as they are.
        Document::Iso(program) if program.mills() => Vec::new(),
        Document::Iso(program) => {
            let mut found = refactor::proposals::<Iso>(program, settings, selection, &wanted);
            if wanted(profile::ID) {
                found.extend(profile::proposals(document, settings));
            }
            found
        }
    }
}

/// The edits that scale a program.
pub fn scaled(
    document: &Document,
    settings: &Effective,
    factor: f64,
) -> Result<Vec<TextEdit>, String> {
    match document {
        Document::ThreeB(program) => {
            refactor::scaled(&Sheet::<ThreeB>::new(program, settings, 0..0), factor)
        }
        Document::Iso(program) if program.mills() => Err(say!(it_is_milled).into()),
        Document::Iso(program) => {
            refactor::scaled(&Sheet::<Iso>::new(program, settings, 0..0), factor)
        }
    }
}
