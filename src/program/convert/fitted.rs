//! The pieces of a step between the nodes of a cut: arcs whose centre is rounded are fitted to their ends.

use crate::geometry::{Arc, Point, Segment, Vector};
use crate::program::path::{MOST_BY_BULGE, Step};
use std::f64::consts::PI;

/// The distances of an arc's ends from its centre may differ by this much, µm: that is the rounding of its numbers. What
/// differs by more, up to what `arc-off-radius` reports, is fitted.
pub(super) const ROUND: f64 = 1.0;

/// The segment of a step moved to the nodes that it runs between; two where one arc cannot be fitted.
pub(super) fn between(ideal: &Segment, step: &Step, from: Point, to: Point) -> Vec<Segment> {
    let Segment::Arc(arc) = ideal else {
        return vec![Segment::line(from, to)];
    };
    let center = arc.center + (from - step.start);
    if arc.is_full_turn() {
        return vec![Segment::Arc(Arc {
            center,
            start: from,
            end: from,
            ..*arc
        })];
    }
    let made = Arc::about(center, from, to, arc.sweep > 0.0);
    // Where both ends nearly coincide, rounding must neither make a full turn of nothing nor the reverse.
    if (made.sweep - arc.sweep).abs() > PI {
        return vec![Segment::Arc(Arc {
            center,
            start: from,
            end: to,
            ..*arc
        })];
    }
    if ((to - center).norm() - made.radius).abs() > ROUND {
        return fitted(&made);
    }
    vec![Segment::Arc(made)]
}

/// An arc whose end is not as far from its centre as its start: one of the same turn through both ends, which has the
/// centre next to it. Of more than three quarters of a turn, two such arcs, which meet half-way between both radii.
fn fitted(arc: &Arc) -> Vec<Segment> {
    if arc.sweep.abs() <= MOST_BY_BULGE {
        return vec![Segment::from_bulge(arc.start, arc.end, arc.bulge())];
    }
    let radius = (arc.radius + (arc.end - arc.center).norm()) / 2.0;
    let (sine, cosine) = (arc.start_angle + arc.sweep / 2.0).sin_cos();
    let middle = arc.center + Vector::new(cosine, sine) * radius;
    let bulge = (arc.sweep / 8.0).tan();
    vec![
        Segment::from_bulge(arc.start, middle, bulge),
        Segment::from_bulge(middle, arc.end, bulge),
    ]
}

/// How much farther one end of an arc lies from its centre than the other, µm.
pub(super) fn unevenness(ideal: &Segment, step: &Step, from: Point, to: Point) -> f64 {
    let arc = ideal.as_arc().filter(|arc| !arc.is_full_turn());
    arc.map_or(0.0, |arc| {
        let center = arc.center + (from - step.start);
        ((to - center).norm() - (from - center).norm()).abs()
    })
}
