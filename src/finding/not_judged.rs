//! What was left out because it would have taken too much, as numbers; [`crate::message`] has the sentence.

/// Work on one document is bounded in counted steps, so that the same document always leaves out the same.
#[derive(Clone, Debug, PartialEq)]
pub enum NotJudged {
    /// Too much lies on or across each other: `count` stretches of contours were not compared with their neighbours.
    Pairs { count: usize },
    /// Too much of a contour of this many blocks lies in one place: not all crossings were looked for.
    Crossings { blocks: usize },
    /// A reference to a block would draw this many copies and segments: `most` is the limit for all references of a
    /// file.
    Reference {
        copies: u64,
        segments: u64,
        most: u64,
    },
    /// A curve takes this many arcs; all curves of a drawing together may take `most` beyond what each has free.
    Curve { arcs: usize, most: u64 },
    /// The calls of subprograms come to more than `lines` lines, or more than `calls` calls.
    Calls { lines: usize, calls: usize },
}
