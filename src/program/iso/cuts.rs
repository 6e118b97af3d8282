//! The cuts of a program, put together from its stretches: whether they close, and which stops stand within a contour,
//! before its tab.

use super::cut::{BytesAt, JoinedCut};
use super::document::Document;
use super::moves::{Move, Place, apart, micrometres};
use super::part::{Part, WireSide};
use super::stretch::Stretch;
use crate::geometry::{Point, Segment};
use crate::program::chunks::Reread;
use crate::program::contours::{Contour, Followed, PartAt};
use crate::program::path::{
    self, BehindStops, Blocks, ControlOffset, Ends, HasCuts, HeldWay, KnownTabs, Lay, Node,
    PartedWay, Way, Writing, goes_on, mixed, pieces_of,
};
use std::borrow::Cow;
use std::cell::OnceCell;
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
        self.stretches().get(stretch)?.lay(part).map(Cow::Borrowed)
    }

    fn way<'a>(&'a self, cut: &JoinedCut) -> PartedWay<'a> {
        let Ends { begin, end, .. } = self.ends(cut);
        let ends = [[begin[0], begin[1]], end];
        let stop = cut.before_tab.map(|moves| moves as usize);
        way_of(self, cut.parts.clone(), stop, Some(ends))
    }

    fn mark(&self, cut: &JoinedCut) -> u64 {
        let lay = |&(stretch, part): &PartAt| self.stretches().get(stretch)?.lay(part);
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
        let stretches = self.stretches();
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

    /// The cut that begins at a part; `None` for one that is known to be sound, and after the last.
    fn cut_from(&self, (stretch, part): PartAt) -> Option<JoinedCut> {
        let own = self.stretches().get(stretch)?;
        let mut cut = JoinedCut::of(own, stretch, part)?;
        if part + 1 < own.part_count() {
            return Some(cut);
        }
        for (index, of) in self.stretches().iter().enumerate().skip(stretch + 1) {
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
            .find(|index| self.stretches()[*index].is_fresh);
        let behind = last.map_or(start, |last| last + 1);
        let reread = Reread {
            chunks: start..behind,
            before: reread.before - (end - behind),
        };
        // The stops after the last cut before the edit may lie in the lines that were read again.
        let mut from = (start, 0);
        let before = self.stretches()[..start].iter().enumerate().rev();
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

    fn follow(&self, cut: &JoinedCut, known: &mut KnownTabs) -> Option<Contour<JoinedCut>> {
        if cut.single_stop().is_none() || !self.is_open(cut) {
            return None;
        }
        let mut open = OpenCuts {
            document: self,
            cuts: vec![OpenCut::new(cut.clone())],
            sum: *cut.sum,
        };
        let is_tab = goes_on(&mut open, known) == Some(true);
        let last = open.cuts.last().map_or(cut, |open| &open.cut);
        let behind = self.behind(last);
        let reach = self
            .cut_from(behind)
            .map_or(behind, |next| self.behind(&next))
            .0;
        let mut contour = Contour {
            tabs: Vec::new(),
            whole: None,
            is_open: false,
            behind: self.behind(cut),
            reach,
        };
        if is_tab {
            let before_stops = &open.cuts[..open.cuts.len() - 1];
            let stops = before_stops
                .iter()
                .filter_map(|open| open.cut.single_stop());
            (contour.tabs, contour.behind) = (stops.collect(), behind);
            contour.whole = open
                .cuts
                .into_iter()
                .map(|open| open.cut)
                .reduce(|mut whole, next| {
                    whole.append(next);
                    whole
                });
        }
        Some(contour)
    }
}

/// A cut that does not enclose anything by itself, and its moves, once they were asked for.
struct OpenCut {
    cut: JoinedCut,
    pieces: OnceCell<Vec<Segment>>,
}

impl OpenCut {
    fn new(cut: JoinedCut) -> OpenCut {
        OpenCut {
            cut,
            pieces: OnceCell::new(),
        }
    }
}

/// Open cuts that continue each other after stops.
struct OpenCuts<'a> {
    document: &'a Document,
    cuts: Vec<OpenCut>,
    /// Of all of them.
    sum: Part,
}

impl BehindStops for OpenCuts<'_> {
    fn take_next(&mut self) -> Option<()> {
        let last = &self.cuts.last()?.cut;
        last.single_stop()?;
        let next = self.document.cut_from(self.document.behind(last))?;
        let goes_on = last.sum.last[1].to == next.sum.first[0].from && self.document.is_open(&next);
        self.sum.append(goes_on.then_some(&next.sum)?);
        self.cuts.push(OpenCut::new(next));
        Some(())
    }

    fn ends(&self) -> Ends {
        self.document.ends_of(&self.sum)
    }

    /// Relative to the start of the first of them.
    fn way(&self, cuts: Range<usize>) -> impl Way {
        let cuts = self.cuts.get(cuts).unwrap_or_default();
        let begin = cuts.first().map_or([0, 0], |open| open.cut.sum.start());
        let writing = self.document.reading().writing();
        let mut way = HeldWay::from(Node::at(Point::origin()), writing);
        for (nth, OpenCut { cut, pieces }) in cuts.iter().enumerate() {
            if nth > 0 {
                way.stop_here();
            }
            let own = || pieces_of(&self.document.way(cut)).unwrap_or_default();
            let by = micrometres(apart(cut.sum.start(), begin)).coords;
            for piece in pieces.get_or_init(own).iter().map(|piece| piece.moved(by)) {
                way.push(piece, piece.as_arc().is_some(), Node::at(piece.end()));
            }
        }
        way
    }

    fn last_mark(&self) -> u64 {
        let last = self.cuts.last();
        let way = last.map_or(0, |open| self.document.mark(&open.cut));
        // What ends within the step of the program coincides.
        mixed(way, self.document.reading().writing().slack.to_bits())
    }

    /// None of them goes round.
    fn last_stands_alone(&self) -> bool {
        false
    }
}

/// The way of some consecutive parts, relative to the start of the first.
fn way_of(
    document: &Document,
    places: Vec<PartAt>,
    stop: Option<usize>,
    ends: Option<[[Node; 2]; 2]>,
) -> PartedWay<'_> {
    let extent = |&(index, part): &PartAt| document.stretches().get(index)?.extent(part);
    let begin = places
        .first()
        .and_then(extent)
        .map_or([0, 0], |(start, ..)| start);
    let part = |place: &PartAt| {
        let (start, moves, arcs) = extent(place)?;
        Some(path::Part {
            lay: Cow::Borrowed(document.stretches().get(place.0)?.lay(place.1)?),
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
