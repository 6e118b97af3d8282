//! The bytes of a text that are not kept: what is asked for is read again from its origin, in
//! parts. The caller knows what that origin is, and whether it is still the same.

use std::fmt;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// Reads a range of the bytes again; `None` where that is not possible, or where they have changed.
pub(crate) type Again = Arc<dyn Fn(Range<usize>) -> Option<Vec<u8>> + Send + Sync>;

/// Bytes of a part.
const PART: usize = 1024;
/// Bytes after a part that are read with it: lines are short, so that none that begins in the part
/// is cut.
const BEHIND: usize = 128;

pub(super) struct Aside {
    length: usize,
    again: Again,
    /// The parts that have been asked for; empty where they were lost.
    parts: Vec<OnceLock<Box<[u8]>>>,
    whole: OnceLock<Vec<u8>>,
    lost: OnceLock<()>,
}

impl Aside {
    pub(super) fn new(length: usize, again: Again) -> Aside {
        Aside {
            length,
            again,
            parts: vec![OnceLock::new(); length / PART + 1],
            whole: OnceLock::new(),
            lost: OnceLock::new(),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.length
    }

    /// True once something could not be read again: what was found in the text does not hold.
    pub(super) fn is_lost(&self) -> bool {
        self.lost.get().is_some()
    }

    pub(super) fn whole(&self) -> &[u8] {
        self.whole.get_or_init(|| self.read(0..self.length))
    }

    pub(super) fn slice(&self, range: Range<usize>) -> Option<&[u8]> {
        if range.start > range.end || range.end > self.length {
            return None;
        }
        let (part, start) = (range.start / PART, range.start / PART * PART);
        let until = (start + PART + BEHIND).min(self.length);
        if range.end > until {
            return self.whole().get(range);
        }
        let read = || self.read(start..until).into();
        let part = self.parts.get(part)?.get_or_init(read);
        part.get(range.start - start..range.end - start)
    }

    fn read(&self, range: Range<usize>) -> Vec<u8> {
        let length = range.len();
        let read = (self.again)(range).filter(|read| read.len() == length);
        read.unwrap_or_else(|| {
            self.lost.get_or_init(|| ());
            Vec::new()
        })
    }
}

impl fmt::Debug for Aside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut aside = f.debug_struct("Aside");
        aside.field("length", &self.length).finish_non_exhaustive()
    }
}
