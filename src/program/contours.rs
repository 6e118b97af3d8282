//! The contours of a program, in any language: which stops lie within one, and where one crosses
//! itself. After an edit only the contours that it touches are looked at.
//!
//! An open cut is followed past its stops, so the result depends on later cuts; how far the search
//! went is kept. Everything from the first touched cut up to where contours begin as before is
//! looked at again.

use super::by_chunk::{Begun, ByChunk};
pub(in crate::program) use super::by_chunk::{PartAt, Touched};
use super::followed::Followed;
use super::path::{Found, Known};
use super::work::{self, Work};
use std::ops::Range;
use std::sync::Arc;

/// An open cut that belongs to no contour before it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Head {
    begin: PartAt,
    behind: PartAt,
    reach: usize,
    /// The stops within its contour.
    tabs: u32,
    is_open: bool,
}

/// What the heads of a chunk come to.
#[derive(Clone, Debug, Default, PartialEq)]
struct Heads {
    /// The last chunk that was looked at for any of them.
    reach: usize,
    tabs: usize,
}

impl Begun for Head {
    type Sum = Heads;

    fn begin(&self) -> PartAt {
        self.begin
    }

    fn renumber(&mut self, moved: &dyn Fn(usize) -> usize) {
        let all = [&mut self.begin.0, &mut self.behind.0, &mut self.reach];
        all.into_iter().for_each(|chunk| *chunk = moved(*chunk));
    }

    fn sum(list: &[Head]) -> Heads {
        Heads {
            reach: list.iter().map(|head| head.reach).max().unwrap_or(0),
            tabs: tabs_of(list.iter()),
        }
    }
}

fn tabs_of<'a>(heads: impl Iterator<Item = &'a Head>) -> usize {
    heads.map(|head| head.tabs as usize).sum()
}

/// A contour that crosses or coincides with itself, or of which an offset loses something, and where.
type Crossing<C> = (C, Arc<Found>);

impl<C: Begun> Begun for Crossing<C> {
    type Sum = ();

    fn begin(&self) -> PartAt {
        self.0.begin()
    }

    fn renumber(&mut self, moved: &dyn Fn(usize) -> usize) {
        self.0.renumber(moved);
    }

    fn sum(_: &[Crossing<C>]) {}
}

/// The contours of a program that stop, are open, cross themselves or lose something by the offset of the control.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct Contours<C: Begun> {
    heads: ByChunk<Head>,
    /// The stops within contours, in the order of the text.
    tabs: Vec<(usize, usize)>,
    crossing: ByChunk<Crossing<C>>,
}

impl<C: Begun> Default for Contours<C> {
    fn default() -> Self {
        Contours {
            heads: ByChunk::default(),
            tabs: Vec::new(),
            crossing: ByChunk::default(),
        }
    }
}

impl<C: Begun + Clone> Contours<C> {
    /// Looks at the cuts that were touched, and at those whose contours depend on them: each
    /// contour is handed out, with whether something was found of it where that was looked for. Returns
    /// all that was looked at.
    pub(crate) fn look<'a, D: Followed<Cut = C>>(
        &mut self,
        document: &D,
        touched: Touched<'a>,
        known: &mut Known,
        mut each: impl FnMut(C, Option<bool>),
    ) -> Touched<'a> {
        let first = self.first_touched(&touched);
        let kept = self.heads.before(first.unwrap_or((self.heads.len(), 0)));
        let own_behind = kept.map_or((0, 0), |head| head.behind);
        let from = first.map_or(touched.from, |first| first.min(touched.from));
        let mut again = Touched {
            from: from.max(own_behind),
            ..touched
        };
        let (mut heads, mut tabs, mut crossing) = (Vec::new(), Vec::new(), Vec::new());
        let (mut at, mut behind) = (again.from, again.from);
        let gone = first.map(|first| self.heads.from(first));
        let mut gone = gone.into_iter().flatten().peekable();
        let mut gone_tabs = 0;
        known.begin();
        loop {
            // Whatever belonged to a contour that is looked at again is looked at again, too.
            while let Some(head) = gone.next_if(|head| {
                let begin = touched.moved(head.begin);
                begin.is_none_or(|begin| begin < again.to)
            }) {
                again.to = again.to.max(touched.moved(head.behind).unwrap_or(again.to));
                gone_tabs += head.tabs as usize;
            }
            let Some(mut cut) = document.next_cut(at, again.to) else {
                break;
            };
            work::add(Work::Cuts, 1);
            let begin = cut.begin();
            at = document.behind(&cut);
            let contour = (begin >= behind).then(|| document.follow(&cut, &mut known.tabs));
            if let Some(contour) = contour.flatten() {
                heads.push(Head {
                    begin,
                    behind: contour.behind,
                    reach: contour.reach,
                    tabs: contour.tabs.len() as u32,
                    is_open: contour.is_open,
                });
                tabs.extend(contour.tabs);
                behind = contour.behind;
                again.to = again.to.max(behind);
                if let Some(whole) = contour.whole {
                    (cut, at) = (whole, behind);
                }
            }
            let found = document.crossings(known, &cut);
            let crosses = found.as_ref().map(|found| !found.is_clean());
            let found = found.filter(|found| !found.is_clean());
            crossing.extend(found.map(|found| (cut.clone(), found)));
            each(cut, crosses);
        }
        drop(gone);
        known.tidy();
        self.put_tabs(&again, gone_tabs, tabs);
        self.heads.splice(&again, heads);
        self.crossing.splice(&again, crossing);
        again
    }

    /// Where the first contour begins that an edit may have changed; `None` where there is none.
    fn first_touched(&self, touched: &Touched<'_>) -> Option<PartAt> {
        let start = touched.reread.chunks.start;
        let is_touched = |head: &&Head| head.reach >= start || head.begin >= touched.from;
        let chunks = self.heads.sums().enumerate();
        let may_be = chunks.filter(|(chunk, sum)| sum.reach >= start || *chunk >= touched.from.0);
        let mut all = may_be.flat_map(|(chunk, _)| self.heads.of(chunk));
        all.find(is_touched).map(|head| head.begin)
    }

    /// Puts stops in the place of some, those of the contours that are `gone`.
    fn put_tabs(&mut self, again: &Touched<'_>, gone: usize, tabs: Vec<(usize, usize)>) {
        let chunk = again.from.0;
        let before = self.heads.of(chunk).iter();
        let before = before.take_while(|head| head.begin < again.from);
        let whole: usize = self.heads.sums().take(chunk).map(|sum| sum.tabs).sum();
        let first = whole + tabs_of(before);
        if again.reread.chunks.len() != again.reread.before {
            let moved = |chunk: &mut usize| *chunk = again.reread.moved(*chunk).unwrap_or(*chunk);
            let behind = self.tabs[first + gone..].iter_mut();
            behind.for_each(|(chunk, _)| moved(chunk));
        }
        self.tabs.splice(first..first + gone, tabs);
    }

    /// Whether a stop stands within a contour.
    pub(crate) fn is_tab(&self, stop: (usize, usize)) -> bool {
        self.tabs.binary_search(&stop).is_ok()
    }

    /// The stops of a chunk that stand within contours.
    pub(crate) fn tabs_in(&self, chunk: usize) -> usize {
        let before = |chunk: usize| self.tabs.partition_point(|tab| tab.0 < chunk);
        before(chunk + 1) - before(chunk)
    }

    /// The beginnings of the contours that do not close, from one place up to another.
    pub(crate) fn open_within(&self, places: Range<PartAt>) -> impl Iterator<Item = PartAt> {
        let within = self.heads.within(places);
        within.filter(|head| head.is_open).map(|head| head.begin)
    }

    /// Whether the cut that begins at a place is such a contour.
    pub(crate) fn is_open(&self, begin: PartAt) -> bool {
        self.heads.at(begin).is_some_and(|head| head.is_open)
    }

    /// The contours that cross or coincide with themselves, and where, in the order of the text.
    pub(crate) fn crossing(&self) -> impl Iterator<Item = &Crossing<C>> {
        self.crossing.iter()
    }

    /// Those of them that begin from one place up to another.
    pub(crate) fn crossing_within(
        &self,
        places: Range<PartAt>,
    ) -> impl Iterator<Item = &Crossing<C>> {
        self.crossing.within(places)
    }
}

#[cfg(test)]
mod tests;
