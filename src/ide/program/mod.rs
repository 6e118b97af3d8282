//! Answers to an editor about a program: the machine's path in words, contours, numbers, layouts.
//!
//! Functions of a document, without a protocol: places are bytes. Answers about the machine's path
//! come from its trace and are the same for every language; the language itself supplies the pieces
//! of a line and their meanings.

mod folding;
mod hints;
mod hover;
mod iso;
mod navigation;
mod numbers;
mod selection;
mod step;
mod symbols;
#[cfg(test)]
mod tests;
mod three_b;
mod tokens;
mod words;

pub(crate) use folding::folds;
pub(crate) use hints::hints;
pub(crate) use hover::hover;
pub(crate) use navigation::{highlights, match_of, pauses};
pub(crate) use numbers::{number_at, renamed};
pub(crate) use selection::selections;
pub(crate) use symbols::symbols;
pub(crate) use tokens::{tokens, tokens_in};

use super::occurrence::{Occurrence, Stop, Stopped};
use super::{Completion, Signature};
use crate::program::Document;
use std::ops::Range;
use words::{LinePart, WordKind};

/// What a language of programs knows of its own text.
trait Language {
    /// What can stand at a byte, the most likely first.
    fn completions(&self, offset: usize) -> Vec<Completion>;

    /// The form of the block that is written at a byte; `None` where there is none.
    fn signature(&self, offset: usize) -> Option<Signature>;

    /// The meaning of the word at a range of bytes in its block, in Markdown; `None` for a word without one.
    fn meaning(&self, word: Range<usize>) -> Option<String>;

    /// The pieces of a line that begins at a byte; damaged lines are cut as far as possible.
    fn words(&self, line: &[u8], offset: usize) -> Vec<LinePart>;

    /// The word at a byte and its counterpart, unless that depends on the machine's path.
    fn partner(&self, _: usize) -> Option<(Range<usize>, Range<usize>)> {
        None
    }

    /// Every place of the name at a byte, in the order of the text, at most `limit`: lines that are called, rows of
    /// tables.
    fn named(&self, _: usize, _: usize, _: Stop<'_>) -> Result<Vec<Occurrence>, Stopped> {
        Ok(Vec::new())
    }

    /// The letters that may lead a block number.
    fn letters_of_numbers(&self) -> &'static [char] {
        &['N', 'n']
    }
}

fn of(document: &Document) -> &dyn Language {
    match document {
        Document::ThreeB(program) => program,
        Document::Iso(program) => &**program,
    }
}

/// What can stand at a byte, the most likely first.
pub(crate) fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    of(document).completions(offset)
}

/// Every place of the name at a byte.
pub(crate) fn named(
    document: &Document,
    offset: usize,
    limit: usize,
    stop: Stop<'_>,
) -> Result<Vec<Occurrence>, Stopped> {
    of(document).named(offset, limit, stop)
}

/// The form of the block that is written at a byte; `None` where there is none.
pub(crate) fn signature(document: &Document, offset: usize) -> Option<Signature> {
    of(document).signature(offset)
}
