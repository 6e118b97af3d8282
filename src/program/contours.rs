//! The contours of a program, in any language: which stops lie within one, and where one crosses
//! itself. After an edit only the contours that it touches are looked at.
//!
//! An open cut is followed past its stops, so the result depends on later cuts; how far the search
//! went is kept. Everything from the first touched cut up to where contours begin as before is
//! looked at again.

use super::chunks::Reread;
use super::path::{Found, HasCuts, Known, KnownTabs};
use std::ops::Range;
use std::sync::Arc;

/// A part of a cut by its chunk and its index in there.
pub(in crate::program) type PartAt = (usize, usize);

/// A document whose cuts begin and end at parts of its chunks.
pub(in crate::program) trait Followed: HasCuts<Cut: Clone> {
    /// The first cut that begins between two places and needs to be looked at.
    fn next_cut(&self, from: PartAt, before: PartAt) -> Option<Self::Cut>;

    fn begin(&self, cut: &Self::Cut) -> PartAt;

    /// Where the cut after it begins.
    fn behind(&self, cut: &Self::Cut) -> PartAt;

    /// The contour that an open cut forms with the cuts after its stops; `None` where it need not
    /// be looked for.
    fn follow(&self, cut: &Self::Cut, known: &mut KnownTabs) -> Option<Contour<Self::Cut>>;

    /// Renumbers its chunks.
    fn renumber(cut: &mut Self::Cut, moved: &dyn Fn(usize) -> usize);
}

/// The contour that an open cut forms with the cuts after its stops.
pub(in crate::program) struct Contour<C> {
    /// The stops within it, in the order of the text, each by its chunk and its place in there.
    pub(crate) tabs: Vec<(usize, usize)>,
    /// All its cuts as one, where the last of them is its tab.
    pub(crate) whole: Option<C>,
    /// It does not close.
    pub(crate) is_open: bool,
    /// Where the next contour may begin.
    pub(crate) behind: PartAt,
    /// The last chunk that was looked at for this.
    pub(crate) reach: usize,
}

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

/// The contours of a program that stop, are open or cross themselves.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct Contours<C> {
    heads: Vec<Head>,
    /// The stops within contours, in the order of the text.
    tabs: Vec<(usize, usize)>,
    /// Those that cross or coincide with themselves, and where.
    crossing: Vec<(C, Arc<Found>)>,
    /// The cuts that the last look began with.
    #[cfg(test)]
    pub(crate) looked_at: usize,
}

impl<C> Default for Contours<C> {
    fn default() -> Self {
        Contours {
            heads: Vec::new(),
            tabs: Vec::new(),
            crossing: Vec::new(),
            #[cfg(test)]
            looked_at: 0,
        }
    }
}

/// The cuts that an edit may have changed: those from one place up to another. Both are the beginnings of cuts, and the
/// cut before the first has nothing to do with those lines.
#[derive(Clone, Copy)]
pub(in crate::program) struct Touched<'a> {
    pub(crate) reread: &'a Reread,
    pub(crate) from: PartAt,
    pub(crate) to: PartAt,
}

impl Touched<'_> {
    fn moved(&self, (chunk, place): PartAt) -> Option<PartAt> {
        Some((self.reread.moved(chunk)?, place))
    }

    /// Replaces what was known of the touched cuts, in a list of things in the order of cuts.
    pub(crate) fn splice<T>(
        &self,
        list: &mut Vec<T>,
        begin: impl Fn(&T) -> PartAt,
        renumber: impl Fn(&mut T, &dyn Fn(usize) -> usize),
        fresh: impl IntoIterator<Item = T>,
    ) {
        let first = list.partition_point(|one| begin(one) < self.from);
        let is_gone = |one: &T| self.moved(begin(one)).is_none_or(|begin| begin < self.to);
        let gone = list
            .iter()
            .skip(first)
            .take_while(|one| is_gone(one))
            .count();
        if self.reread.chunks.len() != self.reread.before {
            let moved = |chunk: usize| self.reread.moved(chunk).unwrap_or(self.reread.chunks.end);
            let behind = list.iter_mut().skip(first + gone);
            behind.for_each(|one| renumber(one, &moved));
        }
        list.splice(first..first + gone, fresh);
    }
}

impl<C: Clone> Contours<C> {
    /// Looks at the cuts that were touched, and at those whose contours depend on them: each
    /// contour is handed out, with whether it crosses itself where that had to be found. Returns
    /// all that was looked at.
    pub(crate) fn look<'a, D: Followed<Cut = C>>(
        &mut self,
        document: &D,
        touched: Touched<'a>,
        known: &mut Known,
        mut each: impl FnMut(C, Option<bool>),
    ) -> Touched<'a> {
        let Touched { reread, .. } = touched;
        let is_touched =
            |head: &Head| head.reach >= reread.chunks.start || head.begin >= touched.from;
        let kept = self.heads.iter().position(is_touched);
        let kept = kept.unwrap_or(self.heads.len());
        let own_behind = self.heads[..kept].last().map_or((0, 0), |head| head.behind);
        let first = self.heads.get(kept).map(|head| head.begin);
        let from = first.map_or(touched.from, |first| first.min(touched.from));
        let mut again = Touched {
            from: from.max(own_behind),
            ..touched
        };
        let (mut heads, mut tabs, mut crossing) = (Vec::new(), Vec::new(), Vec::new());
        let (mut at, mut behind) = (again.from, again.from);
        let mut gone = kept;
        known.begin();
        #[cfg(test)]
        (self.looked_at = 0);
        loop {
            // Whatever belonged to a contour that is looked at again is looked at again, too.
            while let Some(head) = self.heads.get(gone)
                && touched
                    .moved(head.begin)
                    .is_none_or(|begin| begin < again.to)
            {
                again.to = again.to.max(touched.moved(head.behind).unwrap_or(again.to));
                gone += 1;
            }
            let Some(mut cut) = document.next_cut(at, again.to) else {
                break;
            };
            #[cfg(test)]
            (self.looked_at += 1);
            let begin = document.begin(&cut);
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
        known.tidy();
        self.put(&again, kept..gone, heads, tabs);
        let begin = |(cut, _): &(C, Arc<Found>)| document.begin(cut);
        again.splice(
            &mut self.crossing,
            begin,
            |(cut, _), moved| D::renumber(cut, moved),
            crossing,
        );
        again
    }

    /// Puts heads and their stops in the place of some.
    fn put(
        &mut self,
        again: &Touched<'_>,
        gone: Range<usize>,
        heads: Vec<Head>,
        tabs: Vec<(usize, usize)>,
    ) {
        let tabs_of = |heads: &[Head]| heads.iter().map(|head| head.tabs as usize).sum::<usize>();
        let first = tabs_of(&self.heads[..gone.start]);
        let gone_tabs = first..first + tabs_of(&self.heads[gone.clone()]);
        if again.reread.chunks.len() != again.reread.before {
            let moved = |chunk: &mut usize| *chunk = again.reread.moved(*chunk).unwrap_or(*chunk);
            for head in &mut self.heads[gone.end..] {
                moved(&mut head.begin.0);
                moved(&mut head.behind.0);
                moved(&mut head.reach);
            }
            let behind = self.tabs[gone_tabs.end..].iter_mut();
            behind.for_each(|(chunk, _)| moved(chunk));
        }
        self.heads.splice(gone, heads);
        self.tabs.splice(gone_tabs, tabs);
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
        let first = self.heads.partition_point(|head| head.begin < places.start);
        let within = self.heads[first..].iter();
        let within = within.take_while(move |head| head.begin < places.end);
        within.filter(|head| head.is_open).map(|head| head.begin)
    }

    /// Whether the cut that begins at a place is such a contour.
    pub(crate) fn is_open(&self, begin: PartAt) -> bool {
        let head = self.heads.binary_search_by_key(&begin, |head| head.begin);
        head.ok()
            .and_then(|at| self.heads.get(at))
            .is_some_and(|head| head.is_open)
    }

    /// The contours that cross or coincide with themselves, and where, in the order of the text.
    pub(crate) fn crossing(&self) -> &[(C, Arc<Found>)] {
        &self.crossing
    }

    /// Those of them that begin from one place up to another.
    pub(crate) fn crossing_within(
        &self,
        places: Range<PartAt>,
        begin: impl Fn(&C) -> PartAt,
    ) -> &[(C, Arc<Found>)] {
        let before = |to: PartAt| self.crossing.partition_point(|(cut, _)| begin(cut) < to);
        let within = self.crossing.get(before(places.start)..before(places.end));
        within.unwrap_or_default()
    }
}

#[cfg(test)]
mod tests;
