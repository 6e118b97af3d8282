//! The lines of a text that show a fault in its context, as a terminal can show them.

use crate::message::is_hidden;
use crate::text::SourceText;
use std::ops::Range;

/// The lines that show the fault in its context.
#[derive(Clone, Debug)]
pub(super) struct Excerpt {
    pub(super) first_line: usize,
    pub(super) text: String,
    /// Bytes of `text` at fault.
    pub(super) span: Range<usize>,
}

/// Longer lines (100 MB of zeros make one) are shown from near the fault on.
const LONGEST_LINE: usize = 100;

/// Line and column from 1; the column counts characters, and an invalid byte as one.
pub(super) fn place(text: &SourceText, offset: usize) -> (usize, usize) {
    let line = text.line_of(offset);
    let start = text.line_range(line).start;
    let before = text.slice(start..offset.max(start)).unwrap_or_default();
    (
        line + 1,
        String::from_utf8_lossy(before).chars().count() + 1,
    )
}

/// The lines from the one above the fault (in DXF the group code of the number) to its end, at most six.
pub(super) fn excerpt(text: &SourceText, range: &Range<usize>) -> Option<Excerpt> {
    let stands_for_all = range.end == 0;
    if stands_for_all || range.start > range.end || range.end > text.len() {
        return None;
    }
    let fault_line = text.line_of(range.start);
    let last_line = text
        .line_of(range.start.max(range.end - 1))
        .min(fault_line + 4);
    let has_code = fault_line > 0 && is_group_code(text.line(fault_line - 1));
    let first_line = if has_code { fault_line - 1 } else { fault_line };
    let bytes = |range| text.slice(range).unwrap_or_default();
    let mut shown = String::new();
    let mut span = 0..0;
    for line in first_line..=last_line {
        let whole = text.line_range(line);
        let from = if line == fault_line {
            whole
                .start
                .max(range.start.saturating_sub(LONGEST_LINE / 2))
        } else {
            whole.start
        };
        let to = whole.end.min(from + LONGEST_LINE);
        let fault = range.start.clamp(from, to)..range.end.clamp(from, to);
        if line > first_line {
            shown.push('\n');
        }
        push_readable(&mut shown, bytes(from..fault.start));
        if line == fault_line {
            span.start = shown.len();
        }
        push_readable(&mut shown, bytes(fault.clone()));
        if !fault.is_empty() {
            span.end = shown.len();
        }
        push_readable(&mut shown, bytes(fault.end..to));
    }
    span.end = span.end.max(span.start);
    Some(Excerpt {
        first_line: first_line + 1,
        text: shown,
        span,
    })
}

fn is_group_code(line: &[u8]) -> bool {
    let trimmed = line.trim_ascii();
    !trimmed.is_empty()
        && trimmed.len() <= 5
        && trimmed
            .iter()
            .all(|byte| byte.is_ascii_digit() || *byte == b'-')
}

/// Bytes as text that a terminal can show: invalid UTF-8 and control characters become U+FFFD.
fn push_readable(shown: &mut String, bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    shown.extend(text.chars().map(|character| {
        if is_hidden(character) && character != '\t' {
            '\u{fffd}'
        } else {
            character
        }
    }));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &[u8], range: Range<usize>) -> Option<(usize, String, String)> {
        let excerpt = excerpt(&SourceText::new(text.to_vec()), &range)?;
        let fault = excerpt.text[excerpt.span].to_string();
        Some((excerpt.first_line, excerpt.text, fault))
    }

    #[test]
    fn an_excerpt_holds_the_group_code_and_the_value() {
        let text = b"  0\r\nLWPOLYLINE\r\n 42\r\n0.414\r\n 10\r\n";
        assert_eq!(
            shown(text, 22..27),
            Some((3, " 42\n0.414".into(), "0.414".into()))
        );
        assert_eq!(
            shown(b"B1B2B3GXL1\nB\n", 2..4),
            Some((1, "B1B2B3GXL1".into(), "B2".into()))
        );
    }

    #[test]
    fn an_excerpt_of_anything_can_be_shown() {
        assert_eq!(shown(b"", 0..0), None);
        assert_eq!(shown(b"a = \nb", 4..4), Some((1, "a = ".into(), "".into())));
        assert_eq!(shown(b"abc", 1..9), None);
        assert_eq!(
            shown(b" 1\n\xff\x1b[31m\xfe", 4..5),
            Some((
                1,
                " 1\n\u{fffd}\u{fffd}[31m\u{fffd}".into(),
                "\u{fffd}".into()
            ))
        );
        let (_, text, fault) = shown(&vec![0; 5000], 1000..4000).unwrap();
        assert!(text.chars().count() <= LONGEST_LINE && !fault.is_empty());
    }

    #[test]
    fn places_count_characters_from_one() {
        let text = SourceText::new("a\näöü 1\n".as_bytes().to_vec());
        assert_eq!(place(&text, 0), (1, 1));
        assert_eq!(place(&text, 9), (2, 5));
    }
}
