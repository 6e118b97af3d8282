//! The machine's path in a part of a program: an answer costs the length of the part, and a glance at each cut.

use super::path::{Cut, Kind, Step, Trace, Way, Writing, cuts};
use crate::geometry::Point;
use crate::text::SourceText;
use crate::toolpath::each;
use std::ops::Range;

/// Cuts that one core follows at a time.
const CUTS: usize = 16;

/// A program of any language, cut by cut in the order in which the machine runs them.
pub(crate) trait Program: Sync {
    fn text(&self) -> &SourceText;

    /// How its blocks give their ends.
    fn writing(&self) -> Writing;

    /// The machine's start, µm, the origin by default; and whether the program gives it.
    fn begin(&self) -> (Point, bool);

    /// The first unreadable line: the position after it depends on what was meant.
    fn unread_line(&self) -> Option<usize>;

    fn cut_count(&self) -> usize;

    /// The cuts that may run a line, in their order.
    fn cuts_at(&self, line: usize) -> Vec<usize>;

    /// The first cut that may hold something that stands behind a line.
    fn first_behind(&self, line: usize) -> usize;

    /// How many contours end within a cut: pauses, except those before tabs.
    fn contours_in(&self, cut: usize) -> usize;

    /// Whether it has steps.
    fn has_steps(&self, cut: usize) -> bool;

    /// Hands out the steps of a cut; `contour` is that of the first, and afterwards that of the next cut's first.
    fn walk(&self, cut: usize, contour: &mut usize, each: &mut dyn FnMut(Step));
}

/// The contours that end before each cut.
fn contours_before(program: &dyn Program) -> Vec<usize> {
    let mut contour = 0;
    let before = |cut| {
        let before = contour;
        contour += program.contours_in(cut);
        before
    };
    (0..program.cut_count()).map(before).collect()
}

fn steps_of(program: &dyn Program, cut: usize, mut contour: usize) -> Vec<Step> {
    let mut steps = Vec::new();
    program.walk(cut, &mut contour, &mut |step| steps.push(step));
    steps
}

/// Every step of a program.
pub(crate) fn trace(program: &dyn Program) -> Trace {
    let (start, start_is_known) = program.begin();
    let before = contours_before(program);
    let of_cuts = each(before.len(), CUTS, |cut| {
        steps_of(program, cut, before[cut])
    });
    Trace {
        steps: of_cuts.into_iter().flatten().collect(),
        start,
        start_is_known,
        writing: program.writing(),
        ..Trace::default()
    }
}

/// The steps whose text overlaps or touches a range of bytes.
pub(crate) fn steps_in(program: &dyn Program, range: Range<usize>) -> Vec<Step> {
    let text = program.text();
    let lines = text.line_of(range.start)..=text.line_of(range.end);
    let mut touching: Vec<usize> = lines.flat_map(|line| program.cuts_at(line)).collect();
    touching.sort_unstable();
    touching.dedup();
    let before = contours_before(program);
    let steps = touching
        .into_iter()
        .flat_map(|cut| steps_of(program, cut, before[cut]));
    steps
        .filter(|step| step.range.start <= range.end && range.start <= step.range.end)
        .collect()
}

/// The moves between two stops, or of a contour with its tab, of which one touches a byte.
pub(crate) struct CutAt {
    /// Without the steps of stops.
    pub(crate) steps: Vec<Step>,
    /// Its division; steps are counted as these.
    pub(crate) cut: Cut,
    /// The number of the touching one: of two that touch the byte, the one that begins there.
    pub(crate) nth: usize,
}

/// The cut of which a move touches a byte.
pub(crate) fn cut_at(program: &dyn Program, offset: usize) -> Option<CutAt> {
    let touches =
        |step: &Step| step.moves() && step.range.start <= offset && offset <= step.range.end;
    let before = contours_before(program);
    let at = program.cuts_at(program.text().line_of(offset));
    let (first, step) = at.into_iter().rev().find_map(|cut| {
        let steps = steps_of(program, cut, before[cut]);
        let step = steps.iter().rev().find(|step| touches(step))?;
        Some((cut, step.clone()))
    })?;
    // All cuts that may hold steps of the same contour.
    let is_of_it = |cut: &usize| {
        let own = before[*cut];
        own <= step.contour && step.contour <= own + program.contours_in(*cut)
    };
    let from = (0..first)
        .rev()
        .take_while(is_of_it)
        .last()
        .unwrap_or(first);
    let to = (first..before.len()).take_while(is_of_it).last()?;
    let steps = (from..=to).flat_map(|cut| steps_of(program, cut, before[cut]));
    let trace = Trace {
        steps: steps.collect(),
        writing: program.writing(),
        ..Trace::default()
    };
    let index = trace.steps.iter().rposition(|own| *own == step)?;
    let cut = cuts(&trace)
        .into_iter()
        .find(|cut| cut.steps.contains(&index))?;
    let moves = |steps: Range<usize>| {
        let own = trace.steps[steps].iter();
        own.filter(|step| step.moves()).cloned().collect::<Vec<_>>()
    };
    let (start, own) = (cut.steps.start, cut.contour_steps());
    let steps = moves(cut.steps.clone());
    Some(CutAt {
        nth: moves(start..index).len(),
        cut: Cut {
            steps: 0..steps.len(),
            lead_in: moves(start..own.start).len(),
            lead_out: moves(own.end..cut.steps.end).len(),
            ..cut
        },
        steps,
    })
}

/// What is cut from the last stop or rapid on before a byte, as a way.
pub(crate) fn way_before(program: &dyn Program, offset: usize) -> Way {
    let at = program.cuts_at(program.text().line_of(offset));
    let is_cut = |step: &Step| matches!(step.kind, Kind::Line | Kind::Arc);
    let mut steps: Vec<Step> = Vec::new();
    for cut in (0..at.last().map_or(0, |last| last + 1)).rev() {
        let mut own = steps_of(program, cut, 0);
        own.retain(|step| step.range.end <= offset);
        let other = own.iter().rposition(|step| !is_cut(step));
        steps.splice(0..0, own.drain(other.map_or(0, |other| other + 1)..));
        if other.is_some() {
            break;
        }
    }
    Way::of_steps(&steps, program.writing())
}

/// The first stop after a byte.
pub(crate) fn stop_behind(program: &dyn Program, offset: usize) -> Option<Range<usize>> {
    let first = program.first_behind(program.text().line_of(offset));
    (first..program.cut_count()).find_map(|cut| {
        let steps = steps_of(program, cut, 0).into_iter();
        let mut stops = steps.filter(|step| !step.moves() && step.range.start > offset);
        stops.next().map(|stop| stop.range)
    })
}

/// The first block that moves.
pub(crate) fn first_move(program: &dyn Program) -> Option<Range<usize>> {
    (0..program.cut_count()).find_map(|cut| {
        let mut steps = steps_of(program, cut, 0).into_iter();
        steps.find(Step::moves).map(|step| step.range)
    })
}

#[cfg(test)]
mod tests;
