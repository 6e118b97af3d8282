//! Questions about the whole of a text, asked after every edit: they run on a copy, and stop when
//! the answer is no longer wanted.

use super::occurrence::{Occurrence, Question, Role, Stop, Stopped};
use super::program::{highlights, match_of, pauses};
use super::{Fold, Symbol, Token, dxf, program};
use crate::document::Snapshot;
use crate::program::Document;
use crate::text::SourceText;

/// The most places in one answer.
const PLACES: usize = 10_000;

/// The text that such a question holds.
#[derive(Clone, Copy)]
pub(crate) enum Whole<'a> {
    Program(&'a Document),
    /// For DXF only the text; the name at the place that is asked about; drawing and contours, where they are listed.
    Dxf {
        text: &'a SourceText,
        name: Option<&'a dxf::Name>,
        snapshot: Option<&'a Snapshot>,
    },
}

impl<'a> Whole<'a> {
    pub(crate) fn text(&self) -> &'a SourceText {
        match self {
            Whole::Program(program) => program.text(),
            Whole::Dxf { text, .. } => text,
        }
    }

    /// The folds, at most `limit`: beyond it the outermost.
    pub(crate) fn folds(&self, limit: usize, stop: Stop<'_>) -> Result<Vec<Fold>, Stopped> {
        match self {
            Whole::Program(program) => Ok(program::folds(program, limit)),
            Whole::Dxf { text, .. } => {
                let tree = dxf::outline(text, stop).ok_or(Stopped)?;
                Ok(dxf::folds(&tree, limit))
            }
        }
    }

    /// The tree of everything with a name.
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

    /// Calls `take` for each piece of the text, at most `limit`.
    pub(crate) fn tokens(
        &self,
        limit: usize,
        stop: Stop<'_>,
        take: impl FnMut(Token),
    ) -> Result<(), Stopped> {
        match self {
            Whole::Program(program) => program::tokens(program, limit, stop, take),
            Whole::Dxf { text, .. } => dxf::tokens(text, limit, stop, take).ok_or(Stopped),
        }
    }

    /// The other occurrences of what stands at a byte; `None` where DXF names nothing there.
    pub(crate) fn occurrences(
        &self,
        offset: usize,
        question: Question,
        stop: Stop<'_>,
    ) -> Result<Option<Vec<Occurrence>>, Stopped> {
        match (self, question) {
            (Whole::Program(program), question) => {
                places_in_program(program, offset, question, stop).map(Some)
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
                found.retain(|found| question.wants(found.role));
                Ok(Some(found))
            }
        }
    }
}

/// In a program, the places of a name, or else the places that belong together.
fn places_in_program(
    program: &Document,
    offset: usize,
    question: Question,
    stop: Stop<'_>,
) -> Result<Vec<Occurrence>, Stopped> {
    let partner = |range| Occurrence {
        range,
        role: Role::Partner,
    };
    let mut named = program::named(program, offset, PLACES, stop)?;
    let is_told = named.len() > 1 || named.iter().any(|place| place.role == Role::Uses);
    named.retain(|place| question.wants(place.role));
    if is_told {
        return Ok(named);
    }
    let together: Vec<Occurrence> = match question {
        Question::Definition => match_of(program, offset).map(partner).into_iter().collect(),
        Question::Highlights => highlights(program, offset)
            .into_iter()
            .map(partner)
            .collect(),
        Question::References { .. } => {
            let all = pauses(program);
            let is_one = all
                .iter()
                .any(|range| range.start <= offset && offset <= range.end);
            let all = all.into_iter().filter(|_| is_one).take(PLACES);
            all.map(partner).collect()
        }
    };
    // A name without other occurrences, such as a line that is never called, still has its own.
    Ok(if together.is_empty() { named } else { together })
}
