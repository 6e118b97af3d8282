//! Which single field of which block keeps a contour open.
//!
//! A contour that does not close, in which every block for itself is sound, has a field that means something else than its writer
//! did: a wrong quadrant, turn, counting axis or J. Where changing one field of exactly one block closes the contour, that is it.

use super::super::block::{Block, CountingAxis, Motion, Quadrant};
use super::super::decode::meant;
use super::super::encode::counted;
use super::super::run::{BlockEntry, Move, Sum, travel_of};
use super::not_closed::tolerance;
use super::{axis_of, motion_name};
use crate::finding::ProgramFault;
use crate::geometry::{Arc, Point, Segment, Vector};

/// Contours of fewer blocks close by too many changes, contours of more cost too long to try.
pub(in super::super) const BLOCKS: std::ops::RangeInclusive<usize> = 4..=1000;

/// The block whose one change closes the way, by its index, and what is wrong with it. `None` where there is none or more than one.
pub(in super::super) fn culprit<'a>(sum: &Sum, blocks: impl Iterator<Item = &'a BlockEntry>) -> Option<(usize, ProgramFault)> {
    let mut found: Option<(usize, ProgramFault)> = None;
    for (index, entry) in blocks.enumerate() {
        let Some(fault) = changes(&entry.block, sum, entry.travel, index == 0) else { continue };
        if found.is_some() {
            return None;
        }
        found = Some((index, fault));
    }
    found
}

/// The first change of one field that closes the way.
fn changes(block: &Block, sum: &Sum, travel: Move, is_first: bool) -> Option<ProgramFault> {
    let closes = |changed: &Block| {
        let new = travel_of(changed);
        let whole = sum.travel.minus(travel).plus(new);
        let first = if is_first { Some(new) } else { sum.first };
        let near = tolerance(sum.arcs);
        new != travel && (whole.is_within(near) || (sum.blocks >= 3 && first.is_some_and(|first| whole.minus(first).is_within(near))))
    };
    let quadrants = [Quadrant::First, Quadrant::Second, Quadrant::Third, Quadrant::Fourth];
    let kinds: &[fn(Quadrant) -> Motion] = match block.motion {
        Motion::Line(_) => &[Motion::Line],
        Motion::Clockwise(_) => &[Motion::Clockwise, Motion::CounterClockwise],
        Motion::CounterClockwise(_) => &[Motion::CounterClockwise, Motion::Clockwise],
    };
    for kind in kinds {
        for motion in quadrants.map(|quadrant| kind(usual_first(block, quadrant))) {
            if motion != block.motion && closes(&Block { motion, ..*block }) {
                let (found, meant) = (motion_name(block.motion), motion_name(motion));
                return Some(ProgramFault::QuadrantKeepsOpen { found, meant });
            }
        }
    }
    let axis = match block.axis {
        CountingAxis::X => CountingAxis::Y,
        CountingAxis::Y => CountingAxis::X,
    };
    if !matches!(block.motion, Motion::Line(_)) && closes(&Block { axis, ..*block }) {
        return Some(ProgramFault::AxisKeepsOpen { axis: axis_of(block.axis) });
    }
    let meant = j_to_close(block, sum, is_first)?;
    closes(&Block { j: meant, ..*block }).then_some(ProgramFault::JKeepsOpen { j: block.j, meant })
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
    let Some(Segment::Arc(arc)) = meant(block, Point::origin()) else { return None };
    let near = tolerance(sum.arcs);
    let lead_in = sum.first.filter(|_| !is_first && sum.blocks >= 3).map(|first| first.meant_um());
    let ends = [Some([0.0, 0.0]), lead_in].into_iter().flatten().map(|target| {
        let [x, y] = sum.travel.meant_um();
        arc.end + Vector::new(target[0] - x, target[1] - y)
    });
    let on_circle = |end: &Point| ((end - arc.center).norm() - arc.radius).abs() <= near;
    let end = ends.into_iter().find(on_circle)?;
    Some(counted(&Arc::about(arc.center, arc.start, end, arc.sweep > 0.0), block.axis).round() as i64)
}
