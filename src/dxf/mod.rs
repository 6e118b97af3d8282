//! DXF text: read without loss, edited in place.

use crate::drawing::{Delta, Drawing, DrawingEdit, EntityId};
use crate::finding::{Finding, Place};
use crate::text::{SourceText, TextEdit};
use std::ops::Range;
use std::sync::Arc;

/// DXF text, the drawing that it holds, and where each number of it stands.
#[derive(Clone, Debug, Default)]
pub struct Document {
    text: SourceText,
    drawing: Arc<Drawing>,
    findings: Vec<Finding>,
}

impl Document {
    /// Reads DXF text. Never fails: what is damaged is in [`Document::findings`].
    pub fn read(_bytes: Vec<u8>) -> Document {
        Document::default()
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    pub fn drawing(&self) -> &Arc<Drawing> {
        &self.drawing
    }

    /// Faults of the text and what of it is not cut, in the order of the text.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Replaces a range of bytes and reads again what it touched.
    pub fn edit(&mut self, _range: Range<usize>, _replacement: &str) -> Delta {
        Delta::all()
    }

    /// The bytes that a place stands for: the number at fault (42 of the vertex, 40 of an ARC or CIRCLE), or the entity's name.
    pub fn range_of(&self, _place: &Place) -> Range<usize> {
        0..0
    }

    /// The segments whose tags overlap a range of bytes.
    pub fn segments_at(&self, _range: Range<usize>) -> Vec<(EntityId, usize)> {
        Vec::new()
    }

    /// The edit as replacements of numbers in the text, sorted and disjoint. An error says why it cannot be made.
    pub fn text_edits(&self, _edit: &DrawingEdit) -> Result<Vec<TextEdit>, String> {
        Ok(Vec::new())
    }
}
