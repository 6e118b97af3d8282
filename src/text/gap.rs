//! Bytes with a gap, so that successive edits in one place move a line and not the rest of the text.

use super::aside::{Again, Aside};
use std::ops::Range;
use std::sync::OnceLock;

/// The bytes of a text. The gap lies at the start of a line or at the end, never within a line.
#[derive(Debug, Default)]
pub(super) struct Bytes {
    buffer: Vec<u8>,
    /// The bytes of the buffer outside the text.
    gap: Range<usize>,
    /// The contiguous text, once it has been asked for.
    whole: OnceLock<Vec<u8>>,
    /// Stands in for all bytes where they are not kept.
    aside: Option<Box<Aside>>,
}

/// How much wider than needed the gap is made.
const ROOM: usize = 64 * 1024;

/// Room beyond the text for the first gap, unless much is inserted at once.
pub(super) const ROOM_FOR_THE_FIRST: usize = 2 * ROOM;

impl Bytes {
    pub(crate) fn new(buffer: Vec<u8>) -> Bytes {
        Bytes {
            buffer,
            ..Bytes::default()
        }
    }

    /// Bytes that are not kept, but read again when they are asked for.
    pub(crate) fn aside(length: usize, again: Again) -> Bytes {
        Bytes {
            aside: Some(Box::new(Aside::new(length, again))),
            ..Bytes::default()
        }
    }

    /// True where bytes that were not kept could not be read again.
    pub(crate) fn is_lost(&self) -> bool {
        self.aside.as_ref().is_some_and(|aside| aside.is_lost())
    }

    pub(crate) fn len(&self) -> usize {
        let kept = self.buffer.len() - self.gap.len();
        self.aside.as_ref().map_or(kept, |aside| aside.len())
    }

    /// True where the bytes are not kept.
    pub(crate) fn is_aside(&self) -> bool {
        self.aside.is_some()
    }

    /// The bytes before the gap, and those after it.
    pub(crate) fn pieces(&self) -> (&[u8], &[u8]) {
        if let Some(aside) = &self.aside {
            return (aside.whole(), &[]);
        }
        let before = self.buffer.get(..self.gap.start);
        let behind = self.buffer.get(self.gap.end..);
        (before.unwrap_or_default(), behind.unwrap_or_default())
    }

    /// The contiguous text: where it has a gap, a copy that is kept until the next edit.
    pub(crate) fn whole(&self) -> &[u8] {
        match self.pieces() {
            (whole, _) if self.is_aside() => whole,
            _ if self.gap.is_empty() => &self.buffer,
            (before, []) => before,
            ([], behind) => behind,
            (before, behind) => self.whole.get_or_init(|| [before, behind].concat()),
        }
    }

    #[inline]
    pub(crate) fn get(&self, at: usize) -> Option<&u8> {
        if let Some(aside) = &self.aside {
            return aside.slice(at..at + 1)?.first();
        }
        let at = if at < self.gap.start {
            at
        } else {
            at + self.gap.len()
        };
        self.buffer.get(at)
    }

    /// A range of bytes; a range within one line costs nothing.
    #[inline]
    pub(crate) fn slice(&self, range: Range<usize>) -> Option<&[u8]> {
        if let Some(aside) = &self.aside {
            aside.slice(range)
        } else if range.end <= self.gap.start {
            self.buffer.get(range)
        } else if range.start >= self.gap.start {
            let gap = self.gap.len();
            self.buffer.get(range.start + gap..range.end + gap)
        } else {
            self.whole().get(range)
        }
    }

    /// Closes the gap.
    pub(crate) fn join(&mut self) {
        if let Some(aside) = self.aside.take() {
            self.buffer = aside.whole().to_vec();
        }
        self.whole = OnceLock::new();
        self.buffer.drain(std::mem::take(&mut self.gap));
    }

    pub(crate) fn into_whole(mut self) -> Vec<u8> {
        self.join();
        self.buffer
    }

    /// Replaces a range and leaves no gap.
    pub(crate) fn replace(&mut self, range: Range<usize>, replacement: &[u8]) {
        self.join();
        match self.buffer.get_mut(range.clone()) {
            Some(old) if old.len() == replacement.len() => old.copy_from_slice(replacement),
            _ => _ = self.buffer.splice(range, replacement.iter().copied()),
        }
    }

    /// Replaces a range and leaves the gap before the byte that was at `next`, which is not before the end of the
    /// range.
    pub(crate) fn replace_beside_gap(
        &mut self,
        range: Range<usize>,
        replacement: &[u8],
        next: usize,
    ) {
        if self.is_aside() {
            self.join();
        }
        self.whole = OnceLock::new();
        let more = replacement.len().saturating_sub(range.len());
        if self.gap.is_empty() {
            // The bytes before the first gap need not move.
            self.gap = next..next;
        }
        if self.gap.len() < more {
            let (old, room) = (self.buffer.len(), more + ROOM);
            self.buffer.reserve_exact(room);
            self.buffer.resize(old + room, 0);
            self.buffer
                .copy_within(self.gap.end..old, self.gap.end + room);
            self.gap.end += room;
        }
        let width = self.gap.len();
        if next < self.gap.start {
            self.buffer.copy_within(next..self.gap.start, next + width);
        } else {
            let moved = next - self.gap.start;
            self.buffer
                .copy_within(self.gap.end..self.gap.end + moved, self.gap.start);
        }
        let behind = range.start + replacement.len();
        self.buffer.copy_within(range.end..next, behind);
        if let Some(place) = self.buffer.get_mut(range.start..behind) {
            place.copy_from_slice(replacement);
        }
        self.gap = next - range.end + behind..next + width;
    }
}

impl Clone for Bytes {
    /// Contiguous.
    fn clone(&self) -> Bytes {
        let (before, behind) = self.pieces();
        Bytes::new([before, behind].concat())
    }
}

impl PartialEq for Bytes {
    fn eq(&self, other: &Bytes) -> bool {
        self.whole() == other.whole()
    }
}

impl Eq for Bytes {}
