//! `block-number-as-b`: `B25` before a block where the number `N25` was meant. The reader finds it; this is its repair.

use super::{Site, TextFix};
use crate::finding::FixKind;
use crate::text::TextEdit;

pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    let Some(&b) = site.text.get(site.range.start) else {
        return Vec::new();
    };
    let n = if b == b'b' { "n" } else { "N" };
    let edit = TextEdit::new(site.range.start..site.range.start + 1, n);
    vec![TextFix::text(FixKind::NumberWithN, true, edit)]
}
