//! An edit of the text: what it touched is read again.

use super::Document;
use crate::drawing::Delta;
use std::ops::Range;

impl Document {
    /// Replaces a range of bytes and reads again what it touched.
    pub fn edit(&mut self, range: Range<usize>, replacement: &str) -> Delta {
        self.text.replace(range, replacement);
        self.read_all();
        Delta::all()
    }
}
