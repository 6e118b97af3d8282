//! The observations of the rules on pairs of segments, by the runs of the two segments.

use super::again::Again;
use super::compare::{LOOKS_OF_A_PAIR, Observed, Outlooks, RunId, RunsAtHand, ordered};
use super::observations::Observations;
use super::search::{BOXES_OF_A_LOOK, MANY_RUNS, Search, shells_where_crowded};
use crate::drawing::{ContourIndex, ContourKey};
use crate::finding::Rule;
use crate::geometry::{Bounds, Grid, Point, Shell, Shells};
use crate::rules::{Limits, PAIR_RULES, PairRule};
use crate::settings::{Budget, Effective};
use rustc_hash::{FxHashMap, FxHashSet};

/// The runs of all contours by place, and the observations between them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pairs {
    pub(super) grid: Grid<RunId>,
    pub(super) seen: Observations,
    partners: FxHashMap<RunId, Vec<RunId>>,
    /// Runs near which something has come or gone: their discs must be checked again for being empty.
    stale: FxHashSet<RunId>,
    /// The number of pairs in `seen`.
    seen_count: usize,
    /// Runs that have not been compared with all their neighbours because of the limit.
    pub(super) uncompared: FxHashSet<RunId>,
    /// The largest reach of a rule.
    pub(super) reach: f64,
    /// The looks at the start of the last full comparison, and those that are left: for comparing, and for checking
    /// whether discs are empty.
    granted: u64,
    left: u64,
    left_to_ask: u64,
    most_seen: usize,
    /// Set where the limit was reached: forgotten runs that had neither been compared nor met by others; and whether
    /// something has changed that the compared ones may see.
    untold: FxHashSet<RunId>,
    is_disturbed: bool,
    /// The other forgotten runs, where the limit was reached.
    again: Again,
    /// The runs that are not what they were when the dead ends were last looked at.
    pub(super) changed: FxHashSet<RunId>,
    /// There are workpieces, which are not compared with each other.
    are_parts: bool,
}

impl Pairs {
    /// No observations yet, with the looks allowed for a drawing of this many segments and all later edits of it.
    pub(crate) fn new(budget: &Budget, segments: usize) -> Pairs {
        let granted = budget.granted(segments);
        Pairs {
            granted,
            left: granted,
            left_to_ask: granted,
            most_seen: budget.most_seen,
            ..Pairs::default()
        }
    }

    /// Resets the looks, for a tentative edit.
    pub(crate) fn refill(&mut self) {
        (self.left, self.left_to_ask) = (self.granted, self.granted);
    }

    /// The looks since they were granted, or reset.
    pub(crate) fn looks(&self) -> u64 {
        (self.granted - self.left).saturating_add(self.granted - self.left_to_ask)
    }

    /// True while the observations, edit by edit, equal those of a full comparison.
    pub(crate) fn is_as_fresh(&self) -> bool {
        self.is_within_budget() || self.is_settled()
    }

    /// To be called when everything has been compared, in the order of the drawing.
    pub(crate) fn settle(&mut self) {
        self.is_disturbed = false;
    }

    /// True where a full comparison ends at the limit, and changes since are only after that end: another full
    /// comparison would end there again.
    fn is_settled(&self) -> bool {
        let half = self.granted / 2;
        self.seen_count >= self.most_seen
            && self.left >= half
            && self.left_to_ask >= half
            && !self.is_disturbed
            && self.untold.is_empty()
            && self.again.is_empty()
    }

    /// True for a run that was left out of the comparison, and that none of the compared ones has met.
    fn is_left_out(&self, run: &RunId) -> bool {
        self.uncompared.contains(run) && !self.partners.contains_key(run)
    }

    /// True where a full comparison would finish: comparing each present pair at least once took at
    /// most half of the looks. Otherwise the order decides what is left out: compare everything.
    fn is_within_budget(&self) -> bool {
        let half = self.granted / 2;
        self.uncompared.is_empty()
            && self.seen_count < self.most_seen
            && self.left >= half
            && self.left_to_ask >= half
    }

    /// True when no observation between others depends on this contour, and the search among these is complete.
    pub(crate) fn may_spare(&self, key: ContourKey) -> bool {
        let depends = |each: &Observed| {
            each.disc.is_some() && !each.own_disc && each.one.0 != key && each.other.0 != key
        };
        let is_complete = if self.seen_count < self.most_seen {
            self.uncompared.is_empty()
        } else {
            // More is seen of this contour than is looked for; without it the limit is not reached.
            let among_others = |each: &&Observed| each.one.0 != key && each.other.0 != key;
            self.uncompared.iter().all(|run| run.0 == key)
                && self.seen.all().filter(among_others).count() < self.most_seen
        };
        is_complete && !self.seen.all().any(depends)
    }

    /// Forgets a contour as it was at the last comparison.
    pub(crate) fn forget(&mut self, key: ContourKey, index: &ContourIndex) {
        for run in 0..index.run_count() {
            self.forget_run((key, run as u32), &index.bounds_of_run(run));
        }
    }

    /// Forgets a run with its box at the last comparison.
    pub(crate) fn forget_run(&mut self, run: RunId, bounds: &Bounds) {
        self.grid.remove(run, bounds);
        self.disturb_ends(run);
        let is_limited = self.seen_count >= self.most_seen || !self.again.is_empty();
        if self.is_left_out(&run) {
            self.untold.insert(run);
        } else if is_limited && !self.uncompared.contains(&run) {
            self.again.forget(run, self.seen_count);
        } else {
            self.is_disturbed = true;
        }
        self.uncompared.remove(&run);
        self.disturb(run, bounds);
        for partner in self.partners.remove(&run).unwrap_or_default() {
            let gone = self.seen.remove(&ordered(run, partner)).unwrap_or_default();
            self.seen_count -= gone.len();
            if let Some(of_partner) = self.partners.get_mut(&partner) {
                of_partner.retain(|other| *other != run);
            }
        }
    }

    /// Contours with observations beside this one.
    pub(crate) fn beside(&self, key: ContourKey, runs: usize) -> FxHashSet<ContourKey> {
        let partners = (0..runs).filter_map(|run| self.partners.get(&(key, run as u32)));
        partners
            .flatten()
            .map(|other| other.0)
            .filter(|other| *other != key)
            .collect()
    }

    /// Whether runs of other contours come near these bounds of one.
    pub(crate) fn comes_near_others(&self, key: ContourKey, bounds: &Bounds) -> bool {
        let area = bounds.grown(self.reach);
        self.grid.any_near(&area, |(other, _)| other != key)
    }

    /// To be called when a run has come or gone within these bounds.
    fn disturb(&mut self, of: RunId, bounds: &Bounds) {
        if self.partners.is_empty() {
            return;
        }
        let (partners, stale) = (&self.partners, &mut self.stale);
        let (uncompared, untold) = (&self.uncompared, &self.untold);
        let (mut is_seen, mut is_near_the_end) = (false, false);
        self.grid.near(&bounds.grown(self.reach), |run, _| {
            let is_behind = uncompared.contains(&run) || untold.contains(&run);
            is_near_the_end |= is_behind;
            if partners.contains_key(&run) {
                stale.insert(run);
                is_seen = true;
            }
            is_seen |= !is_behind;
        });
        if !self.again.holds(&of) {
            self.is_disturbed |= is_seen;
        } else if is_near_the_end {
            self.again.comes_near_the_end();
        }
    }

    /// The same for many new runs: each of the others is checked for one of these near it.
    fn disturb_about(&mut self, outlook: Outlooks, new: &FxHashMap<RunId, u32>) {
        let is_disturbed = |run: &&RunId| {
            let bounds = outlook(run.0).map(|it| it.index.bounds_of_run(run.1 as usize));
            let is_new = |other: RunId| new.contains_key(&other);
            bounds.is_some_and(|it| self.grid.any_near(&it.grown(self.reach), is_new))
        };
        let disturbed = self.partners.keys().filter(is_disturbed);
        self.stale.extend(disturbed);
        self.is_disturbed = true;
    }

    /// Dead ends near a run must be worked out again.
    fn disturb_ends(&mut self, run: RunId) {
        if self.seen.has(Rule::LostPocket) {
            self.changed.insert(run);
        }
    }

    /// Runs with observations in common with this one.
    pub(super) fn partners_of(&self, run: RunId) -> impl Iterator<Item = RunId> {
        self.partners.get(&run).into_iter().flatten().copied()
    }

    /// Compares new runs with each other and with all that come near them.
    pub(crate) fn check(
        &mut self,
        outlook: Outlooks,
        limits: &Limits,
        settings: &Effective,
        runs: &[RunId],
    ) {
        let rules = rules_on(limits, settings);
        self.are_parts = !settings.workpieces.is_empty();
        self.reach = rules.iter().map(|(_, reach)| *reach).fold(0.0, f64::max);
        // Their order is that of the contours, whatever their keys.
        let new: FxHashMap<RunId, u32> = (0..).zip(runs).map(|(at, &run)| (run, at)).collect();
        // A new run may or may not be after the end of the comparison.
        let is_again = runs.iter().all(|run| self.again.holds(run));
        self.enter(outlook, runs, &new);
        let shells = shells_where_crowded(&self.grid, self.reach, outlook, runs);
        let search = Search {
            grid: &self.grid,
            shells: shells.as_ref(),
            rules: &rules,
            reach: self.reach,
            // Runs that had been compared are compared again completely.
            most_seen: self.most_seen.saturating_mul(1 + usize::from(is_again)),
            new: &new,
            are_parts: self.are_parts,
        };
        let mut kept = RunsAtHand::new(outlook);
        let compared = search.compared(&mut kept, runs, (self.left, self.seen_count));
        (self.left, self.seen_count) = (compared.left, compared.count);
        if is_again {
            let ends_there = self.again.compared(runs, compared.count);
            self.is_disturbed |= !ends_there || !compared.cut_short.is_empty();
        }
        self.uncompared.extend(compared.cut_short);
        for (run, other, found) in compared.seen {
            if found.iter().any(|seen| seen.disc.is_some()) {
                self.stale.insert(run);
            }
            self.seen.insert(ordered(run, other), found);
            self.partners.entry(run).or_default().push(other);
            if other != run {
                self.partners.entry(other).or_default().push(run);
            }
        }
        // A long line that comes or goes may mark many runs as stale that it comes nowhere near.
        let stale: Vec<RunId> = self.stale.iter().copied().collect();
        let shells =
            shells.or_else(|| shells_where_crowded(&self.grid, self.reach, outlook, &stale));
        self.ask_again(&mut kept, limits, shells.as_ref());
    }

    /// Enters runs by place, and marks what they come near.
    fn enter(&mut self, outlook: Outlooks, runs: &[RunId], new: &FxHashMap<RunId, u32>) {
        self.grid.reserve(runs.len());
        for &run in runs {
            if let Some(outlook) = outlook(run.0) {
                let bounds = outlook.index.bounds_of_run(run.1 as usize);
                self.grid.insert(run, bounds);
                if runs.len() < MANY_RUNS {
                    self.disturb(run, &bounds);
                }
            }
        }
        let is_known = |run| self.untold.contains(run) || self.again.holds(run);
        self.is_disturbed |= !runs.iter().all(is_known);
        for run in runs {
            self.disturb_ends(*run);
            self.untold.remove(run);
        }
        if runs.len() >= MANY_RUNS {
            self.disturb_about(outlook, new);
        }
    }

    /// Checks whether the discs of the stale runs' observations are empty, while looks are left.
    /// Those whose discs remain unchecked give no findings.
    fn ask_again(
        &mut self,
        kept: &mut RunsAtHand,
        limits: &Limits,
        shells: Option<&Shells<RunId>>,
    ) {
        let mut left = self.left_to_ask;
        let stale = std::mem::take(&mut self.stale);
        let partners = stale
            .iter()
            .filter_map(|run| Some((run, self.partners.get(run)?)));
        let mut asked: Vec<(RunId, RunId)> = partners
            .flat_map(|(&run, partners)| partners.iter().map(move |&partner| ordered(run, partner)))
            .collect();
        // In the order along the contours, so that cached data of one pair serve the next.
        let mut ranks: FxHashMap<ContourKey, u64> = FxHashMap::default();
        let outlook = kept.outlook;
        let mut rank = |key: ContourKey| {
            *ranks.entry(key).or_insert_with(|| {
                let first = outlook(key)
                    .and_then(|it| Some(it.drawing.rank(it.contour.pieces.first()?.entity)));
                first.unwrap_or(u64::MAX)
            })
        };
        let mut place = |(key, run): RunId| (rank(key), key, run);
        asked.sort_by_cached_key(|&(one, other)| ordered(place(one), place(other)));
        asked.dedup();
        for pair in asked {
            let Some(mut seen) = self.seen.remove(&pair) else {
                continue;
            };
            for each in &mut seen {
                each.blocked = each.disc.is_some_and(|disc| {
                    left == 0
                        || self.reaches_into(
                            (kept, shells),
                            limits,
                            disc,
                            (each.one.0, each.own_disc),
                            &mut left,
                        )
                });
            }
            if left == 0 && seen.iter().any(|each| each.disc.is_some()) {
                self.uncompared.insert(pair.0);
            }
            self.seen.insert(pair, seen);
        }
        self.left_to_ask = left;
    }

    /// True when some segment, of one contour alone or of all of its workpiece, reaches into a disc by more than rounding.
    fn reaches_into(
        &self,
        (kept, shells): (&mut RunsAtHand, Option<&Shells<RunId>>),
        limits: &Limits,
        (center, radius): (Point, f64),
        (of, is_own): (ContourKey, bool),
        left: &mut u64,
    ) -> bool {
        let radius = radius - (1e-6 * radius).max(limits.tolerances.clearance);
        let area = Bounds::of_disc(center, radius);
        let mut near = Vec::new();
        let found = |run: RunId, _: &Bounds| {
            if run.0 == of || !is_own {
                near.push(run);
            }
        };
        let looked = match shells {
            Some(shells) => shells.near(&Shell::of_disc(center, radius), 0.0, found),
            None => self.grid.near(&area, found),
        };
        if self.are_parts {
            let part = |key: ContourKey| (kept.outlook)(key).map(|it| it.part);
            let own = part(of);
            near.retain(|run| part(run.0) == own);
        }
        *left = left.saturating_sub(looked / BOXES_OF_A_LOOK);
        near.into_iter().any(|run| {
            kept.walls_of(run).is_some_and(|walls| {
                *left = left.saturating_sub(LOOKS_OF_A_PAIR + walls.each.len() as u64);
                walls.reach_into(&area, center, radius)
            })
        })
    }

    /// The number of runs that have not been compared with all their neighbours.
    pub(crate) fn uncompared(&self) -> usize {
        self.uncompared.len()
    }
}

/// The rules on pairs that are asked, by their indices, and how far each reaches.
fn rules_on(limits: &Limits, settings: &Effective) -> Vec<(usize, f64)> {
    let is_asked = |rule: &PairRule| settings.severity(rule.rule).is_some();
    let doubles_matter = (PAIR_RULES.iter()).any(|rule| rule.silent_for_doubles && is_asked(rule));
    let is_on =
        |rule: &PairRule| is_asked(rule) || (rule.rule == Rule::DuplicateEntity && doubles_matter);
    let rules = PAIR_RULES.iter().enumerate();
    rules
        .filter(|(_, rule)| is_on(rule))
        .map(|(at, rule)| (at, (rule.reach)(limits)))
        .collect()
}
