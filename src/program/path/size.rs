//! `units`, as far as the size of a program tells: one that no wire cuts speaks for another unit.

use crate::finding::Fault;
use crate::geometry::Bounds;
use crate::rules::units::{is_sizable, is_vast, size};

/// Fewer moves are no part.
const FEWEST_MOVES: usize = 3;

/// The larger side of a program's box (µm), mm. To the µm: what rounding adds hangs on where the program was read from.
pub(crate) fn size_of(bounds: &Bounds) -> f64 {
    size(bounds).round() * 1e-3
}

/// What is said of a program of so many moves that reaches over a box, µm.
pub(crate) fn absurd_size(bounds: &Bounds, moves: usize) -> Option<Fault> {
    let size = size_of(bounds);
    let is_absurd = is_vast(bounds, 1e-3) || !is_sizable(bounds, 1e-3);
    (moves >= FEWEST_MOVES && size > 0.0 && is_absurd).then_some(Fault::AbsurdSize { size })
}
