//! The cuts of a program: consecutive moves without a rapid or a stop between, put together from the stretches that they run through;
//! and which stops stand within a contour, before its tab.

use super::document::{Document, Placed, StopAt};
use super::machine::{Move, Place, apart, micrometres};
use super::run::{Path, Run, SEVERAL, changes_side};
use crate::geometry::{Point, Segment};
use crate::program::path::{
    self, Blocks, HeldWay, Node, PartedWay, Writing, closing, goes_round, is_tab, mixed, pieces_of,
};
use std::cell::OnceCell;
use std::ops::Range;

/// The share of a cut in one stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    /// Indices of the stretch, and of the run in there.
    pub stretch: usize,
    pub run: usize,
    /// Byte of the text from which the stretch's places count.
    pub offset: usize,
}

#[derive(Clone, Debug)]
pub(super) struct Cut {
    pub parts: Vec<Part>,
    pub run: Run,
    /// The line that begins it, and the one that ends it, in the text.
    pub range: Range<usize>,
    pub last_range: Range<usize>,
    /// The stop that ended it, where it is a single one.
    stop: Option<StopAt>,
    stops: usize,
    /// Moves before the stop at its tab.
    before_tab: Option<u32>,
    /// Where the wire was sent to the other side first, and the line that did so.
    pub flip: Option<(Place, Range<usize>)>,
}

/// Twice the area of which no way to and fro encloses as much, nm²: 1 mm².
const LARGE: u128 = 2_000_000_000_000;

impl Cut {
    pub fn of(placed: &Placed<'_>, stretch: usize, run: usize) -> Option<Cut> {
        let (offset, its) = (placed.offset, placed.stretch.run_at(run)?);
        let place = |(start, end): (u32, u32)| offset + start as usize..offset + end as usize;
        let mut cut = Cut {
            parts: vec![Part {
                stretch,
                run,
                offset,
            }],
            flip: its.flip.map(|(at, line)| (at, place(line))),
            range: place(its.range),
            last_range: place(its.last_range),
            run: its,
            stop: None,
            stops: 0,
            before_tab: None,
        };
        cut.stopped(its.stop, stretch);
        Some(cut)
    }

    fn stopped(&mut self, stop: Option<u32>, stretch: usize) {
        match stop {
            None => {}
            Some(SEVERAL) => self.stops += 2,
            Some(at) => {
                self.stops += 1;
                self.stop = Some((stretch, at));
            }
        }
    }

    /// This cut and then the next, which goes on from where it ends: behind the stop at its tab, where there was one.
    pub fn append(&mut self, next: Cut) {
        if self.stops > 0 {
            self.before_tab.get_or_insert(self.run.moves);
        }
        let flips = self.stops == 0 && changes_side(&self.run.last[1], &next.run.first[0]);
        let flip = flips.then(|| (next.run.start(), next.range.clone()));
        self.flip = self.flip.take().or(flip).or(next.flip);
        self.run.append(&next.run);
        self.last_range = next.last_range;
        self.parts.extend(next.parts);
        (self.stop, self.stops) = (next.stop, next.stops);
    }

    pub fn single_stop(&self) -> Option<StopAt> {
        self.stop.filter(|_| self.stops == 1)
    }

    /// Indices of its stretches and of its runs in there.
    pub fn places(&self) -> Vec<(usize, usize)> {
        let place = |part: &Part| (part.stretch, part.run);
        self.parts.iter().map(place).collect()
    }

    /// Its moves, from where it begins.
    pub fn way<'a>(&self, document: &'a Document) -> PartedWay<'a> {
        let begin = self.run.start();
        let seen = |place: Place| Node::at(micrometres(apart(place, begin)));
        let step = |step: &Move| [seen(step.from), seen(step.to)];
        let ends = [step(&self.run.first[0]), step(&self.run.last[1])];
        let stop = self.before_tab.map(|moves| moves as usize);
        way_of(document, self.places(), stop, Some(ends))
    }

    /// Cuts that run on one way, fall into stretches alike and stop before one move of it have one mark.
    pub fn mark(&self, document: &Document) -> u64 {
        let path = |part: &Part| document.stretches().get(part.stretch)?.paths.get(part.run);
        let stop = self.before_tab.map_or(0, |moves| u64::from(moves) + 1);
        let marks = self.parts.iter().filter_map(path).map(|path| path.mark);
        marks.fold(stop, mixed)
    }

    /// How far it may end beside a place and still end in it, µm.
    pub fn tolerance(&self, document: &Document) -> f64 {
        path::tolerance(self.run.arcs as usize).max(document.reading().writing().slack)
    }

    /// How it lies on itself, where it runs through one stretch.
    fn only_path<'a>(&self, document: &'a Document) -> Option<&'a Path> {
        let [part] = self.parts[..] else { return None };
        document.stretches().get(part.stretch)?.paths.get(part.run)
    }

    /// Whether it goes round something: passes to and fro do not.
    fn goes_round(&self, document: &Document) -> bool {
        // What encloses so much needs no closer look, which an edit would pay for every cut that runs from one stretch into the next.
        if self.run.twice_area.unsigned_abs() > LARGE && self.closes_by_ends(document) {
            return true;
        }
        self.only_path(document).map_or_else(
            || goes_round(&self.way(document)) == Some(true),
            |path| path.goes_round,
        )
    }

    fn closes_by_ends(&self, document: &Document) -> bool {
        let tolerance = self.tolerance(document);
        let is_near = |a: Place, b: Place| super::machine::distance(a, b) / 1e3 <= tolerance;
        let (begin, end) = (self.run.first[0], self.run.last[1].to);
        is_near(begin.from, end) || (self.run.moves > 2 && is_near(begin.to, end))
    }

    /// Whether it closes; its ends alone tell that for nearly all cuts.
    pub fn closes(&self, document: &Document) -> bool {
        if self.closes_by_ends(document) {
            return true;
        }
        if let Some(path) = self.only_path(document) {
            return path.closes;
        }
        closing(&self.way(document)).is_some_and(|closing| closing.closed)
    }
}

/// Hands out the cuts in the order in which they run; `None` stands for cuts with which nothing is wrong, all in one stretch.
pub(super) fn cuts(document: &Document, each: &mut dyn FnMut(Option<Cut>)) {
    let mut open: Option<Cut> = None;
    for (index, placed) in document.placed().enumerate() {
        let stretch = placed.stretch;
        if let Some(whole) = stretch.ends_run_before
            && let Some(cut) = open.as_mut().filter(|cut| cut.run.open)
        {
            cut.run.whole &= whole;
            cut.run.faulty |= stretch.faulty_before;
            cut.run.open = false;
        }
        if let Some(cut) = &mut open {
            cut.stopped(stretch.stop_before, index);
        }
        let skipped = if stretch.is_quiet {
            stretch.inner()
        } else {
            0..0
        };
        for run in (0..skipped.start).chain(skipped.end..stretch.run_count()) {
            if run == skipped.end && !skipped.is_empty() {
                open.take().into_iter().for_each(|cut| each(Some(cut)));
                each(None);
            }
            let Some(own) = Cut::of(&placed, index, run) else {
                continue;
            };
            match &mut open {
                Some(known) if own.run.continues && known.run.open => known.append(own),
                _ => open
                    .replace(own)
                    .into_iter()
                    .for_each(|cut| each(Some(cut))),
            }
        }
        if !skipped.is_empty() && skipped.end == stretch.run_count() {
            open.take().into_iter().for_each(|cut| each(Some(cut)));
            each(None);
        }
    }
    open.into_iter().for_each(|cut| each(Some(cut)));
}

/// Hands out the cuts with which something may be wrong, each with what goes on behind the stop at its tab.
pub(super) fn contours(document: &Document, each: &mut dyn FnMut(Cut)) {
    let mut waiting: Option<Cut> = None;
    cuts(document, &mut |cut| {
        let Some(cut) = cut else { return };
        let cut = match waiting.take() {
            Some(mut before) => {
                before.append(cut);
                before
            }
            None => cut,
        };
        if cut.single_stop().is_some_and(|stop| document.is_tab(stop)) {
            waiting = Some(cut);
        } else {
            each(cut);
        }
    });
    waiting.into_iter().for_each(each);
}

impl Document {
    /// The stops before tabs, in the order in which they run.
    pub(super) fn find_tabs(&self) -> Vec<StopAt> {
        tabs(self)
    }
}

fn tabs(document: &Document) -> Vec<StopAt> {
    if document
        .stretches()
        .iter()
        .all(|stretch| stretch.pauses == 0)
    {
        return Vec::new();
    }
    let mut found = Vec::new();
    // Cuts that are open, one behind the other.
    let mut open: Vec<OpenCut> = Vec::new();
    cuts(document, &mut |cut| {
        let Some(cut) = cut.filter(|cut| cut.run.whole && !cut.goes_round(document)) else {
            return open.clear();
        };
        let goes_on = |last: &OpenCut| {
            last.cut.single_stop().is_some() && last.cut.run.last[1].to == cut.run.first[0].from
        };
        if !open.last().is_some_and(goes_on) {
            open.clear();
        }
        open.push(OpenCut {
            cut,
            pieces: OnceCell::new(),
        });
        let way = |cuts: Range<usize>| held(document, &open[cuts]);
        let last = open.len() - 1;
        let moves = |begin: usize| {
            open[begin..]
                .iter()
                .map(|open| open.cut.run.moves)
                .sum::<u32>()
        };
        let is_tab = |begin: &usize| {
            moves(*begin) > 2
                && is_tab(
                    &way(*begin..last),
                    &way(last..last + 1),
                    &way(*begin..last + 1),
                ) == Some(true)
        };
        if let Some(begin) = (0..last).find(is_tab) {
            found.extend(
                open[begin..last]
                    .iter()
                    .filter_map(|open| open.cut.single_stop()),
            );
            open.clear();
        }
        if open.len() > MOST_STOPS {
            open.remove(0);
        }
        if open
            .last()
            .is_some_and(|last| last.cut.single_stop().is_none())
        {
            open.clear();
        }
    });
    found
}

/// A cut that does not go round for itself, and its moves, once they were asked for.
struct OpenCut {
    cut: Cut,
    pieces: OnceCell<Vec<Segment>>,
}

/// Cuts as one way, from where the first begins.
fn held(document: &Document, cuts: &[OpenCut]) -> HeldWay {
    let begin = cuts.first().map_or([0, 0], |open| open.cut.run.start());
    let mut way = HeldWay::from(Node::at(Point::origin()), document.reading().writing());
    for (nth, OpenCut { cut, pieces }) in cuts.iter().enumerate() {
        if nth > 0 {
            way.stop_here();
        }
        let own = pieces.get_or_init(|| pieces_of(&cut.way(document)).unwrap_or_default());
        let by = micrometres(apart(cut.run.start(), begin)).coords;
        for piece in own.iter().map(|piece| piece.moved(by)) {
            way.push(piece, piece.as_arc().is_some(), Node::at(piece.end()));
        }
    }
    way
}

/// Stops in one contour.
const MOST_STOPS: usize = 4;

/// The way of some parts that go on one behind the other, stretches and their runs, from where the first begins.
pub(super) fn way_of(
    document: &Document,
    places: Vec<(usize, usize)>,
    stop: Option<usize>,
    ends: Option<[[Node; 2]; 2]>,
) -> PartedWay<'_> {
    let extent = |&(index, run): &(usize, usize)| document.stretches().get(index)?.extent(run);
    let begin = places
        .first()
        .and_then(extent)
        .map_or([0, 0], |(start, ..)| start);
    let part = |place: &(usize, usize)| {
        let (start, moves, arcs) = extent(place)?;
        let path = document.stretches().get(place.0)?.paths.get(place.1)?;
        Some(path::Part {
            mark: path.mark,
            blocks: moves as usize,
            arcs: arcs as usize,
            start: apart(start, begin),
            bounds: path.bounds,
            near: &path.near,
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
    /// Tells of the moves of a part; gives the byte from which their places count.
    fn moves(&self, part: usize, each: &mut dyn FnMut(&Move, Range<usize>)) -> usize {
        let (stretch, run) = self.places[part];
        let heard = &mut |index: usize, step: &Move, range: (u32, u32)| {
            if index == run {
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
