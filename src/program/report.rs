//! The findings of a program: those of its reader, under the settings' severities, errors first, then in the order of
//! the text.

use super::steps::Program;
use crate::finding::Finding;
use crate::settings::Effective;

/// A program with known faults.
pub(super) trait Report: Program {
    /// All findings, as the rules see them.
    fn all(&self) -> Vec<Finding>;

    /// At most `limit` findings, and how many there are in all.
    fn told(&self, settings: &Effective, limit: usize) -> (Vec<Finding>, usize) {
        let judged = self.all().into_iter().filter_map(|finding| {
            let severity = settings.severity_over(finding.rule, finding.severity)?;
            Some(finding.with(severity))
        });
        let mut all: Vec<Finding> = judged.collect();
        let (count, limit) = (all.len(), limit.max(1));
        let key = |finding: &Finding| (finding.severity, place_of(finding), finding.rule);
        if count > limit {
            // Of many only a few are shown.
            let mut keys: Vec<_> = all.iter().map(key).zip(0..).collect();
            let (_, last, _) = keys.select_nth_unstable(limit - 1);
            let last = *last;
            let mut nth = 0..;
            all.retain(|finding| {
                nth.next()
                    .is_some_and(|nth: usize| (key(finding), nth) <= last)
            });
        }
        all.sort_by_key(key);
        (all, count)
    }
}

/// First and last byte of a finding's place.
pub(super) fn place_of(finding: &Finding) -> (usize, usize) {
    let range = finding.place.in_text();
    range.map_or((0, 0), |range| (range.start, range.end))
}
