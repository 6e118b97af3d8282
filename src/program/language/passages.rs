//! The contours of a program: what is cut between two pauses, with its way in and its way out.

use crate::geometry::{Point, Segment};
use crate::program::trace::{Kind, Step, Trace};
use std::ops::Range;

/// How far two places that are meant as one may lie apart, µm, beside 1 µm for each arc between them: published programs stay within.
const NEAR: f64 = 2.0;

/// Blocks that a way in or out of an open program has at most.
const LONGEST_LEAD: usize = 6;

/// A contour with its ways in and out, or the way between two contours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Passage {
    /// As the trace counts them.
    pub contour: usize,
    /// Indices of the trace's steps, all of which move.
    pub steps: Range<usize>,
    /// Steps at the beginning that lead to the contour.
    pub lead_in: usize,
    /// Steps at the end that lead away from it.
    pub lead_out: usize,
    /// The steps between them come back to where they begin.
    pub closed: bool,
    /// Nothing is cut here.
    pub is_way: bool,
}

impl Passage {
    /// Indices of the steps of the contour itself.
    pub fn contour_steps(&self) -> Range<usize> {
        self.steps.start + self.lead_in..self.steps.end.saturating_sub(self.lead_out).max(self.steps.start + self.lead_in)
    }
}

/// The passages of a trace, in its order.
pub fn passages(trace: &Trace) -> Vec<Passage> {
    let mut found = Vec::new();
    let mut index = 0;
    while let Some(first) = trace.steps.get(index) {
        if !first.moves() {
            index += 1;
            continue;
        }
        let is_same =
            |step: &&Step| step.moves() && step.contour == first.contour && (step.kind == Kind::Rapid) == (first.kind == Kind::Rapid);
        let count = trace.steps[index..].iter().take_while(is_same).count();
        found.push(passage(&trace.steps[index..index + count], index));
        index += count;
    }
    found
}

fn passage(steps: &[Step], offset: usize) -> Passage {
    let contour = steps.first().map_or(0, |step| step.contour);
    let all = Passage { contour, steps: offset..offset + steps.len(), lead_in: 0, lead_out: 0, closed: false, is_way: false };
    if steps.first().is_some_and(|step| step.kind == Kind::Rapid) {
        return Passage { is_way: true, ..all };
    }
    let arcs = steps.iter().filter(|step| step.kind == Kind::Arc).count();
    // Where the machine stands before the step `index`, or at the end; and where it would, did it not drift while it counts.
    let node = |index: usize| steps.get(index).map_or_else(|| steps.last().map_or(Point::origin(), |step| step.end), |step| step.start);
    let mut meant = vec![node(0)];
    for step in steps {
        let travel = step.ideal.as_ref().map_or(step.end - step.start, |ideal| ideal.end() - ideal.start());
        meant.extend(meant.last().map(|before| before + travel));
    }
    let is_near = |one: usize, other: usize| {
        let near = |a: Point, b: Point| (a - b).norm() <= NEAR + arcs as f64;
        near(node(one), node(other)) || matches!((meant.get(one), meant.get(other)), (Some(a), Some(b)) if near(*a, *b))
    };
    let count = steps.len();
    let encloses = |lead_in: usize, lead_out: usize| match steps.get(lead_in..count.saturating_sub(lead_out)) {
        None | Some([]) => false,
        Some([one]) => matches!(one.ideal, Some(Segment::Arc(arc)) if arc.is_full_turn()),
        // There and back encloses nothing.
        Some([there, back]) => there.kind == Kind::Arc || back.kind == Kind::Arc,
        Some(_) => true,
    };
    let is_closed = |lead_in: usize, lead_out: usize| encloses(lead_in, lead_out) && is_near(lead_in, count - lead_out);
    if is_near(0, count) {
        // The way out runs back along the way in.
        let mut leads = 0;
        while encloses(leads + 1, leads + 1) && is_near(leads + 1, count - leads - 1) {
            leads += 1;
        }
        return Passage { lead_in: leads, lead_out: leads, closed: encloses(leads, leads), ..all };
    }
    let leads = (1..=LONGEST_LEAD).flat_map(|both| (0..=both).map(move |lead_out| (both - lead_out, lead_out)));
    match leads.into_iter().find(|&(lead_in, lead_out)| is_closed(lead_in, lead_out)) {
        Some((lead_in, lead_out)) => Passage { lead_in, lead_out, closed: true, ..all },
        None => all,
    }
}
