//! The findings of a program: those of its blocks, as far as they count where they stand, and those of the whole.

use super::super::fields::fields_of;
use super::super::rules::{self, Counts};
use super::super::stretch::Local;
use super::{Cut, Document};
use crate::finding::{Detail, Finding, Place, Rule, Severity};
use crate::settings::{Effective, SideSetting};

/// Where a finding is kept.
#[derive(Clone, Copy, Debug)]
enum Kept {
    InBlock { stretch: usize, index: usize },
    OnWhole { index: usize },
}

impl Document {
    /// All findings as the reader and the rules see them, in no order.
    pub fn findings(&self) -> Vec<Finding> {
        let of_blocks = self
            .locals()
            .map(|(stretch, local)| self.materialized(stretch, local));
        of_blocks
            .chain(self.view.findings.iter().cloned())
            .collect()
    }

    /// At most `limit` findings under the settings' severities, errors first, then in the order of the text; and how many there are.
    pub fn findings_under(&self, settings: &Effective, limit: usize) -> (Vec<Finding>, usize) {
        let severity = |rule: Rule, own: Severity| settings.severity_over(rule, own);
        let mut order: Vec<(Severity, usize, Rule, Kept)> = Vec::new();
        for (stretch, of) in self
            .stretches
            .iter()
            .enumerate()
            .filter(|(_, of)| !of.faults.is_empty())
        {
            for (index, local) in of
                .faults
                .iter()
                .enumerate()
                .filter(|(_, local)| self.counts(stretch, local))
            {
                if let Some(severity) = severity(local.rule, self.own_severity(stretch, local)) {
                    order.push((
                        severity,
                        local.range.start + self.stretches.byte(stretch),
                        local.rule,
                        Kept::InBlock { stretch, index },
                    ));
                }
            }
        }
        for (index, finding) in self.view.findings.iter().enumerate() {
            if let (Some(severity), Place::Text { range }) =
                (severity(finding.rule, finding.severity), &finding.place)
            {
                order.push((severity, range.start, finding.rule, Kept::OnWhole { index }));
            }
        }
        order.sort_by_key(|(severity, start, rule, _)| (*severity, *start, *rule));
        let count = order.len();
        order.truncate(limit);
        let made = order.into_iter().filter_map(|(severity, _, _, which)| {
            let finding = match which {
                Kept::InBlock { stretch, index } => {
                    self.materialized(stretch, self.stretches.get(stretch)?.faults.get(index)?)
                }
                Kept::OnWhole { index } => self.view.findings.get(index)?.clone(),
            };
            Some(finding.with(severity))
        });
        (made.collect(), count)
    }

    fn locals(&self) -> impl Iterator<Item = (usize, &Local)> {
        let all = self
            .stretches
            .iter()
            .enumerate()
            .flat_map(|(stretch, of)| of.faults.iter().map(move |local| (stretch, local)));
        all.filter(|(stretch, local)| self.counts(*stretch, local))
    }

    fn cut_of_local(&self, stretch: usize, local: &Local) -> Option<Cut> {
        self.cut_of_part(&self.view, (stretch, local.part))
    }

    fn is_unusual_only(&self, stretch: usize, local: &Local) -> bool {
        local.counts == Counts::MildIfClosed
            && self
                .cut_of_local(stretch, local)
                .is_none_or(|cut| self.closes(&self.view, &cut))
    }

    fn own_severity(&self, stretch: usize, local: &Local) -> Severity {
        if self.is_unusual_only(stretch, local) {
            Severity::Information
        } else {
            local.rule.default_severity()
        }
    }

    fn counts(&self, stretch: usize, local: &Local) -> bool {
        let cut = || self.cut_of_local(stretch, local);
        match local.counts {
            Counts::Always | Counts::MildIfClosed => true,
            Counts::IfAlone => self.is_local_told(&self.view, stretch, local),
            Counts::IfOpen => cut().is_some_and(|cut| !self.closes(&self.view, &cut)),
            Counts::IfInside { turns_left } => cut().is_some_and(|cut| {
                let runs_left = cut.sum.twice_area > 0.0;
                let wire_is_inside = self.limits.side == SideSetting::Opening;
                (runs_left == wire_is_inside) == turns_left
            }),
        }
    }

    fn materialized(&self, stretch: usize, local: &Local) -> Finding {
        let base = self.stretches.byte(stretch);
        let block = local.range.start + base..local.range.end + base;
        let range = match local.spot {
            rules::Spot::Block => block,
            spot => fields_of(self.text.bytes(), block.clone())
                .map_or(block.clone(), |fields| spot.range(&fields, block)),
        };
        let detail = match &local.detail {
            Detail::Program(fault) if self.is_unusual_only(stretch, local) => {
                Detail::Program(Box::new(fault.as_unusual()))
            }
            detail => detail.clone(),
        };
        Finding::in_text(local.rule, range, detail).with(self.own_severity(stretch, local))
    }
}
