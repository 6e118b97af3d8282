//! The cuts of a program: consecutive moves without a rapid or a stop between, put together from the stretches that they run through;
//! and which stops stand within a contour, before its tab.

use super::crossings::pieces;
use super::document::{Document, Placed};
use super::machine::{Place, micrometres};
use super::stretch::{Run, SEVERAL, changes_side};
use crate::geometry::{Bounds, Point, Segment, Vector};
use crate::program::path::{self, HeldWay, Node, Way, Writing, closing, is_tab, pieces_of};
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

/// A stop: the index of its stretch, and its byte counted from there.
pub(super) type StopAt = (usize, u32);

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

    /// How far it may end beside a place and still end in it, µm.
    pub fn tolerance(&self, document: &Document) -> f64 {
        path::tolerance(self.run.arcs as usize).max(document.reading().writing().slack)
    }

    /// Whether it closes; its ends alone tell that for nearly all cuts.
    pub fn closes(&self, document: &Document) -> bool {
        let tolerance = self.tolerance(document);
        let is_near = |a: Place, b: Place| super::machine::distance(a, b) / 1e3 <= tolerance;
        let (begin, end) = (self.run.first[0], self.run.last[1].to);
        if is_near(begin.from, end) || (self.run.moves > 2 && is_near(begin.to, end)) {
            return true;
        }
        if let [part] = self.parts[..] {
            let path = document
                .stretches()
                .get(part.stretch)
                .and_then(|stretch| stretch.paths.get(part.run));
            return path.is_some_and(|path| path.closes);
        }
        closing(&CutWay::of(document, &[self])).is_some_and(|closing| closing.closed)
    }
}

/// Hands out the cuts in the order in which they run; `None` stands for cuts with which nothing is wrong, all in one stretch.
pub(super) fn cuts(document: &Document, each: &mut dyn FnMut(Option<Cut>)) {
    let mut open: Option<Cut> = None;
    for (index, placed) in document.placed().enumerate() {
        let stretch = placed.stretch;
        if let Some(whole) = stretch.ends_run_before
            && let Some(cut) = &mut open
        {
            cut.run.whole &= whole;
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

/// The stops before tabs, in the order in which they run.
pub(super) fn tabs(document: &Document) -> Vec<StopAt> {
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
        let Some(cut) = cut.filter(|cut| cut.run.whole && !cut.closes(document)) else {
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

/// A cut that does not close for itself, and its moves, once they were asked for.
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
        let own =
            pieces.get_or_init(|| pieces_of(&CutWay::of(document, &[cut])).unwrap_or_default());
        let start = cut.run.start();
        let by = micrometres([
            start[0].wrapping_sub(begin[0]),
            start[1].wrapping_sub(begin[1]),
        ])
        .coords;
        for piece in own.iter().map(|piece| piece.moved(by)) {
            way.push(piece, piece.as_arc().is_some(), Node::at(piece.end()));
        }
    }
    way
}

/// Stops in one contour.
const MOST_STOPS: usize = 4;

/// Cuts as one way, from where the first begins. Costs their parts, and the lines of those that are asked for.
pub(super) struct CutWay<'a> {
    document: &'a Document,
    parts: Vec<WayPart>,
    count: usize,
    arcs: usize,
    stop: Option<usize>,
    /// Before and behind the first and the last move, µm, where they are known beforehand.
    ends: Option<[[Point; 2]; 2]>,
}

struct WayPart {
    /// Indices of the stretch and of the run in there.
    part: (usize, usize),
    first: usize,
    start: Vector,
    bounds: Bounds,
    pieces: OnceCell<Vec<Segment>>,
}

impl<'a> CutWay<'a> {
    fn of(document: &'a Document, cuts: &[&Cut]) -> CutWay<'a> {
        let begin = cuts.first().map_or([0, 0], |cut| cut.run.start());
        let seen = |place: Place| {
            micrometres([
                place[0].wrapping_sub(begin[0]),
                place[1].wrapping_sub(begin[1]),
            ])
        };
        let step = |step: &super::machine::Move| [seen(step.from), seen(step.to)];
        let first = cuts
            .first()
            .map_or([Point::origin(); 2], |cut| step(&cut.run.first[0]));
        let last = cuts
            .last()
            .map_or([Point::origin(); 2], |cut| step(&cut.run.last[1]));
        let first_cut = cuts
            .first()
            .and_then(|cut| cut.before_tab.or((cuts.len() > 1).then_some(cut.run.moves)));
        let stop = first_cut.map(|moves| moves as usize);
        let parts = cuts
            .iter()
            .flat_map(|cut| &cut.parts)
            .map(|part| (part.stretch, part.run));
        CutWay {
            stop,
            ends: Some([first, last]),
            ..CutWay::from(document, begin, parts)
        }
    }

    /// The way of some parts that go on one behind the other: stretches and their runs.
    pub fn of_parts(document: &'a Document, parts: &[(usize, usize)]) -> CutWay<'a> {
        let first = parts
            .first()
            .and_then(|(stretch, run)| document.stretches().get(*stretch)?.extent(*run));
        CutWay::from(
            document,
            first.map_or([0, 0], |(start, ..)| start),
            parts.iter().copied(),
        )
    }

    fn from(
        document: &'a Document,
        begin: Place,
        parts: impl Iterator<Item = (usize, usize)>,
    ) -> CutWay<'a> {
        let seen = |place: Place| {
            micrometres([
                place[0].wrapping_sub(begin[0]),
                place[1].wrapping_sub(begin[1]),
            ])
        };
        let mut way = CutWay {
            document,
            parts: Vec::new(),
            count: 0,
            arcs: 0,
            stop: None,
            ends: None,
        };
        for (index, run) in parts {
            let Some(stretch) = document.stretches().get(index) else {
                continue;
            };
            let (Some((start, moves, arcs)), Some(path)) =
                (stretch.extent(run), stretch.paths.get(run))
            else {
                continue;
            };
            way.parts.push(WayPart {
                part: (index, run),
                first: way.count,
                start: seen(start).coords,
                bounds: path.bounds,
                pieces: OnceCell::new(),
            });
            way.count += moves as usize;
            way.arcs += arcs as usize;
        }
        way
    }

    fn pieces<'b>(&self, part: &'b WayPart) -> &'b [Segment] {
        part.pieces.get_or_init(|| {
            let own = pieces(self.document, part.part.0, part.part.1).0;
            own.into_iter()
                .map(|piece| piece.moved(part.start))
                .collect()
        })
    }
}

impl Way for CutWay<'_> {
    fn count(&self) -> usize {
        self.count
    }

    fn arcs(&self) -> usize {
        self.arcs
    }

    fn writing(&self) -> Writing {
        self.document.reading().writing()
    }

    fn stop(&self) -> Option<usize> {
        self.stop
    }

    fn node(&self, index: usize) -> Option<Node> {
        let known = self.ends.and_then(|[first, last]| match index {
            0 => Some(first[0]),
            1 => Some(first[1]),
            _ if index == self.count => Some(last[1]),
            _ if index + 1 == self.count => Some(last[0]),
            _ => None,
        });
        let point = match known {
            Some(point) => point,
            None if index == self.count => self.piece(index.checked_sub(1)?)?.end(),
            None => self.piece(index)?.start(),
        };
        Some(Node::at(point))
    }

    fn piece(&self, index: usize) -> Option<Segment> {
        let part = self.parts.get(
            self.parts
                .partition_point(|part| part.first <= index)
                .checked_sub(1)?,
        )?;
        self.pieces(part).get(index - part.first).copied()
    }

    fn pieces_about(
        &self,
        at: Point,
        reach: f64,
        each: &mut dyn FnMut(usize, &Segment) -> bool,
    ) -> Option<()> {
        let place = Bounds::of_disc(at, reach + 1.0);
        for part in &self.parts {
            let bounds = Bounds {
                min: part.bounds.min + part.start,
                max: part.bounds.max + part.start,
            };
            if bounds.touches(&place)
                && self
                    .pieces(part)
                    .iter()
                    .zip(part.first..)
                    .any(|(piece, index)| each(index, piece))
            {
                break;
            }
        }
        Some(())
    }
}
