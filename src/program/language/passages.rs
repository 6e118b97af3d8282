//! The contours of a program: what is cut between two pauses, with its way in and its way out.

use crate::geometry::{Point, Segment};
use crate::program::Document;
use crate::program::trace::{Chain, Kind, Step, Trace};
use std::ops::Range;

/// How far two places that are meant as one may lie apart, µm, beside 1 µm for each arc between them: published programs stay within.
const NEAR: f64 = 2.0;

/// Blocks that a way in or out of an open program has at most.
const LONGEST_LEAD: usize = 6;

/// A contour with its ways in and out, or the way between two contours.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
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
        // A chain of all its steps lacks none.
        let own = passage_of(&Chain::of(&trace.steps[index..index + count])).unwrap_or_default();
        found.push(Passage { steps: own.steps.start + index..own.steps.end + index, ..own });
        index += count;
    }
    found
}

/// The chain of moves that touches a byte, what it comes to, and the number of the touching one.
pub fn passage_at(document: &Document, offset: usize) -> Option<(Chain<'static>, Passage, usize)> {
    let (chain, nth) = document.chain_at(offset)?;
    if let Some(passage) = passage_of(&chain) {
        return Some((chain, passage, nth));
    }
    let (chain, nth) = document.whole_chain_at(offset)?;
    let passage = passage_of(&chain)?;
    Some((chain, passage, nth))
}

/// What a chain of steps comes to, its steps counted from 0; `None` where it hangs on steps that the chain does not hold.
pub fn passage_of(chain: &Chain<'_>) -> Option<Passage> {
    let first = chain.step(0);
    let contour = first.map_or(0, |step| step.contour);
    let all = Passage { contour, steps: 0..chain.count(), lead_in: 0, lead_out: 0, closed: false, is_way: false };
    if first.is_some_and(|step| step.kind == Kind::Rapid) {
        return Some(Passage { is_way: true, ..all });
    }
    let is_near = |one: usize, other: usize| -> Option<bool> {
        let near = |a: Point, b: Point| (a - b).norm() <= NEAR + chain.arcs() as f64;
        Some(near(chain.node(one)?, chain.node(other)?) || near(chain.meant_node(one)?, chain.meant_node(other)?))
    };
    let count = chain.count();
    let encloses = |lead_in: usize, lead_out: usize| -> Option<bool> {
        Some(match count.saturating_sub(lead_in + lead_out) {
            0 => false,
            1 => matches!(chain.step(lead_in)?.ideal, Some(Segment::Arc(arc)) if arc.is_full_turn()),
            // There and back encloses nothing.
            2 => chain.step(lead_in)?.kind == Kind::Arc || chain.step(lead_in + 1)?.kind == Kind::Arc,
            _ => true,
        })
    };
    if is_near(0, count)? {
        // The way out runs back along the way in.
        let mut leads = 0;
        while encloses(leads + 1, leads + 1)? && is_near(leads + 1, count - leads - 1)? {
            leads += 1;
        }
        return Some(Passage { lead_in: leads, lead_out: leads, closed: encloses(leads, leads)?, ..all });
    }
    for (lead_in, lead_out) in (1..=LONGEST_LEAD).flat_map(|both| (0..=both).map(move |lead_out| (both - lead_out, lead_out))) {
        if encloses(lead_in, lead_out)? && is_near(lead_in, count - lead_out)? {
            return Some(Passage { lead_in, lead_out, closed: true, ..all });
        }
    }
    Some(all)
}
