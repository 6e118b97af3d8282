//! The observations between segments, by their two runs, with their number for each rule.

use super::compare::{Observed, RunId};
use crate::drawing::ContourKey;
use crate::finding::Rule;
use crate::rules::PAIR_RULES;
use rustc_hash::FxHashMap;

#[derive(Clone, Debug, Default)]
pub(super) struct Observations {
    /// Those that are reported pair by pair.
    between: FxHashMap<(RunId, RunId), Vec<Observed>>,
    /// Those that are reported by their place, which may be more than all others.
    ends: FxHashMap<(RunId, RunId), Vec<Observed>>,
    /// The number of observations of each rule.
    counts: [usize; PAIR_RULES.len()],
    /// The numbers of a contour's crossings with itself and of its empty slots, where there are any.
    pub(super) crossings: FxHashMap<ContourKey, usize>,
    pub(super) slots: FxHashMap<ContourKey, usize>,
}

impl Observations {
    pub(super) fn insert(&mut self, pair: (RunId, RunId), found: Vec<Observed>) {
        self.remove(&pair);
        for each in &found {
            self.counts[each.rule] += 1;
            if let Some(of) = self.own_of(each) {
                *of.entry(each.one.0).or_default() += 1;
            }
        }
        let (told, ends) = match found.iter().all(Observed::is_told) {
            true => (found, Vec::new()),
            false => found.into_iter().partition(Observed::is_told),
        };
        if !told.is_empty() {
            self.between.insert(pair, told);
        }
        if !ends.is_empty() {
            self.ends.insert(pair, ends);
        }
    }

    pub(super) fn remove(&mut self, pair: &(RunId, RunId)) -> Option<Vec<Observed>> {
        let gone = match (self.between.remove(pair), self.ends.remove(pair)) {
            (Some(told), Some(ends)) => [told, ends].concat(),
            (told, ends) => told.or(ends)?,
        };
        for each in &gone {
            self.counts[each.rule] -= 1;
            if let Some(of) = self.own_of(each)
                && let Some(count) = of.get_mut(&each.one.0)
            {
                *count -= 1;
                if *count == 0 {
                    of.remove(&each.one.0);
                }
            }
        }
        Some(gone)
    }

    /// Segments of a contour from `first` on have other indices.
    pub(super) fn shift(
        &mut self,
        pair: &(RunId, RunId),
        key: ContourKey,
        first: usize,
        by: isize,
    ) {
        let of_pair = [self.between.get_mut(pair), self.ends.get_mut(pair)];
        for each in of_pair.into_iter().flatten().flatten() {
            each.shift(key, first, by);
        }
    }

    fn own_of(&mut self, each: &Observed) -> Option<&mut FxHashMap<ContourKey, usize>> {
        if each.one.0 != each.other.0 || each.blocked {
            return None;
        }
        match PAIR_RULES[each.rule].rule {
            Rule::SelfIntersection => Some(&mut self.crossings),
            Rule::NarrowSlot => Some(&mut self.slots),
            _ => None,
        }
    }

    /// All observations, in no order.
    pub(super) fn all(&self) -> impl Iterator<Item = &Observed> {
        self.told().chain(self.ends.values().flatten())
    }

    /// Those that are reported pair by pair, in no order.
    pub(super) fn told(&self) -> impl Iterator<Item = &Observed> {
        self.between.values().flatten()
    }

    /// Those of one rule that is reported pair by pair; where there are none, the others are not looked at.
    pub(super) fn of(&self, rule: Rule) -> impl Iterator<Item = &Observed> {
        let of_rule = move |each: &&Observed| PAIR_RULES[each.rule].rule == rule;
        let between = self.has(rule).then(|| self.between.values().flatten());
        between.into_iter().flatten().filter(of_rule)
    }

    /// Those that are not reported pair by pair, in no order.
    pub(super) fn ends(&mut self) -> impl Iterator<Item = &mut Observed> {
        self.ends.values_mut().flatten()
    }

    pub(super) fn has(&self, rule: Rule) -> bool {
        let mut counts = PAIR_RULES.iter().zip(self.counts);
        counts.any(|(of, count)| of.rule == rule && count > 0)
    }
}
