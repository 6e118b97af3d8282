//! Closed contours that run beside each other everywhere: the same outline, drawn more than once.

use super::{Contour, Drawing};
use crate::geometry::{Bounds, Grid, Point, Segment};

/// Pairs of closed contours, by their places and the earlier one first, that lie within `tolerance` of each other everywhere:
/// each of those that lie in one place with the first of them.
///
/// Costs the segments of those whose boxes are the same within that.
pub(crate) fn twins(
    drawing: &Drawing,
    contours: &[(&Contour, Bounds)],
    tolerance: f64,
) -> Vec<[usize; 2]> {
    // The lower left corners of two that are twins lie within the tolerance of each other.
    let mut corners = Grid::default();
    let mut found = Vec::new();
    for (place, (contour, bounds)) in contours.iter().enumerate() {
        if !contour.closed || bounds.is_empty() {
            continue;
        }
        let corner = Bounds::of_points(&[bounds.min]);
        let mut near = Vec::new();
        corners.near(&corner.grown(tolerance), |earlier, _| near.push(earlier));
        let is_twin = |&earlier: &usize| {
            contours.get(earlier).is_some_and(|(other, theirs)| {
                are_twins(drawing, (other, theirs), (contour, bounds), tolerance)
            })
        };
        match near.into_iter().filter(is_twin).min() {
            Some(first) => found.push([first, place]),
            None => corners.insert(place, corner),
        }
    }
    found
}

/// True for two closed contours that lie within `tolerance` of each other everywhere; each is given with its box.
pub(crate) fn are_twins(
    drawing: &Drawing,
    (one, bounds): (&Contour, &Bounds),
    (other, theirs): (&Contour, &Bounds),
    tolerance: f64,
) -> bool {
    let edges = |of: &Bounds| [of.min.x, of.min.y, of.max.x, of.max.y];
    let mut apart = edges(bounds).into_iter().zip(edges(theirs));
    if !one.closed || !other.closed || apart.any(|(own, met)| (own - met).abs() > tolerance) {
        return false;
    }
    let [own, met] = [one, other].map(|contour| {
        let segments = contour.segments(drawing);
        segments.map(|segment| segment.geometry).collect::<Vec<_>>()
    });
    lies_on(&own, &met, tolerance) && lies_on(&met, &own, tolerance)
}

/// True where the ends of segments, and three points between them, lie within `tolerance` of others.
fn lies_on(segments: &[Segment], others: &[Segment], tolerance: f64) -> bool {
    let mut grid = Grid::default();
    for (place, other) in others.iter().enumerate() {
        grid.insert(place, other.bounds());
    }
    let is_on = |point: Point| {
        let mut is_on = false;
        grid.near(&Bounds::of_disc(point, tolerance), |place, _| {
            let other = others.get(place);
            is_on |= other.is_some_and(|other| other.distance_to(point) <= tolerance);
        });
        is_on
    };
    let mut points = segments
        .iter()
        .flat_map(|segment| [0.0, 0.25, 0.5, 0.75].map(|share| segment.point_at(share)));
    !segments.is_empty() && points.all(is_on)
}

/// The earliest of those that each is a twin of, itself where it is of none; `pairs` as [`twins`] finds them.
pub(super) fn firsts(count: usize, pairs: &[[usize; 2]]) -> Vec<usize> {
    let mut firsts: Vec<usize> = (0..count).collect();
    for &[first, later] in pairs {
        if let Some(of_later) = firsts.get_mut(later) {
            *of_later = first;
        }
    }
    firsts
}
