//! From a line or arc of the path to moves between nodes of the program's grid.

use super::block::Motion;
use crate::geometry::{Arc, Segment};
use crate::program::grid::{
    Node, chord_count, grid_centers, in_pieces, largest_distance, point_of, sagitta, snap,
};
use std::f64::consts::{PI, TAU};

/// How far a move may lie from its piece of the path, anywhere, µm: its centre is on the grid, its ends are snapped.
pub(super) const ASIDE_TOLERANCE: f64 = 2.5;

/// By how much the ends of a written arc may lie unlike far from its centre, µm: less than any reader takes for a fault.
const RADIUS_TOLERANCE: f64 = 1.5;

/// The largest sagitta of a chord that stands for a piece of an arc too large for the format, µm.
const CHORD_SAGITTA: f64 = 0.5;

/// A radius in steps above which an arc goes out as chords: its centre has more digits than controls take.
const LARGEST_RADIUS: f64 = 4e8;

/// A move to `to`, and the piece of the path that it stands for, in steps of the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Encoded {
    pub(crate) motion: Motion,
    pub(crate) from: Node,
    pub(crate) to: Node,
    pub(crate) center: Node,
    pub(crate) piece: Segment,
}

/// Appends the moves of `piece` between its snapped ends. `step` is the grid's step in µm. A piece without length on the grid appends
/// nothing. `None` where no arc within tolerance can be written.
pub(super) fn encode(
    piece: &Segment,
    from: Node,
    to: Node,
    step: f64,
    full_circles: bool,
    moves: &mut Vec<Encoded>,
) -> Option<()> {
    let Segment::Arc(arc) = piece else {
        if from != to {
            moves.push(Encoded {
                motion: Motion::Line,
                from,
                to,
                center: from,
                piece: *piece,
            });
        }
        return Some(());
    };
    let is_full = from == to && arc.sweep.abs() > PI;
    if from == to && (!is_full || arc.radius < 0.5) {
        return Some(());
    }
    if arc.radius > LARGEST_RADIUS {
        return in_pieces(
            piece,
            from,
            to,
            chord_count(arc, CHORD_SAGITTA / step)?,
            |piece, from, to| {
                moves.push(Encoded {
                    motion: Motion::Line,
                    from,
                    to,
                    center: from,
                    piece,
                });
                Some(())
            },
        );
    }
    if is_full && !full_circles {
        return in_pieces(piece, from, to, 2, |piece, from, to| {
            encode_arc(&piece, from, to, step, 0, moves)
        });
    }
    encode_arc(piece, from, to, step, 0, moves)
}

fn encode_arc(
    piece: &Segment,
    from: Node,
    to: Node,
    step: f64,
    depth: u32,
    moves: &mut Vec<Encoded>,
) -> Option<()> {
    let Segment::Arc(arc) = piece else {
        return None;
    };
    if from == to && arc.sweep.abs() <= PI {
        return Some(());
    }
    let fits = |center: Node| {
        (error_of(arc, center, from, to) * step <= ASIDE_TOLERANCE)
            && radii_differ(center, from, to) * step <= RADIUS_TOLERANCE
    };
    let center = grid_centers(arc, from, to)
        .iter()
        .map(|center| center.node)
        .find(|&center| fits(center));
    if let Some(center) = center {
        let motion = if arc.sweep > 0.0 {
            Motion::CounterClockwise
        } else {
            Motion::Clockwise
        };
        moves.push(Encoded {
            motion,
            from,
            to,
            center,
            piece: *piece,
        });
        return Some(());
    }
    // A chord of an arc this flat is as near to it as the grid is.
    if sagitta(arc) * step <= 2.0 * CHORD_SAGITTA {
        moves.push(Encoded {
            motion: Motion::Line,
            from,
            to,
            center: from,
            piece: *piece,
        });
        return Some(());
    }
    if depth >= 8 {
        return None;
    }
    let middle = snap(arc.point_at(0.5))?;
    for (share, from, to) in [(0.0, from, middle), (0.5, middle, to)] {
        encode_arc(
            &piece.part(share, share + 0.5),
            from,
            to,
            step,
            depth + 1,
            moves,
        )?;
    }
    Some(())
}

fn radii_differ(center: Node, from: Node, to: Node) -> f64 {
    ((point_of(from) - point_of(center)).norm() - (point_of(to) - point_of(center)).norm()).abs()
}

/// How far the arc about a grid centre lies from the true one at most; infinite where it turns otherwise.
fn error_of(arc: &Arc, center: Node, from: Node, to: Node) -> f64 {
    if center == from || center == to {
        return f64::INFINITY;
    }
    let made = Arc::about(
        point_of(center),
        point_of(from),
        point_of(to),
        arc.sweep > 0.0,
    );
    let turn = (made.sweep - arc.sweep).abs();
    if turn > PI && turn < TAU + PI {
        return f64::INFINITY;
    }
    let middles = (made.point_at(0.5) - arc.point_at(0.5)).norm();
    largest_distance(&Segment::Arc(made), &Segment::Arc(*arc)).max(middles)
}
