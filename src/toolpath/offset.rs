//! The offset of one segment, with its source. Corners join them, see `corners`.

use super::cores::{any, each};
use super::path::{PathSegment, Source};
use crate::drawing::ContourSegment;
use crate::geometry::{
    Arc, Line, Point, Segment, Tolerances, Vector, corner_between, equally_far, led_to, left_normal,
};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// A segment of a contour as it is cut: without gaps to its neighbours, in the direction of the cut.
pub(super) type Wall = PathSegment;

/// Walls that one core takes at a time.
const AT_A_TIME: usize = 2048;

/// What stands for a segment without length until it is left out.
const NO_WALL: Wall = Wall {
    geometry: Segment::Line(Line {
        start: Point::new(0.0, 0.0),
        end: Point::new(0.0, 0.0),
    }),
    source: Source::Tab,
};

/// The walls of a contour of `count` segments. Both neighbours close a gap within the join tolerance: where it is more than ends that
/// certainly meet are apart, on their own lines and circles, if these meet near by; else half way. Segments without length are left out.
pub(super) fn walls(
    count: usize,
    segment: impl Fn(usize) -> Option<ContourSegment> + Sync + Send,
    closed: bool,
    tolerances: &Tolerances,
) -> Vec<Wall> {
    let Tolerances {
        zero_length,
        certain,
        ..
    } = *tolerances;
    let is_any_short = AtomicBool::new(false);
    let is_long = |wall: &Wall| wall.geometry.length() > zero_length;
    let mut walls = each(count, AT_A_TIME, |at| {
        let wall = segment(at).map(|segment| Wall {
            geometry: segment.geometry,
            source: Source::Segment {
                entity: segment.entity,
                segment: segment.segment,
            },
        });
        let wall = wall.filter(is_long);
        wall.unwrap_or_else(|| {
            is_any_short.store(true, Relaxed);
            NO_WALL
        })
    });
    if is_any_short.into_inner() {
        walls.retain(is_long);
    }
    let count = walls.len();
    if count < 2 {
        if let (true, Some(wall)) = (closed, walls.first_mut())
            && wall
                .geometry
                .as_arc()
                .is_some_and(|arc| !arc.is_full_turn())
        {
            // One arc that returns to its start within the join tolerance is a circle.
            if let Segment::Arc(arc) = wall.geometry {
                wall.geometry = Segment::Arc(Arc::about(
                    arc.center,
                    arc.start,
                    arc.start,
                    arc.sweep > 0.0,
                ));
            }
        }
        return walls;
    }
    let next = |index: usize| if index + 1 == count { 0 } else { index + 1 };
    let joints = if closed { count } else { count - 1 };
    let is_gap = |index: usize| walls[index].geometry.end() != walls[next(index)].geometry.start();
    if !any(joints, AT_A_TIME, is_gap) {
        return walls;
    }
    for index in 0..joints {
        let next = next(index);
        let (end, start) = (walls[index].geometry.end(), walls[next].geometry.start());
        let [before, behind] = [walls[index].geometry, walls[next].geometry];
        if (start - end).norm() > certain
            && let Some(corner) = corner_between(&before, &behind)
        {
            walls[index].geometry = led_to(&before, true, corner);
            walls[next].geometry = led_to(&behind, false, corner);
        } else if end != start {
            let middle = end + (start - end) * 0.5;
            walls[index].geometry = with_ends(
                &walls[index].geometry,
                walls[index].geometry.start(),
                middle,
            );
            walls[next].geometry =
                with_ends(&walls[next].geometry, middle, walls[next].geometry.end());
        }
    }
    walls
}

/// The segment with its ends moved a little. An arc keeps its sweep, one of more than a half turn its place: of a nearly full turn
/// the ends are so near to each other that they say nothing of the radius.
fn with_ends(segment: &Segment, start: Point, end: Point) -> Segment {
    match segment {
        Segment::Line(_) => Segment::line(start, end),
        Segment::Arc(arc)
            if (start - arc.start).norm().max((end - arc.end).norm())
                <= 1e-9 * arc.radius.max(1.0) =>
        {
            Segment::Arc(Arc { start, end, ..*arc })
        }
        Segment::Arc(arc) if arc.is_minor() => Segment::from_bulge(start, end, arc.bulge()),
        Segment::Arc(arc) => {
            let center = equally_far(arc.center, start, end).unwrap_or(arc.center);
            let moved = Arc::about(center, start, end, arc.sweep > 0.0);
            // One whose ends have passed each other is a full turn.
            let is_whole = (moved.sweep - arc.sweep).abs() > 1.0;
            Segment::Arc(match is_whole {
                true => Arc::about(center, start, start, arc.sweep > 0.0),
                false => moved,
            })
        }
    }
}

/// The normal of a wall at a share of it, towards the wire. `side` is +1 for left, −1 for right.
pub(super) fn normal(wall: &Segment, share: f64, side: f64) -> Vector {
    left_normal(wall.tangent_at(share)) * side
}

/// A wall shifted by `correction` to the wire's side.
#[derive(Clone, Copy, Debug)]
pub(super) enum Offset {
    /// A line, or an arc of radius r ∓ c, down to a zero-radius arc that is a point.
    Runs(Segment),
    /// An arc about `center` tighter than the correction: the wire's centre cannot follow it.
    TooTight { center: Point },
}

/// Shifts `wall` by `correction` to `side`. A radius that falls below the correction by at most `tolerance` counts as the limit.
pub(super) fn offset(wall: &Segment, correction: f64, side: f64, tolerance: f64) -> Offset {
    match wall {
        Segment::Line(Line { start, end }) => {
            let shift = normal(wall, 0.0, side) * correction;
            Offset::Runs(Segment::line(start + shift, end + shift))
        }
        Segment::Arc(arc) => {
            let shift = if arc.sweep * side > 0.0 {
                -correction
            } else {
                correction
            };
            let radius = arc.radius + shift;
            if radius < -tolerance {
                return Offset::TooTight { center: arc.center };
            }
            if radius <= tolerance {
                return Offset::Runs(Segment::Arc(Arc {
                    radius: 0.0,
                    start: arc.center,
                    end: arc.center,
                    ..*arc
                }));
            }
            // Not by the share of the two radii: about a far centre they differ by rounding alone.
            let out = |point: Point| point + (point - arc.center) * (shift / arc.radius);
            Offset::Runs(Segment::Arc(Arc {
                radius,
                start: out(arc.start),
                end: out(arc.end),
                ..*arc
            }))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(wall: Segment, side: f64, expected: Option<(f64, [f64; 2])>) {
        match (offset(&wall, 0.1, side, 1e-6), expected) {
            (Offset::TooTight { .. }, None) => {}
            (Offset::Runs(segment), Some((radius, start))) => {
                assert!(
                    (segment.as_arc().map_or(0.0, |arc| arc.radius) - radius).abs() < 1e-12,
                    "{segment:?}"
                );
                assert!(
                    (segment.start() - Point::from(start)).norm() < 1e-12,
                    "{segment:?}"
                );
            }
            (got, expected) => panic!("{got:?}, expected {expected:?}"),
        }
    }

    #[test]
    fn arcs_shrink_on_the_side_of_their_centre() {
        let arc = |radius: f64, sweep: f64| {
            Segment::Arc(Arc::from_center(Point::origin(), radius, 0.0, sweep))
        };
        check(arc(2.0, 1.0), 1.0, Some((1.9, [1.9, 0.0])));
        check(arc(2.0, 1.0), -1.0, Some((2.1, [2.1, 0.0])));
        check(arc(2.0, -1.0), 1.0, Some((2.1, [2.1, 0.0])));
        check(arc(2.0, -1.0), -1.0, Some((1.9, [1.9, 0.0])));
        check(arc(0.1, 1.0), 1.0, Some((0.0, [0.0, 0.0])));
        check(arc(0.1 - 5e-7, 1.0), 1.0, Some((0.0, [0.0, 0.0])));
        check(arc(0.09, 1.0), 1.0, None);
        check(
            Segment::line(Point::origin(), Point::new(3.0, 0.0)),
            1.0,
            Some((0.0, [0.0, 0.1])),
        );
        check(
            Segment::line(Point::origin(), Point::new(3.0, 0.0)),
            -1.0,
            Some((0.0, [0.0, -0.1])),
        );
    }
}
