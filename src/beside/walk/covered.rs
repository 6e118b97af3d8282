//! The parts of the rounds that have been cut.

use super::super::rounds::Spot;
use super::super::{COVERED, TOLERANCE};
use super::{Run, Walk};
use std::ops::Range;

impl Walk<'_> {
    pub(super) fn cover(&mut self, from: &Spot, length: f64) {
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

    /// Whether the part right ahead of a spot has been cut as often as most of its round.
    pub(super) fn is_cut_as_often(&self, spot: &Spot) -> bool {
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

    /// The uncut parts of a round, in its direction.
    pub(super) fn uncut(&self, round: usize) -> Vec<Range<f64>> {
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

    pub(super) fn is_all_cut(&self, round: usize) -> bool {
        !self.covered[round].is_empty() && self.uncut(round).is_empty()
    }

    pub(super) fn is_cut(&self, spot: &Spot) -> bool {
        self.uncut_from(spot) <= COVERED
    }

    /// The uncut length from a spot on, µm.
    pub(super) fn uncut_from(&self, spot: &Spot) -> f64 {
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

    pub(super) fn covers_all(&self, run: &Run, further: f64) -> bool {
        let length = self.rounds.rounds[run.spot.round].length;
        let is_all = |left: f64| (left - further).abs() <= TOLERANCE;
        is_all(length - run.travelled) || is_all(self.uncut_from(&run.spot))
    }

    pub(super) fn is_covered(&self, run: &Run) -> bool {
        let length = self.rounds.rounds[run.spot.round].length;
        run.travelled >= length - COVERED
            || (self.covered[run.spot.round].len() > 2 || run.entry.round != run.spot.round)
                && self.is_all_cut(run.spot.round)
    }

    pub(super) fn lap(&mut self, round: usize) {
        self.covered[round].clear();
    }
}
