//! The cuts of a program, put together from its stretches: whether they close, and which stops stand within a contour,
//! before its tab.

use super::cut::{BytesAt, JoinedCut};
use super::document::Document;
use super::moves::{Move, Place, apart, micrometres};
use super::part::{Part, WireSide};
use super::stretch::Stretch;
use crate::geometry::Segment;
use crate::program::chunks::Reread;
use crate::program::contours::PartAt;
use crate::program::followed::Followed;
use crate::program::path::{
    self, Blocks, ControlOffset, Ends, HasCuts, Lay, Node, PartedWay, Writing, mixed,
};
use std::borrow::Cow;
use std::ops::Range;

impl HasCuts for Document {
    type Cut = JoinedCut;

    fn ends(&self, cut: &JoinedCut) -> Ends {
        self.ends_of(&cut.sum)
    }

    fn twice_area(&self, cut: &JoinedCut) -> f64 {
        // nm² in µm².
        cut.sum.twice_area as f64 / 1e6
    }

    fn only_lay<'a>(&'a self, cut: &JoinedCut) -> Option<Cow<'a, Lay>> {
        let (stretch, part) = cut.only_place()?;
        self.stretches.get(stretch)?.lay(part).map(Cow::Borrowed)
    }

    fn way<'a>(&'a self, cut: &JoinedCut) -> PartedWay<'a> {
        let Ends { begin, end, .. } = self.ends(cut);
        let ends = [[begin[0], begin[1]], end];
        let stop = cut.before_tab.map(|moves| moves as usize);
        way_of(self, cut.parts.clone(), stop, Some(ends))
    }

    fn mark(&self, cut: &JoinedCut) -> u64 {
        let lay = |&(stretch, part): &PartAt| self.stretches.get(stretch)?.lay(part);
        let stop = cut.before_tab.map_or(0, |moves| u64::from(moves) + 1);
        let marks = cut.parts.iter().filter_map(lay).map(|lay| lay.mark);
        marks.fold(stop, mixed)
    }

    fn last_block(&self, cut: &JoinedCut) -> Option<Range<usize>> {
        Some(self.bytes_of(cut.last_line))
    }

    fn part_count(&self, cut: &JoinedCut) -> usize {
        cut.parts.len()
    }

    fn is_doubtful(&self, cut: &JoinedCut) -> bool {
        !cut.sum.whole || cut.sum.faulty
    }

    /// With the correction of its first moves.
    fn control_offset(&self, cut: &JoinedCut) -> Option<ControlOffset> {
        let WireSide::One(side) = cut.sum.side else {
            return None;
        };
        let [first, second] = &cut.sum.first;
        Some(ControlOffset {
            side,
            correction: self.correction(second.offset.or(first.offset)),
        })
    }
}

impl Document {
    /// The tolerance for the end of some moves at a place, µm.
    pub(super) fn tolerance(&self, sum: &Part) -> f64 {
        path::tolerance(sum.arcs as usize).max(self.reading().writing().slack)
    }

    /// The ends of some moves, relative to their start.
    fn ends_of(&self, sum: &Part) -> Ends {
        let ([first, second], [_, last]) = (&sum.first, &sum.last);
        let seen = |place: Place| Node::at(micrometres(apart(place, first.from)));
        Ends {
            begin: [first.from, first.to, second.to].map(seen),
            end: [last.from, last.to].map(seen),
            blocks: sum.moves as usize,
            tolerance: self.tolerance(sum),
        }
    }

    /// Bytes of the text.
    pub(super) fn bytes_of(&self, (stretch, (start, end)): BytesAt) -> Range<usize> {
        let byte = self.byte_of(stretch);
        byte + start as usize..byte + end as usize
    }

    /// The first part from a place on; after the last stretch where there is none.
    fn first_from(&self, (stretch, part): PartAt) -> PartAt {
        let stretches = &self.stretches;
        let is_here = |of: &Stretch| part < of.part_count();
        if stretches.get(stretch).is_some_and(is_here) {
            return (stretch, part);
        }
        let behind = stretches.iter().enumerate().skip(stretch + 1);
        let mut with_parts = behind.filter(|(_, of)| of.part_count() > 0);
        with_parts
            .next()
            .map_or((stretches.len(), 0), |(stretch, _)| (stretch, 0))
    }

    /// It does not enclose anything by itself.
    fn is_open(&self, cut: &JoinedCut) -> bool {
        cut.sum.whole && !self.goes_round(cut)
    }

    /// Which cuts an edit has touched.
    pub(super) fn touched(&self, reread: &Reread) -> (Reread, [PartAt; 2]) {
        let Range { start, end } = reread.chunks;
        // Stretches that were only moved lie as they did.
        let last = (start..end)
            .rev()
            .find(|index| self.stretches[*index].is_fresh);
        let behind = last.map_or(start, |last| last + 1);
        let reread = Reread {
            chunks: start..behind,
            before: reread.before - (end - behind),
        };
        // The stops after the last cut before the edit may lie in the lines that were read again.
        let mut from = (start, 0);
        let before = self.stretches[..start].iter().enumerate().rev();
        for (index, of) in before.filter(|(_, of)| of.part_count() > 0) {
            let last = of.part_count() - 1;
            let Some(part) = of.part_at(last) else {
                break;
            };
            from = (index, last);
            if last > 0 || !part.continues {
                break;
            }
        }
        (reread, [from, (behind, 0)])
    }
}

impl Followed for Document {
    const PIECES_ARE_ONE: bool = false;

    fn next_cut(&self, from: PartAt, before: PartAt) -> Option<JoinedCut> {
        let mut at = self.first_from(from);
        while at < before {
            let cut = self.cut_from(at);
            if cut.is_some() {
                return cut;
            }
            at = self.first_from((at.0, at.1 + 1));
        }
        None
    }

    fn behind(&self, cut: &JoinedCut) -> PartAt {
        let (stretch, part) = cut.parts.last().copied().unwrap_or_default();
        self.first_from((stretch, part + 1))
    }

    /// The cut that begins at a part; `None` for one that is known to be sound, and after the last.
    fn cut_from(&self, (stretch, part): PartAt) -> Option<JoinedCut> {
        let own = self.stretches.get(stretch)?;
        let mut cut = JoinedCut::of(own, stretch, part)?;
        if part + 1 < own.part_count() {
            return Some(cut);
        }
        for (index, of) in self.stretches.iter().enumerate().skip(stretch + 1) {
            if cut.sum.open {
                cut.sum.faulty |= of.faulty_before;
                if let Some(whole) = of.ends_cut_before {
                    cut.sum.whole &= whole;
                    cut.sum.open = false;
                }
            }
            cut.stopped(of.stop_before, index);
            cut.sum.ends_open |= of.ends_open_before;
            if of.part_count() > 0 {
                let goes_on = |next: &JoinedCut| next.sum.continues && cut.sum.open;
                let Some(next) = JoinedCut::of(of, index, 0).filter(goes_on) else {
                    break;
                };
                cut.append(next);
                if of.part_count() > 1 {
                    break;
                }
            }
        }
        Some(cut)
    }

    fn may_go_on(&self, cut: &JoinedCut) -> bool {
        cut.single_stop().is_some() && self.is_open(cut)
    }

    /// A single stop, after which the wire goes on from where it stands.
    fn behind_stop(&self, cut: &JoinedCut) -> Option<JoinedCut> {
        cut.single_stop()?;
        let next = self.cut_from(self.behind(cut))?;
        let goes_on = cut.sum.last[1].to == next.sum.first[0].from && self.is_open(&next);
        goes_on.then_some(next)
    }

    fn stop_between(&self, cut: &JoinedCut, _: &JoinedCut) -> (usize, usize) {
        cut.single_stop().unwrap_or_default()
    }

    fn joined(&self, mut cut: JoinedCut, behind: &JoinedCut) -> JoinedCut {
        cut.append(behind.clone());
        cut
    }
}

/// The way of some consecutive parts, relative to the start of the first.
fn way_of(
    document: &Document,
    places: Vec<PartAt>,
    stop: Option<usize>,
    ends: Option<[[Node; 2]; 2]>,
) -> PartedWay<'_> {
    let extent = |&(index, part): &PartAt| document.stretches.get(index)?.extent(part);
    let begin = places
        .first()
        .and_then(extent)
        .map_or([0, 0], |(start, ..)| start);
    let part = |place: &PartAt| {
        let (start, moves, arcs) = extent(place)?;
        Some(path::WayPart {
            lay: Cow::Borrowed(document.stretches.get(place.0)?.lay(place.1)?),
            blocks: moves as usize,
            arcs: arcs as usize,
            start: apart(start, begin),
        })
    };
    let parts = places.iter().filter_map(part).collect();
    PartedWay::new(Box::new(Held { document, places }), parts, stop, ends)
}

/// The moves of a cut as its stretches hold them.
struct Held<'a> {
    document: &'a Document,
    places: Vec<PartAt>,
}

impl Held<'_> {
    /// Hands over the moves of a part; returns the byte from which their places count.
    fn moves(&self, part: usize, each: &mut dyn FnMut(&Move, (u32, u32))) -> usize {
        self.document.hear(self.places[part], each)
    }
}

impl Blocks for Held<'_> {
    fn pieces(&self, part: usize) -> Vec<Segment> {
        let (mut start, mut pieces) = (None, Vec::new());
        self.moves(part, &mut |step, _| {
            let start = *start.get_or_insert(step.from);
            pieces.push(step.seen_from(start).segment(self.document.reading()));
        });
        pieces
    }

    fn range(&self, part: usize, nth: usize) -> Option<Range<usize>> {
        let mut ranges = Vec::new();
        let offset = self.moves(part, &mut |_, range| ranges.push(range));
        let (start, end) = *ranges.get(nth)?;
        Some(start as usize + offset..end as usize + offset)
    }

    fn writing(&self) -> Writing {
        self.document.reading().writing()
    }
}
