//! Where workers look for the projects' files, and what waits for them.

use super::config::ProjectFile;
use rustc_hash::FxHashMap;
use std::collections::hash_map::Entry;
use std::path::PathBuf;
use std::sync::Arc;

/// What is done to `S` with the file that was found, if there is one.
pub(super) type Then<S> = Box<dyn FnOnce(&mut S, Option<Arc<ProjectFile>>) + Send>;

pub(super) struct Looks<S> {
    /// By the folder from which a worker looks upwards: what has been asked since it began.
    pub(super) under_way: FxHashMap<PathBuf, Vec<Then<S>>>,
    /// The documents that wait, and for how many looks.
    waiting: FxHashMap<Arc<str>, usize>,
    /// Differs after every change of settings: what an earlier look found is out of date.
    pub(super) stamp: u64,
}

impl<S> Default for Looks<S> {
    fn default() -> Self {
        Looks {
            under_way: FxHashMap::default(),
            waiting: FxHashMap::default(),
            stamp: 0,
        }
    }
}

impl<S> Looks<S> {
    pub(super) fn is_at_rest(&self) -> bool {
        self.under_way.is_empty()
    }

    /// True where messages about a document wait for its settings.
    pub(super) fn hold(&self, uri: &str) -> bool {
        self.waiting.contains_key(uri)
    }

    /// What workers are looking at may have changed.
    pub(super) fn begin_again(&mut self) {
        self.stamp += 1;
    }

    pub(super) fn have_wait(&mut self, uri: &Arc<str>) {
        *self.waiting.entry(uri.clone()).or_default() += 1;
    }

    pub(super) fn let_go(&mut self, uri: &Arc<str>) {
        if let Entry::Occupied(mut waiting) = self.waiting.entry(uri.clone()) {
            *waiting.get_mut() -= 1;
            if *waiting.get() == 0 {
                waiting.remove();
            }
        }
    }
}
