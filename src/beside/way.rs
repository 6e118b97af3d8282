//! The motion of a block, in whole micrometres, wherever the program lies.

use super::traced::{Block, Motion};

/// The displacement of a block, µm, and its kind.
pub(super) type Way = (i64, i64, u8);

/// The kind of a block by its displacement; where the direction does not count, that of the upper half of the plane.
pub(super) fn way(block: &Block, is_directed: bool) -> Way {
    let (by, kind) = match &block.motion {
        Motion::Cut(segment) => {
            let kind = match segment.as_arc() {
                None => 0,
                Some(arc) if arc.sweep > 0.0 && is_directed => 1,
                Some(_) => 2,
            };
            // A full turn leads nowhere: its centre gives its size.
            let by = match segment.as_arc().filter(|arc| arc.is_full_turn()) {
                Some(arc) => arc.center - arc.start,
                None => segment.end() - segment.start(),
            };
            (by, kind)
        }
        Motion::Way(_, by) => (*by, 3),
        Motion::Stop => return (0, 0, 4),
    };
    let (x, y) = (by.x.round() as i64, by.y.round() as i64);
    match is_directed || (y, x) >= (0, 0) {
        true => (x, y, kind),
        false => (-x, -y, kind),
    }
}
