//! The proof of a refactoring: the new program, read from its text alone, makes the intended moves, ends where it
//! should, pauses as often as before, and has no kind of error that the old one lacks.

use super::moves::{Edits, Move, Numbers, Printed, Rewrite, point};
use super::sheet::Sheet;
use crate::finding::{Rule, Severity};
use crate::program::document::Document;
use crate::program::encode::{ASIDE_TOLERANCE, aside};
use crate::program::numbering::numbered;
use crate::program::path::Trace;
use crate::program::steps::trace;
use crate::settings::Effective;
use crate::text::{TextEdit, difference, edited};
use std::ops::Range;

/// The tolerance for the end of a counting program, µm, beside 1 µm for each arc.
const END_TOLERANCE: f64 = 2.0;

/// How far a block that counts may end from its place, µm.
const MISS: f64 = 1.5;

/// How far a block that was mirrored, turned or left as it is may lie from its piece, µm: rounding.
const EXACT: f64 = 1e-3;

/// The tolerance for the length of a contour, µm for each of its moves: their ends are moved to the grid, twice.
const LENGTH_TOLERANCE: f64 = 6.0;

/// The edits of the text, proved; none where nothing changes.
pub(in crate::program) fn rewritten(sheet: &Sheet<'_>, rewrite: &Rewrite) -> Edits {
    let printed = sheet.printer.print(&sheet.moves, rewrite)?;
    proved(sheet, rewrite, printed)
}

/// The same for a text that has been printed.
pub(in crate::program) fn proved(
    sheet: &Sheet<'_>,
    rewrite: &Rewrite,
    Printed { edits, blocks }: Printed,
) -> Edits {
    if edits.is_empty() {
        return Ok(edits);
    }
    let old = sheet.document.text().bytes();
    let bytes = edited(old, &edits).ok_or(say!(the_edits_lie_on_each_other))?;
    let after = Document::read(sheet.document.language(), bytes, sheet.settings);
    let now = Sheet::new(&after, sheet.settings, 0..0)
        .map_err(|reason| say!(the_new_program_cannot_be_read, reason))?;
    prove(sheet, rewrite, &blocks, &now)?;
    // A program whose numbers counted its blocks keeps counting them.
    let more = match &after {
        Document::ThreeB(program) if counts(&sheet.trace) && !counts(&now.trace) => {
            numbered(program).unwrap_or_default()
        }
        _ => Vec::new(),
    };
    if more.is_empty() {
        return Ok(edits);
    }
    let finished = same_way(&after, sheet.settings, more).ok();
    let both = finished.and_then(|more| edited(after.text().bytes(), &more));
    let both = both.and_then(|bytes| difference(old, &bytes));
    Ok(both.map_or(edits, |both| vec![both]))
}

fn prove(
    sheet: &Sheet<'_>,
    rewrite: &Rewrite,
    blocks: &[usize],
    now: &Sheet<'_>,
) -> Result<(), String> {
    if now.moves.len() != blocks.iter().sum::<usize>() {
        return Err(say!(the_new_program_reads_otherwise_than_it_was_meant).into());
    }
    let mut left = &now.moves[..];
    for (meant, count) in rewrite.moves.iter().zip(blocks) {
        let (own, rest) = left.split_at(*count);
        left = rest;
        if let (Some(meant), Some(first)) = (meant, own.first()) {
            agree(own, meant, sheet)
                .map_err(|reason| say!(line_by_number, first.line + 1, reason))?;
        }
    }
    prove_lengths(sheet, rewrite, blocks, now)?;
    if now.pause_count() != sheet.pause_count() {
        return Err(say!(a_stop_would_be_lost).into());
    }
    if !sheet.names_places() {
        // Without a header the program counts from its own start.
        let start = rewrite.start.map_or(sheet.trace.start, point);
        let end = now.trace.end() + (start - now.trace.start);
        let miss = (end - rewrite.end.unwrap_or(sheet.trace.end())).norm();
        if miss > END_TOLERANCE + sheet.arcs().max(now.arcs()) as f64 {
            return Err(say!(the_new_program_ends_elsewhere, miss));
        }
    }
    refuse_new_errors(sheet.document, now.document)
}

/// An error where blocks that stand in the place of a move do not make it. They are followed from its begin, so what
/// they miss by adds up.
fn agree(blocks: &[Move], meant: &Move, sheet: &Sheet<'_>) -> Result<(), &'static str> {
    let is_same = |own: &Move| {
        (own.side, own.is_rapid, own.part) == (meant.side, meant.is_rapid, meant.part)
            && (!sheet.names_places() || own.to == meant.to)
    };
    if !blocks.iter().all(is_same) {
        return Err(say!(the_new_line_leads_elsewhere));
    }
    let step = sheet.printer.step(meant.like) as f64 / 1e3;
    let tolerance = match meant.numbers {
        Numbers::Turned(_) if !sheet.names_places() => EXACT,
        _ => ASIDE_TOLERANCE * step.max(1.0) + (blocks.len() - 1) as f64,
    };
    let (mut at, mut share) = (point(meant.from), 0.0);
    for (left, own) in (0..blocks.len()).rev().zip(blocks) {
        let own = own.piece.moved(at - own.piece.start());
        at = own.end();
        let next = if left == 0 {
            1.0
        } else {
            meant.piece.share_of(at)
        };
        let piece = match blocks.len() {
            1 => meant.piece,
            _ => meant.piece.part(share, next),
        };
        let turns = [&own, &piece].map(|curve| curve.as_arc().map(|arc| arc.sweep > 0.0));
        let is_other_turn = turns[0]
            .zip(turns[1])
            .is_some_and(|(own, meant)| own != meant);
        let apart = |share: f64| (own.point_at(share) - piece.point_at(share)).norm();
        let miss = match (sheet.names_places(), meant.numbers) {
            // The ends are the same, and may be off the radius.
            (true, _) => apart(0.5),
            (false, Numbers::Turned(_)) => apart(0.5).max(apart(1.0)),
            (false, _) => aside(&own, &piece),
        };
        if is_other_turn || own != piece && (miss.is_nan() || miss > tolerance) {
            return Err(match sheet.names_places() {
                true if meant.is_arc() => say!(the_arcs_would_not_tell_how_i_and_j_are_meant),
                _ => say!(the_block_does_not_run_along_its_piece),
            });
        }
        share = next;
    }
    // Kept numbers lead where they did, beside the place by what has been taken back of the drift.
    let is_kept = matches!(meant.numbers, Numbers::Turned(_));
    let is_there = is_kept || (at - point(meant.to)).norm() <= MISS * blocks.len() as f64;
    match is_there {
        true => Ok(()),
        false => Err(say!(the_block_does_not_run_along_its_piece)),
    }
}

/// An error where a contour becomes longer or shorter than it should. The lengths are those of the moves as they are
/// read, independent of the places that the refactoring has calculated.
fn prove_lengths(
    sheet: &Sheet<'_>,
    rewrite: &Rewrite,
    blocks: &[usize],
    now: &Sheet<'_>,
) -> Result<(), String> {
    let Some(factor) = rewrite.factor else {
        return Ok(());
    };
    let length = |moves: &[Move]| -> f64 { moves.iter().map(|own| own.piece.length()).sum() };
    let count = |moves: Range<usize>| blocks[moves].iter().sum::<usize>();
    let (mut at, mut start) = (0, 0);
    for contour in &sheet.contours {
        start += count(at..contour.steps.start);
        let news = count(contour.steps.clone());
        let before = &sheet.moves[contour.steps.clone()];
        let found = now.moves.get(start..start + news).unwrap_or_default();
        let room = END_TOLERANCE + LENGTH_TOLERANCE * (before.len() + news) as f64;
        if (length(found) - factor * length(before)).abs() > room * factor.max(1.0) {
            return Err(say!(the_new_program_reads_otherwise_than_it_was_meant).into());
        }
        (at, start) = (contour.steps.end, start + news);
    }
    Ok(())
}

/// An error where the new program has a kind of error that the old one lacks, or more errors. All that an offset loses is
/// one error: scaled, a contour of which nothing is left may have a part that is.
fn refuse_new_errors(before: &Document, after: &Document) -> Result<(), String> {
    let is_loss = |rule: Rule| {
        matches!(
            rule,
            Rule::LostPocket | Rule::OffsetCollapse | Rule::NarrowSlot
        )
    };
    let errors = |document: &Document| -> Vec<Rule> {
        let findings = match document {
            Document::ThreeB(program) => program.findings(),
            Document::Iso(program) => program.plain_findings(),
        };
        let errors = findings.into_iter();
        let errors = errors.filter(|finding| finding.severity == Severity::Error);
        let mut rules: Vec<Rule> = errors.map(|finding| finding.rule).collect();
        let mut is_loss_known = false;
        rules.retain(|rule| !is_loss(*rule) || !std::mem::replace(&mut is_loss_known, true));
        rules
    };
    let (before, after) = (errors(before), errors(after));
    let is_known = |rule: &Rule| {
        before.contains(rule) || is_loss(*rule) && before.iter().any(|own| is_loss(*own))
    };
    match after.iter().find(|rule| !is_known(rule)) {
        Some(rule) => Err(say!(the_new_program_would_have_a_new_fault, rule.name())),
        None if after.len() > before.len() => {
            Err(say!(the_new_program_would_have_more_faults_than_this_one).into())
        }
        None => Ok(()),
    }
}

/// The edits, if the machine takes the same path after them.
pub(in crate::program) fn same_way(
    document: &Document,
    settings: &Effective,
    edits: Vec<TextEdit>,
) -> Edits {
    let way = |document: &Document| {
        let steps = trace(document.program()).into_meant().steps.into_iter();
        steps
            .map(|step| (step.kind, step.line, step.ideal))
            .collect::<Vec<_>>()
    };
    if edits.is_empty() {
        return Ok(edits);
    }
    let bytes = edited(document.text().bytes(), &edits).ok_or(say!(the_edits_lie_on_each_other))?;
    let after = Document::read(document.language(), bytes, settings);
    if way(&after) != way(document) {
        return Err(say!(the_numbers_are_part_of_what_the_machine_does).into());
    }
    refuse_new_errors(document, &after)?;
    Ok(edits)
}

/// Whether the numbers of blocks count them.
fn counts(trace: &Trace) -> bool {
    let mut blocks = trace.steps.iter().filter(|step| step.moves()).zip(1_u32..);
    blocks.all(|(step, ordinal)| step.number == Some(ordinal))
}
