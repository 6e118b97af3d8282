//! What the settings and the drawing say about single entities: findings that somebody has
//! suppressed, listed apart with the reason; and settings for contours that do not exist.

use super::Analysis;
use crate::drawing::{Drawing, EntityId, Role, SUPPRESS, mark_of_layer};
use crate::finding::{Detail, Finding, Place, Rule, Severity};
use crate::geometry::{Bounds, Point};
use crate::settings::{Effective, NEAR, nearest, point_of};
use std::collections::BTreeSet;

/// All findings of a drawing with suppressions.
pub(super) struct Judged {
    pub(super) findings: Vec<Finding>,
    pub(super) suppressed: Vec<(Finding, String)>,
    /// Findings about suppressions that suppress nothing.
    pub(super) useless: Vec<Finding>,
}

impl Analysis {
    /// The suppressed ones, each with the reason.
    pub(crate) fn suppressed(&self, drawing: &Drawing) -> Vec<(Finding, String)> {
        if self.settings.suppressed.is_empty() && !drawing.has_marks() {
            return Vec::new();
        }
        self.clone().judged(drawing).suppressed
    }

    /// Why a finding of a rule at an entity is suppressed.
    pub(super) fn reason(&self, drawing: &Drawing, rule: Rule, id: EntityId) -> Option<String> {
        let handle = &drawing.get(id)?.handle;
        let of_handle = self.settings.suppressed.get(&**handle);
        let said = of_handle.and_then(|reasons| reasons.get(&rule));
        let drawn = || {
            let reasons = drawing.marks(id).filter_map(|mark| waiver(mark)?.ok());
            let mut of_rule = reasons.filter(|(of, _)| *of == rule);
            of_rule.next().map(|(_, reason)| reason.to_owned())
        };
        said.cloned().or_else(drawn)
    }

    pub(super) fn judged(&mut self, drawing: &Drawing) -> Judged {
        let mut all = self.each_finding(drawing);
        self.give_reasons(drawing, &mut all);
        let mut used: BTreeSet<(String, Rule)> = BTreeSet::new();
        let mut used_marks: BTreeSet<(EntityId, Rule)> = BTreeSet::new();
        let (mut findings, mut suppressed) = (Vec::new(), Vec::new());
        for finding in all {
            let (Place::Segment { entity, .. } | Place::Entity { entity }) = finding.place else {
                findings.push(finding);
                continue;
            };
            match self.reason(drawing, finding.rule, entity) {
                Some(reason) => {
                    let handle = drawing.get(entity).map(|entity| entity.handle.to_string());
                    used.extend(handle.map(|handle| (handle, finding.rule)));
                    used_marks.insert((entity, finding.rule));
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
                let sentence = say!(suppresses_nothing, handle, rule.name());
                self.settings_finding(Place::Document, sentence)
            })
            .chain(self.strays(drawing))
            .chain(self.useless_marks(drawing, &used_marks))
            .collect();
        Judged {
            findings: self.together_again(drawing, findings),
            suppressed,
            useless,
        }
    }

    /// Findings about marks in the drawing that suppress nothing, one for each entity or layer.
    fn useless_marks(&self, drawing: &Drawing, used: &BTreeSet<(EntityId, Rule)>) -> Vec<Finding> {
        let mut marked: Vec<EntityId> = drawing.marked().collect();
        marked.sort_unstable_by_key(|id| drawing.rank(*id));
        let mut useful: BTreeSet<(&str, &str)> = BTreeSet::new();
        let mut useless: Vec<((&str, &str), EntityId)> = Vec::new();
        for id in marked {
            let Some(entity) = drawing.get(id) else {
                continue;
            };
            for mark in drawing.marks(id) {
                let is_of_layer = mark_of_layer(&entity.layer) == Some(mark);
                let bearer = if is_of_layer {
                    &*entity.layer
                } else {
                    &*entity.handle
                };
                match waiver(mark) {
                    Some(Ok((rule, _))) if used.contains(&(id, rule)) => {
                        useful.insert((bearer, mark));
                    }
                    Some(_) => useless.push(((bearer, mark), id)),
                    None => {}
                }
            }
        }
        useless.retain(|(key, _)| useful.insert(*key));
        let told = useless.into_iter().filter_map(|((bearer, mark), entity)| {
            let sentence = match waiver(mark)? {
                Ok((rule, _)) => say!(suppresses_nothing, bearer, rule.name()),
                Err(name) => {
                    let names = Rule::ALL.map(Rule::name).join(", ");
                    match nearest(name, &names) {
                        Some(near) => say!(mark_did_you_mean, bearer, mark, near),
                        None => say!(mark_is_not_understood, bearer, mark),
                    }
                }
            };
            self.settings_finding(Place::Entity { entity }, sentence)
        });
        told.collect()
    }

    /// Findings about settings of contours that are not in the drawing.
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
            self.settings_finding(Place::Document, say!(no_contour_of_that_name, name, key))
        })
    }

    fn settings_finding(&self, place: Place, sentence: String) -> Option<Finding> {
        Some(Finding {
            rule: Rule::Settings,
            severity: self
                .settings
                .severity_over(Rule::Settings, Severity::Warning)?,
            place,
            detail: Detail::Said(sentence),
            related: Vec::new(),
        })
    }
}

/// The rule that a mark suppresses, and why: `suppress RULE: reason`, with blanks, `_` or colons between them. `None`
/// for other words; an error that quotes the rule where it is unknown or the reason is missing.
fn waiver(mark: &str) -> Option<Result<(Rule, &str), &str>> {
    let is_between =
        |letter: char| letter.is_whitespace() || matches!(letter, '_' | ':' | '\u{ff1a}');
    let (word, rest) = (mark.get(..SUPPRESS.len())?, mark.get(SUPPRESS.len()..)?);
    if !word.eq_ignore_ascii_case(SUPPRESS) {
        return None;
    }
    let rest = rest.trim_start_matches(is_between);
    let (name, reason) = rest.split_at(rest.find(is_between).unwrap_or(rest.len()));
    let reason = reason.trim_matches(is_between);
    let rule = Rule::ALL
        .into_iter()
        .find(|rule| rule.name().eq_ignore_ascii_case(name));
    let rule = rule.filter(|_| !reason.is_empty());
    Some(rule.map(|rule| (rule, reason)).ok_or(name))
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

/// Whether a point, mm, lies on an entity, within 0.01 mm.
fn runs_through(drawing: &Drawing, settings: &Effective, id: EntityId, at: Point) -> bool {
    let Some(entity) = drawing.get(id) else {
        return false;
    };
    let unit_mm = settings.unit_of(drawing).mm;
    let (near, at) = (NEAR / unit_mm, at / unit_mm);
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
