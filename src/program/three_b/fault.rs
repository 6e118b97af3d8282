//! The faults of a line of 3B or 4B as text, and their sentences.

use std::ops::Range;

/// A fault of a line as text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Flaw {
    /// It cannot be read: the sentence says what was found and what was expected.
    Unreadable(String),
    /// `B` is missing before the number that begins at this byte.
    MissingB { at: usize },
    /// `B` stands where the `N` of a block number was meant.
    BlockNumberAsB { number: u32 },
    /// The letter O stands for a zero.
    LetterO,
    /// Letters or digits that only look like those of a block: the sentence names them.
    NotPlain(String),
    /// Coordinates with commas for decimal points: they are not read.
    DecimalCommas,
    /// The header names a start at no place of a machine: it is not read.
    FarStart,
}

/// A place that cannot be read as it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SyntaxFault {
    pub(crate) range: Range<usize>,
    pub(crate) flaw: Flaw,
    /// The number before an unreadable block.
    pub(crate) number: Option<u32>,
}

impl SyntaxFault {
    pub(crate) fn new(range: Range<usize>, flaw: Flaw) -> SyntaxFault {
        SyntaxFault {
            range,
            flaw,
            number: None,
        }
    }

    /// Moves it to a text with this many more bytes before it.
    pub(super) fn shift(&mut self, by: usize) {
        self.range = self.range.start + by..self.range.end + by;
        if let Flaw::MissingB { at } = &mut self.flaw {
            *at += by;
        }
    }

    /// The finding and the expectation.
    pub(crate) fn sentence(&self) -> String {
        match &self.flaw {
            Flaw::Unreadable(sentence) | Flaw::NotPlain(sentence) => sentence.clone(),
            Flaw::DecimalCommas => say!(the_coordinates_have_decimal_commas).into(),
            Flaw::FarStart => say!(the_start_point_is_beyond_any_machine).into(),
            Flaw::MissingB { .. } => say!(a_b_of_the_block_is_missing).into(),
            Flaw::BlockNumberAsB { number } => {
                say!(b_stands_where_n_was_meant, number)
            }
            Flaw::LetterO => say!(the_letter_o_stands_where_a_zero_was_meant).into(),
        }
    }
}
