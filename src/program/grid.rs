//! The grid of a program: its nodes, and the centre on it about which an arc runs best.

use crate::geometry::{Arc, Point, Segment};
use std::f64::consts::PI;

/// A node of a program on its grid, in absolute coordinates. A step is 1 µm but for ISO profiles with more decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Node {
    pub x: i64,
    pub y: i64,
}

/// The grid point nearest to a point in steps; `None` beyond what a program can address exactly.
pub fn snap(point: Point) -> Option<Node> {
    const FAR: f64 = 1e12;
    let fits = |value: f64| value.abs() <= FAR;
    (fits(point.x) && fits(point.y)).then(|| Node { x: point.x.round() as i64, y: point.y.round() as i64 })
}

pub fn point_of(node: Node) -> Point {
    Point::new(node.x as f64, node.y as f64)
}

/// A grid point that may stand for an arc's centre.
#[derive(Clone, Copy)]
pub struct GridCenter {
    pub node: Node,
    /// By how much it is further from the arc's start than from its end, or nearer.
    pub difference: f64,
    /// From the true centre.
    pub away: f64,
}

/// The nine grid points around the true centre.
pub fn grid_centers(arc: &Arc, from: Node, to: Node) -> [GridCenter; 9] {
    let nearest = Node { x: arc.center.x.round() as i64, y: arc.center.y.round() as i64 };
    std::array::from_fn(|index| {
        let node = Node { x: nearest.x + index as i64 / 3 - 1, y: nearest.y + index as i64 % 3 - 1 };
        let difference = (distance(from, node) - distance(to, node)).abs();
        GridCenter { node, difference, away: (point_of(node) - arc.center).norm() }
    })
}

/// The grid centre that is most nearly as far from the start as from the end; the nearest one where they are equally good.
pub fn best_center(arc: &Arc, from: Node, to: Node) -> Node {
    let [mut best, others @ ..] = grid_centers(arc, from, to);
    for center in others {
        let nearer = center.difference < best.difference + 1e-9 && center.away < best.away;
        if center.difference < best.difference - 1e-9 || nearer {
            best = center;
        }
    }
    best.node
}

fn distance(a: Node, b: Node) -> f64 {
    (point_of(a) - point_of(b)).norm()
}

/// Cuts `whole` into `count` pieces of equal length with snapped nodes between them; pieces without length are left out.
pub fn in_pieces(whole: &Segment, from: Node, to: Node, count: i64, mut each: impl FnMut(Segment, Node, Node) -> Option<()>) -> Option<()> {
    if count <= 1 {
        return each(*whole, from, to);
    }
    let (mut node, mut share) = (from, 0.0);
    for number in 1..=count {
        let next_share = number as f64 / count as f64;
        let next = if number == count { to } else { snap(whole.point_at(next_share))? };
        if next != node {
            each(whole.part(share, next_share), node, next)?;
            (node, share) = (next, next_share);
        }
    }
    Some(())
}

/// How far the middle of an arc lies from that of its chord.
pub fn sagitta(arc: &Arc) -> f64 {
    arc.radius * (1.0 - (arc.sweep.abs() / 2.0).min(PI).cos())
}

/// The number of chords of an arc that each stay within `sagitta` of it; `None` for more than a program can hold.
pub fn chord_count(arc: &Arc, sagitta: f64) -> Option<i64> {
    let half_step = (1.0 - (sagitta / arc.radius).min(1.0)).acos();
    // Where the radius is so large that the step vanishes in rounding, s = l² / 8r gives it.
    let step = if half_step > 1e-6 { 2.0 * half_step } else { (8.0 * sagitta / arc.radius).sqrt() };
    let length = arc.radius * arc.sweep.abs();
    let count = (arc.sweep.abs() / step).ceil();
    (count.is_finite() && length.is_finite() && count <= 1e7).then_some((count as i64).max(1))
}
