//! What searches have found, until the next edit but one.

use rustc_hash::FxHashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// By a mark of all that each search looked at.
#[derive(Debug)]
pub(in crate::program) struct Searches<T> {
    known: Mutex<FxHashMap<u64, T>>,
    before_edit: FxHashMap<u64, T>,
}

impl<T> Default for Searches<T> {
    fn default() -> Searches<T> {
        Searches {
            known: Mutex::default(),
            before_edit: FxHashMap::default(),
        }
    }
}

impl<T: Clone> Clone for Searches<T> {
    fn clone(&self) -> Searches<T> {
        Searches {
            known: Mutex::new(self.held().clone()),
            before_edit: self.before_edit.clone(),
        }
    }
}

impl<T: Clone> Searches<T> {
    fn held(&self) -> MutexGuard<'_, FxHashMap<u64, T>> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What the search that is marked so finds. While it looks, others may ask.
    pub(crate) fn found(&self, mark: u64, search: impl FnOnce() -> T) -> T {
        if let Some(known) = self.held().get(&mark) {
            return known.clone();
        }
        let found = self.before_edit.get(&mark).cloned().unwrap_or_else(search);
        self.held().insert(mark, found.clone());
        found
    }

    /// Takes note of an edit.
    pub(crate) fn edited(&mut self) {
        let known = std::mem::take(&mut *self.held());
        if !known.is_empty() {
            self.before_edit = known;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_asked_for_is_known_until_the_next_edit_but_one() {
        let mut searches = Searches::default();
        assert_eq!(searches.found(1, || "found"), "found");
        assert_eq!(searches.found(1, || "again"), "found");
        searches.edited();
        assert_eq!(searches.clone().found(1, || "again"), "found");
        assert_eq!(searches.found(2, || "other"), "other");
        searches.edited();
        assert_eq!(searches.found(2, || "again"), "other");
        assert_eq!(searches.found(1, || "again"), "again");
    }
}
