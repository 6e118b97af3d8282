//! `text-after-end`: text after the word that ends the program. The controller never reaches it.

use super::TextFix;
use crate::finding::FixKind;
use crate::text::{SourceText, TextEdit};

/// Removes all lines after the one in which the program ends.
pub(in super::super) fn fixes(text: &SourceText, end: usize) -> Vec<TextFix> {
    let kept = text.line_range(text.line_of(end)).end;
    let edit = TextEdit::new(kept..text.len(), "");
    vec![TextFix::text(FixKind::DeleteBehindEnd, false, edit)]
}
