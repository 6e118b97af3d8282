//! From a line or arc of the path to moves between nodes of the program's grid.

use super::block::Motion;
use crate::geometry::{Arc, Segment};
use crate::program::encode::{ASIDE_TOLERANCE, Attempt, Encoder, aside};
use crate::program::grid::{Node, arc_about, grid_centers, radii_differ};
use std::f64::consts::{PI, TAU};

/// The distances of an arc's ends from its centre may differ by this much, µm: no reader takes less for a fault.
const RADIUS_TOLERANCE: f64 = 1.5;

/// An arc with a radius above this, in steps, is written as chords: its centre has more digits than controls take.
const LARGEST_RADIUS: f64 = 4e8;

/// A move to `to`, and its piece of the path, in steps of the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Encoded {
    pub(crate) motion: Motion,
    pub(crate) from: Node,
    pub(crate) to: Node,
    pub(crate) center: Node,
    pub(crate) piece: Segment,
}

/// How a profile writes its moves.
pub(super) struct Moves {
    /// A step of the grid, µm.
    pub step: f64,
    /// Full turns are written as one arc.
    pub(crate) full_circles: bool,
}

impl Encoder for Moves {
    type Block = Encoded;

    fn step(&self) -> f64 {
        self.step
    }

    fn lines(&self, _: i64) -> i64 {
        1
    }

    fn largest_radius(&self) -> f64 {
        LARGEST_RADIUS
    }

    fn line(&self, piece: Segment, from: Node, to: Node) -> Encoded {
        Encoded {
            motion: Motion::Line,
            from,
            to,
            center: from,
            piece,
        }
    }

    fn arc(&self, arc: &Arc, from: Node, to: Node, full_turn: bool) -> Attempt<Encoded> {
        if arc.radius > self.largest_radius() {
            return Attempt::Chords;
        }
        if full_turn && !self.full_circles {
            return Attempt::Pieces(2);
        }
        let fits = |center: &Node| {
            error_of(arc, *center, from, to) * self.step <= ASIDE_TOLERANCE
                && radii_differ(*center, from, to) * self.step <= RADIUS_TOLERANCE
        };
        let Some(center) = grid_centers(arc, from, to).find(fits) else {
            return Attempt::Misses;
        };
        let motion = Motion::turning(arc.sweep > 0.0);
        Attempt::Made(Encoded {
            motion,
            from,
            to,
            center,
            piece: Segment::Arc(*arc),
        })
    }
}

/// The largest distance of the arc about a grid centre from the true one; infinite where it turns the other way.
fn error_of(arc: &Arc, center: Node, from: Node, to: Node) -> f64 {
    let Some(made) = arc_about(arc, center, from, to) else {
        return f64::INFINITY;
    };
    let turn = (made.sweep - arc.sweep).abs();
    if turn > PI && turn < TAU + PI {
        return f64::INFINITY;
    }
    aside(&Segment::Arc(made), &Segment::Arc(*arc))
}
