//! A document between its edits: what the first one needs, and what they have changed.

use super::{Document, Since};

impl Document {
    /// Makes ready what the first edit of a drawing needs.
    pub(crate) fn make_ready(&mut self) {
        self.analysis.make_ready();
    }

    /// What has changed in a drawing since the last call; at the first call everything.
    pub(crate) fn take_changes(&mut self) -> Since {
        self.since.take()
    }
}
