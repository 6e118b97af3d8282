//! What a command changes in a file: edits made in its bytes, and shown as a diff.

use super::output;
use crate::text::TextEdit;
use similar::udiff::UnifiedHunkHeader;
use similar::{Algorithm, ChangeTag, capture_diff_slices, group_diff_ops};
use std::path::Path;

/// The bytes with `edits` made, which are sorted and disjoint; `None` when they are not, or reach past the end.
pub fn edited(bytes: &[u8], edits: &[TextEdit]) -> Option<Vec<u8>> {
    let mut result = Vec::with_capacity(bytes.len());
    let mut at = 0;
    for edit in edits {
        result.extend_from_slice(bytes.get(at..edit.range.start)?);
        result.extend_from_slice(edit.text.as_bytes());
        at = edit.range.end;
    }
    result.extend_from_slice(bytes.get(at..)?);
    Some(result)
}

/// A unified diff with three lines of context, in the file's own bytes.
pub fn diff(path: &Path, before: &[u8], after: &[u8]) -> Vec<u8> {
    let mut text = Vec::new();
    if before == after {
        return text;
    }
    let lines = |bytes| <[u8]>::split_inclusive(bytes, |&byte| byte == b'\n').collect::<Vec<_>>();
    let (old, new) = (lines(before), lines(after));
    for sign in ["---", "+++"] {
        push_line(&mut text, output::STRONG, format!("{sign} {}", path.display()).as_bytes());
    }
    for ops in group_diff_ops(capture_diff_slices(Algorithm::Myers, &old, &new), 3) {
        push_line(&mut text, output::NOTE, UnifiedHunkHeader::new(&ops).to_string().as_bytes());
        for change in ops.iter().flat_map(|op| op.iter_changes(&old, &new)) {
            let (sign, style) = match change.tag() {
                ChangeTag::Delete => (b'-', output::ERROR),
                ChangeTag::Insert => (b'+', output::GOOD),
                ChangeTag::Equal => (b' ', anstyle::Style::new()),
            };
            push_line(&mut text, style, &[&[sign], change.value()].concat());
            if !change.value().ends_with(b"\n") {
                text.extend_from_slice(b"\\ No newline at end of file\n");
            }
        }
    }
    text
}

/// A line in a style; its line end stands behind the colours, which would reach into the next line's margin.
fn push_line(text: &mut Vec<u8>, style: anstyle::Style, line: &[u8]) {
    let end = line.iter().rposition(|byte| !matches!(byte, b'\r' | b'\n')).map_or(0, |last| last + 1);
    let (shown, line_end) = line.split_at(end);
    text.extend_from_slice(style.render().to_string().as_bytes());
    text.extend_from_slice(shown);
    text.extend_from_slice(style.render_reset().to_string().as_bytes());
    text.extend_from_slice(if line_end.is_empty() { b"\n" } else { line_end });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn replacement(range: std::ops::Range<usize>, text: &str) -> TextEdit {
        TextEdit { range, text: text.into() }
    }

    #[test]
    fn edits_change_their_bytes_and_no_others() {
        let edits = [replacement(1..2, "xyz"), replacement(3..3, "-"), replacement(4..5, "")];
        assert_eq!(edited(b"ab\xffde", &edits).as_deref(), Some(&b"axyz\xff-d"[..]));
    }

    #[test]
    fn edits_that_cannot_be_made_are_refused() {
        for edits in [vec![replacement(0..9, "")], vec![replacement(2..3, ""), replacement(1..2, "")]] {
            assert_eq!(edited(b"abc", &edits), None);
        }
    }
}
