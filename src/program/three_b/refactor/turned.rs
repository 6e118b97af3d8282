//! A block mirrored or turned: its numbers stay; axes, quadrants and directions change. So the transformation is exact.

use crate::program::refactor::Transform;
use crate::program::three_b::block::{Block, CountingAxis, Motion, Quadrant};

/// The block for the same move, mirrored or turned.
pub(super) fn turned(block: &Block, transform: Transform) -> Block {
    let signed = |quadrant: Quadrant| {
        let (sign_x, sign_y) = quadrant.signs();
        let (x, y) = match (block.x, block.y, block.motion, block.axis) {
            // A line that leaves both numbers out runs along its counting axis.
            (0, 0, Motion::Line(_), CountingAxis::X) => (block.j, 0),
            (0, 0, Motion::Line(_), CountingAxis::Y) => (0, block.j),
            (x, y, ..) => (x, y),
        };
        transform.of_numbers(x * sign_x as i64, y * sign_y as i64)
    };
    let arc = |quadrant: Quadrant, counter_clockwise: bool| {
        let (x, y) = signed(quadrant);
        if counter_clockwise != transform.mirrors() {
            Motion::CounterClockwise(Quadrant::counter_clockwise(x, y))
        } else {
            Motion::Clockwise(Quadrant::clockwise(x, y))
        }
    };
    let motion = match block.motion {
        Motion::Line(quadrant) => {
            let (x, y) = signed(quadrant);
            Motion::Line(Quadrant::counter_clockwise(x, y))
        }
        Motion::CounterClockwise(quadrant) => arc(quadrant, true),
        Motion::Clockwise(quadrant) => arc(quadrant, false),
    };
    let (x, y) = transform.of_numbers(block.x, block.y);
    let axis = match (motion, block.axis) {
        // A line at 45° counts by its quadrant.
        (Motion::Line(Quadrant::First | Quadrant::Third), _) if x.abs() == y.abs() && x != 0 => {
            CountingAxis::Y
        }
        (Motion::Line(_), _) if x.abs() == y.abs() && x != 0 => CountingAxis::X,
        (_, axis) if !transform.swaps() => axis,
        (_, CountingAxis::X) => CountingAxis::Y,
        (_, CountingAxis::Y) => CountingAxis::X,
    };
    Block {
        x: x.abs(),
        y: y.abs(),
        j: block.j,
        axis,
        motion,
    }
}
