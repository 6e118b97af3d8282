//! Coordinates that are absolute (G90), or that count from where the wire stands (G91).
//!
//! ```text
//! G90                        G91
//! G01 X5. Y0.           →    G01 X5. Y0.
//! X5. Y3.                    X0. Y3.
//! ```

use super::Iso;
use crate::program::iso::plain::words_at;
use crate::program::iso::taper::{Words, refuse_anywhere};
use crate::program::refactor::{Edits, Refactoring, Rewrite, Sheet};
use crate::text::TextEdit;

pub(super) const ABSOLUTE: Refactoring<Iso> = Refactoring {
    id: "refactor.rewrite.coordinates.absolute",
    title: |_| say!(make_all_coordinates_absolute_g90).into(),
    rewrite: |sheet| converted(sheet, false),
};
pub(super) const INCREMENTAL: Refactoring<Iso> = Refactoring {
    id: "refactor.rewrite.coordinates.incremental",
    title: |_| say!(let_all_coordinates_count_from_where_the_wire_stands).into(),
    rewrite: |sheet| converted(sheet, true),
};

fn converted(sheet: &Sheet<'_, Iso>, incremental: bool) -> Edits {
    let content = sheet.content()?;
    if content
        .rows
        .iter()
        .all(|row| row.own.made.incremental == incremental)
    {
        return Ok(Vec::new());
    }
    refuse_anywhere(sheet.document, Words::Guide)?;
    let (text, old) = (sheet.document.text(), sheet.document.reading());
    // An absolute centre is meaningless under G91.
    let rule = if incremental {
        old.absolute
    } else {
        old.incremental
    };
    let reading = old.with_rule(rule);
    let word = if incremental { "G91" } else { "G90" };
    let mut rewrite = Rewrite::<Iso>::new();
    rewrite.extra.reading = Some(reading);
    let first = content.rows.first().map_or(0, |row| row.line);
    let mut stands = false;
    for line in 0..text.line_count() {
        words_at(text, line, |letter, number, range| {
            let is_other = number.mantissa == if incremental { 90 } else { 91 };
            if letter == b'G' && is_other && number.decimals == 0 {
                rewrite.extra.words.push(TextEdit::new(range, word));
                stands |= line <= first;
            }
        });
        stands |= line <= first && sheet.document.block(line).incremental == Some(incremental);
    }
    // G90 holds by default.
    rewrite.extra.first_word = (!stands && incremental).then_some(word);
    rewrite.edits(sheet, content)
}
