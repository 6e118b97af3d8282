//! A program as a list of chunks of consecutive lines, so that an edit rereads only those that it touched.
//!
//! The meaning of a line may depend on the state before it. Each chunk knows the state before and
//! after itself: the chunks after an edit are reread until the state agrees with the earlier one.

#![warn(clippy::indexing_slicing)]

use crate::text::SourceText;
use rayon::prelude::*;
use std::ops::{Deref, DerefMut, Range};

/// Chunks that are read in parallel.
const AT_ONCE: usize = 256;

/// How a language reads its lines.
pub(in crate::program) trait ChunkReader: Sync {
    /// The state between two lines; `()` where lines are independent.
    type State: Copy + PartialEq;
    /// Lines after the part that must be done in sequence.
    type Begun: Send;
    type Chunk: Send + Sync;

    /// Lines of a chunk: it holds this many up to twice as many, so that inserting lines one by one does not leave ever
    /// shorter chunks.
    const LINES: usize;

    /// The state before the first line.
    fn begin(&self) -> Self::State;

    /// Goes through lines; returns the state after them.
    fn run(
        &self,
        text: &SourceText,
        lines: Range<usize>,
        before: Self::State,
    ) -> (Self::Begun, Self::State);

    /// The part that can be done in parallel. What lines have in common with the `old` chunks that
    /// these replace may be reused.
    fn finish(&self, text: &SourceText, begun: Self::Begun, old: &[Self::Chunk]) -> Self::Chunk;

    fn before(chunk: &Self::Chunk) -> Self::State;

    fn after(chunk: &Self::Chunk) -> Self::State;

    /// The reading of a line depends on no more than this many after it.
    const REACH: usize = 0;

    /// The number of lines after its own on which the reading of a chunk depends.
    fn ahead(_: &Self::Chunk) -> usize {
        0
    }

    /// Takes a chunk on from another state; false where its lines must be reread.
    fn take_on(_: &mut Self::Chunk, _: Self::State) -> bool {
        false
    }
}

/// The place of a chunk.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::program) struct Lines {
    /// Lines of the text, from 0.
    pub(crate) lines: Range<usize>,
    /// Byte of the text at which they begin.
    pub(crate) byte: usize,
}

impl Lines {
    fn of(text: &SourceText, lines: Range<usize>) -> Lines {
        Lines {
            byte: text.line_start(lines.start),
            lines,
        }
    }
}

/// The chunks of a program in the order in which they run.
#[derive(Clone, Debug)]
pub(in crate::program) struct Chunks<C> {
    list: Vec<C>,
    places: Vec<Lines>,
}

impl<C> Default for Chunks<C> {
    fn default() -> Self {
        Chunks {
            list: Vec::new(),
            places: Vec::new(),
        }
    }
}

impl<C> Deref for Chunks<C> {
    type Target = [C];

    fn deref(&self) -> &[C] {
        &self.list
    }
}

impl<C> DerefMut for Chunks<C> {
    fn deref_mut(&mut self) -> &mut [C] {
        &mut self.list
    }
}

/// The chunks that an edit made to be read, in place of the earlier ones.
#[derive(Clone, Debug)]
pub(in crate::program) struct Reread {
    /// The chunks that were read.
    pub(crate) chunks: Range<usize>,
    /// How many stood there before.
    pub(crate) before: usize,
}

impl Reread {
    /// All chunks, in place of none.
    pub(crate) fn all<C>(chunks: &[C]) -> Reread {
        Reread {
            chunks: 0..chunks.len(),
            before: 0,
        }
    }

    /// Where a chunk stands now; `None` for one that is gone.
    pub(crate) fn moved(&self, chunk: usize) -> Option<usize> {
        match chunk.checked_sub(self.chunks.start + self.before) {
            Some(behind) => Some(self.chunks.end + behind),
            None => (chunk < self.chunks.start).then_some(chunk),
        }
    }
}

impl<C: Send + Sync> Chunks<C> {
    /// Reads some lines of a text as if they were the first ones.
    pub(crate) fn read<L: ChunkReader<Chunk = C>>(
        language: &L,
        text: &SourceText,
        lines: Range<usize>,
    ) -> Chunks<C> {
        let (list, places) = read(language, text, pieces::<L>(lines), language.begin(), &[]);
        Chunks { list, places }
    }

    /// Reads lines in another order than that of the text, perhaps more than once: a chunk for each range. Such a list
    /// cannot be edited.
    pub(crate) fn read_in_order<L: ChunkReader<Chunk = C>>(
        language: &L,
        text: &SourceText,
        order: &[Range<usize>],
    ) -> Chunks<C> {
        let (list, places) = read(language, text, order.iter().cloned(), language.begin(), &[]);
        Chunks { list, places }
    }

    /// Replaces a range of bytes of the text and rereads what that touched; each chunk that goes or changes is handed to
    /// `gone` before.
    pub(crate) fn edit<L: ChunkReader<Chunk = C>>(
        &mut self,
        language: &L,
        text: &mut SourceText,
        (range, replacement): (Range<usize>, &str),
        mut gone: impl FnMut(&C),
    ) -> Reread {
        let end = range.end.min(text.len());
        let start = range.start.min(end);
        // The byte before belongs to it: a CR there may become one line end with an inserted LF.
        let first = text.line_of(start.saturating_sub(1));
        let (old_count, last) = (text.line_count(), text.line_of(end));
        text.replace(start..end, replacement);
        let mut from = self
            .places
            .partition_point(|place| place.lines.end <= first)
            .min(self.list.len().saturating_sub(1));
        let to = self
            .places
            .partition_point(|place| place.lines.start <= last)
            .max((from + 1).min(self.list.len()));
        // The chunks whose reading looked ahead at these lines, even past short ones in between.
        let (mut before, mut between) = (from, 0);
        while between < L::REACH
            && let Some(index) = before.checked_sub(1)
            && let (Some(chunk), Some(place)) = (self.list.get(index), self.places.get(index))
        {
            if L::ahead(chunk) > between {
                from = index;
            }
            between += place.lines.len();
            before = index;
        }
        let moved = |line: usize| line + text.line_count() - old_count;
        let lines = self.places.get(from).map_or(0, |place| place.lines.start)
            ..self
                .places
                .get(to)
                .map_or(text.line_count(), |place| moved(place.lines.start));
        let before = self
            .list
            .get(from)
            .map_or_else(|| language.begin(), L::before);
        let old = self.list.get(from..to).unwrap_or_default();
        let (fresh, places) = read(language, text, pieces::<L>(lines), before, old);
        let first_behind = from + fresh.len();
        let mut next = first_behind;
        self.list
            .splice(from..to, fresh)
            .for_each(|chunk| gone(&chunk));
        self.places.splice(from..to, places);
        for place in self.places.iter_mut().skip(next) {
            *place = Lines::of(text, moved(place.lines.start)..moved(place.lines.end));
        }
        while let Some(last) = next.checked_sub(1)
            && let Some(before) = self.list.get(last).map(L::after)
            && let Some(chunk) = self.list.get_mut(next)
            && let Some(place) = self.places.get(next)
            && L::before(chunk) != before
        {
            gone(chunk);
            if !L::take_on(chunk, before) {
                let (begun, _) = language.run(text, place.lines.clone(), before);
                *chunk = language.finish(text, begun, std::slice::from_ref(chunk));
            }
            next += 1;
        }
        Reread {
            before: to - from + (next - first_behind),
            chunks: from..next,
        }
    }
}

impl<C> Chunks<C> {
    /// The place of a chunk; empty after the last.
    pub(crate) fn place(&self, chunk: usize) -> Lines {
        self.places.get(chunk).cloned().unwrap_or_default()
    }

    /// Byte of the text from which the places of a chunk count.
    pub(crate) fn byte(&self, chunk: usize) -> usize {
        self.places.get(chunk).map_or(0, |place| place.byte)
    }

    /// The chunk that holds a byte of a text that runs in its own order; the last one for bytes past the end.
    pub(crate) fn at(&self, byte: usize) -> usize {
        self.places
            .partition_point(|place| place.byte <= byte)
            .saturating_sub(1)
    }

    /// The chunks and their places.
    pub(crate) fn placed(
        &self,
    ) -> impl DoubleEndedIterator<Item = (&C, &Lines)> + ExactSizeIterator {
        self.list.iter().zip(&self.places)
    }
}

/// Lines in ranges of chunk size.
fn pieces<L: ChunkReader>(lines: Range<usize>) -> impl Iterator<Item = Range<usize>> {
    let pieces = (lines.len() / L::LINES).max(1);
    let at = move |piece: usize| lines.start + lines.len() * piece / pieces;
    (0..pieces).map(move |piece| at(piece)..at(piece + 1))
}

fn read<L: ChunkReader>(
    language: &L,
    text: &SourceText,
    mut pieces: impl Iterator<Item = Range<usize>>,
    mut state: L::State,
    old: &[L::Chunk],
) -> (Vec<L::Chunk>, Vec<Lines>) {
    let (mut list, mut places) = (Vec::new(), Vec::new());
    loop {
        let some: Vec<L::Begun> = pieces
            .by_ref()
            .take(AT_ONCE)
            .map(|lines| {
                places.push(Lines::of(text, lines.clone()));
                let (begun, after) = language.run(text, lines, state);
                state = after;
                begun
            })
            .collect();
        match some.len() {
            0 => return (list, places),
            1 => list.extend(
                some.into_iter()
                    .map(|begun| language.finish(text, begun, old)),
            ),
            _ => list.par_extend(
                some.into_par_iter()
                    .map(|begun| language.finish(text, begun, old)),
            ),
        }
    }
}
