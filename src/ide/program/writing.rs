//! What helps while a block is being written.

use super::{iso, three_b};
use crate::ide::Completion;
use crate::program::Document;

/// The form of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signature {
    pub label: &'static str,
    /// Each part of the form and what it means, in Markdown.
    pub parameters: &'static [(&'static str, &'static str)],
    /// Index of the part that the cursor is in.
    pub active: usize,
}

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
