//! The index of all pages: a row for each drawing.

use super::html::{self, number, table, text};
use crate::message::spoken;

/// The row of a drawing in the index.
pub(super) struct Line {
    pub(super) name: String,
    pub(super) contours: usize,
    pub(super) smallest_mm: Option<f64>,
    pub(super) errors: usize,
    pub(super) warnings: usize,
    pub(super) notes: usize,
    pub(super) blocks: Option<usize>,
    pub(super) minutes: Option<f64>,
}

/// The index of all pages.
pub(super) fn index(lines: &[(String, Line)]) -> String {
    let heads = [
        say!(column_drawing),
        say!(column_contours),
        say!(column_smallest_radius),
        say!(column_findings),
        say!(column_blocks),
        say!(column_minutes),
    ];
    // No times are set.
    let columns = heads.len() - usize::from(lines.iter().all(|(_, line)| line.minutes.is_none()));
    let row = |(page, line): &(String, Line)| {
        let link = format!("<a href=\"{}\">{}</a>", text(page), text(&line.name));
        let smallest = line.smallest_mm.map(|radius| format!("{radius:.4}"));
        let mut cells = vec![
            ("", link),
            number(line.contours),
            number(smallest.unwrap_or_default()),
            ("", counts(line)),
            number(
                line.blocks
                    .map(|blocks| blocks.to_string())
                    .unwrap_or_default(),
            ),
            number(
                line.minutes
                    .map(|minutes| format!("{minutes:.2}"))
                    .unwrap_or_default(),
            ),
        ];
        cells.truncate(columns);
        cells
    };
    let title = say!(report_of_drawings, lines.len());
    let body = format!(
        "<h1>{}</h1>\n{}",
        text(&title),
        table(&heads[..columns], lines.iter().map(row))
    );
    html::page(spoken().tag(), &title, &body)
}

pub(super) fn span(class: &str, content: impl std::fmt::Display) -> String {
    format!("<span class=\"{class}\">{}</span>", text(content))
}

pub(super) fn counts(line: &Line) -> String {
    let Line {
        errors,
        warnings,
        notes,
        ..
    } = *line;
    let told = [
        (errors > 0).then(|| span("error", say!(errors, errors))),
        (warnings > 0).then(|| span("warning", say!(warnings, warnings))),
        (notes > 0).then(|| span("faint", say!(notes, notes))),
    ];
    let told: Vec<String> = told.into_iter().flatten().collect();
    match told.is_empty() {
        true => span("good", say!(nothing_found)),
        false => told.join(" · "),
    }
}
