//! What an editor asks about a program: the machine's way in words, contours, numbers, layouts.
//!
//! Functions of a document, without a protocol: places are bytes. What hangs on the machine's way is asked of its trace and is the
//! same for every language; what the pieces of a line are and mean is told by the language itself.

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
use crate::text::TextEdit;
use std::ops::Range;
use words::{Part, WordKind};

/// What a language of programs says of its own text.
trait Language {
    /// What can stand at a byte, what is most likely first.
    fn completions(&self, offset: usize) -> Vec<Completion>;

    /// The form of the block that is written at a byte; `None` where none is.
    fn signature(&self, offset: usize) -> Option<Signature>;

    /// What the word at a range of bytes says in its block, in Markdown; `None` for what means nothing.
    fn meaning(&self, word: Range<usize>) -> Option<String>;

    /// The pieces of a line that begins at a byte; damaged lines are cut as far as that goes.
    fn words(&self, line: &[u8], offset: usize) -> Vec<Part>;

    /// The word at a byte and the one that belongs to it, where that is not a matter of the machine's way.
    fn partner(&self, _: usize) -> Option<(Range<usize>, Range<usize>)> {
        None
    }

    /// Every place of what is named at a byte, in the order of the text, at most `limit`: lines that are called, rows of tables.
    fn named(&self, _: usize, _: usize, _: Stop<'_>) -> Result<Vec<Occurrence>, Stopped> {
        Ok(Vec::new())
    }

    /// What may lead a block number.
    fn letters_of_numbers(&self) -> &'static [char] {
        &['N', 'n']
    }

    /// The edits that give a block another number.
    fn renamed(
        &self,
        digits: Range<usize>,
        old: u32,
        name: &str,
        new: u32,
    ) -> Result<Vec<TextEdit>, String>;
}

fn of(document: &Document) -> &dyn Language {
    match document {
        Document::ThreeB(program) => program,
        Document::Iso(program) => &**program,
    }
}

/// What can stand at a byte, what is most likely first.
pub(crate) fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    of(document).completions(offset)
}

/// Every place of what is named at a byte.
pub(crate) fn named(
    document: &Document,
    offset: usize,
    limit: usize,
    stop: Stop<'_>,
) -> Result<Vec<Occurrence>, Stopped> {
    of(document).named(offset, limit, stop)
}

/// The form of the block that is written at a byte; `None` where none is.
pub(crate) fn signature(document: &Document, offset: usize) -> Option<Signature> {
    of(document).signature(offset)
}
