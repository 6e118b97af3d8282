//! What an editor asks about a document: functions without a protocol, whose places are bytes.
//!
//! Answers have the same types whatever the document is. What can be asked of one place of any document with text is asked here; what
//! one kind alone answers, in its own room.

pub mod dxf;
pub mod program;

use crate::document::{Document, Source};
use std::borrow::Cow;
use std::ops::Range;

/// Lines of the text that one question for hints looks at; what lies behind them gets none.
pub const HINT_LINES: usize = 5_000;

/// Sentences in Markdown, and the bytes that they are about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    pub range: Range<usize>,
    pub text: String,
}

/// Words behind a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint {
    pub offset: usize,
    pub text: String,
}

/// Lines that fold behind their first, both ends included.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fold {
    pub first: usize,
    pub last: usize,
    pub kind: FoldKind,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FoldKind {
    /// A record of a drawing, and what stands for it when it is folded.
    Record(String),
    Contour,
    Comment,
}

/// What is offered to be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompletionKind {
    /// A group code.
    Code,
    /// The name of a record.
    Record,
    /// Of a layer, a block, a section.
    Name,
    /// Of a program.
    Word,
    /// Words of a program with places to fill in, as editors' snippets have them.
    Snippet,
}

/// Something that can be written at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    pub label: String,
    pub about: Cow<'static, str>,
    pub text: String,
    /// What the text takes the place of.
    pub range: Range<usize>,
    pub kind: CompletionKind,
}

/// What stands at a byte; `None` where nothing does.
pub fn hover(document: &Document, offset: usize) -> Option<Hover> {
    match document.source() {
        Source::Program(program) => program::hover(program, offset),
        Source::Dxf(dxf) => dxf::hover(dxf, offset, document.settings().unit_of(dxf.drawing())),
        Source::Cad(_) => None,
    }
}

/// Hints for what stands in a range of bytes, in the order of the text.
pub fn hints(document: &Document, range: Range<usize>) -> Vec<Hint> {
    match document.source() {
        Source::Program(program) => program::hints(program, range),
        Source::Dxf(dxf) => dxf::hints(dxf, range, document.settings().unit_of(dxf.drawing())),
        Source::Cad(_) => Vec::new(),
    }
}

/// Ranges of bytes around a byte, each within the next.
pub fn selections(document: &Document, offset: usize) -> Vec<Range<usize>> {
    match document.source() {
        Source::Program(program) => program::selections(program, offset),
        Source::Dxf(dxf) => dxf::selections(dxf, offset),
        Source::Cad(_) => Vec::new(),
    }
}

/// What can stand at a byte, what is most likely first.
pub fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    match document.source() {
        Source::Program(program) => program::completions(program, offset),
        Source::Dxf(dxf) => dxf::completions(dxf, offset),
        Source::Cad(_) => Vec::new(),
    }
}
