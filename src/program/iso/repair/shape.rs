//! The moves of a contour's passes, told by their shapes.

use crate::program::iso::block::{Block, Motion};
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::{Bend, Move, Place, Reading, apart};
use rustc_hash::FxHashMap;

/// From its start to its end, nm, and how it bends: from its start to its centre, or its radius, and whether it turns
/// left.
pub(super) type Shape = (Place, Option<(Place, bool)>);

/// The moves of a contour's other passes, in either direction.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Passes {
    pub(super) counts: FxHashMap<Shape, usize>,
    /// The moves of the cut itself are among them: its passes have no stop between them.
    pub(super) holds_own: bool,
}

impl Passes {
    /// Whether another pass has a move; one that stands in the text is not its own witness.
    pub(super) fn has(&self, shape: &Shape, stands: bool) -> bool {
        let count = self.counts.get(shape).copied().unwrap_or(0);
        count > usize::from(self.holds_own && stands)
    }
}

pub(super) fn shapes<'a>(
    reading: &Reading,
    mut machine: Machine,
    blocks: impl Iterator<Item = &'a Block>,
) -> Vec<Shape> {
    let made = blocks.filter_map(|block| machine.run(block, reading));
    made.filter_map(|made| shape(&made, reading)).collect()
}

/// `None` for a move without a cut or without a length.
pub(super) fn shape(made: &Move, reading: &Reading) -> Option<Shape> {
    if !made.is_cut() || !made.goes_anywhere() {
        return None;
    }
    let turns_left = made.motion == Motion::CounterClockwise;
    let bend = made.is_arc().then(|| {
        let center = made.center(reading.rule(made.incremental));
        let bend = match (center, made.bend) {
            (Some(center), _) => apart(center, made.from),
            (None, Bend::Radius(radius)) => [radius, i64::MAX],
            (None, _) => [0, i64::MAX],
        };
        (bend, turns_left)
    });
    Some((apart(made.to, made.from), bend))
}

pub(super) fn backwards((by, bend): &Shape) -> Shape {
    let bend = bend.map(|(center, turns_left)| {
        let is_radius = center[1] == i64::MAX;
        let center = if is_radius {
            center
        } else {
            apart(center, *by)
        };
        (center, !turns_left)
    });
    (apart([0, 0], *by), bend)
}
