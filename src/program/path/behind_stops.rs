//! The continuation of an open cut after a stop: the tab of its contour, or pieces that return to the start together.

use super::contour::{Ends, is_tab};
use super::lay::mixed;
use super::way::Way;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Stops in one contour, to hold the part before its last piece is cut.
const STOPS_WITHIN: usize = 16;

/// Those of them after which a tab is searched for.
const TABS_WITHIN: usize = 4;

/// Consecutive cuts with a stop between them, from an open one on, as a language provides them.
pub(crate) trait BehindStops {
    /// Takes the cut after the next stop; `None` where none continues there.
    fn take_next(&mut self) -> Option<()>;

    /// The cuts taken so far, with the open one, as one.
    fn ends(&self) -> Ends;

    /// Some of them as one way.
    fn way(&self, cuts: Range<usize>) -> impl Way;

    /// The mark of the last of them: equal ways with the same stops have equal marks.
    fn last_mark(&self) -> u64;

    /// The last one is a contour of its own or the way to one: no cut after it is a tab of those before.
    fn last_stands_alone(&self) -> bool;
}

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
    fn get(&mut self, mark: u64, is_tab: impl FnOnce() -> Option<bool>) -> Option<bool> {
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

/// Takes the continuation of the open cut; true where the last cut is a tab; false where the cuts
/// together return to the start, in whatever order they are cut. `None` where there is none.
pub(crate) fn goes_on(cuts: &mut impl BehindStops, known: &mut KnownTabs) -> Option<bool> {
    let mut may_be_tab = true;
    let mut mark = cuts.last_mark();
    for last in 1..=STOPS_WITHIN {
        cuts.take_next()?;
        may_be_tab &= last <= TABS_WITHIN;
        mark = mixed(mark, cuts.last_mark());
        let ends = cuts.ends();
        let cuts_off = || {
            is_tab(
                &cuts.way(0..last),
                &cuts.way(last..last + 1),
                &cuts.way(0..last + 1),
            )
        };
        let ends_with_tab =
            may_be_tab && ends.blocks > 2 && known.get(mark, cuts_off) == Some(true);
        if ends_with_tab || ends.close() {
            return Some(ends_with_tab);
        }
        may_be_tab = may_be_tab && !cuts.last_stands_alone();
    }
    None
}
