//! Repairs of all rules except `small-radius`: each is tried before it is offered.

use super::Analysis;
use super::report::Tally;
use crate::drawing::{Change, Drawing, DrawingEdit, EntityId};
use crate::finding::{Finding, Fix, Rule};
use rustc_hash::FxHashSet;
use std::borrow::Cow;

/// Rules whose safe repairs "fix all" makes before it makes arcs larger: otherwise only one of two identical lines
/// would be moved, and the arcs of an open contour have no side.
pub(super) const FIRST: [Rule; 3] = [Rule::DuplicateEntity, Rule::Overlap, Rule::OpenContour];

/// The rules whose safe repairs it makes after that: only those of the first rule that has any.
pub(super) const THEN: [Rule; 3] = [Rule::ShortSegment, Rule::Gap, Rule::ArcAsChords];

/// Edits that are tried before a rule is given up: each costs a look at the drawing. In a large
/// drawing, as many as read about this many segments, but at least two.
const TRIES: usize = 24;
const SEGMENTS: usize = 4_000_000;

/// The number of edits rejected by the contours alone that together cost as much as one look.
const ON_SIGHT: usize = 16;

/// Parts that are tried one by one where only one is wanted, or all together do nothing.
const ALONE: usize = 8;

/// The result of a tentative edit.
pub(super) enum Tried<M> {
    Better(M),
    /// A look at the drawing showed that it does not help.
    Worse,
    /// The contours alone show that it does not help.
    PlainlyWorse,
}

impl<M> Tried<M> {
    pub(super) fn of(better: Option<M>) -> Tried<M> {
        better.map_or(Tried::Worse, Tried::Better)
    }

    pub(super) fn map<N>(self, made: impl FnOnce(M) -> N) -> Tried<N> {
        match self {
            Tried::Better(better) => Tried::Better(made(better)),
            Tried::Worse => Tried::Worse,
            Tried::PlainlyWorse => Tried::PlainlyWorse,
        }
    }

    fn better(self) -> Option<M> {
        match self {
            Tried::Better(made) => Some(made),
            Tried::Worse | Tried::PlainlyWorse => None,
        }
    }
}

/// Whether the edit of one fix can be made in the source of the drawing; `None` where every edit can.
pub(super) type Can<'a> = Option<&'a dyn Fn(&DrawingEdit) -> bool>;

/// Which of the safe repairs are wanted.
#[derive(Clone, Copy, Default)]
pub(super) struct Wanted<'a> {
    pub(crate) can: Can<'a>,
    /// Only whether there is one.
    pub(crate) first_will_do: bool,
    /// All findings, if the caller has them.
    pub(crate) found: Option<&'a [Finding]>,
}

impl Analysis {
    /// The fixes of a finding of `rule` that make nothing worse and remove the finding.
    pub(super) fn checked(&self, drawing: &Drawing, rule: Rule, fixes: Vec<Fix>) -> Vec<Fix> {
        if fixes.is_empty() {
            return fixes;
        }
        let before = self.tallied(drawing);
        fixes
            .into_iter()
            .filter(|fix| {
                let tried = self.mends(drawing, rule, before, &fix.edit);
                tried.better().is_some()
            })
            .collect()
    }

    /// The findings after an edit that is possible, leaves no more errors than `before`, no more errors and warnings
    /// together, and fewer findings of `rule`.
    fn mends(
        &self,
        drawing: &Drawing,
        rule: Rule,
        before: &Tally,
        edit: &DrawingEdit,
    ) -> Tried<Tally> {
        let mut edited = drawing.clone();
        let Ok(delta) = edited.apply(edit) else {
            return Tried::PlainlyWorse;
        };
        let chained = match rule {
            Rule::OpenContour => None,
            _ => self.plainly_opens((drawing, &edited), &delta, before),
        };
        // In a map whose borders all meet, chaining again is itself a look at the drawing.
        let rejected = chained.map(|chained| match chained * ON_SIGHT <= edited.len() {
            true => Tried::PlainlyWorse,
            false => Tried::Worse,
        });
        if !cfg!(debug_assertions)
            && let Some(rejected) = rejected
        {
            return rejected;
        }
        let mut tried = self.updated(&edited, &delta);
        let after = tried.tally(&edited);
        // Chords beyond one circle may leave a second sequence behind.
        let is_less = after.of(rule) < before.of(rule)
            || (rule == Rule::ArcAsChords && after.of(rule) <= before.of(rule))
            // Where the search had reached its limit, other findings may appear.
            || after.unseen < before.unseen;
        let is_no_worse = match rule {
            Rule::OpenContour => after.is_no_worse_once_closed(before),
            _ => after.is_no_worse_than(before, rule),
        };
        let is_better =
            is_less && is_no_worse && self.keeps_fits(drawing, (&mut tried, &edited), &mut 0);
        debug_assert!(rejected.is_none() || !is_better, "{before:?} {after:?}");
        rejected.unwrap_or_else(|| Tried::of(is_better.then_some(after)))
    }

    /// The number of edits that are tried.
    pub(super) fn tries(&self) -> usize {
        (SEGMENTS / self.segments.max(1)).clamp(2, TRIES)
    }

    /// The findings of the present drawing.
    pub(super) fn tallied(&self, drawing: &Drawing) -> &Tally {
        self.tally.get_or_init(|| self.clone().tally(drawing))
    }

    /// True when an edit that makes an arc larger leaves fewer tight arcs, no more errors, and no new open end,
    /// overlap, crossing or crumb. If only one of two identical lines is moved, the contour falls
    /// apart.
    ///
    /// An arc that keeps its ends leaves the same material even if another rule, `spared`, then reports it. The looks
    /// that this takes are added to `looks`.
    pub(super) fn enlarges(
        &self,
        drawing: &Drawing,
        edit: &DrawingEdit,
        spared: Option<Rule>,
        looks: &mut u64,
    ) -> bool {
        let mut edited = drawing.clone();
        let Ok(delta) = edited.apply(edit) else {
            return false;
        };
        let touched: FxHashSet<EntityId> = edit.changes.iter().map(Change::entity).collect();
        if self.tight(&edited, &touched) >= self.tight(drawing, &touched) {
            return false;
        }
        let mut tried = self.updated(&edited, &delta);
        let (before, after) = (self.tallied(drawing), tried.tally(&edited));
        *looks = looks.saturating_add(tried.pairs.looks());
        after.of(Rule::SmallRadius) < before.of(Rule::SmallRadius)
            && after.spoils_nothing(before, spared)
            && self.keeps_fits(drawing, (&mut tried, &edited), looks)
    }

    /// One edit that makes all safe repairs of one of the rules that do not collide.
    pub(super) fn fix_all_else(
        &self,
        drawing: &Drawing,
        rules: &[Rule],
        wanted: Wanted,
    ) -> Option<DrawingEdit> {
        let before = self.tallied(drawing);
        let rules: Vec<Rule> = rules
            .iter()
            .copied()
            .filter(|rule| before.of(*rule) > 0)
            .collect();
        if rules.is_empty() {
            return None;
        }
        let findings = match wanted.found {
            Some(found) => Cow::Borrowed(found),
            None => self.clone().findings(drawing, usize::MAX).0.into(),
        };
        for rule in rules {
            let each = rule == Rule::ArcAsChords;
            let each = each.then(|| self.clone().each_finding(drawing));
            let findings = each.as_deref().unwrap_or(&findings);
            let of_rule = findings.iter().filter(|finding| finding.rule == rule);
            let fixes = of_rule.filter_map(|finding| {
                let crate::finding::Place::Segment { entity, segment } = finding.place else {
                    return None;
                };
                let fixes = self.other_fixes(drawing, finding, (entity, segment))?;
                let fix = fixes
                    .into_iter()
                    .find(|fix| fix.preferred && fix.in_fix_all)?;
                // An impossible repair must not block the others.
                let accepted = fix
                    .edit
                    .changes
                    .iter()
                    .all(|change| drawing.accepts(change).is_ok());
                (accepted && wanted.can.is_none_or(|can| can(&fix.edit))).then_some(fix.edit)
            });
            if let Some(edit) = self.most_of(drawing, rule, apart(fixes), wanted) {
                return Some(edit);
            }
        }
        None
    }

    /// One edit that rounds the corners in which parts bind. The fit proves each; a radius below the correction may
    /// result, and the fit decides whether it matters.
    pub(super) fn fix_all_fits(&self, drawing: &Drawing, wanted: Wanted) -> Option<DrawingEdit> {
        self.settings.fit().ok()?;
        let (findings, _) = self.clone().findings(drawing, usize::MAX);
        let of_rule = findings
            .iter()
            .filter(|finding| finding.rule == Rule::DoesNotFit);
        let fixes = of_rule.filter_map(|finding| {
            let fix = self
                .fit_fix(drawing, finding)
                .filter(|fix| fix.in_fix_all)?;
            wanted
                .can
                .is_none_or(|can| can(&fix.edit))
                .then_some(fix.edit)
        });
        let edits = apart(fixes);
        let before = self.tallied(drawing);
        most_together(edits, self.tries(), wanted, |together, _| {
            let changes = together.iter().flat_map(|edit| &edit.changes);
            let tried = DrawingEdit {
                changes: changes.cloned().collect(),
            };
            let mut edited = drawing.clone();
            let Ok(delta) = edited.apply(&tried) else {
                return Tried::PlainlyWorse;
            };
            let mut after = self.updated(&edited, &delta);
            let spoils_nothing =
                (after.tally(&edited)).spoils_nothing(before, Some(Rule::SmallRadius));
            let mut fits_better = || {
                let fitting = after.fitting(&edited, &mut 0);
                let is_better = |before| fitting.is_some_and(|now| now.is_better_than(before));
                self.fitting_of(drawing).is_some_and(is_better)
            };
            Tried::of((spoils_nothing && fits_better()).then_some(tried))
        })
    }

    /// One edit of as many of these as go together without making anything worse.
    fn most_of(
        &self,
        drawing: &Drawing,
        rule: Rule,
        edits: impl Iterator<Item = DrawingEdit>,
        wanted: Wanted,
    ) -> Option<DrawingEdit> {
        let most = most_together(
            edits,
            self.tries(),
            wanted,
            |together, best: Option<&(DrawingEdit, Tally)>| {
                let tried = DrawingEdit {
                    changes: together
                        .iter()
                        .flat_map(|edit| &edit.changes)
                        .cloned()
                        .collect(),
                };
                let before = best.map_or_else(|| self.tallied(drawing), |(_, tally)| tally);
                let after = self.mends(drawing, rule, before, &tried);
                after.map(|after| (tried, after))
            },
        );
        most.map(|(edit, _)| edit)
    }
}

/// The result of as many parts as go together: if not all of them do, each half is tried together
/// with those taken so far, then the halves of that half. `made` is given the parts and the result
/// of those taken so far.
///
/// Where no try succeeds, the first [`ALONE`] are tried each by itself; if one is enough, they are tried before all others.
pub(super) fn most_together<T: Clone, M>(
    mut parts: impl Iterator<Item = T>,
    tries: usize,
    wanted: Wanted,
    made: impl Fn(&[T], Option<&M>) -> Tried<M>,
) -> Option<M> {
    let first: Vec<T> = parts.by_ref().take(ALONE).collect();
    if first.is_empty() {
        return None;
    }
    let alone = |one: &T| made(std::slice::from_ref(one), None).better();
    if wanted.first_will_do
        && let Some(made) = first.iter().find_map(alone)
    {
        return Some(made);
    }
    let parts: Vec<T> = first.iter().cloned().chain(parts).collect();
    let (mut taken, mut best) = (Vec::new(), None);
    let mut failed_alone = FxHashSet::default();
    let all = 0..parts.len();
    let mut waiting = vec![all];
    let mut left = tries * ON_SIGHT;
    while left > 0
        && let Some(some) = waiting.pop()
    {
        if wanted.first_will_do && some.len() == 1 && some.end <= first.len() {
            continue; // It has been tried by itself.
        }
        let together = [taken.as_slice(), &parts[some.clone()]].concat();
        let tried = made(&together, best.as_ref());
        let cost = match tried {
            Tried::PlainlyWorse => 1,
            Tried::Better(_) | Tried::Worse => ON_SIGHT,
        };
        left = left.saturating_sub(cost);
        if let Some(more) = tried.better() {
            (taken, best) = (together, Some(more));
            if wanted.first_will_do {
                break;
            }
        } else if some.len() > 1 {
            let middle = some.start + some.len() / 2;
            waiting.extend([middle..some.end, some.start..middle]);
        } else {
            failed_alone.insert(some.start);
        }
    }
    let is_tried = wanted.first_will_do || waiting.is_empty();
    let untried = first.iter().enumerate();
    let mut untried = untried.filter(|(at, _)| !is_tried && !failed_alone.contains(at));
    best.or_else(|| untried.find_map(|(_, one)| alone(one)))
}

/// The target of a change: an entity, or one vertex of it.
type Claim = (EntityId, Option<usize>);

/// The edits, from the first on, that touch neither the same entity nor adjacent vertices.
fn apart(edits: impl Iterator<Item = DrawingEdit>) -> impl Iterator<Item = DrawingEdit> {
    let mut claimed: FxHashSet<Claim> = FxHashSet::default();
    let mut claimed_in: FxHashSet<EntityId> = FxHashSet::default();
    edits.filter(move |edit| {
        let claims: Vec<Claim> = edit.changes.iter().map(claim).collect();
        let is_free = claims.iter().all(|&(entity, vertex)| match vertex {
            None => !claimed_in.contains(&entity),
            Some(index) => {
                !claimed.contains(&(entity, None))
                    && (index.saturating_sub(1)..=index + 1)
                        .all(|near| !claimed.contains(&(entity, Some(near))))
            }
        });
        if is_free {
            claimed_in.extend(claims.iter().map(|claim| claim.0));
            claimed.extend(claims);
        }
        is_free
    })
}

fn claim(change: &Change) -> Claim {
    match *change {
        Change::SetVertex { entity, index, .. }
        | Change::RemoveVertex { entity, index }
        | Change::InsertVertex { entity, index, .. } => (entity, Some(index)),
        _ => (change.entity(), None),
    }
}
