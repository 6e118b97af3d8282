//! The header that carries the start of a program.

use crate::program::grid::Node;
use crate::program::three_b::layout::push_start_point;
use crate::text::{SourceText, TextEdit};
use std::ops::Range;

/// The line `; Start Point = x , y`, with its line end.
pub(super) fn header(start: Node) -> String {
    let mut line = Vec::new();
    push_start_point(&mut line, start);
    String::from_utf8_lossy(&line).into_owned()
}

/// The edit of a header: any text before it in its line stays.
pub(super) fn new_header(text: &SourceText, old: &Range<usize>, start: Node) -> TextEdit {
    let header = header(start);
    let header = header.trim_end();
    let had_mark = text.bytes().get(old.start) == Some(&b';');
    let new = match had_mark {
        true => header,
        false => header.trim_start_matches("; "),
    };
    TextEdit::new(old.clone(), new)
}
