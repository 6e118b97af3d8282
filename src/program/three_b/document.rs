//! 3B text as an open document: its lines and what is wrong in them.

use crate::finding::Finding;
use crate::text::SourceText;
use std::ops::Range;

/// A 3B program as text, and the faults found in it.
#[derive(Clone, Debug, Default)]
pub struct Document {
    text: SourceText,
    findings: Vec<Finding>,
}

impl Document {
    /// Reads program text. Never fails: what is damaged is in [`Document::findings`].
    pub fn read(_bytes: Vec<u8>) -> Document {
        Document::default()
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Replaces a range of bytes and reads again what it touched.
    pub fn edit(&mut self, _range: Range<usize>, _replacement: &str) {}
}
