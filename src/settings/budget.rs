//! How much may be done for one document.

/// The work that one document may take where it grows with more than the document's length, in counted steps: what is left out hangs
/// on the document alone, not on the machine and not on the edits that led to it. Nothing that a user sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Looks that comparing the segments of a drawing may take, and beside that for each segment: a segment held against another is one,
    /// as are four boxes of the grid. Thousands of circles about one point come near each other everywhere without being seen, and would
    /// be compared for ever.
    pub looks: u64,
    pub looks_of_a_segment: u64,
    /// More than this is not sought: a drawing in which so much lies on or across each other is no drawing to cut yet, and
    /// thousands of copies in one place would be compared for ever.
    pub most_seen: usize,
}

impl Default for Budget {
    fn default() -> Self {
        Budget {
            looks: 20_000_000,
            looks_of_a_segment: 64,
            most_seen: 20_000,
        }
    }
}
