//! What an editor asks about the whole of a text, after every edit: it runs beside the document, and stops when nobody waits any more.

use super::program::{highlights, match_of, pauses};
use super::{Fold, Symbol, Token, dxf, program};
use crate::document::Snapshot;
use crate::program::Document;
use crate::text::SourceText;
use std::ops::Range;

/// Places of one answer.
const PLACES: usize = 10_000;

/// Asked now and then: true when nobody wants the result any more.
pub(crate) type Stop<'a> = &'a dyn Fn() -> bool;

/// Nobody wanted the result any more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Stopped;

/// A text, as far as such a question holds it.
#[derive(Clone, Copy)]
pub(crate) enum Whole<'a> {
    Program(&'a Document),
    /// Of DXF the text alone; what is named at the place that is asked about; drawing and contours, for those who list them.
    Dxf {
        text: &'a SourceText,
        name: Option<&'a dxf::Name>,
        snapshot: Option<&'a Snapshot>,
    },
}

/// What is asked about a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Question {
    Definition,
    References { with_definition: bool },
    Highlights,
}

/// What an occurrence is to what is asked about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    Defines,
    Uses,
    /// It belongs to it.
    Partner,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Occurrence {
    pub(crate) range: Range<usize>,
    pub(crate) role: Role,
}

impl<'a> Whole<'a> {
    pub(crate) fn text(&self) -> &'a SourceText {
        match self {
            Whole::Program(program) => program.text(),
            Whole::Dxf { text, .. } => text,
        }
    }

    /// What can be folded, at most `limit`: where there is more, what holds others.
    pub(crate) fn folds(&self, limit: usize, stop: Stop<'_>) -> Result<Vec<Fold>, Stopped> {
        match self {
            Whole::Program(program) => Ok(program::folds(program, limit)),
            Whole::Dxf { text, .. } => {
                let tree = dxf::outline(text, stop).ok_or(Stopped)?;
                Ok(dxf::folds(&tree, limit))
            }
        }
    }

    /// The tree of what has a name.
    pub(crate) fn symbols(&self, stop: Stop<'_>) -> Result<Vec<Symbol>, Stopped> {
        match self {
            Whole::Program(program) => Ok(program::symbols(program)),
            Whole::Dxf { text, snapshot, .. } => {
                let tree = dxf::outline(text, stop).ok_or(Stopped)?;
                let contours = snapshot.map(dxf::notes).unwrap_or_default();
                Ok(dxf::symbols(tree, &contours))
            }
        }
    }

    /// The pieces of the text, at most `limit`.
    pub(crate) fn tokens(&self, limit: usize, stop: Stop<'_>) -> Result<Vec<Token>, Stopped> {
        match self {
            Whole::Program(program) => Ok(program::tokens(program, limit)),
            Whole::Dxf { text, .. } => dxf::tokens(text, limit, stop).ok_or(Stopped),
        }
    }

    /// Where what stands at a byte stands elsewhere; `None` where DXF names nothing there.
    pub(crate) fn occurrences(
        &self,
        offset: usize,
        question: Question,
        stop: Stop<'_>,
    ) -> Result<Option<Vec<Occurrence>>, Stopped> {
        let of_program = |range| Occurrence {
            range,
            role: Role::Partner,
        };
        match (self, question) {
            (Whole::Program(program), Question::Definition) => Ok(Some(
                match_of(program, offset)
                    .map(of_program)
                    .into_iter()
                    .collect(),
            )),
            (Whole::Program(program), Question::Highlights) => Ok(Some(
                highlights(program, offset)
                    .into_iter()
                    .map(of_program)
                    .collect(),
            )),
            (Whole::Program(program), Question::References { .. }) => {
                let all = pauses(program);
                let is_one = all
                    .iter()
                    .any(|range| range.start <= offset && offset <= range.end);
                let all = all.into_iter().filter(|_| is_one).take(PLACES);
                Ok(Some(all.map(of_program).collect()))
            }
            (Whole::Dxf { name: None, .. }, _) => Ok(None),
            (
                Whole::Dxf {
                    text,
                    name: Some(name),
                    ..
                },
                question,
            ) => {
                let mut found = dxf::occurrences(text, name, PLACES, stop).ok_or(Stopped)?;
                found.retain(|found| match question {
                    Question::Definition => found.role == Role::Defines,
                    Question::References { with_definition } => {
                        with_definition || found.role != Role::Defines
                    }
                    Question::Highlights => true,
                });
                Ok(Some(found))
            }
        }
    }
}
