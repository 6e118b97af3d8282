//! What the looks at corners and walls share: the limits, and what lies about an edge.

use crate::geometry::Bounds;
use crate::toolpath::{Nearby, Part};

/// Of two edges that are as near as each other but for so small a share of the rounding the first one counts.
pub(super) const TIE: f64 = 1e-3;

/// What the clearance is checked against. Drawing units.
pub(super) struct Limits {
    pub clearance: f64,
    pub rounding: f64,
    /// What is left beside walls that are followed on both sides; `None` where both parts are drawn, and each place is looked at.
    pub(crate) along_walls: Option<f64>,
}

/// What lies about the edge that is looked at.
pub(super) struct About<'a> {
    /// Edges of the other part.
    pub(super) edges: Nearby<'a>,
    /// The way of a wire.
    pub(super) way: Nearby<'a>,
    /// A piece of that which the edge before lies beside.
    pub(super) beside: Option<usize>,
    /// The box of all that was asked about this edge.
    pub(super) asked: Bounds,
}

impl About<'_> {
    /// What lies about corners of the punch, about those of the plate, or about walls of the punch.
    pub(super) fn of(which: usize, [punch, plate]: [&Part; 2]) -> About<'_> {
        let (edges, way) = match which {
            0 => (&plate.near, &punch.path),
            1 => (&punch.near, &plate.path),
            _ => (&plate.near, &plate.path),
        };
        About {
            edges: Nearby::of(edges),
            way: Nearby::of(way),
            beside: None,
            asked: Bounds::EMPTY,
        }
    }
}
