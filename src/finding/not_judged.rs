//! What was left out since it would have taken too much, as numbers; the sentence is made in [`crate::message`].

/// Work on one document is bounded in counted steps, so that what is left out hangs on the document alone.
#[derive(Clone, Debug, PartialEq)]
pub enum NotJudged {
    /// So much lies on or across each other that `count` stretches of contours were not compared with what is near them.
    Pairs { count: usize },
    /// So much of a contour of so many blocks lies on one place that crossings were not looked for in all of it.
    Crossings { blocks: usize },
    /// A reference to a block would draw so many copies and segments: `most` is what all references of a file may come to.
    Reference {
        copies: u64,
        segments: u64,
        most: u64,
    },
    /// A curve takes so many arcs, and all curves of a drawing together may take so many beyond what each has free.
    Curve { arcs: usize, most: u64 },
    /// The calls of subprograms come to more than `lines` lines, or more than `calls` calls.
    Calls { lines: usize, calls: usize },
}
