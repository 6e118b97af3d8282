//! What the rules on pairs of segments have seen, by the runs of segments that the two lie in.

use super::report::Report;
use crate::drawing::{ContourIndex, ContourKey, ContourSegment, EntityId};
use crate::finding::{Rule, Side};
use crate::geometry::{Bounds, Grid};
use crate::rules::{Limits, Outlook, PAIR_RULES, PairRule};
use crate::settings::Effective;
use rustc_hash::{FxHashMap, FxHashSet};

/// A run of segments of one contour.
pub type RunId = (ContourKey, u32);

/// A contour's outlook by key.
type Outlooks<'a, 'b> = &'a dyn Fn(ContourKey) -> Option<Outlook<'b>>;

/// What a pair rule has seen between two segments.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Index into [`PAIR_RULES`].
    rule: usize,
    one: (ContourKey, usize),
    other: (ContourKey, usize),
    sides: (Option<Side>, Option<Side>),
}

/// The runs of all contours by place, and what has been seen between them.
#[derive(Clone, Debug, Default)]
pub struct Pairs {
    grid: Grid<RunId>,
    seen: FxHashMap<(RunId, RunId), Vec<Seen>>,
    partners: FxHashMap<RunId, Vec<RunId>>,
}

impl Pairs {
    /// Forgets a contour as it was when it was looked at last.
    pub fn forget(&mut self, key: ContourKey, index: &ContourIndex) {
        for run in 0..index.run_count() {
            self.forget_run((key, run as u32), &index.bounds_of_run(run));
        }
    }

    /// Forgets a run with the box that it was looked at with.
    pub fn forget_run(&mut self, run: RunId, bounds: &Bounds) {
        self.grid.remove(run, bounds);
        for partner in self.partners.remove(&run).unwrap_or_default() {
            self.seen.remove(&ordered(run, partner));
            if let Some(of_partner) = self.partners.get_mut(&partner) {
                of_partner.retain(|other| *other != run);
            }
        }
    }

    /// Looks at new runs, with each other and with all that come near them.
    pub fn look(&mut self, outlook: Outlooks, limits: &Limits, settings: &Effective, runs: &[RunId]) {
        let rules: Vec<usize> = (0..PAIR_RULES.len()).filter(|&rule| settings.severity(PAIR_RULES[rule].rule).is_some()).collect();
        let reach = rules.iter().map(|&rule| (PAIR_RULES[rule].reach)(limits)).fold(0.0, f64::max);
        for &run in runs {
            if let Some(outlook) = outlook(run.0) {
                self.grid.insert(run, outlook.index.bounds_of_run(run.1 as usize));
            }
        }
        let new: FxHashSet<RunId> = runs.iter().copied().collect();
        for &run in runs {
            let Some(own) = outlook(run.0) else { continue };
            let area = own.index.bounds_of_run(run.1 as usize).grown(reach);
            let mut near = Vec::new();
            self.grid.near(&area, |other| {
                // Two new runs are looked at once.
                if !new.contains(&other) || run <= other {
                    near.push(other);
                }
            });
            let segments = segments_of(&own, run.1);
            for other in near {
                let Some(theirs) = outlook(other.0) else { continue };
                let found = if other == run {
                    look_within(&own, run, &segments, &rules, limits)
                } else {
                    look_between(&own, run, &segments, &theirs, other, &segments_of(&theirs, other.1), &rules, limits)
                };
                if !found.is_empty() {
                    self.seen.insert(ordered(run, other), found);
                    self.partners.entry(run).or_default().push(other);
                    if other != run {
                        self.partners.entry(other).or_default().push(run);
                    }
                }
            }
        }
    }

    /// Entities that lie in the same place as another.
    pub fn doubled(&self, outlook: Outlooks) -> FxHashSet<EntityId> {
        let mut doubled = FxHashSet::default();
        for seen in self.seen.values().flatten().filter(|seen| PAIR_RULES[seen.rule].rule == Rule::DuplicateEntity) {
            for (key, index) in [seen.one, seen.other] {
                doubled.extend(outlook(key).and_then(|outlook| outlook.segment(index as isize)).map(|segment| segment.entity));
            }
        }
        doubled
    }

    /// Adds the findings, in the order of their entities.
    pub fn report(&self, outlook: Outlooks, wire_sides: &FxHashMap<ContourKey, Option<Side>>, report: &mut Report) {
        let mut seen: Vec<(&Seen, Outlook, ContourSegment)> = Vec::new();
        for each in self.seen.values().flatten() {
            let concerned = |(key, side): (ContourKey, Option<Side>)| {
                let wire = wire_sides.get(&key).copied().flatten();
                side.is_none() || wire.is_none() || side == wire
            };
            if concerned((each.one.0, each.sides.0))
                && concerned((each.other.0, each.sides.1))
                && let Some(own) = outlook(each.one.0)
                && let Some(segment) = own.segment(each.one.1 as isize)
            {
                seen.push((each, own, segment));
            }
        }
        let place_of = |key: ContourKey, index: usize| outlook(key)?.segment(index as isize).map(|s| (s.entity, s.segment));
        seen.sort_by_cached_key(|(each, _, segment)| (each.rule, segment.entity, segment.segment, place_of(each.other.0, each.other.1)));
        for (each, own, _) in seen {
            let rule = &PAIR_RULES[each.rule];
            if report.counts(rule.rule, None)
                && let Some(theirs) = outlook(each.other.0)
                && let (Some(place), Some(related)) = (own.place(each.one.1), theirs.place(each.other.1))
                && let Some(detail) = (rule.detail)(&own, each.one.1, &theirs, each.other.1)
            {
                report.add(rule.rule, None, place, detail, vec![related]);
            }
        }
    }
}

fn ordered(one: RunId, other: RunId) -> (RunId, RunId) {
    if one <= other { (one, other) } else { (other, one) }
}

/// The segments of a run with their indices and boxes.
fn segments_of(outlook: &Outlook, run: u32) -> Vec<(usize, ContourSegment, Bounds)> {
    let segments = outlook.index.range_of(run as usize).filter_map(|index| Some((index, outlook.segment(index as isize)?)));
    segments.map(|(index, segment)| (index, segment, segment.geometry.bounds())).collect()
}

type Listed = [(usize, ContourSegment, Bounds)];

fn look_within(own: &Outlook, run: RunId, segments: &Listed, rules: &[usize], limits: &Limits) -> Vec<Seen> {
    let mut found = Vec::new();
    for (at, one) in segments.iter().enumerate() {
        for other in &segments[at + 1..] {
            look_at(own, run.0, one, own, run.0, other, rules, limits, &mut found);
        }
    }
    found
}

#[allow(clippy::too_many_arguments)]
fn look_between(
    own: &Outlook,
    run: RunId,
    segments: &Listed,
    theirs: &Outlook,
    other_run: RunId,
    others: &Listed,
    rules: &[usize],
    limits: &Limits,
) -> Vec<Seen> {
    let mut found = Vec::new();
    for one in segments {
        for other in others {
            look_at(own, run.0, one, theirs, other_run.0, other, rules, limits, &mut found);
        }
    }
    found
}

/// Lets the rules look at two segments whose boxes come near each other. The one of the earlier entity comes first,
/// so that the answer does not depend on how contours are keyed.
#[allow(clippy::too_many_arguments)]
fn look_at(
    own: &Outlook,
    key: ContourKey,
    one: &(usize, ContourSegment, Bounds),
    theirs: &Outlook,
    other_key: ContourKey,
    other: &(usize, ContourSegment, Bounds),
    rules: &[usize],
    limits: &Limits,
    found: &mut Vec<Seen>,
) {
    for &rule in rules {
        let PairRule { reach, look, .. } = &PAIR_RULES[rule];
        if !one.2.grown(reach(limits)).touches(&other.2) {
            continue;
        }
        let first = (one.1.entity, one.1.segment) <= (other.1.entity, other.1.segment);
        let (a, at, b, there, one, other) = match first {
            true => (own, one.0, theirs, other.0, (key, one.0), (other_key, other.0)),
            false => (theirs, other.0, own, one.0, (other_key, other.0), (key, one.0)),
        };
        if let Some(sides) = look(a, at, b, there, key == other_key) {
            found.push(Seen { rule, one, other, sides });
        }
    }
}
