//! Coordinates that are absolute (G90), or that count from where the wire stands (G91).
//!
//! ```text
//! G90                        G91
//! G01 X5. Y0.           →    G01 X5. Y0.
//! X5. Y3.                    X0. Y3.
//! ```

use super::Words;
use crate::program::iso::document::Document;
use crate::program::iso::plain::words_at;
use crate::program::iso::taper::{Words as Taper, refuse_anywhere};
use crate::program::refactor::moves::{Edits, Printer};
use crate::program::refactor::proof::proved;
use crate::program::refactor::sheet::Sheet;
use crate::text::TextEdit;

pub(in crate::program) fn counted(
    program: &Document,
    sheet: &Sheet<'_>,
    incremental: bool,
) -> Edits {
    let words = Words::of(program)?;
    let mut made = words.made.iter().map(|(_, own, _)| own);
    if made.all(|own| own.incremental == incremental) {
        return Ok(Vec::new());
    }
    refuse_anywhere(program, Taper::Guide)?;
    let (text, old) = (program.text(), words.reading);
    let (word, other) = if incremental {
        ("G91", 90)
    } else {
        ("G90", 91)
    };
    let mut rewrite = sheet.rewrite();
    let first = sheet.moves.first().map_or(0, |own| own.line);
    let mut stands = false;
    for line in 0..text.line_count() {
        words_at(text, line, |letter, number, range| {
            if letter == b'G' && number.mantissa == other && number.decimals == 0 {
                rewrite.words.push(TextEdit::new(range, word));
                stands |= line <= first;
            }
        });
        stands |= line <= first && program.block(line).incremental == Some(incremental);
    }
    // G90 holds by default.
    if incremental && !stands {
        rewrite.words.extend(program.with_word(first, word));
    }
    // An absolute centre is meaningless under G91.
    let rule = if incremental {
        old.absolute
    } else {
        old.incremental
    };
    let reading = old.with_rule(rule);
    let printed = Words { reading, ..words }.print(&sheet.moves, &rewrite)?;
    proved(sheet, &rewrite, printed)
}
