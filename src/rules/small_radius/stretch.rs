//! Arcs that were fitted to a curve: their radii are those of the fit. What counts is how much of the curve the wire leaves.

use super::Travel;
use crate::geometry::{Point, Segment, left_normal};
use crate::rules::Limits;
use std::ops::RangeInclusive;

/// Segments on either side of a stretch that may hold the wire off.
const HOLDING: usize = 64;

/// Places that are tried along a segment, and steps to find the place between two of them.
const PLACES: usize = 8;
const STEPS: usize = 40;

/// How far a curve is at most from a wire with the correction that passes a stretch of it, at `positions`, which is tighter. `None`
/// where it does not get past.
pub(crate) fn depth(
    travel: &Travel,
    positions: RangeInclusive<isize>,
    limits: &Limits,
) -> Option<f64> {
    let (first, last) = positions.into_inner();
    let beside = usize::try_from(travel.len() as isize - (last - first + 1)).ok()?;
    let most = HOLDING.min(match travel.contour.closed {
        true => beside / 2,
        false => beside,
    }) as isize;
    let segment = |position: isize| Some(travel.segment(position)?.geometry);
    let behind: Vec<Segment> = (last + 1..=last + most).map_while(segment).collect();
    let correction = limits.correction;
    let is_clear = |center: &Point| {
        let least = correction - limits.tolerances.clearance;
        behind.iter().all(|wall| wall.distance_to(*center) >= least)
    };
    // Back along the curve until the wire beside it comes off what follows.
    let before = (1..=most).map_while(|steps| segment(first - steps));
    let mut held: Option<(Segment, f64)> = None;
    for wall in before {
        let center =
            |share: f64| wall.point_at(share) + left_normal(wall.tangent_at(share)) * correction;
        for place in 0..=PLACES {
            let share = 1.0 - place as f64 / PLACES as f64;
            if !is_clear(&center(share)) {
                held = Some((wall, share));
                continue;
            }
            let (mut clear, mut not) = match held {
                Some((of, held)) if of == wall => (share, held),
                _ => (share, share),
            };
            for _ in 0..STEPS {
                let middle = clear.midpoint(not);
                match is_clear(&center(middle)) {
                    true => clear = middle,
                    false => not = middle,
                }
            }
            let center = center(clear);
            let away = (first..=last).filter_map(segment).flat_map(|own| {
                [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| (own.point_at(share) - center).norm())
            });
            return Some(away.fold(0.0, f64::max) - correction);
        }
    }
    None
}
