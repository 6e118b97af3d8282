//! The moves of a program with their places.

use super::{Iso, node_of};
use crate::finding::{Detail, Place as Where, Severity};
use crate::program::iso::document::Document;
use crate::program::iso::moves::Move;
use crate::program::iso::style::Style;
use crate::program::refactor::Row;

/// A move in its line.
#[derive(Clone, Copy, Debug)]
pub(in crate::program) struct Own {
    pub(crate) made: Move,
    /// How lengths are written there, in inches or millimetres.
    pub(crate) style: Style,
}

/// Reads a program for refactoring. Lines that cannot be read, or are run from somewhere else, are left alone.
pub(super) fn rows(document: &Document) -> Result<Vec<Row<Iso>>, String> {
    if document.order().is_some() {
        return Err(say!(the_program_runs_subprograms).into());
    }
    if document.has_corners() {
        return Err(say!(the_control_makes_corners_of_its_own).into());
    }
    let text = document.text();
    for finding in document.plain_findings() {
        if let (Detail::Said(sentence), Severity::Error, Where::Text { range }) =
            (&finding.detail, finding.severity, &finding.place)
        {
            return Err(say!(
                line_by_number,
                text.line_of(range.start) + 1,
                sentence
            ));
        }
    }
    let styles = [false, true].map(|inch| Style::of(document, inch));
    let mut rows = Vec::new();
    let mut fault = None;
    document.moves(&mut |line, made, machine| {
        if made.curve(document.reading()).is_none() {
            fault.get_or_insert_with(|| say!(the_arc_of_a_line_leads_nowhere, line + 1));
        }
        let [from, to] = [made.from, made.to].map(node_of);
        rows.push(Row {
            line,
            from,
            to,
            piece: made.segment(document.reading()),
            own: Own {
                made,
                style: styles[usize::from(machine.inch)],
            },
        });
    });
    if let Some(fault) = fault {
        return Err(fault);
    }
    if rows.is_empty() {
        return Err(say!(the_program_moves_nothing).into());
    }
    Ok(rows)
}
