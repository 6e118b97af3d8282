//! Refactorings of ISO programs: the same part, written otherwise; or exactly mirrored, turned, scaled.
//!
//! One file a refactoring. Each says where the moves of which lines lead afterwards; `rewrite` writes the words, runs every line again
//! as the control does and holds its move against what was meant, and at last reads the new program as a whole. What fails that is not
//! offered.

mod centers;
mod mode;
mod number;
mod profile;
mod reverse;
mod rewrite;
mod scale;
mod sheet;
mod start_here;
mod taper;
#[cfg(test)]
mod tests;
mod transform;

use super::document::Document;
use crate::program::language::Proposal;
use crate::settings::Effective;
use crate::text::TextEdit;
pub(super) use number::numbered;
pub use number::renamed;
pub(super) use rewrite::{Bent, Target, line_to, with_word};
pub use scale::scaled;
use sheet::Sheet;
use std::ops::Range;
pub(in crate::program) use taper::{Words as TaperWords, refuse_anywhere as refuse_taper};

/// One refactoring.
struct Refactoring {
    /// Kind of its code action.
    id: &'static str,
    title: &'static str,
    /// The edits, sorted and disjoint; none where there is nothing to do. Errors say why it cannot be done: lower-case, no final dot.
    rewrite: fn(&Sheet<'_>) -> Result<Vec<TextEdit>, String>,
}

/// All but those of profiles, in the order in which they are offered.
const ALL: [Refactoring; 14] = [
    reverse::REVERSE,
    start_here::START_HERE,
    transform::MIRROR_X,
    transform::MIRROR_Y,
    transform::ROTATE_LEFT,
    transform::ROTATE_RIGHT,
    transform::ROTATE_HALF,
    mode::ABSOLUTE,
    mode::INCREMENTAL,
    centers::START_TO_CENTER,
    centers::CENTER_TO_START,
    centers::ABSOLUTE,
    number::NUMBER,
    number::WITHOUT_NUMBERS,
];

/// What can be done with a program at a selection of bytes; refactorings that would change nothing are left out.
///
/// `wanted` chooses by id.
pub fn proposals(
    document: &Document,
    settings: &Effective,
    selection: Range<usize>,
    wanted: impl Fn(&str) -> bool,
) -> Vec<Proposal> {
    let chosen: Vec<&Refactoring> = ALL
        .iter()
        .filter(|refactoring| wanted(refactoring.id))
        .collect();
    let mut found = Vec::new();
    if !chosen.is_empty() {
        let sheet = Sheet::new(document, settings, selection);
        for refactoring in chosen {
            let edits = (refactoring.rewrite)(&sheet);
            if edits.as_ref().map_or(true, |edits| !edits.is_empty()) {
                found.push(Proposal {
                    id: refactoring.id,
                    title: refactoring.title.to_owned(),
                    edits,
                });
            }
        }
    }
    if wanted(profile::ID) {
        found.extend(profile::proposals(document, settings));
    }
    found
}
