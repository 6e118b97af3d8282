//! What the wire leaves beyond its dead ends: `lost-pocket`.

use super::Analysis;
use super::pair_findings::FacingWalls;
use super::pairs::Pairs;
use super::report::Report;
use super::told::{DeadEnds, Farthest, LeftBetween};
use crate::drawing::{ContourKey, Drawing, RUN};
use crate::finding::{Detail, Rule, Severity, Side};
use crate::rules::arc_as_chords::REACH;
use crate::rules::dead_end::{DeadEnd, holds};
use crate::rules::{NEIGHBOURS, Outlook, Wall};
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::Arc;

impl Analysis {
    /// The dead ends of all contours on the sides that the wire may run on. Where two walls are `narrow-slot`, that says it; and a contour
    /// that crosses itself has no sides.
    pub(super) fn dead_ends(
        &self,
        drawing: &Drawing,
        pairs: &mut Pairs,
        side_of: &dyn Fn(ContourKey) -> Option<Side>,
    ) -> Arc<DeadEnds> {
        let forgotten = std::mem::take(&mut pairs.forgotten);
        let known = pairs.made.ends.take();
        if self.settings.severity(Rule::LostPocket).is_none() || !pairs.seen.has(Rule::LostPocket) {
            return Arc::default();
        }
        let holds = |known: &Arc<DeadEnds>| {
            let mut sides = known.sides.iter();
            sides.all(|(&key, &side)| side_of(key) == side)
                && !forgotten.iter().any(|run| known.hang_on(run))
        };
        let ends = known.filter(holds);
        let ends = ends.unwrap_or_else(|| Arc::new(self.dead_ends_anew(drawing, pairs, side_of)));
        pairs.made.ends = Some(ends.clone());
        ends
    }

    fn dead_ends_anew(
        &self,
        drawing: &Drawing,
        pairs: &mut Pairs,
        side_of: &dyn Fn(ContourKey) -> Option<Side>,
    ) -> DeadEnds {
        let mut ends = DeadEnds::default();
        let mut left = FxHashMap::default();
        let crossed = pairs.contours_with(Rule::SelfIntersection);
        let slots = pairs.slots();
        for each in pairs.dead_ends() {
            let (key, one, other) = (each.one.0, each.one.1, each.other.1);
            let wire = *ends.sides.entry(key).or_insert_with(|| side_of(key));
            let (Some(side), Some((center, _)), Some(outlook)) =
                (each.sides.0, each.disc, self.outlook(drawing, key))
            else {
                continue;
            };
            if crossed.contains(&key) || wire.is_some_and(|known| known != side) {
                continue;
            }
            let count = outlook.contour.len();
            let ended = each.ended.unwrap_or_else(|| {
                let walls = Wall::new(&outlook, one).zip(Wall::new(&outlook, other));
                let end =
                    walls.and_then(|(one, other)| DeadEnd::between(&one, &other, side, center));
                let ended = end.and_then(|end| Some((end.walls(), end.left(&outlook)?)));
                let is_forward = end.is_none_or(|end| end.walls().is_sorted());
                each.ended = (is_forward && hangs_on_runs(one, other, count)).then_some(ended);
                if each.ended.is_none() {
                    match runs_about(one, other, count).filter(|_| is_forward) {
                        Some(runs) => ends.runs.extend(runs.map(|run| (key, run as u32))),
                        None => _ = ends.contours.insert(key),
                    }
                }
                ended
            });
            let Some((walls, beyond)) = ended else {
                continue;
            };
            let is_told = |of: &[FacingWalls]| {
                of.iter().any(|(facing, of_side)| {
                    of_side.is_none_or(|of_side| of_side == side) && holds(walls, count, *facing)
                })
            };
            if slots.get(&key).is_none_or(|of| !is_told(of)) {
                enter(&mut left, &outlook, (key, walls, beyond), side);
            }
        }
        ends.left = left.into_iter().collect();
        ends.left.sort_unstable_by_key(|(place, _)| *place);
        ends
    }

    /// Adds a finding for each place that the wire does not reach.
    pub(super) fn report_dead_ends(&self, drawing: &Drawing, ends: &DeadEnds, report: &mut Report) {
        // Where the contour is the wire's own path, it is followed.
        let mildest = report.is_for_a_path().then_some(Severity::Warning);
        report.count(Rule::LostPocket, mildest, ends.left.len());
        if report.is_full(Rule::LostPocket, mildest) {
            return;
        }
        // Only the first are told, of however many.
        let most = report.room(Rule::LostPocket, mildest);
        for (_, (key, walls, left)) in ends.left.iter().take(most) {
            if let Some(outlook) = self.outlook(drawing, *key)
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

/// True where what a rule sees between two segments of a contour, and about them, lies in their runs: these are looked at anew, and what
/// has been seen between them with them, where something in them changes, or [`NEIGHBOURS`] segments about them.
fn hangs_on_runs(one: usize, other: usize, count: usize) -> bool {
    const ABOUT: usize = REACH - NEIGHBOURS;
    let (first, last) = (one.min(other), one.max(other));
    let is_inside = first >= REACH && last + REACH < count;
    is_inside
        && last / RUN - first / RUN <= 1
        && (first - ABOUT) / RUN == first / RUN
        && (last + ABOUT) / RUN == last / RUN
}

/// The runs that hold two segments of a contour and those about them; `None` where these are many, or go round its end.
fn runs_about(one: usize, other: usize, count: usize) -> Option<Range<usize>> {
    const FEW: usize = 8;
    let first = one.min(other).checked_sub(REACH)? / RUN;
    let last = one.max(other) + REACH;
    let runs = first..last / RUN + 1;
    (last < count && runs.len() <= FEW).then_some(runs)
}

/// Adds what is left, by its place.
fn enter(
    left_at: &mut FxHashMap<Farthest, LeftBetween>,
    outlook: &Outlook,
    new: LeftBetween,
    side: Side,
) {
    let (_, _, left) = new;
    let Some((entity, segment)) = outlook.segment_id(left.index) else {
        return;
    };
    let place = (outlook.drawing.rank(entity), segment, side == Side::Left);
    // One place is told once: of discs that touch the same walls within rounding the first.
    let known = left_at.entry(place).or_insert(new);
    let order = |(_, walls, left): &LeftBetween| (left.depth, *walls);
    if order(&new)
        .partial_cmp(&order(known))
        .is_some_and(std::cmp::Ordering::is_lt)
    {
        *known = new;
    }
}
