//! The text of blocks: compact, aligned, checking.

use super::block::{Block, Node, PartArc};
use crate::program::write::{push_number, push_places};
use crate::settings::Layout;
use crate::text::{TextEdit, WIDEST_COLUMN};
use std::fmt;
use std::ops::Range;

/// Appends one block with its line end; with `part` it is one of 4B. `number` (from 1) and the absolute end point are
/// only in the checking layout.
pub(crate) fn push_block(
    out: &mut Vec<u8>,
    layout: Layout,
    number: usize,
    block: &Block,
    part: Option<&PartArc>,
    end: Node,
) {
    if layout == Layout::Checking {
        push_block_number(out, number as u64);
    }
    push_fields(out, layout, block, part);
    if layout == Layout::Checking {
        push_to_comment_column(out, block);
        push_end_point(out, end);
    }
    out.push(b'\n');
}

/// The layout in which a block is written.
pub(super) fn layout_in(block: &[u8]) -> Layout {
    match block.contains(&b' ') {
        true => Layout::Aligned,
        false => Layout::Compact,
    }
}

/// Appends `N   12: `.
pub(crate) fn push_block_number(out: &mut Vec<u8>, number: u64) {
    out.push(b'N');
    push_number(out, number, 5);
    out.extend_from_slice(b": ");
}

impl fmt::Display for Block {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = Vec::new();
        push_fields(&mut text, Layout::Compact, self, None);
        formatter.write_str(&String::from_utf8_lossy(&text))
    }
}

/// Appends the block itself, from its first `B` to the quadrant; with `part` it is one of 4B.
pub(crate) fn push_fields(
    out: &mut Vec<u8>,
    layout: Layout,
    block: &Block,
    part: Option<&PartArc>,
) {
    let width = if layout == Layout::Compact { 0 } else { 6 };
    let between: &[u8] = if layout == Layout::Compact { b"" } else { b" " };
    for value in [block.x, block.y, block.j]
        .into_iter()
        .chain(part.map(|part| part.radius))
    {
        out.push(b'B');
        out.extend_from_slice(between);
        push_number(out, value.unsigned_abs(), width);
        out.extend_from_slice(between);
    }
    out.extend([b'G', block.axis.letter() as u8]);
    out.extend_from_slice(between);
    if let Some(part) = part {
        out.extend_from_slice(if part.concave { b"DD" } else { b"D" });
        out.extend_from_slice(between);
    }
    out.extend_from_slice(block.motion.name().as_bytes());
}

/// Appends the spaces after an aligned block, so that the text after lines and arcs is in the same column.
pub(crate) fn push_to_comment_column(out: &mut Vec<u8>, block: &Block) {
    out.extend_from_slice(if block.motion.is_line() { b"  " } else { b" " });
}

/// Appends `; x , y`, the absolute end point in mm.
pub(crate) fn push_end_point(out: &mut Vec<u8>, end: Node) {
    out.extend_from_slice(b"; ");
    push_millimetres(out, end.x, 10);
    out.extend_from_slice(b" , ");
    push_millimetres(out, end.y, 10);
}

/// Appends the header that carries the absolute start of a program, which blocks cannot.
pub(crate) fn push_start_point(out: &mut Vec<u8>, start: Node) {
    out.extend_from_slice(b"; Start Point = ");
    push_millimetres(out, start.x, 0);
    out.extend_from_slice(b" , ");
    push_millimetres(out, start.y, 0);
    out.push(b'\n');
}

/// µm as mm with three decimals, right-aligned in `width` columns.
fn push_millimetres(out: &mut Vec<u8>, micrometres: i64, width: usize) {
    let mut text = Vec::with_capacity(24);
    if micrometres < 0 {
        text.push(b'-');
    }
    let magnitude = micrometres.unsigned_abs();
    push_number(&mut text, magnitude / 1000, 0);
    text.push(b'.');
    push_places(&mut text, magnitude % 1000, 3);
    out.extend(std::iter::repeat_n(b' ', width.saturating_sub(text.len())));
    out.extend_from_slice(&text);
}

/// The edit that replaces the digits of a block's number. A number with leading zeros keeps its width; one in a column
/// keeps its column, as far as spaces give room.
pub(super) fn number_edit(text: &[u8], digits: Range<usize>, number: u32) -> TextEdit {
    let width = digits.len().min(WIDEST_COLUMN);
    if text.get(digits.start) == Some(&b'0') {
        return TextEdit::new(digits, format!("{number:0width$}"));
    }
    let before = text.get(..digits.start).unwrap_or_default().iter().rev();
    let room = before.take_while(|byte| **byte == b' ').count();
    let longer = number.to_string().len().saturating_sub(digits.len());
    let taken = longer.min(room.saturating_sub(1));
    let width = if room > 1 { width + taken } else { 0 };
    TextEdit::new(
        digits.start - taken..digits.end,
        format!("{number:>width$}"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::edited;

    #[test]
    fn a_number_keeps_its_column_and_its_zeros() {
        for (text, number, expected) in [
            ("N9 B1", 10, "N10 B1"),
            ("N10 B1", 9, "N9 B1"),
            ("N   9: B1", 10, "N  10: B1"),
            ("N  10: B1", 9, "N   9: B1"),
            ("N 9: B1", 1000, "N 1000: B1"),
            ("N  9: B1", 1000, "N 1000: B1"),
            ("N009 B1", 10, "N010 B1"),
            ("N0 B1", 10, "N10 B1"),
        ] {
            let first = text.find(|c: char| c.is_ascii_digit()).unwrap();
            let digits = text[first..].bytes().take_while(u8::is_ascii_digit).count();
            let edit = number_edit(text.as_bytes(), first..first + digits, number);
            let found = edited(text.as_bytes(), &[edit]).unwrap();
            assert_eq!(
                String::from_utf8(found).unwrap(),
                expected,
                "{text} {number}"
            );
        }
    }
}
