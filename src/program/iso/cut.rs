//! A cut: consecutive moves of an ISO program without a rapid or a stop between, put together from the parts of its
//! stretches.

use super::moves::Place;
use super::part::{Part, SEVERAL, changes_side};
use super::stretch::{Placed, StopAt};
use std::ops::Range;

/// The place of a part of a cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PartAt {
    /// Indices of the stretch, and of the part in it.
    pub(crate) stretch: usize,
    pub(crate) part: usize,
    /// Byte of the text from which the stretch's places count.
    pub(crate) offset: usize,
}

/// Consecutive moves, put together from the parts of the stretches that they run through.
#[derive(Clone, Debug)]
pub(crate) struct JoinedCut {
    pub(crate) parts: Vec<PartAt>,
    /// All of them as one.
    pub(crate) sum: Box<Part>,
    /// The line that begins it, and the one that ends it, in the text.
    pub(crate) range: Range<usize>,
    pub(crate) last_range: Range<usize>,
    /// The stop that ended it, where it is a single one.
    stop: Option<StopAt>,
    stops: usize,
    /// Moves before the stop at its tab.
    pub(crate) before_tab: Option<u32>,
    /// The last stretch on whose lines it depends.
    pub(crate) reach: usize,
    /// Where the wire was first sent to the other side, and the line that did so.
    pub(crate) flip: Option<(Place, Range<usize>)>,
}

impl JoinedCut {
    pub(crate) fn of(placed: &Placed<'_>, stretch: usize, part: usize) -> Option<JoinedCut> {
        let (offset, its) = (placed.offset, placed.stretch.part_at(part)?);
        let place = |(start, end): (u32, u32)| offset + start as usize..offset + end as usize;
        let mut cut = JoinedCut {
            parts: vec![PartAt {
                stretch,
                part,
                offset,
            }],
            flip: its.flip.map(|(at, line)| (at, place(line))),
            range: place(its.range),
            last_range: place(its.last_range),
            sum: Box::new(its),
            stop: None,
            stops: 0,
            before_tab: None,
            reach: stretch,
        };
        cut.stopped(its.stop, stretch);
        Some(cut)
    }

    pub(crate) fn stopped(&mut self, stop: Option<u32>, stretch: usize) {
        match stop {
            None => {}
            Some(SEVERAL) => self.stops += 2,
            Some(at) => {
                self.stops += 1;
                self.stop = Some((stretch, at));
            }
        }
    }

    /// This cut followed by the next, which goes on from its end: behind the stop at its tab, if there was one.
    pub(crate) fn append(&mut self, next: JoinedCut) {
        if self.stops > 0 {
            self.before_tab.get_or_insert(self.sum.moves);
        }
        let flips = self.stops == 0 && changes_side(&self.sum.last[1], &next.sum.first[0]);
        let flip = flips.then(|| (next.sum.start(), next.range.clone()));
        self.flip = self.flip.take().or(flip).or(next.flip);
        self.sum.append(&next.sum);
        self.last_range = next.last_range;
        self.parts.extend(next.parts);
        self.reach = self.reach.max(next.reach);
        (self.stop, self.stops) = (next.stop, next.stops);
    }

    pub(crate) fn single_stop(&self) -> Option<StopAt> {
        self.stop.filter(|_| self.stops == 1)
    }

    /// Indices of its stretches and of its parts in them.
    pub(crate) fn places(&self) -> Vec<(usize, usize)> {
        let place = |at: &PartAt| (at.stretch, at.part);
        self.parts.iter().map(place).collect()
    }

    /// Its first stretch, and its part in there.
    pub(crate) fn begin(&self) -> (usize, usize) {
        self.parts
            .first()
            .map_or((0, 0), |at| (at.stretch, at.part))
    }

    /// The stretch that holds all of it, and its part in it.
    pub(crate) fn only_place(&self) -> Option<(usize, usize)> {
        let [at] = self.parts[..] else { return None };
        Some((at.stretch, at.part))
    }
}
