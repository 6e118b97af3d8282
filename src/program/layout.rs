//! Brings a program into a layout.

use crate::program::document::Document;
use crate::program::{iso, three_b};
use crate::settings::Effective;
use crate::text::TextEdit;
use std::ops::Range;

/// The edits that bring some lines of a program into the layout that is set, else into that of most of its lines.
///
/// They are sorted and disjoint, and change nothing that the machine does, nor what is found in the program: each line
/// is read back before it is taken, and end points that would hide a fault or bring one about are neither written nor
/// left out.
pub fn format(document: &Document, settings: &Effective, lines: Range<usize>) -> Vec<TextEdit> {
    format_saying(document, settings, lines).0
}

/// The same, and a sentence where end points and block numbers stay as they stand.
pub(crate) fn format_saying(
    document: &Document,
    settings: &Effective,
    lines: Range<usize>,
) -> (Vec<TextEdit>, Option<String>) {
    if document.is_no_text().is_some() {
        return (Vec::new(), None);
    }
    let layout = settings.stated_layout;
    match document {
        Document::ThreeB(program) => {
            let formatted = three_b::format::guarded(program, settings, layout, lines);
            let sentence = formatted.kept.map(|kept| {
                say!(
                    end_points_are_left_as_they_are,
                    kept.rule.name(),
                    kept.line + 1
                )
            });
            (formatted.edits, sentence)
        }
        Document::Iso(program) => (iso::format(program.text(), layout, lines), None),
    }
}
