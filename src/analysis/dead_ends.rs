//! What the wire leaves beyond its dead ends: `lost-pocket`.

use super::Analysis;
use super::pair_findings::FacingWalls;
use super::pairs::Pairs;
use super::report::Report;
use crate::drawing::{ContourKey, Drawing, RUN};
use crate::finding::{Detail, Rule, Severity, Side};
use crate::rules::arc_as_chords::REACH;
use crate::rules::dead_end::{DeadEnd, Left, holds};
use crate::rules::{NEIGHBOURS, Outlook, Wall};
use rustc_hash::FxHashMap;

/// The contour, the two walls that the wire comes to, and what it leaves.
type Told = (ContourKey, [usize; 2], Left);

/// Rank of an entity, its segment, and whether the wire runs on the left of it.
type Farthest = (u64, usize, bool);

/// What is left beyond the dead ends of all contours.
#[derive(Debug, Default)]
pub(crate) struct DeadEnds {
    /// By the rank of the entity and the segment that the wire stays farthest from.
    left: FxHashMap<Farthest, Told>,
}

impl Analysis {
    /// The dead ends of all contours on the sides that the wire may run on. Where two walls are `narrow-slot`, that says it; and a contour
    /// that crosses itself has no sides.
    pub(super) fn dead_ends(
        &self,
        drawing: &Drawing,
        pairs: &mut Pairs,
        side_of: &dyn Fn(ContourKey) -> Option<Side>,
    ) -> DeadEnds {
        let mut ends = DeadEnds::default();
        if self.settings.severity(Rule::LostPocket).is_none() || pairs.dead_ends().next().is_none()
        {
            return ends;
        }
        let crossed = pairs.contours_with(Rule::SelfIntersection);
        let slots = pairs.slots();
        for each in pairs.dead_ends() {
            let (key, one, other) = (each.one.0, each.one.1, each.other.1);
            let (Some(side), Some((center, _)), Some(outlook)) =
                (each.sides.0, each.disc, self.outlook(drawing, key))
            else {
                continue;
            };
            if crossed.contains(&key) || side_of(key).is_some_and(|known| known != side) {
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
                ended
            });
            let Some((walls, left)) = ended else {
                continue;
            };
            let is_told = |of: &[FacingWalls]| {
                of.iter().any(|(facing, of_side)| {
                    of_side.is_none_or(|of_side| of_side == side) && holds(walls, count, *facing)
                })
            };
            if slots.get(&key).is_none_or(|of| !is_told(of)) {
                ends.enter(&outlook, (key, walls, left), side);
            }
        }
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
        let mut told: Vec<(&Farthest, &Told)> = ends.left.iter().collect();
        // Only the first are told, of however many.
        let most = report.room(Rule::LostPocket, mildest);
        if most < told.len() {
            told.select_nth_unstable_by_key(most, |(place, _)| **place);
            told.truncate(most);
        }
        told.sort_unstable_by_key(|(place, _)| **place);
        for (_, (key, walls, left)) in told {
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

impl DeadEnds {
    fn enter(&mut self, outlook: &Outlook, new: Told, side: Side) {
        let (_, _, left) = new;
        let Some((entity, segment)) = outlook.segment_id(left.index) else {
            return;
        };
        let place = (outlook.drawing.rank(entity), segment, side == Side::Left);
        // One place is told once: of discs that touch the same walls within rounding the first.
        let known = self.left.entry(place).or_insert(new);
        let order = |(_, walls, left): &Told| (left.depth, *walls);
        if order(&new)
            .partial_cmp(&order(known))
            .is_some_and(std::cmp::Ordering::is_lt)
        {
            *known = new;
        }
    }
}
