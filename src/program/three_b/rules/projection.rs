//! The relation of a line's J to its X and Y.

use super::super::decode::J_TOLERANCE;
use super::Outlook;
use crate::program::three_b::block::{Block, Motion};

/// The meaning of a line's J.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Length {
    /// The projection on the counted or on the larger axis, or X and Y are left out.
    Projection,
    /// X and Y are a ratio, J carries the scale.
    Ratio,
    /// The length of the line itself.
    Euclid,
    /// None of these. `is_certain` where it cannot be a ratio either: nobody takes out a factor that is not whole from
    /// a line along an axis.
    Misfit { is_certain: bool },
}

pub(super) fn length(outlook: &Outlook) -> Length {
    length_of(outlook.block)
}

/// True for a line whose J is neither a projection nor the scale of a ratio.
pub(super) fn is_misfit(block: &Block) -> bool {
    matches!(block.motion, Motion::Line(_)) && matches!(length_of(block), Length::Misfit { .. })
}

fn length_of(block: &Block) -> Length {
    let Block { x, y, j, axis, .. } = *block;
    let larger = x.max(y);
    let counted = axis.of([x, y]);
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
    // A common factor that was taken out is a whole number.
    let factor = (j + larger / 2) / larger;
    if factor >= 2 && near((factor * larger) as f64) {
        return Length::Ratio;
    }
    Length::Misfit {
        is_certain: x == 0 || y == 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::three_b::block::{CountingAxis, Quadrant};

    #[test]
    fn the_length_in_j_is_told_by_x_and_y() {
        let misfit = |is_certain: bool| Length::Misfit { is_certain };
        for (numbers, expected) in [
            ([3000, 5000, 5000], Length::Projection),
            // On the axis that is counted, though it is the smaller one.
            ([3000, 5000, 3000], Length::Projection),
            ([0, 0, 700], Length::Projection),
            ([3, 5, 5000], Length::Ratio),
            ([3000, 4000, 5000], Length::Euclid),
            ([3000, 5000, 4000], misfit(true)),
            ([0, 5000, 7000], misfit(true)),
            ([3000, 5000, 7000], misfit(false)),
            ([0, 5000, 1], misfit(true)),
        ] {
            let [x, y, j] = numbers;
            let (axis, motion) = (CountingAxis::X, Motion::Line(Quadrant::First));
            let block = Block {
                x,
                y,
                j,
                axis,
                motion,
            };
            assert_eq!(length_of(&block), expected, "{numbers:?}");
        }
    }
}
