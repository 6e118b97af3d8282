//! The findings of a program: those of its reader, under the settings' severities, errors first, then in the order of
//! the text.

use super::steps::Program;
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

/// A program with known faults.
pub(super) trait Report: Program {
    /// What a finding is worded from: of many only a few are shown.
    type Source;

    fn found(&self) -> impl Iterator<Item = Found<Self::Source>>;

    fn worded(&self, source: Self::Source) -> Option<Finding>;

    /// All findings, as the rules see them.
    fn all(&self) -> Vec<Finding> {
        let all = self.found();
        all.filter_map(|found| self.worded(found.source)).collect()
    }

    /// Those without merely suspected blocks, and without a search for the slip behind them.
    fn plain(&self) -> Vec<Finding> {
        self.all()
    }

    /// At most `limit` findings, and how many there are in all.
    fn told(&self, settings: &Effective, limit: usize) -> (Vec<Finding>, usize) {
        let (limit, mut count) = (limit.max(1), 0);
        let mut first: Vec<(Key, Self::Source)> = Vec::new();
        for found in self.found() {
            let Some(severity) = settings.severity_over(found.rule, found.severity) else {
                continue;
            };
            first.push(((severity, found.place, found.rule, count), found.source));
            count += 1;
            if first.len() >= limit.saturating_mul(2) {
                first.select_nth_unstable_by_key(limit - 1, |(key, _)| *key);
                first.truncate(limit);
            }
        }
        first.sort_unstable_by_key(|(key, _)| *key);
        first.truncate(limit);
        let worded = |(key, source): (Key, _)| Some(self.worded(source)?.with(key.0));
        (first.into_iter().filter_map(worded).collect(), count)
    }
}

/// First and last byte of a finding's place.
pub(super) fn place_of(finding: &Finding) -> (usize, usize) {
    let range = finding.place.in_text();
    range.map_or((0, 0), |range| (range.start, range.end))
}
