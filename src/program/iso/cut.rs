//! A cut: consecutive moves of an ISO program without a rapid or a stop between, put together from the parts of its
//! stretches.

use super::moves::{Place, added, apart};
use super::part::{Part, SEVERAL, changes_side};
use super::stretch::{StopAt, Stretch};
use crate::program::by_chunk::{Begun, ByChunk};
use crate::program::contours::PartAt;

/// Bytes of a stretch, by its index.
pub(crate) type BytesAt = (usize, (u32, u32));

/// Consecutive moves, put together from the parts of the stretches that they run through.
#[derive(Clone, Debug)]
pub(crate) struct JoinedCut {
    pub(crate) parts: Vec<PartAt>,
    /// All of them as one.
    pub(crate) sum: Box<Part>,
    /// The line that begins it, and the one that ends it.
    pub(crate) first_line: BytesAt,
    pub(crate) last_line: BytesAt,
    /// The stop that ended it, where it is a single one.
    stop: Option<StopAt>,
    stops: usize,
    /// Moves before the stop at its tab.
    pub(crate) before_tab: Option<u32>,
    /// Where the wire was first sent to the other side, and the line that did so.
    pub(crate) flip: Option<(Place, BytesAt)>,
    /// All that is said of it depends on it alone, and is kept.
    pub(crate) is_told: bool,
    /// How far its first stretch had been moved when it was put together.
    moved: Place,
}

impl Begun for JoinedCut {
    /// How many there are of which not all that is said is kept.
    type Sum = usize;

    fn begin(&self) -> PartAt {
        self.parts.first().copied().unwrap_or_default()
    }

    fn renumber(&mut self, moved: &dyn Fn(usize) -> usize) {
        let parts = self.parts.iter_mut().map(|(stretch, _)| stretch);
        let lines = [&mut self.first_line.0, &mut self.last_line.0];
        let stop = self.stop.as_mut().map(|(stretch, _)| stretch);
        let flip = self.flip.as_mut().map(|(_, (stretch, _))| stretch);
        let all = parts.chain(lines).chain(stop).chain(flip);
        all.for_each(|stretch| *stretch = moved(*stretch));
    }

    fn sum(list: &[JoinedCut]) -> usize {
        list.iter().filter(|cut| !cut.is_told).count()
    }
}

impl ByChunk<JoinedCut> {
    /// Those of which not all that is said is kept.
    pub(crate) fn untold(&self) -> impl Iterator<Item = &JoinedCut> {
        let chunks = self.sums().enumerate();
        let with_some = chunks.filter(|(_, untold)| **untold > 0);
        let all = with_some.flat_map(|(chunk, _)| self.of(chunk));
        all.filter(|cut| !cut.is_told)
    }
}

impl JoinedCut {
    pub(crate) fn of(of: &Stretch, stretch: usize, part: usize) -> Option<JoinedCut> {
        let its = of.part_at(part)?;
        let mut cut = JoinedCut {
            parts: vec![(stretch, part)],
            flip: its.flip.map(|(at, line)| (at, (stretch, line))),
            first_line: (stretch, its.range),
            last_line: (stretch, its.last_range),
            sum: Box::new(its),
            stop: None,
            stops: 0,
            before_tab: None,
            is_told: false,
            moved: of.moved,
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
                self.stop = Some((stretch, at as usize));
            }
        }
    }

    /// This cut followed by the next, which goes on from its end: after the stop at its tab, if there was one.
    pub(crate) fn append(&mut self, next: JoinedCut) {
        if self.stops > 0 {
            self.before_tab.get_or_insert(self.sum.moves);
        }
        let flips = self.stops == 0 && changes_side(&self.sum.last[1], &next.sum.first[0]);
        let flip = flips.then(|| (next.sum.start(), next.first_line));
        self.flip = self.flip.take().or(flip).or(next.flip);
        self.sum.append(&next.sum);
        self.last_line = next.last_line;
        self.parts.extend(next.parts);
        (self.stop, self.stops) = (next.stop, next.stops);
    }

    /// The stretch that holds all of it, and its part in it.
    pub(crate) fn only_place(&self) -> Option<PartAt> {
        let [at] = self.parts[..] else { return None };
        Some(at)
    }

    /// Whether its first stretch has been moved since.
    pub(crate) fn is_elsewhere(&self, moved: Place) -> bool {
        moved != self.moved
    }

    /// Takes it to where its first stretch has been moved.
    pub(crate) fn follow(&mut self, moved: Place) {
        let by = apart(moved, self.moved);
        if by != [0, 0] {
            self.moved = moved;
            self.sum.shift(by);
            self.flip
                .iter_mut()
                .for_each(|(at, _)| *at = added(*at, by));
        }
    }

    pub(crate) fn single_stop(&self) -> Option<StopAt> {
        self.stop.filter(|_| self.stops == 1)
    }
}
