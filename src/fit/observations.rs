//! What was seen of the edges of a part that lies in another, and what that depends on.

use crate::geometry::{Bounds, Point};

/// What was seen of the edges of a part, in their order.
#[derive(Clone, Debug, Default)]
pub(super) struct EdgeObservations {
    /// For each edge, the box of everything that was asked about it; an empty one where nothing was.
    pub asked: Vec<Bounds>,
    /// The verdicts on those that stand too far out.
    pub verdicts: Vec<Verdict>,
}

impl EdgeObservations {
    /// What was seen of an edge that stands too far out.
    pub(super) fn of(&self, edge: usize) -> Option<&Verdict> {
        let edge_of = |verdict: &Verdict| verdict.edge as usize;
        let at = self.verdicts.binary_search_by_key(&edge, edge_of);
        self.verdicts.get(at.ok()?)
    }
}

/// An edge that stands too far out, by indices and places: to which segments they belong is found out each time it is reported.
#[derive(Clone, Copy, Debug)]
pub(super) struct Verdict {
    pub edge: u32,
    /// On the edge.
    pub at: Point,
    pub clearance: f64,
    /// The edge of the other part there, and the place on it that is reported.
    pub other: u32,
    pub(crate) at_other: Point,
    pub lies: Lies,
}

/// Where on its edge the place lies that stands too far out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Lies {
    /// In a corner, `away` from where the wire turned.
    InCorner { away: f64 },
    /// At the first or the last end of a wall, which is less deep elsewhere.
    AtEnd { is_last: bool },
    /// Elsewhere on a wall.
    OnWall,
    /// All along a long wall.
    AllAlong,
    /// On the other part: it is a tip of that.
    OnTip,
}
