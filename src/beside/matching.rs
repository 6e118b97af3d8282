//! Places of a drawing that may match a block of a program.

use super::REACH;
use super::placement::Placement;
use super::rounds::{Rounds, Spot};
use super::traced::Traced;
use crate::geometry::Segment;

/// Places on the drawing that are tried for a block.
const PLACES: usize = 64;

/// A place of the drawing where a block begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub spot: Spot,
    pub(crate) placement: Placement,
}

/// Places of the drawing that may match a block, wherever the program lies.
pub(super) fn matching(
    rounds: &Rounds,
    traced: &Traced,
    index: usize,
    placement: &Placement,
) -> Vec<Found> {
    let Some(block) = traced.blocks[index].segment() else {
        return Vec::new();
    };
    let begin = placement.place(block.start());
    let mut found = Vec::new();
    let meant = block.end() - block.start();
    if meant.norm() > 20.0 {
        for (spot, whole) in rounds.leading(meant) {
            let is_arc = |segment: &Segment| segment.as_arc().map(|arc| arc.sweep > 0.0);
            if is_arc(&whole) == is_arc(block) && found.len() < PLACES {
                found.push(Found {
                    spot,
                    placement: placement.moved(begin - spot.at),
                });
            }
        }
    }
    // An arc lies about its centre, wherever on it the block begins.
    if let Some(arc) = block.as_arc() {
        let center = placement.place(arc.center);
        for (round, piece) in rounds.with_radius(arc.radius) {
            let Some(own) = rounds.rounds[round].pieces[piece].segment.as_arc() else {
                continue;
            };
            if found.len() >= PLACES {
                break;
            }
            let moved = placement.moved(center - own.center);
            let spots = rounds.near(moved.place(block.start()), 2.0 * REACH);
            let own = spots.into_iter();
            let own = own.filter(|spot| (spot.round, spot.piece) == (round, piece));
            found.extend(own.map(|spot| Found {
                spot,
                placement: moved,
            }));
        }
    }
    found
}
