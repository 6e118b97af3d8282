//! A program as refactorings see it: its moves, its contours, and what is selected.

use super::moves::{Change, Move, Numbers, Place, Printer, Rewrite, place, point};
use super::transform::Transform;
use crate::geometry::{Point, Segment, Vector};
use crate::program::document::Document;
use crate::program::iso::refactor::Words;
use crate::program::path::{Cut, Kind, Step, Trace, cuts};
use crate::program::steps::trace;
use crate::program::three_b::refactor::Blocks;
use crate::settings::Effective;
use crate::text::TextEdit;
use std::ops::Range;

pub(in crate::program) struct Sheet<'a> {
    pub(crate) document: &'a Document,
    pub(crate) settings: &'a Effective,
    /// Bytes of the text.
    selection: Range<usize>,
    /// As the blocks mean it.
    pub(crate) trace: Trace,
    pub(crate) moves: Vec<Move>,
    /// The contours of the program. Their steps are moves, and they are counted as a person does, without the ways
    /// between.
    pub(crate) contours: Vec<Cut>,
    /// The moves before which the program pauses.
    pauses: Vec<usize>,
    pub(crate) printer: Box<dyn Printer + 'a>,
}

impl<'a> Sheet<'a> {
    /// The error names the line that cannot be read.
    pub(crate) fn new(
        document: &'a Document,
        settings: &'a Effective,
        selection: Range<usize>,
    ) -> Result<Sheet<'a>, String> {
        let trace = trace(document.program()).into_meant();
        let steps: Vec<&Step> = trace.steps.iter().filter(|step| step.moves()).collect();
        let printer: Box<dyn Printer + 'a> = match document {
            Document::ThreeB(program) => Box::new(Blocks::of(program, &trace)?),
            Document::Iso(program) => Box::new(Words::of(program)?),
        };
        if printer.count() != steps.len() {
            return Err(say!(the_program_is_not_followed_as_a_whole).into());
        }
        let (contours, pauses) = contours(&trace);
        let ends = places(&trace, &steps, &contours)?;
        let moves = steps.iter().zip(ends).enumerate();
        let moves = moves.map(|(like, (step, [from, to]))| {
            Some(Move {
                like,
                line: step.line,
                from,
                to,
                piece: step.ideal?.moved(point(from) - step.start),
                side: step.side,
                is_rapid: step.kind == Kind::Rapid,
                numbers: Numbers::Turned(Transform::NONE),
                part: printer.part(like),
                counts: !trace.writing.names_places,
            })
        });
        let moves: Option<Vec<Move>> = moves.collect();
        let moves = moves.ok_or(say!(the_program_is_not_followed_as_a_whole))?;
        Ok(Sheet {
            document,
            settings,
            selection,
            moves,
            contours,
            pauses,
            printer,
            trace,
        })
    }

    /// A program to which nothing has been done yet.
    pub(crate) fn rewrite(&self) -> Rewrite {
        Rewrite {
            moves: self.moves.iter().copied().map(Some).collect(),
            words: Vec::new(),
            start: None,
            end: None,
            factor: Some(1.0),
        }
    }

    pub(crate) fn words(&self, change: &Change<'_>) -> Result<Vec<TextEdit>, String> {
        self.printer.words(change)
    }

    /// Moves name their ends, not displacements: nothing drifts.
    pub(crate) fn names_places(&self) -> bool {
        self.trace.writing.names_places
    }

    /// Lines that the selection touches.
    pub(crate) fn selected_lines(&self) -> Range<usize> {
        let text = self.document.text();
        let first = text.line_of(self.selection.start);
        let last = text.line_of(self.selection.end.max(self.selection.start + 1) - 1);
        first..last.max(first) + 1
    }

    /// The selected moves; all, where at most one line is selected.
    pub(crate) fn selected_moves(&self) -> Range<usize> {
        let lines = self.selected_lines();
        if lines.len() < 2 {
            return 0..self.moves.len();
        }
        let behind = |line: usize| self.moves.partition_point(|own| own.line < line);
        behind(lines.start)..behind(lines.end)
    }

    /// The contours that the selection touches; all, where it touches none.
    pub(crate) fn selected_contours(&self) -> Vec<&Cut> {
        let lines = self.selected_lines();
        let cut = || self.contours.iter().filter(|contour| !contour.is_way);
        let touched = |contour: &&Cut| {
            let mut own = self.moves[contour.steps.clone()].iter();
            own.any(|own| lines.contains(&own.line))
        };
        let chosen: Vec<&Cut> = cut().filter(touched).collect();
        match chosen.is_empty() {
            true => cut().collect(),
            false => chosen,
        }
    }

    pub(crate) fn arcs(&self) -> usize {
        self.moves.iter().filter(|own| own.is_arc()).count()
    }

    pub(crate) fn is_behind_pause(&self, index: usize) -> bool {
        self.pauses.binary_search(&index).is_ok()
    }

    pub(crate) fn pause_count(&self) -> usize {
        self.pauses.len()
    }

    /// An error where the contour pauses before its tab: that pause would be misplaced.
    pub(crate) fn refuse_pause(&self, contour: &Cut) -> Result<(), String> {
        let within = |index: &usize| contour.steps.start < *index && *index < contour.steps.end;
        match self.pauses.iter().copied().find(within) {
            Some(index) => Err(say!(
                the_contour_pauses_to_hold_the_part,
                self.moves[index].line + 1
            )),
            None => Ok(()),
        }
    }

    /// The moves of a closed contour whose ends coincide; the error says why there are none.
    pub(crate) fn closed(&self, contour: &Cut) -> Result<Range<usize>, String> {
        self.refuse_pause(contour)?;
        let (own, ordinal) = (contour.contour_steps(), contour.contour);
        if !contour.closed || own.is_empty() {
            return Err(say!(
                only_a_closed_contour_begins_elsewhere_or_goes_round,
                ordinal
            ));
        }
        if !self.names_places() {
            return Ok(own);
        }
        // Leads that only nearly coincide belong to it.
        let mut wider =
            (0..=contour.lead_in.min(contour.lead_out)).map(|by| own.start - by..own.end + by);
        wider
            .find(|own| self.moves[own.start].from == self.moves[own.end - 1].to)
            .ok_or_else(|| say!(the_contour_misses_its_own_begin, ordinal))
    }
}

/// The contours of a program, and the moves before which it pauses.
fn contours(trace: &Trace) -> (Vec<Cut>, Vec<usize>) {
    // Cuts count all steps.
    let mut move_of = Vec::with_capacity(trace.steps.len() + 1);
    let (mut count, mut pauses) = (0, Vec::new());
    for step in &trace.steps {
        move_of.push(count);
        count += usize::from(step.moves());
        if step.kind == Kind::Pause {
            pauses.push(count);
        }
    }
    let moves = |steps: Range<usize>| {
        let at = |step: usize| move_of.get(step).copied().unwrap_or(count);
        at(steps.start)..at(steps.end)
    };
    let mut ordinal = 0;
    let contours = cuts(trace).into_iter().map(|cut| {
        let (own, all) = (moves(cut.contour_steps()), moves(cut.steps.clone()));
        ordinal += usize::from(!cut.is_way);
        Cut {
            contour: ordinal,
            lead_in: own.start - all.start,
            lead_out: all.end - own.end,
            steps: all,
            ..cut
        }
    });
    (contours.collect(), pauses)
}

/// Where each move begins and ends. Of a program that counts these are whole µm, and the drift of a contour's arcs is
/// taken back arc by arc, so that it closes; a full circle ends where it begins, and has none.
fn places(trace: &Trace, steps: &[&Step], contours: &[Cut]) -> Result<Vec<[Place; 2]>, String> {
    let counts = !trace.writing.names_places;
    let whole = |x: f64| if counts { x.round() } else { x };
    let near = |point: Point| {
        place(point.map(whole))
            .ok_or_else(|| say!(the_path_runs_too_far_out_for_a_program).to_owned())
    };
    let drifts = |step: &Step| {
        let arc = step.ideal.as_ref().and_then(Segment::as_arc);
        counts && arc.is_some_and(|arc| !arc.is_full_turn())
    };
    let mut found = Vec::with_capacity(steps.len());
    // What has been taken back so far.
    let mut back = Vector::zeros();
    for contour in contours {
        let own = contour.contour_steps();
        let of_contour = steps.get(own.clone()).unwrap_or_default();
        let drift = match (of_contour.first(), of_contour.last()) {
            (Some(first), Some(last)) if contour.closed => last.end - first.start,
            _ => Vector::zeros(),
        };
        let arcs = of_contour.iter().filter(|step| drifts(step)).count();
        let (before, mut passed) = (back, 0.0);
        for index in contour.steps.clone() {
            let Some(step) = steps.get(index) else { break };
            let from = near(step.start - back.map(whole))?;
            if own.contains(&index) && drifts(step) {
                passed += 1.0;
                back = before + drift * (passed / arcs as f64);
            }
            found.push([from, near(step.end - back.map(whole))?]);
        }
    }
    Ok(found)
}
