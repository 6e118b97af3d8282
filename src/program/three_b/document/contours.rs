//! The contours of a program: its open cuts, each with what goes on after its stops.

use super::cuts::joined;
use super::{At, Document, JoinedCut};
use crate::program::by_chunk::Begun;
use crate::program::contours::{Contour, Followed, PartAt};
use crate::program::path::{BehindStops, Ends, HasCuts, KnownTabs, Way, goes_on};
use std::ops::Range;

/// An open cut and the cuts after its stops.
struct OpenCuts<'a> {
    document: &'a Document,
    /// All as one, and all but the last, which is the first while there is no other.
    whole: JoinedCut,
    before: JoinedCut,
    last: JoinedCut,
    /// The starts of the cuts after the first.
    begins: Vec<PartAt>,
}

impl BehindStops for OpenCuts<'_> {
    fn take_next(&mut self) -> Option<()> {
        let begin = self.document.part_behind(self.whole.parts[1]);
        self.last = self.document.cut_from(begin)?;
        let whole = joined(self.whole.clone(), &self.last);
        self.before = std::mem::replace(&mut self.whole, whole);
        self.begins.push(begin);
        Some(())
    }

    fn ends(&self) -> Ends {
        self.document.ends(&self.whole)
    }

    fn way(&self, cuts: Range<usize>) -> impl Way {
        self.document.way(match (cuts.start, cuts.end) {
            (0, end) if end > self.begins.len() => &self.whole,
            (0, _) => &self.before,
            _ => &self.last,
        })
    }

    fn last_mark(&self) -> u64 {
        self.document.mark(&self.last)
    }

    fn last_stands_alone(&self) -> bool {
        let last = &self.last;
        last.sum.blocks > 0 && (last.is_jump || self.document.is_closed(last))
    }
}

impl Followed for Document {
    /// Of the cuts within one stretch only those that may be open or cross themselves.
    fn next_cut(&self, from: PartAt, before: PartAt) -> Option<JoinedCut> {
        let outer = &self.view.outer;
        let outer = outer.get(outer.partition_point(|cut| cut.parts[0] < from));
        let last = self.last_part();
        for stretch in from.0..self.stretches.len().min(before.0 + 1) {
            let of = self.stretches.get(stretch)?;
            let first = if stretch == from.0 { from.1 } else { 0 };
            let from_first = |parts: &[usize]| {
                let next = parts.partition_point(|part| *part < first);
                parts.get(next).copied()
            };
            let here = |(own, part): PartAt| (own == stretch && part >= first).then_some(part);
            let places = [
                from_first(&of.open),
                from_first(&of.may_cross),
                outer.and_then(|cut| here(cut.parts[0])),
                last.and_then(here),
            ];
            if let Some(part) = places.into_iter().flatten().min() {
                let at = (stretch, part);
                let known = outer.filter(|cut| cut.parts[0] == at).cloned();
                return known.or_else(|| self.cut_from(at)).filter(|_| at < before);
            }
        }
        None
    }

    fn behind(&self, cut: &JoinedCut) -> PartAt {
        self.part_behind(cut.parts[1])
    }

    fn follow(&self, cut: &JoinedCut, known: &mut KnownTabs) -> Option<Contour<JoinedCut>> {
        let is_empty = cut.sum.blocks + cut.sum.unread == 0;
        if cut.is_jump
            || is_empty
            || !self.may_be_open(cut)
            || self.goes_round(cut)
            || self.ends_open(cut)
        {
            return None;
        }
        let mut open = OpenCuts {
            document: self,
            whole: cut.clone(),
            before: cut.clone(),
            last: cut.clone(),
            begins: Vec::new(),
        };
        let is_tab = goes_on(&mut open, known);
        let whole = open.whole;
        let behind = self.behind(&whole);
        let next = self.cut_from(behind);
        let reach = next.map_or(self.stretches.len(), |next| next.parts[1].0);
        Some(match is_tab {
            Some(is_tab) => Contour {
                tabs: open.begins,
                whole: is_tab.then_some(whole),
                is_open: false,
                behind,
                reach,
            },
            None => Contour {
                tabs: Vec::new(),
                whole: None,
                // To and fro on one way it closes.
                is_open: !self.is_closed(cut),
                behind: self.behind(cut),
                reach,
            },
        })
    }
}

impl Begun for JoinedCut {
    type Sum = ();

    fn begin(&self) -> PartAt {
        self.parts[0]
    }

    fn renumber(&mut self, moved: &dyn Fn(usize) -> usize) {
        self.parts = self.parts.map(|(stretch, part)| (moved(stretch), part));
    }

    fn sum(_: &[JoinedCut]) {}
}

impl Document {
    /// The part that the word at the end of the program ends.
    fn last_part(&self) -> Option<PartAt> {
        let At { stretch, entry } = self.view.end?;
        let parts = &self.stretches.get(stretch)?.parts;
        let part = parts.binary_search_by_key(&entry, |part| part.entries().end);
        Some((stretch, part.ok().filter(|part| *part > 0)?))
    }

    /// Between two pauses what looks like a way to the next contour is one; before the end it is not.
    fn may_be_open(&self, cut: &JoinedCut) -> bool {
        let (stretch, part) = cut.parts[0];
        let is_named = |of: &super::Stretch| {
            let is_inner = part > 0 && part + 1 < of.parts.len();
            !is_inner || of.open.binary_search(&part).is_ok()
        };
        self.stretches.get(stretch).is_some_and(is_named)
            || self.last_part() == Some((stretch, part))
    }

    /// Whether the machine stops twice where a cut ends.
    fn ends_open(&self, cut: &JoinedCut) -> bool {
        let last = cut.parts[1];
        let word = self.stretches.get(last.0).and_then(|of| {
            let part = of.parts.get(last.1)?;
            part.word.map(|_| At {
                stretch: last.0,
                entry: part.entries().end,
            })
        });
        word.is_some() && word != self.view.end && self.stops_again(last)
    }
}
