//! `units`, as far as the size of a program shows it: one that no wire cuts suggests another unit.

use crate::finding::Fault;
use crate::geometry::Bounds;
use crate::rules::units::{is_sizable, is_vast, size};

/// Fewer moves are no part.
const FEWEST_MOVES: usize = 3;

/// The larger side of a program's box (µm), mm. To the µm, since rounding depends on where reading began.
pub(crate) fn size_of(bounds: &Bounds) -> f64 {
    size(bounds).round() * 1e-3
}

/// The finding for a program with this many moves in a box, µm.
pub(crate) fn absurd_size(bounds: &Bounds, moves: usize) -> Option<Fault> {
    let size = size_of(bounds);
    let is_absurd = is_vast(bounds, 1e-3) || !is_sizable(bounds, 1e-3);
    (moves >= FEWEST_MOVES && size > 0.0 && is_absurd).then_some(Fault::AbsurdSize { size })
}
