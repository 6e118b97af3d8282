//! The form of a block, and which of its parts the cursor is in.

use crate::ide::program::Signature;
use crate::program::three_b::Document;
use crate::program::three_b::pieces::{Field, pieces};

const THREE_B: &[(&str, &str)] = &[
    (
        "X",
        "µm without sign: of a line its end from its start, of an arc its start from its centre",
    ),
    ("Y", "µm without sign, as X"),
    (
        "J",
        "counting length in µm: the block's projection on the axis that G names, of an arc added up between the axis crossings",
    ),
    (
        "G",
        "counting axis, `GX` or `GY`: of a line its larger component, of an arc the axis that its end lies further from",
    ),
    (
        "Z",
        "`L1` to `L4` line, `NR1` to `NR4` counter-clockwise, `SR1` to `SR4` clockwise; the number is the quadrant of the line's direction or of the arc's start",
    ),
];

const FOUR_B: &[(&str, &str)] = &[
    THREE_B[0],
    THREE_B[1],
    THREE_B[2],
    ("R", "radius of the arc in µm"),
    THREE_B[3],
    (
        "D",
        "`D` convex, `DD` concave: whether the correction makes the arc larger or smaller",
    ),
    THREE_B[4],
];

/// The form of the block that is written at a byte; `None` where none is.
pub fn signature(document: &Document, offset: usize) -> Option<Signature> {
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
    let (label, parameters, active) = if is_four_b {
        ("B X B Y B J B R G D Z", FOUR_B, part)
    } else {
        let active = match part {
            6 => 4,
            4 | 5 => 3,
            part => part.min(2),
        };
        ("B X B Y B J G Z", THREE_B, active)
    };
    Some(Signature {
        label,
        parameters,
        active,
    })
}
