//! Reverse the direction in which contours are cut.
//!
//! ```text
//! B5000B0B5000GXL1           B5000B0B5000GXL1
//! B5000B0B10000GYNR1    →    B5000B0B10000GYSR4
//! B5000B0B10000GYNR3         B5000B0B10000GYSR2
//! B5000B0B5000GXL3           B5000B0B5000GXL3
//! ```
//!
//! Ways in and out stay. An open path is reversed where it is the whole program: it then begins at its other end.

use super::Refactoring;
use super::rewrite::{New, Rewrite, encoded};
use super::sheet::{Content, Sheet};
use crate::program::three_b::block::{Motion, Node, Quadrant};
use crate::program::three_b::encode::Encoded;
use crate::text::TextEdit;
use std::ops::Range;

pub const REVERSE: Refactoring = Refactoring {
    id: "refactor.rewrite.reverse",
    title: |_| "Reverse the direction of the contour".into(),
    rewrite: reverse,
};

fn reverse(sheet: &Sheet<'_>) -> Result<Vec<TextEdit>, String> {
    let content = sheet.content()?;
    let nodes = content.nodes()?;
    let mut rewrite = Rewrite {
        end: sheet.trace.end(),
        ..Rewrite::default()
    };
    for contour in sheet.selected_contours(content) {
        content.refuse_pause(contour)?;
        let rows = if contour.closed {
            contour.own_rows()
        } else if content.contours.len() == 1 {
            (rewrite.start, rewrite.end) = (nodes.last().map(|(_, to)| *to), sheet.trace.start);
            contour.rows.clone()
        } else {
            return Err(format!(
                "contour {} is open: what follows begins at its end",
                contour.ordinal
            ));
        };
        for (index, source) in rows.clone().zip(rows.rev()) {
            rewrite
                .rows
                .insert(index, reversed(content, source, nodes[source])?);
        }
    }
    rewrite.edits(sheet, content)
}

/// A row's blocks the other way.
fn reversed(content: &Content, index: usize, (from, to): (Node, Node)) -> Result<Vec<New>, String> {
    let row = &content.rows[index];
    let piece = content.piece_from(index, from).reversed();
    let Motion::Line(quadrant) = row.block.motion else {
        return encoded(&piece, to, from, row.part, index, content.largest);
    };
    // The same numbers into the opposite quadrant.
    let opposite = match quadrant {
        Quadrant::First => Quadrant::Third,
        Quadrant::Second => Quadrant::Fourth,
        Quadrant::Third => Quadrant::First,
        Quadrant::Fourth => Quadrant::Second,
    };
    let mut block = row.block;
    block.motion = Motion::Line(opposite);
    Ok(vec![New {
        encoded: Encoded {
            block,
            from: to,
            to: from,
            piece,
        },
        part: row.part,
        source: index,
        exact: true,
    }])
}

/// The blocks of some rows in their own order, as they stand.
pub(super) fn kept(content: &Content, rows: Range<usize>, nodes: &[(Node, Node)]) -> Vec<New> {
    let keep = |index: usize| {
        let (row, (from, to)) = (&content.rows[index], nodes[index]);
        New {
            encoded: Encoded {
                block: row.block,
                from,
                to,
                piece: content.piece_from(index, from),
            },
            part: row.part,
            source: index,
            exact: true,
        }
    };
    rows.map(keep).collect()
}
