//! The dead ends of contours, kept by the two runs in which they were found. Knows nothing of how they are found.

use super::compare::shifted;
use crate::drawing::ContourKey;
use crate::finding::Side;
use crate::rules::dead_end::Left;
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};
use std::sync::Arc;

/// Two runs of a contour, the smaller number first.
pub(super) type Runs = [u32; 2];

/// Rank of an entity, its segment, and whether the wire runs on its left: the place from which the wire stays farthest
/// away.
pub(super) type Farthest = (u64, usize, bool);

/// A place, and the order that decides which of several ends there is reported: the least depth, by its bits, then the
/// walls.
type Order = (Farthest, u64, [usize; 2]);

/// The dead ends of all contours that have any.
#[derive(Clone, Debug, Default)]
pub(super) struct DeadEnds {
    pub(super) of: FxHashMap<ContourKey, Arc<EndsOf>>,
}

/// The part of a contour that must be checked again.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Asked {
    All,
    /// What depends on these runs.
    About(BTreeSet<u32>),
}

impl Asked {
    pub(super) const NOTHING: Asked = Asked::About(BTreeSet::new());

    /// Adds the part that another one names.
    pub(super) fn add(&mut self, other: &Asked) {
        match (&mut *self, other) {
            (Asked::About(runs), Asked::About(more)) => runs.extend(more),
            (Asked::About(_), Asked::All) => *self = Asked::All,
            (Asked::All, _) => {}
        }
    }
}

impl Default for Asked {
    fn default() -> Self {
        Asked::NOTHING
    }
}

/// The dead ends of one contour, while the wire stays on its side.
#[derive(Clone, Debug, Default)]
pub(super) struct EndsOf {
    pub(super) side: Option<Side>,
    /// A contour that crosses itself has no sides: the part that must be checked once it has them.
    pub(super) waits: Asked,
    ends: BTreeMap<Order, Left>,
    /// The number of places among them: each is reported once.
    places: usize,
    of_runs: BTreeMap<Runs, Vec<Order>>,
    /// Those that depend on more of the contour than the runs around their own two.
    pub(super) far: BTreeSet<Runs>,
}

/// A reported dead end: its contour, the two walls that the wire reaches, and what it leaves.
pub(super) type Told = (ContourKey, [usize; 2], Left);

impl EndsOf {
    /// Adds what is left between two walls, found between two runs. Of ends that would be reported
    /// alike at one place the first stays.
    pub(super) fn insert(&mut self, runs: Runs, place: Farthest, walls: [usize; 2], left: Left) {
        self.places += usize::from(!self.has(place));
        // Depths are not negative: their bits are in their order.
        let order = (place, left.depth.to_bits(), walls);
        self.ends.entry(order).or_insert(left);
        self.of_runs.entry(runs).or_default().push(order);
    }

    /// Forgets what was found between two runs.
    pub(super) fn remove(&mut self, runs: &Runs) {
        self.far.remove(runs);
        for order in self.of_runs.remove(runs).unwrap_or_default() {
            if self.ends.remove(&order).is_some() {
                self.places -= usize::from(!self.has(order.0));
            }
        }
    }

    /// Segments from `first` on have other indices, in the contour and in the entity that it is.
    pub(super) fn shift(&mut self, first: usize, by: isize) {
        let shifted = |index| shifted(index, first, by);
        let moved = |((rank, segment, is_left), depth, walls): Order| -> Order {
            ((rank, shifted(segment), is_left), depth, walls.map(shifted))
        };
        let ends = std::mem::take(&mut self.ends).into_iter();
        let ends = ends.map(|(order, left)| {
            let index = shifted(left.index);
            (moved(order), Left { index, ..left })
        });
        self.ends = ends.collect();
        for order in self.of_runs.values_mut().flatten() {
            *order = moved(*order);
        }
    }

    /// The pairs of runs between which ends were found, where the number of the first run is in a range.
    pub(super) fn seen_from(&self, first: u32, last: u32) -> impl Iterator<Item = Runs> {
        let range = [first, 0]..=[last, u32::MAX];
        self.of_runs.range(range).map(|(runs, _)| *runs)
    }

    fn has(&self, place: Farthest) -> bool {
        let range = (place, 0, [0; 2])..=(place, u64::MAX, [usize::MAX; 2]);
        self.ends.range(range).next().is_some()
    }
}

impl DeadEnds {
    /// The number of places in the contours for which `counts` holds.
    pub(super) fn count(&self, counts: impl Fn(ContourKey) -> bool) -> usize {
        let of = self.of.iter().filter(|(key, _)| counts(**key));
        of.map(|(_, of)| of.places).sum()
    }

    /// The first places of these contours, in machining order.
    pub(super) fn first(&self, most: usize, counts: impl Fn(ContourKey) -> bool) -> Vec<Told> {
        let of = self.of.iter().filter(|(key, _)| counts(**key));
        let mut each: Vec<_> = of
            .map(|(&key, of)| (key, of.ends.iter().peekable()))
            .collect();
        let mut next: BinaryHeap<Reverse<(Order, usize)>> = each
            .iter_mut()
            .enumerate()
            .filter_map(|(at, (_, ends))| Some(Reverse((*ends.peek()?.0, at))))
            .collect();
        let mut told = Vec::new();
        let mut last = None;
        while let Some(Reverse((_, at))) = next.pop().filter(|_| told.len() < most) {
            let (key, ends) = &mut each[at];
            if let Some((&(place, _, walls), &left)) = ends.next()
                && last.replace(place) != Some(place)
            {
                told.push((*key, walls, left));
            }
            next.extend(ends.peek().map(|(order, _)| Reverse((**order, at))));
        }
        told
    }
}
