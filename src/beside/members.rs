//! Whether every block of a program lies on its drawing, in whatever order.
//!
//! A walk along both has to guess where a program means to be; that nothing is unlike can be told without: each block but the few that lead
//! in, out and from pass to pass follows some piece of some round, and each round that is cut is cut as often everywhere.

use super::pose::Pose;
use super::rounds::{Rounds, Spot};
use super::traced::{Motion, Traced};
use super::walk::Walked;
use super::{BETWEEN, COVERED, REACH};
use std::ops::Range;

/// What is known of a program up to one of its blocks.
#[derive(Clone)]
pub(super) struct Members {
    pub pose: Pose,
    /// Where the last block has led to, and where its run began.
    pub spot: Option<Spot>,
    pub entry: Option<Spot>,
    runs: Vec<bool>,
    /// Blocks that end where the drawing says.
    follows: Vec<usize>,
    cuts: Vec<Vec<Range<f64>>>,
    contours: Vec<usize>,
    /// Blocks since the last that follows; one that follows has been left for them.
    away: usize,
    left: Option<Spot>,
    is_broken: bool,
    miss: f64,
}

impl Members {
    pub fn new(traced: &Traced, rounds: &Rounds, pose: Pose) -> Members {
        Members {
            pose,
            spot: None,
            entry: None,
            runs: vec![false; traced.blocks.len()],
            follows: Vec::new(),
            cuts: vec![Vec::new(); rounds.rounds.len()],
            contours: Vec::new(),
            away: 0,
            left: None,
            is_broken: false,
            miss: 0.0,
        }
    }

    /// Takes one block after the other in; the first one that shows that something is unlike, at the latest.
    pub fn take(&mut self, traced: &Traced, rounds: &Rounds, index: usize) {
        let segment = match &traced.blocks[index].motion {
            Motion::Cut(segment) => segment,
            Motion::Stop => {
                self.left = None;
                return;
            }
            Motion::Way(..) => {
                (self.spot, self.entry, self.left, self.away) = (None, None, None, 0);
                return;
            }
        };
        let goes_on = self.spot.zip(self.entry);
        let found =
            goes_on.and_then(|(spot, entry)| self.follow(traced, rounds, index, spot, entry));
        let found = found.or_else(|| {
            let near = rounds.near(self.pose.place(segment.start()), REACH);
            let mut all = near.into_iter().filter_map(|spot| {
                // Where the run began divides a piece for all of it.
                let own = |(last, entry): (Spot, Spot)| {
                    ((last.round, last.back) == (spot.round, spot.back)).then_some(entry)
                };
                let entry = goes_on.and_then(own).unwrap_or(spot);
                self.follow(traced, rounds, index, spot, entry)
            });
            let first = all.next()?;
            if first.whole {
                return Some(first);
            }
            Some(all.find(|found| found.whole).unwrap_or(first))
        });
        let Some(found) = found else {
            if let Some(spot) = self.spot.take() {
                self.left = Some(spot);
                self.away = 0;
            }
            if traced.counts && segment.as_arc().is_some() {
                self.pose = self.pose.behind_arcs();
            }
            self.entry = None;
            self.away += 1;
            self.is_broken |= self.away > BETWEEN;
            return;
        };
        let Found {
            from,
            entry,
            pose,
            to,
            length,
            whole,
            miss,
        } = found;
        // Away and back to the same place: that is no way from pass to pass.
        self.is_broken |= self.spot.is_none()
            && self.left.is_some_and(|left| {
                (left.round, left.back) == (from.round, from.back)
                    && (left.at - from.at).norm() < 10.0
            });
        (self.pose, self.spot, self.entry) = (pose, to, Some(entry));
        (self.left, self.away) = (None, 0);
        self.runs[index] = true;
        self.follows.extend(whole.then_some(index));
        self.miss += miss;
        self.contours.push(rounds.rounds[from.round].contour);
        rounds.cover(&from, length, |part| self.cuts[from.round].push(part));
    }

    fn follow(
        &self,
        traced: &Traced,
        rounds: &Rounds,
        index: usize,
        from: Spot,
        entry: Spot,
    ) -> Option<Found> {
        let mut pose = self.pose;
        let reached = pose.follow(rounds, traced, index, &from, &entry)?;
        Some(Found {
            from,
            entry,
            pose,
            to: reached.spot,
            length: reached.length,
            whole: reached.whole,
            miss: reached.off.norm(),
        })
    }

    /// Blocks about those where blocks begin to follow, or no longer do.
    pub fn breaks(traced: &Traced, rounds: &Rounds, pose: Pose) -> Vec<usize> {
        let mut members = Members::new(traced, rounds, pose);
        let mut breaks = Vec::new();
        for index in 0..traced.blocks.len() {
            let is_on = members.spot.is_some();
            members.take(traced, rounds, index);
            if is_on != members.spot.is_some() {
                breaks.extend(index.saturating_sub(2)..=index);
            }
            if members.is_broken {
                break;
            }
        }
        breaks.retain(|&index| traced.blocks[index].segment().is_some());
        breaks
    }

    /// All of them; `None` where something is unlike.
    /// And by how much they miss their places together, µm.
    pub fn all(traced: &Traced, rounds: &Rounds, pose: Pose) -> Option<(Walked, f64)> {
        let mut members = Members::new(traced, rounds, pose);
        for index in 0..traced.blocks.len() {
            members.take(traced, rounds, index);
            if members.is_broken {
                return None;
            }
        }
        let is_whole = |(round, cuts): (usize, &Vec<Range<f64>>)| {
            cuts.is_empty() || is_even(cuts, rounds.rounds[round].length)
        };
        let whole = members.cuts.iter().enumerate().all(is_whole);
        let walked = Walked {
            runs: members.runs,
            follows: members.follows,
            contours: members.contours,
            ..Walked::default()
        };
        (whole && !walked.contours.is_empty()).then_some((walked, members.miss))
    }
}

struct Found {
    from: Spot,
    entry: Spot,
    pose: Pose,
    to: Option<Spot>,
    length: f64,
    whole: bool,
    miss: f64,
}

/// Whether a round of a length is cut everywhere as often as nearly everywhere, but not less.
fn is_even(cuts: &[Range<f64>], length: f64) -> bool {
    let mut events: Vec<(f64, i32)> = Vec::with_capacity(2 * cuts.len() + 1);
    events.extend(
        cuts.iter()
            .flat_map(|part| [(part.start, 1), (part.end, -1)]),
    );
    events.push((length, 0));
    events.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut at, mut count) = (0.0, 0);
    let mut stretches: Vec<(i32, f64)> = Vec::with_capacity(events.len());
    for (to, step) in events {
        let to = to.clamp(0.0, length);
        stretches.push((count, to - at));
        (at, count) = (to, count + step);
    }
    let most = stretches.iter().map(|(count, _)| *count).max().unwrap_or(0);
    let long = |count: i32| -> f64 {
        let own = stretches.iter().filter(|(own, _)| *own == count);
        own.map(|(_, length)| length).sum()
    };
    let usual = (0..=most).max_by(|a, b| long(*a).total_cmp(&long(*b)));
    let usual = usual.unwrap_or(0);
    let mut hole = 0.0;
    for (count, length) in stretches {
        hole = if count < usual {
            hole + length
        } else if length > 1.0 {
            0.0
        } else {
            hole
        };
        if hole > COVERED {
            return false;
        }
    }
    usual > 0
}
