//! What helps while a block is being written.

use crate::program::{Document, iso, three_b};
use std::ops::Range;

/// Something that can be written at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    pub label: String,
    pub about: String,
    pub text: String,
    /// What the text takes the place of.
    pub range: Range<usize>,
    /// The text holds places to fill in, as editors' snippets have them.
    pub is_snippet: bool,
}

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
        Document::ThreeB(program) => three_b::language::completions(program, offset),
        Document::Iso(program) => iso::language::completions(program, offset),
    }
}

/// The form of the block that is written at a byte; `None` where none is.
pub fn signature(document: &Document, offset: usize) -> Option<Signature> {
    match document {
        Document::ThreeB(program) => three_b::language::signature(program, offset),
        Document::Iso(program) => iso::language::signature(program, offset),
    }
}
