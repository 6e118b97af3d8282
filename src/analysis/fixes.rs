//! The fixes of one finding, and of all.

use super::Analysis;
use super::repair::{self, Wanted};
use crate::drawing::{Drawing, DrawingEdit, EntityId};
use crate::finding::{Finding, Fix, FixKind, Place, Rule};
use crate::rules::{CONTOUR_RULES, LOCAL_RULES, Observation, PAIR_RULES, Wall, small_radius};

impl Analysis {
    /// The fixes of one finding, the preferred one first; empty where there is none.
    pub fn fixes(&self, drawing: &Drawing, finding: &Finding) -> Vec<Fix> {
        let Place::Segment { entity, segment } = &finding.place else {
            return Vec::new();
        };
        if finding.rule == Rule::DoesNotFit {
            return self.fit_fix(drawing, finding).into_iter().collect();
        }
        if finding.rule != Rule::SmallRadius {
            return self.checked(
                drawing,
                finding.rule,
                self.other_fixes(drawing, finding, (*entity, *segment))
                    .unwrap_or_default(),
            );
        }
        let Some((key, index)) = self.chains.index_of(*entity, *segment) else {
            return Vec::new();
        };
        let mut fixes = Vec::new();
        let found = self
            .attempt(drawing, key, index)
            .and_then(|(_, replacement)| replacement.ok());
        let old = self
            .chains
            .get(key)
            .and_then(|contour| contour.segment(drawing, index))
            .map(|segment| segment.geometry);
        let is_notch = found.zip(old).is_some_and(|(replacement, old)| {
            let ends = [old.start(), old.end()];
            ends.contains(&replacement.arc.start) && ends.contains(&replacement.arc.end)
        });
        fixes.extend(self.larger_arc(drawing, key, index, &mut 0));
        let place = self
            .chains
            .get(key)
            .and_then(|contour| contour.segment(drawing, index));
        if let Some(place) = place.filter(|_| !is_notch)
            && let Some((edit, kink)) = small_radius::keep_end_points(drawing, &place, &self.limits)
            && self.enlarges(drawing, &edit, Some(Rule::LostPocket), &mut 0)
        {
            let kind = FixKind::KeepEndPoints {
                radius: self.limits.fix_radius,
                kink,
            };
            fixes.push(Fix {
                kind,
                preferred: false,
                in_fix_all: false,
                edit,
            });
        }
        fixes
    }

    /// The repair of a finding that "fix all" would make, if `may` holds for it; that is asked first, since the proof takes a
    /// look at the drawing.
    pub(crate) fn safe_fix(
        &self,
        drawing: &Drawing,
        finding: &Finding,
        may: &dyn Fn(&DrawingEdit) -> bool,
    ) -> Option<Fix> {
        let at = match finding.place {
            Place::Segment { entity, segment } => (entity, segment),
            _ => return None,
        };
        let is_wanted = |fix: &Fix| fix.preferred && fix.in_fix_all && may(&fix.edit);
        match finding.rule {
            Rule::DoesNotFit => self.fit_fix(drawing, finding).filter(is_wanted),
            Rule::SmallRadius => {
                let (key, index) = self.chains.index_of(at.0, at.1)?;
                let arc = self.proposed_arc(drawing, key, index)?;
                let is_proved = |fix: &Fix| self.enlarges(drawing, &fix.edit, None, &mut 0);
                Some(arc).filter(is_wanted).filter(is_proved)
            }
            rule => {
                let mut fixes = self.other_fixes(drawing, finding, at)?;
                fixes.retain(is_wanted);
                self.checked(drawing, rule, fixes).into_iter().next()
            }
        }
    }

    /// The fixes of a finding of any rule but `small-radius`.
    pub(super) fn other_fixes(
        &self,
        drawing: &Drawing,
        finding: &Finding,
        at: (EntityId, usize),
    ) -> Option<Vec<Fix>> {
        let (key, index) = self.chains.index_of(at.0, at.1)?;
        let outlook = self.outlook(drawing, key)?;
        if let Some(rule) = LOCAL_RULES.iter().find(|local| local.rule == finding.rule) {
            return Some((rule.fixes)(&outlook, Observation::at(index)));
        }
        if let Some(rule) = CONTOUR_RULES.iter().find(|rule| rule.rule == finding.rule) {
            return Some((rule.fixes)(&outlook));
        }
        let rule = PAIR_RULES.iter().find(|pair| pair.rule == finding.rule)?;
        let mut fixes: Vec<Fix> = Vec::new();
        for related in &finding.related {
            let Place::Segment { entity, segment } = related else {
                return None;
            };
            let (other_key, other_index) = self.chains.index_of(*entity, *segment)?;
            let theirs = self.outlook(drawing, other_key)?;
            let found = (rule.fixes)(
                &Wall::new(&outlook, index)?,
                &Wall::new(&theirs, other_index)?,
            );
            // Of several doubles all go at once.
            match fixes.first_mut().zip(found.first()) {
                Some((all, more)) => all.edit.changes.extend(more.edit.changes.iter().cloned()),
                None => fixes.extend(found),
            }
        }
        Some(fixes)
    }

    /// One edit that makes every safe fix; `None` where there is none.
    ///
    /// Doubles first, then arcs; only where there are none of these to fix, the safe fixes of the other rules, one rule
    /// at a time: call again until nothing is left.
    pub fn fix_all(&self, drawing: &Drawing) -> Option<DrawingEdit> {
        self.fix_all_of(drawing, Wanted::default())
    }

    /// As [`Analysis::fix_all`], but only with the fixes for which `can` holds.
    pub(crate) fn fix_all_that(
        &self,
        drawing: &Drawing,
        can: &dyn Fn(&DrawingEdit) -> bool,
    ) -> Option<DrawingEdit> {
        let can = Some(can);
        self.fix_all_of(
            drawing,
            Wanted {
                can,
                ..Wanted::default()
            },
        )
    }

    /// Whether [`Analysis::fix_all_that`] would change anything: the first change is enough. `found` are all findings,
    /// if the caller has them.
    pub(crate) fn has_fix_that(
        &mut self,
        drawing: &Drawing,
        found: Option<&[Finding]>,
        can: &dyn Fn(&DrawingEdit) -> bool,
    ) -> bool {
        if self.tally.get().is_none() {
            self.tally = self.tally(drawing).into();
        }
        let wanted = Wanted {
            can: Some(can),
            first_will_do: true,
            found,
        };
        self.fix_all_of(drawing, wanted).is_some()
    }

    fn fix_all_of(&self, drawing: &Drawing, wanted: Wanted) -> Option<DrawingEdit> {
        // Where not all has been compared, no repair can be shown to make nothing worse, and each try costs as much again.
        if self.pairs.uncompared() > 0 {
            return None;
        }
        let doubles = self.fix_all_else(drawing, &repair::FIRST, wanted);
        doubles
            .or_else(|| self.fix_all_arcs(drawing, wanted))
            .or_else(|| self.fix_all_else(drawing, &repair::THEN, wanted))
            .or_else(|| self.fix_all_fits(drawing, wanted))
    }
}
