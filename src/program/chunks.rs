//! A program as a list of chunks: consecutive lines that were read, so that an edit reads again only those that it touched.
//!
//! What a line says may hang on what is in force before it. Each chunk knows what is in force before and behind itself: those behind
//! an edit are read again for as long as something else is in force than was.

#![warn(clippy::indexing_slicing)]

use crate::text::SourceText;
use rayon::prelude::*;
use std::ops::{Deref, DerefMut, Range};

/// Chunks that are read side by side.
const AT_ONCE: usize = 256;

/// How a language reads its lines.
pub(in crate::program) trait ChunkReader: Sync {
    /// What is in force between two lines; `()` where a line hangs on no other.
    type State: Copy + PartialEq;
    /// Lines of which is done what has to be done one after another.
    type Begun: Send;
    type Chunk: Send;

    /// Lines of a chunk: it holds so many to twice as many, so that lines inserted one by one do not leave ever shorter ones.
    const LINES: usize;

    /// What is in force before the first line.
    fn begin(&self) -> Self::State;

    /// Goes through lines; gives what is in force behind them.
    fn run(
        &self,
        text: &SourceText,
        lines: Range<usize>,
        before: Self::State,
    ) -> (Self::Begun, Self::State);

    /// What can be done side by side.
    fn finish(&self, text: &SourceText, begun: Self::Begun) -> Self::Chunk;

    fn before(chunk: &Self::Chunk) -> Self::State;

    fn after(chunk: &Self::Chunk) -> Self::State;

    /// How its last lines run hangs on lines behind it.
    fn looks_ahead(_: &Self::Chunk) -> bool {
        false
    }

    /// Takes a chunk on from another state; false where its lines have to be read again.
    fn take_on(_: &mut Self::Chunk, _: Self::State) -> bool {
        false
    }
}

/// Where the lines of a chunk stand.
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

impl<C: Send> Chunks<C> {
    /// Reads some lines of a text as if they were the first ones.
    pub(crate) fn read<L: ChunkReader<Chunk = C>>(
        language: &L,
        text: &SourceText,
        lines: Range<usize>,
    ) -> Chunks<C> {
        let (list, places) = read(language, text, pieces::<L>(lines), language.begin());
        Chunks { list, places }
    }

    /// Reads lines in another order than that of the text, perhaps more than once: a chunk for each range. Such a list cannot be edited.
    pub(crate) fn read_in_order<L: ChunkReader<Chunk = C>>(
        language: &L,
        text: &SourceText,
        order: &[Range<usize>],
    ) -> Chunks<C> {
        let (list, places) = read(language, text, order.iter().cloned(), language.begin());
        Chunks { list, places }
    }

    /// Replaces a range of bytes of the text and reads again what that touched.
    pub(crate) fn edit<L: ChunkReader<Chunk = C>>(
        &mut self,
        language: &L,
        text: &mut SourceText,
        range: Range<usize>,
        replacement: &str,
    ) {
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
        while let Some(before) = from.checked_sub(1)
            && self.list.get(before).is_some_and(L::looks_ahead)
        {
            from = before;
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
        let (fresh, places) = read(language, text, pieces::<L>(lines), before);
        let mut next = from + fresh.len();
        self.list.splice(from..to, fresh);
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
            if !L::take_on(chunk, before) {
                let (begun, _) = language.run(text, place.lines.clone(), before);
                *chunk = language.finish(text, begun);
            }
            next += 1;
        }
    }
}

impl<C> Chunks<C> {
    /// Where a chunk stands; nowhere behind the last.
    pub(crate) fn place(&self, chunk: usize) -> Lines {
        self.places.get(chunk).cloned().unwrap_or_default()
    }

    /// Byte of the text from which the places of a chunk count.
    pub(crate) fn byte(&self, chunk: usize) -> usize {
        self.places.get(chunk).map_or(0, |place| place.byte)
    }

    /// The chunk that holds a byte of a text that runs as it stands; the last one for bytes past the end.
    pub(crate) fn at(&self, byte: usize) -> usize {
        self.places
            .partition_point(|place| place.byte <= byte)
            .saturating_sub(1)
    }

    /// The chunks and where they stand.
    pub(crate) fn placed(
        &self,
    ) -> impl DoubleEndedIterator<Item = (&C, &Lines)> + ExactSizeIterator {
        self.list.iter().zip(&self.places)
    }
}

/// Lines in ranges of as many as a chunk holds.
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
            1 => list.extend(some.into_iter().map(|begun| language.finish(text, begun))),
            _ => list.par_extend(
                some.into_par_iter()
                    .map(|begun| language.finish(text, begun)),
            ),
        }
    }
}
