//! A program as cuts: its lines from one stop to the next, each with the state in which the machine enters it. An edit
//! rereads the cuts that it touched, and those behind them whose state changes.

#![warn(clippy::indexing_slicing)]

use crate::text::SourceText;
use rayon::prelude::*;
use std::ops::{Deref, Range};

/// Cuts that are judged in parallel.
const AT_ONCE: usize = 512;

/// How a language reads its lines.
pub(in crate::program) trait Reader: Sync {
    /// What the meaning of a line depends on; `()` where lines are independent.
    type State: Clone + PartialEq + Send + Sync;
    /// Lines up to the end of a cut, run.
    type Begun: Send;
    type Cut: Send + Sync;

    /// How many lines run.
    fn line_count(&self, text: &SourceText) -> usize;

    /// Byte of the text from which places count in a cut that begins at a line.
    fn base(&self, text: &SourceText, line: usize) -> usize;

    /// Runs lines from one on, up to the end of a cut: what was run, the line behind it, and the state there.
    fn run(
        &self,
        text: &SourceText,
        first: usize,
        before: &Self::State,
    ) -> (Self::Begun, usize, Self::State);

    /// What takes time and depends on nothing else. More cuts than one where some lie in the line in which the first ends:
    /// each with its lines.
    fn finish(&self, text: &SourceText, begun: Self::Begun) -> Vec<(Range<usize>, Self::Cut)>;

    /// The reading of a line depends on no more than this many after it.
    const REACH: usize = 0;

    /// Takes a cut on from one state to another; false, and unchanged, where its lines must be run again.
    fn take_on(_: &mut Self::Cut, _from: &Self::State, _to: &Self::State) -> bool {
        false
    }

    /// The state after a cut that was taken on, which had been `after`.
    fn taken_on(after: &Self::State, _from: &Self::State, _to: &Self::State) -> Self::State {
        after.clone()
    }
}

/// The place of a cut.
#[derive(Clone, Debug)]
struct Lines {
    /// Tells it apart from all others that were read.
    id: u64,
    /// In the order in which they run, from 0.
    lines: Range<usize>,
    /// Byte of the text from which its places count.
    byte: usize,
    /// It begins in the line in which the one before ends.
    shares: bool,
}

/// The cuts of a program in the order in which they run.
#[derive(Clone, Debug)]
pub(in crate::program) struct Cuts<C, S> {
    list: Vec<C>,
    places: Vec<Lines>,
    /// The state before each.
    befores: Vec<S>,
    /// The state after the last.
    end: S,
    /// How many have been read: each gets a number of its own.
    read: u64,
}

impl<C, S> Deref for Cuts<C, S> {
    type Target = [C];

    fn deref(&self) -> &[C] {
        &self.list
    }
}

impl<C: Send + Sync, S: Clone + PartialEq + Send + Sync> Cuts<C, S> {
    /// Reads a whole text.
    pub(crate) fn read<L>(language: &L, text: &SourceText, begin: S) -> Cuts<C, S>
    where
        L: Reader<Cut = C, State = S>,
    {
        let mut cuts = Cuts::before(begin.clone());
        cuts.read_on(language, text, [0, 0], (0, begin));
        cuts
    }

    /// None, before a state.
    pub(crate) fn before(begin: S) -> Cuts<C, S> {
        Cuts {
            list: Vec::new(),
            places: Vec::new(),
            befores: Vec::new(),
            end: begin,
            read: 0,
        }
    }

    /// Replaces a range of bytes of the text and rereads what that touched.
    pub(crate) fn edit<L>(
        &mut self,
        language: &L,
        text: &mut SourceText,
        (range, replacement): (Range<usize>, &str),
    ) where
        L: Reader<Cut = C, State = S>,
    {
        let end = range.end.min(text.len());
        let start = range.start.min(end);
        // The byte before belongs to it: a CR there may become one line end with an inserted LF.
        let first = text.line_of(start.saturating_sub(1));
        let (old_count, last) = (text.line_count(), text.line_of(end));
        let places = &self.places;
        // The first whose reading may have looked at these lines.
        let touched = places.partition_point(|place| place.lines.end + L::REACH <= first);
        // A cut ends where it does because of what follows it.
        let mut from = touched.min(places.len()).saturating_sub(1);
        while from > 0 && places.get(from).is_some_and(|place| place.shares) {
            from -= 1;
        }
        let to = places.partition_point(|place| place.lines.start <= last);
        let mut to = to.max(from);
        // What was read together with an edited one is read again with it: its places count from a byte that is gone.
        while places.get(to).is_some_and(|place| place.shares) {
            to += 1;
        }
        text.replace(start..end, replacement);
        for place in self.places.iter_mut().skip(to) {
            let moved = |line: usize| line + text.line_count() - old_count;
            place.lines = moved(place.lines.start)..moved(place.lines.end);
            place.byte = place.byte + replacement.len() - (end - start);
        }
        let line = self.lines(from).start;
        let state = self.state_before(from).clone();
        self.read_on(language, text, [from, to], (line, state));
    }

    /// Runs lines from one on in place of the cuts from `from` on, of which those before `to` are gone, until one that
    /// stands already begins in the state in which it was run.
    fn read_on<L>(
        &mut self,
        language: &L,
        text: &SourceText,
        [mut from, mut to]: [usize; 2],
        (mut line, mut state): (usize, S),
    ) where
        L: Reader<Cut = C, State = S>,
    {
        let count = language.line_count(text);
        loop {
            let (mut fresh, mut begun) = (Cuts::before(state.clone()), Vec::new());
            fresh.read = self.read;
            let is_met = loop {
                let is_past = |place: &Lines| place.lines.start < line || place.shares;
                while self.places.get(to).is_some_and(is_past) {
                    to += 1;
                }
                if self
                    .places
                    .get(to)
                    .is_some_and(|place| place.lines.start == line)
                {
                    if self.take_on::<L>(to, &state) {
                        break true;
                    }
                    to += 1;
                }
                if line >= count {
                    break false;
                }
                let base = language.base(text, line);
                let (ran, next, after) = language.run(text, line, &state);
                begun.push((base, std::mem::replace(&mut state, after), ran));
                line = next.max(line + 1);
                if begun.len() == AT_ONCE {
                    fresh.finish(language, text, &mut begun);
                }
            };
            fresh.finish(language, text, &mut begun);
            let end = if is_met { to } else { self.list.len() };
            let met = from + fresh.len();
            self.read = fresh.read;
            self.list.splice(from..end, fresh.list);
            self.places.splice(from..end, fresh.places);
            self.befores.splice(from..end, fresh.befores);
            if !is_met {
                self.end = state;
                return;
            }
            let Some((index, after)) = self.pass_on::<L>(met, state) else {
                return;
            };
            ([from, to], line, state) = ([index; 2], self.lines(index).start, after);
        }
    }

    /// Takes a cut on to another state; false where it must be run again.
    fn take_on<L>(&mut self, cut: usize, to: &S) -> bool
    where
        L: Reader<Cut = C, State = S>,
    {
        match (self.list.get_mut(cut), self.befores.get(cut)) {
            (Some(cut), Some(from)) => from == to || L::take_on(cut, from, to),
            _ => false,
        }
    }

    /// Passes a state on from a cut that was taken on to it, as far as states change; the first that must be run again, and
    /// the state before it.
    fn pass_on<L>(&mut self, first: usize, mut state: S) -> Option<(usize, S)>
    where
        L: Reader<Cut = C, State = S>,
    {
        for cut in first.. {
            let before = self.befores.get_mut(cut)?;
            let from = std::mem::replace(before, state.clone());
            let after = self.befores.get_mut(cut + 1).unwrap_or(&mut self.end);
            let passed = L::taken_on(after, &from, &state);
            if from == state || *after == passed {
                return None;
            }
            if cut + 1 == self.list.len() {
                self.end = passed;
                return None;
            }
            if !self.take_on::<L>(cut + 1, &passed) {
                return Some((cut + 1, passed));
            }
            state = passed;
        }
        None
    }

    /// Adds what was begun.
    fn finish<L>(&mut self, language: &L, text: &SourceText, begun: &mut Vec<(usize, S, L::Begun)>)
    where
        L: Reader<Cut = C, State = S>,
    {
        let finish = |(byte, before, begun): (usize, S, L::Begun)| {
            (byte, before, language.finish(text, begun))
        };
        let all: Vec<_> = match begun.len() {
            0 | 1 => begun.drain(..).map(finish).collect(),
            _ => std::mem::take(begun).into_par_iter().map(finish).collect(),
        };
        for (byte, before, cuts) in all {
            for (nth, (lines, cut)) in cuts.into_iter().enumerate() {
                self.read += 1;
                self.places.push(Lines {
                    id: self.read,
                    lines,
                    byte,
                    shares: nth > 0,
                });
                self.befores.push(before.clone());
                self.list.push(cut);
            }
        }
    }
}

impl<C, S> Cuts<C, S> {
    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut C> {
        self.list.iter_mut()
    }

    /// Tells a cut apart from all others, and from what it was before an edit.
    pub(crate) fn id(&self, cut: usize) -> u64 {
        self.places.get(cut).map_or(0, |place| place.id)
    }

    /// The state in which the machine enters a cut.
    pub(crate) fn state_before(&self, cut: usize) -> &S {
        self.befores.get(cut).unwrap_or(&self.end)
    }

    /// The first line of a cut, and of the one behind it: the lines that it runs.
    pub(crate) fn lines(&self, cut: usize) -> Range<usize> {
        self.places
            .get(cut)
            .map_or(0..0, |place| place.lines.clone())
    }

    /// Byte of the text from which the places of a cut count.
    pub(crate) fn byte(&self, cut: usize) -> usize {
        self.places.get(cut).map_or(0, |place| place.byte)
    }

    /// The first cut that runs a line or one behind it.
    pub(crate) fn first_at(&self, line: usize) -> usize {
        self.places.partition_point(|place| place.lines.end <= line)
    }
}
