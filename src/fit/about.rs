//! What the looks at corners and walls share: the limits, and what lies near an edge.

use crate::toolpath::{Nearby, Part};

/// Of two edges whose distances differ by no more than this share of the rounding, the first one counts.
pub(super) const TIE: f64 = 1e-3;

/// What the clearance is checked against. Drawing units.
pub(super) struct FitLimits {
    pub clearance: f64,
    pub rounding: f64,
    /// The clearance beside walls that both wires follow; `None` where both parts are drawn, and each place is looked at.
    pub(crate) along_walls: Option<f64>,
}

/// What lies near the edge that is looked at.
pub(super) struct About<'a> {
    /// Edges of the other part.
    pub(super) edges: Nearby<'a>,
    /// The way of a wire.
    pub(super) way: Nearby<'a>,
    /// A piece of it beside which the edge before lies.
    pub(super) beside: Option<usize>,
}

impl About<'_> {
    /// What lies near corners of the punch (0), near those of the plate (1), or near walls of the punch (2).
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
        }
    }
}
