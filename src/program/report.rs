//! The findings of a program: those of its reader, under the settings' severities, errors first, then in the order of
//! the text.

use super::steps::Program;
use crate::finding::{Finding, Rule, Severity};
use crate::settings::Effective;
use std::collections::BinaryHeap;

/// A finding, made only where it is shown: a program may have a fault in every block.
pub(super) struct Unmade<'a> {
    pub(super) rule: Rule,
    pub(super) severity: Severity,
    /// The first byte of its block.
    pub(super) start: usize,
    pub(super) make: &'a dyn Fn() -> Finding,
}

impl Unmade<'_> {
    /// One that is made already.
    pub(super) fn hand_out(finding: &Finding, take: &mut dyn FnMut(&Unmade<'_>)) {
        take(&Unmade {
            rule: finding.rule,
            severity: finding.severity,
            start: place_of(finding).0,
            make: &|| finding.clone(),
        });
    }
}

/// A program with known faults.
pub(super) trait Report: Program {
    /// Hands out all findings, as the rules see them.
    fn each(&self, take: &mut dyn FnMut(&Unmade<'_>));

    fn all(&self) -> Vec<Finding> {
        let mut all = Vec::new();
        self.each(&mut |found| all.push((found.make)()));
        all
    }

    /// At most `limit` findings, and how many there are in all.
    fn told(&self, settings: &Effective, limit: usize) -> (Vec<Finding>, usize) {
        let (mut count, limit) = (0, limit.max(1));
        // The last one to be shown on top.
        let mut shown: BinaryHeap<(Severity, usize, usize)> = BinaryHeap::new();
        let mut made: Vec<Finding> = Vec::new();
        self.each(&mut |found| {
            let Some(severity) = settings.severity_over(found.rule, found.severity) else {
                return;
            };
            count += 1;
            let is_shown =
                |last: &(Severity, usize, usize)| (severity, found.start) < (last.0, last.1);
            let place = match shown.peek() {
                _ if made.len() < limit => made.len(),
                Some(last) if is_shown(last) => last.2,
                _ => return,
            };
            let finding = (found.make)().with(severity);
            match made.get_mut(place) {
                Some(other) => {
                    *other = finding;
                    shown.pop();
                }
                None => made.push(finding),
            }
            shown.push((severity, found.start, place));
        });
        made.sort_by_key(|finding| (finding.severity, place_of(finding), finding.rule));
        (made, count)
    }
}

/// First and last byte of a finding's place.
pub(super) fn place_of(finding: &Finding) -> (usize, usize) {
    let range = finding.place.in_text();
    range.map_or((0, 0), |range| (range.start, range.end))
}
