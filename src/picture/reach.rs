//! What of a segment is near enough to be drawn: programs that show pictures lose themselves in coordinates of
//! millions, and a lens enlarges a thousand times.

use crate::geometry::{Arc, Bounds, Point, Segment};
use std::f64::consts::{PI, TAU};

/// The farthest coordinate that is written, and the largest radius, in the picture's units: more than ten sheets.
pub(super) const FARTHEST: f64 = 10_000.0;
/// An arc of a larger radius is drawn by chords, picture units.
const FLATTEST: f64 = 1e6;
/// The chords of such an arc: over a length of `FARTHEST` they are off by less than a tenth of a unit.
const CHORDS: u32 = 64;

/// A part of a segment.
pub(super) enum Reach {
    /// As it is.
    Near(Segment),
    /// In place of what is too far away, a line along the edge of what is near: areas keep their inside.
    Far(Segment),
}

/// Hands out the parts of a segment, in its direction; `origin` is where the picture's coordinates are 0, `scale` its units in
/// one of the drawing.
pub(super) fn each_part(origin: Point, scale: f64, segment: Segment, each: &mut impl FnMut(Reach)) {
    // Nearly all is near, and an arc is where its circle is.
    let far = match &segment {
        Segment::Line(line) => (line.start - origin).amax().max((line.end - origin).amax()),
        Segment::Arc(arc) => (arc.center - origin).amax() + arc.radius,
    };
    if far * scale <= FARTHEST {
        return each(Reach::Near(segment));
    }
    let near = Bounds {
        min: origin,
        max: origin,
    }
    .grown(FARTHEST / scale);
    let bounds = segment.bounds();
    if bounds.merged(&near) == near && !is_flat(scale, &segment) {
        return each(Reach::Near(segment));
    }
    let mut shares = match &segment {
        Segment::Line(line) => {
            let (start, by) = (line.start, line.end - line.start);
            let (x, y) = (
                |edge: f64| (edge - start.x) / by.x,
                |edge: f64| (edge - start.y) / by.y,
            );
            let [left, right, low, high] = edges(&near);
            vec![x(left), x(right), y(low), y(high)]
        }
        Segment::Arc(arc) => {
            let [left, right, low, high] = edges(&near);
            let mut shares = shares_at_x(arc, left);
            shares.extend(shares_at_x(arc, right));
            shares.extend(shares_at_y(arc, low));
            shares.extend(shares_at_y(arc, high));
            shares
        }
    };
    shares.retain(|share| *share > 0.0 && *share < 1.0);
    shares.extend([0.0, 1.0]);
    shares.sort_by(f64::total_cmp);
    shares.dedup();
    for (from, to) in shares.iter().copied().zip(shares.iter().copied().skip(1)) {
        let middle = segment.point_at((from + to) / 2.0);
        let [start, end] = [from, to].map(|share| clamped(segment.point_at(share), &near));
        if middle != clamped(middle, &near) {
            if start != end {
                each(Reach::Far(Segment::line(start, end)));
            }
            continue;
        }
        let own = segment.part(from, to);
        if !is_flat(scale, &own) {
            each(Reach::Near(match own {
                Segment::Line(_) => Segment::line(start, end),
                arc => arc,
            }));
            continue;
        }
        let at = |chord: u32| {
            let share = f64::from(chord) / f64::from(CHORDS);
            clamped(segment.point_at(from + (to - from) * share), &near)
        };
        let chords = (0..CHORDS).map(|chord| Segment::line(at(chord), at(chord + 1)));
        chords.map(Reach::Near).for_each(&mut *each);
    }
}

fn is_flat(scale: f64, segment: &Segment) -> bool {
    segment
        .as_arc()
        .is_some_and(|arc| arc.radius * scale > FLATTEST)
}

/// The edges of a box: left and right, low and high.
fn edges(of: &Bounds) -> [f64; 4] {
    [of.min.x, of.max.x, of.min.y, of.max.y]
}

fn clamped(point: Point, within: &Bounds) -> Point {
    Point::new(
        point.x.clamp(within.min.x, within.max.x),
        point.y.clamp(within.min.y, within.max.y),
    )
}

/// Where an arc has this coordinate, as shares of its sweep from 0 on.
fn shares_at_x(arc: &Arc, x: f64) -> Vec<f64> {
    let across = ((x - arc.center.x) / arc.radius).acos();
    shares_at(arc, [across, -across])
}

/// The same of the other coordinate.
fn shares_at_y(arc: &Arc, y: f64) -> Vec<f64> {
    let up = ((y - arc.center.y) / arc.radius).asin();
    shares_at(arc, [up, PI - up])
}

/// No number is an angle that the arc does not reach.
fn shares_at(arc: &Arc, angles: [f64; 2]) -> Vec<f64> {
    let share = |angle: &f64| {
        let turned = (angle - arc.start_angle) * arc.sweep.signum();
        turned.rem_euclid(TAU) / arc.sweep.abs()
    };
    angles
        .iter()
        .filter(|angle| angle.is_finite())
        .map(share)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::winding_of;
    use proptest::prelude::*;

    /// Places about the origin, and far away from it.
    fn place() -> impl Strategy<Value = Point> {
        let one = || prop_oneof![-20.0..20.0, -3e4..3e4, -1e9..1e9];
        (one(), one()).prop_map(|(x, y)| Point::new(x, y))
    }

    fn bulge() -> impl Strategy<Value = f64> {
        prop_oneof![Just(0.0), -1.5..1.5, Just(1.0), -1e-4..1e-4]
    }

    fn drawn(segments: &[Segment], scale: f64) -> Vec<Segment> {
        let mut all = Vec::new();
        for segment in segments {
            each_part(Point::origin(), scale, *segment, &mut |part| match part {
                Reach::Near(segment) | Reach::Far(segment) => all.push(segment),
            });
        }
        all
    }

    proptest! {
        /// Nothing is written that is far away, and an area keeps its inside.
        #[test]
        fn what_is_far_is_not_written_and_leaves_areas_as_they_are(
            corners in prop::collection::vec((place(), bulge()), 3..7),
            scale in prop_oneof![Just(1.0), 1e-3..1e3],
            asked in prop::collection::vec((-0.9..0.9, -0.9..0.9), 20),
        ) {
            let next = corners.iter().cycle().skip(1);
            let sides = corners.iter().zip(next);
            let sides = sides.filter(|((from, _), (to, _))| (to - from).norm() > 1e-3);
            let segments: Vec<Segment> = sides
                .map(|((from, bulge), (to, _))| Segment::from_bulge(*from, *to, *bulge))
                .collect();
            let drawn = drawn(&segments, scale);
            for segment in &drawn {
                let ends = [segment.start(), segment.end(), segment.point_at(0.5)];
                for end in ends {
                    prop_assert!(end.coords.amax() * scale <= 1.001 * FARTHEST, "{segment:?}");
                }
            }
            let reach = FARTHEST / scale;
            for (x, y) in asked {
                let at = Point::new(x * reach, y * reach);
                // Beside the line itself chords decide.
                let is_clear = |of: &[Segment]| of.iter().all(|own| own.distance_to(at) > 2e-2 * reach);
                if is_clear(&segments) && is_clear(&drawn) {
                    prop_assert_eq!(
                        winding_of(segments.iter().copied(), at),
                        winding_of(drawn.iter().copied(), at),
                        "{:?} {:?}", at, drawn
                    );
                }
            }
        }
    }
}
