//! The pieces of a line in every language, mapped to one list of kinds.

use std::ops::Range;

/// The kind of a piece of a line, in any language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WordKind {
    /// `N12`.
    Number,
    /// The letter before a number: `B` of 3B.
    Lead,
    /// A length or coordinate: X, Y, J of 3B; `X1.5` of ISO.
    Length,
    /// The counting axis of 3B; values for the control's table and words of settings in ISO.
    Setting,
    /// The kind of motion: Z of 3B, G words of ISO.
    Motion,
    /// Pauses, ends and the like.
    Stop,
    /// Coordinates that only state the end of a block or the start of a program.
    Stated,
    Comment,
    Strange,
}

/// A piece of a line; bytes of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct LinePart {
    pub(crate) kind: WordKind,
    pub(crate) range: Range<usize>,
}
