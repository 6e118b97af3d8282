//! The search for the runs that come near a run, and the comparison with each. Knows nothing of what was found before.

use super::compare::{
    Comparison, LOOKS_OF_A_PAIR, Observed, Outlooks, RunId, RunWalls, RunsAtHand, Walled, passes,
};
use crate::geometry::{Bounds, Grid, Segment, Shell, Shells};
use crate::rules::Outlook;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::rc::Rc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering::Relaxed};

/// From this many runs on, what has been seen is checked in one pass, and a task takes more runs.
pub(super) const MANY_RUNS: usize = 512;
/// Runs that are compared in parallel: results beyond the bounds are dropped.
const BATCH: usize = 8192;
/// From this many runs on, several threads are worth while.
const SEVERAL_RUNS: usize = if cfg!(test) { 2 } else { 64 };
/// Runs per task, of many and of fewer.
const SHARE: usize = 64;
const SMALL_SHARE: usize = 8;

/// One look of the budget: the comparison of two segments, or of this many boxes of the grid.
pub(super) const BOXES_OF_A_LOOK: u64 = 4;

/// The sample of runs for which neighbours are counted, how many of those may really come near, and how many neighbours
/// are a crowd.
const SAMPLES: usize = 32;
const CROWDED: usize = 64;

/// The partners of new runs.
pub(super) struct Search<'a> {
    pub(super) grid: &'a Grid<RunId>,
    /// All runs in another index, where the grid is crowded.
    pub(super) shells: Option<&'a Shells<RunId>>,
    pub(super) rules: &'a [(usize, f64)],
    pub(super) reach: f64,
    /// Observations beyond this number are dropped.
    pub(super) most_seen: usize,
    pub(super) new: &'a FxHashMap<RunId, u32>,
    pub(super) are_parts: bool,
}

/// The results for one run.
#[derive(Default)]
pub(super) struct Looked {
    /// The looks that it took to find its neighbours.
    pub(super) before: u64,
    /// Each neighbour, the looks that it took, and the observations.
    pub(super) each: Vec<(RunId, u64, Vec<Observed>)>,
    /// No looks were left for the others, or enough has been observed.
    pub(super) is_cut_short: bool,
}

impl Looked {
    pub(super) fn looks(&self) -> u64 {
        self.before + self.each.iter().map(|(_, looks, _)| looks).sum::<u64>()
    }

    pub(super) fn found(&self) -> usize {
        self.each.iter().map(|(.., found)| found.len()).sum()
    }
}

impl Compared {
    /// Adds the results for a run, up to the bounds.
    fn add(&mut self, run: RunId, looked: Looked, most_seen: usize) {
        self.left = self.left.saturating_sub(looked.before);
        let mut is_whole = !looked.is_cut_short;
        for (other, looks, found) in looked.each {
            if self.count >= most_seen || self.left == 0 {
                is_whole = false;
                break;
            }
            self.left = self.left.saturating_sub(looks);
            if !found.is_empty() {
                self.count += found.len();
                self.seen.push((run, other, found));
            }
        }
        if !is_whole {
            self.cut_short.push(run);
        }
    }
}

/// Where a run of a contour lies.
fn shell_of(outlook: &Outlook, run: u32) -> Shell {
    let range = outlook.index.range_of(run as usize);
    let segments = outlook.contour.segments_in(outlook.drawing, range);
    let segments: Vec<Segment> = segments.map(|segment| segment.geometry).collect();
    Shell::of(segments.iter().copied())
}

/// What the comparison of new runs has found.
pub(super) struct Compared {
    pub(super) seen: Vec<(RunId, RunId, Vec<Observed>)>,
    /// Those that have not been compared with all their neighbours.
    pub(super) cut_short: Vec<RunId>,
    /// The looks that are left.
    pub(super) left: u64,
    /// How much has been seen in all.
    pub(super) count: usize,
}

impl Search<'_> {
    /// Compares new runs in their order, within so many looks, where so much has been seen before. Where they are many, several cores work ahead: what
    /// is found beyond the bounds is dropped.
    pub(super) fn compared(
        &self,
        kept: &mut RunsAtHand,
        runs: &[RunId],
        (left, count): (u64, usize),
    ) -> Compared {
        let most_seen = self.most_seen;
        let mut all = Compared {
            seen: Vec::new(),
            cut_short: Vec::new(),
            left,
            count,
        };
        let outlook = kept.outlook;
        for (batch, runs) in runs.chunks(BATCH).enumerate() {
            let first = batch * BATCH;
            // A run that was not compared here because of the limit is compared below, if at all.
            let (looks, found) = (AtomicU64::new(0), AtomicUsize::new(0));
            let (left, count) = (all.left, all.count);
            let is_enough =
                || looks.load(Relaxed) >= left || count + found.load(Relaxed) >= most_seen;
            let look = |kept: &mut RunsAtHand, (at, &run): (usize, &RunId)| {
                (!is_enough()).then(|| {
                    let looked = self.look(kept, first + at, run, left);
                    looks.fetch_add(looked.looks(), Relaxed);
                    found.fetch_add(looked.found(), Relaxed);
                    looked
                })
            };
            let ahead: Vec<Option<Looked>> = if runs.len() < SEVERAL_RUNS {
                Vec::new()
            } else {
                let share = if self.new.len() < MANY_RUNS {
                    SMALL_SHARE
                } else {
                    SHARE
                };
                let runs = runs.par_iter().enumerate().with_min_len(share);
                runs.map_init(|| RunsAtHand::new(outlook), look).collect()
            };
            let mut ahead = ahead.into_iter();
            for (at, &run) in runs.iter().enumerate() {
                let ahead = ahead.next().flatten();
                if all.count >= most_seen || all.left == 0 {
                    all.cut_short.push(run);
                    continue;
                }
                let looked = ahead.unwrap_or_else(|| self.look(kept, first + at, run, all.left));
                all.add(run, looked, most_seen);
            }
        }
        all
    }

    /// Compares the new run with this index with all that come near it, within this many looks.
    pub(super) fn look(&self, kept: &mut RunsAtHand, at: usize, run: RunId, most: u64) -> Looked {
        let mut looked = Looked::default();
        let Some(own) = (kept.outlook)(run.0) else {
            return looked;
        };
        let area = own.index.bounds_of_run(run.1 as usize).grown(self.reach);
        let mut near = Vec::new();
        let found = |other, bounds: &Bounds| {
            // Two new runs are compared only once.
            if self.new.get(&other).is_none_or(|&its| at <= its as usize) {
                near.push((other, *bounds));
            }
        };
        let boxes = match &self.shells {
            Some(shells) => shells.near(&shell_of(&own, run.1), self.reach, found),
            None => self.grid.near(&area, found),
        };
        looked.before = boxes / BOXES_OF_A_LOOK;
        if self.are_parts {
            near.retain(|(other, _)| (kept.outlook)(other.0).is_some_and(|it| it.part == own.part));
        }
        let walls = match near.as_slice() {
            [] => return looked,
            // The walls of a run that nothing else comes near are not needed again.
            [(alone, _)] if *alone == run => Rc::new(RunWalls::of(&own, run.1)),
            _ => match kept.walls_of(run) {
                Some(walls) => walls,
                None => return looked,
            },
        };
        // A long line may have a box that holds half the drawing, and come near little of it.
        let comes_near = |(wall, bounds): &Walled, theirs: &Bounds| {
            bounds.grown(self.reach).touches(theirs) && passes(wall.geometry(), theirs, self.reach)
        };
        near.retain(|(other, theirs)| {
            looked.before += (walls.each.len() as u64).div_ceil(BOXES_OF_A_LOOK);
            *other == run || walls.each.iter().any(|wall| comes_near(wall, theirs))
        });
        looked.before += LOOKS_OF_A_PAIR * near.len() as u64;
        let comparison = |other: RunId| Comparison {
            rules: self.rules,
            reach: self.reach,
            keys: (run.0, other.0),
        };
        let (mut looks, mut count) = (looked.before, 0);
        for (other, _) in near {
            if looks >= most || count >= self.most_seen {
                looked.is_cut_short = true;
                break;
            }
            let mut found = Vec::new();
            let theirs = (other != run).then(|| kept.walls_of(other)).flatten();
            let own = match theirs {
                Some(theirs) => comparison(other).between(&walls, &theirs, &mut found),
                None => comparison(other).within(&walls, &mut found),
            };
            looks += own;
            count += found.len();
            looked.each.push((other, own, found));
        }
        looked
    }
}

/// An index of all runs by how they lie within each other, where most new runs have too many boxes
/// near them for the grid to help.
pub(super) fn shells_where_crowded(
    grid: &Grid<RunId>,
    reach: f64,
    outlook: Outlooks,
    runs: &[RunId],
) -> Option<Shells<RunId>> {
    let step = (runs.len() >= CROWDED).then_some(runs.len() / SAMPLES)?;
    // It has to be worth putting all of them into a tree.
    let samples = || runs.iter().step_by(step).take(SAMPLES);
    let read = samples().map(|&run| {
        let bounds = outlook(run.0).map(|it| it.index.bounds_of_run(run.1 as usize));
        let area = bounds.unwrap_or(Bounds::EMPTY).grown(reach);
        grid.near(&area, |_, _| {}) as usize
    });
    let read: usize = read.sum();
    if read * runs.len() < SAMPLES * CROWDED * grid.len() {
        return None;
    }
    let shell = |run: RunId| Some(shell_of(&outlook(run.0)?, run.1));
    let mut meet = 0;
    for &run in samples() {
        let own = shell(run)?;
        let mut near = Vec::new();
        let area = own.bounds().grown(reach);
        grid.near(&area, |other, _| near.push(other));
        let tried = near.iter().step_by(near.len().div_ceil(SAMPLES).max(1));
        let shells: Vec<Shell> = tried.filter_map(|&other| shell(other)).collect();
        let meeting = shells.iter().filter(|it| it.may_meet(&own, reach));
        meet += near.len() * meeting.count() / shells.len().max(1);
    }
    (meet * 8 < read).then(|| {
        let runs: Vec<RunId> = grid.keys().collect();
        let shells = runs.par_iter().filter_map(|&run| Some((run, shell(run)?)));
        Shells::new(shells.collect())
    })
}
