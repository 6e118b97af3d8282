//! The observations between segments, as findings and for rules that derive findings from them.

use super::compare::{Observed, Outlooks, SegmentId};
use super::pairs::Pairs;
use super::report::Report;
use super::told::{
    Doubles, Told, ToldPair, gather_crossings, is_without_room, merged, reaches, takes_of_the_other,
};
use super::twice::Twice;
use crate::drawing::{ContourKey, Drawing, EntityId};
use crate::finding::{Detail, NotJudged, Place, Rule, Severity, Side};
use crate::geometry::Point;
use crate::rules::{PAIR_RULES, Wall};
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;

/// Two segments of a contour that form a slot, and the disc between them.
pub(crate) type Slot = ([usize; 2], Option<(Point, f64)>);

/// Two segments of a contour that form a slot, and the side of travel that it lies on, `None` for
/// either side.
pub(crate) type FacingWalls = ([usize; 2], Option<Side>);

impl Pairs {
    /// The `narrow-slot` findings of one contour: the two segments, and the disc between them.
    pub(crate) fn slots_of(&self, key: ContourKey) -> Vec<Slot> {
        let own = |each: &&Observed| each.one.0 == key && each.other.0 == key && !each.blocked;
        self.seen
            .of(Rule::NarrowSlot)
            .filter(own)
            .map(|each| ([each.one.1, each.other.1], each.disc))
            .collect()
    }

    /// The narrowest place between walls that count, with the segments that face each other there.
    pub(super) fn narrowest(
        &self,
        outlook: Outlooks,
        side_of: &dyn Fn(ContourKey) -> Option<Side>,
        counts: &dyn Fn([ContourKey; 2]) -> bool,
    ) -> Option<(f64, [SegmentId; 2])> {
        let slots = self.seen.of(Rule::NarrowSlot).filter(|each| {
            !each.blocked && counts([each.one.0, each.other.0]) && reaches(each, outlook, side_of)
        });
        let width = |each: &Observed| Some((2.0 * each.disc?.1, [each.one, each.other]));
        // Of equally narrow ones the same, whatever their order.
        slots.filter_map(width).min_by(|a, b| {
            let by_place = || a.1.cmp(&b.1);
            a.0.total_cmp(&b.0).then_with(by_place)
        })
    }

    /// The facing walls that `narrow-slot` has found in single contours, with their side of travel, by contour.
    pub(super) fn slots(&self) -> FxHashMap<ContourKey, Vec<FacingWalls>> {
        let mut slots: FxHashMap<ContourKey, Vec<FacingWalls>> = FxHashMap::default();
        for each in self.seen.of(Rule::NarrowSlot) {
            if each.one.0 == each.other.0 && !each.blocked {
                slots
                    .entry(each.one.0)
                    .or_default()
                    .push(([each.one.1, each.other.1], each.sides.0.or(each.sides.1)));
            }
        }
        slots
    }

    /// The pairs of entities that lie in the same place.
    pub(super) fn doubles(&self, outlook: Outlooks) -> impl Iterator<Item = [EntityId; 2]> {
        let entity_of = |(key, index): SegmentId| Some(outlook(key)?.segment_id(index)?.0);
        let seen = self.seen.of(Rule::DuplicateEntity);
        seen.filter_map(move |seen| Some([entity_of(seen.one)?, entity_of(seen.other)?]))
    }

    /// Entities that lie in the same place as another.
    pub(crate) fn doubled(&self, outlook: Outlooks) -> FxHashSet<EntityId> {
        self.doubles(outlook).flatten().collect()
    }

    /// The place of the first run that has not been compared.
    fn first_uncompared(&self, drawing: &Drawing, outlook: Outlooks) -> Option<Place> {
        let first = self.uncompared.iter().filter_map(|&(key, run)| {
            outlook(key)?.place(outlook(key)?.index.range_of(run as usize).start)
        });
        let rank = |place: &Place| match place {
            Place::Segment { entity, segment } => Some((drawing.rank(*entity), *segment)),
            _ => None,
        };
        first.min_by_key(rank)
    }

    /// Adds the findings, in the machining order of their entities.
    pub(crate) fn report(
        &mut self,
        drawing: &Drawing,
        outlook: Outlooks,
        wire_side: &dyn Fn(ContourKey) -> Option<Side>,
        report: &mut Report,
    ) {
        let told = match self
            .told
            .take()
            .filter(|told| told.holds(outlook, wire_side))
        {
            Some(told) => told,
            None => Arc::new(self.tell(drawing, outlook, wire_side, report)),
        };
        if !self.uncompared.is_empty()
            && report.counts(Rule::NotJudged, None)
            && let Some(place) = told.uncompared.clone()
        {
            let left_out = NotJudged::Pairs {
                count: self.uncompared.len(),
            };
            report.add(
                Rule::NotJudged,
                None,
                place,
                Detail::NotJudged(left_out),
                Vec::new(),
            );
        }
        let mut kinds: Vec<(Rule, Option<Severity>, bool)> = Vec::new();
        for (&(rule, mildest), &count) in &told.counts {
            let rule = PAIR_RULES[rule].rule;
            report.count(rule, mildest, count);
            kinds.push((rule, mildest, !report.is_full(rule, mildest)));
        }
        for (&(rule, mildest), &count) in &told.absorbed {
            report.weigh(PAIR_RULES[rule].rule, mildest, count);
        }
        for each in &told.pairs {
            let (_, mildest, is_open) = kinds[each.kind];
            let rule = &PAIR_RULES[each.rule];
            if !is_open {
                continue;
            }
            if report.is_full(rule.rule, mildest) {
                kinds[each.kind].2 = false;
                if kinds.iter().all(|(.., is_open)| !is_open) {
                    break;
                }
            } else if let (Some(own), Some(theirs)) = (outlook(each.one.0), outlook(each.other.0))
                && let (Some(one), Some(other)) = (
                    Wall::new(&own, each.one.1),
                    Wall::new(&theirs, each.other.1),
                )
                && let (Some(mut place), Some(other_place)) =
                    (own.place(each.one.1), theirs.place(each.other.1))
                && let Some(mut detail) = match &each.others {
                    Some(doubles) => Some(doubles.detail()),
                    None => (rule.detail)(&one, &other, each.one.0 == each.other.0),
                }
            {
                let mut related = vec![other_place];
                if let Some(doubles) = &each.others {
                    related.clone_from(&doubles.places);
                }
                if let Some(crossings) = &each.crossings {
                    let place_of = |&(key, index): &SegmentId| outlook(key)?.place(index);
                    place = place_of(&crossings.of).unwrap_or(place);
                    related = crossings.others.iter().filter_map(place_of).collect();
                    if let Detail::SelfIntersection { count, .. } = &mut detail {
                        *count = crossings.count;
                    }
                }
                report.add(rule.rule, mildest, place, detail, related);
            }
        }
        self.told = Some(told);
    }

    /// The findings of all observations.
    fn tell(
        &self,
        drawing: &Drawing,
        outlook: Outlooks,
        wire_side: &dyn Fn(ContourKey) -> Option<Side>,
        report: &Report,
    ) -> Told {
        let is_for_a_path = report.is_for_a_path();
        type Ends = ((EntityId, usize), (EntityId, usize));
        let mut told = Told {
            uncompared: self.first_uncompared(drawing, outlook),
            ..Told::default()
        };
        let keys = self.seen.told();
        for key in keys.flat_map(|each| [each.one.0, each.other.0]) {
            told.sides.entry(key).or_insert_with(|| wire_side(key));
        }
        let side_of = |key: ContourKey| told.sides.get(&key).copied().flatten();
        let is_middle = |key: ContourKey| outlook(key).is_some_and(|it| it.is_middle());
        let mut meeting: FxHashMap<[ContourKey; 2], bool> = FxHashMap::default();
        let mut seen: Vec<(usize, Ends, &Observed)> = Vec::new();
        for each in self.seen.told() {
            let ends = |(key, index): SegmentId| outlook(key)?.segment_id(index);
            if !each.blocked
                && reaches(each, outlook, &side_of)
                && let (Some(one), Some(other)) = (ends(each.one), ends(each.other))
            {
                // Walls on one another: a fault where one wire takes of what the other leaves.
                if is_without_room(each) {
                    let keys = [each.one.0, each.other.0];
                    let takes = meeting
                        .entry(keys)
                        .or_insert_with(|| takes_of_the_other(outlook, keys, &side_of));
                    if !*takes || is_for_a_path {
                        continue;
                    }
                }
                seen.push((each.rule, (one, other), each));
            }
        }
        let twice = Twice::among(drawing, outlook, seen.iter().map(|(_, _, each)| *each));
        seen.retain(|(_, _, each)| !twice.are_one(each.one.0, each.other.0));
        let rank = |(entity, segment): (EntityId, usize)| (drawing.rank(entity), segment);
        seen.sort_unstable_by_key(|(rule, ends, _)| (*rule, rank(ends.0), rank(ends.1)));
        let is_double =
            |each: &&(usize, Ends, &Observed)| PAIR_RULES[each.0].rule == Rule::DuplicateEntity;
        let doubles: FxHashSet<(EntityId, EntityId)> = seen
            .iter()
            .filter(is_double)
            .map(|(_, ends, _)| (ends.0.0, ends.1.0))
            .collect();
        // All entities that lie in one place, and all such duplicates of a contour, are one
        // finding, at the first of them; those that can be deleted are separate from those that
        // cannot.
        let later: FxHashSet<EntityId> = doubles.iter().map(|(_, other)| *other).collect();
        let outline = |ends: &Ends, each: &Observed| (each.one.0, drawing.is_editable(ends.1.0));
        let mut others: FxHashMap<(ContourKey, bool), Doubles> = FxHashMap::default();
        for (_, ends, each) in seen.iter().filter(is_double) {
            if !later.contains(&ends.0.0)
                && let Some(place) = outlook(each.other.0).and_then(|it| it.place(each.other.1))
            {
                let doubles = others.entry(outline(ends, each)).or_default();
                doubles.add(ends.0.0, ends.1.0, place);
            }
        }
        let merged = merged(
            &seen.iter().map(|(_, _, each)| *each).collect::<Vec<_>>(),
            &|key| outlook(key).map(|it| it.contour.len()),
        );
        // An open contour is not cut, and is an error of its own: how near it comes to others, and
        // what it touches or crosses, is checked once it is closed; overlaps among open contours
        // are hints until then, since they have a fix.
        let doubled: FxHashSet<EntityId> = doubles
            .iter()
            .flat_map(|(one, other)| [*one, *other])
            .collect();
        let is_told_open = |key: ContourKey| {
            let contour = outlook(key).map(|it| it.contour);
            let contour = contour.filter(|_| side_of(key).is_none());
            contour.is_some_and(|it| {
                !it.closed
                    && !it
                        .pieces
                        .iter()
                        .all(|piece| doubled.contains(&piece.entity))
            })
        };
        let open_is_an_error = report.open_is_an_error();
        for (at, (number, ends, each)) in seen.iter().enumerate() {
            let rule = &PAIR_RULES[*number];
            if (rule.silent_for_doubles || is_without_room(each))
                && doubles.contains(&(ends.0.0, ends.1.0))
                || merged.contains(&at)
            {
                continue;
            }
            let others = match rule.rule {
                Rule::DuplicateEntity if later.contains(&ends.0.0) => continue,
                Rule::DuplicateEntity => match others.remove(&outline(ends, each)) {
                    Some(others) => Some(others),
                    None => {
                        let kind = (*number, each.mildest);
                        *told.absorbed.entry(kind).or_default() += 1;
                        continue;
                    }
                },
                _ => None,
            };
            // What is milled along its middle has no side.
            let is_unknown = |key: ContourKey| side_of(key).is_none() && !is_middle(key);
            let unknown = rule.warning_when_side_unknown
                && (is_unknown(each.one.0) || is_unknown(each.other.0));
            let [one_is_open, other_is_open] =
                [each.one.0, each.other.0].map(|key| open_is_an_error && is_told_open(key));
            let mildest = match rule.rule {
                Rule::Overlap | Rule::DuplicateEntity if one_is_open && other_is_open => {
                    Some(Severity::Hint)
                }
                // Where the contour is the wire's own path it may well touch and cross itself: leads do.
                _ if unknown || is_for_a_path => Some(Severity::Warning),
                _ => each.mildest,
            };
            let is_absorbed = (one_is_open || other_is_open)
                && each.one.0 != each.other.0
                && matches!(rule.rule, Rule::SelfIntersection | Rule::NarrowSlot);
            if is_absorbed {
                *told.absorbed.entry((*number, mildest)).or_default() += 1;
                continue;
            }
            told.pairs.push(ToldPair {
                rule: *number,
                mildest,
                kind: 0,
                one: each.one,
                other: each.other,
                others,
                crossings: None,
            });
        }
        told.meeting = meeting;
        let of_pair = |pair: &ToldPair| {
            let first = outlook(pair.one.0).and_then(|it| it.segment_id(pair.one.1));
            (pair.rule, first.map(rank))
        };
        let of_contours = twice.told(drawing, outlook);
        if !of_contours.is_empty() {
            told.pairs.extend(of_contours);
            told.pairs.sort_by_key(of_pair);
        }
        for kind in gather_crossings(&mut told.pairs) {
            *told.absorbed.entry(kind).or_default() += 1;
        }
        for pair in &told.pairs {
            *told.counts.entry((pair.rule, pair.mildest)).or_default() += 1;
        }
        for pair in &mut told.pairs {
            pair.kind = told.counts.range(..(pair.rule, pair.mildest)).count();
        }
        told
    }
}
