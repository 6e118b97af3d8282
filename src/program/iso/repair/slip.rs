//! Which changes undo a slip that nothing else explains as well.

use super::scan::Line;
use super::{Change, Suspect};
use crate::program::iso::block::{Block, Motion};

impl Suspect<'_> {
    /// False of a change that is never sure: one that adds a way, or removes something that stands only once, and one that is as well
    /// another slip, or none. `lines` stand in the place of those that it changes.
    pub(super) fn is_a_slip(&self, change: &Change, lines: &[Line]) -> bool {
        let total = self.way.total();
        let has_radius = |line: &Line| line.block.has_center() || line.block.r.is_some();
        match change {
            Change::Delete { index } => self.is_twice(*index),
            Change::Insert { .. } => false,
            // An arc without a radius may have lost it, or be a line.
            Change::Replace { index, meant } => {
                !meant.is_calculated
                    && !self.may_lack_a_line
                    && !self.is_rapid(*index)
                    && (total.radiusless == 0 || lines.iter().any(has_radius))
            }
            // Out and back on one way may be a slit, and then nothing is wrong.
            Change::Exchange { .. } => total.hard > total.slits && total.radiusless == 0,
        }
    }

    /// True for a line that repeats the one before.
    pub(super) fn is_twice(&self, index: usize) -> bool {
        let said = |line: &Line| {
            let Block {
                x,
                y,
                i,
                j,
                r,
                motion,
                ..
            } = line.block;
            (x, y, i, j, r, motion)
        };
        let before = index.checked_sub(1).map(|before| &self.way.lines[before]);
        before.is_some_and(|before| {
            said(before) == said(&self.way.lines[index]) && !before.block.empty
        })
    }

    /// Where a cut begins is told by nothing but itself.
    fn is_rapid(&self, index: usize) -> bool {
        self.made(index)
            .is_some_and(|made| made.motion == Motion::Rapid)
    }
}
