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
use std::cell::LazyCell;
use std::ops::Range;
use std::rc::Rc;

/// A refactoring that may be possible at a selection: it is not tried before its edits are asked for.
pub struct Offer<'a> {
    /// Kind of its code action.
    pub id: &'static str,
    pub title: String,
    make: Box<dyn Fn() -> Edits + 'a>,
}

impl<'a> Offer<'a> {
    pub(in crate::program) fn new(
        id: &'static str,
        title: String,
        make: impl Fn() -> Edits + 'a,
    ) -> Offer<'a> {
        let make = Box::new(make);
        Offer { id, title, make }
    }

    /// The edits, empty where there is nothing to do, or why it cannot be done.
    pub fn edits(&self) -> Edits {
        (self.make)()
    }

    /// The refactoring with its edits; nothing where it would change nothing.
    pub fn tried(self) -> Option<Proposal> {
        let edits = self.edits();
        let changes = edits.as_ref().map_or(true, |edits| !edits.is_empty());
        let Offer { id, title, .. } = self;
        changes.then_some(Proposal { id, title, edits })
    }
}

/// A refactoring that has been tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
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

/// The refactorings of a program at a selection of bytes. `wanted` chooses by id.
pub(in crate::program) fn offers<'a, N: Notation + 'a>(
    document: &'a N::Document,
    settings: &'a Effective,
    selection: Range<usize>,
    wanted: &dyn Fn(&str) -> bool,
) -> Vec<Offer<'a>> {
    let sheet = move || Sheet::<N>::new(document, settings, selection.clone());
    let sheet = Rc::new(LazyCell::new(sheet));
    let offer = |refactoring: Refactoring<N>| {
        let (sheet, Refactoring { id, title, rewrite }) = (sheet.clone(), refactoring);
        Offer::new(id, title(settings), move || rewrite(&sheet))
    };
    let chosen = all::<N>().filter(|refactoring| wanted(refactoring.id));
    chosen.map(offer).collect()
}
