//! How an edit turned one list into another.

use crate::toolpath::{NEW, which_it_is, which_it_was};

/// For each item its index before the edit, and for each earlier item its index now, in their
/// order.
#[derive(Clone, Debug)]
pub(super) struct Change {
    was: Vec<u32>,
    is: Vec<u32>,
}

impl Change {
    /// `None` where too much has changed.
    pub(super) fn of<T>(
        before: &[T],
        now: &[T],
        is_same: impl Fn(&T, &T) -> bool,
    ) -> Option<Change> {
        let was = which_it_was(before, now, is_same)?;
        let is = which_it_is(&was, before.len());
        Some(Change { was, is })
    }

    /// The change of a list of `count` items, none of which has changed.
    pub(super) fn none(count: usize) -> Change {
        let all: Vec<u32> = (0..count as u32).collect();
        Change {
            was: all.clone(),
            is: all,
        }
    }

    /// The old index of a present item; `None` for a new one.
    pub(super) fn was(&self, index: usize) -> Option<usize> {
        let was = self.was.get(index).filter(|was| **was != NEW);
        was.map(|was| *was as usize)
    }

    /// The present index of an earlier item; `None` for one that is gone.
    pub(super) fn is(&self, index: usize) -> Option<usize> {
        let is = self.is.get(index).filter(|is| **is != NEW);
        is.map(|is| *is as usize)
    }

    /// The items that are gone, by their old indices.
    pub(super) fn gone(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is.len()).filter(|was| self.is[*was] == NEW)
    }

    /// The new items.
    pub(super) fn come(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.was.len()).filter(|now| self.was[*now] == NEW)
    }
}
