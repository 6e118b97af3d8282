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

/// A way of at most this many lines between two pauses leads from one contour to the next.
pub(super) const JUMP_BLOCKS: usize = 3;

/// True for the way between two pauses from one contour to the next. A way that returns to its start is not one: that
/// is how a tab is cut off, from and to the thread hole.
pub(super) fn is_jump(sum: &Sum) -> bool {
    let is_way = (1..=JUMP_BLOCKS).contains(&sum.blocks) && sum.arcs == 0;
    is_way && sum.travel.machine != [0, 0]
}

/// True for a part that is searched for crossings: behind a faulty block the path is not the intended one.
pub(super) fn may_cross_itself(sum: &Sum) -> bool {
    sum.blocks >= FEWEST_CROSSING && sum.errors == 0
}
