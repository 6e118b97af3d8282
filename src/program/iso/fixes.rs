//! Repairs of a program as edits of its text. Where it is not clear what was meant, none is offered.

use super::block::{read_line, word_range};
use super::document::Document;
use crate::finding::{Detail, Finding, Fix, FixKind, IsoFault, Place};
use crate::text::TextEdit;
use std::ops::Range;

/// The fixes of one finding, the preferred one first.
pub(super) fn fixes(document: &Document, finding: &Finding) -> Vec<Fix<Vec<TextEdit>>> {
    let (Detail::Iso(fault), Place::Text { range }) = (&finding.detail, &finding.place) else { return Vec::new() };
    let fix = |kind: FixKind, in_fix_all: bool, edits: Vec<TextEdit>| Fix { kind, preferred: true, in_fix_all, edit: edits };
    match fault {
        IsoFault::NoEnd { word } => {
            let end = document.text().line_range(document.text().line_of(range.end)).end;
            let text = format!("{}{word}", line_end(document, range.end));
            vec![fix(FixKind::AddEnd { word: word.clone() }, true, vec![TextEdit { range: end..end, text }])]
        }
        IsoFault::Switch { on: true, arc: false } => {
            // The rapid that the correction would go on with is cut instead.
            let Some(word) = rapid_word(document, range) else { return Vec::new() };
            vec![fix(FixKind::CutRapid, false, vec![TextEdit { range: word, text: "G01".into() }])]
        }
        IsoFault::RoleSide { .. } | IsoFault::EntrySide { .. } => {
            let bytes = document.text().bytes().get(range.clone()).unwrap_or_default();
            let other = match read_line(bytes, 0, |_| {}).compensation {
                Some(super::block::Compensation::Left) => "G42",
                Some(super::block::Compensation::Right) => "G41",
                _ => return Vec::new(),
            };
            vec![fix(FixKind::SwapSide, false, vec![TextEdit { range: range.clone(), text: other.into() }])]
        }
        IsoFault::BehindEnd => {
            let end = document.text().len();
            vec![fix(FixKind::DeleteBehindEnd, false, vec![TextEdit { range: range.start..end, text: String::new() }])]
        }
        _ => Vec::new(),
    }
}

/// The G00 of a line.
fn rapid_word(document: &Document, range: &Range<usize>) -> Option<Range<usize>> {
    let line = document.text().line_range(document.text().line_of(range.start));
    let bytes = document.text().bytes().get(line.clone())?;
    word_range(bytes, line.start, |letter, number| letter == b'G' && number.whole() == Some(0))
}

/// The line end that the text uses before a place.
fn line_end(document: &Document, place: usize) -> &'static str {
    let before = document.text().bytes().get(..place).unwrap_or_default();
    match memchr::memrchr(b'\n', before) {
        Some(at) if at > 0 && before[at - 1] == b'\r' => "\r\n",
        _ => "\n",
    }
}
