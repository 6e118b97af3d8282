//! What the wire leaves beyond its dead ends: `lost-pocket`.

use super::Analysis;
use super::pair_findings::FacingWalls;
use super::report::Report;
use crate::drawing::{ContourKey, Drawing};
use crate::finding::{Detail, Rule, Severity, Side};
use crate::rules::dead_end::{DeadEnd, Left};
use crate::rules::{Outlook, Wall};
use std::collections::BTreeMap;

/// The contour, the two walls that the wire comes to, and what it leaves.
type Told = (ContourKey, [usize; 2], Left);

/// What is left beyond the dead ends of all contours.
#[derive(Debug, Default)]
pub(crate) struct DeadEnds {
    /// By the rank of the entity and the segment that the wire stays farthest from.
    left: BTreeMap<(u64, usize, bool), Told>,
}

impl Analysis {
    /// The dead ends of all contours on the sides that the wire may run on. Where two walls are `narrow-slot`, that says it; and a contour
    /// that crosses itself has no sides.
    pub(super) fn dead_ends(
        &self,
        drawing: &Drawing,
        side_of: &dyn Fn(ContourKey) -> Option<Side>,
    ) -> DeadEnds {
        let mut ends = DeadEnds::default();
        if self.settings.severity(Rule::LostPocket).is_none() {
            return ends;
        }
        let mut seen = self.pairs.dead_ends().peekable();
        if seen.peek().is_none() {
            return ends;
        }
        let crossed = self.pairs.contours_with(Rule::SelfIntersection);
        let slots = self.pairs.slots();
        for (key, [one, other], side, center) in seen {
            let Some(outlook) = self
                .outlook(drawing, key)
                .filter(|_| !crossed.contains(&key))
            else {
                continue;
            };
            let is_concerned = side_of(key).is_none_or(|known| known == side);
            let end = || {
                DeadEnd::between(
                    &Wall::new(&outlook, one)?,
                    &Wall::new(&outlook, other)?,
                    side,
                    center,
                )
            };
            let Some(end) = is_concerned.then(end).flatten() else {
                continue;
            };
            let is_told = |of: &[FacingWalls]| {
                of.iter().any(|(walls, of_side)| {
                    of_side.is_none_or(|of_side| of_side == side)
                        && end.holds(outlook.contour.len(), *walls)
                })
            };
            if slots.get(&key).is_none_or(|of| !is_told(of)) {
                ends.enter(&outlook, key, &end);
            }
        }
        ends
    }

    /// Adds a finding for each place that the wire does not reach.
    pub(super) fn report_dead_ends(&self, drawing: &Drawing, ends: &DeadEnds, report: &mut Report) {
        // Where the contour is the wire's own path, it is followed.
        let mildest = report.is_for_a_path().then_some(Severity::Warning);
        for (key, walls, left) in ends.left.values() {
            if report.counts(Rule::LostPocket, mildest)
                && let Some(outlook) = self.outlook(drawing, *key)
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

impl DeadEnds {
    fn enter(&mut self, outlook: &Outlook, key: ContourKey, end: &DeadEnd) {
        let is_left = end.side() == Side::Left;
        let Some(left) = end.left(outlook) else {
            return;
        };
        let Some(segment) = outlook.segment(left.index as isize) else {
            return;
        };
        let place = (
            outlook.drawing.rank(segment.entity),
            segment.segment,
            is_left,
        );
        let new = (key, end.walls(), left);
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
