//! `lost-pocket`: what the wire leaves beyond its dead ends.
//!
//! What is left beyond one is kept with its observation until something changes between its two walls. There are no more observations than a drawing
//! may have (`Budget::most_seen`), so all of them are looked through for each report.

use super::Analysis;
use super::compare::{Ended, Observed};
use super::pair_findings::FacingWalls;
use super::pairs::Pairs;
use super::report::Report;
use crate::drawing::{ContourIndex, ContourKey, Drawing};
use crate::finding::{Detail, Rule, Severity, Side};
use crate::rules::arc_as_chords::REACH;
use crate::rules::dead_end::{DeadEnd, Left, holds};
use crate::rules::{Outlook, PAIR_RULES, Wall};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeSet;
use std::ops::Bound;

/// The place from which the wire stays farthest away: rank of an entity, its segment, and whether the wire runs on its left.
type Farthest = (u64, usize, bool);

/// A dead end as it is reported. Of several at one place it is the least deep one, then the one with the first walls.
struct ReportedEnd {
    order: (Farthest, u64, [usize; 2]),
    of: ContourKey,
    /// It is known on which side of the contour the wire runs.
    has_side: bool,
    left: Left,
}

/// What the dead ends of a contour are looked at with.
struct Around<'a> {
    outlook: Outlook<'a>,
    side: Option<Side>,
    slots: Option<SlotsBySide>,
}

impl Analysis {
    /// Adds a finding for each place that the wire does not reach. A contour that crosses itself has no sides; walls that are a `narrow-slot`
    /// have their own finding. Where nobody has said on which side the wire runs, it may never come near a dead end: that is no error.
    pub(super) fn report_dead_ends(
        &mut self,
        drawing: &Drawing,
        side_of: &dyn Fn(&Analysis, ContourKey) -> Option<Side>,
        report: &mut Report,
    ) {
        let is_on = self.settings.severity(Rule::LostPocket).is_some();
        if !is_on || !self.pairs.seen.has(Rule::LostPocket) {
            self.pairs.changed.clear();
            return;
        }
        let mut pairs = std::mem::take(&mut self.pairs);
        self.forget_changed_ends(&mut pairs);
        let told = self.dead_ends(drawing, &mut pairs, side_of);
        self.pairs = pairs;
        // The wire follows a contour that is its own path.
        let mildest = report.is_for_a_path().then_some(Severity::Warning);
        let (known, unknown): (Vec<ReportedEnd>, Vec<ReportedEnd>) =
            told.into_iter().partition(|told| told.has_side);
        self.report_ends(drawing, &known, mildest, report);
        self.report_ends(drawing, &unknown, Some(Severity::Warning), report);
    }

    fn report_ends(
        &self,
        drawing: &Drawing,
        told: &[ReportedEnd],
        mildest: Option<Severity>,
        report: &mut Report,
    ) {
        report.count(Rule::LostPocket, mildest, told.len());
        // Only the first ones are reported.
        let most = report.room(Rule::LostPocket, mildest);
        for ReportedEnd {
            order, of, left, ..
        } in told.iter().take(most)
        {
            let (_, _, walls) = order;
            if let Some(outlook) = self.outlook(drawing, *of)
                && let Some(place) = outlook.place(left.index)
            {
                let related = walls.iter().filter(|&&wall| wall != left.index);
                let related = related.filter_map(|&wall| outlook.place(wall)).collect();
                let detail = Detail::DeadEnd {
                    near: left.near,
                    uncut: left.depth,
                };
                report.add(Rule::LostPocket, mildest, place, detail, related);
            }
        }
    }

    /// Forgets what is left beyond dead ends between whose walls, or near which, something has changed.
    fn forget_changed_ends(&self, pairs: &mut Pairs) {
        let mut changed: FxHashMap<ContourKey, BTreeSet<u32>> = FxHashMap::default();
        for (key, run) in pairs.changed.drain() {
            changed.entry(key).or_default().insert(run);
        }
        for each in pairs.seen.ends() {
            let of = each.one.0;
            if let (Some(ended), Some(runs)) = (&each.ended, changed.get(&of))
                && let Some(known) = self.known.get(&of)
                && reaches_into(&known.index, ended.walls, runs)
            {
                each.ended = None;
            }
        }
    }

    /// The dead ends of all contours, in machining order, one for each place.
    fn dead_ends(
        &self,
        drawing: &Drawing,
        pairs: &mut Pairs,
        side_of: &dyn Fn(&Analysis, ContourKey) -> Option<Side>,
    ) -> Vec<ReportedEnd> {
        let mut slots = pairs.slots();
        let crossed: FxHashSet<ContourKey> = pairs.seen.crossings.keys().copied().collect();
        // A tangle may have as many dead ends as pairs of segments.
        let mut around = |key: ContourKey| {
            let outlook = self.outlook(drawing, key);
            let outlook = outlook.filter(|_| !crossed.contains(&key))?;
            let slots = slots.remove(&key).map(|slots| SlotsBySide::of(&slots));
            let side = side_of(self, key);
            Some(Around {
                outlook,
                side,
                slots,
            })
        };
        let mut all: FxHashMap<ContourKey, Option<Around>> = FxHashMap::default();
        let told = pairs.seen.ends().filter_map(|each| {
            let around = all.entry(each.one.0).or_insert_with_key(|&key| around(key));
            around.as_ref()?.told(each)
        });
        let mut told: Vec<ReportedEnd> = told.collect();
        told.sort_unstable_by_key(|told| told.order);
        told.dedup_by_key(|told| told.order.0);
        told
    }
}

impl Around<'_> {
    /// What is reported of a dead end, which is worked out if necessary.
    fn told(&self, each: &mut Observed) -> Option<ReportedEnd> {
        let outlook = &self.outlook;
        let ((Some(side), _), Some((center, _))) = (each.sides, each.disc) else {
            return None;
        };
        let is_one = PAIR_RULES[each.rule].rule == Rule::LostPocket && !each.blocked;
        if !is_one || self.side.is_some_and(|known| known != side) {
            return None;
        }
        let [one, other] = [each.one.1, each.other.1];
        let ended = *each.ended.get_or_insert_with(|| {
            let walls = Wall::new(outlook, one).zip(Wall::new(outlook, other));
            let end = walls.and_then(|(one, other)| DeadEnd::between(&one, &other, side, center));
            Ended {
                walls: end.map_or([one, other], |end| end.walls()),
                left: end.and_then(|end| end.left(outlook)),
            }
        });
        let (walls, left) = (ended.walls, ended.left?);
        let is_slot = |slots: &SlotsBySide| slots.lie_between(walls, outlook.contour.len(), side);
        if self.slots.as_ref().is_some_and(is_slot) {
            return None;
        }
        let (entity, segment) = outlook.segment_id(left.index)?;
        let place = (outlook.drawing.rank(entity), segment, side == Side::Left);
        // Depths are not negative: their bits are in their order.
        let order = (place, left.depth.to_bits(), walls);
        let of = each.one.0;
        Some(ReportedEnd {
            order,
            of,
            has_side: self.side.is_some(),
            left,
        })
    }
}

/// True where one of these runs comes into the stretch of a contour from one wall to another, or so near it that a rule looks at it.
fn reaches_into(index: &ContourIndex, [from, to]: [usize; 2], runs: &BTreeSet<u32>) -> bool {
    let count = index.len();
    if (to + count - from) % count + 2 * REACH >= count {
        return !runs.is_empty();
    }
    let [first, last] =
        [from + count - REACH, to + REACH].map(|at| index.run_of(at % count) as u32);
    let is_any = |range: (Bound<u32>, Bound<u32>)| runs.range(range).next().is_some();
    match (from + count - REACH) % count <= (to + REACH) % count {
        true => is_any((Bound::Included(first), Bound::Included(last))),
        false => {
            is_any((Bound::Included(first), Bound::Unbounded))
                || is_any((Bound::Unbounded, Bound::Included(last)))
        }
    }
}

/// The slots between walls of one contour, for the wire on either side: the two walls, in the order of the first, each
/// with the least second wall from it on.
struct SlotsBySide([Vec<([usize; 2], usize)>; 2]);

impl SlotsBySide {
    fn of(slots: &[FacingWalls]) -> SlotsBySide {
        SlotsBySide([Side::Left, Side::Right].map(|on| {
            let on_side = slots
                .iter()
                .filter(|(_, side)| side.is_none_or(|side| side == on));
            let ordered = on_side.map(|([one, other], _)| [*one.min(other), *one.max(other)]);
            let mut each: Vec<_> = ordered.map(|walls| (walls, walls[1])).collect();
            each.sort_unstable();
            let mut least = usize::MAX;
            for (_, second) in each.iter_mut().rev() {
                least = least.min(*second);
                *second = least;
            }
            each
        }))
    }

    /// True where one lies between two walls of a dead end.
    fn lie_between(&self, walls: [usize; 2], count: usize, side: Side) -> bool {
        let of = &self.0[usize::from(side == Side::Right)];
        let [from, to] = walls;
        if from > to {
            return of.iter().any(|(slot, _)| holds(walls, count, *slot));
        }
        let first = of.partition_point(|(slot, _)| slot[0] < from);
        of.get(first).is_some_and(|(_, least)| *least <= to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Entity, Geometry, Kind, Vertex};
    use crate::settings::Effective;
    use std::sync::Arc;

    /// The teeth of a comb leave dead ends; while one long line crosses them all, none of them is
    /// worked out.
    #[test]
    fn dead_ends_of_a_contour_that_crosses_itself_wait_until_it_does_not() {
        let comb = |last: (f64, f64)| {
            let tooth = |at: usize| {
                let x = at as f64 * 0.3;
                [(x, 0.0), (x + 0.1, 5.0), (x + 0.2, 0.0)]
            };
            let corners = (0..40).flat_map(tooth).chain([(20.0, 9.0), last]);
            Geometry::Polyline {
                closed: true,
                vertices: corners.map(|(x, y)| Vertex::new(x, y, 0.0)).collect(),
            }
        };
        let entity = |geometry| Entity {
            handle: "A".into(),
            layer: "0".into(),
            role: None,
            kind: Kind::LightPolyline,
            geometry,
        };
        let mut drawing = Drawing::new(None);
        let id = drawing.push(entity(comb((-9.0, 9.0))));
        let settings = Arc::new(Effective::default());
        let mut analysis = Analysis::new(&drawing, settings.clone());
        let told = |analysis: &mut Analysis, drawing: &Drawing| {
            let (findings, _) = analysis.findings(drawing, usize::MAX);
            let lost = findings.iter().filter(|it| it.rule == Rule::LostPocket);
            let lost = lost.count();
            let known = analysis.pairs.seen.ends();
            (lost, known.filter(|each| each.ended.is_some()).count())
        };
        let (lost, known) = told(&mut analysis, &drawing);
        assert!(lost > 30 && known >= lost, "{lost} {known}");
        // From its first look on, and after an edit.
        drawing.replace(id, entity(comb((-9.0, 2.0))));
        assert_eq!(
            told(&mut Analysis::new(&drawing, settings.clone()), &drawing),
            (0, 0)
        );
        let delta = crate::drawing::Delta {
            touched: vec![crate::drawing::Touched::Vertices {
                entity: id,
                start: 121,
                removed: 1,
                inserted: 1,
            }],
        };
        analysis.update(&drawing, &delta);
        assert_eq!(told(&mut analysis, &drawing).0, 0);
        drawing.replace(id, entity(comb((-9.0, 9.0))));
        analysis.update(&drawing, &delta);
        assert_eq!(told(&mut analysis, &drawing), (lost, known));
    }
}
