//! A block mirrored or turned: its numbers stay; axes, quadrants and directions change. So the transformation is exact.

use crate::program::refactor::Transform;
use crate::program::three_b::block::{Block, Motion, Quadrant};

/// The block for the same move, mirrored or turned.
pub(super) fn turned(block: &Block, transform: Transform) -> Block {
    let signed = |quadrant: Quadrant| {
        let (sign_x, sign_y) = quadrant.signs();
        let [x, y] = match block.motion {
            Motion::Line(_) => block.extent(),
            _ => [block.x, block.y],
        };
        transform.of_numbers(x * sign_x as i64, y * sign_y as i64)
    };
    let arc = |quadrant: Quadrant, counter_clockwise: bool| {
        let (x, y) = signed(quadrant);
        Motion::arc(counter_clockwise != transform.mirrors(), x, y)
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
        (Motion::Line(quadrant), _) if x.abs() == y.abs() && x != 0 => {
            quadrant.counts_at_45_degrees()
        }
        (_, axis) if !transform.swaps() => axis,
        (_, axis) => axis.other(),
    };
    Block {
        x: x.abs(),
        y: y.abs(),
        j: block.j,
        axis,
        motion,
    }
}
