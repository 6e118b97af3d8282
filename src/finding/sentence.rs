//! What a finding says to a person: its numbers in the units that people read, handed to the sentences of [`crate::message`].

use super::{
    CenterFix, Detail, Fault, Finding, FixKind, NoFix, NotJudged, Side, SmallRadius, Unwritable,
};
use crate::drawing::Visibility;
use crate::message::readable;

/// What a finding says, for a person: lower-case, no final dot. `unit_mm` is the drawing's unit in mm.
///
/// Names out of the drawing that stand in it are [`readable`].
pub fn sentence(finding: &Finding, unit_mm: f64) -> String {
    readable(&said(finding, unit_mm)).into_owned()
}

fn said(finding: &Finding, unit_mm: f64) -> String {
    match &finding.detail {
        Detail::SmallRadius(numbers) => small_radius(numbers, unit_mm),
        Detail::UnsupportedEntity {
            kind,
            count: 1,
            why,
        } => say!(is_not_cut, kind, why),
        Detail::UnsupportedEntity { kind, count, why } => {
            say!(of_them_is_not_cut, kind, count, why)
        }
        Detail::Unseen {
            layer,
            visibility,
            count,
        } => unseen(layer, *visibility, *count),
        Detail::SharpCorner {
            turn,
            radius,
            uncut,
            count: None,
        } => say!(
            corner_of_degrees_is_left_with_r_mm,
            turn.abs().to_degrees(),
            mm(radius * unit_mm),
            mm(uncut * unit_mm)
        ),
        Detail::SharpCorner {
            turn,
            radius,
            count: Some(1),
            ..
        } => say!(
            sharp_corner_of_degrees_where,
            turn.abs().to_degrees(),
            mm(radius * unit_mm)
        ),
        Detail::SharpCorner {
            radius,
            count: Some(count),
            ..
        } => {
            say!(
                sharp_corners_those_that_the_wire_runs,
                count,
                mm(radius * unit_mm)
            )
        }
        Detail::NarrowSlot { width, required } => {
            let (width, required) = told_apart(width * unit_mm, required * unit_mm);
            say!(slot_is_mm_wide_the_wire_needs_mm, width, required)
        }
        Detail::LostPocket { .. } => say!(the_offset_loses_this_part_of_the_outline).into(),
        Detail::DeadEnd { uncut, .. } => {
            say!(
                the_wire_does_not_reach_this_part_of_the_outline,
                mm(uncut * unit_mm)
            )
        }
        Detail::OffsetCollapse {
            required,
            point: true,
        } => say!(
            at_a_correction_of_mm_a_point_is_left_of_the_outline,
            mm(required * unit_mm)
        ),
        Detail::UnprovedPath { .. } => say!(no_path_of_the_wire_along_this_contour_holds).into(),
        Detail::OffsetCollapse {
            required,
            point: false,
        } => {
            say!(
                nothing_is_left_of_the_outline_at_a_correction_of_mm,
                mm(required * unit_mm)
            )
        }
        Detail::Unwritable(what) => unwritable(what),
        Detail::OpenContour { distance } => {
            say!(contour_is_open_its_ends_are_mm, mm(distance * unit_mm))
        }
        Detail::Gap { distance } => say!(ends_do_not_meet, mm(distance * unit_mm)),
        Detail::DuplicateEntity => say!(entity_lies_in_the_same_place_as_another).into(),
        Detail::Overlap { length } => {
            say!(segment_runs_on_another_one_over_mm, mm(length * unit_mm))
        }
        Detail::NotJudged(what) => not_judged(what),
        Detail::ShortSegment { length: 0.0 } => say!(segment_has_no_length).into(),
        Detail::ShortSegment { length } => say!(segment_is_only_mm_long, mm(length * unit_mm)),
        Detail::NearTangent { turn } => {
            say!(contour_kinks_by_degrees, turn.abs().to_degrees())
        }
        Detail::SelfIntersection { touches, .. } => {
            say!(
                contour_here_the_wire_would_cut,
                if *touches {
                    say!(touches_itself_or_another)
                } else {
                    say!(crosses_itself_or_another)
                }
            )
        }
        Detail::ArcAsChords {
            chords,
            radius,
            deviation,
            ..
        } => {
            // Less than a nanometre is rounding.
            let within = if deviation * unit_mm < 1e-6 {
                String::new()
            } else {
                say!(within_mm, mm(deviation * unit_mm))
            };
            say!(
                chords_lie_on_one_arc_of_r_mm,
                chords,
                mm(radius * unit_mm),
                within
            )
        }
        Detail::Size { size } => {
            let what = if size * unit_mm > 1.0 {
                say!(more_than_any_machine_travels)
            } else {
                say!(less_than_a_wire_is_thick)
            };
            say!(
                the_largest_contour_is_mm_long_or_wide,
                mm(size * unit_mm),
                what
            )
        }
        Detail::Program(fault) => program(fault),
        Detail::More { count } => say!(more_findings_are_not_shown, count),
        Detail::OnePass { passes, correction } => {
            say!(
                the_program_holds_one_of_passes_that_of_correction_mm,
                passes,
                mm(*correction)
            )
        }
        Detail::LeadIn(sentence)
        | Detail::Units(sentence)
        | Detail::Syntax(sentence)
        | Detail::Settings(sentence) => sentence.clone(),
    }
}

fn unwritable(what: &Unwritable) -> String {
    match *what {
        Unwritable::TightArc {
            at: [x, y],
            radius,
            correction,
        } => say!(n4b_cannot_have_the_arc_r_at, radius, x, y, correction),
        Unwritable::BeginsInCorner { at: [x, y] } => {
            say!(n4b_needs_a_transition_arc_where_the_cut_begins, x, y)
        }
        Unwritable::NoTransition {
            at: [x, y],
            radius,
            turn,
        } => say!(
            n4b_needs_a_transition_arc_of_r_at_the_corner,
            radius,
            x,
            y,
            turn.to_degrees().abs()
        ),
    }
}

fn unseen(layer: &str, visibility: Visibility, count: usize) -> String {
    let (entities, are) = if count == 1 {
        (say!(n1_entity).to_string(), say!(is))
    } else {
        (say!(entities, count), say!(are))
    };
    let of_layer = |what: &str| say!(layer_is_on_it_not_cut_unless, layer, what, entities, are);
    match visibility {
        Visibility::Frozen => of_layer(say!(frozen)),
        Visibility::Off => of_layer(say!(switched_off)),
        Visibility::Invisible => say!(invisible_group_code_60_not, entities, are),
        Visibility::Unplotted | Visibility::Shown => {
            say!(layer_is_not_plotted_on, layer, entities, are)
        }
    }
}

/// What the other place of a finding is, for a person.
pub fn related(finding: &Finding, handle: &str, segment: Option<usize>) -> String {
    let handle = readable(handle);
    let place = segment.map_or_else(
        || handle.to_string(),
        |segment| say!(segment, handle, segment),
    );
    match finding.detail {
        Detail::NarrowSlot { .. } => say!(the_facing_wall, place),
        Detail::DeadEnd { .. } => say!(the_wire_comes_no_further_than_here, place),
        Detail::DuplicateEntity => say!(the_same_place, place),
        Detail::Overlap { .. } => say!(runs_on_this_one, place),
        Detail::LeadIn(_) => say!(what_is_in_the_way, place),
        Detail::SelfIntersection { touches: true, .. } => say!(touches_this_one, place),
        Detail::SelfIntersection { .. } => say!(crosses_this_one, place),
        Detail::SharpCorner { .. } | Detail::NearTangent { .. } => {
            say!(meets_this_one, place)
        }
        _ => say!(the_other_one, place),
    }
}

/// What a fix does, as the title of its code action.
pub fn title(kind: &FixKind, unit_mm: f64) -> String {
    match kind {
        FixKind::Refillet {
            radius,
            arcs,
            moved,
        } => {
            let what = if *arcs == 1 {
                say!(arc).to_string()
            } else {
                say!(arcs, arcs)
            };
            say!(
                replace_the_by_one_of_r_mm,
                what,
                mm(radius * unit_mm),
                mm(moved * unit_mm)
            )
        }
        FixKind::KeepEndPoints { radius, kink } => say!(
            keep_the_end_points_change_only_the_bulge_to_r,
            mm(radius * unit_mm),
            kink.to_degrees()
        ),
        FixKind::Fillet { radius } => {
            say!(round_the_corner_with_r_mm, mm(radius * unit_mm))
        }
        FixKind::Close { length: 0.0 } => say!(close_the_contour).into(),
        FixKind::Close { length } => {
            say!(close_the_contour_with_a_line_of_mm, mm(length * unit_mm))
        }
        FixKind::Snap { distance } => say!(snap_the_ends_together_moves, mm(distance * unit_mm)),
        FixKind::DeleteDouble => say!(delete_the_double).into(),
        FixKind::DeletePoint => say!(delete_what_has_no_length).into(),
        FixKind::Merge => say!(remove_the_short_segment_its_neighbours_meet).into(),
        FixKind::MakeTangent { moved } => {
            say!(make_the_segments_tangent_moves, mm(moved * unit_mm))
        }
        FixKind::SetJ { j } => say!(set_j_to, j),
        FixKind::SetEnd { axis, value } => say!(set_to, axis.letter(), value),
        FixKind::SetAxis { axis, j: None } => say!(count_g, axis.letter()),
        FixKind::SetAxis { axis, j: Some(j) } => say!(count_g_j, axis.letter(), j),
        FixKind::SetMotion { name } => say!(set_z_to, name),
        FixKind::SetCoordinates { at: [x, y] } => {
            say!(set_the_coordinates_to_where_the_block, x, y)
        }
        FixKind::FollowCoordinates => say!(change_the_block_to_end_at_its_coordinates).into(),
        FixKind::ExchangeXAndY => say!(exchange_x_and_y).into(),
        FixKind::RestoreBlock { block } => {
            say!(
                write_the_block_as,
                block.split_whitespace().collect::<String>()
            )
        }
        FixKind::DeleteTwin => say!(delete_the_block_which_stands_twice).into(),
        FixKind::ExchangeBlocks => say!(exchange_the_two_blocks).into(),
        FixKind::InsertBlock { length, is_arc } => {
            say!(
                put_the_lost_of_mm_in,
                if *is_arc { say!(arc) } else { say!(line) },
                mm(*length)
            )
        }
        FixKind::InsertB => say!(put_the_lost_b_back).into(),
        FixKind::NumberWithN => say!(write_the_block_number_with_n).into(),
        FixKind::PlainLetters => say!(write_plain_letters_and_digits).into(),
        FixKind::DecimalPoints => say!(write_decimal_points).into(),
        FixKind::ZeroForO => say!(write_a_zero_for_the_letter_o).into(),
        FixKind::DeleteBlock => say!(delete_the_block).into(),
        FixKind::SplitBlock { pieces } => say!(split_the_block_into_that_fit, pieces),
        FixKind::SetNumber { number } => say!(number_the_block_n, number),
        FixKind::Renumber { first, step: 1 } => say!(number_all_blocks_from_n_on, first),
        FixKind::Renumber { first, step } => {
            say!(number_all_blocks_from_n_on_in_steps, first, step)
        }
        FixKind::AddEnd { word } => say!(end_the_program_with, word),
        FixKind::DeleteBehindEnd => say!(delete_what_stands_behind_the_end).into(),
        FixKind::CutRapid => say!(cut_there_g01_instead_of_the_rapid).into(),
        FixKind::SetCenter { radius, how } => match how {
            CenterFix::OtherConvention => {
                say!(take_i_and_j_as_other_controls_do, mm(*radius))
            }
            CenterFix::Sign => say!(put_the_sign_of_i_and_j_right, mm(*radius)),
            CenterFix::Swap => say!(swap_i_and_j_r, mm(*radius)),
            CenterFix::Nearest { moved } => say!(move_the_centre_by_mm, mm(*moved), mm(*radius)),
        },
        FixKind::Rewrite { found, meant } if meant.is_empty() => say!(delete, found),
        FixKind::Rewrite { found, meant } if found.is_empty() => say!(write, meant),
        FixKind::Rewrite { found, meant } => say!(write_for, meant, found),
        FixKind::InsertLine { block } => say!(insert_the_block, block),
        FixKind::SwapSide => say!(let_the_wire_run_on_the_other_side).into(),
        FixKind::OneArc { chords, radius } => say!(
            replace_the_chords_by_one_arc_of_r_mm,
            chords,
            mm(radius * unit_mm)
        ),
    }
}

/// A field that keeps a contour open, as far as can be known from the contour alone.
fn keeps_open(found: &str, meant: &str, is_sure: bool) -> String {
    if is_sure {
        return say!(keeps_the_contour_open_with, found, meant);
    }
    say!(may_be_wrong_the_contour_does, found, meant)
}

/// What is wrong in a program, and what comes of it at the machine.
fn program(fault: &Fault) -> String {
    let side_word = |side: &Side| match side {
        Side::Left => say!(g41_lets_the_wire_run_on_the_left),
        Side::Right => say!(g42_lets_the_wire_run_on_the_right),
    };
    match fault {
        Fault::MissingB => say!(a_b_of_the_block_is_missing_the_controller).into(),
        Fault::BlockNumberAsB { number } => {
            say!(b_stands_where_the_block_number, number)
        }
        Fault::LengthInJ {
            j,
            projection,
            axis,
        } => say!(
            j_is_the_length_of_the_line_the_controller_counts_its_projection_on,
            j,
            axis.letter(),
            projection
        ),
        Fault::WrongJ {
            j: 0,
            projection,
            axis,
        } => {
            say!(
                j_is_0_the_line_projection_on_is_um,
                axis.letter(),
                projection
            )
        }
        Fault::WrongJ {
            j,
            projection,
            axis,
        } => say!(
            j_is_not_the_line_projection_on_um,
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
            say!(j_is_more_than_one_turn_counts_um, j, turn)
        }
        Fault::SmallerProjection {
            axis,
            counted,
            larger,
        } => {
            say!(
                g_counts_the_smaller_projection_of_units,
                axis.letter(),
                counted,
                larger,
                axis.other().letter()
            )
        }
        Fault::ArcEndAxis { axis, x, y } => say!(
            g_does_not_fit_the_arc_end_at,
            axis.letter(),
            x,
            y,
            axis.other().letter()
        ),
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
            is_unusual_for_a_line_along,
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
                contradicts_a_line_along_expected,
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
        Fault::TwinKeepsOpen => say!(the_block_stands_twice_without).into(),
        Fault::ZeroBlock => say!(the_block_moves_nothing_its_j).into(),
        Fault::ArcWithoutRadius => say!(the_arc_has_no_radius).into(),
        Fault::TooManyDigits {
            field,
            value,
            digits,
        } => {
            say!(
                has_more_than_the_digits_that_the_controller_takes,
                field,
                value,
                digits
            )
        }
        Fault::NotClosed { x, y, .. } => say!(
            the_contour_does_not_close,
            mm(x.hypot(*y) / 1000.0),
            x / 1000.0,
            y / 1000.0
        ),
        Fault::MissingEnd { word } => {
            say!(the_program_has_no_end_expected, word)
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
            the_coordinates_behind_the_block_are_mm_from,
            mm(x.hypot(*y) / 1000.0),
            x / 1000.0,
            y / 1000.0
        ),
        Fault::PathCrossesItself { at: [x, y], other } => say!(
            the_wire_crosses_its_own_path_of_line_here_at,
            other + 1,
            x,
            y
        ),
        Fault::OffRadius { start, end } => {
            let (near, far) = told_apart(start / 1e3, end / 1e3);
            say!(the_ends_of_the_arc_are_not_on_one_circle, near, far)
        }
        Fault::NoRadius => say!(arc_without_a_radius_i).into(),
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
            say!(
                which_is_this_contour_the_settings,
                side_word(side),
                is,
                wanted
            )
        }
        Fault::EntrySide { side } => {
            say!(
                of_this_contour_but_it_comes_to_it_from_the_other_side,
                side_word(side)
            )
        }
        Fault::CutOpen { distance } => {
            say!(the_cut_does_not_close, mm(distance / 1e3))
        }
        Fault::BehindEnd => say!(text_behind_the_end_of_the_program).into(),
        Fault::Foreign { word, count: 1 } => {
            say!(is_a_matter_of_the_machine_it_is_kept_not, word)
        }
        Fault::Foreign { word, count } => {
            say!(times_is_a_matter_of_the_machine_it_is_kept, word, count)
        }
        Fault::NoSubprogram { number } => say!(subprogram_does_not_stand_in_this_text, number),
        Fault::EndlessCalls => say!(the_subprograms_call_each_other_without_end_or).into(),
        Fault::CenterOnLine => say!(i_and_j_stand_beside_a_straight_cut).into(),
        Fault::WordTwice { letter } => say!(stands_twice_in_this_line, letter),
        Fault::ReversedArc { is_sure: true } => say!(the_arc_runs_the_wrong_way_round).into(),
        Fault::ReversedArc { is_sure: false } => say!(the_arc_may_run_the_wrong_way_round).into(),
        Fault::Spur { length } => {
            say!(the_wire_goes_out_mm_and_back_on_the_same, mm(length / 1e3))
        }
        Fault::DoubledBlock { arc: true } => say!(the_block_stands_twice_the_wire).into(),
        Fault::DoubledBlock { arc: false } => say!(the_block_stands_twice_the_wire_is_there).into(),
        Fault::NoOffset { side } => {
            say!(and_nothing_says_by_how_much, side_word(side))
        }
        Fault::SideChange { side } => {
            say!(from_here_on_in_the_middle_of_the_cut, side_word(side))
        }
        Fault::StillOn => say!(the_program_ends_with_the_correction_on).into(),
        Fault::NoReturn { number } => {
            say!(subprogram_has_no_m99, number)
        }
        Fault::NoCorner => say!(the_word_for_a_corner_finds_none_here_or).into(),
        Fault::Bare { word, count: 1 } => {
            say!(has_no_decimal_point_the_other_numbers_have, word)
        }
        Fault::Bare { word, count } => say!(and_others_in_all_have_no_decimal, word, count),
        Fault::Pointed { word } => {
            say!(has_a_decimal_point_the_other_numbers_have_none, word)
        }
        Fault::Places { word, usual } => {
            say!(has_not_decimals_as_all_other_numbers, word, usual)
        }
        Fault::LooksLikeInches { size } => say!(the_program_does_not_say_its_unit, mm(*size)),
        Fault::UnknownValue { word } => {
            say!(
                hangs_on_a_place_of_the_control_table_that_the_program_does,
                word
            )
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
                (true, _) => say!(may_be_missing_here_with, meant, comes_of_it),
                (_, true) => say!(may_be_one_too_many, found, comes_of_it),
                _ => say!(may_be_wrong_with_here, found, comes_of_it, meant),
            }
        }
        Fault::OpenCenters => say!(full_circles_alone_do_not_tell_how).into(),
    }
}

/// What was left out, and why.
fn not_judged(what: &NotJudged) -> String {
    match what {
        NotJudged::Pairs { count } => say!(thousands_of_entities_lie_on_or_across_each, count),
        NotJudged::Crossings { blocks } => {
            say!(so_much_of_the_way_of_these_blocks_lies_on, blocks)
        }
        NotJudged::Reference {
            copies,
            segments,
            most,
        } => say!(
            this_insert_draws_copies_segments_in_all_more,
            copies,
            segments,
            most
        ),
        NotJudged::Curve { arcs, most } => say!(this_curve_would_take_arcs_more_than, arcs, most),
        NotJudged::Calls { lines, calls } => {
            say!(
                the_calls_of_subprograms_come_to_more_than_lines_or,
                lines,
                calls
            )
        }
    }
}

fn small_radius(numbers: &SmallRadius, unit_mm: f64) -> String {
    let (radius, required) = told_apart(numbers.radius * unit_mm, numbers.required * unit_mm);
    let pass = numbers
        .pass
        .map_or(String::new(), |pass| say!(of_pass, pass));
    let mut text = say!(arc_r_mm_is_below_the_correction_mm, radius, required, pass);
    if numbers.overcut * unit_mm >= 0.5e-6 {
        text += &say!(
            the_wire_overcuts_the_contour_by_mm,
            mm(numbers.overcut * unit_mm)
        );
        if numbers.stock_left.is_finite() {
            text += &say!(or_leaves_mm_where, mm(numbers.stock_left * unit_mm));
        }
    } else {
        text += say!(the_control_loses_the_arc);
    }
    match numbers.no_fix {
        None => {}
        Some(NoFix::NarrowSlot) => {
            text += &say!(
                no_arc_of_the_required_radius_fits_here,
                mm(2.0 * numbers.required * unit_mm)
            );
        }
        Some(NoFix::SealsContour) => text += say!(the_arc_that_fits_would_seal_the_slot),
        Some(NoFix::ShortSegment) => {
            text += say!(the_arc_that_fits_would_leave_a_segment_too_short)
        }
        Some(NoFix::Spoils) => text += say!(the_arc_that_fits_here_would_bring_another_fault),
        Some(NoFix::NoNeighbour) => text += say!(there_is_no_neighbour_on_both_sides_that_a_larger),
        Some(NoFix::Program) => text += say!(repair_it_in_the_drawing_and_make_the_program_again),
        Some(NoFix::NotEditable) => {
            text += say!(it_is_part_of_an_entity_that_cannot_be_edited_here)
        }
    }
    text
}

/// A length in mm with three decimals, or with as many as its first digit needs.
fn mm(length: f64) -> String {
    let places = if length != 0.0 && length.abs() < 0.0005 {
        6
    } else {
        3
    };
    format!("{length:.places$}")
}

/// Two lengths in mm with as many decimals as it takes to tell them apart, at least three.
fn told_apart(one: f64, other: f64) -> (String, String) {
    let digits = |places: usize| (format!("{one:.places$}"), format!("{other:.places$}"));
    (3..=9)
        .map(digits)
        .find(|(a, b)| a != b)
        .unwrap_or_else(|| digits(3))
}
