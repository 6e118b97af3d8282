//! `missing-end`: nothing ends the program.

use super::TextFix;
use crate::finding::FixKind;
use crate::text::{SourceText, TextEdit};

/// The end word on a line of its own, after the line that ends at `behind`.
pub(in super::super) fn fixes(text: &SourceText, behind: usize, word: &str) -> Vec<TextFix> {
    let line_end = text.line_end(0);
    let line = text.line_of(behind);
    let range = text.line_range(line);
    let edit = TextEdit::new(range.end..range.end, format!("{line_end}{word}"));
    let word = word.into();
    vec![TextFix::text(FixKind::AddEnd { word }, true, edit)]
}
