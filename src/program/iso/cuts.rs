//! The cuts of a program, put together from its stretches: whether they close, and which stops stand within a contour,
//! before its tab.

use super::cut::{JoinedCut, PartAt};
use super::document::Document;
use super::moves::{Move, Place, apart, micrometres};
use super::part::Part;
use super::stretch::StopAt;
use crate::geometry::{Point, Segment};
use crate::program::path::{
    self, BehindStops, Blocks, Ends, HasCuts, HeldWay, KnownTabs, Lay, Node, PartedWay, Way,
    Writing, goes_on, mixed, pieces_of,
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
        way_of(self, cut.places(), stop, Some(ends))
    }

    fn mark(&self, cut: &JoinedCut) -> u64 {
        let lay = |at: &PartAt| self.stretches().get(at.stretch)?.lay(at.part);
        let stop = cut.before_tab.map_or(0, |moves| u64::from(moves) + 1);
        let marks = cut.parts.iter().filter_map(lay).map(|lay| lay.mark);
        marks.fold(stop, mixed)
    }

    fn last_block(&self, cut: &JoinedCut) -> Option<Range<usize>> {
        Some(cut.last_range.clone())
    }

    fn part_count(&self, cut: &JoinedCut) -> usize {
        cut.parts.len()
    }

    fn is_doubtful(&self, cut: &JoinedCut) -> bool {
        !cut.sum.whole || cut.sum.faulty
    }
}

impl Document {
    /// The tolerance of a cut's end at a place, µm.
    pub(super) fn tolerance(&self, cut: &JoinedCut) -> f64 {
        self.ends(cut).tolerance
    }

    /// The ends of some moves, relative to their start.
    fn ends_of(&self, sum: &Part) -> Ends {
        let ([first, second], [_, last]) = (&sum.first, &sum.last);
        let seen = |place: Place| Node::at(micrometres(apart(place, first.from)));
        Ends {
            begin: [first.from, first.to, second.to].map(seen),
            end: [last.from, last.to].map(seen),
            blocks: sum.moves as usize,
            tolerance: path::tolerance(sum.arcs as usize).max(self.reading().writing().slack),
        }
    }

    /// The doubtful cuts, each with its continuation behind the stop at its tab; and the stops before tabs.
    pub(super) fn find_contours(&self, known: &mut KnownTabs) -> (Vec<JoinedCut>, Vec<StopAt>) {
        let cuts = cuts(self);
        let tabs = tabs(self, &cuts, known);
        (contours(cuts, &tabs), tabs)
    }
}

/// The cuts in the order in which they run; `None` stands for sound cuts.
fn cuts(document: &Document) -> Vec<Option<JoinedCut>> {
    let mut cuts = Vec::new();
    // The last one, while it may still grow.
    let mut open: Option<JoinedCut> = None;
    // The last stretch of a sound one.
    let mut sound_up_to: Option<usize> = None;
    for (index, placed) in document.placed().enumerate() {
        let stretch = placed.stretch;
        if let Some(cut) = open.as_mut().filter(|cut| cut.sum.open) {
            cut.reach = index;
            cut.sum.faulty |= stretch.faulty_before;
            if let Some(whole) = stretch.ends_cut_before {
                cut.sum.whole &= whole;
                cut.sum.open = false;
            }
        }
        if let Some(cut) = &mut open {
            cut.stopped(stretch.stop_before, index);
            cut.sum.ends_open |= stretch.ends_open_before;
        }
        let inner = stretch.inner();
        let continues = sound_up_to.is_some_and(|last| index <= last);
        for part in 0..stretch.part_count() {
            let is_last = part + 1 == stretch.part_count();
            let is_sound = (part == 0 && continues && inner.start > 0)
                || (stretch.is_clean && inner.contains(&part))
                || (is_last && stretch.sound_over.is_some());
            if is_sound {
                if let Some(before) = open.take() {
                    cuts.extend([Some(before), None]);
                }
                continue;
            }
            let Some(own) = JoinedCut::of(&placed, index, part) else {
                continue;
            };
            match &mut open {
                Some(known) if own.sum.continues && known.sum.open => known.append(own),
                _ => cuts.extend(open.replace(own).map(Some)),
            }
        }
        sound_up_to = stretch.sound_over.map(|over| index + over).or(sound_up_to);
    }
    cuts.extend(open.map(Some));
    cuts
}

/// The doubtful cuts, each with its continuation behind the stop at its tab.
fn contours(cuts: Vec<Option<JoinedCut>>, tabs: &[StopAt]) -> Vec<JoinedCut> {
    let mut contours: Vec<JoinedCut> = Vec::new();
    let mut goes_on = false;
    for cut in cuts.into_iter().flatten() {
        match contours.last_mut().filter(|_| goes_on) {
            Some(before) => before.append(cut),
            None => contours.push(cut),
        }
        let stop = contours.last().and_then(JoinedCut::single_stop);
        goes_on = stop.is_some_and(|stop| tabs.binary_search(&stop).is_ok());
    }
    contours
}

/// The stops before tabs, in the order in which they run.
fn tabs(document: &Document, cuts: &[Option<JoinedCut>], known: &mut KnownTabs) -> Vec<StopAt> {
    let mut found = Vec::new();
    let stretches = document.stretches();
    if stretches.iter().all(|stretch| stretch.pauses == 0) {
        return found;
    }
    let open_cut = cuts.iter().map(|cut| {
        let cut = cut.as_ref()?;
        (cut.sum.whole && !document.goes_round(cut)).then(|| OpenCut {
            cut,
            pieces: OnceCell::new(),
        })
    });
    let cuts: Vec<Option<OpenCut<'_>>> = open_cut.collect();
    let mut first = 0;
    while first < cuts.len() {
        let end = cuts[first].as_ref().and_then(|open| {
            let mut behind = Behind {
                document,
                cuts: &cuts[first..],
                taken: 1,
                sum: *open.cut.sum,
            };
            (goes_on(&mut behind, known) == Some(true)).then_some(first + behind.taken)
        });
        let before_stops = first..end.map_or(first, |end| end - 1);
        let stops = cuts[before_stops].iter().flatten();
        found.extend(stops.filter_map(|open| open.cut.single_stop()));
        first = end.unwrap_or(first + 1);
    }
    found
}

/// A cut that does not enclose anything by itself, and its moves, once they were asked for.
struct OpenCut<'a> {
    cut: &'a JoinedCut,
    pieces: OnceCell<Vec<Segment>>,
}

/// Open cuts that continue each other behind stops.
struct Behind<'a> {
    document: &'a Document,
    /// From the first one on; `None` for one that is not open.
    cuts: &'a [Option<OpenCut<'a>>],
    taken: usize,
    /// Of all cuts so far.
    sum: Part,
}

impl BehindStops for Behind<'_> {
    fn take_next(&mut self) -> Option<()> {
        let [last, next] = self.cuts.get(self.taken - 1..self.taken + 1)? else {
            return None;
        };
        let (last, next) = (last.as_ref()?.cut, next.as_ref()?.cut);
        let goes_on = last.single_stop().is_some() && last.sum.last[1].to == next.sum.first[0].from;
        self.sum.append(goes_on.then_some(&next.sum)?);
        self.taken += 1;
        Some(())
    }

    fn ends(&self) -> Ends {
        self.document.ends_of(&self.sum)
    }

    /// Relative to the start of the first of them.
    fn way(&self, cuts: Range<usize>) -> impl Way {
        let open = || self.cuts[cuts.clone()].iter().flatten();
        let begin = open().next().map_or([0, 0], |open| open.cut.sum.start());
        let writing = self.document.reading().writing();
        let mut way = HeldWay::from(Node::at(Point::origin()), writing);
        for (nth, OpenCut { cut, pieces }) in open().enumerate() {
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
        let last = self.cuts[self.taken - 1].as_ref();
        let way = last.map_or(0, |open| self.document.mark(open.cut));
        // What ends within the step of the program coincides.
        mixed(way, self.document.reading().writing().slack.to_bits())
    }

    /// None of them goes round.
    fn last_stands_alone(&self) -> bool {
        false
    }
}

/// The way of some consecutive parts, stretches and their parts, relative to the start of the first.
pub(super) fn way_of(
    document: &Document,
    places: Vec<(usize, usize)>,
    stop: Option<usize>,
    ends: Option<[[Node; 2]; 2]>,
) -> PartedWay<'_> {
    let extent = |&(index, part): &(usize, usize)| document.stretches().get(index)?.extent(part);
    let begin = places
        .first()
        .and_then(extent)
        .map_or([0, 0], |(start, ..)| start);
    let part = |place: &(usize, usize)| {
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
    places: Vec<(usize, usize)>,
}

impl Held<'_> {
    /// Hands over the moves of a part; returns the byte from which their places count.
    fn moves(&self, part: usize, each: &mut dyn FnMut(&Move, Range<usize>)) -> usize {
        let (stretch, nth) = self.places[part];
        let heard = &mut |index: usize, step: &Move, range: (u32, u32)| {
            if index == nth {
                each(step, range.0 as usize..range.1 as usize);
            }
        };
        self.document.run_again(stretch, heard)
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
        let own = ranges.into_iter().nth(nth)?;
        Some(own.start + offset..own.end + offset)
    }

    fn writing(&self) -> Writing {
        self.document.reading().writing()
    }
}
