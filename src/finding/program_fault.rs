//! What is wrong in a program's block or contour, as numbers; the sentence is made in [`crate::message`].

use super::Rule;

/// An axis of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    X,
    Y,
}

impl Axis {
    pub fn letter(self) -> char {
        match self {
            Axis::X => 'X',
            Axis::Y => 'Y',
        }
    }

    pub fn other(self) -> Axis {
        match self {
            Axis::X => Axis::Y,
            Axis::Y => Axis::X,
        }
    }
}

/// The numbers of a fault in a 3B or 4B program. Lengths in µm unless they say otherwise.
#[derive(Clone, Debug, PartialEq)]
pub enum ProgramFault {
    /// One of a block's three `B` is not there.
    MissingB,
    BlockNumberAsB {
        number: u32,
    },
    /// J is the length of the line, `projection` is what is counted.
    LengthInJ {
        j: i64,
        projection: i64,
        axis: Axis,
    },
    /// J is not the line's projection.
    WrongJ {
        j: i64,
        projection: i64,
        axis: Axis,
    },
    /// J is not what leads to the contour's end: with `meant` in its place it closes.
    JKeepsOpen {
        j: i64,
        meant: i64,
        /// Something beside the closing speaks for it.
        is_sure: bool,
    },
    /// J is more than one turn counts.
    JOverTurn {
        j: i64,
        turn: i64,
    },
    /// A line counts its smaller projection.
    SmallerProjection {
        axis: Axis,
        counted: i64,
        larger: i64,
    },
    /// An arc ends at (`x`, `y`) from its centre, where `axis` hardly moves.
    ArcEndAxis {
        axis: Axis,
        x: f64,
        y: f64,
    },
    /// With the other axis the contour closes.
    AxisKeepsOpen {
        axis: Axis,
        /// Something beside the closing speaks for it.
        is_sure: bool,
    },
    /// `found` is not the quadrant of a line along an axis.
    AxisQuadrant {
        found: &'static str,
        expected: [&'static str; 2],
        axis: Axis,
    },
    /// The same where the contour closes with it: a zero has no sign.
    UnusualQuadrant {
        found: &'static str,
        expected: [&'static str; 2],
        axis: Axis,
    },
    /// With `meant` in the place of `found` the contour closes.
    QuadrantKeepsOpen {
        found: &'static str,
        meant: &'static str,
        /// Something beside the closing speaks for it.
        is_sure: bool,
    },
    /// With `meant` in the place of `value` the contour closes.
    NumberKeepsOpen {
        axis: Axis,
        value: i64,
        meant: i64,
    },
    /// With X and Y exchanged the contour closes.
    ExchangedKeepsOpen,
    /// The block stands twice: without it the contour closes.
    TwinKeepsOpen,
    ZeroBlock,
    ArcWithoutRadius,
    /// `field` holds more than `digits` digits.
    TooManyDigits {
        field: &'static str,
        value: i64,
        digits: u32,
    },
    /// The contour ends beside its beginning.
    NotClosed {
        x: f64,
        y: f64,
        blocks: usize,
    },
    MissingEnd {
        word: String,
    },
    TextAfterEnd {
        word: String,
    },
    DoubledNumber {
        number: u32,
    },
    /// `expected` would follow, `number` does.
    NumberOutOfOrder {
        expected: u32,
        number: u32,
    },
    Unnumbered {
        expected: u32,
    },
    /// The coordinates behind the block are off from where it leads.
    PositionMismatch {
        x: f64,
        y: f64,
    },
    /// The way meets the block on line `other` (from 0) at a point, mm from the program's start.
    PathCrossesItself {
        at: [f64; 2],
        other: usize,
    },
}

impl ProgramFault {
    /// The same where what it says is only unusual.
    pub fn as_unusual(&self) -> ProgramFault {
        match *self {
            ProgramFault::AxisQuadrant {
                found,
                expected,
                axis,
            } => ProgramFault::UnusualQuadrant {
                found,
                expected,
                axis,
            },
            ref other => other.clone(),
        }
    }

    pub fn rule(&self) -> Rule {
        match self {
            ProgramFault::MissingB => Rule::MissingB,
            ProgramFault::BlockNumberAsB { .. } => Rule::BlockNumberAsB,
            ProgramFault::LengthInJ { .. } => Rule::LengthInJ,
            ProgramFault::WrongJ { .. } | ProgramFault::JKeepsOpen { .. } => Rule::WrongJ,
            ProgramFault::JOverTurn { .. } => Rule::JOverTurn,
            ProgramFault::SmallerProjection { .. }
            | ProgramFault::ArcEndAxis { .. }
            | ProgramFault::AxisKeepsOpen { .. } => Rule::WrongCountingAxis,
            ProgramFault::AxisQuadrant { .. }
            | ProgramFault::UnusualQuadrant { .. }
            | ProgramFault::QuadrantKeepsOpen { .. } => Rule::WrongQuadrant,
            ProgramFault::ZeroBlock => Rule::ZeroBlock,
            ProgramFault::ArcWithoutRadius => Rule::ArcWithoutRadius,
            ProgramFault::TooManyDigits { .. } => Rule::TooManyDigits,
            ProgramFault::NotClosed { .. }
            | ProgramFault::NumberKeepsOpen { .. }
            | ProgramFault::ExchangedKeepsOpen
            | ProgramFault::TwinKeepsOpen => Rule::NotClosed,
            ProgramFault::MissingEnd { .. } => Rule::MissingEnd,
            ProgramFault::TextAfterEnd { .. } => Rule::TextAfterEnd,
            ProgramFault::DoubledNumber { .. }
            | ProgramFault::NumberOutOfOrder { .. }
            | ProgramFault::Unnumbered { .. } => Rule::BlockNumber,
            ProgramFault::PositionMismatch { .. } => Rule::PositionMismatch,
            ProgramFault::PathCrossesItself { .. } => Rule::PathCrossesItself,
        }
    }
}
