//! The pieces of a line in every language, mapped to one list of kinds.

use super::line_part::LinePart;
use super::{iso, three_b};
use crate::program::Document;

/// The pieces of a line, one after the other; damaged lines are cut as far as possible.
pub(crate) fn words_of(document: &Document, line: usize) -> Vec<LinePart> {
    let text = document.text();
    let range = text.line_range(line);
    let bytes = text.bytes().get(range.clone()).unwrap_or_default();
    match document {
        Document::ThreeB(program) => three_b::line_parts(program, bytes, range.start),
        Document::Iso(program) => iso::line_parts(program, bytes, range.start),
    }
}
