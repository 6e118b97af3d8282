//! The planes of a taper, TP and TN, when a program is scaled: they are heights of the workpiece and of the guides,
//! which change only with the unit.

use crate::program::iso::document::Document;
use crate::program::iso::style::Style;
use crate::program::iso::tilt::{Upper, upper_words};
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
        let start = document.text().line_start(line);
        let mut has_planes = false;
        upper_words(document.line_bytes(line), |upper, range| {
            let Upper::Plane(_, number) = upper else {
                return;
            };
            has_planes = true;
            let inch = document
                .machine_before(line)
                .is_some_and(|machine| machine.inch);
            if let Some(number) = number {
                let length = document.reading().length(number, inch) as f64 * factor;
                let number = Style::of(document, inch).number(length.round() as i64);
                // Behind both letters.
                edits.push(TextEdit::new(
                    start + range.start + 2..start + range.end,
                    number,
                ));
            }
        });
        if has_planes && !is_of_unit {
            let reason = say!(the_planes_of_a_taper_would_not_be_kept);
            return Err(say!(line_by_number, line + 1, reason));
        }
    }
    Ok(())
}
