//! Which single field of which block keeps a contour open.
//!
//! A contour that does not close, in which every block for itself is sound, has a field that means something else than its writer
//! did (a wrong quadrant, turn, counting axis or J), or lacks a block, or is meant to stay open. A field is named where changing it,
//! and nothing else in the contour, closes it. Several such changes are weighed by what they do at the block's neighbours: one that
//! makes the path run on smoothly counts, one that breaks what is smooth, doubles the wire back on itself or makes the path cross
//! itself is none. The coordinates behind a block decide where there are any.

use super::super::block::{Block, CountingAxis, Motion, Quadrant};
use super::super::decode::meant;
use super::super::encode::counted;
use super::super::entry::{BlockEntry, Move, travel_of};
use super::super::run::Sum;
use super::position_mismatch::mismatch;
use super::{axis_of, motion_name};
use crate::finding::Fault;
use crate::geometry::{Arc, Point, Segment, Vector, turn};
use crate::program::path::crossings_of;
use crate::program::path::tolerance;

/// Contours of fewer blocks close by too many changes, contours of more cost too long to try.
pub(in super::super) const BLOCKS: std::ops::RangeInclusive<usize> = 4..=1000;

/// Blocks that meet within this angle run smoothly into each other, radians: two degrees, what rounding to µm makes of a small arc.
const SMOOTH: f64 = 0.035;

/// A change of one field that closes the way.
struct Change {
    index: usize,
    block: Block,
    fault: Fault,
    /// Smooth joints of the block that the change makes, less those that it breaks.
    smoother: i32,
    /// The coordinates behind the block say so.
    is_stated: bool,
}

/// The block whose one change closes the way, by its index, and what is wrong with it. `None` where there is none, or where several
/// are as likely.
pub(in super::super) fn culprit(sum: &Sum, blocks: &[&BlockEntry]) -> Option<(usize, Fault)> {
    let mut changes: Vec<Change> = (0..blocks.len())
        .filter_map(|index| change_of(index, sum, blocks))
        .collect();
    if changes.iter().any(|change| change.is_stated) {
        changes.retain(|change| change.is_stated);
    }
    let best = changes
        .iter()
        .map(|change| change.smoother)
        .max()
        .filter(|best| *best >= 0)?;
    changes.retain(|change| change.smoother == best);
    let change = changes.pop().filter(|_| changes.is_empty())?;
    let path = |changed: Option<Block>| crosses(blocks, change.index, changed, sum.arcs);
    if path(Some(change.block)) {
        return None;
    }
    let is_sure = change.is_stated || change.smoother > 0 || path(None);
    Some((change.index, with_certainty(change.fault, is_sure)))
}

fn with_certainty(fault: Fault, is_sure: bool) -> Fault {
    match fault {
        Fault::QuadrantKeepsOpen { found, meant, .. } => Fault::QuadrantKeepsOpen {
            found,
            meant,
            is_sure,
        },
        Fault::AxisKeepsOpen { axis, .. } => Fault::AxisKeepsOpen { axis, is_sure },
        Fault::JKeepsOpen { j, meant, .. } => Fault::JKeepsOpen { j, meant, is_sure },
        other => other,
    }
}

/// The most likely change of one field of a block that closes the way.
fn change_of(index: usize, sum: &Sum, blocks: &[&BlockEntry]) -> Option<Change> {
    let entry = blocks.get(index)?;
    let before = index.checked_sub(1).and_then(|before| blocks.get(before));
    // Lead-in and lead-out that lie on each other are right, both of them.
    let (first, last) = (blocks.first()?, blocks.last()?);
    if (index == 0 || index + 1 == blocks.len())
        && first.travel.plus(last.travel).is_within(tolerance(0))
    {
        return None;
    }
    let stated = before
        .and_then(|before| before.stated_end())
        .zip(entry.stated_end());
    let fits =
        |travel: &Move| stated.is_none_or(|(from, to)| mismatch(&from, travel, &to).is_none());
    if stated.is_some() && fits(&entry.travel) {
        return None;
    }
    let now = joints(blocks, index, &entry.block);
    let weighed = candidates(entry, sum, index == 0)
        .into_iter()
        .filter_map(|(block, fault)| {
            let then = joints(blocks, index, &block);
            let doubles_back = then.doubled > now.doubled;
            let fits = fits(&travel_of(&block));
            (!doubles_back && fits).then(|| Change {
                index,
                block,
                fault,
                smoother: then.smooth - now.smooth,
                is_stated: stated.is_some(),
            })
        });
    // Of several in one block the first is the plainest.
    weighed.reduce(|best, other| {
        if other.smoother > best.smoother {
            other
        } else {
            best
        }
    })
}

/// How a block meets its neighbours.
struct Joints {
    smooth: i32,
    /// Joints at which the wire runs back on the way that it came.
    doubled: i32,
}

fn joints(blocks: &[&BlockEntry], index: usize, block: &Block) -> Joints {
    let segment = |block: &Block| meant(block, Point::origin());
    let neighbour = |index: Option<usize>| {
        index
            .and_then(|index| blocks.get(index))
            .and_then(|entry| segment(&entry.block))
    };
    let mut joints = Joints {
        smooth: 0,
        doubled: 0,
    };
    let Some(own) = segment(block) else {
        return joints;
    };
    let mut meet = |from: Vector, to: Vector| {
        let angle = turn(from, to).abs();
        joints.smooth += i32::from(angle <= SMOOTH);
        joints.doubled += i32::from(angle >= std::f64::consts::PI - SMOOTH);
    };
    if let Some(before) = neighbour(index.checked_sub(1)) {
        meet(before.end_tangent(), own.start_tangent());
    }
    if let Some(behind) = neighbour(index.checked_add(1)) {
        meet(own.end_tangent(), behind.start_tangent());
    }
    joints
}

/// Whether the way crosses itself, with another block in the place of one.
fn crosses(blocks: &[&BlockEntry], index: usize, changed: Option<Block>, arcs: usize) -> bool {
    let mut at = Move::default();
    let mut pieces = Vec::with_capacity(blocks.len());
    for (nth, entry) in blocks.iter().enumerate() {
        let block = changed.filter(|_| nth == index).unwrap_or(entry.block);
        let [x, y] = at.meant_um();
        let start = Point::new(x, y);
        pieces.push(meant(&block, start).unwrap_or(Segment::line(start, start)));
        at = at.plus(if nth == index {
            travel_of(&block)
        } else {
            entry.travel
        });
    }
    !crossings_of(&pieces, arcs).is_empty()
}

/// Every change of one field that closes the way, the plainest first.
fn candidates(entry: &BlockEntry, sum: &Sum, is_first: bool) -> Vec<(Block, Fault)> {
    let (block, travel) = (&entry.block, entry.travel);
    let closes = |changed: &Block| {
        let new = travel_of(changed);
        let whole = sum.travel.minus(travel).plus(new);
        let first = if is_first { Some(new) } else { sum.first };
        let near = tolerance(sum.arcs);
        new != travel
            && (whole.is_within(near)
                || (sum.blocks >= 3
                    && first.is_some_and(|first| whole.minus(first).is_within(near))))
    };
    let mut found = Vec::new();
    let quadrants = [
        Quadrant::First,
        Quadrant::Second,
        Quadrant::Third,
        Quadrant::Fourth,
    ];
    let kinds: &[fn(Quadrant) -> Motion] = match block.motion {
        Motion::Line(_) => &[Motion::Line],
        Motion::Clockwise(_) => &[Motion::Clockwise, Motion::CounterClockwise],
        Motion::CounterClockwise(_) => &[Motion::CounterClockwise, Motion::Clockwise],
    };
    for kind in kinds {
        for motion in quadrants.map(|quadrant| kind(usual_first(block, quadrant))) {
            let changed = Block { motion, ..*block };
            if motion != block.motion && closes(&changed) {
                let (name, meant) = (motion_name(block.motion), motion_name(motion));
                found.push((
                    changed,
                    Fault::QuadrantKeepsOpen {
                        found: name,
                        meant,
                        is_sure: false,
                    },
                ));
            }
        }
    }
    let axis = match block.axis {
        CountingAxis::X => CountingAxis::Y,
        CountingAxis::Y => CountingAxis::X,
    };
    let changed = Block { axis, ..*block };
    if !matches!(block.motion, Motion::Line(_)) && closes(&changed) {
        found.push((
            changed,
            Fault::AxisKeepsOpen {
                axis: axis_of(block.axis),
                is_sure: false,
            },
        ));
    }
    if let Some(meant) = j_to_close(block, sum, is_first).filter(|j| *j > 0) {
        let changed = Block { j: meant, ..*block };
        if closes(&changed) {
            found.push((
                changed,
                Fault::JKeepsOpen {
                    j: block.j,
                    meant,
                    is_sure: false,
                },
            ));
        }
    }
    found
}

/// The quadrants of a line along an axis in the order in which they are usual for it: a zero has no sign, so two lead to one place.
fn usual_first(block: &Block, quadrant: Quadrant) -> Quadrant {
    match (block.y != 0 && block.x == 0, quadrant) {
        (false, Quadrant::Second) => Quadrant::Third,
        (false, Quadrant::Third) => Quadrant::Second,
        (true, Quadrant::First) => Quadrant::Second,
        (true, Quadrant::Second) => Quadrant::Fourth,
        (true, Quadrant::Third) => Quadrant::First,
        (true, Quadrant::Fourth) => Quadrant::Third,
        (_, quadrant) => quadrant,
    }
}

/// The J with which an arc ends where the contour needs it, where that lies on its circle.
fn j_to_close(block: &Block, sum: &Sum, is_first: bool) -> Option<i64> {
    let Some(Segment::Arc(arc)) = meant(block, Point::origin()) else {
        return None;
    };
    let near = tolerance(sum.arcs);
    let lead_in = sum
        .first
        .filter(|_| !is_first && sum.blocks >= 3)
        .map(|first| first.meant_um());
    let ends = [Some([0.0, 0.0]), lead_in]
        .into_iter()
        .flatten()
        .map(|target| {
            let [x, y] = sum.travel.meant_um();
            arc.end + Vector::new(target[0] - x, target[1] - y)
        });
    let on_circle = |end: &Point| ((end - arc.center).norm() - arc.radius).abs() <= near;
    let end = ends.into_iter().find(on_circle)?;
    // Back to where it starts it turns once: rounding does not decide between that and nothing.
    if (end - arc.start).norm() <= near {
        return Some((4.0 * arc.radius).round() as i64);
    }
    Some(
        counted(
            &Arc::about(arc.center, arc.start, end, arc.sweep > 0.0),
            block.axis,
        )
        .round() as i64,
    )
}
