//! The sentence of a finding: its numbers in the units that people read, in the words of [`crate::message`].

use super::lengths::{absurd, mm, told_apart};
use super::program_sentence::program;
use super::{
    Aside, Cause, Detail, Finding, NoFix, NotJudged, Rule, SetAside, SmallRadius, Unlike,
    Unwritable,
};
use crate::drawing::Visibility;
use crate::message::readable;

/// The subject of a finding: a plain number is the unit of a drawing for the wire.
#[derive(Clone, Copy, Debug)]
pub struct Telling {
    /// mm of the drawing's unit.
    pub unit_mm: f64,
    /// An electrode cuts, not a wire.
    pub mills: bool,
}

impl From<f64> for Telling {
    fn from(unit_mm: f64) -> Telling {
        Telling {
            unit_mm,
            mills: false,
        }
    }
}

impl Telling {
    /// The cutting tool, within a sentence.
    fn tool(self) -> &'static str {
        match self.mills {
            true => say!(the_electrode_that_mills),
            false => say!(the_wire_that_cuts),
        }
    }
}

/// The sentence of a finding, for a person: lower-case, no final dot.
///
/// Names from the drawing in it are made `readable`.
pub fn sentence(finding: &Finding, telling: impl Into<Telling>) -> String {
    readable(&said(finding, telling.into())).into_owned()
}

fn said(finding: &Finding, telling: Telling) -> String {
    let (unit_mm, tool) = (telling.unit_mm, telling.tool());
    match &finding.detail {
        Detail::SmallRadius(numbers) => small_radius(numbers, telling),
        Detail::UnsupportedEntity {
            kind,
            count: 1,
            why,
        } => say!(is_not_cut, kind, why),
        Detail::UnsupportedEntity { kind, count, why } => {
            say!(of_them_is_not_cut, kind, count, why)
        }
        Detail::SetAside(parts) => set_aside(parts),
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
            a_sharp_corner_that_the_wire_runs_inside,
            turn.abs().to_degrees(),
            mm(radius * unit_mm),
            tool
        ),
        Detail::SharpCorner {
            radius,
            count: Some(count),
            ..
        } => {
            say!(
                sharp_corners_that_the_wire_runs_inside,
                count,
                mm(radius * unit_mm),
                tool
            )
        }
        Detail::NarrowSlot { width, required } => {
            let (width, required) = told_apart(width * unit_mm, required * unit_mm);
            say!(the_slot_is_too_narrow, width, required, tool)
        }
        Detail::LostPocket { .. } => say!(the_offset_loses_this_part_of_the_outline, tool),
        Detail::DeadEnd { uncut, .. } => {
            say!(
                the_wire_does_not_reach_this_part_of_the_outline,
                mm(uncut * unit_mm),
                tool
            )
        }
        Detail::DoesNotFit(misfit) => {
            let [depth, wanted] =
                [-misfit.clearance, misfit.wanted].map(|length| length * unit_mm * 1e3);
            let (of, partner) = (&misfit.of, &misfit.partner);
            match &misfit.cause {
                Cause::Corner(corner_of) => {
                    say!(the_parts_bind_here, of, partner, depth, corner_of, wanted)
                }
                Cause::Radii(radii) => {
                    let [own, other] = radii.map(|radius| mm(radius * unit_mm));
                    say!(
                        the_parts_bind_along_an_arc,
                        of,
                        partner,
                        depth,
                        own,
                        other,
                        wanted
                    )
                }
                Cause::Wall => say!(the_parts_bind_along_a_wall, of, partner, depth, wanted),
            }
        }
        Detail::NoPartner { of, missing } => {
            let sentence = say!(the_contour_has_no_partner, of);
            match missing.is_empty() {
                true => sentence,
                false => sentence + &say!(nothing_is_drawn_of, missing.join(", ")),
            }
        }
        Detail::OffsetCollapse {
            required,
            point: true,
        } => say!(a_point_is_left_of_the_outline, mm(required * unit_mm), tool),
        Detail::UnprovedPath { .. } => say!(no_path_of_the_wire_along_this_contour_holds, tool),
        Detail::OffsetCollapse {
            required,
            point: false,
        } => {
            say!(nothing_is_left_of_the_outline, mm(required * unit_mm), tool)
        }
        Detail::Unwritable(what) => unwritable(what),
        Detail::OpenContour { distance } => {
            say!(contour_is_open_its_ends_are_mm, mm(distance * unit_mm))
        }
        Detail::Gap { distance } => say!(ends_do_not_meet, mm(distance * unit_mm)),
        Detail::DuplicateEntity { count: 1 } => {
            say!(entity_lies_in_the_same_place_as_another, tool)
        }
        Detail::DuplicateEntity { count } => {
            say!(entities_of_the_outline_lie_there_twice, count, tool)
        }
        Detail::Overlap { length } => {
            say!(segment_runs_on_another_one_over_mm, mm(length * unit_mm))
        }
        Detail::NotJudged(what) => not_judged(what),
        Detail::ShortSegment { length: 0.0 } => say!(segment_has_no_length).into(),
        Detail::ShortSegment { length } => say!(the_segment_is_too_short, mm(length * unit_mm)),
        Detail::NearTangent { turn } => {
            say!(contour_kinks_by_degrees, turn.abs().to_degrees(), tool)
        }
        Detail::SelfIntersection { touches, count, .. } if *count > 1 => {
            say!(
                the_wire_would_cut_into_the_part_each_time,
                if *touches {
                    say!(touches_itself_or_another)
                } else {
                    say!(crosses_itself_or_another)
                },
                count,
                tool
            )
        }
        Detail::SelfIntersection { touches, .. } => {
            say!(
                the_wire_would_cut_into_the_part,
                if *touches {
                    say!(touches_itself_or_another)
                } else {
                    say!(crosses_itself_or_another)
                },
                tool
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
                chords_lie_on_one_arc,
                chords,
                mm(radius * unit_mm),
                within,
                tool
            )
        }
        Detail::Size { size } => {
            let what = absurd(size * unit_mm);
            say!(the_size_of_the_part_is_absurd, mm(size * unit_mm), what)
        }
        Detail::Program(fault) => program(fault),
        Detail::More { count } => say!(more_findings_are_not_shown, count),
        Detail::NotTheDrawing(what) => unlike(what, unit_mm),
        Detail::Said(sentence) => sentence.clone(),
    }
}

fn unlike(what: &Unlike, unit_mm: f64) -> String {
    match what {
        Unlike::Block {
            other,
            handle,
            segment,
            off,
        } => say!(
            the_block_does_not_follow_its_drawing,
            segment,
            handle,
            other,
            mm(*off)
        ),
        Unlike::Moved { other, handle, off } => {
            say!(
                the_contour_does_not_begin_where_its_drawing_has_it,
                handle,
                other,
                mm(*off)
            )
        }
        Unlike::Unfinished {
            other,
            handle,
            segment,
        } => say!(
            the_contour_is_left_before_it_is_cut_all_round,
            segment,
            handle,
            other
        ),
        Unlike::Foreign { other } => say!(no_contour_of_the_drawing_is_like_this, other),
        Unlike::Lead { other, off } => {
            say!(
                the_way_does_not_lead_where_its_drawing_has_it,
                other,
                mm(*off)
            )
        }
        Unlike::Stated { other, off } => say!(
            the_coordinates_are_not_where_its_drawing_has_the_end,
            other,
            mm(*off)
        ),
        Unlike::Segment { other, line, off } => {
            say!(
                the_program_does_not_follow_this_segment,
                other,
                line,
                mm(off * unit_mm)
            )
        }
        Unlike::Begin { other, line, off } => {
            say!(
                the_program_begins_this_contour_elsewhere,
                other,
                line,
                mm(off * unit_mm)
            )
        }
        Unlike::Left { other, line } => {
            say!(
                the_program_leaves_this_contour_before_this_segment,
                other,
                line
            )
        }
        Unlike::Nothing { other } => say!(nothing_is_like_the_other, other),
        Unlike::Milled { other } => say!(it_is_milled_otherwise, other),
        Unlike::Unreadable { other, reason } => {
            say!(it_is_not_held_against_its_other, other, reason)
        }
        Unlike::Several { other, more } => say!(it_is_held_against_the_first, other, more),
    }
}

fn unwritable(what: &Unwritable) -> String {
    match *what {
        Unwritable::TightArc {
            at: [x, y],
            radius,
            correction,
        } => say!(an_arc_that_4b_cannot_have, radius, x, y, correction),
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

/// The most names in a list.
const LISTED: usize = 8;

fn set_aside(parts: &[SetAside]) -> String {
    let count: usize = parts.iter().map(|part| part.count).sum();
    let entities = say!(entities, count);
    let are = if count == 1 { say!(is) } else { say!(are) };
    let mut said: Vec<String> = parts
        .iter()
        .take(LISTED)
        .map(|SetAside { why, count, .. }| match why {
            Aside::Linetype(name) => say!(in_a_linetype, count, name),
            Aside::Layer(name) => say!(on_a_layer, count, name),
            Aside::Lone if *count == 1 => say!(n1_lone_line).into(),
            Aside::Lone => say!(lone_lines, count),
        })
        .collect();
    let others: usize = parts.iter().skip(LISTED).map(|part| part.count).sum();
    if others > 0 {
        said.push(say!(others_of_them, others));
    }
    say!(drawn_to_be_read_and_not_cut, entities, are, said.join(", "))
}

fn unseen(layer: &str, visibility: Visibility, count: usize) -> String {
    let entities = say!(entities, count);
    let are = if count == 1 { say!(is) } else { say!(are) };
    let of_layer = |what: &str| say!(entities_of_a_layer_are_not_cut, layer, what, entities, are);
    match visibility {
        Visibility::Frozen => of_layer(say!(frozen)),
        Visibility::Off => of_layer(say!(switched_off)),
        Visibility::Invisible => say!(invisible_entities_are_not_cut, entities, are),
        Visibility::Unplotted | Visibility::Shown => {
            say!(
                entities_of_a_layer_that_is_not_plotted_are_cut,
                layer,
                entities,
                are
            )
        }
    }
}

/// The other place of a finding, in words.
pub(crate) fn related(
    finding: &Finding,
    handle: &str,
    segment: Option<usize>,
    telling: Telling,
) -> String {
    let handle = readable(handle);
    let place = segment.map_or_else(
        || handle.to_string(),
        |segment| say!(segment, handle, segment),
    );
    match finding.detail {
        Detail::DoesNotFit(ref misfit) => say!(its_partner, misfit.partner, place),
        Detail::NarrowSlot { .. } => say!(the_facing_wall, place),
        Detail::DeadEnd { .. } => say!(the_wire_comes_no_further_than_here, place, telling.tool()),
        Detail::DuplicateEntity { .. } => say!(the_same_place, place),
        Detail::Overlap { .. } => say!(runs_on_this_one, place),
        Detail::Said(_) if matches!(finding.rule, Rule::LeadIn | Rule::StartHole) => {
            say!(what_is_in_the_way, place)
        }
        Detail::SelfIntersection { touches: true, .. } => say!(touches_this_one, place),
        Detail::SelfIntersection { .. } => say!(crosses_this_one, place),
        Detail::SharpCorner { .. } | Detail::NearTangent { .. } => {
            say!(meets_this_one, place)
        }
        _ => say!(the_other_one, place),
    }
}

/// What was left out, and why.
fn not_judged(what: &NotJudged) -> String {
    match what {
        NotJudged::Pairs { count } => say!(thousands_of_entities_lie_on_each_other, count),
        NotJudged::Crossings { blocks } => {
            say!(so_much_of_the_way_lies_on_one_place, blocks)
        }
        NotJudged::Reference {
            copies,
            segments,
            most,
        } => say!(this_insert_draws_too_much, copies, segments, most),
        NotJudged::Curve { arcs, most } => say!(this_curve_would_take_too_many_arcs, arcs, most),
        NotJudged::Calls { lines, calls } => {
            say!(the_calls_of_subprograms_come_to_too_much, lines, calls)
        }
    }
}

fn small_radius(numbers: &SmallRadius, telling: Telling) -> String {
    let (unit_mm, tool) = (telling.unit_mm, telling.tool());
    let (radius, required) = told_apart(numbers.radius * unit_mm, numbers.required * unit_mm);
    let pass = numbers
        .pass
        .map_or(String::new(), |pass| say!(of_pass, pass));
    let mut text = say!(arc_r_mm_is_below_the_correction_mm, radius, required, pass);
    if numbers.taken_by_skims {
        text += &match numbers.stock_left.is_finite() {
            true => say!(
                the_later_passes_find_mm_more_stock,
                mm(numbers.stock_left * unit_mm)
            ),
            false => say!(the_later_passes_find_more_stock).into(),
        };
    } else if numbers.overcut * unit_mm >= 0.5e-6 {
        text += &say!(
            the_wire_overcuts_the_contour_by_mm,
            mm(numbers.overcut * unit_mm),
            tool
        );
        if numbers.stock_left.is_finite() {
            text += &say!(or_leaves_stock, mm(numbers.stock_left * unit_mm));
        }
    } else {
        text += say!(the_control_loses_the_arc);
    }
    match numbers.no_fix {
        None => {}
        Some(NoFix::NarrowSlot) => {
            text += &say!(
                no_arc_of_the_required_radius_fits_here,
                mm(2.0 * numbers.required * unit_mm),
                tool
            );
        }
        Some(NoFix::SealsContour) => text += say!(the_arc_that_fits_would_seal_the_slot),
        Some(NoFix::ShortSegment) => {
            text += say!(the_arc_that_fits_would_leave_a_segment_too_short)
        }
        Some(NoFix::Spoils) => text += say!(the_arc_that_fits_here_would_bring_another_fault),
        Some(NoFix::NoNeighbour) => text += say!(no_neighbours_for_a_larger_arc),
        Some(NoFix::Program) => text += say!(repair_it_in_the_drawing_and_make_the_program_again),
        Some(NoFix::NotEditable) => {
            text += say!(it_is_part_of_an_entity_that_cannot_be_edited_here)
        }
    }
    text
}
