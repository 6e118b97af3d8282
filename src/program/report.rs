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

/// A program with known faults.
pub(super) trait Report {
    /// The source for wording a finding: of many findings few are shown.
    type Kept;

    fn found(&self) -> Vec<Found<Self::Kept>>;

    fn worded(&self, kept: Self::Kept) -> Option<Finding>;

    /// All findings, as the rules see them.
    fn all(&self) -> Vec<Finding> {
        let worded = |found: Found<Self::Kept>| self.worded(found.kept);
        self.found().into_iter().filter_map(worded).collect()
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
        let mut found: Vec<_> = self.found().into_iter().filter_map(under).collect();
        found.sort_by_key(|found| (found.severity, found.place, found.rule));
        let count = found.len();
        found.truncate(limit);
        let worded = |found: Found<Self::Kept>| Some(self.worded(found.kept)?.with(found.severity));
        (found.into_iter().filter_map(worded).collect(), count)
    }
}

/// First and last byte of a finding's place.
pub(super) fn place_of(finding: &Finding) -> (usize, usize) {
    match &finding.place {
        Place::Text { range } => (range.start, range.end),
        _ => (0, 0),
    }
}
