//! The findings from observations between segments.

use super::compare::{Observed, Outlooks, SegmentId};
use crate::drawing::{ContourKey, EntityId};
use crate::finding::{Detail, Place, Rule, Severity, Side};
use crate::rules::{Outlook, PAIR_RULES};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;

/// The findings of the observed pairs.
#[derive(Debug, Default)]
pub(super) struct PairFindings {
    /// In the order of the rules, and in the machining order of the entities.
    pub(super) pairs: Vec<PairFinding>,
    /// The number of each rule and severity.
    pub(super) counts: BTreeMap<(usize, Option<Severity>), usize>,
    /// The number of findings for which others stand, by their rule and severity.
    pub(super) absorbed: BTreeMap<(usize, Option<Severity>), usize>,
}

#[derive(Debug)]
pub(super) struct PairFinding {
    /// Index into [`PAIR_RULES`].
    pub(super) rule: usize,
    pub(super) mildest: Option<Severity>,
    /// Place of its rule and severity among the counts.
    pub(super) kind: usize,
    pub(super) one: SegmentId,
    pub(super) other: SegmentId,
    /// The duplicates in a contour.
    pub(super) others: Option<DoublesOfContour>,
    pub(super) crossings: Option<Crossings>,
}

/// The other segments that a segment crosses or touches, if they are many: reported once, at that
/// segment.
#[derive(Debug)]
pub(super) struct Crossings {
    pub(super) of: SegmentId,
    pub(super) count: usize,
    /// The first of the others.
    pub(super) others: Vec<SegmentId>,
}

/// A segment that crosses or touches more others than this is reported once for all of them.
const MANY: usize = 16;

/// The number of others that are named.
const NAMED: usize = 8;

/// Reports the crossings of each segment with many of them as one: the first stays. Returns the
/// rule and severity of those for which it stands.
pub(super) fn gather_crossings(pairs: &mut Vec<PairFinding>) -> Vec<(usize, Option<Severity>)> {
    let is_crossing = |pair: &&PairFinding| PAIR_RULES[pair.rule].rule == Rule::SelfIntersection;
    let mut counts: FxHashMap<(SegmentId, Option<Severity>), usize> = FxHashMap::default();
    for pair in pairs.iter().filter(is_crossing) {
        for of in [pair.one, pair.other] {
            *counts.entry((of, pair.mildest)).or_default() += 1;
        }
    }
    counts.retain(|_, count| *count > MANY);
    if counts.is_empty() {
        return Vec::new();
    }
    // Where two such segments meet, the one with more crossings stands for the pair.
    let of = |pair: &PairFinding| {
        let count = |of: SegmentId| counts.get(&(of, pair.mildest)).copied();
        let (one, other) = (count(pair.one), count(pair.other));
        let longer = if one >= other { pair.one } else { pair.other };
        one.or(other).map(|_| (longer, pair.mildest))
    };
    let mut own: FxHashMap<(SegmentId, Option<Severity>), Crossings> = FxHashMap::default();
    for pair in pairs.iter().filter(is_crossing) {
        let Some(key) = of(pair) else { continue };
        let crossings = own.entry(key).or_insert_with(|| Crossings {
            of: key.0,
            count: 0,
            others: Vec::new(),
        });
        crossings.count += 1;
        if crossings.others.len() < NAMED {
            let is_one = pair.one == key.0;
            crossings
                .others
                .push(if is_one { pair.other } else { pair.one });
        }
    }
    let few: FxHashSet<(SegmentId, Option<Severity>)> = own
        .iter()
        .filter(|(_, crossings)| crossings.count <= MANY)
        .map(|(&key, _)| key)
        .collect();
    let mut gone = Vec::new();
    pairs.retain_mut(|pair| {
        let key = of(pair).filter(|key| is_crossing(&&*pair) && !few.contains(key));
        let Some(key) = key else { return true };
        pair.crossings = own.remove(&key);
        if pair.crossings.is_none() {
            gone.push((pair.rule, pair.mildest));
        }
        pair.crossings.is_some()
    });
    gone
}

/// Entities of one contour that are duplicated.
#[derive(Debug, Default)]
pub(super) struct DoublesOfContour {
    /// The later ones, which are superfluous.
    pub(super) places: Vec<Place>,
    /// The number of entities of the contour that they duplicate, and the last of those.
    count: usize,
    last: Option<EntityId>,
    known: FxHashSet<EntityId>,
}

impl DoublesOfContour {
    /// Adds one that lies on `first`; all that lie on one follow each other.
    pub(super) fn add(&mut self, first: EntityId, later: EntityId, place: Place) {
        self.count += usize::from(self.last.replace(first) != Some(first));
        if self.known.insert(later) {
            self.places.push(place);
        }
    }

    pub(super) fn detail(&self) -> Detail {
        Detail::DuplicateEntity { count: self.count }
    }
}

/// True for walls that lie on one another: what is seen between others has the disc that touches both.
pub(super) fn is_without_room(seen: &Observed) -> bool {
    PAIR_RULES[seen.rule].rule == Rule::NarrowSlot && seen.disc.is_none()
}

/// Whether a wire on this side of a closed contour runs outside of it, as round a punch.
fn runs_outside(outlook: &Outlook, side: Side) -> bool {
    side.sign() * outlook.index.twice_area() < 0.0
}

/// True where what is seen concerns the sides on which the wire runs.
pub(super) fn reaches(
    each: &Observed,
    outlook: Outlooks,
    side_of: &dyn Fn(ContourKey) -> Option<Side>,
) -> bool {
    let is_concerned = |(key, side): (ContourKey, Option<Side>)| {
        side.is_none() || side_of(key).is_none() || side == side_of(key)
    };
    let both = [(each.one.0, each.sides.0), (each.other.0, each.sides.1)];
    if both.into_iter().all(is_concerned) {
        return true;
    }
    if each.one.0 == each.other.0 || PAIR_RULES[each.rule].rule != Rule::NarrowSlot {
        return false;
    }
    let Some((_, radius)) = each.disc else {
        return false;
    };
    // Between an open contour that is cut and another one the wire of either keeps off the other, whose own wire may run on its far side;
    // an end of an open contour has no sides, and the wire comes no further past it than the correction. So does the wire round a punch keep
    // off an opening beside it.
    let is_open = |key: ContourKey| outlook(key).is_some_and(|it| !it.contour.closed);
    let is_cut_open = |(key, _): (ContourKey, Option<Side>)| is_open(key) && side_of(key).is_some();
    let is_punch = |(key, _): &(ContourKey, Option<Side>)| {
        let (own, side) = outlook(*key).zip(side_of(*key))?;
        own.contour.closed.then(|| runs_outside(&own, side))
    };
    let has_opening = both.iter().any(|one| is_punch(one) == Some(false));
    let is_any_open = both.into_iter().any(is_cut_open);
    let correction = outlook(each.one.0).map_or(0.0, |it| it.limits.correction);
    both.into_iter().any(|(key, side)| {
        let is_end = is_open(key) && side.is_none();
        is_concerned((key, side))
            && (is_any_open || has_opening && is_punch(&(key, side)) == Some(true))
            && (!is_end || 2.0 * radius < correction)
    })
}

/// Of two contours with the wire on different sides of a wall that they share: true where the wire of each runs in the part of the other.
/// That of an opening at the edge of its punch runs in waste, and so do those of two openings side by side.
pub(super) fn takes_of_the_other(
    outlook: Outlooks,
    keys: [ContourKey; 2],
    wire_side: &dyn Fn(ContourKey) -> Option<Side>,
) -> bool {
    // Whether it is a punch, and its area; `None` for an open one, which keeps what lies on the other side of the wire.
    let of = |key: ContourKey| {
        let (outlook, side) = (outlook(key)?, wire_side(key)?);
        let of_closed = || {
            let twice_area = outlook.index.twice_area().abs();
            (runs_outside(&outlook, side), twice_area)
        };
        Some(outlook.contour.closed.then(of_closed))
    };
    let [Some(one), Some(other)] = keys.map(of) else {
        return false;
    };
    match (one, other) {
        (None, None) => true,
        (Some((is_punch, _)), None) | (None, Some((is_punch, _))) => is_punch,
        (Some((true, _)), Some((true, _))) => true,
        (Some((false, _)), Some((false, _))) => false,
        // One lies in the other: the part is the inner one where the punch is.
        (Some((true, punch)), Some((false, opening)))
        | (Some((false, opening)), Some((true, punch))) => punch < opening,
    }
}

/// Those of `seen` that another one stands for: of neighbouring pairs with one observation, all except the one with
/// the smallest disc.
pub(super) fn merged(
    seen: &[&Observed],
    count_of: &dyn Fn(ContourKey) -> Option<usize>,
) -> FxHashSet<usize> {
    let mut at: FxHashMap<(usize, SegmentId, SegmentId), usize> = FxHashMap::default();
    let pair = |seen: &Observed| {
        if seen.one <= seen.other {
            (seen.one, seen.other)
        } else {
            (seen.other, seen.one)
        }
    };
    for (position, each) in seen
        .iter()
        .enumerate()
        .filter(|(_, each)| PAIR_RULES[each.rule].one_per_place)
    {
        let (one, other) = pair(each);
        at.insert((each.rule, one, other), position);
    }
    let mut gone = FxHashSet::default();
    let mut known = FxHashSet::default();
    let width = |position: usize| seen[position].disc.map_or(0.0, |(_, radius)| radius);
    for start in (0..seen.len()).filter(|&position| PAIR_RULES[seen[position].rule].one_per_place) {
        if !known.insert(start) {
            continue;
        }
        let (mut group, mut waiting) = (vec![start], vec![start]);
        while let Some(position) = waiting.pop() {
            let (one, other) = pair(seen[position]);
            let beside = |(key, index): SegmentId| {
                let count = count_of(key).unwrap_or(1).max(1);
                [
                    (key, index),
                    (key, (index + 1) % count),
                    (key, (index + count - 1) % count),
                ]
            };
            for one in beside(one) {
                for other in beside(other) {
                    let (one, other) = if one <= other {
                        (one, other)
                    } else {
                        (other, one)
                    };
                    if let Some(&met) = at.get(&(seen[position].rule, one, other))
                        && known.insert(met)
                    {
                        group.push(met);
                        waiting.push(met);
                    }
                }
            }
        }
        // Of equally narrow ones the first in the order of entities stays.
        let narrowest = group
            .iter()
            .copied()
            .map(width)
            .fold(f64::INFINITY, f64::min);
        let stays = group
            .iter()
            .copied()
            .filter(|&position| width(position) <= narrowest + 1e-9)
            .min();
        gone.extend(
            group
                .into_iter()
                .filter(|&position| Some(position) != stays),
        );
    }
    gone
}
