//! What an editor asks about a document: functions without a protocol, whose places are bytes.
//!
//! Answers have the same types whatever the document is. What can be asked of one place of any document with text is asked here, what
//! looks at the whole of it of `Whole`; what one kind alone answers, in its own room.

mod amounts;
pub mod dxf;
mod occurrence;
pub(crate) mod program;
mod symbol;
mod whole;

pub(crate) use occurrence::{Occurrence, Question, Role, Stop, Stopped};
pub use symbol::Symbol;
pub(crate) use symbol::SymbolKind;
pub(crate) use whole::Whole;

use crate::document::{Document, Source};
use crate::drawing::Unit;
use std::borrow::Cow;
use std::ops::Range;

/// Lines of the text that one question for hints looks at; what lies behind them gets none.
pub(crate) const HINT_LINES: usize = 5_000;

/// Sentences in Markdown, and the bytes that they are about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Hover {
    pub(crate) range: Range<usize>,
    pub(crate) text: String,
}

/// Words behind a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Hint {
    pub(crate) offset: usize,
    pub(crate) text: String,
}

/// Lines that fold behind their first, both ends included.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fold {
    pub first: usize,
    pub last: usize,
    pub(crate) kind: FoldKind,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum FoldKind {
    /// A record of a drawing, and what stands for it when it is folded.
    Record(String),
    Contour,
    Comment,
}

/// What a piece of a text is, as themes have colours for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TokenKind {
    Code,
    Record,
    Handle,
    Layer,
    Number,
    Text,
    Comment,
    /// Name of a header variable.
    Variable,
    /// Name of a section, table, block or subclass.
    Name,
}

impl TokenKind {
    /// All kinds; the position of each is its number.
    pub(crate) const ALL: [TokenKind; 9] = [
        TokenKind::Code,
        TokenKind::Record,
        TokenKind::Handle,
        TokenKind::Layer,
        TokenKind::Number,
        TokenKind::Text,
        TokenKind::Comment,
        TokenKind::Variable,
        TokenKind::Name,
    ];
}

/// A piece of a line, for colouring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    pub line: usize,
    /// Bytes from the beginning of the line as the text has it.
    pub start: usize,
    pub length: usize,
    pub(crate) kind: TokenKind,
}

/// What is offered to be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CompletionKind {
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
pub(crate) struct Completion {
    pub(crate) label: String,
    pub(crate) about: Cow<'static, str>,
    pub(crate) text: String,
    /// What the text takes the place of.
    pub(crate) range: Range<usize>,
    pub(crate) kind: CompletionKind,
}

impl Completion {
    /// What is listed as it is written.
    fn new(
        text: impl Into<String>,
        about: impl Into<Cow<'static, str>>,
        range: &Range<usize>,
        kind: CompletionKind,
    ) -> Completion {
        let text = text.into();
        Completion {
            label: text.clone(),
            about: about.into(),
            text,
            range: range.clone(),
            kind,
        }
    }

    fn snippet(label: &str, about: &'static str, text: &str, range: &Range<usize>) -> Completion {
        Completion {
            label: label.into(),
            ..Completion::new(text, about, range, CompletionKind::Snippet)
        }
    }
}

/// The form of what is written at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Signature {
    pub(crate) label: &'static str,
    /// Each part of the form, as it stands in the label, and what it means, in Markdown.
    pub(crate) parameters: Vec<(&'static str, &'static str)>,
    /// Index of the part that the cursor is in.
    pub(crate) active: usize,
}

/// Asks a document with text by its kind.
macro_rules! ask {
    ($document:ident, $feature:ident($place:expr) $(, $unit:expr)?) => {
        match $document.source() {
            Source::Program(program) => program::$feature(program, $place),
            Source::Dxf(dxf) => dxf::$feature(dxf, $place $(, $unit)?),
            Source::Cad(_) => Default::default(),
        }
    };
}

fn unit_of(document: &Document) -> Unit {
    Unit {
        mm: document.unit_mm(),
    }
}

/// What stands at a byte; `None` where nothing does.
pub(crate) fn hover(document: &Document, offset: usize) -> Option<Hover> {
    ask!(document, hover(offset), unit_of(document))
}

/// Hints for what stands in a range of bytes, in the order of the text.
pub(crate) fn hints(document: &Document, range: Range<usize>) -> Vec<Hint> {
    ask!(document, hints(range), unit_of(document))
}

/// Ranges of bytes around a byte, each within the next.
pub(crate) fn selections(document: &Document, offset: usize) -> Vec<Range<usize>> {
    ask!(document, selections(offset))
}

/// What can stand at a byte, what is most likely first.
pub(crate) fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    ask!(document, completions(offset))
}

/// The tokens of some lines.
pub(crate) fn tokens_in(document: &Document, lines: Range<usize>) -> Vec<Token> {
    ask!(document, tokens_in(lines))
}

/// The form of what is written at a byte; `None` where none is.
pub(crate) fn signature(document: &Document, offset: usize) -> Option<Signature> {
    program::signature(document.program()?, offset)
}

/// Adds a range where it holds the last one and is another; the first where it holds the byte.
fn widen(found: &mut Vec<Range<usize>>, offset: usize, range: Range<usize>) {
    let grows = match found.last() {
        None => range.start <= offset && offset <= range.end,
        Some(last) => range.start <= last.start && last.end <= range.end && range != *last,
    };
    if grows {
        found.push(range);
    }
}
