//! Names what is wrong where runs ended before their contours did, at the end of the whole program.

use super::super::traced::Motion;
use super::super::{COVERED, REACH};
use super::{Kind, Loose, NEAR, Run, Walk};
use crate::geometry::Vector;
use std::ops::Range;

impl Walk<'_> {
    /// Names what is wrong where runs ended before their contours did.
    pub(super) fn settle(&mut self, tabs: &[f64]) {
        for loose in std::mem::take(&mut self.loose) {
            let Loose {
                run,
                block,
                is_behind,
                placement,
            } = loose;
            let is_lacking = self.is_lacking(&run);
            let gap = match is_lacking {
                true => self.rounds.ahead(&run.spot, &run.entry),
                false => self.uncut_from(&run.spot),
            };
            // A tab is cut after a stop, or by hand.
            let own = |cut: &&[Range<usize>; 2]| cut[0].contains(&run.first);
            let stops = self.traced.cuts.iter().find(own).is_some_and(|[all, _]| {
                let mut blocks = self.traced.blocks[all.clone()].iter();
                blocks.any(|block| block.motion == Motion::Stop)
            });
            let is_cut = if is_lacking {
                false
            } else if stops {
                gap <= COVERED
            } else {
                let is_tab = |tab: &f64| *tab > 0.0 && (gap - tab).abs() <= 500.0;
                self.is_cut_as_often(&run.spot) || tabs.iter().any(is_tab)
            };
            if is_cut {
                self.moved.extend(run.moved.is_some().then_some(run));
                continue;
            }
            // Up to where the run began? Then a block before it may be the wrong one.
            let entry = run.entry;
            let ahead = if self.rounds.rounds[entry.round].closed {
                self.rounds.ahead(&run.spot, &entry)
            } else {
                f64::INFINITY
            };
            let own = self.off(&placement, &run, block);
            let of_block = is_behind.then_some(own);
            let before = self
                .before(&run)
                .filter_map(|before| {
                    let start = self.traced.blocks[before].segment()?.start();
                    let shift = run.moved.unwrap_or_default();
                    let away = |by: Vector| (placement.place(start) + by - run.spot.at).norm();
                    Some((before, away(Vector::zeros()).min(away(shift))))
                })
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .filter(|_| gap <= COVERED || (ahead - gap).abs() <= COVERED + 1.0);
            // Everything is cut except a little before its start: its first block is that much too short.
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
        for run in std::mem::take(&mut self.ended) {
            self.begins_late(&run);
        }
        // A change that moves everything after it has been named where it is.
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

    /// Whether a pass that is not completed has another beside it that is, without a stop between them: what it leaves
    /// is no tab.
    fn is_lacking(&self, run: &Run) -> bool {
        let own = &self.rounds.rounds[run.spot.round];
        let blocks = &self.traced.blocks;
        let is_offset = blocks[run.first].is_offset();
        let others = self
            .complete
            .iter()
            .filter(|(round, _)| self.rounds.rounds[*round].contour == own.contour);
        let is_own = |other: usize| !self.is_switched(other, run.first);
        let is_beside = |other: usize| {
            let between = &blocks[other.min(run.first)..other.max(run.first)];
            between.iter().all(|block| block.segment().is_some())
        };
        let mut others = others
            .map(|(_, first)| *first)
            .filter(|other| is_beside(*other));
        is_offset && own.closed && !others.clone().any(is_own) && others.next().is_some()
    }

    /// An open contour is cut from one end to the other: where a run begins after that end, and the part between is
    /// uncut, one of the blocks before it should have cut it.
    fn begins_late(&mut self, run: &Run) {
        let entry = run.entry;
        let last = self.rounds.rounds[entry.round].pieces.len() - 1;
        let (first, passed) = if entry.back {
            (last, last - entry.piece)
        } else {
            (0, entry.piece)
        };
        let mut missed = Run {
            spot: self.rounds.at_begin(entry.round, first, entry.back),
            ..run.clone()
        };
        let gap = self.uncut_from(&missed.spot);
        if gap <= COVERED {
            return;
        }
        if passed == 0 {
            // Its first block is that much too short.
            self.name(run, run.first, gap, Kind::Block);
            return;
        }
        let begin = self.rounds.at_begin(entry.round, entry.piece, entry.back);
        let passed = passed + usize::from((begin.at - entry.at).norm() > REACH);
        let Some(before) = self.before(run).nth(passed - 1) else {
            self.name(run, run.first, gap, Kind::Unfinished);
            return;
        };
        let (named, off) = self.first_unlike(&missed, before);
        for _ in before..named {
            missed.spot = self.rounds.next(&missed.spot).unwrap_or(missed.spot);
        }
        self.walked.runs[named] = true;
        self.name(&missed, named, off, Kind::Block);
    }

    /// Among the blocks before a run, starting with the one that begins where the run returned to, the one that does
    /// not follow, and its deviation.
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
}
