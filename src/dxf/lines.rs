//! The lines of DXF text for the lexer. Knows of line ends and the byte-order mark, not of tags.

use super::number::trimmed_range;
use crate::text::{LineStarts, SourceText};
use std::ops::Range;

pub(crate) const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Lines by number, without line ends, without a byte-order mark, without the empty line after the last line end.
#[derive(Clone, Copy)]
pub(crate) struct Lines<'a> {
    text: &'a SourceText,
    /// The text before its gap, if it has one; empty where the text is set aside.
    head: &'a [u8],
    starts: &'a LineStarts,
    count: usize,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(text: &'a SourceText) -> Lines<'a> {
        let (head, starts) = (text.at_hand(), text.line_starts());
        let empty_last = starts
            .len()
            .checked_sub(1)
            .and_then(|last| starts.get(last))
            .is_some_and(|last| last >= text.len());
        Lines {
            text,
            head,
            starts,
            count: starts.len() - usize::from(empty_last),
        }
    }

    pub(crate) fn slice(&self, range: Range<usize>) -> &'a [u8] {
        match self.head.get(range.clone()) {
            Some(bytes) => bytes,
            None => self.text.slice(range).unwrap_or_default(),
        }
    }

    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// True when the last line has no line end: it may be truncated.
    pub(crate) fn last_is_open(&self) -> bool {
        self.count == self.starts.len()
    }

    pub(crate) fn has_byte_order_mark(&self) -> bool {
        match self.head {
            [] => self.slice(0..BYTE_ORDER_MARK.len()) == BYTE_ORDER_MARK,
            head => head.starts_with(BYTE_ORDER_MARK),
        }
    }

    pub(crate) fn range(&self, line: usize) -> Range<usize> {
        let Some(mut start) = self.starts.get(line) else {
            return self.text.len()..self.text.len();
        };
        let mut end = match self.starts.get(line + 1) {
            Some(next) => {
                // A line with a successor ends with LF, CR or CR LF.
                let shortened = next.saturating_sub(1);
                let crlf = shortened > start && self.slice(shortened - 1..shortened + 1) == b"\r\n";
                shortened - usize::from(crlf)
            }
            None => self.text.len(),
        };
        if line == 0 && self.has_byte_order_mark() {
            start = BYTE_ORDER_MARK.len();
        }
        end = end.max(start);
        start..end
    }

    pub(crate) fn content(&self, line: usize) -> &'a [u8] {
        self.slice(self.range(line))
    }

    /// Where a line's content stands, without padding.
    pub(crate) fn trimmed_range(&self, line: usize) -> Range<usize> {
        let range = self.range(line);
        let inner = trimmed_range(self.slice(range.clone()));
        range.start + inner.start..range.start + inner.end
    }

    /// A line's content without padding.
    pub(crate) fn trimmed(&self, line: usize) -> &'a [u8] {
        self.slice(self.trimmed_range(line))
    }
}
