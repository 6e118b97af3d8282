//! The grid of a program: its nodes, and the best centre on it for an arc.

use crate::geometry::{Arc, Point, Segment, Vector, direction, left_normal};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

/// A node of a program on its grid, in absolute coordinates. A step is 1 µm, except in ISO profiles with more decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Node {
    pub(crate) x: i64,
    pub(crate) y: i64,
}

impl fmt::Display for Node {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "({}, {})", self.x, self.y)
    }
}

/// The grid point nearest to a point in steps; `None` beyond what a program can address exactly.
pub(crate) fn snap(point: Point) -> Option<Node> {
    const FAR: f64 = 1e12;
    let fits = |value: f64| value.abs() <= FAR;
    (fits(point.x) && fits(point.y)).then(|| Node {
        x: point.x.round() as i64,
        y: point.y.round() as i64,
    })
}

pub(crate) fn point_of(node: Node) -> Point {
    Point::new(node.x as f64, node.y as f64)
}

/// A grid point as a candidate for an arc's centre.
#[derive(Clone, Copy)]
struct Candidate {
    node: Node,
    /// The largest distance of the arc about it from the true one, or of its end from the intended one, in hundredths
    /// of a step; exact where that `is_known`, else a lower bound.
    cost: i64,
    is_known: bool,
    /// Distance from the true centre.
    away: f64,
}

/// The nine grid points around the true centre, the best first: its arc stays nearest to the true one over its whole
/// length and ends nearest to its node. Of equally good ones, the nearest to the true centre.
///
/// Each is measured only when nothing else can come before it.
pub(crate) fn grid_centers(arc: &Arc, from: Node, to: Node) -> impl Iterator<Item = Node> {
    let arc = *arc;
    let hundredths = |cost: f64| (cost * 100.0).round().min(1e15) as i64;
    let nearest = Node {
        x: arc.center.x.round() as i64,
        y: arc.center.y.round() as i64,
    };
    let middle = middle_of(&arc);
    let at_ends = at_ends(&arc, from, to);
    let mut left: [Candidate; 9] = std::array::from_fn(|index| {
        let node = Node {
            x: nearest.x + index as i64 / 3 - 1,
            y: nearest.y + index as i64 % 3 - 1,
        };
        Candidate {
            node,
            cost: hundredths(least_cost(&arc, middle, node, from, to).max(at_ends)),
            is_known: false,
            away: (point_of(node) - arc.center).norm(),
        }
    });
    let mut count = left.len();
    std::iter::from_fn(move || {
        loop {
            let all = left[..count].iter().enumerate();
            let (at, best) =
                all.min_by(|(_, a), (_, b)| a.cost.cmp(&b.cost).then(a.away.total_cmp(&b.away)))?;
            if best.is_known {
                let node = best.node;
                left.copy_within(at + 1..count, at);
                count -= 1;
                return Some(node);
            }
            let cost = hundredths(cost_of(&arc, best.node, from, to, at_ends));
            (left[at].cost, left[at].is_known) = (cost, true);
        }
    })
}

/// The best of [`grid_centers`].
pub(crate) fn best_center(arc: &Arc, from: Node, to: Node) -> Node {
    grid_centers(arc, from, to).next().unwrap_or(from)
}

/// How far the nodes are from an arc: about whatever centre, it runs from one to the other.
fn at_ends(arc: &Arc, from: Node, to: Node) -> f64 {
    let piece = Segment::Arc(*arc);
    let ends = [from, to].map(|node| piece.distance_to(point_of(node)));
    f64::max(ends[0], ends[1])
}

/// From the centre of an arc to its middle, where that lies between the ends of any arc of [`grid_centers`].
fn middle_of(arc: &Arc) -> Option<Vector> {
    const STEPS: f64 = 6.0;
    let half = arc.sweep.abs() / 2.0;
    let is_between = half * arc.radius > STEPS && half < FRAC_PI_2 && !arc.is_shallow();
    is_between.then(|| direction(arc.start_angle + arc.sweep / 2.0))
}

/// A lower bound of the error of an arc about a grid point, from its middle and its ends.
fn least_cost(arc: &Arc, middle: Option<Vector>, center: Node, from: Node, to: Node) -> f64 {
    let miss = radii_differ(center, from, to);
    let Some(middle) = middle else { return miss };
    let own = point_of(center);
    let at = own + middle * (point_of(from) - own).norm();
    // What rounding may take from it far out.
    let rounding = 1e-6 + 1e-14 * (arc.center.coords.abs().sum() + arc.radius);
    miss.max(((at - arc.center).norm() - arc.radius).abs() - rounding)
}

/// An arc as it is written: from node to node about a grid point. `None` where that is one of its ends.
pub(crate) fn arc_about(arc: &Arc, center: Node, from: Node, to: Node) -> Option<Arc> {
    let [middle, start, end] = [center, from, to].map(point_of);
    (center != from && center != to).then(|| Arc::about(middle, start, end, arc.sweep > 0.0))
}

/// How much further one of two nodes is from a grid point than the other, in steps.
pub(crate) fn radii_differ(center: Node, from: Node, to: Node) -> f64 {
    let distance = |node: Node| (point_of(node) - point_of(center)).norm();
    (distance(from) - distance(to)).abs()
}

/// The error of an arc about a grid point, in steps; infinite where it turns the other way. `at_ends` is how far its
/// nodes are from the true one.
fn cost_of(arc: &Arc, center: Node, from: Node, to: Node, at_ends: f64) -> f64 {
    let written = arc_about(arc, center, from, to);
    let Some(written) = written.filter(|written| (written.sweep - arc.sweep).abs() <= PI) else {
        return f64::INFINITY;
    };
    let miss = radii_differ(center, from, to);
    // A controller that is given the start turns about the centre at the start's distance.
    farthest_between(&Segment::Arc(written), &Segment::Arc(*arc), at_ends).max(miss)
}

/// The largest distance of a written line or arc from its piece of the path, over its whole length.
pub(crate) fn largest_distance(written: &Segment, piece: &Segment) -> f64 {
    let ends = [written.start(), written.end()].map(|place| piece.distance_to(place));
    farthest_between(written, piece, f64::max(ends[0], ends[1]))
}

/// The same, with the distance of its ends, which is known.
fn farthest_between(written: &Segment, piece: &Segment, at_ends: f64) -> f64 {
    // Between its ends it is farthest where it is parallel to the piece.
    let between = match (written, piece) {
        (Segment::Line(line), Segment::Arc(arc)) => {
            let share = line.share_of(arc.center);
            let is_between = (0.0..=1.0).contains(&share);
            [is_between.then(|| written.point_at(share)), None, None]
        }
        (Segment::Line(_), Segment::Line(_)) => [None; 3],
        (Segment::Arc(own), piece) => {
            let along = match piece {
                Segment::Line(line) => left_normal(line.direction()),
                Segment::Arc(arc) => own.center - arc.center,
            };
            // About a common centre every place is equally far.
            let by = along.try_normalize(0.0).map(|along| along * own.radius);
            let look = |by: Vector| Some(own.center + by).filter(|&place| own.spans(place));
            // It reaches its end at its own radius, which may miss that end a little.
            let end = own.center + (own.end - own.center).normalize() * own.radius;
            [by.and_then(look), by.and_then(|by| look(-by)), Some(end)]
        }
    };
    let places = between.into_iter().flatten();
    places
        .map(|place| piece.distance_to(place))
        .fold(at_ends, f64::max)
}

/// Cuts `whole` into `count` pieces of equal length with snapped nodes between them; pieces without length are left out.
pub(crate) fn in_pieces(
    whole: &Segment,
    from: Node,
    to: Node,
    count: i64,
    mut each: impl FnMut(Segment, Node, Node) -> Option<()>,
) -> Option<()> {
    if count <= 1 {
        return each(*whole, from, to);
    }
    let (mut node, mut share) = (from, 0.0);
    for number in 1..=count {
        let next_share = number as f64 / count as f64;
        let next = if number == count {
            to
        } else {
            snap(whole.point_at(next_share))?
        };
        if next != node {
            each(whole.part(share, next_share), node, next)?;
            (node, share) = (next, next_share);
        }
    }
    Some(())
}

/// The distance of an arc's middle from that of its chord.
pub(crate) fn sagitta(arc: &Arc) -> f64 {
    arc.radius * (1.0 - (arc.sweep.abs() / 2.0).min(PI).cos())
}

/// The most blocks along one line or arc of a path: more are a kilometre and more.
pub(crate) const MOST_PIECES: i64 = 100_000;

/// The number of chords of an arc that each stay within `sagitta` of it; `None` beyond [`MOST_PIECES`].
pub(crate) fn chord_count(arc: &Arc, sagitta: f64) -> Option<i64> {
    let half_step = (1.0 - (sagitta / arc.radius).min(1.0)).acos();
    // Where the radius is so large that the step vanishes in rounding, s = l² / 8r gives it.
    let step = if half_step > 1e-6 {
        2.0 * half_step
    } else {
        (8.0 * sagitta / arc.radius).sqrt()
    };
    let length = arc.radius * arc.sweep.abs();
    let count = (arc.sweep.abs() / step).ceil();
    (count.is_finite() && length.is_finite() && count <= MOST_PIECES as f64)
        .then_some((count as i64).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn arc() -> impl Strategy<Value = (Arc, Node, Node)> {
        let size = prop_oneof![20.0_f64..2e3, 2e3_f64..2e5];
        let turn = prop_oneof![0.05_f64..6.0, -6.0_f64..-0.05];
        (
            -1e5_f64..1e5,
            -1e5_f64..1e5,
            size,
            0.0_f64..7.0,
            turn,
            any::<bool>(),
        )
            .prop_map(|(x, y, radius, start, sweep, on_grid)| {
                let center = if on_grid {
                    Point::new(x.round(), y.round())
                } else {
                    Point::new(x, y)
                };
                let arc = Arc::from_center(center, radius, start, sweep);
                (arc, snap(arc.start).unwrap(), snap(arc.end).unwrap())
            })
    }

    #[test]
    fn a_centre_on_the_grid_stays_where_it_is() {
        // R 40.1 about the origin, from the top to 0.1 mm beside the bottom.
        let end = Point::new(-100.0, -(40_100.0_f64.powi(2) - 100.0 * 100.0).sqrt());
        let arc = Arc::about(Point::origin(), Point::new(0.0, 40_100.0), end, true);
        let best = best_center(&arc, snap(arc.start).unwrap(), snap(arc.end).unwrap());
        assert_eq!((best.x, best.y), (0, 0));
    }

    proptest! {
        #[test]
        fn the_largest_distance_is_that_of_all_points((arc, from, to) in arc(), by in -3.0_f64..3.0, bulge in -0.5_f64..0.5) {
            prop_assume!(from != to);
            let path = Segment::Arc(arc);
            let moved = [Point::new(arc.start.x + by, arc.start.y), Point::new(arc.end.x, arc.end.y - by)];
            let written = [
                Segment::Arc(Arc::about(point_of(best_center(&arc, from, to)), point_of(from), point_of(to), arc.sweep > 0.0)),
                Segment::line(moved[0], moved[1]),
                Segment::from_bulge(moved[0], moved[1], bulge),
            ];
            for written in written {
                // Far from the piece other places of it are the nearest ones.
                let line = Segment::line(arc.start, arc.end);
                for (written, piece) in [(written, path), (written, line)] {
                    let points = (0..=720).map(|step| written.point_at(f64::from(step) / 720.0));
                    let sampled = points.map(|point| piece.distance_to(point)).fold(0.0, f64::max);
                    let is_near = sampled < 0.2 * arc.radius && arc.sweep.abs() < 3.0;
                    let found = largest_distance(&written, &piece);
                    let slack = 1e-6 + written.length() / 720.0;
                    prop_assert!(!is_near || sampled <= found + 1e-6 + slack * 0.01, "{sampled} {found}");
                    prop_assert!(found <= sampled + slack, "{sampled} {found}");
                }
            }
        }

        #[test]
        fn an_arc_on_the_grid_stays_near_the_true_one((arc, from, to) in arc()) {
            prop_assume!(from != to && arc.sweep.abs() * arc.radius > 20.0 && (std::f64::consts::TAU - arc.sweep.abs()) * arc.radius > 20.0);
            let best = best_center(&arc, from, to);
            let cost = |node| cost_of(&arc, node, from, to, at_ends(&arc, from, to));
            prop_assert!(cost(best) <= 1.5, "{}", cost(best));
            // No other one is better by more than the steps in which they are compared.
            prop_assert!(grid_centers(&arc, from, to).all(|center| cost(center) >= cost(best) - 0.011));
        }

        #[test]
        fn the_centres_come_in_the_order_of_their_cost((arc, from, to) in arc()) {
            let nearest = snap(arc.center).unwrap();
            let around = (0..9).map(|index| Node { x: nearest.x + index / 3 - 1, y: nearest.y + index % 3 - 1 });
            let mut all: Vec<Node> = around.collect();
            let key = |node: &Node| {
                let cost = (cost_of(&arc, *node, from, to, at_ends(&arc, from, to)) * 100.0).round().min(1e15) as i64;
                (cost, (point_of(*node) - arc.center).norm())
            };
            all.sort_by(|a, b| key(a).partial_cmp(&key(b)).unwrap());
            prop_assert_eq!(grid_centers(&arc, from, to).collect::<Vec<_>>(), all);
        }
    }
}
