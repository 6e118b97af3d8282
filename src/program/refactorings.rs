//! Refactorings of a program in any language.

use crate::program::document::Document;
use crate::program::iso::refactor::Iso;
use crate::program::profile;
use crate::program::refactor::{self, Offer, Proposal, Sheet};
use crate::program::three_b::refactor::ThreeB;
use crate::settings::Effective;
use crate::text::TextEdit;
use std::ops::Range;

/// What may be possible at a selection of bytes, nothing of it tried. `wanted` chooses by id.
pub fn offers<'a>(
    document: &'a Document,
    settings: &'a Effective,
    selection: Range<usize>,
    wanted: impl Fn(&str) -> bool,
) -> Vec<Offer<'a>> {
    match document {
        Document::ThreeB(program) => {
            refactor::offers::<ThreeB>(program, settings, selection, &wanted)
        }
        // The heights of an electrode belong to the moves as they are.
        Document::Iso(program) if program.mills() => Vec::new(),
        Document::Iso(program) => {
            let mut found = refactor::offers::<Iso>(program, settings, selection, &wanted);
            if wanted(profile::ID) {
                found.extend(profile::offers(document, settings));
            }
            found
        }
    }
}

/// All of them tried, except those that would change nothing.
pub fn refactorings(
    document: &Document,
    settings: &Effective,
    selection: Range<usize>,
    wanted: impl Fn(&str) -> bool,
) -> Vec<Proposal> {
    let offers = offers(document, settings, selection, wanted).into_iter();
    offers.filter_map(Offer::tried).collect()
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
