//! The meaning of a word of a block: X and Y of a line and of an arc, the counting length, the axis, the quadrant.

use crate::program::three_b::Document;
use crate::program::three_b::block::{Block, CountingAxis, Motion, Quadrant};
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::pieces::{Field, pieces};
use std::ops::Range;

/// The meaning of the word at a range of bytes in its block, in Markdown; `None` for a word without one.
pub(crate) fn meaning(document: &Document, word: Range<usize>) -> Option<String> {
    let text = document.text();
    let line = text.line_range(text.line_of(word.start));
    let bytes = text.bytes().get(line.clone())?;
    let field = pieces(bytes, &document.words())
        .into_iter()
        .find(|piece| line.start + piece.range.start == word.start)?
        .field;
    let mut holder: Option<Block> = None;
    read_line(bytes, line.start, &document.words(), |item| {
        if let Item::Block { block, range, .. } = item
            && range.start <= word.start
            && word.end <= range.end
        {
            holder = Some(block);
        }
    });
    let is_line = holder.map(|block| matches!(block.motion, Motion::Line(_)));
    let axis = holder.map(|block| block.axis);
    Some(match field {
        Field::Number => say!(number_without_meaning_for_the_path).into(),
        Field::Separator => say!(b_leads_each_number).into(),
        Field::X | Field::Y => {
            let name = if field == Field::X { "X" } else { "Y" };
            match is_line {
                Some(true) => say!(coordinate_of_a_line, name),
                Some(false) => say!(coordinate_of_an_arc, name),
                None => say!(coordinate_without_sign, name),
            }
        }
        Field::J => {
            let projection = match is_line {
                Some(true) => say!(the_projection_of_the_line),
                Some(false) => say!(the_projections_of_the_arc),
                None => say!(the_projection_of_the_block),
            };
            let axis = match axis {
                Some(CountingAxis::X) => say!(x_axis),
                Some(CountingAxis::Y) => say!(y_axis),
                None => say!(counting_axis),
            };
            say!(counting_length_of_a_block, projection, axis)
        }
        Field::Radius => say!(radius_of_a_4b_arc).into(),
        Field::Axis => {
            let rule = match is_line {
                Some(true) => say!(the_larger_component_of_a_line),
                Some(false) => say!(the_further_axis_of_the_end_of_an_arc),
                None => say!(the_axis_of_a_line_and_of_an_arc),
            };
            let (letter, axis) = match axis {
                Some(CountingAxis::X) => ("X", "X"),
                Some(CountingAxis::Y) => ("Y", "Y"),
                None => ("", say!(x_or_y)),
            };
            say!(the_controller_counts_along, letter, axis, rule)
        }
        Field::Convexity => say!(convex_or_concave).into(),
        Field::Motion => match holder?.motion {
            Motion::Line(quadrant) => {
                let way = match quadrant {
                    Quadrant::First => say!(right_or_up_to_the_right),
                    Quadrant::Second => say!(up_or_up_to_the_left),
                    Quadrant::Third => say!(left_or_down_to_the_left),
                    Quadrant::Fourth => say!(down_or_down_to_the_right),
                };
                say!(line_into_quadrant, quadrant.number(), way)
            }
            Motion::Clockwise(quadrant) => say!(clockwise_arc_from_quadrant, quadrant.number()),
            Motion::CounterClockwise(quadrant) => {
                say!(counter_clockwise_arc_from_quadrant, quadrant.number())
            }
        },
        Field::Pause => say!(the_machine_stops_to_cut_or_thread_the_wire).into(),
        Field::End => say!(the_end_of_the_program).into(),
        Field::Coordinates => say!(where_the_block_ends_for_the_reader).into(),
        Field::StartPoint => say!(where_the_program_begins_for_the_reader).into(),
        Field::Comment | Field::Strange => return None,
    })
}
