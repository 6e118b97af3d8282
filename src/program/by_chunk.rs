//! What is known of cuts, in their order, by the chunks in which they begin: what an edit changes costs what is known of
//! its own chunks, however much is known of others.

use super::chunks::Reread;
use std::ops::Range;

/// A part of a cut by its chunk and its index in there.
pub(in crate::program) type PartAt = (usize, usize);

/// The cuts that an edit may have changed: those from one place up to another. Both are the beginnings of cuts, and the
/// cut before the first has nothing to do with those lines.
#[derive(Clone, Copy)]
pub(in crate::program) struct Touched<'a> {
    pub(crate) reread: &'a Reread,
    pub(crate) from: PartAt,
    pub(crate) to: PartAt,
}

impl Touched<'_> {
    /// Where a part stands now; `None` for one that is gone.
    pub(crate) fn moved(&self, (chunk, place): PartAt) -> Option<PartAt> {
        Some((self.reread.moved(chunk)?, place))
    }
}

/// A cut, or something that is known of one.
pub(in crate::program) trait Begun: Sized {
    /// What is known of all those of a chunk without looking at each.
    type Sum: Clone + std::fmt::Debug + Default + PartialEq;

    /// The part that its cut begins with.
    fn begin(&self) -> PartAt;

    /// Names its chunks again.
    fn renumber(&mut self, moved: &dyn Fn(usize) -> usize);

    fn sum(list: &[Self]) -> Self::Sum;
}

/// A list in the order in which cuts begin.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct ByChunk<T: Begun> {
    chunks: Vec<(Vec<T>, T::Sum)>,
}

impl<T: Begun> Default for ByChunk<T> {
    fn default() -> Self {
        ByChunk { chunks: Vec::new() }
    }
}

impl<T: Begun> ByChunk<T> {
    pub(crate) fn len(&self) -> usize {
        self.chunks.len()
    }

    /// Those of a chunk.
    pub(crate) fn of(&self, chunk: usize) -> &[T] {
        self.chunks.get(chunk).map_or(&[], |(list, _)| list)
    }

    pub(crate) fn sum(&self, chunk: usize) -> Option<&T::Sum> {
        self.chunks.get(chunk).map(|(_, sum)| sum)
    }

    pub(crate) fn sums(&self) -> impl DoubleEndedIterator<Item = &T::Sum> + ExactSizeIterator {
        self.chunks.iter().map(|(_, sum)| sum)
    }

    pub(crate) fn iter(&self) -> impl DoubleEndedIterator<Item = &T> {
        self.chunks.iter().flat_map(|(list, _)| list)
    }

    /// Those that begin at a place or after it.
    pub(crate) fn from(&self, place: PartAt) -> impl Iterator<Item = &T> {
        let behind = self.chunks.get(place.0..).unwrap_or_default().iter();
        let all = behind.flat_map(|(list, _)| list);
        all.skip_while(move |one| one.begin() < place)
    }

    /// The last that begins before a place.
    pub(crate) fn before(&self, place: PartAt) -> Option<&T> {
        let last = self.chunks.len().min(place.0 + 1);
        let before = self.chunks[..last].iter().rev();
        before
            .flat_map(|(list, _)| list.iter().rev())
            .find(|one| one.begin() < place)
    }

    /// Those that begin from one place up to another.
    pub(crate) fn within(&self, places: Range<PartAt>) -> impl Iterator<Item = &T> {
        let last = self.chunks.len().min(places.end.0 + 1);
        let within = self.chunks.get(places.start.0..last);
        let all = within.unwrap_or_default().iter();
        let all = all.flat_map(|(list, _)| list);
        all.filter(move |one| places.contains(&one.begin()))
    }

    /// The one of the cut that begins at a place.
    pub(crate) fn at(&self, place: PartAt) -> Option<&T> {
        let list = self.of(place.0);
        let at = list.binary_search_by_key(&place, T::begin);
        at.ok().and_then(|at| list.get(at))
    }

    /// Those that an edit touches, as they were before it.
    pub(crate) fn touched(&self, touched: &Touched<'_>) -> impl Iterator<Item = &T> {
        let is_touched = |one: &&T| touched.moved(one.begin()).is_none_or(|at| at < touched.to);
        self.from(touched.from).take_while(is_touched)
    }

    /// Replaces what was known of the touched cuts.
    pub(crate) fn splice(&mut self, touched: &Touched<'_>, fresh: impl IntoIterator<Item = T>) {
        let Touched { reread, from, to } = *touched;
        let read = reread.chunks.clone();
        let before = self.chunks.len().max(read.start + reread.before);
        self.chunks.resize_with(before, Default::default);
        let keep = |chunks: &mut [(Vec<T>, T::Sum)], is_kept: &dyn Fn(&T) -> bool| {
            chunks.iter_mut().for_each(|(list, _)| list.retain(is_kept));
        };
        let first = from.0.min(read.start);
        keep(&mut self.chunks[first..read.start], &|one| {
            one.begin() < from
        });
        let none = read.clone().map(|_| Default::default());
        self.chunks
            .splice(read.start..read.start + reread.before, none);
        if read.len() != reread.before {
            let moved = |chunk: usize| reread.moved(chunk).unwrap_or(read.end);
            let behind = self.chunks[read.end..].iter_mut();
            behind
                .flat_map(|(list, _)| list)
                .for_each(|one| one.renumber(&moved));
        }
        let last = self.chunks.len().min(to.0 + 1).max(read.end);
        keep(&mut self.chunks[read.end..last], &|one| one.begin() >= to);
        let mut fresh = fresh.into_iter().peekable();
        while let Some(begin) = fresh.peek().map(T::begin) {
            let own = std::iter::from_fn(|| fresh.next_if(|one| one.begin().0 == begin.0));
            let own: Vec<T> = own.collect();
            let Some((list, _)) = self.chunks.get_mut(begin.0) else {
                continue;
            };
            let at = list.partition_point(|one| one.begin() < begin);
            list.splice(at..at, own);
            list.shrink_to_fit();
        }
        for (list, sum) in &mut self.chunks[first..last] {
            *sum = T::sum(list);
        }
        if read.len() != reread.before {
            let behind = self.chunks[last..].iter_mut();
            behind.for_each(|(list, sum)| *sum = T::sum(list));
        }
    }

    /// Each with leave to change it; sums are made again.
    pub(crate) fn change(&mut self, chunk: usize, mut change: impl FnMut(&mut T)) {
        if let Some((list, sum)) = self.chunks.get_mut(chunk) {
            list.iter_mut().for_each(&mut change);
            *sum = T::sum(list);
        }
    }
}
