//! Work of a comparison, in counted steps.

use std::cell::Cell;

/// The most steps of one comparison: distances of a place from a segment, and the like.
const MOST: usize = 4_000_000;

/// The steps that are left. Where none are, nothing more is looked for, and what is known is told.
#[derive(Debug)]
pub(super) struct Budget(Cell<usize>);

impl Default for Budget {
    fn default() -> Budget {
        Budget(Cell::new(MOST))
    }
}

impl Budget {
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
