//! What still holds for two parts laid in each other after an edit: an edge is not looked at again if it is where it was, and nothing has
//! changed of all that was asked about it.

use super::change::Change;
use super::observations::{Observations, Verdict};
use crate::geometry::Bounds;
use crate::toolpath::Part;

/// Two parts laid in each other as they were before an edit, under the same limits.
pub(super) struct Reuse<'a> {
    observations: &'a [Observations; 3],
    /// The changes of the edges of both parts.
    edges: [Change; 2],
    /// The boxes of all that has changed, and the box around them.
    changed: Vec<Bounds>,
    all: Bounds,
}

impl<'a> Reuse<'a> {
    /// `None` where too much has changed.
    pub(super) fn new(
        observations: &'a [Observations; 3],
        before: [&Part; 2],
        now: [&Part; 2],
    ) -> Option<Reuse<'a>> {
        let mut changed = Vec::new();
        let mut of_edges = |before: &Part, now: &Part| {
            if std::ptr::eq(before, now) {
                return Some(Change::none(now.edges.len()));
            }
            let change = Change::of(&before.edges, &now.edges, |a, b| {
                a.geometry == b.geometry && a.turned_about == b.turned_about
            })?;
            let ways = [&before.path, &now.path];
            let of_way = Change::of(ways[0].segments(), ways[1].segments(), PartialEq::eq)?;
            changed.extend(change.gone().map(|edge| *before.near.bounds_of(edge)));
            changed.extend(change.come().map(|edge| *now.near.bounds_of(edge)));
            changed.extend(of_way.gone().map(|piece| *ways[0].bounds_of(piece)));
            changed.extend(of_way.come().map(|piece| *ways[1].bounds_of(piece)));
            Some(change)
        };
        let edges = [of_edges(before[0], now[0])?, of_edges(before[1], now[1])?];
        let mut all = Bounds::EMPTY;
        changed.iter().for_each(|bounds| all.merge(bounds));
        Some(Reuse {
            observations,
            edges,
            changed,
            all,
        })
    }

    /// What is known of one kind of looks.
    pub(super) fn of(&self, which: usize) -> Known<'_> {
        let [punch, plate] = &self.edges;
        let [own, other] = match which {
            1 => [plate, punch],
            _ => [punch, plate],
        };
        Known {
            reuse: self,
            observations: &self.observations[which],
            own,
            other,
            next: 0,
        }
    }
}

/// What is known of one kind of looks, edge by edge.
pub(super) struct Known<'a> {
    reuse: &'a Reuse<'a>,
    observations: &'a Observations,
    own: &'a Change,
    other: &'a Change,
    /// The verdict that comes next.
    next: usize,
}

impl Known<'_> {
    /// What was asked about an edge, and what came of it, where that still holds. Edges are asked for in their order.
    pub(super) fn kept(&mut self, edge: usize) -> Option<(Bounds, Option<Verdict>)> {
        let was = self.own.was(edge)?;
        let asked = *self.observations.asked.get(was)?;
        let known = &self.observations.verdicts;
        while known
            .get(self.next)
            .is_some_and(|known| (known.edge as usize) < was)
        {
            self.next += 1;
        }
        let is_new = |changed: &Bounds| changed.touches(&asked);
        if is_new(&self.reuse.all) && self.reuse.changed.iter().any(is_new) {
            return None;
        }
        let verdict = known
            .get(self.next)
            .filter(|known| known.edge as usize == was);
        let verdict = match verdict {
            Some(known) => Some(Verdict {
                edge: edge as u32,
                other: self.other.is(known.other as usize)? as u32,
                ..*known
            }),
            None => None,
        };
        Some((asked, verdict))
    }
}
