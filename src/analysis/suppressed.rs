//! What somebody has looked at and lets stand, with the reason: it is told apart from all other findings.

use super::Analysis;
use crate::drawing::{Drawing, EntityId};
use crate::finding::{Detail, Finding, Place, Rule, Severity};
use std::collections::BTreeSet;

/// All findings of a drawing in which something is suppressed.
pub(super) struct Judged {
    pub(super) findings: Vec<Finding>,
    pub(super) suppressed: Vec<(Finding, String)>,
    /// What is said of suppressions that suppress nothing.
    pub(super) useless: Vec<Finding>,
}

impl Analysis {
    /// What is suppressed, each with the reason.
    pub(crate) fn suppressed(&mut self, drawing: &Drawing) -> Vec<(Finding, String)> {
        if self.settings.suppressed.is_empty() {
            return Vec::new();
        }
        self.judged(drawing).suppressed
    }

    /// Why a finding of a rule at an entity is let stand.
    pub(super) fn reason(&self, drawing: &Drawing, rule: Rule, id: EntityId) -> Option<&String> {
        let handle = &drawing.get(id)?.handle;
        self.settings.suppressed.get(&**handle)?.get(&rule)
    }

    pub(super) fn judged(&mut self, drawing: &Drawing) -> Judged {
        let (mut all, _) = self.report(drawing, usize::MAX).finish();
        self.give_reasons(drawing, &mut all);
        let mut used: BTreeSet<(String, Rule)> = BTreeSet::new();
        let (mut findings, mut suppressed) = (Vec::new(), Vec::new());
        for finding in all {
            let (Place::Segment { entity, .. } | Place::Entity { entity }) = finding.place else {
                findings.push(finding);
                continue;
            };
            match self.reason(drawing, finding.rule, entity).cloned() {
                Some(reason) => {
                    let handle = drawing.get(entity).map(|entity| entity.handle.to_string());
                    used.extend(handle.map(|handle| (handle, finding.rule)));
                    suppressed.push((finding, reason));
                }
                None => findings.push(finding),
            }
        }
        let severity = self
            .settings
            .severity_over(Rule::Settings, Severity::Warning);
        let asked = self.settings.suppressed.iter();
        let useless = asked
            .flat_map(|(handle, rules)| rules.keys().map(move |rule| (handle.clone(), *rule)))
            .filter(|asked| !used.contains(asked))
            .filter_map(|(handle, rule)| {
                Some(Finding {
                    rule: Rule::Settings,
                    severity: severity?,
                    place: Place::Document,
                    detail: Detail::Settings(say!(suppresses_nothing, handle, rule.name())),
                    related: Vec::new(),
                })
            })
            .collect();
        Judged {
            findings,
            suppressed,
            useless,
        }
    }
}
