//! Faults in a program of any language, as numbers.

use super::{Rule, Severity, Side};
use crate::geometry::Vector;

/// An axis of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    X,
    Y,
}

impl Axis {
    pub(crate) fn letter(self) -> char {
        match self {
            Axis::X => 'X',
            Axis::Y => 'Y',
        }
    }

    pub(crate) fn other(self) -> Axis {
        match self {
            Axis::X => Axis::Y,
            Axis::Y => Axis::X,
        }
    }
}

/// The numbers of a fault in a program. Lengths in µm unless they say otherwise.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// A rule with a sentence of its own, where nobody else needs its numbers.
    Said {
        rule: Rule,
        sentence: String,
    },
    /// One of a block's three `B` is missing.
    MissingB,
    BlockNumberAsB {
        number: u32,
    },
    /// J is the length of the line, but must be the `projection`.
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
    /// J does not lead to the contour's end: with `meant` it closes.
    JKeepsOpen {
        j: i64,
        meant: i64,
        /// Other evidence than the closing supports it.
        is_sure: bool,
    },
    /// J is more than one turn counts.
    JOverTurn {
        j: i64,
        turn: i64,
    },
    /// R of a 4B block is not √(X² + Y²), µm.
    RadiusOff {
        radius: i64,
        meant: i64,
    },
    /// A line counts its smaller projection.
    SmallerProjection {
        axis: Axis,
        counted: i64,
        larger: i64,
    },
    /// With the other axis the contour closes.
    AxisKeepsOpen {
        axis: Axis,
        /// Other evidence than the closing supports it.
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
    /// With `meant` instead of `found` the contour closes.
    QuadrantKeepsOpen {
        found: &'static str,
        meant: &'static str,
        /// Other evidence than the closing supports it.
        is_sure: bool,
    },
    /// With `meant` instead of `value` the contour closes.
    NumberKeepsOpen {
        axis: Axis,
        value: i64,
        meant: i64,
    },
    /// With X and Y exchanged the contour closes.
    ExchangedKeepsOpen,
    /// The block stands twice: without it the contour closes.
    TwinKeepsOpen,
    /// An arc whose centre is one of its ends, or is missing.
    ArcWithoutRadius,
    /// `field` holds more than `digits` digits.
    TooManyDigits {
        field: &'static str,
        value: i64,
        digits: u32,
    },
    /// A cut ends this far beside its beginning.
    NotClosed {
        x: f64,
        y: f64,
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
    /// `expected` should follow, but `number` does.
    NumberOutOfOrder {
        expected: u32,
        number: u32,
    },
    Unnumbered {
        expected: u32,
    },
    /// The coordinates behind the block differ from its end.
    PositionMismatch {
        x: f64,
        y: f64,
    },
    /// The path meets the block on line `other` (from 0) at a point, mm from the contour's start, and from that of its
    /// own block.
    PathCrossesItself {
        at: [f64; 2],
        from_block: Option<Vector>,
        other: usize,
    },
    /// The start of an arc is `start` from its centre, its end `end`.
    OffRadius {
        start: f64,
        end: f64,
    },
    /// Compensation is switched with an arc, or with a rapid.
    Switch {
        on: bool,
        arc: bool,
    },
    /// The wire runs on `side` of a contour, which makes it a punch (or an opening) against the settings.
    RoleSide {
        side: Side,
        punch: bool,
    },
    /// The wire runs on `side` of a contour but approaches it from the other side.
    EntrySide {
        side: Side,
    },
    /// `word` stands `count` times.
    Foreign {
        word: String,
        count: usize,
    },
    /// A subprogram that is not in the text.
    NoSubprogram {
        number: u32,
    },
    EndlessCalls,
    /// G02 for G03, or the other way round; `is_sure` where the way turns back on itself.
    ReversedArc {
        is_sure: bool,
    },
    /// Out and back by this much.
    Spur {
        length: f64,
    },
    /// An arc that goes round once more, or a line that leads nowhere.
    DoubledBlock {
        arc: bool,
    },
    NoOffset {
        side: Side,
    },
    /// The wire changes to `side` from the other one.
    SideChange {
        side: Side,
    },
    StillOn,
    /// Subprogram `number` runs on into the blocks behind it.
    NoReturn {
        number: u32,
    },
    /// `word` stands for the first of `count`.
    Bare {
        word: String,
        count: usize,
    },
    /// A number with a decimal point among numbers without one.
    Pointed {
        word: String,
    },
    /// A number with other decimals than all others, which have `usual`.
    Places {
        word: String,
        usual: u8,
    },
    /// mm, of a program that does not state its unit.
    LooksLikeInches {
        size: f64,
    },
    /// mm: no wire cuts a part of this size.
    AbsurdSize {
        size: f64,
    },
    /// A place of the table that depends on one which the program does not fill.
    UnknownValue {
        word: String,
    },
    /// With `meant` instead of `found` the program is sound.
    Suspect {
        found: String,
        meant: String,
        closes: bool,
    },
}

impl Fault {
    /// The same where its effect is only unusual.
    pub(crate) fn as_unusual(&self) -> Fault {
        match *self {
            Fault::AxisQuadrant {
                found,
                expected,
                axis,
            } => Fault::UnusualQuadrant {
                found,
                expected,
                axis,
            },
            ref other => other.clone(),
        }
    }

    pub(crate) fn said(rule: Rule, sentence: impl Into<String>) -> Fault {
        let sentence = sentence.into();
        Fault::Said { rule, sentence }
    }

    pub(crate) fn rule(&self) -> Rule {
        match self {
            Fault::Said { rule, .. } => *rule,
            Fault::MissingB => Rule::MissingB,
            Fault::BlockNumberAsB { .. } => Rule::BlockNumberAsB,
            Fault::LengthInJ { .. } => Rule::LengthInJ,
            Fault::WrongJ { .. } | Fault::JKeepsOpen { .. } => Rule::WrongJ,
            Fault::JOverTurn { .. } => Rule::JOverTurn,
            Fault::SmallerProjection { .. } | Fault::AxisKeepsOpen { .. } => {
                Rule::WrongCountingAxis
            }
            Fault::AxisQuadrant { .. }
            | Fault::UnusualQuadrant { .. }
            | Fault::QuadrantKeepsOpen { .. } => Rule::WrongQuadrant,
            Fault::ArcWithoutRadius => Rule::ArcWithoutRadius,
            Fault::TooManyDigits { .. } => Rule::TooManyDigits,
            Fault::NotClosed { .. } => Rule::NotClosed,
            Fault::MissingEnd { .. } => Rule::MissingEnd,
            Fault::TextAfterEnd { .. } => Rule::TextAfterEnd,
            Fault::DoubledNumber { .. }
            | Fault::NumberOutOfOrder { .. }
            | Fault::Unnumbered { .. } => Rule::BlockNumber,
            Fault::PositionMismatch { .. } => Rule::PositionMismatch,
            Fault::PathCrossesItself { .. } => Rule::PathCrossesItself,
            Fault::OffRadius { .. } | Fault::RadiusOff { .. } => Rule::ArcOffRadius,
            Fault::Switch { .. } => Rule::CompensationSwitch,
            Fault::RoleSide { .. } | Fault::EntrySide { .. } => Rule::WrongSide,
            Fault::Foreign { .. }
            | Fault::NoSubprogram { .. }
            | Fault::EndlessCalls
            | Fault::UnknownValue { .. } => Rule::MachineDependent,
            Fault::ReversedArc { .. } => Rule::ReversedArc,
            Fault::Spur { .. } => Rule::Spur,
            Fault::DoubledBlock { .. } | Fault::TwinKeepsOpen => Rule::DoubledBlock,
            Fault::NoOffset { .. } => Rule::MissingOffset,
            Fault::SideChange { .. } => Rule::SideChange,
            Fault::StillOn => Rule::MissingCancel,
            Fault::NoReturn { .. } => Rule::MissingReturn,
            Fault::Bare { .. } | Fault::Pointed { .. } | Fault::Places { .. } => Rule::MixedNumbers,
            Fault::LooksLikeInches { .. } | Fault::AbsurdSize { .. } => Rule::Units,
            Fault::Suspect { .. } | Fault::NumberKeepsOpen { .. } | Fault::ExchangedKeepsOpen => {
                Rule::SuspectBlock
            }
        }
    }

    /// That of its rule, unless the case is more or less severe than usual.
    pub(crate) fn severity(&self) -> Severity {
        match self {
            Fault::DoubledBlock { arc: true } => Severity::Error,
            Fault::ReversedArc { is_sure: false }
            | Fault::EntrySide { .. }
            | Fault::EndlessCalls => Severity::Warning,
            Fault::LooksLikeInches { .. } => Severity::Hint,
            _ => self.rule().default_severity(),
        }
    }
}
