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

pub use folding::folds;
pub use hints::hints;
pub use hover::hover;
pub use navigation::{highlights, match_of, pauses};
pub use numbers::{number_at, renamed};
pub use selection::selections;
pub use symbols::symbols;
pub use tokens::{tokens, tokens_in};
pub use words::{Part, WordKind, words_of};

use super::{Completion, Signature};
use crate::program::Document;

/// What can stand at a byte, what is most likely first.
pub fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    match document {
        Document::ThreeB(program) => three_b::completions(program, offset),
        Document::Iso(program) => iso::completions(program, offset),
    }
}

/// The form of the block that is written at a byte; `None` where none is.
pub fn signature(document: &Document, offset: usize) -> Option<Signature> {
    match document {
        Document::ThreeB(program) => three_b::signature(program, offset),
        Document::Iso(program) => iso::signature(program, offset),
    }
}
