//! The form of a block, and which of its parts the cursor is in.

use crate::ide::Signature;
use crate::program::three_b::Document;
use crate::program::three_b::pieces::{Field, pieces};

/// The form of the block that is written at a byte; `None` where there is none.
pub(crate) fn signature(document: &Document, offset: usize) -> Option<Signature> {
    let text = document.text();
    let line = text.line_range(text.line_of(offset));
    let bytes = text.bytes().get(line.clone())?;
    let cursor = offset.clamp(line.start, line.end) - line.start;
    let all = pieces(bytes, &document.words());
    let is_four_b = all.iter().any(|piece| piece.field == Field::Radius);
    let last = all.iter().rfind(|piece| piece.range.start < cursor)?;
    let separators = all
        .iter()
        .take_while(|piece| piece.range.start < cursor)
        .filter(|piece| piece.field == Field::Separator)
        .count();
    let inside = cursor <= last.range.end;
    let part = match last.field {
        Field::Separator | Field::X | Field::Y | Field::J | Field::Radius => {
            separators.checked_sub(1)?.min(3)
        }
        Field::Axis if inside => 4,
        Field::Axis | Field::Convexity if is_four_b => {
            5 + usize::from(last.field == Field::Convexity && !inside)
        }
        Field::Axis => 6,
        Field::Motion if inside => 6,
        Field::Strange if separators >= 3 => 4,
        _ => return None,
    };
    // Parts of 4B; 3B lacks the radius and the side.
    let (label, active) = if is_four_b {
        ("B X B Y B J B R G D Z", part)
    } else {
        let active = match part {
            6 => 4,
            4 | 5 => 3,
            part => part.min(2),
        };
        ("B X B Y B J G Z", active)
    };
    let parameters = label.split(' ').filter(|word| *word != "B");
    Some(Signature {
        label,
        parameters: parameters.map(|name| (name, about(name))).collect(),
        active,
    })
}

fn about(name: &str) -> &'static str {
    match name {
        "X" => say!(x_of_a_block),
        "Y" => say!(y_of_a_block),
        "J" => say!(j_of_a_block),
        "R" => say!(r_of_a_block),
        "G" => say!(g_of_a_block),
        "D" => say!(d_of_a_block),
        _ => say!(z_of_a_block),
    }
}
