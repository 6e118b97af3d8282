//! From a line or arc of the path to blocks on the µm grid.

use super::block::{Block, CountingAxis, Motion, Node, Quadrant};
use super::decode::{decode, phase};
use crate::geometry::{Arc, Point, Segment};
pub(super) use crate::program::encode::ASIDE_TOLERANCE;
use crate::program::encode::{Attempt, Encoder, aside};
use crate::program::grid::grid_centers;
pub(crate) use crate::program::grid::{point_of, snap};
use std::f64::consts::{PI, TAU};

/// How far a decoded block may end from its node, µm.
pub(crate) const END_TOLERANCE: f64 = 1.5;

/// A block, the nodes between which it runs, and its piece of the path, in µm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Encoded {
    pub(crate) block: Block,
    pub(crate) from: Node,
    pub(crate) to: Node,
    pub(crate) piece: Segment,
}

impl Encoded {
    /// Where its piece ends; the node, where that was moved.
    pub(super) fn target(&self) -> Point {
        let end = self.piece.end();
        match snap(end) == Some(self.to) {
            true => end,
            false => point_of(self.to),
        }
    }
}

/// Appends the blocks of `piece` (µm) from `from` to `to`, its snapped ends. No number is above `largest`.
///
/// A piece without length on the grid, such as an arc of radius zero, appends nothing. `None` when an arc cannot be
/// written within tolerance, or a number does not fit.
pub(crate) fn encode(
    piece: &Segment,
    from: Node,
    to: Node,
    largest: i64,
    blocks: &mut Vec<Encoded>,
) -> Option<()> {
    Blocks { largest }.encode(piece, from, to, blocks)
}

/// Blocks with no number above the largest.
pub(super) struct Blocks {
    pub(super) largest: i64,
}

impl Encoder for Blocks {
    type Block = Encoded;

    fn step(&self) -> f64 {
        1.0
    }

    fn lines(&self, longest: i64) -> i64 {
        match longest <= self.largest {
            true => 1,
            // Pieces one µm short of the limit, because a snapped node may lie one further.
            false => longest / (self.largest - 1).max(1) + 1,
        }
    }

    /// Its centre needs more digits than a block has.
    fn largest_radius(&self) -> f64 {
        2.0 * self.largest as f64
    }

    fn line(&self, piece: Segment, from: Node, to: Node) -> Encoded {
        Encoded {
            block: line_block(from, to),
            from,
            to,
            piece,
        }
    }

    fn arc(&self, arc: &Arc, from: Node, to: Node, full_turn: bool) -> Attempt<Self::Block> {
        if arc.radius > self.largest_radius() {
            return Attempt::Chords;
        }
        match arc_block(arc, from, to, full_turn) {
            None => Attempt::Misses,
            Some(block) if block.x.max(block.y) > self.largest => Attempt::Chords,
            // Pieces of one length differ in their J; one that is too long is split once more.
            Some(block) if block.j > self.largest => {
                let count = block.j / (self.largest - self.largest / 1000).max(1) + 1;
                Attempt::Pieces(count.max(2))
            }
            Some(block) => Attempt::Made(Encoded {
                block,
                from,
                to,
                piece: Segment::Arc(*arc),
            }),
        }
    }
}

/// The block of a straight line between two different nodes.
///
/// A line at 45° counts Y in the quadrants I and III, X in II and IV; sources disagree, and J is the same either way.
pub(crate) fn line_block(from: Node, to: Node) -> Block {
    let (dx, dy) = (to.x - from.x, to.y - from.y);
    let (x, y) = (dx.abs(), dy.abs());
    let quadrant = Quadrant::counter_clockwise(dx, dy);
    let axis = match x.cmp(&y) {
        std::cmp::Ordering::Greater => CountingAxis::X,
        std::cmp::Ordering::Less => CountingAxis::Y,
        std::cmp::Ordering::Equal => quadrant.counts_at_45_degrees(),
    };
    Block {
        x,
        y,
        j: x.max(y),
        axis,
        motion: Motion::Line(quadrant),
    }
}

/// The block about the best centre. Where it leads too far from the arc, as a grid centre two µm off can past a half
/// turn, the block about the next best one.
fn arc_block(arc: &Arc, from: Node, to: Node, full_turn: bool) -> Option<Block> {
    grid_centers(arc, from, to).find_map(|center| {
        let block = raw_block(center, arc.sweep, from, to, full_turn)?;
        let decoded = decode(&block, point_of(from)).ok()?;
        let is_arc = decoded
            .as_arc()
            .is_some_and(|arc| arc.is_full_turn() == full_turn);
        (is_arc && runs_along(&decoded, &Segment::Arc(*arc), to)).then_some(block)
    })
}

/// Whether a decoded block runs along its piece of the path to its node.
pub(super) fn runs_along(decoded: &Segment, piece: &Segment, to: Node) -> bool {
    (decoded.end() - point_of(to)).norm() <= END_TOLERANCE
        && aside(decoded, piece) <= ASIDE_TOLERANCE
}

/// The block that turns by about `sweep` from one node to another about a grid point; `None` where that is one of them.
pub(super) fn raw_block(
    center: Node,
    sweep: f64,
    from: Node,
    to: Node,
    full_turn: bool,
) -> Option<Block> {
    let (start_x, start_y) = (from.x - center.x, from.y - center.y);
    let (end_x, end_y) = (to.x - center.x, to.y - center.y);
    if (start_x, start_y) == (0, 0) || (end_x, end_y) == (0, 0) {
        return None;
    }
    let counter_clockwise = sweep > 0.0;
    let radius = (start_x as f64).hypot(start_y as f64);
    let axis = if end_x.abs() < end_y.abs() {
        CountingAxis::X
    } else {
        CountingAxis::Y
    };
    let j = if full_turn {
        4.0 * radius
    } else {
        let start_angle = (start_y as f64).atan2(start_x as f64);
        let between = (end_y as f64).atan2(end_x as f64) - start_angle;
        let own = between + TAU * ((sweep - between) / TAU).round();
        if own * sweep <= 0.0 || own.abs() > TAU {
            return None;
        }
        projections(
            axis.of([start_x, start_y]) as f64,
            axis.of([end_x, end_y]) as f64,
            radius,
            phase(axis, start_angle, counter_clockwise),
            own.abs(),
        )
    };
    Some(Block {
        x: start_x.abs(),
        y: start_y.abs(),
        j: j.round() as i64,
        axis,
        motion: Motion::arc(counter_clockwise, start_x, start_y),
    })
}

/// How far a controller counts on an axis along an arc.
pub(crate) fn counted(arc: &Arc, axis: CountingAxis) -> f64 {
    let [first, last] = [arc.start, arc.end].map(|at| axis.of((at - arc.center).into()));
    if arc.is_full_turn() {
        return 4.0 * arc.radius;
    }
    projections(
        first,
        last,
        arc.radius,
        phase(axis, arc.start_angle, arc.sweep > 0.0),
        arc.sweep.abs(),
    )
}

/// Sum of the absolute projections of an arc on the counting axis, piece by piece between the axis crossings, from the first to
/// the last counted coordinate. `phase` is the start's, see [`phase`].
fn projections(first: f64, last: f64, radius: f64, phase: f64, sweep: f64) -> f64 {
    let half_turn = (phase / PI).floor();
    let crossings = ((phase + sweep) / PI).floor() - half_turn;
    if crossings < 1.0 {
        return (last - first).abs();
    }
    // The counted coordinate is R cos(phase): at the end of an even half turn it is −R.
    let extreme = |half_turn: f64| {
        if half_turn % 2.0 == 0.0 {
            -radius
        } else {
            radius
        }
    };
    (extreme(half_turn) - first).abs()
        + 2.0 * radius * (crossings - 1.0)
        + (last - extreme(half_turn + crossings - 1.0)).abs()
}
