//! The planes of a taper, TP and TN, when a program is scaled: they are heights of the workpiece and of the guides,
//! which change only with the unit.

use crate::program::iso::document::Document;
use crate::program::iso::plain::words;
use crate::program::iso::style::Style;
use crate::program::iso::word::Token;
use crate::program::refactor::INCH;
use crate::text::TextEdit;

/// Adds the planes in another unit to `edits`. An error where the factor is not that of a unit.
pub(super) fn scale(
    document: &Document,
    factor: f64,
    edits: &mut Vec<TextEdit>,
) -> Result<(), String> {
    let is_of_unit = [INCH, 1.0 / INCH]
        .iter()
        .any(|unit| (factor / unit - 1.0).abs() < 1e-9);
    for line in 0..document.text().line_count() {
        let bytes = document.line_bytes(line);
        let start = document.text().line_start(line);
        let mut has_planes = false;
        // Ranges count from 1: a byte order mark begins a text alone.
        words(bytes, 1, |token, range| {
            if token != Token::Foreign {
                return;
            }
            let word = bytes.get(range.start - 1..range.end - 1);
            let Some([b'T' | b't', b'P' | b'p' | b'N' | b'n', ..]) = word else {
                return;
            };
            has_planes = true;
            let inch = document
                .machine_before(line)
                .is_some_and(|machine| machine.inch);
            // Its second letter and the number, as a word.
            words(
                word.and_then(|word| word.get(1..)).unwrap_or_default(),
                1,
                |token, _| {
                    if let Token::Word { number, .. } = token {
                        let length = document.reading().length(number, inch) as f64 * factor;
                        let number = Style::of(document, inch).number(length.round() as i64);
                        let place = start + range.start + 1..start + range.end - 1;
                        edits.push(TextEdit::new(place, number));
                    }
                },
            );
        });
        if has_planes && !is_of_unit {
            let reason = say!(the_planes_of_a_taper_would_not_be_kept);
            return Err(say!(line_by_number, line + 1, reason));
        }
    }
    Ok(())
}
