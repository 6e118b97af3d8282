//! What a word of a block means: X and Y of a line and of an arc, the counting length, the axis, the quadrant.

use crate::program::three_b::Document;
use crate::program::three_b::block::{Block, CountingAxis, Motion};
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::pieces::{Field, pieces};
use std::ops::Range;

/// What the word at a range of bytes says in its block, in Markdown; `None` for what means nothing.
pub fn meaning(document: &Document, word: Range<usize>) -> Option<String> {
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
    Some(match field {
        Field::Number => "**N** block number: it has no meaning for the path".into(),
        Field::Separator => "**B** leads each number of a block: `B` X `B` Y `B` J `G` Z".into(),
        Field::X | Field::Y => {
            let name = if field == Field::X { "X" } else { "Y" };
            match is_line {
                Some(true) => {
                    format!("**{name}** of a line: how far its end lies from its start along {name}, µm without sign; Z has the sign")
                }
                Some(false) => {
                    format!("**{name}** of an arc: how far its start lies from its centre along {name}, µm without sign; Z has the sign")
                }
                None => format!("**{name}** µm without sign: of a line its end from its start, of an arc its start from its centre"),
            }
        }
        Field::J => {
            let axis = holder.map_or("counting axis", |block| if block.axis == CountingAxis::X { "X axis" } else { "Y axis" });
            let way = match is_line {
                Some(true) => "the line's projection",
                Some(false) => "the arc's projections between the axis crossings, added up",
                None => "the block's projection",
            };
            format!("**J** counting length, µm: {way} on the {axis}. The controller counts it down and stops at 0")
        }
        Field::Radius => "**R** radius of a 4B arc, µm: the controller adds or takes off its correction".into(),
        Field::Axis => {
            let axis = holder.map_or("X or Y", |block| if block.axis == CountingAxis::X { "X" } else { "Y" });
            let rule = match is_line {
                Some(true) => "the larger component of a line",
                Some(false) => "of an arc, the axis that its end lies further from",
                None => "of a line its larger component, of an arc the axis that its end lies further from",
            };
            format!("**G{}** the controller counts steps along {axis}: {rule}", if axis.len() == 1 { axis } else { "" })
        }
        Field::Convexity => "**D** convex, **DD** concave: whether the correction makes a 4B arc larger or smaller".into(),
        Field::Motion => about_motion(holder?.motion),
        Field::Pause => "**pause**: the machine stops, so that the wire can be cut or threaded".into(),
        Field::End => "**end** of the program".into(),
        Field::Coordinates => "where the block ends, absolute, mm: only for the reader, the controller passes it over".into(),
        Field::StartPoint => "where the program begins, absolute, mm: only for the reader, the controller passes it over".into(),
        Field::Comment | Field::Strange => return None,
    })
}

fn about_motion(motion: Motion) -> String {
    match motion {
        Motion::Line(quadrant) => {
            let way = [
                "+X, or up to the right",
                "+Y, or up to the left",
                "−X, or down to the left",
                "−Y, or down to the right",
            ];
            let number = quadrant.number();
            format!(
                "**L{number}** line into quadrant {number}: {}",
                way[usize::from(number) - 1]
            )
        }
        Motion::Clockwise(quadrant) => {
            let number = quadrant.number();
            format!(
                "**SR{number}** clockwise arc that starts in quadrant {number} about its centre"
            )
        }
        Motion::CounterClockwise(quadrant) => {
            let number = quadrant.number();
            format!(
                "**NR{number}** counter-clockwise arc that starts in quadrant {number} about its centre"
            )
        }
    }
}
