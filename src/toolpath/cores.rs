//! Work over the cores of the machine: what is made, or held against a proof, piece by piece.

use super::job::Job;
use super::path::Refusal;
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
use std::ops::Range;

/// Pieces that one core takes at a time.
const STEP: usize = 1024;

/// Steps between two questions whether the answer is still wanted.
const ROUND: usize = 32;

/// What comes of each of so many, in their order. A core takes so many at a time; to wake one takes as long as some microseconds of work.
pub(super) fn each<Made: Send>(
    count: usize,
    at_a_time: usize,
    made: impl Fn(usize) -> Made + Sync + Send,
) -> Vec<Made> {
    match count <= at_a_time {
        true => (0..count).map(made).collect(),
        false => over_cores(count, at_a_time).map(made).collect(),
    }
}

/// The same where two things come of each.
pub(super) fn each_two<One: Send, Other: Send>(
    count: usize,
    at_a_time: usize,
    made: impl Fn(usize) -> (One, Other) + Sync + Send,
) -> (Vec<One>, Vec<Other>) {
    match count <= at_a_time {
        true => (0..count).map(made).unzip(),
        false => over_cores(count, at_a_time).map(made).unzip(),
    }
}

fn over_cores(count: usize, at_a_time: usize) -> impl IndexedParallelIterator<Item = usize> {
    (0..count).into_par_iter().with_min_len(at_a_time)
}

impl Job<'_> {
    /// The first fault, in their order, among `count` pieces; `fault_of` says that of some of them.
    pub(super) fn first_fault<Fault: Send>(
        &self,
        count: usize,
        fault_of: impl Fn(Range<usize>) -> Result<(), Fault> + Sync,
    ) -> Result<Result<(), Fault>, Refusal> {
        for first in (0..count).step_by(ROUND * STEP) {
            self.go_on()?;
            let last = (first + ROUND * STEP).min(count);
            let step = |at: usize| first + at * STEP..(first + (at + 1) * STEP).min(last);
            let steps = (last - first).div_ceil(STEP);
            let fault = match steps {
                // To wake a core takes longer.
                1 => fault_of(step(0)).err(),
                _ => {
                    let steps = (0..steps).into_par_iter();
                    steps.find_map_first(|at| fault_of(step(at)).err())
                }
            };
            if let Some(fault) = fault {
                return Ok(Err(fault));
            }
        }
        Ok(Ok(()))
    }
}
