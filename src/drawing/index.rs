//! A contour cut into runs of consecutive segments, each with its box, its share of the area and its tight arcs. An
//! edit touches one run or two, however long the contour is: where segments come or go, the run has more or fewer.

use super::{Contour, ContourSegment, Drawing};
use crate::geometry::{Bounds, Point};
use std::iter::once;
use std::ops::Range;

/// Segments in one run. Few enough to look through in a microsecond, many enough that a million segments make only some
/// thousand boxes.
pub(crate) const RUN: usize = 64;

/// Segments that a run has at the most, after some have come into it.
const LONGEST: usize = 4 * RUN;

/// An area below this share of the square about a contour has no sign: it does not tell the direction of the contour.
const ROUNDING: f64 = 1e-12;

#[derive(Clone, Debug)]
struct Run {
    bounds: Bounds,
    twice_area: f64,
}

impl Run {
    const EMPTY: Run = Run {
        bounds: Bounds::EMPTY,
        twice_area: 0.0,
    };
}

/// Boxes, area and tight arcs of one contour.
#[derive(Clone, Debug)]
pub(crate) struct ContourIndex {
    /// Most contours have only this run; without a segment it is empty.
    first: Run,
    /// The runs after it.
    others: Vec<Run>,
    /// Indices within the contour of arcs with a radius below a threshold, rising.
    tight: Vec<u32>,
    segments: u32,
    /// The first segment of each run; none where all but the last have [`RUN`] segments, as afresh.
    starts: Option<Box<[u32]>>,
    /// The area is summed relative to a point near the contour, so that far-off coordinates cost no digits.
    origin: Point,
}

impl ContourIndex {
    /// Reads every segment once; arcs with a radius below `threshold` count as tight.
    pub(crate) fn new(drawing: &Drawing, contour: &Contour, threshold: f64) -> ContourIndex {
        let segments = contour.len();
        let origin = contour
            .segment(drawing, 0)
            .map_or_else(Point::origin, |first| first.geometry.start());
        let mut index = ContourIndex {
            first: Run::EMPTY,
            others: Vec::with_capacity(segments.div_ceil(RUN).saturating_sub(1)),
            tight: Vec::new(),
            segments: segments as u32,
            starts: None,
            origin,
        };
        for run in 0..index.run_count() {
            let mut tight = Vec::new();
            let segments = contour.segments_in(drawing, index.range_of(run));
            let looked = index.look(run, segments, threshold, &mut tight);
            match run {
                0 => index.first = looked,
                _ => index.others.push(looked),
            }
            index.tight.append(&mut tight);
        }
        index
    }

    /// The same for a contour of one run whose segments are at hand.
    pub(crate) fn of_one_run(segments: &[ContourSegment], threshold: f64) -> ContourIndex {
        let mut index = ContourIndex {
            first: Run::EMPTY,
            others: Vec::new(),
            tight: Vec::new(),
            segments: segments.len() as u32,
            starts: None,
            origin: segments
                .first()
                .map_or_else(Point::origin, |first| first.geometry.start()),
        };
        let mut tight = Vec::new();
        index.first = index.look(0, segments.iter().copied(), threshold, &mut tight);
        index.tight = tight;
        index
    }

    /// Reads some runs again, whose segments are as many as they were.
    pub(crate) fn look_again(
        &mut self,
        drawing: &Drawing,
        contour: &Contour,
        threshold: f64,
        runs: Range<usize>,
    ) {
        for run in runs {
            let mut tight = Vec::new();
            let range = self.range_of(run);
            let segments = contour.segments_in(drawing, range.clone());
            let looked = self.look(run, segments, threshold, &mut tight);
            match run.checked_sub(1) {
                None => self.first = looked,
                Some(behind) => self.others[behind] = looked,
            }
            let old = self.tight_before(range.start)..self.tight_before(range.end);
            self.tight.splice(old, tight);
        }
    }

    /// Records that some segments, those of `gone`, have been replaced by so many others: `come`. Nothing but the runs in which
    /// they lie changes, but later segments have other indices. False, with nothing done, where these runs would become too
    /// long, or have none left, or are more than two: the contour is to be read again.
    pub(crate) fn splice(
        &mut self,
        drawing: &Drawing,
        contour: &Contour,
        threshold: f64,
        (gone, come): (Range<usize>, usize),
    ) -> bool {
        if gone.is_empty() || gone.end > self.len() {
            return false;
        }
        let runs = self.runs_over(gone.clone());
        let moved = |start: usize| start + come - gone.len();
        let new_end = gone.start + come;
        let mut starts: Vec<u32> = (0..self.run_count())
            .map(|run| self.range_of(run).start)
            .map(|start| match start {
                _ if start <= gone.start => start as u32,
                _ if start < gone.end => start.min(new_end) as u32,
                _ => moved(start) as u32,
            })
            .collect();
        let end = moved(self.len());
        let length = |run: usize| {
            let behind = starts.get(run + 1).map_or(end, |&start| start as usize);
            behind.checked_sub(starts[run] as usize)
        };
        let fits = |run: usize| length(run).is_some_and(|it| (1..=LONGEST).contains(&it));
        if runs.len() > 2 || end != contour.len() || !runs.clone().all(fits) {
            return false;
        }
        let old = self.tight_before(gone.start)..self.tight_before(gone.end);
        self.tight.drain(old.clone());
        for tight in self.tight.iter_mut().skip(old.start) {
            *tight = moved(*tight as usize) as u32;
        }
        self.segments = end as u32;
        starts.shrink_to_fit();
        self.starts = Some(starts.into());
        self.look_again(drawing, contour, threshold, runs);
        true
    }

    /// The number of tight arcs before the segment at `index`.
    fn tight_before(&self, index: usize) -> usize {
        self.tight
            .partition_point(|&tight| (tight as usize) < index)
    }

    pub(crate) fn len(&self) -> usize {
        self.segments as usize
    }

    fn run(&self, run: usize) -> Option<&Run> {
        match run.checked_sub(1) {
            None => Some(&self.first),
            Some(behind) => self.others.get(behind),
        }
    }

    fn look(
        &self,
        run: usize,
        segments: impl Iterator<Item = ContourSegment>,
        threshold: f64,
        tight: &mut Vec<u32>,
    ) -> Run {
        let mut found = Run::EMPTY;
        for (index, segment) in self.range_of(run).zip(segments) {
            found.bounds.merge(&segment.geometry.bounds());
            found.twice_area += segment.geometry.twice_area(self.origin);
            if segment
                .geometry
                .as_arc()
                .is_some_and(|arc| arc.radius < threshold)
            {
                tight.push(index as u32);
            }
        }
        found
    }

    /// Segments of a run.
    pub(crate) fn range_of(&self, run: usize) -> Range<usize> {
        match &self.starts {
            None => run * RUN..((run + 1) * RUN).min(self.len()),
            Some(starts) => {
                let start = |run| starts.get(run).map_or(self.len(), |&start| start as usize);
                start(run)..start(run + 1)
            }
        }
    }

    /// The run with a segment.
    pub(crate) fn run_of(&self, segment: usize) -> usize {
        match &self.starts {
            None => segment / RUN,
            Some(starts) => {
                let begun = starts.partition_point(|&start| start as usize <= segment);
                begun.saturating_sub(1)
            }
        }
    }

    /// The runs with some segments.
    pub(crate) fn runs_over(&self, segments: Range<usize>) -> Range<usize> {
        let first = self.run_of(segments.start);
        let behind = match segments.end.checked_sub(1) {
            Some(last) if !segments.is_empty() => self.run_of(last) + 1,
            _ => first,
        };
        first..behind.min(self.run_count()).max(first)
    }

    /// Twice the signed area, positive counter-clockwise; meaningful for a closed contour. Zero for a contour that
    /// retraces itself, whose area is only rounding.
    pub(crate) fn twice_area(&self) -> f64 {
        let others = self.others.iter().map(|run| run.twice_area);
        let twice_area = others.fold(self.first.twice_area, |sum, area| sum + area);
        let bounds = self.bounds();
        let least = ROUNDING * (bounds.width() + bounds.height()).powi(2);
        if twice_area.abs() > least {
            twice_area
        } else {
            0.0
        }
    }

    /// Number of runs.
    pub(crate) fn run_count(&self) -> usize {
        match &self.starts {
            None => self.len().div_ceil(RUN),
            Some(starts) => starts.len(),
        }
    }

    /// The box of a run; empty past the last one.
    pub(crate) fn bounds_of_run(&self, run: usize) -> Bounds {
        self.run(run).map_or(Bounds::EMPTY, |run| run.bounds)
    }

    pub(crate) fn bounds(&self) -> Bounds {
        self.bounds_about(0..self.len())
    }

    /// A box that holds the segments of `range`, and some beside them.
    pub(crate) fn bounds_about(&self, range: Range<usize>) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        let runs = self.runs_over(range);
        runs.filter_map(|run| self.run(run))
            .for_each(|run| bounds.merge(&run.bounds));
        bounds
    }

    /// Indices of the tight arcs, rising.
    pub(crate) fn tight(&self) -> impl Iterator<Item = usize> + '_ {
        self.tight.iter().map(|&index| index as usize)
    }

    /// Ranges of segments of which some may come near `area`.
    pub(crate) fn near<'a>(&'a self, area: &'a Bounds) -> impl Iterator<Item = Range<usize>> + 'a {
        let runs = once(&self.first).chain(&self.others).enumerate();
        runs.filter(|(_, run)| run.bounds.touches(area))
            .map(|(run, _)| self.range_of(run))
    }
}
