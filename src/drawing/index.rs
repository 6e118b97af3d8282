//! A contour cut into runs of consecutive segments, each with what is asked of it often: its box, its share of the
//! area, its tight arcs. An edit that keeps the count touches one run, however long the contour is.

use super::{Contour, Drawing};
use crate::geometry::{Bounds, Point};
use std::ops::Range;

/// Segments in one run. Short enough that one run is looked through in a microsecond, long enough that a million
/// segments make only a few thousand boxes.
const RUN: usize = 256;

#[derive(Clone, Debug)]
struct Run {
    bounds: Bounds,
    twice_area: f64,
    /// Indices within the contour of arcs with a radius below the threshold.
    tight: Vec<u32>,
}

/// Boxes, area and tight arcs of one contour.
#[derive(Clone, Debug)]
pub struct ContourIndex {
    runs: Vec<Run>,
    segments: usize,
    /// The area is summed as seen from here: a point near the contour, so that coordinates far out cost no digits.
    origin: Point,
    threshold: f64,
}

impl ContourIndex {
    /// Looks at every segment once; arcs with a radius below `threshold` are remembered as tight.
    pub fn new(drawing: &Drawing, contour: &Contour, threshold: f64) -> ContourIndex {
        let segments = contour.len();
        let origin = contour.segment(drawing, 0).map_or_else(Point::origin, |first| first.geometry.start());
        let mut index = ContourIndex { runs: Vec::with_capacity(segments.div_ceil(RUN)), segments, origin, threshold };
        index.extend(drawing, contour);
        index
    }

    /// Looks again at the segments of `changed`; everything behind its start when the count has changed too.
    pub fn update(&mut self, drawing: &Drawing, contour: &Contour, changed: Range<usize>) {
        let first = changed.start / RUN;
        if contour.len() != self.segments {
            self.runs.truncate(first);
            self.segments = contour.len();
            self.extend(drawing, contour);
            return;
        }
        for run in first..changed.end.div_ceil(RUN).min(self.runs.len()) {
            self.runs[run] = self.look(drawing, contour, run);
        }
    }

    pub fn len(&self) -> usize {
        self.segments
    }

    pub fn is_empty(&self) -> bool {
        self.segments == 0
    }

    fn extend(&mut self, drawing: &Drawing, contour: &Contour) {
        for run in self.runs.len()..self.segments.div_ceil(RUN) {
            let looked = self.look(drawing, contour, run);
            self.runs.push(looked);
        }
    }

    fn look(&self, drawing: &Drawing, contour: &Contour, run: usize) -> Run {
        let mut found = Run { bounds: Bounds::EMPTY, twice_area: 0.0, tight: Vec::new() };
        for index in self.range_of(run) {
            let Some(segment) = contour.segment(drawing, index) else { continue };
            found.bounds.merge(&segment.geometry.bounds());
            found.twice_area += segment.geometry.twice_area(self.origin);
            if segment.geometry.as_arc().is_some_and(|arc| arc.radius < self.threshold) {
                found.tight.push(index as u32);
            }
        }
        found
    }

    fn range_of(&self, run: usize) -> Range<usize> {
        run * RUN..((run + 1) * RUN).min(self.segments)
    }

    /// Twice the signed area, positive counter-clockwise; meaningful for a closed contour.
    pub fn twice_area(&self) -> f64 {
        self.runs.iter().map(|run| run.twice_area).sum()
    }

    pub fn bounds(&self) -> Bounds {
        self.bounds_about(0..self.segments)
    }

    /// A box that holds the segments of `range`, and some beside them.
    pub fn bounds_about(&self, range: Range<usize>) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        let runs = range.start / RUN..range.end.div_ceil(RUN).min(self.runs.len());
        self.runs.get(runs).unwrap_or_default().iter().for_each(|run| bounds.merge(&run.bounds));
        bounds
    }

    /// Indices of the tight arcs, rising.
    pub fn tight(&self) -> impl Iterator<Item = usize> + '_ {
        self.runs.iter().flat_map(|run| run.tight.iter().map(|&index| index as usize))
    }

    /// Ranges of segments of which some may come near `area`.
    pub fn near<'a>(&'a self, area: &'a Bounds) -> impl Iterator<Item = Range<usize>> + 'a {
        self.runs.iter().enumerate().filter(|(_, run)| run.bounds.touches(area)).map(|(run, _)| self.range_of(run))
    }
}
