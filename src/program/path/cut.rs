//! The contours of a program: everything cut between two pauses, with way in and way out; a pause before a tab belongs
//! to the contour.

use super::contour::closing;
use super::trace::{Kind, Step, Trace};
use super::way::Way;
use std::ops::Range;

/// A contour with its ways in and out, or the way between two contours.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Cut {
    /// As the trace counts them.
    pub(crate) contour: usize,
    /// Indices of the trace's steps; all of them move except the pauses before tabs.
    pub(crate) steps: Range<usize>,
    /// Steps at the beginning that lead to the contour.
    pub(crate) lead_in: usize,
    /// Steps at the end that lead away from it.
    pub(crate) lead_out: usize,
    /// The steps between them come back to where they begin.
    pub(crate) closed: bool,
    /// Nothing is cut here.
    pub(crate) is_way: bool,
}

impl Cut {
    /// Indices of the steps of the contour itself.
    pub(crate) fn contour_steps(&self) -> Range<usize> {
        self.steps.start + self.lead_in
            ..self
                .steps
                .end
                .saturating_sub(self.lead_out)
                .max(self.steps.start + self.lead_in)
    }
}

/// The cuts of a trace, in its order.
pub(crate) fn cuts(trace: &Trace) -> Vec<Cut> {
    let mut found = Vec::new();
    let mut index = 0;
    while let Some(first) = trace.steps.get(index) {
        if !first.moves() {
            index += 1;
            continue;
        }
        let is_same =
            |step: &Step| step.moves() && (step.kind == Kind::Rapid) == (first.kind == Kind::Rapid);
        let is_within = |step: &&Step| {
            step.contour == first.contour && (is_same(step) || step.kind == Kind::Pause)
        };
        let count = trace.steps[index..].iter().take_while(is_within).count();
        let count = trace.steps[index..index + count]
            .iter()
            .rposition(is_same)
            .map_or(1, |last| last + 1);
        found.push(cut_in(trace, index..index + count));
        index += count;
    }
    found
}

/// The division of some steps of a trace, all of which move except the pauses before tabs.
pub(crate) fn cut_in(trace: &Trace, steps: Range<usize>) -> Cut {
    let own = trace.steps.get(steps.clone()).unwrap_or_default();
    let first = own.iter().find(|step| step.moves());
    let cut = Cut {
        contour: first.map_or(0, |step| step.contour),
        is_way: first.is_some_and(|step| step.kind == Kind::Rapid),
        steps,
        ..Cut::default()
    };
    if cut.is_way {
        return cut;
    }
    let moves = own.iter().filter(|step| step.moves());
    let stop = own.iter().position(|step| !step.moves());
    let closing = closing(&Way::of_steps(moves, trace.writing).stopping(stop));
    // Pauses count as steps here.
    let places = own.iter().enumerate().filter(|(_, step)| step.moves());
    let places: Vec<usize> = places.map(|(place, _)| place).collect();
    let place = |nth: usize| places.get(nth).copied().unwrap_or(own.len());
    let end = places.len() - closing.lead_out;
    let behind = end.checked_sub(1).map_or(0, |last| place(last) + 1);
    let lead_in = place(closing.lead_in);
    Cut {
        lead_in,
        lead_out: own.len() - behind.max(lead_in),
        closed: closing.closed,
        ..cut
    }
}
