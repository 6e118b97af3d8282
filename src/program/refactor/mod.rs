//! Refactorings of programs: the same part written in another way, or exactly mirrored, rotated or
//! scaled.
//!
//! One file a refactoring, the same for every language. Each says what replaces which move; the language, a
//! [`Notation`], writes it; [`proof`] reads the new program and compares each of its moves with the intended one. A
//! refactoring that fails there is not offered.

mod merge;
mod mirror;
mod notation;
mod number;
mod proof;
mod reverse;
mod scale;
mod start_here;
#[cfg(test)]
pub(in crate::program) mod tests;
mod transform;

pub(in crate::program) use notation::{At, Change, Content, News, Notation, Rewrite, Row, Sheet};
pub(in crate::program) use scale::{INCH, scaled};
pub(in crate::program) use transform::Transform;

use crate::settings::Effective;
use crate::text::TextEdit;
use std::ops::Range;

/// A refactoring as it is offered at a selection.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// Kind of its code action.
    pub id: &'static str,
    pub title: String,
    pub edits: Edits,
}

/// The edits, sorted and disjoint, or why it cannot be done: in lower case without a full stop.
pub(in crate::program) type Edits = Result<Vec<TextEdit>, String>;

/// One refactoring of a language.
pub(in crate::program) struct Refactoring<N: Notation> {
    /// Kind of its code action.
    pub(crate) id: &'static str,
    pub(crate) title: fn(&Effective) -> String,
    /// No edits where there is nothing to do.
    pub(crate) rewrite: fn(&Sheet<'_, N>) -> Edits,
}

/// All of a language, in the order in which they are offered.
fn all<N: Notation>() -> impl Iterator<Item = Refactoring<N>> {
    let of_contours = [reverse::reverse(), start_here::start_here()];
    of_contours
        .into_iter()
        .chain(mirror::all())
        .chain(scale::all())
        .chain([merge::merge()])
        .chain(N::own())
        .chain(number::all())
}

/// The possible refactorings of a program at a selection of bytes, except those that would change nothing.
///
/// `wanted` chooses by id.
pub(in crate::program) fn proposals<N: Notation>(
    document: &N::Document,
    settings: &Effective,
    selection: Range<usize>,
    wanted: &dyn Fn(&str) -> bool,
) -> Vec<Proposal> {
    let mut chosen = all::<N>()
        .filter(|refactoring| wanted(refactoring.id))
        .peekable();
    if chosen.peek().is_none() {
        return Vec::new();
    }
    let sheet = Sheet::new(document, settings, selection);
    let propose = |refactoring: Refactoring<N>| {
        let edits = (refactoring.rewrite)(&sheet);
        let changes = edits.as_ref().map_or(true, |edits| !edits.is_empty());
        changes.then(|| Proposal {
            id: refactoring.id,
            title: (refactoring.title)(settings),
            edits,
        })
    };
    chosen.filter_map(propose).collect()
}
