//! What a block does, in whole micrometres, wherever the program lies.

use super::traced::{Block, Motion};

/// Where a block leads, µm, and what it is.
pub(super) type Way = (i64, i64, u8);

/// What a block is by where it leads; where the way along it does not count, that of the upper half of the plane.
pub(super) fn way(block: &Block, is_directed: bool) -> Way {
    let (by, kind) = match &block.motion {
        Motion::Cut(segment) => {
            let kind = match segment.as_arc() {
                None => 0,
                Some(arc) if arc.sweep > 0.0 && is_directed => 1,
                Some(_) => 2,
            };
            // A full turn leads nowhere: its centre says how large it is.
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
