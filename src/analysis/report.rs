//! Findings as they are gathered: counted all, kept up to a limit, the worst first.

use crate::finding::{Detail, Finding, Place, Rule, Severity};
use crate::settings::Effective;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Gathers findings. What comes first within its severity is kept.
#[derive(Debug)]
pub struct Report {
    settings: Arc<Effective>,
    limit: usize,
    kept: BTreeMap<Severity, Vec<Finding>>,
    count: usize,
}

impl Report {
    pub fn new(settings: Arc<Effective>, limit: usize) -> Report {
        Report { settings, limit, kept: BTreeMap::new(), count: 0 }
    }

    /// The severity of a rule, `mildest` where the case is milder than the rule; `None` where it is off.
    fn severity(&self, rule: Rule, mildest: Option<Severity>) -> Option<Severity> {
        let set = self.settings.severity(rule)?;
        Some(mildest.map_or(set, |mildest| set.max(mildest)))
    }

    /// Counts a finding. True when it should be worked out and added.
    pub fn counts(&mut self, rule: Rule, mildest: Option<Severity>) -> bool {
        let Some(severity) = self.severity(rule, mildest) else { return false };
        self.count += 1;
        self.kept.get(&severity).is_none_or(|kept| kept.len() < self.limit)
    }

    /// Adds a finding that has been counted.
    pub fn add(&mut self, rule: Rule, mildest: Option<Severity>, place: Place, detail: Detail, related: Vec<Place>) {
        if let Some(severity) = self.severity(rule, mildest) {
            self.kept.entry(severity).or_default().push(Finding { rule, severity, place, detail, related });
        }
    }

    /// The findings, the worst first, and how many there are in all.
    pub fn finish(self) -> (Vec<Finding>, usize) {
        let mut findings: Vec<Finding> = self.kept.into_values().flatten().collect();
        findings.truncate(self.limit);
        (findings, self.count)
    }
}
