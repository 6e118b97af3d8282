//! The lengths beside the moves when a program is scaled: the position set by G92, and the planes of a taper, TP and TN,
//! which are heights of the workpiece and of the guides and change only with the unit.

use crate::program::iso::document::Document;
use crate::program::iso::plain::words_at;
use crate::program::iso::style::Style;
use crate::program::iso::tilt::{Upper, upper_words};
use crate::program::iso::word::Number;
use crate::program::refactor::moves::{Edits, INCH};
use crate::text::TextEdit;

/// A length of a line, scaled.
fn scaled(document: &Document, line: usize, number: Number, factor: f64) -> String {
    let before = document.machine_before(line);
    let inch = before.is_some_and(|machine| machine.inch);
    let length = document.reading().length(number, inch) as f64 * factor;
    Style::of(document, inch).number(length.round() as i64)
}

/// The position set by G92.
pub(super) fn positions(document: &Document, factor: f64) -> Edits {
    let text = document.text();
    let mut edits = Vec::new();
    for line in 0..text.line_count() {
        let block = document.block(line);
        if block.takes_coordinates && block.has_coordinates() {
            return Err(say!(a_word_takes_the_coordinates, line + 1));
        }
        if !block.sets_position {
            continue;
        }
        words_at(text, line, |letter, number, range| {
            if matches!(letter, b'X' | b'Y') {
                let number = scaled(document, line, number, factor);
                edits.push(TextEdit::new(range, format!("{}{number}", letter as char)));
            }
        });
    }
    Ok(edits)
}

/// The planes in another unit. An error where the factor is not that of a unit.
pub(super) fn planes(document: &Document, factor: f64) -> Edits {
    let mut units = [INCH, 1.0 / INCH].iter();
    let is_of_unit = units.any(|unit| (factor / unit - 1.0).abs() < 1e-9);
    let mut edits = Vec::new();
    for line in 0..document.text().line_count() {
        let start = document.text().line_start(line);
        let mut has_planes = false;
        upper_words(document.line_bytes(line), |upper, range| {
            let Upper::Plane(_, number) = upper else {
                return;
            };
            has_planes = true;
            if let Some(number) = number {
                let number = scaled(document, line, number, factor);
                // Behind both letters.
                let digits = start + range.start + 2..start + range.end;
                edits.push(TextEdit::new(digits, number));
            }
        });
        if has_planes && !is_of_unit {
            let reason = say!(the_planes_of_a_taper_would_not_be_kept);
            return Err(say!(line_by_number, line + 1, reason));
        }
    }
    Ok(edits)
}
