//! Where a contour has been edited since something was derived from it.

use std::ops::Range;

/// More stretches than these are not recorded one by one.
const MOST: usize = 16;

/// More segments are not looked at one by one.
const MOST_SEGMENTS: usize = 256;

/// Where a contour has been edited.
#[derive(Clone, Debug)]
pub(super) enum Edited {
    /// In these segments, of which none came or went.
    Within(Vec<Range<usize>>),
    Anywhere,
}

impl Edited {
    /// Nowhere yet.
    pub(super) fn not() -> Edited {
        Edited::Within(Vec::new())
    }

    pub(super) fn is_any(&self) -> bool {
        self.within().is_none_or(|within| !within.is_empty())
    }

    pub(super) fn within(&self) -> Option<&[Range<usize>]> {
        match self {
            Edited::Within(within) => Some(within),
            Edited::Anywhere => None,
        }
    }

    /// Adds that it has been edited there, too; `None` stands for anywhere.
    pub(super) fn merge(&mut self, there: Option<&[Range<usize>]>) {
        if let (Edited::Within(within), Some(there)) = (&mut *self, there) {
            let new: Vec<_> = there.iter().filter(|it| !within.contains(it)).collect();
            within.extend(new.into_iter().cloned());
            let segments: usize = within.iter().map(ExactSizeIterator::len).sum();
            if within.len() <= MOST && segments <= MOST_SEGMENTS {
                return;
            }
        }
        *self = Edited::Anywhere;
    }
}
