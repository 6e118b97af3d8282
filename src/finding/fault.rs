//! Faults in a program of any language: their numbers, their rules, and the sentences about them.

use super::lengths::{absurd, mm, told_apart};
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

    /// The coordinate along it.
    pub(crate) fn of<T: Copy>(self, [x, y]: [T; 2]) -> T {
        match self {
            Axis::X => x,
            Axis::Y => y,
        }
    }
}

/// The rows of faults: as [`told`], with the rule of each.
macro_rules! faults {
    ($(
        $(#[$doc:meta])*
        $variant:ident $({ $($(#[$of:meta])* $field:ident: $kind:ty),+ })? [$rule:expr]
            => $said:expr;
    )+) => {
        told! {
            /// The numbers of a fault in a program. Lengths in µm unless they say otherwise.
            enum Fault;
            /// The fault, and its effect at the machine.
            fn sentence();
            $($(#[$doc])* $variant $({ $($(#[$of])* $field: $kind),+ })? => $said;)+
        }

        impl Fault {
            #[allow(unused_variables, reason = "only one of them tells its rule")]
            pub(crate) fn rule(&self) -> Rule {
                match self {
                    $(Fault::$variant $({ $($field),+ })? => $rule,)+
                }
            }
        }
    };
}

faults! {
    /// A rule with a finished sentence, where nothing else needs its numbers.
    Said { rule: Rule, sentence: String } [*rule] => sentence.as_str();
    /// One of a block's three `B` is missing.
    MissingB [Rule::MissingB] => say!(a_missing_b_shifts_the_numbers);
    BlockNumberAsB { number: u32 } [Rule::BlockNumberAsB]
        => say!(b_stands_where_the_block_number_was_meant, number);
    /// J is the length of the line, but must be the `projection`.
    LengthInJ { j: i64, projection: i64, axis: Axis } [Rule::LengthInJ]
        => say!(j_is_the_length_of_the_line, j, axis.letter(), projection);
    /// J is not the line's projection.
    WrongJ { j: i64, projection: i64, axis: Axis } [Rule::WrongJ] => match (j, axis.letter()) {
        (0, axis) => say!(j_is_0_beside_a_projection, axis, projection),
        (j, axis) => {
            let (off, is_more) = ((j - projection).abs(), j > projection);
            let how = if is_more { say!(too_far) } else { say!(too_early) };
            say!(j_is_not_the_projection_of_the_line, j, axis, projection, off, how)
        }
    };
    /// J is more than one turn counts.
    JOverTurn { j: i64, turn: i64 } [Rule::JOverTurn] => say!(j_is_more_than_one_turn_counts, j, turn);
    /// R of a 4B block is not √(X² + Y²), µm.
    RadiusOff { radius: i64, meant: i64 } [Rule::ArcOffRadius] => say!(r_is_not_the_radius_of_x_and_y, radius, meant);
    /// A line counts its smaller projection.
    SmallerProjection { axis: Axis, counted: i64, larger: i64 } [Rule::WrongCountingAxis] => {
        let [own, other] = [*axis, axis.other()].map(Axis::letter);
        say!(g_counts_the_smaller_projection, own, counted, larger, other)
    };
    /// `found` is not the quadrant of a line along an axis.
    AxisQuadrant { found: &'static str, expected: [&'static str; 2], axis: Axis } [Rule::WrongQuadrant]
        => say!(contradicts_a_line_along_an_axis, found, axis.letter(), expected[0], expected[1]);
    /// The same where the contour closes with it: a zero has no sign.
    UnusualQuadrant { found: &'static str, expected: [&'static str; 2], axis: Axis } [Rule::WrongQuadrant]
        => say!(is_unusual_for_a_line_along_an_axis, found, axis.letter(), expected[0], expected[1]);
    /// With `meant` instead of `found` in a field of the block the contour closes.
    FieldKeepsOpen {
        rule: Rule,
        found: String,
        meant: String,
        /// The same of a number, µm.
        numbers: Option<[i64; 2]>,
        /// Evidence other than the closing supports it.
        is_sure: bool
    } [*rule] => keeps_open(found, meant, *is_sure);
    /// With X and Y exchanged the contour closes.
    ExchangedKeepsOpen [Rule::SuspectBlock] => say!(x_and_y_stand_for_each_other);
    /// The block is repeated: without it the contour closes.
    TwinKeepsOpen [Rule::DoubledBlock] => say!(without_its_double_the_contour_closes);
    /// An arc whose centre is one of its ends, or is missing.
    ArcWithoutRadius [Rule::ArcWithoutRadius] => say!(the_arc_has_no_radius);
    /// `field` holds more than `digits` digits.
    TooManyDigits { field: &'static str, value: i64, digits: u32 } [Rule::TooManyDigits]
        => say!(a_number_has_more_digits_than_the_controller_takes, field, value, digits);
    /// A cut ends this far from its beginning.
    NotClosed { x: f64, y: f64 } [Rule::NotClosed]
        => say!(the_cut_does_not_close, mm(x.hypot(*y) / 1000.0), x / 1000.0, y / 1000.0);
    /// The wire came back to where a cut began, and leads on from there by this much, µm.
    LeadsOn { length: f64 } [Rule::NotClosed]
        => say!(the_wire_leads_on_from_the_start_hole, mm(length / 1e3));
    MissingEnd { word: String } [Rule::MissingEnd] => say!(the_program_lacks_its_end, word);
    TextAfterEnd { word: String } [Rule::TextAfterEnd] => say!(text_behind_which_ends_the_program, word);
    DoubledNumber { number: u32 } [Rule::BlockNumber] => say!(block_number_n_stands_twice, number);
    /// `expected` should follow, but `number` does.
    NumberOutOfOrder { expected: u32, number: u32 } [Rule::BlockNumber]
        => say!(block_number_n_is_out_of_turn_expected_n, number, expected);
    Unnumbered { expected: u32 } [Rule::BlockNumber] => say!(the_block_has_no_number_expected_n, expected);
    /// The coordinates after the block differ from its end.
    PositionMismatch { x: f64, y: f64 } [Rule::PositionMismatch] => {
        let off = mm(x.hypot(*y) / 1000.0);
        say!(the_coordinates_are_not_where_the_block_ends, off, x / 1000.0, y / 1000.0)
    };
    /// The path meets the block on line `other` (from 0) at a point, in mm from the contour's
    /// start, and from the start of its own block.
    PathCrossesItself { at: [f64; 2], from_block: Option<Vector>, other: usize } [Rule::PathCrossesItself]
        => say!(the_wire_crosses_its_own_path, other + 1, at[0], at[1]);
    /// The start of an arc is `start` from its centre, its end `end`.
    OffRadius { start: f64, end: f64 } [Rule::ArcOffRadius] => {
        let (near, far) = told_apart(start / 1e3, end / 1e3);
        say!(the_ends_of_the_arc_are_not_on_one_circle, near, far)
    };
    /// Compensation is switched with an arc, or with a rapid.
    Switch { on: bool, arc: bool } [Rule::CompensationSwitch] => match (on, arc) {
        (true, true) => say!(the_correction_is_switched_on_by_an_arc),
        (false, true) => say!(the_correction_is_switched_off_by_an_arc),
        (_, false) => say!(the_correction_is_switched_on_by_a_rapid),
    };
    /// The wire runs on `side` of a contour, which makes it a punch (or an opening), contrary to
    /// the settings.
    RoleSide { side: Side, punch: bool } [Rule::WrongSide] => {
        let (is, wanted) = match punch {
            true => (say!(outside), say!(opening)),
            false => (say!(inside), say!(punch)),
        };
        say!(the_settings_say_the_other_side, runs_on(*side), is, wanted)
    };
    /// The wire runs on `side` of a contour but approaches it from the other side.
    EntrySide { side: Side } [Rule::WrongSide] => say!(it_comes_from_the_other_side, runs_on(*side));
    /// A pass on another side of its contour than most passes of it.
    PassSide { side: Side, inside: bool } [Rule::WrongSide] => {
        let (is, others) = match inside {
            true => (say!(inside), say!(outside)),
            false => (say!(outside), say!(inside)),
        };
        say!(the_other_passes_run_on_the_other_side, runs_on(*side), is, others)
    };
    /// Corrections of this pass and of the one before it, µm.
    PassRises { correction: f64, before: f64 } [Rule::PassOrder]
        => say!(this_pass_has_a_larger_correction, mm(correction / 1e3), mm(before / 1e3), mm((correction - before) / 1e3));
    /// A pass whose contour lies this far beside that of the one before it, µm.
    PassAside { by: f64 } [Rule::PassOrder] => say!(this_pass_lies_beside_the_one_before, mm(by / 1e3));
    /// The last side of a contour is cut with the correction switched off.
    SwitchedOffEarly [Rule::CompensationSwitch] => say!(the_correction_ends_before_the_contour);
    /// `word` occurs `count` times.
    Foreign { word: String, count: usize } [Rule::MachineDependent] => match count {
        1 => say!(is_a_matter_of_the_machine, word),
        count => say!(is_often_a_matter_of_the_machine, word, count),
    };
    /// A subprogram that is not in the text.
    NoSubprogram { number: u32 } [Rule::MachineDependent]
        => say!(subprogram_does_not_stand_in_this_text, number);
    EndlessCalls [Rule::MachineDependent] => say!(the_subprograms_call_each_other_without_end);
    /// G02 for G03, or the other way round; `is_sure` where the path turns back on itself.
    ReversedArc { is_sure: bool } [Rule::ReversedArc] => match is_sure {
        true => say!(the_arc_runs_the_wrong_way_round),
        false => say!(the_arc_may_run_the_wrong_way_round),
    };
    /// The wire goes out and back by this much.
    Spur { length: f64 } [Rule::Spur]
        => say!(the_wire_goes_out_mm_and_back_on_the_same, mm(length / 1e3));
    /// An arc that goes round once more, or a line that leads nowhere.
    DoubledBlock { arc: bool } [Rule::DoubledBlock] => match arc {
        true => say!(the_block_stands_twice_and_goes_round),
        false => say!(the_block_stands_twice_and_moves_nothing),
    };
    NoOffset { side: Side } [Rule::MissingOffset] => say!(nothing_says_by_how_much, runs_on(*side));
    /// The wire changes to `side` from the other one.
    SideChange { side: Side } [Rule::SideChange]
        => say!(the_side_changes_within_the_cut, runs_on(*side));
    StillOn [Rule::MissingCancel] => say!(the_program_ends_with_the_correction_on);
    /// Subprogram `number` runs on into the blocks after it.
    NoReturn { number: u32 } [Rule::MissingReturn] => say!(subprogram_has_no_m99, number);
    /// `word` stands for the first of `count`.
    Bare { word: String, count: usize } [Rule::MixedNumbers] => match count {
        1 => say!(has_no_decimal_point, word),
        count => say!(several_have_no_decimal_point, word, count),
    };
    /// A number with a decimal point among numbers without one.
    Pointed { word: String } [Rule::MixedNumbers] => say!(has_a_decimal_point, word);
    /// A number with other decimals than all others, which have `usual`.
    Places { word: String, usual: u8 } [Rule::MixedNumbers]
        => say!(has_other_decimals_than_the_others, word, usual);
    /// mm, of a program that does not state its unit.
    LooksLikeInches { size: f64 } [Rule::Units] => say!(the_program_does_not_say_its_unit, mm(*size));
    /// mm: no wire cuts a part of this size.
    AbsurdSize { size: f64 } [Rule::Units]
        => say!(the_program_is_meant_in_another_unit, mm(*size), absurd(*size));
    /// A place of the table that depends on one that the program does not fill.
    UnknownValue { word: String } [Rule::MachineDependent]
        => say!(hangs_on_an_empty_place_of_the_table, word);
    /// With `meant` instead of `found` the program is sound.
    Suspect { found: String, meant: String, closes: bool } [Rule::SuspectBlock] => {
        let comes_of_it = match closes {
            true => say!(the_cut_does_not_close_and_it_would),
            false => say!(the_cut_would_be_sound),
        };
        match (found.is_empty(), meant.is_empty()) {
            (true, _) => say!(may_be_missing_here, meant, comes_of_it),
            (_, true) => say!(may_be_one_too_many, found, comes_of_it),
            _ => say!(may_be_wrong_here, found, comes_of_it, meant),
        }
    };
}

/// A field that keeps a contour open, as far as the contour alone shows.
fn keeps_open(found: &str, meant: &str, is_sure: bool) -> String {
    match is_sure {
        true => say!(keeps_the_contour_open_with, found, meant),
        false => say!(may_keep_the_contour_open, found, meant),
    }
}

/// The word that lets the wire run on a side.
fn runs_on(side: Side) -> &'static str {
    match side {
        Side::Left => say!(g41_lets_the_wire_run_on_the_left),
        Side::Right => say!(g42_lets_the_wire_run_on_the_right),
    }
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

    /// The severity of its rule, unless the case is more or less severe than usual.
    pub(crate) fn severity(&self) -> Severity {
        match self {
            Fault::DoubledBlock { arc: true } => Severity::Error,
            Fault::ReversedArc { is_sure: false }
            | Fault::EntrySide { .. }
            | Fault::LeadsOn { .. }
            | Fault::PassRises { .. }
            | Fault::PassAside { .. }
            | Fault::EndlessCalls => Severity::Warning,
            Fault::LooksLikeInches { .. } => Severity::Hint,
            _ => self.rule().default_severity(),
        }
    }
}
