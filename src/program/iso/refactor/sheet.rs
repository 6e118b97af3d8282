//! A program as refactorings see it: its moves by lines, its contours, the selection.

use crate::finding::{Detail, Place as Where, Severity};
use crate::program::iso::document::Document;
use crate::program::iso::machine::{Course, Move};
use crate::program::path::Kind;
use crate::program::path::{Cut, cuts};
use crate::settings::Effective;
use std::ops::Range;

/// A line that moves the wire.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    pub line: usize,
    pub made: Move,
    /// It is written in inches.
    pub inch: bool,
}

/// A program for refactoring.
pub struct Sheet<'a> {
    pub document: &'a Document,
    pub settings: &'a Effective,
    /// Bytes of the text.
    selection: Range<usize>,
    content: Result<Content, String>,
}

pub struct Content {
    pub rows: Vec<Row>,
    /// Their steps are rows.
    pub contours: Vec<Cut>,
    /// The rows before which the program pauses.
    pauses: Vec<usize>,
}

impl<'a> Sheet<'a> {
    pub fn new(
        document: &'a Document,
        settings: &'a Effective,
        selection: Range<usize>,
    ) -> Sheet<'a> {
        Sheet {
            document,
            settings,
            selection,
            content: content(document),
        }
    }

    /// The moves; the error says which line cannot be read.
    pub fn content(&self) -> Result<&Content, String> {
        self.content.as_ref().map_err(Clone::clone)
    }

    /// Lines that the selection touches.
    pub fn selected_lines(&self) -> Range<usize> {
        let text = self.document.text();
        let first = text.line_of(self.selection.start);
        let last = text.line_of(self.selection.end.max(self.selection.start + 1) - 1);
        first..last.max(first) + 1
    }

    /// The contours that the selection touches; all, where it touches none.
    pub fn selected_contours<'c>(&self, content: &'c Content) -> Vec<&'c Cut> {
        let lines = self.selected_lines();
        let cut = || content.contours.iter().filter(|contour| !contour.is_way);
        let touched = |contour: &&Cut| {
            content.rows[contour.steps.clone()]
                .iter()
                .any(|row| lines.contains(&row.line))
        };
        let chosen: Vec<&Cut> = cut().filter(touched).collect();
        if chosen.is_empty() {
            cut().collect()
        } else {
            chosen
        }
    }
}

impl Content {
    /// The rows of a closed contour whose ends are one place; the error says why there are none.
    pub fn closed(&self, contour: &Cut) -> Result<Range<usize>, String> {
        let own = contour.contour_steps();
        let Some(first) = self.rows.get(own.start).filter(|_| !own.is_empty()) else {
            return Err("the contour has no block".into());
        };
        if let Some(row) = self
            .pauses
            .iter()
            .find(|row| contour.steps.start < **row && **row < contour.steps.end)
        {
            let line = self.rows[*row].line + 1;
            return Err(format!(
                "the contour pauses before line {line}, to hold the part while its tab is cut"
            ));
        }
        if !contour.closed {
            return Err(format!(
                "the contour that begins in line {} is open",
                first.line + 1
            ));
        }
        // Leads that only nearly lie on each other are part of it.
        let wider =
            (0..=contour.lead_in.min(contour.lead_out)).map(|by| own.start - by..own.end + by);
        let is_one_place =
            |own: &Range<usize>| match (self.rows.get(own.start), self.rows.get(own.end - 1)) {
                (Some(first), Some(last)) => first.made.from == last.made.to,
                _ => false,
            };
        let found = wider.into_iter().find(is_one_place);
        found.ok_or_else(|| {
            format!(
                "the contour that begins in line {} misses its own begin: close it first",
                first.line + 1
            )
        })
    }
}

/// Reads a program for refactoring. What cannot be read, or is run from somewhere else, is left alone.
fn content(document: &Document) -> Result<Content, String> {
    if document.order().is_some() {
        return Err(
            "the program runs subprograms: a line of them is run in more than one place".into(),
        );
    }
    if document.has_corners() {
        return Err("the control makes corners of its own (R on a straight cut, `,R`, `,C`): its moves are not those of the lines".into());
    }
    let text = document.text();
    for finding in document.plain_findings() {
        if let (Detail::Syntax(sentence), Severity::Error, Where::Text { range }) =
            (&finding.detail, finding.severity, &finding.place)
        {
            return Err(format!(
                "line {}: {sentence}",
                text.line_of(range.start) + 1
            ));
        }
    }
    let mut rows = Vec::new();
    let mut fault = None;
    document.moves(&mut |line, made, machine| {
        if matches!(
            made.course(document.reading()),
            Course::OffRadius { .. } | Course::NoRadius
        ) {
            fault.get_or_insert_with(|| format!("line {}: the arc leads nowhere", line + 1));
        }
        rows.push(Row {
            line,
            made,
            inch: machine.inch,
        });
    });
    if let Some(fault) = fault {
        return Err(fault);
    }
    if rows.is_empty() {
        return Err("the program moves nothing".into());
    }
    // Cuts count all steps, rows only those that move.
    let trace = document.trace();
    let mut row_of = Vec::with_capacity(trace.steps.len() + 1);
    let mut row = 0;
    for step in &trace.steps {
        row_of.push(row);
        row += usize::from(step.moves());
    }
    row_of.push(row);
    let at = |step: usize| row_of.get(step).copied().unwrap_or(row);
    let contours = cuts(&trace).into_iter().map(|cut| {
        let (steps, own) = (at(cut.steps.start)..at(cut.steps.end), cut.contour_steps());
        let (lead_in, lead_out) = (at(own.start) - steps.start, steps.end - at(own.end));
        Cut {
            steps,
            lead_in,
            lead_out,
            ..cut
        }
    });
    let contours = contours.collect();
    let pauses = trace
        .steps
        .iter()
        .enumerate()
        .filter(|(_, step)| step.kind == Kind::Pause)
        .map(|(step, _)| at(step))
        .collect();
    Ok(Content {
        contours,
        rows,
        pauses,
    })
}
