//! Which closed contours lie within which.

use super::{Contour, ContourIndex, Drawing};
use crate::geometry::{Bounds, Point, Segment, cross, turn};
use std::f64::consts::TAU;

/// For each closed contour, how many of the others hold it: 0 for the outermost. Open contours have depth 0 and hold nothing.
///
/// A contour lies within another when its first point does; where the two touch in just that point either answer may come.
/// Costs a box comparison for each pair whose boxes overlap in x, and the segments of the outer one where the boxes nest.
pub fn nesting_depths(drawing: &Drawing, contours: &[(&Contour, &ContourIndex)]) -> Vec<usize> {
    let boxes: Vec<Bounds> = contours.iter().map(|(_, index)| index.bounds()).collect();
    let mut by_left: Vec<usize> = (0..contours.len()).filter(|&i| contours[i].0.closed && !boxes[i].is_empty()).collect();
    by_left.sort_by(|&a, &b| boxes[a].min.x.total_cmp(&boxes[b].min.x));
    let mut depths = vec![0; contours.len()];
    for (rank, &inner) in by_left.iter().enumerate() {
        let Some(first) = contours[inner].0.segment(drawing, 0) else { continue };
        let point = first.geometry.point_at(0.5);
        let holds = |&&outer: &&usize| {
            outer != inner
                && boxes[outer].max.x >= boxes[inner].max.x
                && boxes[outer].min.y <= boxes[inner].min.y
                && boxes[outer].max.y >= boxes[inner].max.y
                && boxes[outer] != boxes[inner]
                && winding(drawing, contours[outer].0, point) != 0
        };
        let reach = by_left.partition_point(|&other| boxes[other].min.x <= boxes[inner].min.x).max(rank);
        depths[inner] = by_left[..reach].iter().filter(holds).count();
    }
    depths
}

/// How often a closed contour goes round `point`, positive counter-clockwise; undefined on the contour itself.
pub fn winding(drawing: &Drawing, contour: &Contour, point: Point) -> i64 {
    let mut angle = 0.0;
    let mut caps = 0;
    for segment in contour.segments(drawing) {
        let (start, end) = (segment.geometry.start(), segment.geometry.end());
        angle += turn(start - point, end - point);
        if let Segment::Arc(arc) = segment.geometry {
            // Between chord and arc the arc goes round the point and the chord does not.
            let beyond_chord = if start == end { true } else { cross(end - start, point - start) * arc.sweep < 0.0 };
            if beyond_chord && (point - arc.center).norm() < arc.radius {
                caps += arc.sweep.signum() as i64;
            }
        }
    }
    (angle / TAU).round() as i64 + caps
}
