//! The controller step by step, as it is: what the closed form of [`travel`](super::travel) is tested against.

use super::super::block::{Block, Motion, Node};
use super::{Ramp, Round, is_turned, ramp, signed};

/// The same as [`travel`](super::travel), step by step: `each` gets the position after every step, relative to the block's start.
///
/// Takes a step for each µm of the way. Ends after `most` steps.
pub fn interpolate(block: &Block, most: usize, mut each: impl FnMut(Node)) -> Option<Node> {
    let mut left_to_count = block.j;
    let mut at = Node { x: 0, y: 0 };
    if left_to_count == 0 {
        return Some(at);
    }
    let (quadrant, turn) = match block.motion {
        Motion::Line(quadrant) => (quadrant, None),
        Motion::Clockwise(quadrant) => (quadrant, Some(false)),
        Motion::CounterClockwise(quadrant) => (quadrant, Some(true)),
    };
    if let Some(counter_clockwise) = turn {
        let mut round = Round::of(block, quadrant, counter_clockwise)?;
        let start = round.point();
        for _ in 0..most {
            if round.is_at_axis() {
                round.turn();
            }
            let is_outside = round.left * round.left + round.done * round.done >= round.square;
            let counts = if is_outside {
                round.left -= 1;
                round.left_counts()
            } else {
                round.done += 1;
                !round.left_counts()
            };
            let point = round.point();
            at = Node {
                x: point.x - start.x,
                y: point.y - start.y,
            };
            each(at);
            left_to_count -= i64::from(counts);
            if left_to_count == 0 {
                return Some(at);
            }
        }
        return None;
    }
    let Ramp {
        first,
        second,
        first_counts,
    } = ramp(block, quadrant)?;
    let (mut a, mut b) = (0_i64, 0_i64);
    for _ in 0..most {
        let is_above = i128::from(b) * i128::from(first) >= i128::from(a) * i128::from(second);
        // Along the second axis there is nothing to compare.
        let steps_first = is_above && first > 0;
        if steps_first {
            a += 1;
        } else {
            b += 1;
        }
        let (x, y) = if is_turned(quadrant) { (b, a) } else { (a, b) };
        at = signed(quadrant, x, y);
        each(at);
        left_to_count -= i64::from(steps_first == first_counts);
        if left_to_count == 0 {
            return Some(at);
        }
    }
    None
}
