//! The grid of a program: its nodes, and the centre on it about which an arc runs best.

use crate::geometry::{Arc, Point};

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
