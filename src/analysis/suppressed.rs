//! What the settings say of single entities of a drawing: what somebody has looked at and lets stand, with the reason, which is told
//! apart from all other findings; and what is said of contours that are not there.

use super::Analysis;
use crate::drawing::{Drawing, EntityId, Role};
use crate::finding::{Detail, Finding, Place, Rule, Severity};
use crate::geometry::{Bounds, Point};
use crate::settings::{Effective, NEAR, point_of};
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
        let asked = self.settings.suppressed.iter();
        let useless = asked
            .flat_map(|(handle, rules)| rules.keys().map(move |rule| (handle.clone(), *rule)))
            .filter(|asked| !used.contains(asked))
            .filter_map(|(handle, rule)| {
                self.settings_finding(say!(suppresses_nothing, handle, rule.name()))
            })
            .chain(self.strays(drawing))
            .collect();
        Judged {
            findings,
            suppressed,
            useless,
        }
    }

    /// What is said of contours that are not in the drawing.
    fn strays<'a>(&'a self, drawing: &'a Drawing) -> impl Iterator<Item = Finding> + 'a {
        let misses = |key: &&String| match point_of(key) {
            Some(at) => !drawing
                .entities()
                .any(|(id, _)| runs_through(drawing, &self.settings, id, at)),
            None => drawing.find(key).is_none(),
        };
        let missing = self.settings.own.keys().filter(misses);
        missing.filter_map(|key| {
            let name = self.settings.document.as_deref().unwrap_or_default();
            self.settings_finding(say!(no_contour_of_that_name, name, key))
        })
    }

    fn settings_finding(&self, sentence: String) -> Option<Finding> {
        Some(Finding {
            rule: Rule::Settings,
            severity: self
                .settings
                .severity_over(Rule::Settings, Severity::Warning)?,
            place: Place::Document,
            detail: Detail::Settings(sentence),
            related: Vec::new(),
        })
    }
}

/// The role that the settings give to an entity by its handle, or by a point that it runs through.
pub(super) fn own_role(drawing: &Drawing, settings: &Effective, id: EntityId) -> Option<Role> {
    let by_handle = || settings.contours.get(&*drawing.get(id)?.handle).copied();
    let through = |(at, _): &&(Point, Role)| runs_through(drawing, settings, id, *at);
    let by_point = || settings.points.iter().find(through).map(|(_, role)| *role);
    if settings.contours.is_empty() {
        by_point()
    } else {
        by_handle().or_else(by_point)
    }
}

/// Whether a point lies on an entity, within 0.01 mm.
fn runs_through(drawing: &Drawing, settings: &Effective, id: EntityId, at: Point) -> bool {
    let Some(entity) = drawing.get(id) else {
        return false;
    };
    let near = NEAR / settings.unit_of(drawing).mm;
    let flat = drawing.flat();
    entity
        .geometry
        .bounds(flat)
        .grown(near)
        .touches(&Bounds::of_points(&[at]))
        && entity
            .geometry
            .segments_of(flat)
            .any(|segment| segment.distance_to(at) <= near)
}
