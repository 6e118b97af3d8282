//! Work over the cores of the machine: what is made, or checked against a proof, piece by piece.

use rayon::iter::{
    IndexedParallelIterator, IntoParallelIterator, ParallelExtend, ParallelIterator,
};
use std::ops::Range;

/// Pieces that one core takes at a time.
const STEP: usize = 1024;

/// Steps between two questions whether the answer is still wanted.
const ROUND: usize = 32;

/// The results for `count` items, in their order. A core takes a number of them at a time; waking
/// one costs as much as some microseconds of work.
pub(crate) fn each<Made: Send>(
    count: usize,
    at_a_time: usize,
    made: impl Fn(usize) -> Made + Sync + Send,
) -> Vec<Made> {
    let mut all = Vec::with_capacity(count);
    extend(&mut all, count, at_a_time, made);
    all
}

/// The same after others.
pub(super) fn extend<Made: Send>(
    all: &mut Vec<Made>,
    count: usize,
    at_a_time: usize,
    made: impl Fn(usize) -> Made + Sync + Send,
) {
    match count <= at_a_time {
        true => all.extend((0..count).map(made)),
        false => all.par_extend(over_cores(count, at_a_time).map(made)),
    }
}

/// The sum of this many numbers, the same one whatever the cores are.
pub(super) fn sum(count: usize, of: impl Fn(usize) -> f64 + Sync + Send) -> f64 {
    let parts = each(count.div_ceil(STEP), 2, |part| {
        let numbers = part * STEP..((part + 1) * STEP).min(count);
        numbers.map(&of).sum::<f64>()
    });
    parts.into_iter().sum()
}

/// True where that is so for one of this many.
pub(super) fn any(
    count: usize,
    at_a_time: usize,
    is_it: impl Fn(usize) -> bool + Sync + Send,
) -> bool {
    match count <= at_a_time {
        true => (0..count).any(is_it),
        false => over_cores(count, at_a_time).any(is_it),
    }
}

fn over_cores(count: usize, at_a_time: usize) -> impl IndexedParallelIterator<Item = usize> {
    (0..count).into_par_iter().with_min_len(at_a_time)
}

/// The first fault, in their order, among `count` pieces; `fault_of` says that of some of them. Now and then it is asked whether to `go_on`.
pub(super) fn first_fault<Fault: Send, Stop>(
    count: usize,
    go_on: impl Fn() -> Result<(), Stop>,
    fault_of: impl Fn(Range<usize>) -> Result<(), Fault> + Sync,
) -> Result<Result<(), Fault>, Stop> {
    for first in (0..count).step_by(ROUND * STEP) {
        go_on()?;
        let last = (first + ROUND * STEP).min(count);
        let step = |at: usize| first + at * STEP..(first + (at + 1) * STEP).min(last);
        let steps = (last - first).div_ceil(STEP);
        let fault = match steps {
            // Waking a core would take longer.
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
