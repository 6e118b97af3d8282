//! A contour with its role, and so the side on which the wire runs.

use super::{Contour, Drawing, Role};
use crate::geometry::Side;

/// A contour, its role, and what follows from the two.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    pub contour: Contour,
    /// Never [`Role::Ignore`]: such entities are in no contour. For a closed contour neither [`Role::Left`] nor
    /// [`Role::Right`].
    pub role: Role,
    /// Twice the signed area in square drawing units, positive counter-clockwise; 0 for an open contour.
    pub twice_area: f64,
}

impl Outline {
    /// The handle of the contour's first entity, by which users know the contour.
    pub(crate) fn name<'a>(&self, drawing: &'a Drawing) -> &'a str {
        let first = self.contour.pieces.first();
        first
            .and_then(|piece| drawing.get(piece.entity))
            .map_or("?", |entity| &entity.handle)
    }

    /// False for what is drawn a second time, and for what is left out.
    pub(crate) fn is_cut(&self) -> bool {
        self.contour.double_of.is_none() && self.role != Role::Ignore
    }

    /// True where the wire's centre runs on the contour itself, whatever the correction.
    pub(crate) fn is_on_line(&self) -> bool {
        self.role == Role::Line
    }

    /// True where no path beside the contour can be made, for want of a side.
    pub(crate) fn lacks_side(&self) -> bool {
        self.wire_side().is_none() && !self.is_on_line()
    }

    /// Side of the direction of travel on which the wire runs: see `wire_side`.
    pub(crate) fn wire_side(&self) -> Option<Side> {
        wire_side(self.role, self.contour.closed, self.twice_area)
    }
}

/// Side of the direction of travel on which the wire runs: inside an opening, outside a punch; that of an open contour
/// is its role. `None` where every arc must survive both sides, for an open contour with another role and for a closed
/// one without area, and for one that is cut on the line.
pub(crate) fn wire_side(role: Role, closed: bool, twice_area: f64) -> Option<Side> {
    let counter_clockwise = twice_area > 0.0;
    match role {
        Role::Left if !closed => Some(Side::Left),
        Role::Right if !closed => Some(Side::Right),
        _ if !closed || twice_area == 0.0 => None,
        Role::Opening if counter_clockwise => Some(Side::Left),
        Role::Opening => Some(Side::Right),
        Role::Punch if counter_clockwise => Some(Side::Right),
        Role::Punch => Some(Side::Left),
        Role::Both | Role::Left | Role::Right | Role::Line | Role::Ignore => None,
    }
}
