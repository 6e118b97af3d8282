//! Passes without a stop between them: the control's correction is switched off and on again on the way from one to the
//! next, or the wire comes back to where it began.

use crate::geometry::Bounds;
use crate::program::path::{self, Cut, Step, Trace};
use std::ops::Range;

/// The most blocks of a way in without a correction.
const LEAD: usize = 2;

/// Cuts, and the steps at which some of them go on where the one before ends, without a stop.
#[derive(Default)]
pub(super) struct Parted {
    pub(super) cuts: Vec<Cut>,
    pub(super) going_on: Vec<usize>,
}

/// The cuts of a trace, each with one correction: a new one begins where the correction is switched on again after a way
/// without it. Only where each of them is a closed contour; `all` parts the others too, where it is also switched from
/// side to side behind a stop.
pub(super) fn parted(trace: &Trace, all: bool) -> Parted {
    let mut parted = Parted::default();
    for cut in path::cuts(trace) {
        let steps = trace.steps.get(cut.steps.clone()).unwrap_or_default();
        let has_stops = steps.iter().any(|step| !step.moves());
        let pieces = match steps.iter().any(|step| step.side.is_some()) {
            true => pieces(steps, cut.steps.start),
            false => returns(steps, cut.steps.start),
        };
        if cut.is_way || pieces.len() < 2 {
            parted.cuts.push(without_correction(trace, cut, all));
            continue;
        }
        let found: Vec<Cut> = pieces
            .iter()
            .map(|piece| path::cut_in(trace, piece.clone()))
            .collect();
        if !all && (has_stops || !found.iter().all(|piece| piece.closed)) {
            parted.cuts.push(cut);
            continue;
        }
        let mut end = None;
        for piece in found {
            parted
                .going_on
                .extend(Some(piece.steps.start).filter(|start| end == Some(*start)));
            end = Some(piece.steps.end);
            let contour = cut.contour;
            parted
                .cuts
                .push(without_correction(trace, Cut { contour, ..piece }, all));
        }
    }
    parted
}

/// The steps from one switch to the next, without the stops between them; `first` is the index of the first step.
fn pieces(steps: &[Step], first: usize) -> Vec<Range<usize>> {
    let mut pieces = Vec::new();
    let mut begun = 0;
    // The end of the last step that moves, the sides of that and of the last one with a side.
    let (mut end, mut before, mut last) = (0, None, None);
    for (index, step) in steps.iter().enumerate().filter(|(_, step)| step.moves()) {
        let is_switched = step.side.is_some() && last.is_some() && step.side != before;
        if is_switched && (before.is_none() || end < index) {
            pieces.push(first + begun..first + end);
            begun = index;
        }
        (end, before, last) = (index + 1, step.side, step.side.or(last));
    }
    pieces.push(first + begun..first + end);
    pieces
}

/// The steps from one return to the beginning to the next, where each goes round beside the others: passes of coordinates.
fn returns(steps: &[Step], first: usize) -> Vec<Range<usize>> {
    let Some(begin) = steps.iter().find(|step| step.moves()) else {
        return Vec::new();
    };
    let mut pieces: Vec<(Range<usize>, Bounds)> = Vec::new();
    let (mut begun, mut bounds) = (0, Bounds::EMPTY);
    for (index, step) in steps.iter().enumerate() {
        bounds.merge(&Bounds::of_points(&[step.start, step.end]));
        if (step.end - begin.start).norm() < 1.0 && step.moves() {
            pieces.push((first + begun..first + index + 1, bounds));
            (begun, bounds) = (index + 1, Bounds::EMPTY);
        }
    }
    let is_whole = begun == steps.len();
    let mut boxes = pieces.iter().map(|(_, own)| own);
    let are_passes = boxes
        .next()
        .is_some_and(|one| boxes.all(|other| path::lie_beside(one, other)));
    match is_whole && are_passes {
        true => pieces.into_iter().map(|(piece, _)| piece).collect(),
        false => Vec::new(),
    }
}

/// The cut, its way out beginning where the correction is switched off, and its way in ending where it is switched on:
/// the contour is what has a correction, where that closes by itself. With `all` also where it does not: a pass up to
/// its tab closes only by its way back.
fn without_correction(trace: &Trace, cut: Cut, all: bool) -> Cut {
    let steps = trace.steps.get(cut.steps.clone()).unwrap_or_default();
    let is_without = |step: &&Step| step.moves() && step.side.is_none();
    let lead_in = steps.iter().take_while(is_without).count();
    let lead_out = steps.iter().rev().take_while(is_without).count();
    let is_kept = lead_in <= cut.lead_in && lead_out <= cut.lead_out;
    if cut.is_way || is_kept || lead_in == steps.len() {
        return cut;
    }
    let inner = path::cut_in(trace, cut.steps.start + lead_in..cut.steps.end - lead_out);
    if inner.closed && lead_in <= LEAD {
        return Cut {
            closed: true,
            lead_in: lead_in + inner.lead_in,
            lead_out: lead_out + inner.lead_out,
            ..cut
        };
    }
    if !all || lead_in > if cut.closed { cut.lead_in } else { LEAD } {
        return cut;
    }
    Cut {
        closed: cut.closed && lead_out <= cut.lead_out,
        lead_in: cut.lead_in.max(lead_in),
        lead_out: cut.lead_out.max(lead_out),
        ..cut
    }
}
