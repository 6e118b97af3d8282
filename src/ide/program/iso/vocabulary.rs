//! The meanings of G and M words: common to every control, or dependent on the machine but usual on wire cutters.

use crate::program::iso::word::Number;

/// The meaning of a word common to every control.
pub(super) fn known(letter: u8, number: Number) -> Option<&'static str> {
    match letter {
        b'G' => known_g(number),
        b'M' => known_m(number.whole()?),
        _ => None,
    }
}

/// The usual meaning of a word that depends on the machine.
pub(super) fn usual(letter: u8, number: Number) -> Option<&'static str> {
    Some(match letter {
        b'G' => return usual_g(number),
        b'M' => return usual_m(number.whole()?),
        b'U' | b'V' => say!(upper_guide_along_x_or_y),
        b'Z' => say!(a_height),
        b'A' => say!(an_angle_of_the_taper),
        b'C' | b'E' | b'S' => say!(a_cutting_condition),
        b'T' => say!(a_switch),
        b'Q' | b'K' => say!(a_parameter_of_a_cycle),
        _ => return None,
    })
}

fn known_g(number: Number) -> Option<&'static str> {
    Some(match (number.mantissa, number.decimals) {
        (0, 0) => say!(moves_without_cutting_from_here_on),
        (1, 0) => say!(cuts_a_line_from_here_on),
        (2, 0) => say!(cuts_an_arc_clockwise_from_here_on),
        (3, 0) => say!(cuts_an_arc_counter_clockwise_from_here_on),
        (4, 0) => say!(waits),
        (17, 0) => say!(arcs_lie_in_the_plane_of_x_and_y),
        (20 | 70, 0) => say!(lengths_are_inches),
        (21 | 71, 0) => say!(lengths_are_millimetres),
        (40, 0) => say!(ends_the_correction_from_the_next_cut_on),
        (41, 0) => say!(correction_on_the_left),
        (42, 0) => say!(correction_on_the_right),
        (90, 0) => say!(coordinates_are_absolute_from_the_zero),
        (91, 0) => say!(coordinates_count_from_the_wire),
        (92, 0) => say!(says_where_the_wire_stands_in_this_line),
        (901 | 911, 1) => say!(says_how_i_and_j_are_meant),
        _ => return None,
    })
}

fn usual_g(number: Number) -> Option<&'static str> {
    if number.decimals > 0 {
        return None;
    }
    Some(match number.mantissa {
        5..=12 => say!(mirrors_or_swaps_the_axes),
        22 | 23 => say!(a_limit_of_travel),
        28..=30 => say!(goes_to_a_place_that_the_machine_knows),
        38 | 39 => say!(how_the_correction_is_switched),
        48 | 49 => say!(whether_corners_are_rounded),
        50 => say!(ends_the_taper),
        51 | 52 => say!(taper_to_the_left_or_right),
        54..=59 => say!(chooses_a_system_of_coordinates),
        60 | 61 => say!(how_exactly_a_corner_is_run),
        80..=82 => say!(moves_until_the_wire_touches),
        84 => say!(aligns_the_wire),
        93 => say!(shifts_the_zero),
        94 | 95 => say!(how_the_feed_is_controlled),
        _ => return None,
    })
}

fn known_m(number: i64) -> Option<&'static str> {
    Some(match number {
        0 => say!(stop_as_to_thread_the_wire),
        1 => say!(stop_where_switched_on),
        2 => say!(end_of_the_program),
        30 => say!(end_of_the_program_back_to_its_begin),
        98 => say!(runs_a_subprogram),
        99 => say!(end_of_a_subprogram_goes_on_behind_the_call),
        _ => return None,
    })
}

fn usual_m(number: i64) -> Option<&'static str> {
    Some(match number {
        5 => say!(the_next_move_ignores_that_the_wire_touches),
        6 | 20 | 60 => say!(threads_the_wire),
        21 | 50 => say!(cuts_the_wire_off),
        17 => say!(end_of_a_subprogram),
        80..=89 => say!(switches_the_generator_or_the_water),
        96 | 97 => say!(calls_a_subprogram_or_ends_it),
        _ => return None,
    })
}
