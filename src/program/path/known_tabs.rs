//! The stops of contours as they are known already.

use rustc_hash::FxHashMap;

/// Whether cuts up to a stop and the one after it are a contour and its tab, by the marks of them
/// all: what an edit leaves alone is not worked out again.
#[derive(Clone, Debug, Default)]
pub(crate) struct KnownTabs {
    found: FxHashMap<u64, Option<bool>>,
    /// The answers in use since it was tidied, and the most that ever were.
    used: usize,
    most_used: usize,
}

impl KnownTabs {
    pub(crate) fn get(&mut self, mark: u64, is_tab: impl FnOnce() -> Option<bool>) -> Option<bool> {
        self.used += 1;
        *self.found.entry(mark).or_insert_with(is_tab)
    }

    /// Forgets everything where much more is known than ever was in use at once.
    pub(super) fn tidy(&mut self) {
        self.most_used = self.most_used.max(self.used);
        if self.found.len() > 4 * self.most_used + 4096 {
            self.found.clear();
        }
        self.used = 0;
    }
}
