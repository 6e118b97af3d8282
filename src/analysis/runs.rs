//! The runs of one contour by place: of a long one that many lines ask about, they lie in boxes about boxes.

use crate::drawing::{Contour, ContourIndex, Drawing, turns_about};
use crate::geometry::{Bounds, Boxes, Point, Segment, cross, turn};
use std::f64::consts::TAU;
use std::ops::Range;

/// From this many runs on it is worth while to sort them.
pub(super) const MANY_RUNS: usize = 8;

/// The boxes of the runs of a contour, boxes about pairs of them, and so on.
pub(super) fn boxes_of(index: &ContourIndex) -> Boxes {
    Boxes::of((0..index.run_count()).map(|run| index.bounds_of_run(run)))
}

/// True for a contour of lines that lie in a strip of half the join tolerance, there and back: what it encloses lies on it.
pub(super) fn is_flat(
    drawing: &Drawing,
    contour: &Contour,
    index: &ContourIndex,
    join: f64,
) -> bool {
    let bounds = index.bounds();
    let strip = join / 2.0;
    // Most contours enclose far more than any strip of their length.
    if index.twice_area().abs() > 2.0 * strip * (bounds.width() + bounds.height()) {
        return false;
    }
    let ends = || {
        let segments = contour.segments(drawing).map(|it| it.geometry);
        segments.flat_map(|segment| [segment.start(), segment.end()])
    };
    let Some(first) = ends().next() else {
        return false;
    };
    let away = |point: &Point| (point - first).norm_squared();
    let far = ends().max_by(|one, other| away(one).total_cmp(&away(other)));
    let along = far.unwrap_or(first) - first;
    let length = along.norm();
    let (mut left, mut right) = (0.0_f64, 0.0_f64);
    let is_within = |point: Point| {
        let beside = match length > 0.0 {
            true => cross(along, point - first) / length,
            false => 0.0,
        };
        (left, right) = (left.max(beside), right.min(beside));
        left - right <= strip
    };
    let are_lines = || {
        let mut segments = contour.segments(drawing);
        segments.all(|it| matches!(it.geometry, Segment::Line(_)))
    };
    ends().all(is_within) && are_lines()
}

/// A contour with its runs, sorted by place or not.
pub(super) struct Runs<'a> {
    pub(super) drawing: &'a Drawing,
    pub(super) contour: &'a Contour,
    pub(super) index: &'a ContourIndex,
    pub(super) sorted: Option<&'a Boxes>,
}

impl Runs<'_> {
    /// Ranges of segments of which some may come near `area`, in their order.
    pub(super) fn near(&self, area: &Bounds) -> Vec<Range<usize>> {
        let Some(boxes) = self.sorted else {
            return self.index.near(area).collect();
        };
        let mut near = Vec::new();
        boxes.touching(area, usize::MAX, &mut |run| {
            near.push(self.index.range_of(run))
        });
        near
    }

    /// Whether the contour comes within a distance of a point.
    pub(super) fn pass_by(&self, point: Point, distance: f64) -> bool {
        let about = Bounds::of_disc(point, distance);
        self.near(&about).into_iter().any(|range| {
            let mut segments = self.contour.segments_in(self.drawing, range);
            segments.any(|segment| segment.geometry.distance_to(point) <= distance)
        })
    }

    /// Whether the contour, which is closed, encloses a point. Runs about which a box does not hold the point are replaced by their chord.
    pub(super) fn enclose(&self, point: Point) -> bool {
        let here = Bounds::of_points(&[point]);
        let (mut angle, mut caps) = (0.0, 0);
        let mut see = |runs: Range<usize>, is_about: bool| {
            let range = self.index.range_of(runs.start).start
                ..self.index.range_of(runs.end.saturating_sub(1)).end;
            if is_about {
                let segments = self.contour.segments_in(self.drawing, range);
                let (turned, arcs) = turns_about(segments.map(|segment| segment.geometry), point);
                angle += turned;
                caps += arcs;
            } else if let Some((first, last)) = self.contour.segment(self.drawing, range.start).zip(
                self.contour
                    .segment(self.drawing, range.end.saturating_sub(1)),
            ) {
                angle += turn(first.geometry.start() - point, last.geometry.end() - point);
            }
        };
        match self.sorted {
            Some(boxes) => _ = boxes.parted(&here, &mut see),
            None if !self.index.bounds().touches(&here) => {}
            None => (0..self.index.run_count()).for_each(|run| {
                see(run..run + 1, self.index.bounds_of_run(run).touches(&here));
            }),
        }
        (angle / TAU).round() as i64 + caps != 0
    }
}
