//! How much work may go into one document.

/// The work that one document may take where it grows with more than the document's length, in counted steps: what is
/// left out depends only on the document, not on the machine or on earlier edits. Not a user setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// The comparisons that the segments of a drawing may take, and in addition for each segment: one for a pair of
    /// segments, one for four boxes that are looked through. Comparing thousands of long lines with
    /// overlapping boxes would never end.
    pub looks: u64,
    pub looks_of_a_segment: u64,
    /// The search stops at this many: a drawing where this much lies on or across each other is not
    /// ready to cut, and comparing thousands of copies in one place would never end.
    pub most_seen: usize,
}

impl Budget {
    /// The looks at a drawing of this many segments.
    pub(crate) fn granted(&self, segments: usize) -> u64 {
        let of_segments = self.looks_of_a_segment.saturating_mul(segments as u64);
        self.looks.saturating_add(of_segments)
    }
}

impl Default for Budget {
    fn default() -> Self {
        Budget {
            looks: 20_000_000,
            looks_of_a_segment: 128,
            most_seen: 20_000,
        }
    }
}
