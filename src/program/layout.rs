//! Brings a program into a layout.

use crate::program::document::Document;
use crate::program::{iso, three_b};
use crate::settings::Effective;
use crate::text::TextEdit;
use std::ops::Range;

/// The edits that bring some lines of a program into the layout that is set, else into that of most of its lines.
///
/// They are sorted and disjoint, and change nothing that the machine does: each line is read back before it is taken.
pub fn format(document: &Document, settings: &Effective, lines: Range<usize>) -> Vec<TextEdit> {
    let layout = settings.stated_layout;
    match document {
        _ if document.is_no_text().is_some() => Vec::new(),
        Document::ThreeB(program) => {
            three_b::format::format(program.text(), layout, &program.words(), lines)
        }
        Document::Iso(program) => iso::format(program.text(), layout, lines),
    }
}
