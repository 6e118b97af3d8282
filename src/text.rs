//! Text with its lines: bytes, where each line begins, and positions as editors count them.

use std::ops::Range;

/// How a client counts characters within a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    Utf8,
    #[default]
    Utf16,
}

/// A replacement of a range of bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextEdit {
    pub range: Range<usize>,
    pub text: String,
}

/// The bytes of a document and the starts of its lines, which end with LF, CR LF or CR.
#[derive(Clone, Debug, Default)]
pub struct SourceText {
    bytes: Vec<u8>,
    line_starts: Vec<u32>,
}
