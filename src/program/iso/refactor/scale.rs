//! Scale a program about its zero. Corrections, which are those of the wire, stay.

use super::rewrite::{Bent, Rewrite, Target};
use super::sheet::{Content, Sheet};
use super::taper::{Words, refuse_anywhere};
use crate::geometry::Arc;
use crate::program::grid::{best_center, snap};
use crate::program::iso::block::read_line;
use crate::program::iso::document::Document;
use crate::program::iso::machine::{Place, micrometres};
use crate::program::iso::style::Style;
use crate::program::iso::word::{Token, words};
use crate::settings::Effective;
use crate::text::TextEdit;

/// Factors that a program is scaled by.
const FACTORS: std::ops::RangeInclusive<f64> = 1e-4..=1e4;

/// The edits that scale a program.
pub fn scaled(
    document: &Document,
    settings: &Effective,
    factor: f64,
) -> Result<Vec<TextEdit>, String> {
    if !FACTORS.contains(&factor) {
        return Err(format!(
            "the factor is {factor}, expected a number from {} to {}",
            FACTORS.start(),
            FACTORS.end()
        ));
    }
    let sheet = Sheet::new(document, settings, 0..0);
    let content: &Content = sheet.content()?;
    refuse_anywhere(document, Words::Guide)?;
    let mut rewrite = Rewrite {
        words: positions(document, factor)?,
        ..Rewrite::default()
    };
    let styles = [false, true].map(|inch| Style::of(document, inch));
    let mut from = None;
    for (index, row) in content.rows.iter().enumerate() {
        let style = styles[usize::from(row.inch)];
        let of_length = |length: i64| style.rounded((length as f64 * factor).round() as i64);
        let of_place = |place: Place| place.map(of_length);
        let old = Target::of(&row.made, document.reading());
        let begin: Place = from.unwrap_or_else(|| of_place(row.made.from));
        let to = of_place(old.to);
        let bend = match old.bend {
            Bent::Line => Bent::Line,
            Bent::Radius(radius) => Bent::Radius(of_length(radius)),
            Bent::Center(center) => Bent::Center(
                fitting(begin, to, center, factor, &style)
                    .ok_or("the program would run too far out")?,
            ),
        };
        from = Some(to);
        rewrite.rows.insert(index, Target { to, bend, ..old });
    }
    rewrite.edits(&sheet, content)
}

/// The centre in the program's steps that is most nearly as far from both ends.
fn fitting(from: Place, to: Place, center: Place, factor: f64, style: &Style) -> Option<Place> {
    let step = style.step();
    let scale = 1e3 / step as f64;
    let arc = Arc::about(
        micrometres(center) * factor * scale,
        micrometres(from) * scale,
        micrometres(to) * scale,
        true,
    );
    let node = best_center(
        &arc,
        snap(micrometres(from) * scale)?,
        snap(micrometres(to) * scale)?,
    );
    Some([node.x.checked_mul(step)?, node.y.checked_mul(step)?])
}

/// Where G92 says that the wire stands.
fn positions(document: &Document, factor: f64) -> Result<Vec<TextEdit>, String> {
    let text = document.text();
    let mut edits = Vec::new();
    for line in 0..text.line_count() {
        let range = text.line_range(line);
        let bytes = text.bytes().get(range.clone()).unwrap_or_default();
        let block = read_line(bytes, 1, |_| {});
        if block.takes_coordinates && block.has_coordinates() {
            return Err(format!(
                "line {}: a word takes the coordinates for a place of the machine",
                line + 1
            ));
        }
        if !block.sets_position {
            continue;
        }
        let inch = document
            .machine_before(line)
            .is_some_and(|machine| machine.inch);
        let style = Style::of(document, inch);
        words(bytes, 1, |token| {
            if let Token::Word {
                letter: letter @ (b'X' | b'Y'),
                number,
                range: word,
            } = token
            {
                let length =
                    (document.reading().length(number, inch) as f64 * factor).round() as i64;
                let text = format!("{}{}", letter as char, style.number(length));
                edits.push(TextEdit {
                    range: range.start + word.start - 1..range.start + word.end - 1,
                    text,
                });
            }
        });
    }
    Ok(edits)
}
