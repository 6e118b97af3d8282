//! Work of a comparison, in counted steps.

use std::cell::Cell;

/// The most steps of one comparison: distances of a place from a segment, and the like.
pub(super) const MOST: usize = 4_000_000;

/// The steps that are left. Where none are, what is found is not known to be so.
#[derive(Debug)]
pub(super) struct Budget(Cell<usize>);

impl Budget {
    pub(super) fn of(steps: usize) -> Budget {
        Budget(Cell::new(steps))
    }

    /// Whether there were too few.
    pub(super) fn is_spent(&self) -> bool {
        self.0.get() == 0
    }

    /// Takes some steps; false where too few are left.
    pub(super) fn take(&self, steps: usize) -> bool {
        match self.0.get().checked_sub(steps) {
            Some(left) => {
                self.0.set(left);
                true
            }
            None => {
                self.0.set(0);
                false
            }
        }
    }
}
