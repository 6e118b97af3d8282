//! A block mirrored or turned: its numbers stay; axes, quadrants and directions change. So the transformation is exact.

use crate::program::refactor::transform::Transform;
use crate::program::three_b::block::{Block, Motion, Quadrant};

/// The block for the same move, mirrored or turned.
pub(super) fn turned(block: &Block, transform: Transform) -> Block {
    if transform == Transform::NONE {
        return *block;
    }
    let (sign_x, sign_y) = block.motion.quadrant().signs();
    let [x, y] = match block.motion.is_line() {
        true => block.extent(),
        false => [block.x, block.y],
    };
    let [x, y] = transform.of_place([x * sign_x as i64, y * sign_y as i64]);
    let motion = match block.motion {
        Motion::Line(_) => Motion::Line(Quadrant::counter_clockwise(x, y)),
        Motion::CounterClockwise(_) => Motion::arc(!transform.mirrors(), x, y),
        Motion::Clockwise(_) => Motion::arc(transform.mirrors(), x, y),
    };
    let [x, y] = transform.of_place([block.x, block.y]).map(i64::abs);
    let axis = match motion {
        Motion::Line(quadrant) if x == y && x != 0 => quadrant.counts_at_45_degrees(),
        _ if transform.swaps() => block.axis.other(),
        _ => block.axis,
    };
    Block {
        x,
        y,
        j: block.j,
        axis,
        motion,
    }
}
