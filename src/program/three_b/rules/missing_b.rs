//! `missing-b`: one of a block's three `B` is not there. The reader finds it; this is its repair.

use super::{Site, TextFix};
use crate::finding::FixKind;
use crate::text::TextEdit;
use std::ops::Range;

pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    let fields = &site.fields;
    let numbers = [&fields.x, &fields.y, &fields.j];
    let befores = [fields.first, fields.x.end, fields.y.end].into_iter();
    let has_b = |range: Range<usize>| {
        let text = site.text.get(range).unwrap_or_default();
        memchr::memchr2(b'B', b'b', text).is_some()
    };
    let mut starts = befores.zip(numbers.map(|digits| digits.start));
    let Some((_, at)) = starts.find(|(before, start)| !has_b(*before..*start)) else {
        return Vec::new();
    };
    let line = site.text.get(site.line.clone()).unwrap_or_default();
    let is_lower = line.contains(&b'b') && !line.contains(&b'B');
    let edit = TextEdit::new(at..at, if is_lower { "b" } else { "B" });
    vec![TextFix::text(FixKind::InsertB, true, edit)]
}
