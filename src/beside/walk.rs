//! Along a program and the rounds of its drawing at once.
//!
//! A run follows a round from where the program comes to it. A block that does not is named, and the run goes on behind it from where
//! the program stands, or from where it comes back to the drawing: one change is one difference. What leads to a run and away from it is
//! not looked at. Where a run ends although its contour goes on, that waits for the end: a tab may be cut later.

use super::matching::{Found, matching};
use super::pose::{Pose, Reached, stretch};
use super::rounds::{Rounds, Spot};
use super::traced::{Block, Motion, Traced};
use super::{BETWEEN, COVERED, REACH, TOLERANCE};
use crate::drawing::EntityId;
use crate::geometry::Vector;
use std::ops::Range;

/// A block that does not follow, by its index.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Unlike {
    pub block: usize,
    pub source: Option<(EntityId, usize)>,
    /// How far it is off, µm.
    pub off: f64,
    pub kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The block leads elsewhere than its segment.
    Block,
    /// Its contour begins elsewhere.
    Moved,
    /// The contour goes on where the program does not.
    Unfinished,
    /// No contour of the drawing is like this.
    Foreign,
}

/// What came of a walk.
#[derive(Debug, Default)]
pub(super) struct Walked {
    pub unlike: Vec<Unlike>,
    /// Of each block: it is part of a run, or of what was named in one.
    pub runs: Vec<bool>,
    /// The blocks that end where the drawing says.
    pub follows: Vec<usize>,
    /// Contours that were followed.
    pub contours: Vec<usize>,
}

/// Blocks that have to follow so that others before them are taken as changed.
const SURE: usize = 3;
/// Blocks and pieces that are passed over to find on, at most.
const PASSED: usize = 8;
/// Blocks that are looked at for the end of a piece that several of them are on.
const SPLIT: usize = 400;
/// How far a wrong first block of a contour may lie from where the contour comes back to it, µm.
const NEAR: f64 = 1_000.0;

#[derive(Clone, Debug)]
struct Run {
    first: usize,
    entry: Spot,
    spot: Spot,
    travelled: f64,
    /// It has come round.
    complete: bool,
    /// Blocks up to here are on one piece, as has been seen.
    split: usize,
    /// The block before which pieces were passed over last: not twice, or there is no end.
    passed: Option<usize>,
    /// Before it began, and how far it lies beside that.
    moved: Option<Vector>,
}

/// A run that ended before its contour did.
#[derive(Debug)]
struct Loose {
    run: Run,
    /// The first block behind it, or its last one where there is no other.
    block: usize,
    is_behind: bool,
    pose: Pose,
}

pub(super) struct Walk<'a> {
    traced: &'a Traced,
    rounds: &'a Rounds,
    pose: Pose,
    /// Of each round the stretches that have been cut.
    covered: Vec<Vec<Range<f64>>>,
    /// The same of all laps and passes.
    cuts: Vec<Vec<Range<f64>>>,
    loose: Vec<Loose>,
    /// Runs that begin beside where the drawing has them.
    moved: Vec<Run>,
    walked: Walked,
}

impl<'a> Walk<'a> {
    pub fn new(traced: &'a Traced, rounds: &'a Rounds, pose: Pose) -> Walk<'a> {
        Walk {
            traced,
            rounds,
            pose,
            covered: vec![Vec::new(); rounds.rounds.len()],
            cuts: vec![Vec::new(); rounds.rounds.len()],
            loose: Vec::new(),
            moved: Vec::new(),
            walked: Walked {
                runs: vec![false; traced.blocks.len()],
                ..Walked::default()
            },
        }
    }

    /// `tabs`: what may be left standing, µm.
    pub fn go(mut self, tabs: &[f64]) -> Walked {
        let mut run: Option<Run> = None;
        let (mut index, mut tried) = (0, 0);
        // Each block is gone back before once.
        let mut gone_back = 0;
        while let Some(block) = self.traced.blocks.get(index) {
            match block.motion {
                Motion::Stop => {
                    index += 1;
                    continue;
                }
                Motion::Way(..) => {
                    self.leave(run.take(), index, false);
                    index += 1;
                    continue;
                }
                Motion::Cut(_) => {}
            }
            if let Some(open) = &mut run {
                if self.step(open, index) {
                    index += 1;
                    continue;
                }
                if open.first == index {
                    // Its first block ends where nothing goes on.
                    run = None;
                    index = tried + 1;
                    continue;
                }
                match self.resume(open, index) {
                    Some(behind) => {
                        index = behind;
                        continue;
                    }
                    None => self.leave(run.take(), index, true),
                }
            }
            tried = index;
            run = self.enter(index);
            // It may begin before the block that showed where it lies.
            index = run.as_ref().map_or(index + 1, |run| run.first);
            if index < tried && tried < gone_back {
                (run, index) = (None, tried + 1);
            }
            gone_back = gone_back.max(tried + 1);
        }
        self.leave(run, self.traced.blocks.len(), false);
        // All laps together: a tab is cut in several.
        self.covered.clone_from(&self.cuts);
        self.settle(tabs);
        self.walked.unlike.sort_by_key(|unlike| unlike.block);
        self.walked
    }

    /// Lets a run go on by one block; false where that does not follow.
    fn step(&mut self, run: &mut Run, index: usize) -> bool {
        let mut pose = self.pose;
        let Some(reached) = pose.follow(self.rounds, self.traced, index, &run.spot, &run.entry)
        else {
            return false;
        };
        let is_chord = self.traced.blocks[index]
            .segment()
            .is_some_and(|own| own.as_arc().is_none())
            && self.rounds.piece(&run.spot).segment.as_arc().is_some();
        if !reached.whole && !run.complete && !is_chord && index >= run.split {
            let behind = self.covers_all(run, reached.length);
            match self.split_ends(&pose, run, &reached, index) {
                Some(end) => run.split = end,
                None if behind || self.begins_before(&pose, run, &reached) => {}
                None => return false,
            }
        }
        self.pose = pose;
        self.take(run, &reached, index);
        true
    }

    /// Whether a block before the run begins about where this one ends: it was the first of its contour, which comes back to there.
    fn begins_before(&self, pose: &Pose, run: &Run, reached: &Reached) -> bool {
        let Some(spot) = reached.spot else {
            return false;
        };
        let left = self.rounds.rest(&spot).length();
        self.before(run).any(|before| {
            let start = self.traced.blocks[before]
                .segment()
                .map(|own| pose.place(own.start()));
            start.is_some_and(|start| (start - spot.at).norm() < left.min(NEAR))
        })
    }

    /// Blocks right before a run that follow nothing, the nearest first.
    fn before(&self, run: &Run) -> impl Iterator<Item = usize> {
        (1..=BETWEEN)
            .map_while(|back| run.first.checked_sub(back))
            .take_while(|&before| self.traced.blocks[before].segment().is_some())
            .take_while(|&before| !self.walked.runs[before])
    }

    /// Notes what a block has cut.
    fn take(&mut self, run: &mut Run, reached: &Reached, index: usize) {
        self.walked.runs[index] = true;
        // How far it goes on past its start, and where a tab begins, is the program's own.
        if reached.whole && !run.complete {
            self.walked.follows.push(index);
        }
        self.cover(&run.spot, reached.length);
        run.travelled += reached.length;
        run.complete |= self.is_covered(run);
        match reached.spot {
            Some(spot) => run.spot = spot,
            // An open round has no other end.
            None => run.complete = true,
        }
        let goes_on = || {
            let begins = [run.entry, run.spot];
            reached.whole
                && begins[0] == begins[1]
                && self
                    .verify(self.pose, run.spot, run.entry, index + 1, SURE)
                    .0
                    >= SURE
        };
        if run.complete && goes_on() {
            // Once more round in one go: a lap of its own.
            self.lap(run.spot.round);
            (run.travelled, run.complete) = (0.0, false);
        }
    }

    fn lap(&mut self, round: usize) {
        self.covered[round].clear();
    }

    /// The block behind those that share a piece of the drawing with the one at `index`, which ends within it; `None` where they do not
    /// come to its end, nor to a stop or another pass.
    fn split_ends(&self, pose: &Pose, run: &Run, reached: &Reached, index: usize) -> Option<usize> {
        let (mut pose, mut spot) = (*pose, reached.spot?);
        let mut length = reached.length;
        for next in index + 1..self.traced.blocks.len().min(index + SPLIT) {
            match self.traced.blocks[next].motion {
                Motion::Stop => return Some(next),
                Motion::Way(..) => return None,
                Motion::Cut(_) => {}
            }
            let followed = pose.follow(self.rounds, self.traced, next, &spot, &run.entry);
            let Some(further) = followed else {
                return self.turns(&pose, &spot, next).then_some(next);
            };
            length += further.length;
            if further.whole || self.covers_all(run, length) {
                return Some(next);
            }
            spot = further.spot?;
        }
        None
    }

    /// Follows from a spot on, at most so many blocks: how many do, and whether the contour or the program's cut ends behind them.
    pub(super) fn verify(
        &self,
        mut pose: Pose,
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
            let followed = pose.follow(self.rounds, self.traced, next, &spot, &entry);
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

    /// Whether a block and one more at most are the last before a stop.
    fn leads_out(&self, index: usize) -> bool {
        let behind = self.traced.blocks[index..].iter();
        behind.take_while(|block| block.segment().is_some()).count() <= 2
    }

    /// Whether another pass, or the way back, begins at a block or behind a few that lead to it.
    fn turns(&self, pose: &Pose, spot: &Spot, index: usize) -> bool {
        for next in index..self.traced.blocks.len().min(index + BETWEEN + 1) {
            let block = &self.traced.blocks[next];
            let Motion::Cut(segment) = &block.motion else {
                if matches!(block.motion, Motion::Stop) {
                    continue;
                }
                return false;
            };
            let near = self.rounds.near(pose.place(segment.start()), REACH);
            let other = |near: &&Spot| (near.round, near.back) != (spot.round, spot.back);
            if near
                .iter()
                .filter(other)
                .any(|near| self.begins(pose, near, next).is_some())
            {
                return true;
            }
        }
        false
    }

    /// Goes on with a run behind a block that does not follow, and names it. The block to go on with; `None` where nothing follows.
    fn resume(&mut self, run: &mut Run, index: usize) -> Option<usize> {
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
            .take_while(|nth| cut(nth).is_some())
            .count();
        let mut choices: Vec<(usize, usize)> = (0..=cuts)
            .flat_map(|blocks| (0..ways.len()).map(move |pieces| (blocks, pieces)))
            .filter(|&(blocks, pieces)| blocks > 0 || pieces > 0 && run.passed != Some(index))
            .collect();
        choices.sort_by_key(|&(blocks, pieces)| {
            let size = blocks.max(pieces);
            (size, blocks != pieces, blocks.abs_diff(pieces), blocks)
        });
        for (blocks, pieces) in choices {
            let last = index + blocks;
            let end = match blocks.checked_sub(1) {
                Some(before) => cut(&(index + before))?.end(),
                None => cut(&index)?.start(),
            };
            let mut spot = ways[pieces];
            if pieces > 0 && blocks > 1 {
                // It may come back to the drawing within a piece, where a tab begins.
                let near = self.rounds.near(self.pose.place(end), REACH);
                let within = near.iter().find(|near| {
                    (near.round, near.piece, near.back) == (spot.round, spot.piece, spot.back)
                });
                spot = within.copied().unwrap_or(spot);
            }
            let miss = self.pose.place(end) - spot.at;
            for by in [Vector::zeros(), miss] {
                let is_back = by == Vector::zeros();
                if is_back && miss.norm() > REACH {
                    continue;
                }
                let pose = if is_back {
                    self.pose
                } else {
                    self.pose.moved(by)
                };
                let (count, ends) = self.verify(pose, spot, run.entry, last, SURE);
                let is_back_at_stop = is_back && ends && spot.at != ways[pieces].at;
                if count < SURE && !(ends && count >= 1 || is_back_at_stop) {
                    continue;
                }
                // Little speaks for it, and something for another pass or a tab.
                if count < SURE
                    && *turns.get_or_insert_with(|| self.turns(&self.pose, &run.spot, index))
                {
                    return None;
                }
                let off = match blocks {
                    1 => miss.norm(),
                    _ => self.off(&self.pose, run, index),
                };
                self.name(run, index, off, Kind::Block);
                (index..last).for_each(|block| self.walked.runs[block] = true);
                let mut gone = run.spot;
                for next in &ways[1..=pieces] {
                    let length = self.rounds.rest(&gone).length();
                    self.cover(&gone, length);
                    run.travelled += length;
                    gone = *next;
                }
                let within = self.rounds.rest(&gone).length() - self.rounds.rest(&spot).length();
                if within > 0.0 {
                    self.cover(&gone, within);
                    run.travelled += within;
                }
                self.pose = pose;
                run.spot = spot;
                run.passed = (blocks == 0).then_some(index);
                return Some(last);
            }
        }
        None
    }

    /// How far the end of a block lies from that of the piece which it should follow.
    fn off(&self, pose: &Pose, run: &Run, index: usize) -> f64 {
        let Some(segment) = self.traced.blocks[index].segment() else {
            return 0.0;
        };
        // It may stand for several pieces.
        let end = pose.place(segment.end());
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

    fn name(&mut self, run: &Run, block: usize, off: f64, kind: Kind) {
        let source = self.rounds.piece(&run.spot).source;
        self.walked.unlike.push(Unlike {
            block,
            source,
            off,
            kind,
        });
    }

    /// A run ends; what has not been cut of its contour is looked at when all has been gone along.
    fn leave(&mut self, run: Option<Run>, index: usize, is_behind: bool) {
        let Some(run) = run else { return };
        self.walked
            .contours
            .push(self.rounds.rounds[run.spot.round].contour);
        if run.complete {
            self.moved.extend(run.moved.is_some().then_some(run));
            return;
        }
        self.loose.push(Loose {
            block: if is_behind {
                index
            } else {
                index.saturating_sub(1)
            },
            is_behind,
            pose: self.pose,
            run,
        });
    }

    /// A run that begins with a block.
    fn enter(&mut self, index: usize) -> Option<Run> {
        let segment = *self.traced.blocks[index].segment()?;
        if self.comes_by_arcs(index) {
            self.pose = self.pose.unsurely();
        }
        let mut best: Option<(usize, Found)> = None;
        let mut consider = |count: usize, found: Found| {
            if best.as_ref().is_none_or(|(most, _)| count > *most) {
                best = Some((count, found));
            }
        };
        for spot in self.rounds.near(self.pose.place(segment.start()), REACH) {
            if let Some(count) = self.begins(&self.pose, &spot, index) {
                let found = Found {
                    spot,
                    pose: self.pose,
                };
                consider(count, found);
            }
        }
        let (mut moved, mut is_first) = (None, false);
        if best.is_none() {
            let found = matching(self.rounds, self.traced, index, &self.pose)
                .into_iter()
                .filter(|found| {
                    let (count, ends) =
                        self.verify(found.pose, found.spot, found.spot, index, SURE);
                    count >= 2 || ends && self.is_circle(&found.spot)
                })
                .min_by(|a, b| {
                    let away = |found: &Found| (found.pose.shift - self.pose.shift).norm();
                    away(a).total_cmp(&away(b))
                });
            if let Some(found) = found {
                let by = found.pose.shift - self.pose.shift;
                // Where the program lies was found by its first contour, or one behind that.
                is_first = self.walked.contours.is_empty();
                moved = (by.norm() > REACH).then_some(by);
                best = Some((0, found));
            }
        }
        let (_, Found { mut spot, pose }) = best?;
        let mut first = index;
        if moved.is_some() {
            // What came before could not be told from a lead.
            for before in (1..=2).filter_map(|back| index.checked_sub(back)) {
                let Some(own) = self.traced.blocks[before].segment() else {
                    break;
                };
                if self.walked.runs[before] {
                    break;
                }
                let near = self.rounds.near(pose.place(own.start()), REACH);
                let leads = |near: &&Spot| {
                    near.round == spot.round
                        && self.verify(pose, **near, **near, before, SURE).0 >= 2
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
            self.pose = pose;
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

    /// Whether an arc that counts leads to a block beside the drawing.
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
    fn is_whole(&self, spot: &Spot, index: usize) -> bool {
        let mut pose = self.pose;
        let reached = pose.follow(self.rounds, self.traced, index, spot, spot);
        reached.is_some_and(|reached| reached.whole)
    }

    /// How much speaks for a run that begins with a block at a spot; `None` where it may lead there, or away.
    fn begins(&self, pose: &Pose, spot: &Spot, index: usize) -> Option<usize> {
        let (count, ends) = self.verify(*pose, *spot, *spot, index, SURE);
        let is_rest = || !self.is_cut(spot) && !self.covered[spot.round].is_empty();
        let is_run = count >= 2 || count >= 1 && (ends || self.is_whole(spot, index) || is_rest());
        is_run.then_some(2 * count + usize::from(ends))
    }

    fn is_circle(&self, spot: &Spot) -> bool {
        self.rounds.rounds[spot.round].circle.is_some()
    }

    /// Names what is wrong where runs ended before their contours did.
    fn settle(&mut self, tabs: &[f64]) {
        for loose in std::mem::take(&mut self.loose) {
            let Loose {
                run,
                block,
                is_behind,
                pose,
            } = loose;
            let gap = self.uncut_from(&run.spot);
            // A tab is cut behind a stop, or by hand.
            let own = |cut: &&[Range<usize>; 2]| cut[0].contains(&run.first);
            let stops = self.traced.cuts.iter().find(own).is_some_and(|[all, _]| {
                let mut blocks = self.traced.blocks[all.clone()].iter();
                blocks.any(|block| block.motion == Motion::Stop)
            });
            let is_cut = if stops {
                gap <= COVERED
            } else {
                let is_tab = |tab: &f64| *tab > 0.0 && (gap - tab).abs() <= 500.0;
                self.is_cut_as_often(&run.spot) || tabs.iter().any(is_tab)
            };
            if is_cut {
                self.moved.extend(run.moved.is_some().then_some(run));
                continue;
            }
            // Up to where the run began? Then a block before it may be the one.
            let entry = run.entry;
            let ahead = self.rounds.ahead(&run.spot, &entry);
            let own = self.off(&pose, &run, block);
            let of_block = is_behind.then_some(own);
            let before = self
                .before(&run)
                .filter_map(|before| {
                    let start = self.traced.blocks[before].segment()?.start();
                    let shift = run.moved.unwrap_or_default();
                    let away = |by: Vector| (pose.place(start) + by - run.spot.at).norm();
                    Some((before, away(Vector::zeros()).min(away(shift))))
                })
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .filter(|_| gap <= COVERED || (ahead - gap).abs() <= COVERED + 1.0);
            // All but a little before where it began is cut: its first block is that much too short.
            let is_short = gap <= NEAR && gap > COVERED && (ahead - gap).abs() <= COVERED + 1.0;
            let (named, off, kind) = match (before, of_block) {
                (before, _) if is_short && before.is_none_or(|(_, by)| by > COVERED) => {
                    (run.first, gap, Kind::Block)
                }
                (Some((before, by)), other) if other.is_none_or(|other| by < other) => {
                    let (named, off) = self.first_unlike(&run, before);
                    (named, off, Kind::Block)
                }
                // It ends beside the entry by as much as that was: the first block is wrong, or the way to it.
                (_, Some(off)) if run.moved.is_some_and(|by| (by.norm() - off).abs() <= REACH) => {
                    (run.first, off, Kind::Block)
                }
                (_, Some(off)) => (block, off, Kind::Block),
                _ => (block, own.min(gap), Kind::Unfinished),
            };
            self.walked.runs[named] = true;
            self.name(&run, named, off, kind);
        }
        // A change that moves everything behind it has been named where it is.
        let mut changes: Vec<f64> = self.walked.unlike.iter().map(|unlike| unlike.off).collect();
        for run in std::mem::take(&mut self.moved) {
            let by = run.moved.map_or(0.0, |by| by.norm());
            let change = changes.iter().position(|off| (off - by).abs() <= REACH);
            match change {
                Some(change) => {
                    changes.swap_remove(change);
                }
                // Each contour of 4B lies beside the part's by the correction, where its cut begins.
                None if self.traced.four_b => {}
                None => self.name(
                    &Run {
                        spot: run.entry,
                        ..run.clone()
                    },
                    run.first,
                    by,
                    Kind::Moved,
                ),
            }
        }
    }

    /// Of the blocks before a run, from that on which begins where the run came back to, the one that does not follow, and how far it is off.
    fn first_unlike(&self, run: &Run, before: usize) -> (usize, f64) {
        let (mut spot, mut worst) = (run.spot, (before, 0.0));
        for block in before..run.first {
            let Some(own) = self.traced.blocks[block].segment() else {
                break;
            };
            let rest = self.rounds.rest(&spot);
            let off = ((own.end() - own.start()) - (rest.end() - rest.start())).norm();
            if off > worst.1 {
                worst = (block, off);
            }
            if off > REACH {
                break;
            }
            match self.rounds.next(&spot) {
                Some(next) => spot = next,
                None => break,
            }
        }
        worst
    }

    fn cover(&mut self, from: &Spot, length: f64) {
        let (covered, cuts) = (&mut self.covered[from.round], &mut self.cuts[from.round]);
        self.rounds.cover(from, length, |part| {
            cuts.push(part.clone());
            match covered.last_mut() {
                Some(last) if (last.end - part.start).abs() <= 3.0 => last.end = part.end,
                Some(last) if (last.start - part.end).abs() <= 3.0 => last.start = part.start,
                _ => covered.push(part),
            }
        });
    }

    /// Whether what lies right ahead of a spot has been cut as often as most of its round.
    fn is_cut_as_often(&self, spot: &Spot) -> bool {
        const PLACES: usize = 25;
        let length = self.rounds.rounds[spot.round].length;
        let cuts = &self.cuts[spot.round];
        let often = |at: f64| cuts.iter().filter(|part| part.contains(&at)).count();
        let ahead = if spot.back { -COVERED } else { COVERED };
        let here = often((self.rounds.along(spot) + ahead).rem_euclid(length));
        let mut all: Vec<usize> = (0..PLACES)
            .map(|place| often((place as f64 + 0.5) / PLACES as f64 * length))
            .collect();
        all.sort_unstable();
        here >= all[PLACES / 2].max(1)
    }

    /// What of a round has not been cut, in its direction.
    fn uncut(&self, round: usize) -> Vec<Range<f64>> {
        let mut covered = self.covered[round].clone();
        covered.sort_by(|a, b| a.start.total_cmp(&b.start));
        let (mut from, mut uncut) = (0.0, Vec::new());
        for part in covered {
            if part.start > from {
                uncut.push(from..part.start);
            }
            from = part.end.max(from);
        }
        let length = self.rounds.rounds[round].length;
        if from < length {
            uncut.push(from..length);
        }
        uncut.retain(|part| part.end - part.start > COVERED);
        uncut
    }

    fn is_all_cut(&self, round: usize) -> bool {
        !self.covered[round].is_empty() && self.uncut(round).is_empty()
    }

    fn is_cut(&self, spot: &Spot) -> bool {
        self.uncut_from(spot) <= COVERED
    }

    /// How far nothing has been cut from a spot on, µm.
    fn uncut_from(&self, spot: &Spot) -> f64 {
        let length = self.rounds.rounds[spot.round].length;
        let along = self.rounds.along(spot);
        let uncut = self.uncut(spot.round);
        let (mut at, mut found) = (along, 0.0);
        // Across the place where the round begins.
        for _ in 0..2 {
            let holds = |part: &&Range<f64>| {
                if spot.back {
                    part.start < at - 1.0 && at <= part.end + 4.0
                } else {
                    part.start - 4.0 <= at && at < part.end - 1.0
                }
            };
            let Some(part) = uncut.iter().find(holds) else {
                break;
            };
            if spot.back {
                found += at - part.start;
                if part.start > 1.0 {
                    break;
                }
                at = length;
            } else {
                found += part.end - at;
                if part.end < length - 1.0 {
                    break;
                }
                at = 0.0;
            }
        }
        found
    }

    fn covers_all(&self, run: &Run, further: f64) -> bool {
        let length = self.rounds.rounds[run.spot.round].length;
        let is_all = |left: f64| (left - further).abs() <= TOLERANCE;
        is_all(length - run.travelled) || is_all(self.uncut_from(&run.spot))
    }

    fn is_covered(&self, run: &Run) -> bool {
        let length = self.rounds.rounds[run.spot.round].length;
        run.travelled >= length - COVERED
            || (self.covered[run.spot.round].len() > 2 || run.entry.round != run.spot.round)
                && self.is_all_cut(run.spot.round)
    }
}
