//! Reverse the direction in which contours are cut; under a correction the wire stays on its side of the part.
//!
//! ```text
//! B5000B0B5000GXL1           B5000B0B5000GXL1          G41 D1                      G42 D1
//! B5000B0B10000GYNR1    →    B5000B0B10000GYSR4        G01 X5 Y0                   G01 X5 Y0
//! B5000B0B10000GYNR3         B5000B0B10000GYSR2        G03 X-5 Y0 I-5 J0     →     G02 X-5 Y0 I-5 J0
//! B5000B0B5000GXL3           B5000B0B5000GXL3          G03 X5 Y0 I5 J0             G02 X5 Y0 I5 J0
//! ```
//!
//! Ways in and out stay. An open path that counts is reversed where it is the whole program: it then begins at its other end.

use super::{Change, Edits, Notation, Refactoring, Rewrite, Sheet};

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
            content.closed(contour)?
        };
        for (place, row) in rows.clone().zip(rows.clone().rev()) {
            let reversed = N::reversed(sheet.at(content, row))?;
            rewrite.rows.insert(place, reversed);
        }
        N::turn_round(sheet, content, contour, rows, &mut rewrite)?;
    }
    rewrite.edits(sheet, content)
}
