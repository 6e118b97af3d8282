//! The controller's closed form against every single step, and against the block's ideal end.

use wedm::program::three_b::{Block, CountingAxis, Motion, Quadrant, interpolate, travel};

/// Steps that are taken at most: blocks that would take more are too long for this.
const STEPS: usize = 2_000_000;

pub fn run(data: &[u8]) {
    let Some(&data) = data.first_chunk::<14>() else {
        return;
    };
    let number = |at: usize, bytes: usize| {
        data[at..at + bytes]
            .iter()
            .fold(0_i64, |sum, byte| sum * 256 + i64::from(*byte))
    };
    let Some(quadrant) = Quadrant::from_number(data[12] % 4 + 1) else {
        return;
    };
    let motion = match data[12] / 4 % 3 {
        0 => Motion::Line(quadrant),
        1 => Motion::Clockwise(quadrant),
        _ => Motion::CounterClockwise(quadrant),
    };
    let axis = if data[13].is_multiple_of(2) {
        CountingAxis::X
    } else {
        CountingAxis::Y
    };
    // Any number for the closed form alone.
    let huge = Block {
        x: number(0, 4),
        y: number(4, 4),
        j: number(8, 4),
        axis,
        motion,
    };
    let _ = travel(&huge);
    // Small enough to be stepped through.
    let block = Block {
        x: huge.x % 3_000,
        y: huge.y % 3_000,
        j: huge.j % 30_000,
        axis,
        motion,
    };
    let stepped = interpolate(&block, STEPS, |_| {});
    let closed = travel(&block);
    // A line that counts an axis on which it hardly moves takes more steps than are taken here.
    if stepped.is_some() || closed.is_none() {
        assert_eq!(closed, stepped, "{block:?}");
    }
}
