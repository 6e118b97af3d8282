//! The totals of blocks without a word between them, from which their contour is put together.

use super::block::{Block, Motion};
use super::entry::Move;
use crate::geometry::{Point, Segment};
use crate::program::path::{Ends, FEWEST_CROSSING, mixed, tolerance};

/// The totals of blocks without a word between them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sum {
    pub(crate) blocks: usize,
    pub(crate) arcs: usize,
    pub(crate) travel: Move,
    /// How far its blocks go along each axis in all, µm, and the sum of their displacements, nm.
    pub(crate) along: [i64; 2],
    pub(crate) length: i64,
    /// Twice the area between the way and its chord, µm²; only its sign is used.
    pub(crate) twice_area: f64,
    /// Faults that change where the way leads.
    pub(crate) errors: usize,
    /// Unreadable blocks: the end of the way is unknown.
    pub(crate) unread: usize,
    /// Tells two of them apart: equal ways have equal marks.
    pub(crate) mark: u64,
    pub(crate) first: Option<Move>,
    pub(crate) second: Option<Move>,
    pub(crate) last: Option<Move>,
}

impl Sum {
    /// These blocks and then the next.
    pub(crate) fn then(&self, next: &Sum) -> Sum {
        if next.blocks == 0 {
            return Sum {
                errors: self.errors + next.errors,
                unread: self.unread + next.unread,
                ..*self
            };
        }
        let (a, b) = (self.travel.meant_um(), next.travel.meant_um());
        Sum {
            blocks: self.blocks + next.blocks,
            arcs: self.arcs + next.arcs,
            travel: self.travel.plus(next.travel),
            along: [0, 1].map(|axis| self.along[axis].saturating_add(next.along[axis])),
            length: self.length.saturating_add(next.length),
            twice_area: self.twice_area + next.twice_area + a[0] * b[1] - a[1] * b[0],
            errors: self.errors + next.errors,
            unread: self.unread + next.unread,
            mark: self
                .mark
                .wrapping_mul(POLYNOMIAL.wrapping_pow(next.blocks as u32))
                .wrapping_add(next.mark),
            first: self.first.or(next.first),
            second: self.second.or(if self.blocks == 1 {
                next.first
            } else if self.blocks == 0 {
                next.second
            } else {
                None
            }),
            last: next.last.or(self.last),
        }
    }

    pub(crate) fn ends(&self) -> Ends {
        let first = self.first.unwrap_or_default();
        let second = first.plus(self.second.unwrap_or_default());
        let last = self.travel.minus(self.last.unwrap_or_default());
        Ends {
            begin: [Move::default(), first, second].map(|at| at.node()),
            end: [last, self.travel].map(|at| at.node()),
            blocks: self.blocks,
            tolerance: tolerance(self.arcs),
        }
    }

    pub(crate) fn push(&mut self, block: &Block, travel: Move, segment: Option<&Segment>) {
        let origin = Point::origin();
        let one = Sum {
            blocks: 1,
            arcs: usize::from(!matches!(block.motion, Motion::Line(_))),
            travel,
            along: travel.machine.map(i64::saturating_abs),
            length: nanometres(travel.machine),
            twice_area: segment
                .and_then(Segment::as_arc)
                .map_or(0.0, |arc| Segment::Arc(*arc).twice_area(origin)),
            errors: 0,
            unread: 0,
            mark: mark_of(block),
            first: Some(travel),
            second: None,
            last: Some(travel),
        };
        *self = self.then(&one);
    }
}

const POLYNOMIAL: u64 = 0x9e37_79b9_7f4a_7c15;

fn mark_of(block: &Block) -> u64 {
    let Block {
        x,
        y,
        j,
        axis,
        motion,
    } = *block;
    let (kind, quadrant) = match motion {
        Motion::Line(quadrant) => (0, quadrant),
        Motion::Clockwise(quadrant) => (1, quadrant),
        Motion::CounterClockwise(quadrant) => (2, quadrant),
    };
    let fields = [
        x as u64,
        y as u64,
        j as u64,
        axis as u64 * 16 + kind * 4 + u64::from(quadrant.number()),
    ];
    fields.into_iter().fold(POLYNOMIAL, mixed)
}

/// A way of at most this many lines between two pauses leads from one contour to the next, wherever it turns.
const JUMP_BLOCKS: usize = 3;

/// A way of at most this many lines that never turns back on an axis does so, too: no contour with one fault in it
/// looks like that.
const STAIR_BLOCKS: usize = 8;

/// How much longer than a straight line a way that leads straight on may be, for each of its
/// blocks, nm: they end on whole µm.
const NOT_STRAIGHT: i64 = 10;

/// True for the way between two pauses from one contour to the next. A way that returns to its start is not one: that
/// is how a tab is cut off, from and to the thread hole.
pub(super) fn is_jump(sum: &Sum) -> bool {
    if sum.blocks == 0 || sum.arcs > 0 || sum.travel.machine == [0, 0] {
        return false;
    }
    let blocks = sum.blocks as i64;
    let turns_back = |axis: usize| {
        let straight = sum.travel.machine[axis].saturating_abs();
        sum.along[axis].saturating_sub(straight) > blocks
    };
    let is_straight = || {
        sum.length.saturating_sub(nanometres(sum.travel.machine))
            <= blocks.saturating_mul(NOT_STRAIGHT)
    };
    sum.blocks <= JUMP_BLOCKS
        || (sum.blocks <= STAIR_BLOCKS && !turns_back(0) && !turns_back(1))
        || is_straight()
}

/// How far a displacement in µm leads, nm.
fn nanometres(um: [i64; 2]) -> i64 {
    ((um[0] as f64).hypot(um[1] as f64) * 1e3).round() as i64
}

/// True for a part that is searched for crossings: after a faulty block the path is not the intended one.
pub(super) fn may_cross_itself(sum: &Sum) -> bool {
    sum.blocks >= FEWEST_CROSSING && sum.errors == 0
}
