//! The sentences about faults in a program.

use super::lengths::{absurd, mm, told_apart};
use super::{Fault, Side};

/// A field that keeps a contour open, as far as the contour alone shows.
fn keeps_open(found: &str, meant: &str, is_sure: bool) -> String {
    if is_sure {
        return say!(keeps_the_contour_open_with, found, meant);
    }
    say!(may_keep_the_contour_open, found, meant)
}

/// The fault in a program, and its effect at the machine.
pub(super) fn program(fault: &Fault) -> String {
    let side_word = |side: &Side| match side {
        Side::Left => say!(g41_lets_the_wire_run_on_the_left),
        Side::Right => say!(g42_lets_the_wire_run_on_the_right),
    };
    match fault {
        Fault::Said { sentence, .. } => sentence.clone(),
        Fault::MissingB => say!(a_missing_b_shifts_the_numbers).into(),
        Fault::BlockNumberAsB { number } => {
            say!(b_stands_where_the_block_number_was_meant, number)
        }
        Fault::LengthInJ {
            j,
            projection,
            axis,
        } => say!(j_is_the_length_of_the_line, j, axis.letter(), projection),
        Fault::WrongJ {
            j: 0,
            projection,
            axis,
        } => {
            say!(j_is_0_beside_a_projection, axis.letter(), projection)
        }
        Fault::WrongJ {
            j,
            projection,
            axis,
        } => say!(
            j_is_not_the_projection_of_the_line,
            j,
            axis.letter(),
            projection,
            (j - projection).abs(),
            if j > projection {
                say!(too_far)
            } else {
                say!(too_early)
            }
        ),
        Fault::JKeepsOpen { j, meant, is_sure } => {
            keeps_open(&format!("J {j}"), &format!("J {meant}"), *is_sure)
        }
        Fault::JOverTurn { j, turn } => {
            say!(j_is_more_than_one_turn_counts, j, turn)
        }
        Fault::RadiusOff { radius, meant } => {
            say!(r_is_not_the_radius_of_x_and_y, radius, meant)
        }
        Fault::SmallerProjection {
            axis,
            counted,
            larger,
        } => {
            say!(
                g_counts_the_smaller_projection,
                axis.letter(),
                counted,
                larger,
                axis.other().letter()
            )
        }
        Fault::AxisKeepsOpen { axis, is_sure } => keeps_open(
            &format!("G{}", axis.letter()),
            &format!("G{}", axis.other().letter()),
            *is_sure,
        ),
        Fault::UnusualQuadrant {
            found,
            expected: [one, other],
            axis,
        } => say!(
            is_unusual_for_a_line_along_an_axis,
            found,
            axis.letter(),
            one,
            other
        ),
        Fault::AxisQuadrant {
            found,
            expected: [one, other],
            axis,
        } => {
            say!(
                contradicts_a_line_along_an_axis,
                found,
                axis.letter(),
                one,
                other
            )
        }
        Fault::QuadrantKeepsOpen {
            found,
            meant,
            is_sure,
        } => keeps_open(found, meant, *is_sure),
        Fault::NumberKeepsOpen { axis, value, meant } => {
            let letter = axis.letter();
            keeps_open(
                &format!("{letter} {value}"),
                &format!("{letter} {meant}"),
                true,
            )
        }
        Fault::ExchangedKeepsOpen => say!(x_and_y_stand_for_each_other).into(),
        Fault::TwinKeepsOpen => say!(without_its_double_the_contour_closes).into(),
        Fault::ArcWithoutRadius => say!(the_arc_has_no_radius).into(),
        Fault::TooManyDigits {
            field,
            value,
            digits,
        } => {
            say!(
                a_number_has_more_digits_than_the_controller_takes,
                field,
                value,
                digits
            )
        }
        Fault::NotClosed { x, y } => say!(
            the_cut_does_not_close,
            mm(x.hypot(*y) / 1000.0),
            x / 1000.0,
            y / 1000.0
        ),
        Fault::MissingEnd { word } => {
            say!(the_program_lacks_its_end, word)
        }
        Fault::TextAfterEnd { word } => {
            say!(text_behind_which_ends_the_program, word)
        }
        Fault::DoubledNumber { number } => say!(block_number_n_stands_twice, number),
        Fault::NumberOutOfOrder { expected, number } => {
            say!(block_number_n_is_out_of_turn_expected_n, number, expected)
        }
        Fault::Unnumbered { expected } => {
            say!(the_block_has_no_number_expected_n, expected)
        }
        Fault::PositionMismatch { x, y } => say!(
            the_coordinates_are_not_where_the_block_ends,
            mm(x.hypot(*y) / 1000.0),
            x / 1000.0,
            y / 1000.0
        ),
        Fault::PathCrossesItself {
            at: [x, y], other, ..
        } => {
            say!(the_wire_crosses_its_own_path, other + 1, x, y)
        }
        Fault::OffRadius { start, end } => {
            let (near, far) = told_apart(start / 1e3, end / 1e3);
            say!(the_ends_of_the_arc_are_not_on_one_circle, near, far)
        }
        Fault::Switch {
            on: true,
            arc: true,
        } => say!(the_correction_is_switched_on_by_an_arc).into(),
        Fault::Switch {
            on: false,
            arc: true,
        } => say!(the_correction_is_switched_off_by_an_arc).into(),
        Fault::Switch { .. } => say!(the_correction_is_switched_on_by_a_rapid).into(),
        Fault::RoleSide { side, punch } => {
            let (is, wanted) = if *punch {
                (say!(outside), say!(opening))
            } else {
                (say!(inside), say!(punch))
            };
            say!(the_settings_say_the_other_side, side_word(side), is, wanted)
        }
        Fault::EntrySide { side } => {
            say!(it_comes_from_the_other_side, side_word(side))
        }
        Fault::Foreign { word, count: 1 } => {
            say!(is_a_matter_of_the_machine, word)
        }
        Fault::Foreign { word, count } => {
            say!(is_often_a_matter_of_the_machine, word, count)
        }
        Fault::NoSubprogram { number } => say!(subprogram_does_not_stand_in_this_text, number),
        Fault::EndlessCalls => say!(the_subprograms_call_each_other_without_end).into(),
        Fault::ReversedArc { is_sure: true } => say!(the_arc_runs_the_wrong_way_round).into(),
        Fault::ReversedArc { is_sure: false } => say!(the_arc_may_run_the_wrong_way_round).into(),
        Fault::Spur { length } => {
            say!(the_wire_goes_out_mm_and_back_on_the_same, mm(length / 1e3))
        }
        Fault::DoubledBlock { arc: true } => say!(the_block_stands_twice_and_goes_round).into(),
        Fault::DoubledBlock { arc: false } => say!(the_block_stands_twice_and_moves_nothing).into(),
        Fault::NoOffset { side } => {
            say!(nothing_says_by_how_much, side_word(side))
        }
        Fault::SideChange { side } => {
            say!(the_side_changes_within_the_cut, side_word(side))
        }
        Fault::StillOn => say!(the_program_ends_with_the_correction_on).into(),
        Fault::NoReturn { number } => {
            say!(subprogram_has_no_m99, number)
        }
        Fault::Bare { word, count: 1 } => {
            say!(has_no_decimal_point, word)
        }
        Fault::Bare { word, count } => say!(several_have_no_decimal_point, word, count),
        Fault::Pointed { word } => {
            say!(has_a_decimal_point, word)
        }
        Fault::Places { word, usual } => {
            say!(has_other_decimals_than_the_others, word, usual)
        }
        Fault::LooksLikeInches { size } => say!(the_program_does_not_say_its_unit, mm(*size)),
        Fault::AbsurdSize { size } => {
            say!(
                the_program_is_meant_in_another_unit,
                mm(*size),
                absurd(*size)
            )
        }
        Fault::UnknownValue { word } => {
            say!(hangs_on_an_empty_place_of_the_table, word)
        }
        Fault::Suspect {
            found,
            meant,
            closes,
        } => {
            let comes_of_it = if *closes {
                say!(the_cut_does_not_close_and_it_would)
            } else {
                say!(the_cut_would_be_sound)
            };
            match (found.is_empty(), meant.is_empty()) {
                (true, _) => say!(may_be_missing_here, meant, comes_of_it),
                (_, true) => say!(may_be_one_too_many, found, comes_of_it),
                _ => say!(may_be_wrong_here, found, comes_of_it, meant),
            }
        }
    }
}
