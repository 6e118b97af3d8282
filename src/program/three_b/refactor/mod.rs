//! Refactorings of 3B: the same part, written otherwise; or exactly mirrored, turned, scaled, offset.
//!
//! One file a refactoring, all in [`ALL`]. Each says what stands in the place of which block; `rewrite` writes the text, reads it
//! again and holds every new block against the piece of the path that it stands for. What fails that is not offered.

mod correction;
mod layout;
mod merge;
mod number;
mod reverse;
mod rewrite;
mod scale;
mod sheet;
mod split;
mod start_here;
#[cfg(test)]
mod tests;
mod transform;

pub use scale::scaled;
pub use sheet::Sheet;

use super::Document;
use crate::program::language::Proposal;
use crate::settings::Effective;
use crate::text::TextEdit;
use std::ops::Range;

/// One refactoring.
pub struct Refactoring {
    /// Kind of its code action.
    pub id: &'static str,
    pub title: fn(&Effective) -> String,
    /// The edits, sorted and disjoint; none where there is nothing to do. Errors say why it cannot be done: lower-case, no final dot.
    pub rewrite: fn(&Sheet<'_>) -> Result<Vec<TextEdit>, String>,
}

/// All of them, in the order in which they are offered.
pub const ALL: [Refactoring; 18] = [
    reverse::REVERSE,
    start_here::START_HERE,
    transform::MIRROR_X,
    transform::MIRROR_Y,
    transform::ROTATE_LEFT,
    transform::ROTATE_RIGHT,
    transform::ROTATE_HALF,
    scale::INCH_TO_MM,
    scale::MM_TO_INCH,
    merge::MERGE,
    split::SPLIT,
    correction::OPENING,
    correction::PUNCH,
    layout::COMPACT,
    layout::ALIGNED,
    layout::CHECKING,
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
    if chosen.is_empty() {
        return Vec::new();
    }
    let sheet = Sheet::new(document, settings, selection);
    let propose = |refactoring: &Refactoring| {
        let edits = (refactoring.rewrite)(&sheet);
        let changes = edits.as_ref().map_or(true, |edits| !edits.is_empty());
        changes.then(|| Proposal {
            id: refactoring.id,
            title: (refactoring.title)(settings),
            edits,
        })
    };
    chosen.into_iter().filter_map(propose).collect()
}
