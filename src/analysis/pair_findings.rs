//! The observations between segments, as findings and for rules that derive findings from them.

use super::common_line::CommonLines;
use super::compare::{Observed, Outlooks, SegmentId};
use super::pairs::Pairs;
use super::report::Report;
use super::told::{
    DoublesOfContour, PairFinding, PairFindings, gather_crossings, is_without_room, merged,
    reaches, takes_of_the_other,
};
use super::twice::Twice;
use crate::drawing::{ContourKey, Drawing, EntityId};
use crate::finding::{Detail, NotJudged, Place, Rule, Severity, Side};
use crate::geometry::Point;
use crate::rules::{Outlook, PAIR_RULES, Wall};
use rustc_hash::{FxHashMap, FxHashSet};

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
        &self,
        drawing: &Drawing,
        outlook: Outlooks,
        wire_side: &dyn Fn(ContourKey) -> Option<Side>,
        common_lines: &CommonLines,
        report: &mut Report,
    ) {
        let told = self.tell(drawing, outlook, wire_side, common_lines, report);
        if !self.uncompared.is_empty()
            && report.counts(Rule::NotJudged, None)
            && let Some(place) = self.first_uncompared(drawing, outlook)
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
    }

    /// The findings of all observations.
    fn tell(
        &self,
        drawing: &Drawing,
        outlook: Outlooks,
        wire_side: &dyn Fn(ContourKey) -> Option<Side>,
        common_lines: &CommonLines,
        report: &Report,
    ) -> PairFindings {
        let mut sides = FxHashMap::default();
        for key in (self.seen.told()).flat_map(|each| [each.one.0, each.other.0]) {
            sides.entry(key).or_insert_with(|| wire_side(key));
        }
        let telling = Telling {
            drawing,
            outlook,
            sides,
            is_for_a_path: report.is_for_a_path(),
            open_is_an_error: report.open_is_an_error(),
        };
        let mut seen = telling.seen(self.seen.told());
        seen.retain(|it| !telling.is_of_common_line(it, common_lines));
        let twice = Twice::among(drawing, outlook, seen.iter().map(|it| it.each));
        seen.retain(|it| !twice.are_one(it.each.one.0, it.each.other.0));
        let rank = |(entity, segment): (EntityId, usize)| (drawing.rank(entity), segment);
        seen.sort_by_cached_key(|it| (it.each.rule, rank(it.one), rank(it.other)));
        let mut in_one_place = InOnePlace::among(&seen, &telling);
        let merged = merged(&seen.iter().map(|it| it.each).collect::<Vec<_>>(), &|key| {
            outlook(key).map(|it| it.contour.len())
        });
        let mut told = PairFindings::default();
        for (at, it) in seen.iter().enumerate() {
            if merged.contains(&at) || in_one_place.is_silent(it) {
                continue;
            }
            let is_double = it.rule() == Rule::DuplicateEntity;
            let others = match is_double {
                true => in_one_place.others.remove(&it.outline(drawing)),
                false => None,
            };
            let is_open = telling.are_open(it, &in_one_place);
            let (mildest, is_absorbed) = match is_double && others.is_none() {
                true => (it.each.mildest, true),
                false => (
                    telling.mildest(it, is_open),
                    telling.waits_until_closed(it, is_open),
                ),
            };
            if is_absorbed {
                *told.absorbed.entry((it.each.rule, mildest)).or_default() += 1;
                continue;
            }
            told.pairs.push(PairFinding {
                rule: it.each.rule,
                mildest,
                kind: 0,
                one: it.each.one,
                other: it.each.other,
                others,
                crossings: None,
            });
        }
        let of_pair = |pair: &PairFinding| {
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

/// An observation, with the segments of the two entities.
struct Seen<'a> {
    one: (EntityId, usize),
    other: (EntityId, usize),
    each: &'a Observed,
}

impl Seen<'_> {
    fn rule(&self) -> Rule {
        PAIR_RULES[self.each.rule].rule
    }

    /// All duplicates of a contour are one finding; those that can be deleted are separate from those that cannot.
    fn outline(&self, drawing: &Drawing) -> (ContourKey, bool) {
        (self.each.one.0, drawing.is_editable(self.other.0))
    }
}

/// Entities that lie in one place.
struct InOnePlace {
    pairs: FxHashSet<(EntityId, EntityId)>,
    /// Those that lie on an earlier one.
    later: FxHashSet<EntityId>,
    all: FxHashSet<EntityId>,
    /// Of each contour those that lie on the first of them, until they have been reported.
    others: FxHashMap<(ContourKey, bool), DoublesOfContour>,
}

impl InOnePlace {
    fn among(seen: &[Seen], telling: &Telling) -> InOnePlace {
        let doubles = || (seen.iter()).filter(|it| it.rule() == Rule::DuplicateEntity);
        let later: FxHashSet<EntityId> = doubles().map(|it| it.other.0).collect();
        let mut others: FxHashMap<(ContourKey, bool), DoublesOfContour> = FxHashMap::default();
        for it in doubles().filter(|it| !later.contains(&it.one.0)) {
            let (key, index) = it.each.other;
            if let Some(place) = (telling.outlook)(key).and_then(|it| it.place(index)) {
                let doubles = others.entry(it.outline(telling.drawing)).or_default();
                doubles.add(it.one.0, it.other.0, place);
            }
        }
        InOnePlace {
            pairs: doubles().map(|it| (it.one.0, it.other.0)).collect(),
            all: doubles().flat_map(|it| [it.one.0, it.other.0]).collect(),
            later,
            others,
        }
    }

    /// True for what another finding about the two entities stands for.
    fn is_silent(&self, it: &Seen) -> bool {
        let rule = &PAIR_RULES[it.each.rule];
        let are_doubles = || self.pairs.contains(&(it.one.0, it.other.0));
        (rule.silent_for_doubles || is_without_room(it.each)) && are_doubles()
            || rule.rule == Rule::DuplicateEntity && self.later.contains(&it.one.0)
    }
}

/// What the findings of observations depend on.
struct Telling<'a, 'b> {
    drawing: &'a Drawing,
    outlook: Outlooks<'a, 'b>,
    /// On which side of each contour the wire runs.
    sides: FxHashMap<ContourKey, Option<Side>>,
    is_for_a_path: bool,
    open_is_an_error: bool,
}

impl Telling<'_, '_> {
    fn side_of(&self, key: ContourKey) -> Option<Side> {
        self.sides.get(&key).copied().flatten()
    }

    /// The observations that concern the wire on its sides.
    fn seen<'s>(&self, all: impl Iterator<Item = &'s Observed>) -> Vec<Seen<'s>> {
        let side_of = |key| self.side_of(key);
        let ends = |(key, index): SegmentId| (self.outlook)(key)?.segment_id(index);
        let mut meeting: FxHashMap<[ContourKey; 2], bool> = FxHashMap::default();
        let mut seen = Vec::new();
        for each in all {
            if !each.blocked
                && reaches(each, self.outlook, &side_of)
                && let (Some(one), Some(other)) = (ends(each.one), ends(each.other))
            {
                // Walls on one another: a fault where one wire takes of what the other leaves.
                if is_without_room(each) {
                    let keys = [each.one.0, each.other.0];
                    let takes = meeting
                        .entry(keys)
                        .or_insert_with(|| takes_of_the_other(self.outlook, keys, &side_of));
                    if !*takes || self.is_for_a_path {
                        continue;
                    }
                }
                seen.push(Seen { one, other, each });
            }
        }
        seen
    }

    /// What is said by a common line: that parts share an edge, touch at its ends, and that a line between them ends on the outline.
    fn is_of_common_line(&self, it: &Seen, common_lines: &CommonLines) -> bool {
        let keys = [it.each.one.0, it.each.other.0];
        let entities = [it.one.0, it.other.0];
        if keys[0] == keys[1] || !common_lines.are_of_one_block(entities[0], entities[1]) {
            return false;
        }
        if entities.iter().any(|entity| common_lines.divides(*entity)) {
            return matches!(
                it.rule(),
                Rule::NarrowSlot | Rule::Overlap | Rule::SelfIntersection
            );
        }
        match it.rule() {
            Rule::NarrowSlot => is_without_room(it.each),
            Rule::Overlap => true,
            Rule::SelfIntersection => {
                let [own, theirs] = keys.map(self.outlook);
                let walls = own.as_ref().zip(theirs.as_ref()).and_then(|(own, theirs)| {
                    let one = Wall::new(own, it.each.one.1)?;
                    Some((one, Wall::new(theirs, it.each.other.1)?))
                });
                let detail = |(one, other): (Wall, Wall)| {
                    (PAIR_RULES[it.each.rule].detail)(&one, &other, false)
                };
                let near = |own: &Outlook| 2.0 * own.limits.tolerances.same_place;
                match (walls.and_then(detail), own.as_ref().map(near)) {
                    (
                        Some(Detail::SelfIntersection {
                            touches: true, at, ..
                        }),
                        Some(near),
                    ) => common_lines.ends_at(at, near),
                    _ => false,
                }
            }
            _ => false,
        }
    }

    /// Which of the two contours are reported as open: those without a side that are not drawn twice as a whole.
    fn are_open(&self, it: &Seen, in_one_place: &InOnePlace) -> [bool; 2] {
        [it.each.one.0, it.each.other.0].map(|key| {
            let outlook = (self.outlook)(key).filter(|it| !it.on_line);
            let contour = outlook.map(|it| it.contour);
            let contour = contour.filter(|_| self.open_is_an_error && self.side_of(key).is_none());
            contour.is_some_and(|it| {
                let mut pieces = it.pieces.iter();
                !it.closed && !pieces.all(|piece| in_one_place.all.contains(&piece.entity))
            })
        })
    }

    /// An open contour is not cut, and is an error of its own: how near it comes to others, and what it touches or crosses, is
    /// checked once it is closed.
    fn waits_until_closed(&self, it: &Seen, is_open: [bool; 2]) -> bool {
        is_open.contains(&true)
            && it.each.one.0 != it.each.other.0
            && matches!(it.rule(), Rule::SelfIntersection | Rule::NarrowSlot)
    }

    fn mildest(&self, it: &Seen, is_open: [bool; 2]) -> Option<Severity> {
        // What is milled along its middle has no side.
        let is_unknown = |key: ContourKey| {
            self.side_of(key).is_none() && !(self.outlook)(key).is_some_and(|it| it.is_middle())
        };
        let unknown = PAIR_RULES[it.each.rule].warning_when_side_unknown
            && (is_unknown(it.each.one.0) || is_unknown(it.each.other.0));
        match it.rule() {
            // Overlaps among open contours have a fix, which may be what closes them.
            Rule::Overlap | Rule::DuplicateEntity if is_open == [true; 2] => Some(Severity::Hint),
            // Where the contour is the wire's own path it may well touch and cross itself: leads do.
            _ if unknown || self.is_for_a_path => Some(Severity::Warning),
            _ => it.each.mildest,
        }
    }
}
