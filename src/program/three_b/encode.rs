//! From a line or arc of the path to blocks on the µm grid.

use super::block::{Block, CountingAxis, Motion, Node, Quadrant};
use super::decode::{decode, phase};
use crate::geometry::{Arc, Line, Segment};
use crate::program::grid::{chord_count, grid_centers, in_pieces, largest_distance, sagitta};
pub(crate) use crate::program::grid::{point_of, snap};
use std::f64::consts::{PI, TAU};

/// How far a decoded block may end from its node, µm.
pub(crate) const END_TOLERANCE: f64 = 1.5;

/// How far a decoded block may lie from its piece of the path, anywhere, µm.
pub(crate) const ASIDE_TOLERANCE: f64 = 2.5;

/// The largest sagitta of a chord that stands for a piece of an arc too large for the format, µm.
const CHORD_SAGITTA: f64 = 0.5;

/// A block, the nodes between which it runs, and the piece of the path that it stands for, in µm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Encoded {
    pub(crate) block: Block,
    pub(crate) from: Node,
    pub(crate) to: Node,
    pub(crate) piece: Segment,
}

/// Appends the blocks of `piece` (µm) from `from` to `to`, the snapped ends of it. None of their numbers is above `largest`.
///
/// A piece that has no length on the grid, an arc of radius zero among them, appends nothing. `None` when an arc cannot be
/// written within tolerance, or a number does not fit.
pub(crate) fn encode(
    piece: &Segment,
    from: Node,
    to: Node,
    largest: i64,
    blocks: &mut Vec<Encoded>,
) -> Option<()> {
    match piece {
        Segment::Line(line) => encode_line(line, from, to, largest, blocks),
        Segment::Arc(arc) => encode_arc(arc, from, to, largest, 0, blocks),
    }
}

fn encode_line(
    line: &Line,
    from: Node,
    to: Node,
    largest: i64,
    blocks: &mut Vec<Encoded>,
) -> Option<()> {
    let longest = (to.x - from.x).abs().max((to.y - from.y).abs());
    if longest == 0 {
        return Some(());
    }
    // Pieces one µm short of the limit, because a snapped node may lie one further.
    let count = if longest <= largest {
        1
    } else {
        longest / (largest - 1).max(1) + 1
    };
    in_pieces(&Segment::Line(*line), from, to, count, |piece, from, to| {
        blocks.push(Encoded {
            block: line_block(from, to),
            from,
            to,
            piece,
        });
        Some(())
    })
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
        std::cmp::Ordering::Equal if matches!(quadrant, Quadrant::First | Quadrant::Third) => {
            CountingAxis::Y
        }
        std::cmp::Ordering::Equal => CountingAxis::X,
    };
    Block {
        x,
        y,
        j: x.max(y),
        axis,
        motion: Motion::Line(quadrant),
    }
}

fn encode_arc(
    arc: &Arc,
    from: Node,
    to: Node,
    largest: i64,
    depth: u32,
    blocks: &mut Vec<Encoded>,
) -> Option<()> {
    let full_turn = from == to && arc.sweep.abs() > PI;
    if from == to && (!full_turn || arc.radius < 0.5) {
        return Some(());
    }
    // Its centre needs more digits than a block has.
    if arc.radius > 2.0 * largest as f64 {
        return chords(arc, from, to, largest, blocks);
    }
    let whole = Segment::Arc(*arc);
    match arc_block(arc, from, to, full_turn) {
        Attempt::Block(block) if block.x > largest || block.y > largest => {
            chords(arc, from, to, largest, blocks)
        }
        Attempt::Block(block) if block.j > largest => {
            // Pieces of one length differ in their J, which is split once more where that is too long.
            let count = block.j / (largest - largest / 1000).max(1) + 1;
            in_pieces(&whole, from, to, count.max(2), |piece, from, to| {
                encode(&piece, from, to, largest, blocks)
            })
        }
        Attempt::Block(block) => {
            blocks.push(Encoded {
                block,
                from,
                to,
                piece: whole,
            });
            Some(())
        }
        // A chord of an arc this flat is as near to it as the grid is.
        Attempt::Misses if sagitta(arc) <= 2.0 * CHORD_SAGITTA => {
            encode_chord(&whole, from, to, largest, blocks)
        }
        Attempt::Misses if depth < 8 => {
            let middle = snap(arc.point_at(0.5))?;
            for (share, from, to) in [(0.0, from, middle), (0.5, middle, to)] {
                if let Segment::Arc(half) = whole.part(share, share + 0.5) {
                    encode_arc(&half, from, to, largest, depth + 1, blocks)?;
                }
            }
            Some(())
        }
        Attempt::Misses => None,
    }
}

/// Lines whose sagitta stays below [`CHORD_SAGITTA`].
fn chords(arc: &Arc, from: Node, to: Node, largest: i64, blocks: &mut Vec<Encoded>) -> Option<()> {
    let count = chord_count(arc, CHORD_SAGITTA)?;
    in_pieces(&Segment::Arc(*arc), from, to, count, |piece, from, to| {
        encode_chord(&piece, from, to, largest, blocks)
    })
}

/// Straight blocks that stand for an arc.
fn encode_chord(
    piece: &Segment,
    from: Node,
    to: Node,
    largest: i64,
    blocks: &mut Vec<Encoded>,
) -> Option<()> {
    let first = blocks.len();
    encode_line(
        &Line {
            start: piece.start(),
            end: piece.end(),
        },
        from,
        to,
        largest,
        blocks,
    )?;
    let count = (blocks.len() - first) as f64;
    for (index, block) in blocks[first..].iter_mut().enumerate() {
        block.piece = piece.part(index as f64 / count, (index + 1) as f64 / count);
    }
    Some(())
}

enum Attempt {
    Block(Block),
    /// Decoded again, the block would not end at its node.
    Misses,
}

/// The block about the best centre; where it leads too far from the arc, as a grid centre two µm off can past a half turn, about the
/// next best one.
fn arc_block(arc: &Arc, from: Node, to: Node, full_turn: bool) -> Attempt {
    let centers = grid_centers(arc, from, to);
    let mut attempts = centers
        .iter()
        .map(|center| block_about(center.node, arc, from, to, full_turn));
    attempts
        .find(|attempt| matches!(attempt, Attempt::Block(_)))
        .unwrap_or(Attempt::Misses)
}

/// Other blocks that stand for the same arc within tolerance: about another centre, or counting 1 µm more or less.
pub(crate) fn alternatives(encoded: &Encoded, largest: i64) -> Vec<Block> {
    let Segment::Arc(arc) = &encoded.piece else {
        return Vec::new();
    };
    let (from, to) = (encoded.from, encoded.to);
    if from == to || matches!(encoded.block.motion, Motion::Line(_)) {
        return Vec::new();
    }
    let mut found = Vec::new();
    for center in grid_centers(arc, from, to) {
        let Attempt::Block(block) = block_about(center.node, arc, from, to, false) else {
            continue;
        };
        let counts = [block.j - 1, block.j, block.j + 1].map(|j| Block { j, ..block });
        found.extend(counts.into_iter().filter(|block| {
            block.x.max(block.y).max(block.j) <= largest && stands_for(block, arc, from, to, false)
        }));
    }
    found
}

/// Whether a block, decoded again, is the arc between its nodes.
fn stands_for(block: &Block, arc: &Arc, from: Node, to: Node, full_turn: bool) -> bool {
    match decode(block, point_of(from)) {
        Ok(Segment::Arc(decoded)) => {
            decoded.is_full_turn() == full_turn
                && (decoded.end - point_of(to)).norm() <= END_TOLERANCE
                && largest_distance(&Segment::Arc(decoded), &Segment::Arc(*arc)) <= ASIDE_TOLERANCE
                && (decoded.point_at(0.5) - arc.point_at(0.5)).norm() <= ASIDE_TOLERANCE
        }
        _ => false,
    }
}

fn block_about(center: Node, arc: &Arc, from: Node, to: Node, full_turn: bool) -> Attempt {
    let (start_x, start_y) = (from.x - center.x, from.y - center.y);
    let (end_x, end_y) = (to.x - center.x, to.y - center.y);
    if (start_x, start_y) == (0, 0) || (end_x, end_y) == (0, 0) {
        return Attempt::Misses;
    }
    let counter_clockwise = arc.sweep > 0.0;
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
        let sweep = between + TAU * ((arc.sweep - between) / TAU).round();
        if sweep * arc.sweep <= 0.0 || sweep.abs() > TAU {
            return Attempt::Misses;
        }
        let (first, last) = match axis {
            CountingAxis::X => (start_x, end_x),
            CountingAxis::Y => (start_y, end_y),
        };
        projections(
            first as f64,
            last as f64,
            radius,
            phase(axis, start_angle, counter_clockwise),
            sweep.abs(),
        )
    };
    let motion = if counter_clockwise {
        Motion::CounterClockwise(Quadrant::counter_clockwise(start_x, start_y))
    } else {
        Motion::Clockwise(Quadrant::clockwise(start_x, start_y))
    };
    let block = Block {
        x: start_x.abs(),
        y: start_y.abs(),
        j: j.round() as i64,
        axis,
        motion,
    };
    if stands_for(&block, arc, from, to, full_turn) {
        Attempt::Block(block)
    } else {
        Attempt::Misses
    }
}

/// What a controller counts on an axis along an arc.
pub(crate) fn counted(arc: &Arc, axis: CountingAxis) -> f64 {
    let (first, last) = match axis {
        CountingAxis::X => (arc.start.x - arc.center.x, arc.end.x - arc.center.x),
        CountingAxis::Y => (arc.start.y - arc.center.y, arc.end.y - arc.center.y),
    };
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
