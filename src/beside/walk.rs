//! Walks along a program and the rounds of its drawing at once.
//!
//! A run follows a round from where the program reaches it. A block that does not follow is named, and the run goes on
//! after it from the program's position, or from where it returns to the drawing: one change is one difference. The
//! ways to and from a run are not checked. A run that ends before its contour waits for the end: a tab may be cut
//! later.

mod covered;
mod enter;
mod resume;
mod settle;

use super::COVERED;
use super::placement::{Placement, Reached};
use super::rounds::{Rounds, Spot};
use super::traced::{Motion, Traced};
use crate::drawing::EntityId;
use crate::geometry::{Side, Vector};
use std::ops::Range;

/// A block that does not follow, by its index.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Unlike {
    pub block: usize,
    pub source: Option<(EntityId, usize)>,
    /// Its deviation, µm.
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
    /// No contour of the drawing matches it.
    Foreign,
    /// A way in or out, or between contours, of a program that is otherwise ours.
    Lead,
    /// The coordinates after a block of such a program differ from its end.
    Stated,
    /// The control lets the wire run on one side, or none, and should on another.
    Side {
        said: Option<Side>,
        meant: Option<Side>,
    },
    /// A pass takes its correction from the place of another one.
    Register { said: u32, meant: u32 },
    /// A contour is cut at another correction than the others of its program, nm.
    Correction { said: u32, meant: u32 },
    /// The machine should stop before this block.
    Unstopped,
    /// The wire runs on the other side of an arc of 4B; it should run inside of it, or outside.
    Turned { meant: bool },
    /// The wire runs into the part, by as much as it is off.
    Inside,
    /// A way in ends this far beside the path of its contour, which goes on from there.
    Astray,
    /// The wire runs on the other side of its contour than the settings say.
    OtherSide,
}

/// The result of a walk.
#[derive(Debug, Default)]
pub(super) struct Walked {
    pub unlike: Vec<Unlike>,
    /// For each block: it is part of a run, or of something named in one.
    pub runs: Vec<bool>,
    /// For each block that follows a round, its number, and whether it goes against its direction.
    pub on: Vec<Option<(usize, bool)>>,
    /// The blocks that end where the drawing says.
    pub follows: Vec<usize>,
    /// Contours that were followed.
    pub contours: Vec<usize>,
    /// Blocks that follow within the tolerance, with numbers that no writer rounds so.
    pub slips: Vec<Unlike>,
    /// A cut round closed contours does not end where it began.
    pub misses_start: bool,
}

/// This many blocks must follow so that others before them count as changed.
const SURE: usize = 3;
/// The largest distance of a wrong first block of a contour from the contour's return to it, µm.
const NEAR: f64 = 1_000.0;

#[derive(Clone, Debug)]
struct Run {
    first: usize,
    entry: Spot,
    spot: Spot,
    travelled: f64,
    /// It has completed its round.
    complete: bool,
    /// Blocks up to here are known to be on one piece.
    split: usize,
    /// The block before which pieces were last skipped: not twice, or there is no end.
    passed: Option<usize>,
    /// By how much the program lies elsewhere from its start on than before.
    moved: Option<Vector>,
}

/// A run that ended before its contour did.
#[derive(Debug)]
struct Loose {
    run: Run,
    /// The first block after it, or its last one where there is no other.
    block: usize,
    is_behind: bool,
    placement: Placement,
}

pub(super) struct Walk<'a> {
    traced: &'a Traced,
    rounds: &'a Rounds,
    placement: Placement,
    /// Of each round the stretches that have been cut.
    covered: Vec<Vec<Range<f64>>>,
    /// The same for all laps and passes.
    cuts: Vec<Vec<Range<f64>>>,
    loose: Vec<Loose>,
    /// Runs that reached the end of an open contour.
    ended: Vec<Run>,
    /// Of each run that has completed its round alone, the round and the first block.
    complete: Vec<(usize, usize)>,
    /// Runs that begin beside their place in the drawing.
    moved: Vec<Run>,
    walked: Walked,
}

impl<'a> Walk<'a> {
    pub(super) fn new(traced: &'a Traced, rounds: &'a Rounds, placement: Placement) -> Walk<'a> {
        Walk {
            traced,
            rounds,
            placement,
            covered: vec![Vec::new(); rounds.rounds.len()],
            cuts: vec![Vec::new(); rounds.rounds.len()],
            loose: Vec::new(),
            ended: Vec::new(),
            complete: Vec::new(),
            moved: Vec::new(),
            walked: Walked {
                runs: vec![false; traced.blocks.len()],
                on: vec![None; traced.blocks.len()],
                ..Walked::default()
            },
        }
    }

    /// `tabs`: the lengths of the tabs that may be left standing, µm.
    pub(super) fn go(mut self, tabs: &[f64]) -> Walked {
        let mut run: Option<Run> = None;
        let (mut index, mut tried) = (0, 0);
        // From each block the walk goes back once at most.
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
                if self.is_switched(open.first, index) {
                    self.leave(run.take(), index, false);
                } else {
                    match self.resume(open, index) {
                        Some(behind) => {
                            index = behind;
                            continue;
                        }
                        None => self.leave(run.take(), index, true),
                    }
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

    /// Whether the correction is switched on or off between two blocks: they belong to different passes.
    fn is_switched(&self, one: usize, other: usize) -> bool {
        let stretch = |index: usize| self.traced.blocks.get(index).map(|block| block.stretch);
        stretch(one) != stretch(other)
    }

    /// Lets a run go on by one block; false where that does not follow.
    fn step(&mut self, run: &mut Run, index: usize) -> bool {
        let mut placement = self.placement;
        let Some(reached) =
            placement.follow(self.rounds, self.traced, index, &run.spot, &run.entry)
        else {
            return false;
        };
        let is_chord = self.traced.blocks[index]
            .segment()
            .is_some_and(|own| own.as_arc().is_none())
            && self.rounds.piece(&run.spot).segment.as_arc().is_some();
        if !reached.whole && !run.complete && !is_chord && index >= run.split {
            let behind = self.covers_all(run, reached.length);
            match self.split_ends(&placement, run, &reached, index) {
                Some(end) => run.split = end,
                None if behind || self.begins_before(&placement, run, &reached) => {}
                None => return false,
            }
        }
        self.placement = placement;
        self.take(run, &reached, index);
        true
    }

    /// Notes what a block has cut.
    fn take(&mut self, run: &mut Run, reached: &Reached, index: usize) {
        self.walked.runs[index] = true;
        self.walked.on[index] = Some((run.spot.round, run.spot.back));
        // The overlap past its start, and the start of a tab, are the program's own.
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
                    .verify(self.placement, run.spot, run.entry, index + 1, SURE)
                    .0
                    >= SURE
        };
        if run.complete && goes_on() {
            // Once more round in one go: a lap of its own.
            self.lap(run.spot.round);
            (run.travelled, run.complete) = (0.0, false);
        }
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

    /// Ends a run; the uncut rest of its contour is checked at the end of the program.
    fn leave(&mut self, run: Option<Run>, index: usize, is_behind: bool) {
        let Some(run) = run else { return };
        self.walked
            .contours
            .push(self.rounds.rounds[run.spot.round].contour);
        if run.complete {
            let round = &self.rounds.rounds[run.spot.round];
            if run.travelled >= round.length - COVERED {
                self.complete.push((run.spot.round, run.first));
            }
            if round.from_end {
                self.ended.push(run.clone());
            }
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
            placement: self.placement,
            run,
        });
    }
}
