//! The index of all pages: a row for each drawing.

use super::html::{self, cell, number, table, text};
use crate::message::{duration, spoken};

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
    /// Why there is no program.
    pub(super) refusal: Option<String>,
    /// The keys that times need and that are not set.
    pub(super) missing: Vec<String>,
}

/// The index of all pages.
pub(super) fn index(lines: &[(String, Line)]) -> String {
    let heads = [
        say!(column_drawing),
        say!(column_contours),
        say!(column_smallest_radius),
        say!(column_findings),
        say!(column_blocks),
        say!(column_time),
    ];
    let row = |(page, line): &(String, Line)| {
        let link = format!("<a href=\"{}\">{}</a>", text(page), text(&line.name));
        let smallest = line.smallest_mm.map(|radius| format!("{radius:.4}"));
        let blocks = match (line.blocks, &line.refusal) {
            (Some(blocks), _) => number(blocks),
            (None, Some(why)) => cell(say!(none_because, why)),
            (None, None) => cell(say!(no_program)),
        };
        let time = match line.minutes {
            Some(minutes) => number(duration(minutes)),
            None if line.missing.is_empty() => cell(say!(no_program)),
            None => cell(say!(not_set_are, line.missing.join(", "))),
        };
        vec![
            ("", link),
            number(line.contours),
            smallest.map_or_else(|| cell(say!(no_arcs)), number),
            ("", counts(line)),
            blocks,
            time,
        ]
    };
    let title = say!(report_of_drawings, lines.len());
    let body = format!(
        "<h1>{}</h1>\n{}",
        text(&title),
        table(&heads, lines.iter().map(row))
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
