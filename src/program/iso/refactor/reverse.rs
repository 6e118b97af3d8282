//! Reverse the direction in which closed contours are cut; the wire stays on its side of the part.
//!
//! ```text
//! G41 D1                     G42 D1
//! G01 X5 Y0                  G01 X5 Y0
//! G03 X-5 Y0 I-5 J0     →    G02 X-5 Y0 I-5 J0
//! G03 X5 Y0 I5 J0            G02 X5 Y0 I5 J0
//! ```
//!
//! Ways in and out stay.

use super::Refactoring;
use super::rewrite::{Rewrite, Target, swapped_sides};
use super::sheet::Sheet;
use super::taper::{Words, refuse_anywhere};
use crate::finding::Side;
use crate::program::iso::block::Motion;
use crate::text::TextEdit;

pub const REVERSE: Refactoring = Refactoring {
    id: "refactor.rewrite.reverse",
    title: "Reverse the direction of the contour",
    rewrite: reverse,
};

fn reverse(sheet: &Sheet<'_>) -> Result<Vec<TextEdit>, String> {
    let content = sheet.content()?;
    refuse_anywhere(sheet.document, Words::All)?;
    let reading = sheet.document.reading();
    let mut rewrite = Rewrite::default();
    for contour in sheet.selected_contours(content) {
        let own = content.closed(contour)?;
        for (index, source) in own.clone().zip(own.clone().rev()) {
            let made = content.rows[source].made;
            let motion = match made.motion {
                Motion::Clockwise => Motion::CounterClockwise,
                Motion::CounterClockwise => Motion::Clockwise,
                straight => straight,
            };
            rewrite.rows.insert(
                index,
                Target {
                    motion,
                    to: made.from,
                    ..Target::of(&made, reading)
                },
            );
        }
        // The correction's word stands before the way in.
        let before = contour
            .steps
            .start
            .checked_sub(1)
            .map_or(0, |row| content.rows[row].line + 1);
        let last = content.rows[own.end - 1].line;
        let words = swapped_sides(sheet.document, before..last + 1);
        if words.is_empty()
            && content.rows[contour.steps.clone()]
                .iter()
                .any(|row| row.made.side.is_some())
        {
            return Err("the correction was switched on for another contour before".into());
        }
        rewrite.words.extend(words);
        for index in contour.steps.clone() {
            let row = &content.rows[index];
            let target = rewrite
                .rows
                .entry(index)
                .or_insert_with(|| Target::of(&row.made, reading));
            target.side = row.made.side.map(Side::reversed);
        }
    }
    rewrite.edits(sheet, content)
}
