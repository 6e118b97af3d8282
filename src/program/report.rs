//! The findings of a program: those of its reader, under the settings' severities, errors first, then in the order of
//! the text.

use crate::finding::{Finding, Place, Rule, Severity};
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

/// A program with known faults.
pub(super) trait Report {
    /// The source for wording a finding: of many findings few are shown.
    type Kept;

    fn found(&self) -> impl Iterator<Item = Found<Self::Kept>>;

    fn worded(&self, kept: Self::Kept) -> Option<Finding>;

    /// All findings, as the rules see them.
    fn all(&self) -> Vec<Finding> {
        let worded = |found: Found<Self::Kept>| self.worded(found.kept);
        self.found().filter_map(worded).collect()
    }

    /// Those without merely suspected blocks, and without a search for the slip behind them.
    fn plain(&self) -> Vec<Finding> {
        self.all()
    }

    /// At most `limit` findings, and how many there are in all.
    fn told(&self, settings: &Effective, limit: usize) -> (Vec<Finding>, usize) {
        let under = |found: Found<Self::Kept>| {
            let severity = settings.severity_over(found.rule, found.severity)?;
            Some(Found { severity, ..found })
        };
        let mut count = 0;
        // Those of which some are the first, each by its key: the others are only counted.
        let mut first: Vec<(Key, Self::Kept)> = Vec::new();
        let (held, mut last) = (limit.max(1), None);
        for found in self.found().filter_map(under) {
            let key: Key = (found.severity, found.place, found.rule, count);
            count += 1;
            if last.is_some_and(|last| key > last) {
                continue;
            }
            first.push((key, found.kept));
            if first.len() == held.saturating_mul(2) {
                let (_, greatest, _) = first.select_nth_unstable_by_key(held - 1, |(key, _)| *key);
                last = Some(greatest.0);
                first.truncate(held);
            }
        }
        first.sort_unstable_by_key(|(key, _)| *key);
        first.truncate(limit);
        let worded = |(key, kept): (Key, Self::Kept)| Some(self.worded(kept)?.with(key.0));
        (first.into_iter().filter_map(worded).collect(), count)
    }
}

/// First and last byte of a finding's place.
pub(super) fn place_of(finding: &Finding) -> (usize, usize) {
    match &finding.place {
        Place::Text { range } => (range.start, range.end),
        _ => (0, 0),
    }
}
