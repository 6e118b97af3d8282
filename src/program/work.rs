//! How much work is done, for the tests that bound it. Nothing is counted in a build that is no test.

/// What is counted.
#[derive(Clone, Copy, Debug)]
pub(in crate::program) enum Work {
    /// Cuts from which contours are looked for.
    Cuts,
    /// Contours that are judged, and searches for a block to blame in one.
    Contours,
    Blames,
    /// Findings that are looked at one by one to tell the first few, and to find those that a slip may explain.
    Findings,
    Troubles,
    /// Cuts whose repairs are searched for.
    Repairs,
    /// Chunks without steps on the way to the one before a place.
    ChunksPassed,
}

/// Counts some more.
#[cfg(not(test))]
pub(in crate::program) fn add(_: Work, _: usize) {}

#[cfg(test)]
pub(in crate::program) use counted::{add, take};

#[cfg(test)]
mod counted {
    use super::Work;
    use std::cell::Cell;

    thread_local! {
        static COUNTS: Cell<[usize; 7]> = const { Cell::new([0; 7]) };
    }

    pub(in crate::program) fn add(work: Work, count: usize) {
        let mut counts = COUNTS.get();
        counts[work as usize] += count;
        COUNTS.set(counts);
    }

    /// What this thread has done of it since the last time.
    pub(in crate::program) fn take(work: Work) -> usize {
        let mut counts = COUNTS.get();
        let taken = std::mem::take(&mut counts[work as usize]);
        COUNTS.set(counts);
        taken
    }
}
