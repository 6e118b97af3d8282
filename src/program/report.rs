//! The findings of a program: those of its reader, under the settings' severities, errors first, then in the order of
//! the text.

use super::by_chunk::ByChunk;
use super::of_cut::{Counted, OfCut};
use super::steps::Program;
use super::work::{self, Work};
use crate::finding::{Finding, Rule, Severity};
use crate::settings::Effective;

/// A finding before it is worded.
pub(super) struct Found<S> {
    pub(super) rule: Rule,
    /// As the rule sees it, before the settings change it.
    pub(super) severity: Severity,
    /// First and last byte that it is sorted by.
    pub(super) place: (usize, usize),
    pub(super) source: S,
}

/// What findings are sorted by: severity, place and rule, and their number among all.
type Key = (Severity, (usize, usize), Rule, usize);

/// What a finding is worded from: of many findings only a few are shown.
pub(super) enum Source<O> {
    /// What is kept of the cuts that begin in a chunk, by its index there.
    OfCut {
        chunk: usize,
        index: usize,
    },
    Own(O),
}

/// A program with known faults: those of single cuts, by the chunks in which these begin, and its own.
pub(super) trait Report: Program {
    /// What a finding of its own is worded from.
    type Own;

    /// The first byte of a chunk.
    fn byte_of(&self, chunk: usize) -> usize;

    fn of_cuts(&self) -> &ByChunk<OfCut>;

    /// In how many groups its own findings are kept.
    fn own_groups(&self) -> usize;

    /// A byte that no finding of a group stands before, and how many there are of each kind; `None` where that is not known
    /// without looking at each.
    fn own_tally(&self, _group: usize) -> Option<(usize, &[Counted])> {
        None
    }

    fn own_in(&self, group: usize) -> impl Iterator<Item = Found<Source<Self::Own>>>;

    fn own_worded(&self, own: Self::Own) -> Option<Finding>;

    /// All findings, as the rules see them.
    fn all(&self) -> Vec<Finding> {
        let all = (0..self.groups()).flat_map(|group| self.found_in(group));
        all.filter_map(|found| self.worded(found.source)).collect()
    }

    /// Those without merely suspected blocks, and without a search for the slip behind them.
    fn plain(&self) -> Vec<Finding> {
        self.all()
    }

    /// Those of its own, and those of the cuts of each chunk.
    fn groups(&self) -> usize {
        self.own_groups() + self.of_cuts().len()
    }

    fn tally(&self, group: usize) -> Option<(usize, &[Counted])> {
        match group.checked_sub(self.own_groups()) {
            None => self.own_tally(group),
            Some(chunk) => Some(self.of_cuts().sum(chunk)?.told(|chunk| self.byte_of(chunk))),
        }
    }

    fn found_in(&self, group: usize) -> impl Iterator<Item = Found<Source<Self::Own>>> {
        let chunk = group.checked_sub(self.own_groups());
        let own = chunk.is_none().then(|| self.own_in(group));
        own.into_iter()
            .flatten()
            .chain(chunk.into_iter().flat_map(move |chunk| {
                let of_cuts = self.of_cuts().of(chunk).iter().enumerate();
                of_cuts.map(move |(index, found)| {
                    let range = found.range(|chunk| self.byte_of(chunk));
                    Found {
                        rule: found.rule,
                        severity: found.severity,
                        place: (range.start, range.end),
                        source: Source::OfCut { chunk, index },
                    }
                })
            }))
    }

    fn worded(&self, source: Source<Self::Own>) -> Option<Finding> {
        match source {
            Source::Own(own) => self.own_worded(own),
            Source::OfCut { chunk, index } => {
                let found = self.of_cuts().of(chunk).get(index)?;
                Some(found.finding(|chunk| self.byte_of(chunk), self.text()))
            }
        }
    }

    /// At most `limit` findings, and how many there are in all.
    fn told(&self, settings: &Effective, limit: usize) -> (Vec<Finding>, usize) {
        let under_settings = |found: Found<Source<Self::Own>>| {
            let severity = settings.severity_over(found.rule, found.severity)?;
            Some(Found { severity, ..found })
        };
        // Only the first findings are kept, each by its key; the others are counted.
        let mut first: First<Source<Self::Own>> = First::of(limit.max(1));
        for group in 0..self.groups() {
            match self
                .tally(group)
                .and_then(|tally| first.passed(settings, tally))
            {
                Some(count) => first.count += count,
                None => self
                    .found_in(group)
                    .filter_map(under_settings)
                    .for_each(|found| first.push(found)),
            }
        }
        let First {
            mut held, count, ..
        } = first;
        held.sort_unstable_by_key(|(key, _)| *key);
        held.truncate(limit);
        let worded =
            |(key, source): (Key, Source<Self::Own>)| Some(self.worded(source)?.with(key.0));
        (held.into_iter().filter_map(worded).collect(), count)
    }
}

/// The first of many findings, in no order, and how many there are in all.
struct First<S> {
    held: Vec<(Key, S)>,
    most: usize,
    /// Findings after it are not among the first.
    last: Option<Key>,
    count: usize,
}

impl<S> First<S> {
    fn of(most: usize) -> First<S> {
        First {
            held: Vec::new(),
            most,
            last: None,
            count: 0,
        }
    }

    fn push(&mut self, found: Found<S>) {
        let key: Key = (found.severity, found.place, found.rule, self.count);
        self.count += 1;
        work::add(Work::Findings, 1);
        if self.last.is_some_and(|last| key > last) {
            return;
        }
        self.held.push((key, found.source));
        if self.held.len() == self.most.saturating_mul(2) {
            let last = self.most - 1;
            let (_, greatest, _) = self.held.select_nth_unstable_by_key(last, |(key, _)| *key);
            self.last = Some(greatest.0);
            self.held.truncate(self.most);
        }
    }

    /// The number of findings of a group, if none of them is among the first.
    fn passed(&self, settings: &Effective, (byte, tally): (usize, &[Counted])) -> Option<usize> {
        let mut all = 0;
        for (rule, severity, count) in tally {
            if let Some(severity) = settings.severity_over(*rule, *severity) {
                let (last, place, ..) = self.last?;
                all += ((severity, byte) > (last, place.0)).then_some(*count)?;
            }
        }
        Some(all)
    }
}

/// First and last byte of a finding's place.
pub(super) fn place_of(finding: &Finding) -> (usize, usize) {
    let range = finding.place.in_text();
    range.map_or((0, 0), |range| (range.start, range.end))
}
