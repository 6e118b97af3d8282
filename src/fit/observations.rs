//! What was seen of the edges of a part that lies in another.

use crate::geometry::Point;

/// What was seen of an edge of a part; `verdicts` are those on the ones that stand too far out, in their order.
pub(super) fn verdict_on(verdicts: &[Verdict], edge: usize) -> Option<&Verdict> {
    let edge_of = |verdict: &Verdict| verdict.edge as usize;
    let at = verdicts.binary_search_by_key(&edge, edge_of);
    verdicts.get(at.ok()?)
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
