//! Which closed contours lie within which.

use super::twins::{firsts, twins};
use super::{Contour, Drawing};
use crate::geometry::{Bounds, Grid, Point, Segment, turn};
use std::f64::consts::{PI, TAU};

/// A point from which a line looks nearly as long as a half turn, radians, lies on it: which side it is on, rounding decides.
const ON_A_WALL: f64 = 1e-3;

/// For each closed contour, the number of others that hold it: 0 for the outermost. Open contours have depth 0 and hold
/// nothing. Each contour is given with its box.
///
/// One that lies within `tolerance` of another everywhere is the same outline drawn again: the two count once, and have
/// one depth. A contour lies within another when the middle of its first segment does, or of the next one that does not lie on a straight
/// wall of the other. Costs the number of boxes about each first point, and of the segments of their contours.
pub(crate) fn nesting_depths(
    drawing: &Drawing,
    contours: &[(&Contour, Bounds)],
    tolerance: f64,
) -> Vec<usize> {
    let boxes: Vec<Bounds> = contours
        .iter()
        .map(|(contour, bounds)| match contour.closed {
            true => *bounds,
            false => Bounds::EMPTY,
        })
        .collect();
    let mut grid = Grid::default();
    boxes
        .iter()
        .enumerate()
        .for_each(|(position, &bounds)| grid.insert(position, bounds));
    let firsts = firsts(contours.len(), &twins(drawing, contours, tolerance));
    let depth = |inner: usize| {
        let (contour, own) = (contours[inner].0, &boxes[inner]);
        let Some(first) = contour.segment(drawing, 0).filter(|_| contour.closed) else {
            return 0;
        };
        let point = first.geometry.point_at(0.5);
        let mut depth = 0;
        grid.near(&Bounds::of_points(&[point]), |outer, _| {
            let theirs = &boxes[outer];
            let holds_box = theirs.merged(own) == *theirs && theirs != own;
            let is_drawn_again = firsts[outer] != outer || outer == firsts[inner];
            depth += usize::from(
                holds_box && !is_drawn_again && lies_within(drawing, contour, contours[outer].0),
            );
        });
        depth
    };
    let depths: Vec<usize> = (0..contours.len()).map(depth).collect();
    firsts.into_iter().map(|first| depths[first]).collect()
}

/// Whether a contour lies within a closed one that it does not cross.
pub(crate) fn lies_within(drawing: &Drawing, inner: &Contour, outer: &Contour) -> bool {
    let is_on_wall = |point: &Point| {
        let mut walls = outer.segments(drawing).map(|wall| wall.geometry);
        walls.any(|wall| match wall {
            Segment::Line(wall) => {
                turn(wall.start - point, wall.end - point).abs() > PI - ON_A_WALL
            }
            Segment::Arc(_) => false,
        })
    };
    let mut middles = inner.segments(drawing).map(|it| it.geometry.point_at(0.5));
    let Some(first) = middles.next() else {
        return false;
    };
    let clear = std::iter::once(first)
        .chain(middles)
        .find(|it| !is_on_wall(it));
    winding(drawing, outer, clear.unwrap_or(first)) != 0
}

/// The winding number of a closed contour about `point`, positive counter-clockwise; undefined on the contour itself.
pub(crate) fn winding(drawing: &Drawing, contour: &Contour, point: Point) -> i64 {
    winding_of(
        contour.segments(drawing).map(|segment| segment.geometry),
        point,
    )
}

/// The same for closed segments.
pub(crate) fn winding_of(segments: impl Iterator<Item = Segment>, point: Point) -> i64 {
    let (angle, caps) = turns_about(segments, point);
    (angle / TAU).round() as i64 + caps
}

/// The angle that the chords of segments sweep about `point`, and the turns that their arcs add.
pub(crate) fn turns_about(segments: impl Iterator<Item = Segment>, point: Point) -> (f64, i64) {
    let mut angle = 0.0;
    let mut caps = 0;
    for segment in segments {
        let (start, end) = (segment.start(), segment.end());
        let turned = turn(start - point, end - point);
        angle += turned;
        if let Segment::Arc(arc) = segment {
            // Between chord and arc the arc goes round the point and the chord does not. A point on the chord lies on the side to which it
            // has been turned.
            let beyond_chord = start == end || turned * arc.sweep < 0.0;
            if beyond_chord && (point - arc.center).norm() < arc.radius {
                caps += arc.sweep.signum() as i64;
            }
        }
    }
    (angle, caps)
}
