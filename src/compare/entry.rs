//! Where a pass begins: the first block of its contour, and its place on the way of the wire.

use super::walk::{At, COVERED, Walk};
use crate::geometry::Vector;

/// Corners of a way at which blocks are laid, and so many ways to begin that are tried.
const CORNERS: usize = 400;
const ENTRIES: usize = 5;

impl Walk<'_> {
    /// Where a pass may begin with some blocks, the likeliest first: for each of some places where the program may lie with
    /// the first of them that begins on the way there, and goes on along it; then, for a program that counts from block to block,
    /// where a block lies at a corner of the way and the next ones follow, as near as may be: only what leads there may be
    /// wrong; at last with one that follows alone.
    pub(super) fn entries(
        &self,
        blocks: &[usize],
        places: &[Vector],
        is_part: bool,
        anywhere: bool,
    ) -> Vec<(usize, At)> {
        let is_cut = |index: &usize| self.segment(*index).is_some();
        let blocks: Vec<usize> = blocks.iter().copied().filter(is_cut).collect();
        let begun = |shift: &Vector| -> Vec<(usize, At)> {
            let of_block = |index: &usize| Some((*index, self.begun(*index, *shift)?));
            blocks.iter().filter_map(of_block).collect()
        };
        let begun: Vec<Vec<(usize, At)>> = places.iter().map(begun).collect();
        let good = begun.iter().filter_map(|of_place| {
            let mut all = of_place.iter();
            all.find(|(index, at)| self.begins(*index, *at, is_part))
        });
        let mut all: Vec<(usize, At)> = Vec::new();
        for (index, at) in good.copied() {
            let is_known = |(other, _): &(usize, At)| *other == index;
            if !all.iter().any(is_known) {
                all.push((index, at));
            }
        }
        let has_good = !all.is_empty();
        all.sort_by_key(|(index, _)| *index);
        if let (true, false, Some(shift)) = (anywhere && self.is_relative, is_part, places.first())
        {
            let mut near = self.near_corners(&blocks);
            // Of several at one place the first.
            let away =
                |(index, at): &(usize, At)| ((at.shift - shift).norm().round() as u64, *index);
            near.sort_by_key(away);
            for (index, at) in near {
                let is_known = |(_, other): &(usize, At)| (other.shift - at.shift).norm() <= 1.0;
                if all.len() < ENTRIES && !all.iter().any(is_known) && self.begins(index, at, false)
                {
                    all.push((index, at));
                }
            }
        }
        if !has_good {
            let mut begun = begun.into_iter().flatten();
            all.extend(begun.find(|(index, at)| self.follow(*index, *at).is_some()));
        }
        all
    }

    /// Some blocks at all corners of the way.
    fn near_corners(&self, blocks: &[usize]) -> Vec<(usize, At)> {
        let mut near = Vec::new();
        for &index in blocks {
            for piece in self.ring.pieces.iter().take(CORNERS) {
                near.extend(
                    self.laid(index, piece.before, piece)
                        .into_iter()
                        .map(|at| (index, at)),
                );
            }
        }
        near.retain(|(index, at)| self.budget.take(2) && self.follow(*index, *at).is_some());
        near
    }

    /// Where the way is complete that is begun at a place.
    pub(super) fn complete(&self, at: At) -> f64 {
        let from = if self.ring.closed { at.along } else { 0.0 };
        from + self.ring.length - COVERED
    }

    /// The place on the way where a block begins.
    fn begun(&self, index: usize, shift: Vector) -> Option<At> {
        if !self.budget.take(self.ring.pieces.len()) {
            return None;
        }
        let start = self.segment(index)?.start() + shift;
        let (along, away) = self
            .ring
            .nearest(start, 0.0, self.ring.length * (1.0 - 1e-12))?;
        // A machine that counts has drifted there.
        let (reach, drift) = match self.counts {
            true => (2.0 * self.within, self.place(along) - start),
            false => (self.within, Vector::zeros()),
        };
        (away <= reach).then_some(At {
            along,
            shift: shift + drift,
        })
    }

    /// A block goes on along the way; it may be the wrong one itself.
    fn begins(&self, index: usize, at: At, is_part: bool) -> bool {
        let complete = self.complete(at);
        match self.follow(index, at) {
            Some(along) => {
                let Some(next) = self.next(index + 1) else {
                    return true;
                };
                let behind = At { along, ..at };
                is_part
                    || along >= complete
                    || self.follow(next, behind).is_some()
                    || self.resume(next, behind, Some(index), complete).is_some()
            }
            None => self.runs_along(index, at) && self.resume(index, at, None, complete).is_some(),
        }
    }
}
