//! The titles of fixes.

use super::lengths::mm;
use super::{Aside, CenterFix, FixKind};

/// The title of a fix, for its code action.
pub(crate) fn title(kind: &FixKind, unit_mm: f64) -> String {
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
                replace_arcs_by_one_of_r,
                what,
                mm(radius * unit_mm),
                mm(moved * unit_mm)
            )
        }
        FixKind::KeepEndPoints { radius, kink } => say!(
            change_only_the_bulge,
            mm(radius * unit_mm),
            kink.to_degrees()
        ),
        FixKind::Fillet { radius } => {
            say!(round_the_corner_with_r_mm, mm(radius * unit_mm))
        }
        FixKind::FitCorner {
            radius,
            other: None,
        } => {
            say!(
                give_the_corner_the_least_radius_that_fits,
                mm(radius * unit_mm)
            )
        }
        FixKind::FitCorner {
            radius,
            other: Some(other),
        } => say!(
            give_both_corners_radii_that_fit,
            mm(radius * unit_mm),
            mm(other * unit_mm)
        ),
        FixKind::Close { length: 0.0 } => say!(close_the_contour).into(),
        FixKind::Close { length } => {
            say!(close_the_contour_with_a_line_of_mm, mm(length * unit_mm))
        }
        FixKind::Snap { distance } => say!(snap_the_ends_together, mm(distance * unit_mm)),
        FixKind::DeleteDouble => say!(delete_the_double).into(),
        FixKind::DeletePoint => say!(delete_what_has_no_length).into(),
        FixKind::Merge => say!(remove_the_short_segment_its_neighbours_meet).into(),
        FixKind::MakeTangent { moved } => {
            say!(make_the_segments_tangent, mm(moved * unit_mm))
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
                put_the_lost_block_in,
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
            CenterFix::Nearest { moved } => say!(move_the_centre, mm(*moved), mm(*radius)),
        },
        FixKind::Rewrite { found, meant } if meant.is_empty() => say!(delete, found),
        FixKind::Rewrite { found, meant } if found.is_empty() => say!(write, meant),
        FixKind::Rewrite { found, meant } => say!(write_for, meant, found),
        FixKind::InsertLine { block } => say!(insert_the_block, block),
        FixKind::CutAllTheSame {
            why: Aside::Linetype(name),
        } => say!(cut_what_is_drawn_in_a_linetype, name),
        FixKind::CutAllTheSame {
            why: Aside::Layer(name),
        } => say!(cut_what_lies_on_a_layer, name),
        FixKind::CutAllTheSame { why: Aside::Lone } => say!(cut_the_lone_lines).into(),
        FixKind::Suppress { rule } => say!(suppress_here_with_a_reason, rule.name()),
        FixKind::IgnoreLayer { layer } => say!(ignore_the_layer, layer),
        FixKind::SwapSide => say!(let_the_wire_run_on_the_other_side).into(),
        FixKind::OneArc { chords, radius } => say!(
            replace_the_chords_by_one_arc_of_r_mm,
            chords,
            mm(radius * unit_mm)
        ),
    }
}
