//! What has been observed between segments, by their two runs, and how much of each rule there is.

use super::compare::{Observed, RunId};
use crate::finding::Rule;
use crate::rules::PAIR_RULES;
use rustc_hash::FxHashMap;

#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    between: FxHashMap<(RunId, RunId), Vec<Observed>>,
    /// How many there are of each of the rules.
    counts: [usize; PAIR_RULES.len()],
}

impl Seen {
    pub(super) fn insert(&mut self, pair: (RunId, RunId), found: Vec<Observed>) {
        self.remove(&pair);
        found.iter().for_each(|each| self.counts[each.rule] += 1);
        self.between.insert(pair, found);
    }

    pub(super) fn remove(&mut self, pair: &(RunId, RunId)) -> Option<Vec<Observed>> {
        let gone = self.between.remove(pair)?;
        gone.iter().for_each(|each| self.counts[each.rule] -= 1);
        Some(gone)
    }

    /// All observations, in no order.
    pub(super) fn all(&self) -> impl Iterator<Item = &Observed> {
        self.between.values().flatten()
    }

    /// Those of one rule; where there are none, without a look at the others.
    pub(super) fn of(&self, rule: Rule) -> impl Iterator<Item = &Observed> {
        let of_rule = move |each: &&Observed| PAIR_RULES[each.rule].rule == rule;
        let between = self.has(rule).then(|| self.between.values().flatten());
        between.into_iter().flatten().filter(of_rule)
    }

    pub(super) fn of_mut(&mut self, rule: Rule) -> impl Iterator<Item = &mut Observed> {
        let of_rule = move |each: &&mut Observed| PAIR_RULES[each.rule].rule == rule;
        let between = match self.has(rule) {
            true => Some(self.between.values_mut().flatten()),
            false => None,
        };
        between.into_iter().flatten().filter(of_rule)
    }

    pub(super) fn has(&self, rule: Rule) -> bool {
        let mut counts = PAIR_RULES.iter().zip(self.counts);
        counts.any(|(of, count)| of.rule == rule && count > 0)
    }
}
