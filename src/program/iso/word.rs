//! The words of a line: a letter and its number, each with its place; comments, marks and unreadable text.
//!
//! Nothing here knows the meaning of a word, and lines are independent of each other.

#![warn(clippy::indexing_slicing)]

use crate::finding::{Detail, Finding, Rule, Severity};
use crate::text::shown;
use std::ops::Range;

/// A number as it is written: `mantissa · 10^−decimals`. Its decimal point distinguishes millimetres from micrometres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Number {
    pub(crate) mantissa: i64,
    pub(crate) decimals: u8,
    pub(crate) point: bool,
}

impl Number {
    /// The number if it is whole, such as that of G01 or N10.
    pub(crate) fn whole(self) -> Option<i64> {
        let factor = 10_i64.checked_pow(u32::from(self.decimals))?;
        (self.mantissa % factor == 0).then_some(self.mantissa / factor)
    }

    /// A number that counts: whole, and not below 0.
    pub(crate) fn index(self) -> Option<u32> {
        u32::try_from(self.whole()?).ok()
    }
}

/// One item of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Token {
    /// `G01`, `X-1.5`: the letter in upper case.
    Word { letter: u8, number: Number },
    /// `H001=110`, a value for the control's table, perhaps a list.
    Definition {
        letter: u8,
        index: Number,
        value: Option<Number>,
    },
    /// `H001=.0085+H175`: a value for the control's table, the sum of numbers and other places of it.
    Sum {
        letter: u8,
        index: Number,
        terms: Vec<Term>,
    },
    /// `,R2.` or `,C1.`: the corner at the end of the move is rounded, or chamfered.
    Corner { round: bool, number: Number },
    /// `STOP`, `#1=4`, or a word beside the wire's way with a variable or an expression instead of its number: it
    /// depends on the machine.
    Foreign,
    /// `( … )`, or `;` to the end of the line.
    Comment,
    /// `%`: where a program begins and ends on tape.
    Tape,
    /// `/`: a block that the operator may skip.
    Skip,
    /// Not readable; the rest of the line is read all the same.
    Fault(WordFault),
}

/// A term of a sum, with its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Term {
    pub(crate) is_negative: bool,
    pub(crate) value: Value,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Value {
    Number(Number),
    /// The value of another place of the control's table.
    Place {
        letter: u8,
        index: u32,
    },
}

/// A fault at a place of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordFault {
    /// A letter without its number.
    NoNumber {
        letter: u8,
    },
    /// `X#101`, `Y[1+2]`, `X=AC(5)`: the way is known to the control alone.
    Expression {
        letter: u8,
    },
    /// `X1.2.3`.
    NotANumber {
        letter: u8,
    },
    /// `X1O.5`: read as the zero that is meant.
    LetterO,
    /// `X1,5`: read as the point that is meant.
    DecimalComma,
    /// Full-width characters, or letters and spaces of other scripts: read as what they look like.
    Lookalike,
    TooManyDigits {
        digits: u32,
    },
    /// `(` without `)`.
    OpenComment,
    /// `G90; G92 X5. Y5.`: to other controls the semicolon ends a block.
    CommentedBlock,
    /// A character that begins no word.
    NoWord,
}

impl WordFault {
    /// The finding for it: it stands at `start` of its line, and at `range` of the text.
    pub(crate) fn finding(self, line: &[u8], start: usize, range: Range<usize>) -> Finding {
        let column = start + 1;
        let bytes = line.get(start..start + range.len()).unwrap_or_default();
        let shown = shown(bytes);
        let sentence = match self {
            WordFault::NoNumber { letter } => say!(word_without_number, column, letter as char),
            WordFault::Expression { letter } => {
                say!(
                    expression_for_a_number,
                    column,
                    letter as char,
                    shown.get(1..).unwrap_or_default()
                )
            }
            WordFault::NotANumber { letter } => say!(
                word_is_no_number,
                column,
                letter as char,
                shown.get(1..).unwrap_or_default()
            ),
            WordFault::TooManyDigits { digits } => say!(number_of_too_many_digits, column, digits),
            WordFault::OpenComment => say!(comment_is_not_closed, column),
            WordFault::CommentedBlock => say!(semicolon_hides_a_block, column),
            WordFault::LetterO => say!(letter_o_in_a_number, column),
            WordFault::DecimalComma => say!(comma_in_a_number, column),
            WordFault::Lookalike => say!(only_looks_like_ascii, column, shown),
            WordFault::NoWord => say!(no_word, column, shown),
        };
        let severity = match self {
            WordFault::OpenComment | WordFault::CommentedBlock => Severity::Warning,
            _ => Rule::Syntax.default_severity(),
        };
        let rule = match self {
            WordFault::TooManyDigits { .. } => Rule::TooManyDigits,
            _ => Rule::Syntax,
        };
        Finding::in_text(rule, range, Detail::Said(sentence)).with(severity)
    }
}

impl WordFault {
    /// It is read all the same.
    pub(crate) fn is_read(self) -> bool {
        matches!(
            self,
            WordFault::OpenComment
                | WordFault::CommentedBlock
                | WordFault::LetterO
                | WordFault::DecimalComma
                | WordFault::Lookalike
        )
    }
}
