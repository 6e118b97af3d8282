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

use super::{Completion, Signature};
use crate::program::Document;

/// What can stand at a byte, what is most likely first.
pub(crate) fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    match document {
        Document::ThreeB(program) => three_b::completions(program, offset),
        Document::Iso(program) => iso::completions(program, offset),
    }
}

/// The form of the block that is written at a byte; `None` where none is.
pub(crate) fn signature(document: &Document, offset: usize) -> Option<Signature> {
    match document {
        Document::ThreeB(program) => three_b::signature(program, offset),
        Document::Iso(program) => iso::signature(program, offset),
    }
}
