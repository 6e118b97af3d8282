//! The contours of a program: its open cuts, each with what goes on after its stops.

use super::super::sum::{Sum, is_jump};
use super::{At, Document, JoinedCut};
use crate::program::by_chunk::Begun;
use crate::program::contours::PartAt;
use crate::program::followed::Followed;
use crate::program::path::HasCuts;

impl Followed for Document {
    const PIECES_ARE_ONE: bool = true;

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

    /// The blocks from a part on, up to the next word; `None` after the end of the program.
    fn cut_from(&self, start: PartAt) -> Option<JoinedCut> {
        let end = self.view.end;
        let mut cut: Option<JoinedCut> = None;
        let (mut stretch, mut index) = start;
        while let Some(of) = self.stretches.get(stretch) {
            let at = |entry: usize| At { stretch, entry };
            for (nth, part) in of.parts.iter().enumerate().skip(index) {
                if end.is_some_and(|end| end < at(part.entries().start)) {
                    return cut;
                }
                let own = cut.get_or_insert(JoinedCut {
                    parts: [(stretch, nth); 2],
                    sum: Sum::default(),
                    is_jump: false,
                    stop: None,
                });
                own.parts[1] = (stretch, nth);
                own.sum = own.sum.then(&of.sum(part));
                if part.word.is_some() {
                    let is_end = end == Some(at(part.entries().end));
                    own.is_jump = start != (0, 0)
                        && self.is_behind_word(start)
                        && !is_end
                        && is_jump(&own.sum)
                        && !self.stops_again((stretch, nth));
                    return cut;
                }
            }
            (stretch, index) = (stretch + 1, 0);
        }
        cut
    }

    fn may_go_on(&self, cut: &JoinedCut) -> bool {
        let is_empty = cut.sum.blocks + cut.sum.unread == 0;
        !(cut.is_jump
            || is_empty
            || !self.may_be_open(cut)
            || self.goes_round(cut)
            || self.ends_open(cut))
    }

    fn stop_between(&self, _: &JoinedCut, behind: &JoinedCut) -> (usize, usize) {
        behind.begin()
    }

    fn joined(&self, cut: JoinedCut, behind: &JoinedCut) -> JoinedCut {
        JoinedCut {
            parts: [cut.parts[0], behind.parts[1]],
            sum: cut.sum.then(&behind.sum),
            is_jump: false,
            stop: cut.stop.or(Some(cut.sum.blocks)),
        }
    }

    fn stands_alone(&self, cut: &JoinedCut) -> bool {
        cut.sum.blocks > 0 && (cut.is_jump || self.is_closed(cut))
    }

    /// To and fro on one way it closes.
    fn stays_open(&self, cut: &JoinedCut) -> bool {
        !self.is_closed(cut)
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
