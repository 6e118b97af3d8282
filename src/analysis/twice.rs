//! Closed contours that lie on one another everywhere, whatever their entities: one of them is cut, and one finding says so.

use super::compare::{Observed, Outlooks};
use super::told::{DoublesOfContour, PairFinding};
use crate::drawing::{ContourKey, Drawing, EntityId, are_twins};
use crate::finding::Rule;
use crate::rules::{Outlook, PAIR_RULES};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;

/// Of contours in one place: the first of them by each of the later ones.
#[derive(Default)]
pub(super) struct Twice {
    first_of: FxHashMap<ContourKey, ContourKey>,
}

impl Twice {
    /// Looks at all contours with segments that lie on one another.
    pub(super) fn among<'a>(
        drawing: &Drawing,
        outlook: Outlooks,
        seen: impl Iterator<Item = &'a Observed>,
    ) -> Twice {
        let is_asked = |each: &&Observed| {
            matches!(
                PAIR_RULES[each.rule].rule,
                Rule::DuplicateEntity | Rule::Overlap
            )
        };
        let rank = |key: ContourKey| {
            let first = outlook(key)?.contour.pieces.first()?.entity;
            Some(drawing.rank(first))
        };
        let ordered = |each: &Observed| {
            let (one, other) = (each.one.0, each.other.0);
            match rank(one) <= rank(other) {
                true => [one, other],
                false => [other, one],
            }
        };
        // What was left out when ends were joined lies on what was kept.
        let holder = |each: &Observed| {
            let is_on = |left_out: ContourKey, (key, index): (ContourKey, usize)| {
                let kept = outlook(left_out)?.contour.double_of?;
                (outlook(key)?.segment_id(index)?.0 == kept).then_some([key, left_out])
            };
            is_on(each.one.0, each.other).or_else(|| is_on(each.other.0, each.one))
        };
        let mut held: Vec<[ContourKey; 2]> = Vec::new();
        let mut known = FxHashSet::default();
        let pairs = seen
            .filter(is_asked)
            .inspect(|each| held.extend(holder(each)))
            .map(ordered);
        let mut pairs: Vec<[ContourKey; 2]> = pairs
            .filter(|&[one, other]| one != other && known.insert([one, other]))
            .collect();
        pairs.retain(|&[one, other]| {
            let (Some(one), Some(other)) = (outlook(one), outlook(other)) else {
                return false;
            };
            let [own, theirs] = [&one, &other].map(|it: &Outlook| it.index.bounds());
            let tolerance = one.limits.tolerances.same_place;
            are_twins(
                drawing,
                (one.contour, &own),
                (other.contour, &theirs),
                tolerance,
            )
        });
        pairs.sort_by_key(|&[one, other]| (rank(one), rank(other)));
        let mut twice = Twice::default();
        for [one, other] in pairs {
            let first = twice.first(one);
            twice.first_of.entry(other).or_insert(first);
        }
        let firsts: FxHashSet<ContourKey> = twice.first_of.values().copied().collect();
        for [kept, left_out] in held {
            let first = twice.first(kept);
            if firsts.contains(&first) {
                twice.first_of.entry(left_out).or_insert(first);
            }
        }
        twice
    }

    fn first(&self, key: ContourKey) -> ContourKey {
        self.first_of.get(&key).copied().unwrap_or(key)
    }

    /// Whether two contours are one.
    pub(super) fn are_one(&self, one: ContourKey, other: ContourKey) -> bool {
        one != other && self.first(one) == self.first(other)
    }

    /// One finding for each place, and another one for what cannot be deleted there.
    pub(super) fn told(&self, drawing: &Drawing, outlook: Outlooks) -> Vec<PairFinding> {
        let Some(rule) = PAIR_RULES
            .iter()
            .position(|rule| rule.rule == Rule::DuplicateEntity)
        else {
            return Vec::new();
        };
        let mut told: BTreeMap<(u64, bool), PairFinding> = BTreeMap::new();
        let mut later: Vec<(u64, ContourKey, ContourKey)> = Vec::new();
        let first_entity = |key: ContourKey| -> Option<EntityId> {
            Some(outlook(key)?.contour.pieces.first()?.entity)
        };
        for (&other, &first) in &self.first_of {
            later.extend(first_entity(other).map(|it| (drawing.rank(it), other, first)));
        }
        later.sort_unstable();
        for (_, other, first) in later {
            let (Some(theirs), Some(entity)) = (outlook(other), first_entity(first)) else {
                continue;
            };
            let pieces = &theirs.contour.pieces;
            let goes = pieces.iter().all(|it| drawing.is_whole(it.entity));
            let pair = told
                .entry((drawing.rank(entity), goes))
                .or_insert_with(|| PairFinding {
                    rule,
                    mildest: None,
                    kind: 0,
                    one: (first, 0),
                    other: (other, 0),
                    others: Some(DoublesOfContour::default()),
                    crossings: None,
                });
            for piece in pieces {
                if let (Some(doubles), Some(place)) =
                    (&mut pair.others, theirs.place(piece.first()))
                {
                    doubles.add(entity, piece.entity, place);
                }
            }
        }
        told.into_values().collect()
    }
}
