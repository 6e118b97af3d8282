//! Repairs of all rules but `small-radius`: each is tried before it is offered.

use super::Analysis;
use super::report::Tally;
use crate::drawing::{Change, Drawing, DrawingEdit, EntityId};
use crate::finding::{Fix, Rule};
use rustc_hash::FxHashSet;

/// The rules whose safe repairs "fix all" makes, the first of them that has any.
const SAFE: [Rule; 4] = [Rule::DuplicateEntity, Rule::ShortSegment, Rule::Gap, Rule::ArcAsChords];

/// Edits that are tried before a rule is given up: each costs a look at the drawing.
const TRIES: usize = 24;

impl Analysis {
    /// Those of the fixes of a finding of `rule` that make nothing worse and let the finding go.
    pub(super) fn checked(&self, drawing: &Drawing, rule: Rule, fixes: Vec<Fix>) -> Vec<Fix> {
        if fixes.is_empty() {
            return fixes;
        }
        let before = self.clone().tally(drawing);
        fixes.into_iter().filter(|fix| self.mends(drawing, rule, &before, &fix.edit)).collect()
    }

    /// True when the edit can be made, leaves no more errors and no more warnings, and fewer findings of `rule`.
    fn mends(&self, drawing: &Drawing, rule: Rule, before: &Tally, edit: &DrawingEdit) -> bool {
        let (mut edited, mut analysis) = (drawing.clone(), self.clone());
        let Ok(delta) = edited.apply(edit) else { return false };
        analysis.update(&edited, &delta);
        let after = analysis.tally(&edited);
        // What one circle could not hold may leave a second sequence of chords behind.
        let is_less = after.of(rule) < before.of(rule) || (rule == Rule::ArcAsChords && after.of(rule) <= before.of(rule));
        is_less && after.is_no_worse_than(before)
    }

    /// One edit that makes the safe repairs of one rule, as many as do not collide.
    pub(super) fn fix_all_else(&self, drawing: &Drawing) -> Option<DrawingEdit> {
        let mut analysis = self.clone();
        let before = analysis.tally(drawing);
        let rules: Vec<Rule> = SAFE.into_iter().filter(|rule| before.of(*rule) > 0).collect();
        if rules.is_empty() {
            return None;
        }
        let (findings, _) = analysis.findings(drawing, usize::MAX);
        for rule in rules {
            let mut tries_left = TRIES;
            let of_rule = findings.iter().filter(|finding| finding.rule == rule);
            let fixes = of_rule.filter_map(|finding| {
                let crate::finding::Place::Segment { entity, segment } = finding.place else { return None };
                let fixes = self.other_fixes(drawing, finding, (entity, segment))?;
                let fix = fixes.into_iter().find(|fix| fix.preferred && fix.in_fix_all)?;
                // One that cannot be made must not stand in the way of the others.
                fix.edit.changes.iter().all(|change| drawing.accepts(change).is_ok()).then_some(fix.edit)
            });
            if let Some(edit) = self.most_of(drawing, rule, &before, &apart(fixes), &mut tries_left) {
                return Some(edit);
            }
        }
        None
    }

    /// All the edits as one; where that makes anything worse, the first half of them that does not.
    fn most_of(&self, drawing: &Drawing, rule: Rule, before: &Tally, edits: &[DrawingEdit], tries_left: &mut usize) -> Option<DrawingEdit> {
        if edits.is_empty() || *tries_left == 0 {
            return None;
        }
        *tries_left -= 1;
        let all = DrawingEdit { changes: edits.iter().flat_map(|edit| edit.changes.iter().cloned()).collect() };
        if self.mends(drawing, rule, before, &all) {
            return Some(all);
        }
        if edits.len() == 1 {
            return None;
        }
        let (first, second) = edits.split_at(edits.len() / 2);
        self.most_of(drawing, rule, before, first, tries_left).or_else(|| self.most_of(drawing, rule, before, second, tries_left))
    }
}

/// What a change claims for itself: an entity, or one vertex of it.
type Claim = (EntityId, Option<usize>);

/// Those of the edits, from the first on, that touch neither the same entity nor vertices next to each other.
fn apart(edits: impl Iterator<Item = DrawingEdit>) -> Vec<DrawingEdit> {
    let mut claimed: FxHashSet<Claim> = FxHashSet::default();
    let mut claimed_in: FxHashSet<EntityId> = FxHashSet::default();
    let mut accepted = Vec::new();
    for edit in edits {
        let claims: Vec<Claim> = edit.changes.iter().map(claim).collect();
        let is_free = claims.iter().all(|&(entity, vertex)| match vertex {
            None => !claimed_in.contains(&entity),
            Some(index) => {
                !claimed.contains(&(entity, None))
                    && (index.saturating_sub(1)..=index + 1).all(|near| !claimed.contains(&(entity, Some(near))))
            }
        });
        if is_free {
            claimed_in.extend(claims.iter().map(|claim| claim.0));
            claimed.extend(claims);
            accepted.push(edit);
        }
    }
    accepted
}

fn claim(change: &Change) -> Claim {
    match *change {
        Change::SetVertex { entity, index, .. } | Change::RemoveVertex { entity, index } | Change::InsertVertex { entity, index, .. } => {
            (entity, Some(index))
        }
        _ => (change.entity(), None),
    }
}
