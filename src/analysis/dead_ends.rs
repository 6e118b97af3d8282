//! `lost-pocket`: what the wire leaves beyond its dead ends.

use super::Analysis;
use super::ends::{Asked, DeadEnds, EndsOf, Runs};
use super::pair_findings::FacingWalls;
use super::pairs::Pairs;
use super::report::Report;
use crate::drawing::{ContourIndex, ContourKey, Drawing};
use crate::finding::{Detail, Rule, Severity, Side};
use crate::rules::arc_as_chords::REACH;
use crate::rules::dead_end::{DeadEnd, holds};
use crate::rules::{NEIGHBOURS, Outlook, PAIR_RULES, Wall};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;
use std::sync::Arc;

/// A dead end depends on at most this many runs about its walls, else on the whole contour.
const FEW: usize = 8;

impl Analysis {
    /// Updates the dead ends of all contours, for each possible wire side. Walls reported as `narrow-slot` are skipped.
    pub(super) fn find_dead_ends(
        &self,
        drawing: &Drawing,
        pairs: &mut Pairs,
        side_of: &dyn Fn(ContourKey) -> Option<Side>,
    ) {
        let changed = std::mem::take(&mut pairs.changed);
        let known = pairs.ends.take();
        if self.settings.severity(Rule::LostPocket).is_none() || !pairs.seen.has(Rule::LostPocket) {
            return;
        }
        // A tangle may have as many dead ends as pairs of segments, none of which is reported.
        let crossings = &pairs.seen.crossings;
        let has_sides = |key: ContourKey| !crossings.contains_key(&key);
        let mut asked: FxHashMap<ContourKey, Asked> = FxHashMap::default();
        match &known {
            Some(known) => {
                for (key, run) in changed {
                    if let Asked::About(runs) = asked.entry(key).or_default() {
                        runs.insert(run);
                    }
                }
                for (&key, of) in &known.of {
                    if of.side != side_of(key) {
                        asked.insert(key, Asked::All);
                    } else if of.waits != Asked::NOTHING && has_sides(key) {
                        asked.entry(key).or_default().add(&of.waits);
                    }
                }
            }
            None => {
                let own = pairs
                    .seen
                    .with_ends()
                    .filter(|(one, other)| one.0 == other.0);
                asked.extend(own.map(|(one, _)| (one.0, Asked::All)));
            }
        }
        if asked.is_empty() {
            pairs.ends = known;
            return;
        }
        let mut ends = known.unwrap_or_default();
        for (key, asked) in asked.extract_if(|&key, _| !has_sides(key)) {
            let of = Arc::make_mut(ends.of.entry(key).or_default());
            of.waits.add(&asked);
            of.side = side_of(key);
        }
        let has_slots =
            |key: ContourKey| pairs.seen.slots.contains_key(&key) && asked.contains_key(&key);
        let slots = pairs.slots(has_slots).into_iter();
        let slots: FxHashMap<ContourKey, Slots> =
            slots.map(|(key, each)| (key, Slots::of(&each))).collect();
        let mut of_all: FxHashMap<ContourKey, BTreeSet<Runs>> = FxHashMap::default();
        if asked.values().any(|asked| matches!(asked, Asked::All)) {
            for (one, other) in pairs.seen.with_ends() {
                of_all.entry(one.0).or_default().insert([one.1, other.1]);
            }
        }
        for (key, asked) in asked {
            let known = ends.of.remove(&key);
            let Some(outlook) = self.outlook(drawing, key) else {
                continue;
            };
            let is_known = known.is_some();
            let (mut of, runs) = match asked {
                Asked::All => (EndsOf::default(), of_all.remove(&key).unwrap_or_default()),
                Asked::About(about) => {
                    let mut of = known.map(Arc::unwrap_or_clone).unwrap_or_default();
                    let runs = leave(pairs, key, &mut of, &about);
                    (of, runs)
                }
            };
            (of.side, of.waits) = (side_of(key), Asked::NOTHING);
            let has_any = enter(pairs, (key, &outlook), (&mut of, slots.get(&key)), &runs);
            // One that does not count on this side of the wire may count on the other.
            if is_known || has_any {
                ends.of.insert(key, Arc::new(of));
            }
        }
        pairs.ends = Some(ends);
    }

    /// Adds a finding for each place that the wire does not reach. A contour that crosses itself has no sides.
    /// Where nobody has said on which side the wire runs, it may never come near a dead end: that is no error.
    pub(super) fn report_dead_ends(
        &self,
        drawing: &Drawing,
        side_of: &dyn Fn(ContourKey) -> Option<Side>,
        report: &mut Report,
    ) {
        let Some(ends) = &self.pairs.ends else {
            return;
        };
        let has_sides = |key: ContourKey| !self.pairs.seen.crossings.contains_key(&key);
        let is_known = |key: ContourKey| has_sides(key) && side_of(key).is_some();
        let is_unknown = |key: ContourKey| has_sides(key) && side_of(key).is_none();
        // The wire follows a contour that is its own path.
        let mildest = report.is_for_a_path().then_some(Severity::Warning);
        self.report_ends(drawing, ends, mildest, &is_known, report);
        let warning = Some(Severity::Warning);
        self.report_ends(drawing, ends, warning, &is_unknown, report);
    }

    fn report_ends(
        &self,
        drawing: &Drawing,
        ends: &DeadEnds,
        mildest: Option<Severity>,
        holds: &dyn Fn(ContourKey) -> bool,
        report: &mut Report,
    ) {
        report.count(Rule::LostPocket, mildest, ends.count(holds));
        // Only the first ones are reported.
        let most = report.room(Rule::LostPocket, mildest);
        for (key, walls, left) in ends.first(most, holds) {
            if let Some(outlook) = self.outlook(drawing, key)
                && let Some(place) = outlook.place(left.index)
            {
                let related = walls
                    .iter()
                    .filter(|&&wall| wall != left.index)
                    .filter_map(|&wall| outlook.place(wall))
                    .collect();
                report.add(
                    Rule::LostPocket,
                    mildest,
                    place,
                    Detail::DeadEnd {
                        near: left.near,
                        uncut: left.depth,
                    },
                    related,
                );
            }
        }
    }
}

/// Removes results that depend on the changed runs; returns the pairs of runs to check again.
/// Results that depend on more than the runs about their walls are removed, too; those across the
/// end of a contour count as such.
fn leave(
    pairs: &Pairs,
    key: ContourKey,
    of: &mut EndsOf,
    changed: &BTreeSet<u32>,
) -> BTreeSet<Runs> {
    const REACHED: u32 = FEW as u32;
    let mut runs = of.far.clone();
    let about = changed
        .iter()
        .flat_map(|run| run.saturating_sub(REACHED)..=run.saturating_add(REACHED));
    for run in about.collect::<BTreeSet<u32>>() {
        let others = pairs.partners_of((key, run)).filter(|other| other.0 == key);
        runs.extend(others.map(|other| [run.min(other.1), run.max(other.1)]));
        let from = of.seen_from(run.saturating_sub(REACHED), run);
        runs.extend(from.filter(|runs| runs.contains(&run)));
    }
    runs.iter().for_each(|runs| of.remove(runs));
    runs
}

/// Adds the observations between these pairs of runs of a contour, except those that its slots report. False where
/// there are none.
fn enter(
    pairs: &mut Pairs,
    (key, outlook): (ContourKey, &Outlook),
    (of, slots): (&mut EndsOf, Option<&Slots>),
    runs: &BTreeSet<Runs>,
) -> bool {
    let count = outlook.contour.len();
    let is_told = |walls, side| slots.is_some_and(|slots| slots.lie_between(walls, count, side));
    let mut has_any = false;
    for &runs in runs {
        let [one, other] = runs.map(|run| (key, run));
        for each in pairs.seen.ends_between(&(one, other)) {
            has_any = true;
            if PAIR_RULES[each.rule].rule != Rule::LostPocket || each.blocked {
                continue;
            }
            let (one, other) = (each.one.1, each.other.1);
            let (Some(side), Some((center, _))) = (each.sides.0, each.disc) else {
                continue;
            };
            if of.side.is_some_and(|known| known != side) {
                continue;
            }
            let ended = each.ended.unwrap_or_else(|| {
                let walls = Wall::new(outlook, one).zip(Wall::new(outlook, other));
                let end =
                    walls.and_then(|(one, other)| DeadEnd::between(&one, &other, side, center));
                let ended = end.and_then(|end| Some((end.walls(), end.left(outlook)?)));
                let is_forward = end.is_none_or(|end| end.walls().is_sorted());
                let hangs = is_forward && hangs_on_runs(outlook.index, one, other);
                each.ended = hangs.then_some(ended);
                if !(hangs || is_forward && is_near(outlook.index, one, other)) {
                    of.far.insert(runs);
                }
                ended
            });
            if let Some((walls, left)) = ended
                && !is_told(walls, side)
                && let Some((entity, segment)) = outlook.segment_id(left.index)
            {
                let place = (outlook.drawing.rank(entity), segment, side == Side::Left);
                of.insert(runs, place, walls, left);
            }
        }
    }
    has_any
}

/// True if all that a rule sees between two segments lies in their runs, so that re-checking these is enough: they are
/// checked again where one of their segments changes, or one of [`NEIGHBOURS`] about them.
fn hangs_on_runs(index: &ContourIndex, one: usize, other: usize) -> bool {
    const ABOUT: usize = REACH - NEIGHBOURS;
    let (first, last) = (one.min(other), one.max(other));
    let is_inside = first >= REACH && last + REACH < index.len();
    let [of_first, of_last] = [first, last].map(|segment| index.run_of(segment));
    is_inside
        && of_last - of_first <= 1
        && index.run_of(first - ABOUT) == of_first
        && index.run_of(last + ABOUT) == of_last
}

/// True where the runs of two segments and of those about them are few, and do not cross the end of the contour.
fn is_near(index: &ContourIndex, one: usize, other: usize) -> bool {
    let last = one.max(other) + REACH;
    let first = one.min(other).checked_sub(REACH);
    first.is_some_and(|first| last < index.len() && index.run_of(last) - index.run_of(first) < FEW)
}

/// The slots between walls of one contour, for the wire on either side: the two walls, in the order of the first, each
/// with the least second wall from it on.
struct Slots([Vec<([usize; 2], usize)>; 2]);

impl Slots {
    fn of(slots: &[FacingWalls]) -> Slots {
        Slots([Side::Left, Side::Right].map(|on| {
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
            let known = analysis.pairs.ends.as_ref();
            (lost.count(), known.map_or(0, |ends| ends.count(|_| true)))
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
