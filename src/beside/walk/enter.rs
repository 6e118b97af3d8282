//! The start of a run: a block that lies on the drawing, with others after it that continue there.

use super::super::matching::{Found, matching};
use super::super::placement::Placement;
use super::super::rounds::Spot;
use super::super::traced::{Block, Motion};
use super::super::{BETWEEN, COVERED, REACH};
use super::{Run, SURE, Walk};

impl Walk<'_> {
    /// A run that begins with a block.
    pub(super) fn enter(&mut self, index: usize) -> Option<Run> {
        let segment = *self.traced.blocks[index].segment()?;
        if self.comes_by_arcs(index) {
            self.placement = self.placement.unsurely();
        }
        let mut best: Option<(usize, Found)> = None;
        let mut consider = |count: usize, found: Found| {
            if best.as_ref().is_none_or(|(most, _)| count > *most) {
                best = Some((count, found));
            }
        };
        for spot in self
            .rounds
            .near(self.placement.place(segment.start()), REACH)
        {
            if let Some(count) = self.begins(&self.placement, &spot, index) {
                let found = Found {
                    spot,
                    placement: self.placement,
                };
                consider(count, found);
            }
        }
        let (mut moved, mut is_first) = (None, false);
        if best.is_none() {
            let found = matching(self.rounds, self.traced, index, &self.placement)
                .into_iter()
                .filter(|found| {
                    let (count, ends) =
                        self.verify(found.placement, found.spot, found.spot, index, SURE);
                    count >= 2 || ends && self.is_circle(&found.spot)
                })
                .min_by(|a, b| {
                    let away =
                        |found: &Found| (found.placement.shift - self.placement.shift).norm();
                    away(a).total_cmp(&away(b))
                });
            if let Some(found) = found {
                let by = found.placement.shift - self.placement.shift;
                // The place of the program was found from its first contour, or from one after that.
                is_first = self.walked.contours.is_empty();
                moved = (by.norm() > REACH).then_some(by);
                best = Some((0, found));
            }
        }
        let (
            _,
            Found {
                mut spot,
                placement,
            },
        ) = best?;
        let mut first = index;
        if moved.is_some() {
            // The blocks before looked like a lead.
            for before in (1..=2).filter_map(|back| index.checked_sub(back)) {
                let Some(own) = self.traced.blocks[before].segment() else {
                    break;
                };
                if self.walked.runs[before] || self.is_switched(before, index) {
                    break;
                }
                let near = self.rounds.near(placement.place(own.start()), REACH);
                let leads = |near: &&Spot| {
                    near.round == spot.round
                        && self.verify(placement, **near, **near, before, SURE).0 >= 2
                };
                if let Some(near) = near.iter().find(leads) {
                    (first, spot) = (before, *near);
                }
            }
        }
        if self.is_all_cut(spot.round) {
            self.lap(spot.round);
        }
        if moved.is_some() {
            self.placement = placement;
        }
        let moved = moved.filter(|_| !is_first);
        Some(Run {
            first,
            entry: spot,
            spot,
            travelled: 0.0,
            complete: false,
            split: 0,
            passed: None,
            moved,
        })
    }

    /// Whether a counting arc leads to a block beside the drawing.
    fn comes_by_arcs(&self, index: usize) -> bool {
        let before = (0..index)
            .rev()
            .take_while(|&before| !self.walked.runs[before]);
        let mut blocks = before
            .map(|before| &self.traced.blocks[before])
            .take(BETWEEN);
        let is_arc = |block: &Block| block.segment().is_some_and(|own| own.as_arc().is_some());
        self.traced.counts && blocks.any(is_arc)
    }

    /// The block ends where a piece does.
    pub(super) fn is_whole(&self, spot: &Spot, index: usize) -> bool {
        let mut placement = self.placement;
        let reached = placement.follow(self.rounds, self.traced, index, spot, spot);
        reached.is_some_and(|reached| reached.whole)
    }

    /// The evidence for a run that begins with a block at a spot; `None` where it may be a way there, or away.
    pub(super) fn begins(&self, placement: &Placement, spot: &Spot, index: usize) -> Option<usize> {
        let (count, ends) = self.verify(*placement, *spot, *spot, index, SURE);
        let is_rest = || !self.is_cut(spot) && !self.covered[spot.round].is_empty();
        let is_run = count >= 2 || count >= 1 && (ends || self.is_whole(spot, index) || is_rest());
        is_run.then_some(2 * count + usize::from(ends))
    }

    pub(super) fn is_circle(&self, spot: &Spot) -> bool {
        self.rounds.rounds[spot.round].circle.is_some()
    }

    /// Follows from a spot on, at most this many blocks: how many follow, and whether the contour or the program's cut
    /// ends after them.
    pub(in crate::beside) fn verify(
        &self,
        mut placement: Placement,
        from: Spot,
        entry: Spot,
        index: usize,
        most: usize,
    ) -> (usize, bool) {
        let (mut spot, mut count, mut length) = (from, 0, 0.0);
        let mut stop = None;
        let round = &self.rounds.rounds[from.round];
        for next in index..self.traced.blocks.len() {
            match self.traced.blocks[next].motion {
                Motion::Stop => {
                    stop = Some(count);
                    continue;
                }
                Motion::Way(..) => return (count, true),
                Motion::Cut(_) => {}
            }
            let followed = placement.follow(self.rounds, self.traced, next, &spot, &entry);
            let Some(reached) = followed else {
                return (
                    count,
                    stop == Some(count) || count > 0 && self.leads_out(next),
                );
            };
            count += 1;
            length += reached.length;
            match reached.spot {
                Some(further) if count < most => spot = further,
                Some(_) => return (count, false),
                None => return (count, true),
            }
            if length >= round.length - COVERED || reached.whole && spot == entry {
                return (count, true);
            }
        }
        (count, true)
    }

    /// Whether a block and one more at most are the last before a stop, or before the correction is switched on or
    /// off, or the first after that.
    pub(super) fn leads_out(&self, index: usize) -> bool {
        if index > 0 && self.is_switched(index - 1, index) {
            return true;
        }
        let behind = self.traced.blocks[index..].iter();
        let is_cut = |block: &&Block| block.segment().is_some();
        behind.take_while(is_cut).count() <= 2
    }
}
