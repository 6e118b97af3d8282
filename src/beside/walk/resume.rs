//! Whether and where a run goes on after a block that does not follow.

use super::super::placement::{Placement, Reached, stretch};
use super::super::rounds::Spot;
use super::super::traced::Motion;
use super::super::{BETWEEN, REACH};
use super::{Kind, NEAR, Run, SURE, Walk};

/// The most blocks and pieces that are skipped to find the continuation.
const PASSED: usize = 8;
/// Blocks that are read to find the end of a piece that several of them share.
const SPLIT: usize = 400;

/// How a run goes on after a block that does not follow.
struct Resumed {
    /// Of the blocks and the pieces that are skipped the more.
    size: usize,
    blocks: usize,
    pieces: usize,
    spot: Spot,
    placement: Placement,
    off: f64,
}

impl Walk<'_> {
    /// Continues a run after a block that does not follow, and names it. Returns the block to go on with; `None` where
    /// nothing follows.
    pub(super) fn resume(&mut self, run: &mut Run, index: usize) -> Option<usize> {
        if run.complete {
            return None;
        }
        let mut ways = vec![run.spot];
        while ways.len() <= PASSED {
            match ways.last().and_then(|spot| self.rounds.next(spot)) {
                Some(next) => ways.push(next),
                None => break,
            }
        }
        let mut turns: Option<bool> = None;
        let cut = |nth: &usize| {
            self.traced
                .blocks
                .get(*nth)
                .and_then(|block| block.segment())
        };
        let cuts = (index..index + PASSED)
            .take_while(|nth| cut(nth).is_some() && !self.is_switched(index, *nth))
            .count();
        // All that is left of a pass, taken to be moved as a whole.
        let mut moved: Option<Resumed> = None;
        for (blocks, pieces) in choices(cuts, ways.len(), run.passed != Some(index)) {
            let size = blocks.max(pieces);
            if moved.as_ref().is_some_and(|moved| size > moved.size + 1) {
                break;
            }
            let last = index + blocks;
            let end = match blocks.checked_sub(1) {
                Some(before) => cut(&(index + before))?.end(),
                None => cut(&index)?.start(),
            };
            let mut spot = ways[pieces];
            if pieces > 0 && blocks > 1 {
                // It may come back to the drawing within a piece, where a tab begins.
                let near = self.rounds.near(self.placement.place(end), REACH);
                let within = near.iter().find(|near| {
                    (near.round, near.piece, near.back) == (spot.round, spot.piece, spot.back)
                });
                spot = within.copied().unwrap_or(spot);
            }
            let miss = self.placement.place(end) - spot.at;
            for is_back in [true, false] {
                let placement = match is_back {
                    true if miss.norm() > REACH => continue,
                    true => self.placement,
                    false if moved.is_some() => continue,
                    false => self.placement.moved(miss),
                };
                let (count, ends) = self.verify(placement, spot, run.entry, last, SURE);
                let is_back_at_stop = is_back && ends && spot.at != ways[pieces].at;
                if count < SURE && !(ends && count >= 1 || is_back_at_stop) {
                    continue;
                }
                // Little speaks for it, and something for another pass or a tab.
                if count < SURE
                    && *turns.get_or_insert_with(|| self.turns(&self.placement, &run.spot, index))
                {
                    return None;
                }
                let off = match blocks {
                    1 => miss.norm(),
                    _ => self.off(&self.placement, run, index),
                };
                let resumed = Resumed {
                    size,
                    blocks,
                    pieces,
                    spot,
                    placement,
                    off,
                };
                if count < SURE && !is_back && self.switches(last) {
                    moved = Some(resumed);
                    continue;
                }
                return Some(self.go_on(run, index, &ways, resumed));
            }
        }
        moved.map(|moved| self.go_on(run, index, &ways, moved))
    }

    /// Whether the correction is switched soon after a block, before any stop.
    fn switches(&self, index: usize) -> bool {
        let blocks = self.traced.blocks.iter().skip(index).take(SURE + 1);
        let mut blocks = blocks.take_while(|block| block.segment().is_some());
        let first = blocks.next();
        blocks.any(|block| first.is_some_and(|first| first.stretch != block.stretch))
    }

    /// Names the block at which a run is interrupted. Returns the block to go on with.
    fn go_on(&mut self, run: &mut Run, index: usize, ways: &[Spot], resumed: Resumed) -> usize {
        let last = index + resumed.blocks;
        self.name(run, index, resumed.off, Kind::Block);
        (index..last).for_each(|block| self.walked.runs[block] = true);
        self.pass(run, &ways[1..=resumed.pieces], resumed.spot);
        self.placement = resumed.placement;
        run.passed = (resumed.blocks == 0).then_some(index);
        last
    }

    /// Takes the way of a run over the beginnings of these pieces to a spot on the last of them.
    fn pass(&mut self, run: &mut Run, begins: &[Spot], to: Spot) {
        for next in begins {
            let length = self.rounds.rest(&run.spot).length();
            self.cover(&run.spot, length);
            run.travelled += length;
            run.spot = *next;
        }
        let within = self.rounds.rest(&run.spot).length() - self.rounds.rest(&to).length();
        if within > 0.0 {
            self.cover(&run.spot, within);
            run.travelled += within;
        }
        run.spot = to;
    }

    /// The distance of a block's end from that of the piece which it should follow.
    pub(super) fn off(&self, placement: &Placement, run: &Run, index: usize) -> f64 {
        let Some(segment) = self.traced.blocks[index].segment() else {
            return 0.0;
        };
        // It may stand for several pieces.
        let end = placement.place(segment.end());
        let (mut spot, mut off) = (run.spot, f64::INFINITY);
        for _ in 0..4 {
            let (rest, next) = stretch(self.rounds, &spot, &run.entry);
            off = off.min((end - rest.end()).norm());
            match next {
                Some(next) if next != run.entry => spot = next,
                _ => break,
            }
        }
        off
    }

    /// The block after those that share a piece of the drawing with the one at `index`, which ends within it; `None`
    /// where they do not reach its end, a stop or another pass.
    pub(super) fn split_ends(
        &self,
        placement: &Placement,
        run: &Run,
        reached: &Reached,
        index: usize,
    ) -> Option<usize> {
        let (mut placement, mut spot) = (*placement, reached.spot?);
        let mut length = reached.length;
        for next in index + 1..self.traced.blocks.len().min(index + SPLIT) {
            match self.traced.blocks[next].motion {
                Motion::Stop => return Some(next),
                Motion::Way(..) => return None,
                Motion::Cut(_) => {}
            }
            let followed = placement.follow(self.rounds, self.traced, next, &spot, &run.entry);
            let Some(further) = followed else {
                if self.is_switched(index, next) {
                    return Some(next);
                }
                return self.turns(&placement, &spot, next).then_some(next);
            };
            length += further.length;
            if further.whole || self.covers_all(run, length) {
                return Some(next);
            }
            spot = further.spot?;
        }
        None
    }

    /// Whether another pass, or the way back, begins at a block or after a few that lead to it.
    pub(super) fn turns(&self, placement: &Placement, spot: &Spot, index: usize) -> bool {
        for next in index..self.traced.blocks.len().min(index + BETWEEN + 1) {
            let block = &self.traced.blocks[next];
            if self.is_switched(index, next) {
                return false;
            }
            let Motion::Cut(segment) = &block.motion else {
                if matches!(block.motion, Motion::Stop) {
                    continue;
                }
                return false;
            };
            let near = self.rounds.near(placement.place(segment.start()), REACH);
            let other = |near: &&Spot| (near.round, near.back) != (spot.round, spot.back);
            if near
                .iter()
                .filter(other)
                .any(|near| self.begins(placement, near, next).is_some())
            {
                return true;
            }
        }
        false
    }

    /// Whether a block before the run begins about where this one ends: it was the first of its contour, which returns
    /// there.
    pub(super) fn begins_before(
        &self,
        placement: &Placement,
        run: &Run,
        reached: &Reached,
    ) -> bool {
        let Some(spot) = reached.spot else {
            return false;
        };
        let left = self.rounds.rest(&spot).length();
        self.before(run).any(|before| {
            let start = self.traced.blocks[before]
                .segment()
                .map(|own| placement.place(own.start()));
            start.is_some_and(|start| (start - spot.at).norm() < left.min(NEAR))
        })
    }

    /// Blocks right before a run that follow nothing, the nearest first.
    pub(super) fn before(&self, run: &Run) -> impl Iterator<Item = usize> {
        (1..=BETWEEN)
            .map_while(|back| run.first.checked_sub(back))
            .take_while(|&before| self.traced.blocks[before].segment().is_some())
            .take_while(|&before| !self.walked.runs[before])
            .take_while(|&before| !self.is_switched(before, run.first))
    }
}

/// The numbers of blocks and pieces to skip, the likeliest first: few of both, and as many of the one as of the other.
/// Pieces without blocks are skipped only where they `may_be_missing`.
fn choices(blocks: usize, pieces: usize, may_be_missing: bool) -> Vec<(usize, usize)> {
    let mut choices: Vec<(usize, usize)> = (0..=blocks)
        .flat_map(|blocks| (0..pieces).map(move |pieces| (blocks, pieces)))
        .filter(|&(blocks, pieces)| blocks > 0 || pieces > 0 && may_be_missing)
        .collect();
    choices.sort_by_key(|&(blocks, pieces)| {
        let size = blocks.max(pieces);
        (size, blocks != pieces, blocks.abs_diff(pieces), blocks)
    });
    choices
}
