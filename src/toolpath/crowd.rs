//! How close together the walls of a contour lie beside a correction: what a path beside them costs grows with that.

use super::clearance::Walls;
use super::vicinity::FAN;
use rustc_hash::FxHashMap;

/// The most walls that may lie, on average, in a square of twice the correction: each of them is compared with the others there.
pub(super) const MOST_IN_A_SQUARE: usize = 500;

/// How many walls lie on average in a square of this size with a wall. It is estimated from the boxes of a few walls, so that it takes hardly any time.
pub(super) fn crowd(walls: &Walls, size: f64) -> usize {
    let count = walls.segments().len();
    if count <= MOST_IN_A_SQUARE || size <= 0.0 {
        return 0;
    }
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
    let pairs: u64 = squares.values().map(|own| own * own).sum();
    (pairs / (count as u64).max(1)) as usize
}
