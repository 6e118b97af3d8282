//! How close together the walls of a contour lie beside a correction: what a path beside them costs grows with that.

use super::clearance::Walls;
use super::vicinity::FAN;
use rustc_hash::FxHashMap;

/// The most walls that may lie, on average, in a square of twice the correction: each of them is compared with the others there.
pub(super) const MOST_IN_A_SQUARE: usize = 500;

/// A path that is looked for among all crossings takes this many looks for a pair of walls beside each other: each wall has two pieces, each of
/// which is cut by both of the other, and what is cut off is measured again.
const LOOKS_OF_A_PAIR: u64 = 16;

/// How many walls lie on average in a square of this size with a wall.
pub(super) fn crowd(walls: &Walls, size: f64) -> usize {
    let count = walls.segments().len();
    if count <= MOST_IN_A_SQUARE || size <= 0.0 {
        return 0;
    }
    (pairs(walls, size) / count as u64) as usize
}

/// The looks at pairs of pieces that it may take to find out what a path at a correction loses.
pub(crate) fn looks_beside(walls: &Walls, correction: f64) -> u64 {
    LOOKS_OF_A_PAIR * pairs(walls, 2.0 * correction)
}

/// How many pairs of walls lie in the same square of this size. It is estimated from the boxes of a few walls, so that it takes hardly any time.
fn pairs(walls: &Walls, size: f64) -> u64 {
    let count = walls.segments().len();
    let all = walls.bounds();
    let mut few = Vec::with_capacity(count.div_ceil(FAN));
    walls.few_near(&all, &mut few);
    let mut squares: FxHashMap<(u64, u64), u64> = FxHashMap::default();
    for (first, bounds) in few {
        let middle = nalgebra::center(&bounds.min, &bounds.max) - all.min;
        let square = (middle / size).map(|column| column as u64);
        let own = FAN.min(count - first as usize) as u64;
        *squares.entry((square.x, square.y)).or_default() += own;
    }
    squares.values().map(|own| own * own).sum()
}
