//! The contours with findings of their own, in machining order, with counts by kind: kept from one report to the next,
//! so that contours beyond the limit of a report are not looked at. Knows nothing of what the findings say.

use crate::drawing::{ContourKey, EntityId};
use crate::finding::{Place, Rule, Severity, Side, SmallRadius};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Up to one new contour in this many is inserted by itself; if there are more, all are sorted.
const FEW: usize = 8;

/// A rule, and the severity that the case has at most.
pub(super) type Kind = (Rule, Option<Severity>);

/// A contour with findings of its own.
#[derive(Clone, Debug)]
pub(super) struct Notable {
    /// The first of its entities in machining order.
    pub(super) first: EntityId,
    pub(super) what: Notability,
    /// The number of its findings, once counted.
    pub(super) counted: Option<Counted>,
}

/// What is to be asked about such a contour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Notability {
    pub(super) has_tight_arcs: bool,
    pub(super) has_observations: bool,
    /// A rule on whole contours holds.
    pub(super) as_a_whole: bool,
}

/// How many findings a contour has with the wire on a side.
#[derive(Clone, Debug, Default)]
pub(super) struct Counted {
    pub(super) side: Option<Side>,
    pub(super) counts: Counts<Vec<(Kind, usize)>>,
    /// The fit says what its arcs leave.
    pub(super) says_the_fit: bool,
    /// Each arc below the correction, where they are few.
    pub(super) arcs: Option<Arc<[TightArc]>>,
}

/// An arc below the correction, by its index in the contour.
#[derive(Clone, Debug)]
pub(super) struct TightArc {
    pub(super) index: usize,
    pub(super) place: Place,
    pub(super) numbers: SmallRadius,
}

/// Numbers of findings: of arcs below the correction, of local rules, of rules on whole contours.
#[derive(Clone, Debug, Default)]
pub(super) struct Counts<T> {
    pub(super) arcs: T,
    pub(super) local: T,
    /// Those of local rules that another finding of the contour stands for.
    pub(super) stood_for: T,
    pub(super) whole: T,
}

/// The sums over many contours.
pub(super) type Sums = Counts<BTreeMap<Kind, usize>>;

impl Sums {
    pub(super) fn add(&mut self, counted: &Counted) {
        self.change(counted, |sum, count| *sum += count);
    }

    pub(super) fn take(&mut self, counted: &Counted) {
        self.change(counted, |sum, count| *sum -= count);
    }

    fn change(&mut self, counted: &Counted, change: impl Fn(&mut usize, usize)) {
        for (sums, counts) in [
            (&mut self.arcs, &counted.counts.arcs),
            (&mut self.local, &counted.counts.local),
            (&mut self.stood_for, &counted.counts.stood_for),
            (&mut self.whole, &counted.counts.whole),
        ] {
            for &(kind, count) in counts {
                let sum = sums.entry(kind).or_default();
                change(sum, count);
                if *sum == 0 {
                    sums.remove(&kind);
                }
            }
        }
    }
}

/// All of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Notables {
    of: FxHashMap<ContourKey, Notable>,
    /// In machining order: without those that are `fresh`, and with those that are `gone`.
    sorted: Vec<ContourKey>,
    fresh: FxHashSet<ContourKey>,
    gone: FxHashSet<ContourKey>,
    /// The sums over all that are not `uncounted`; `None` while the sides of some depend on other contours.
    sums: Option<Sums>,
    uncounted: FxHashSet<ContourKey>,
}

impl Notables {
    pub(super) fn get(&self, key: ContourKey) -> Option<&Notable> {
        self.of.get(&key)
    }

    pub(super) fn insert(&mut self, key: ContourKey, notable: Notable) {
        self.remove(key);
        self.of.insert(key, notable);
        self.fresh.insert(key);
        self.uncounted.insert(key);
    }

    pub(super) fn remove(&mut self, key: ContourKey) {
        let Some(old) = self.of.remove(&key) else {
            return;
        };
        if !self.fresh.remove(&key) {
            self.gone.insert(key);
        }
        if !self.uncounted.remove(&key)
            && let (Some(sums), Some(counted)) = (&mut self.sums, &old.counted)
        {
            sums.take(counted);
        }
    }

    /// All in machining order, once they have been put in it.
    pub(super) fn in_order(&self) -> &[ContourKey] {
        &self.sorted
    }

    pub(super) fn put_in_order(&mut self, rank: impl Fn(EntityId) -> u64) {
        let Notables {
            of,
            sorted,
            fresh,
            gone,
            ..
        } = self;
        if !gone.is_empty() {
            sorted.retain(|key| !gone.contains(key));
            gone.clear();
        }
        let place = |key: ContourKey| (of.get(&key).map(|it| rank(it.first)), key);
        if fresh.len() > sorted.len() / FEW {
            sorted.extend(fresh.drain());
            sorted.sort_by_cached_key(|&key| place(key));
        }
        for key in fresh.drain() {
            let at = sorted.partition_point(|&other| place(other) < place(key));
            sorted.insert(at, key);
        }
    }

    /// The number of findings of each kind in all, except of a `suspended` contour. Where `sides_stay`, the side of a
    /// contour depends on nothing else, and only new contours are counted.
    pub(super) fn sums(
        &mut self,
        sides_stay: bool,
        suspended: Option<ContourKey>,
        side_of: impl Fn(ContourKey) -> Option<Side>,
        count: impl Fn(ContourKey, Notability, Option<Side>) -> Counted,
    ) -> Sums {
        let known = self.sums.take().filter(|_| sides_stay);
        if known.is_none() {
            self.uncounted = self.of.keys().copied().collect();
        }
        let mut sums = known.unwrap_or_default();
        let asked: Vec<ContourKey> = self.uncounted.drain().collect();
        self.uncounted
            .extend(suspended.filter(|key| asked.contains(key)));
        for key in asked.into_iter().filter(|&key| Some(key) != suspended) {
            let side = side_of(key);
            let Some(notable) = self.of.get_mut(&key) else {
                continue;
            };
            let known = notable.counted.take().filter(|known| known.side == side);
            let counted = known.unwrap_or_else(|| count(key, notable.what, side));
            sums.add(notable.counted.insert(counted));
        }
        if sides_stay {
            self.sums = Some(sums.clone());
        }
        if let Some(key) = suspended.filter(|key| !self.uncounted.contains(key))
            && let Some(counted) = self.of.get(&key).and_then(|it| it.counted.as_ref())
        {
            sums.take(counted);
        }
        sums
    }
}
