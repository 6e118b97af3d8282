//! How the J of a line stands to its X and Y.

use super::{J_TOLERANCE, Seen};

/// What J of a line says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Length {
    /// The projection on the counted or on the larger axis, or X and Y are left out.
    Projection,
    /// X and Y are a ratio, J carries the scale.
    Ratio,
    /// The length of the line itself.
    Euclid,
    /// Nothing of these. `is_certain` where it cannot be a ratio either: nobody takes out a factor between 1 and 2 of a line along an axis.
    Misfit { is_certain: bool },
}

pub(super) fn length(seen: &Seen) -> Length {
    let (x, y, j) = (seen.block.x, seen.block.y, seen.block.j);
    let larger = x.max(y);
    let counted = if seen.axis() == crate::finding::Axis::X { x } else { y };
    let near = |a: f64| (j as f64 - a).abs() <= J_TOLERANCE;
    if larger == 0 || near(larger as f64) || (counted > 0 && near(counted as f64)) {
        return Length::Projection;
    }
    if x > 0 && y > 0 && near((x as f64).hypot(y as f64)) {
        return Length::Euclid;
    }
    if j < larger {
        return Length::Misfit { is_certain: true };
    }
    if j >= 2 * larger - J_TOLERANCE as i64 {
        return Length::Ratio;
    }
    Length::Misfit { is_certain: x == 0 || y == 0 }
}
