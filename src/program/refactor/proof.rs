//! The proof of a refactoring: the new program, read from its text alone, makes the intended moves, ends where it
//! should, pauses as often as before, and has no kind of error that the old one lacks.

use super::{Content, Edits, Notation, Rewrite, Row, Sheet};
use crate::finding::{Rule, Severity};
use crate::program::grid::point_of;
use crate::program::path::{Kind, Trace};
use crate::program::steps::{Program, trace};
use crate::text::{TextEdit, difference, edited};

/// The tolerance for the end of a counting program, µm, beside 1 µm for each arc.
const END_TOLERANCE: f64 = 2.0;

/// The tolerance for the length of a contour, µm for each of its moves: their ends are moved to the grid, twice.
const LENGTH_TOLERANCE: f64 = 6.0;

impl<N: Notation> Rewrite<N> {
    /// The edits of the text, proved; none where nothing changes.
    pub(crate) fn edits(self, sheet: &Sheet<'_, N>, content: &Content<N>) -> Edits {
        let edits = N::write(sheet, content, &self)?;
        if edits.is_empty() {
            return Ok(edits);
        }
        let old = sheet.document.text().bytes();
        let bytes = edited(old, &edits).ok_or(say!(the_edits_lie_on_each_other))?;
        let after = N::read(bytes, sheet.settings);
        prove(sheet, content, &self, &after)?;
        let more = N::finishing(&sheet.trace, &after);
        if more.is_empty() {
            return Ok(edits);
        }
        let again = Sheet::<N>::new(&after, sheet.settings, 0..0);
        let finished = same_way(&again, more).ok();
        let both = finished.and_then(|more| edited(after.text().bytes(), &more));
        let both = both.and_then(|bytes| difference(old, &bytes));
        Ok(both.map_or(edits, |both| vec![both]))
    }
}

fn prove<N: Notation>(
    sheet: &Sheet<'_, N>,
    content: &Content<N>,
    rewrite: &Rewrite<N>,
    after: &N::Document,
) -> Result<(), String> {
    let again = Sheet::<N>::new(after, sheet.settings, 0..0);
    let now = again
        .content()
        .map_err(|reason| say!(the_new_program_cannot_be_read, reason))?;
    let meant = rewrite.meant(sheet, content);
    if now.rows.len() != meant.len() {
        return Err(say!(the_new_program_reads_otherwise_than_it_was_meant).into());
    }
    for (row, meant) in now.rows.iter().zip(&meant) {
        N::agree(after, row, meant).map_err(|what| say!(line_by_number, row.line + 1, what))?;
    }
    prove_lengths(content, rewrite, now)?;
    let pauses = |trace: &Trace| {
        let is_pause = |step: &&crate::program::path::Step| step.kind == Kind::Pause;
        trace.steps.iter().filter(is_pause).count()
    };
    if pauses(&again.trace) != pauses(&sheet.trace) {
        return Err(say!(a_stop_would_be_lost).into());
    }
    if !sheet.trace.writing.names_places {
        // Without a header the program counts from its own start.
        let start = rewrite.start.map_or(sheet.trace.start, point_of);
        let end = again.trace.end() + (start - again.trace.start);
        let miss = (end - rewrite.end.unwrap_or(sheet.trace.end())).norm();
        if miss > END_TOLERANCE + content.arcs().max(now.arcs()) as f64 {
            return Err(say!(the_new_program_ends_elsewhere, miss));
        }
    }
    refuse_new_errors::<N>(sheet.document, after)
}

/// An error where a contour becomes longer or shorter than it should. The lengths are those of the
/// moves as they are read, independent of the places that the refactoring has calculated.
fn prove_lengths<N: Notation>(
    content: &Content<N>,
    rewrite: &Rewrite<N>,
    now: &Content<N>,
) -> Result<(), String> {
    let Some(stretch) = rewrite.stretch else {
        return Ok(());
    };
    let length = |rows: &[Row<N>]| -> f64 { rows.iter().map(|row| row.piece.length()).sum() };
    let news = |row: usize| rewrite.rows.get(&row).map_or(1, Vec::len);
    let (mut at, mut start) = (0, 0);
    for contour in &content.contours {
        start += (at..contour.steps.start).map(news).sum::<usize>();
        let count = contour.steps.clone().map(news).sum::<usize>();
        let rows = content.rows.get(contour.steps.clone()).unwrap_or_default();
        let found = now.rows.get(start..start + count).unwrap_or_default();
        let room = END_TOLERANCE + LENGTH_TOLERANCE * (rows.len() + count) as f64;
        if (length(found) - stretch * length(rows)).abs() > room * stretch.max(1.0) {
            return Err(say!(the_new_program_reads_otherwise_than_it_was_meant).into());
        }
        (at, start) = (contour.steps.end, start + count);
    }
    Ok(())
}

/// An error where the new program has a kind of error that the old one lacks, or more errors. All that an offset loses is
/// one error: scaled, a contour of which nothing is left may have a part that is.
fn refuse_new_errors<N: Notation>(before: &N::Document, after: &N::Document) -> Result<(), String> {
    let kind = |rule: Rule| match rule {
        Rule::LostPocket | Rule::OffsetCollapse => Rule::NarrowSlot,
        rule => rule,
    };
    let errors = |document: &N::Document| -> Vec<Rule> {
        let findings = N::findings(document).into_iter();
        let errors = findings.filter(|finding| finding.severity == Severity::Error);
        let mut is_loss_known = false;
        let is_first = |rule: &Rule| {
            kind(*rule) != Rule::NarrowSlot || !std::mem::replace(&mut is_loss_known, true)
        };
        errors
            .map(|finding| finding.rule)
            .filter(is_first)
            .collect()
    };
    let (before, after) = (errors(before), errors(after));
    let is_new = |rule: &&Rule| !before.iter().any(|own| kind(*own) == kind(**rule));
    match after.iter().find(is_new) {
        Some(rule) => Err(say!(the_new_program_would_have_a_new_fault, rule.name())),
        None if after.len() > before.len() => {
            Err(say!(the_new_program_would_have_more_faults_than_this_one).into())
        }
        None => Ok(()),
    }
}

/// The edits, if the machine takes the same path after them.
pub(super) fn same_way<N: Notation>(sheet: &Sheet<'_, N>, edits: Vec<TextEdit>) -> Edits {
    let way = |trace: &Trace| {
        let steps = trace.steps.iter();
        steps
            .map(|step| (step.kind, step.line, step.ideal))
            .collect::<Vec<_>>()
    };
    if edits.is_empty() {
        return Ok(edits);
    }
    let bytes =
        edited(sheet.document.text().bytes(), &edits).ok_or(say!(the_edits_lie_on_each_other))?;
    let after = N::read(bytes, sheet.settings);
    if way(&trace(&after).into_meant()) != way(&sheet.trace) {
        return Err(say!(the_numbers_are_part_of_what_the_machine_does).into());
    }
    refuse_new_errors::<N>(sheet.document, &after)?;
    Ok(edits)
}
