//! Answers to an editor about a document: functions without a protocol, whose places are bytes.
//!
//! Answers have the same types whatever the document is. Questions about one place of any document with text are here,
//! questions about the whole of it in `Whole`; the rooms below answer for their kind of document.

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

use crate::analysis;
use crate::document::{Document, Snapshot, Source};
use crate::drawing::Unit;
use std::borrow::Cow;
use std::ops::Range;

/// Lines of the text that one question for hints reads; the lines after get none.
pub(crate) const HINT_LINES: usize = 5_000;

/// Sentences in Markdown, and the bytes that they are about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Hover {
    pub(crate) range: Range<usize>,
    pub(crate) text: String,
}

/// Words shown after a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Hint {
    pub(crate) offset: usize,
    pub(crate) text: String,
}

/// Lines that fold into the first of them, both ends included.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fold {
    pub first: usize,
    pub last: usize,
    pub(crate) kind: FoldKind,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum FoldKind {
    /// A record of a drawing, and its text when it is folded.
    Record(String),
    Contour,
    Comment,
}

/// The kind of a piece of text, as themes colour it.
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

/// The kind of a completion.
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
    /// Words of a program with places to fill in, as snippets of editors.
    Snippet,
}

/// Something that can be written at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Completion {
    pub(crate) label: String,
    pub(crate) about: Cow<'static, str>,
    pub(crate) text: String,
    /// The range that the text replaces.
    pub(crate) range: Range<usize>,
    pub(crate) kind: CompletionKind,
}

impl Completion {
    /// A completion whose label is its text.
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
    /// Each part of the form, as it stands in the label, and its meaning, in Markdown.
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

/// The hover at a byte, with what the segment there costs; `None` where there is nothing.
pub(crate) fn hover(document: &Document, offset: usize) -> Option<Hover> {
    let mut hover: Hover = ask!(document, hover(offset), unit_of(document))?;
    for price in prices(document, offset) {
        hover.text.push_str("\n\n");
        hover.text.push_str(&price);
    }
    Some(hover)
}

/// Segments of a drawing beyond which a hover says no prices: it would have to compare all walls.
const PRICED: usize = 5_000;

/// What the segments at a byte cost; nothing at the head of a polyline, which has them all.
fn prices(document: &Document, offset: usize) -> Vec<String> {
    let mut prices = Vec::new();
    let Some(snapshot) = document.snapshot() else {
        return prices;
    };
    let Snapshot {
        drawing,
        outlines,
        settings,
    } = &snapshot;
    let segments: usize = outlines.iter().map(|outline| outline.contour.len()).sum();
    let here = document.segments_at(offset..offset);
    if settings.job.wires.is_none() || segments > PRICED || here.len() > 2 {
        return prices;
    }
    for at in here {
        prices.extend(analysis::price_of_segment(drawing, outlines, settings, at));
    }
    prices.dedup();
    prices
}

/// Hints for a range of bytes, in the order of the text.
pub(crate) fn hints(document: &Document, range: Range<usize>) -> Vec<Hint> {
    ask!(document, hints(range), unit_of(document))
}

/// Ranges of bytes around a byte, each within the next.
pub(crate) fn selections(document: &Document, offset: usize) -> Vec<Range<usize>> {
    ask!(document, selections(offset))
}

/// What can stand at a byte, the most likely first.
pub(crate) fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    ask!(document, completions(offset))
}

/// The tokens of some lines.
pub(crate) fn tokens_in(document: &Document, lines: Range<usize>) -> Vec<Token> {
    ask!(document, tokens_in(lines))
}

/// The form of what is written at a byte; `None` where there is none.
pub(crate) fn signature(document: &Document, offset: usize) -> Option<Signature> {
    program::signature(document.program()?, offset)
}

/// Adds a range if it holds the last one and differs from it; the first if it holds the byte.
fn widen(found: &mut Vec<Range<usize>>, offset: usize, range: Range<usize>) {
    let grows = match found.last() {
        None => range.start <= offset && offset <= range.end,
        Some(last) => range.start <= last.start && last.end <= range.end && range != *last,
    };
    if grows {
        found.push(range);
    }
}
