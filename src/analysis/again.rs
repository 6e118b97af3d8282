//! Runs that are looked at again after the limit was reached: whether a look at everything would
//! still end where it did.
//!
//! Where not all of a drawing can be compared, an edit has all of it looked at again, in machining
//! order, so that the same is left out as for a fresh reading. An edit after which that look would
//! end where it did before needs none: one beyond the end, or one before it that adds as much work
//! as it takes away.

use super::compare::RunId;
use rustc_hash::FxHashSet;

/// Forgotten runs that had been compared with all their neighbours, until they have been compared
/// again. A look at everything ends at the same pair if all of them, and everything near them, lie
/// before the end, and as much is seen of them as before.
#[derive(Clone, Debug, Default)]
pub(super) struct Again {
    runs: FxHashSet<RunId>,
    /// How much had been seen before the first of them was forgotten.
    seen: usize,
    /// One of them comes, or came, near a run after the end.
    is_near_the_end: bool,
}

impl Again {
    pub(super) fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    pub(super) fn holds(&self, run: &RunId) -> bool {
        self.runs.contains(run)
    }

    /// Forgets a run; `seen` is how much had been seen with it.
    pub(super) fn forget(&mut self, run: RunId, seen: usize) {
        if self.runs.is_empty() {
            (self.seen, self.is_near_the_end) = (seen, false);
        }
        self.runs.insert(run);
    }

    pub(super) fn comes_near_the_end(&mut self) {
        self.is_near_the_end = true;
    }

    /// To be called when some of them have been compared again; `seen` is how much is seen in all.
    /// False where that shows that a look at everything would end elsewhere.
    pub(super) fn compared(&mut self, runs: &[RunId], seen: usize) -> bool {
        for run in runs {
            self.runs.remove(run);
        }
        !self.runs.is_empty() || (seen == self.seen && !self.is_near_the_end)
    }
}
