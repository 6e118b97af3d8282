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
use words::LinePart;

/// What can stand at a byte, the most likely first.
pub(crate) fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    match document {
        Document::ThreeB(program) => three_b::completions(program, offset),
        Document::Iso(program) => iso::completions(program, offset),
    }
}

/// Every place of the name at a byte, in the order of the text, at most `limit`: lines that are called, rows of tables.
pub(crate) fn named(
    document: &Document,
    offset: usize,
    limit: usize,
    stop: Stop<'_>,
) -> Result<Vec<Occurrence>, Stopped> {
    match document {
        Document::ThreeB(_) => Ok(Vec::new()),
        Document::Iso(program) => iso::named(program, offset, limit, stop),
    }
}

/// The form of the block that is written at a byte; `None` where there is none.
pub(crate) fn signature(document: &Document, offset: usize) -> Option<Signature> {
    match document {
        Document::ThreeB(program) => three_b::signature(program, offset),
        Document::Iso(program) => iso::signature(program, offset),
    }
}

/// The pieces of a line, one after the other; damaged lines are cut as far as possible.
fn words_of(document: &Document, line: usize) -> Vec<LinePart> {
    let text = document.text();
    let range = text.line_range(line);
    let bytes = text.bytes().get(range.clone()).unwrap_or_default();
    match document {
        Document::ThreeB(program) => three_b::line_parts(program, bytes, range.start),
        Document::Iso(program) => iso::line_parts(program, bytes, range.start),
    }
}
