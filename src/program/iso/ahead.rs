//! The lines behind a line, which a corner and a joint look at.

/// Lines, each with the byte at which it begins, that can be read more than once.
pub(crate) trait Lines<'a>: Iterator<Item = (usize, &'a [u8])> + Clone {}

impl<'a, I: Iterator<Item = (usize, &'a [u8])> + Clone> Lines<'a> for I {}

/// The lines after a line.
pub(super) struct Ahead<'l, L> {
    pub(super) lines: &'l L,
}

impl<'a, L: Lines<'a>> Ahead<'_, L> {
    pub(super) fn lines(&self) -> impl Iterator<Item = &'a [u8]> {
        self.lines.clone().map(|(_, line)| line)
    }
}
