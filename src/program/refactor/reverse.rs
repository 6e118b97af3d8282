//! Reverse the direction in which contours are cut; under a correction the wire stays on its side of the part.
//!
//! ```text
//! B5000B0B5000GXL1           B5000B0B5000GXL1          G41 D1                      G42 D1
//! B5000B0B10000GYNR1    →    B5000B0B10000GYSR4        G01 X5 Y0                   G01 X5 Y0
//! B5000B0B10000GYNR3         B5000B0B10000GYSR2        G03 X-5 Y0 I-5 J0     →     G02 X-5 Y0 I-5 J0
//! B5000B0B5000GXL3           B5000B0B5000GXL3          G03 X5 Y0 I5 J0             G02 X5 Y0 I5 J0
//! ```
//!
//! Ways in and out stay where they are one way, there and back; leads that part (arcs that run along the contour at its
//! start, an overlap) are reversed with it. An open path that counts is reversed where it is the whole program: it then begins at its other end.

use super::{Change, Content, Edits, Notation, Refactoring, Rewrite, Sheet};
use crate::program::path::{Cut, tolerance};
use std::ops::Range;

pub(super) fn reverse<N: Notation>() -> Refactoring<N> {
    Refactoring {
        id: "refactor.rewrite.reverse",
        title: |_| say!(reverse_the_direction_of_the_contour).into(),
        rewrite: reversed,
    }
}

fn reversed<N: Notation>(sheet: &Sheet<'_, N>) -> Edits {
    let content = sheet.content()?;
    N::refuse(sheet, Change::Reverse)?;
    let mut rewrite = Rewrite::new();
    for contour in sheet.selected_contours(content) {
        let is_all = content.contours.len() == 1 && !sheet.trace.writing.names_places;
        let rows = if is_all && !contour.closed {
            content.refuse_pause(contour)?;
            rewrite.start = content.rows.last().map(|row| row.to);
            rewrite.end = Some(sheet.trace.start);
            contour.steps.clone()
        } else {
            with_leads(content, contour, content.closed(contour)?)
        };
        for (place, row) in rows.clone().zip(rows.clone().rev()) {
            let reversed = N::reversed(sheet.at(content, row))?;
            rewrite.rows.insert(place, reversed);
        }
        N::turn_round(sheet, content, contour, rows, &mut rewrite)?;
    }
    rewrite.edits(sheet, content)
}

/// The rows of a contour, with its leads where these differ but come back to one place, else
/// without them.
fn with_leads<N: Notation>(content: &Content<N>, contour: &Cut, own: Range<usize>) -> Range<usize> {
    let (rows, all) = (&content.rows, contour.steps.clone());
    let [leads_in, leads_out] = [&rows[all.start..own.start], &rows[own.end..all.end]];
    let (Some(first), Some(last)) = (leads_in.first(), leads_out.last()) else {
        return own;
    };
    let place = |node| Content::<N>::point(node);
    let near = tolerance(content.arcs());
    let mut both = leads_in.iter().zip(leads_out.iter().rev());
    let is_one_way = leads_in.len() == leads_out.len()
        && both.all(|(there, back)| {
            let middles = [&there.piece, &back.piece].map(|piece| piece.point_at(0.5));
            (middles[0] - middles[1]).norm() <= 2.0 * near
        });
    let comes_back = match content.names_places {
        true => first.from == last.to,
        false => (place(first.from) - place(last.to)).norm() <= near,
    };
    if is_one_way || !comes_back { own } else { all }
}
