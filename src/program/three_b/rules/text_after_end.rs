//! `text-after-end`: text after the word that ends the program. The controller never reaches it.

use super::TextFix;
use crate::finding::FixKind;
use crate::text::{SourceText, TextEdit};
use std::ops::Range;

/// Removes all lines after the one in which the program ends; where it ends once more behind a block, `DD` may have been typed
/// for the `D` of a stop.
pub(in super::super) fn fixes(
    text: &SourceText,
    end: Range<usize>,
    ends_again: bool,
) -> Vec<TextFix> {
    let kept = text.line_range(text.line_of(end.start)).end;
    let edit = TextEdit::new(kept..text.len(), "");
    let delete = TextFix::text(FixKind::DeleteBehindEnd, false, edit);
    let word = text.slice(end.clone()).unwrap_or_default();
    let found = String::from_utf8_lossy(word).into_owned();
    match found.get(1..) {
        Some(meant) if ends_again && found.eq_ignore_ascii_case("DD") => {
            let meant = meant.to_owned();
            let edit = TextEdit::new(end, meant.clone());
            let stop = TextFix::text(FixKind::Rewrite { found, meant }, false, edit);
            vec![stop.preferred_if(false), delete.preferred_if(false)]
        }
        _ => vec![delete],
    }
}
