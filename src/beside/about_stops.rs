//! Where among its stops and ends a program differs from a guess: there another tab, lead or pass is as likely as a change.

use super::against_reference::Told;
use super::difference::Difference;
use super::traced::{Block, Motion, Traced};

/// The deviation of a block at a stop where a tab was guessed wrong, mm.
pub(super) const FAR: f64 = 0.05;
/// A tab, an overlap or a lead of another length shows at most this many blocks from a stop or an end.
const ABOUT: usize = 3;

/// The wire does not stop near a block, and no way in or out is near.
pub(super) fn is_amid(traced: &Traced, one: &Difference) -> bool {
    let is_one = |block: &Block| block.range == one.range;
    let blocks = &traced.blocks;
    let at = blocks.iter().position(is_one).unwrap_or(0);
    let about = at.saturating_sub(ABOUT)..=at + ABOUT;
    let is_cut = |index: &usize| {
        let block = blocks.get(*index);
        block.is_some_and(|block| block.segment().is_some())
    };
    at >= ABOUT && about.clone().filter(is_cut).count() == about.count()
}

/// The large differences end where the wire stops or begins, or lie on both sides of a stop: the tab has another length
/// than was guessed, and nobody changed anything.
pub(super) fn parts_at_a_stop(traced: &Traced, told: &Told) -> bool {
    let off = |block: &Block| {
        let mut all = told.comparison.differences.iter();
        let of = all.find(|difference| difference.range == block.range);
        of.map_or(0.0, |difference| difference.off)
    };
    traced.blocks.windows(3).any(|about| match about {
        [before, stop, behind] if stop.motion == Motion::Stop => {
            let (one, other) = (off(before), off(behind));
            one.max(other) > FAR || one.min(other) > 0.0
        }
        _ => false,
    })
}

/// Between two stops every block differs: that pass has another correction.
pub(super) fn differs_from_stop_to_stop(traced: &Traced, told: &Told) -> bool {
    let all = &told.comparison.differences;
    let differs = |block: &Block| all.iter().any(|one| one.range == block.range);
    let mut passes = traced.blocks.split(|block| block.motion == Motion::Stop);
    all.len() > 1 && passes.any(|pass| pass.len() > 1 && pass.iter().all(differs))
}
