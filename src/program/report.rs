//! The findings of a program: those of its reader, under the settings' severities, errors first, then in the order of
//! the text.

use crate::finding::{Finding, Rule, Severity};
use crate::settings::Effective;

/// A finding before it is worded.
pub(super) struct Found<K> {
    pub(super) rule: Rule,
    /// As the rule sees it, before the settings change it.
    pub(super) severity: Severity,
    /// First and last byte that it is sorted by.
    pub(super) place: (usize, usize),
    pub(super) kept: K,
}

/// What findings are sorted by: severity, place and rule, and their number among all.
type Key = (Severity, (usize, usize), Rule, usize);

/// How many findings there are of a rule, in a severity as the rule sees it.
pub(super) type Counted = (Rule, Severity, usize);

/// Counts one more.
pub(super) fn count(counts: &mut Vec<Counted>, rule: Rule, severity: Severity) {
    let own = counts
        .iter_mut()
        .find(|one| (one.0, one.1) == (rule, severity));
    match own {
        Some((.., count)) => *count += 1,
        None => counts.push((rule, severity, 1)),
    }
}

/// A program with known faults.
pub(super) trait Report {
    /// What a finding is worded from: of many findings only a few are shown.
    type Kept;

    /// In how many groups its findings are kept.
    fn groups(&self) -> usize;

    /// A byte that no finding of a group stands before, and how many there are of each kind; `None` where that is not known
    /// without looking at each.
    fn tally(&self, group: usize) -> Option<(usize, &[Counted])>;

    fn found_in(&self, group: usize) -> impl Iterator<Item = Found<Self::Kept>>;

    fn worded(&self, kept: Self::Kept) -> Option<Finding>;

    /// All findings, as the rules see them.
    fn all(&self) -> Vec<Finding> {
        let worded = |found: Found<Self::Kept>| self.worded(found.kept);
        let all = (0..self.groups()).flat_map(|group| self.found_in(group));
        all.filter_map(worded).collect()
    }

    /// Those without merely suspected blocks, and without a search for the slip behind them.
    fn plain(&self) -> Vec<Finding> {
        self.all()
    }

    /// At most `limit` findings, and how many there are in all.
    fn told(&self, settings: &Effective, limit: usize) -> (Vec<Finding>, usize) {
        let First {
            held: mut first,
            count,
            ..
        } = self.first(settings, limit);
        first.sort_unstable_by_key(|(key, _)| *key);
        first.truncate(limit);
        let worded = |(key, kept): (Key, Self::Kept)| Some(self.worded(kept)?.with(key.0));
        (first.into_iter().filter_map(worded).collect(), count)
    }

    /// The number of findings that are looked at one by one to find the first `limit` of them.
    #[cfg(test)]
    fn looked_at(&self, settings: &Effective, limit: usize) -> usize {
        self.first(settings, limit).looked_at
    }

    fn first(&self, settings: &Effective, limit: usize) -> First<Self::Kept> {
        let under_settings = |found: Found<Self::Kept>| {
            let severity = settings.severity_over(found.rule, found.severity)?;
            Some(Found { severity, ..found })
        };
        // Only the first findings are kept, each by its key; the others are counted.
        let mut first: First<Self::Kept> = First::of(limit.max(1));
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
        first
    }
}

/// The first of many findings, in no order, and how many there are in all.
pub(super) struct First<K> {
    held: Vec<(Key, K)>,
    most: usize,
    /// Findings after it are not among the first.
    last: Option<Key>,
    count: usize,
    #[cfg(test)]
    looked_at: usize,
}

impl<K> First<K> {
    fn of(most: usize) -> First<K> {
        First {
            held: Vec::new(),
            most,
            last: None,
            count: 0,
            #[cfg(test)]
            looked_at: 0,
        }
    }

    fn push(&mut self, found: Found<K>) {
        let key: Key = (found.severity, found.place, found.rule, self.count);
        self.count += 1;
        #[cfg(test)]
        (self.looked_at += 1);
        if self.last.is_some_and(|last| key > last) {
            return;
        }
        self.held.push((key, found.kept));
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
