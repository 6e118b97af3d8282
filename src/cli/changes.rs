//! The changes of a command to a file, shown as a diff.

use super::{Failure, output};
use crate::message::readable;
use crate::text::Writing;
use similar::udiff::UnifiedHunkHeader;
use similar::{Algorithm, ChangeTag, capture_diff_slices, group_diff_ops};
use std::path::Path;

/// A unified diff with three lines of context: for people with colours and made readable, else in
/// the file's own bytes.
pub(crate) fn print_diff(
    path: &Path,
    before: &[u8],
    after: &[u8],
    writing: Writing,
) -> Result<(), Failure> {
    let for_people = output::is_for_people();
    let diff = diff(path, before, after, for_people);
    if for_people {
        output::print(String::from_utf8_lossy(&diff))
    } else {
        output::print_bytes(&writing.written(&diff))
    }
}

fn diff(path: &Path, before: &[u8], after: &[u8], for_people: bool) -> Vec<u8> {
    let mut text = Vec::new();
    if before == after {
        return text;
    }
    let push_line = if for_people {
        push_readable_line
    } else {
        push_bytes
    };
    let lines = |bytes| <[u8]>::split_inclusive(bytes, |&byte| byte == b'\n').collect::<Vec<_>>();
    let (old, new) = (lines(before), lines(after));
    for sign in ["---", "+++"] {
        push_line(
            &mut text,
            output::STRONG,
            format!("{sign} {}", output::name(path)).as_bytes(),
        );
    }
    for ops in group_diff_ops(capture_diff_slices(Algorithm::Myers, &old, &new), 3) {
        push_line(
            &mut text,
            output::NOTE,
            UnifiedHunkHeader::new(&ops).to_string().as_bytes(),
        );
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

fn push_bytes(text: &mut Vec<u8>, _: anstyle::Style, line: &[u8]) {
    text.extend_from_slice(line);
    if !line.ends_with(b"\n") {
        text.push(b'\n');
    }
}

/// A line in a style; its line end comes after the end of the colours, which would otherwise reach
/// into the next line's margin.
fn push_readable_line(text: &mut Vec<u8>, style: anstyle::Style, line: &[u8]) {
    let end = line
        .iter()
        .rposition(|byte| !matches!(byte, b'\r' | b'\n'))
        .map_or(0, |last| last + 1);
    let shown = String::from_utf8_lossy(&line[..end]);
    text.extend_from_slice(format!("{}\n", output::styled(style, readable(&shown))).as_bytes());
}
