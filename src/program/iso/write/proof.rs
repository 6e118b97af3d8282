//! The proof of a written line: the control's move is compared with the piece of the path.

use super::Lines;
use crate::geometry::Segment;
use crate::program::encode::proved_aside;
use crate::program::grid::point_of;
use crate::program::iso::encode::Encoded;
use crate::program::iso::moves::FARTHEST;
use crate::program::iso::moves::{Course, Move, Place};
use crate::program::write::{ProofError, Proved, scaled, too_far_out};

impl Lines<'_> {
    /// Compares the control's move for the line with the node and the piece of the path: its largest distance from that, µm.
    pub(super) fn check(&self, step: &Encoded, made: Option<Move>) -> Proved<f64> {
        let Some(made) = made else {
            if self.place(step.to).iter().any(|nm| nm.abs() > FARTHEST) {
                return Err(too_far_out(point_of(step.to)));
            }
            return Err(ProofError::Mismatch(say!(
                a_written_move_does_not_move,
                step.to
            )));
        };
        let (from, to) = (self.place(step.from), self.place(step.to));
        if made.from != from || made.to != to || made.motion != step.motion {
            // Only the profile can have changed the origin or the unit of coordinates.
            let shown = |[x, y]: Place| format!("({x}, {y})");
            let profile = say!(its_lines_lead_elsewhere, shown(to), shown(made.to));
            return Err(self.refused(&profile));
        }
        if made.is_cut() && !self.is_switched_off && made.side != self.side {
            return Err(self.refused(say!(the_correction_is_not_in_force_along_the_contour)));
        }
        let decoded = match made.course(&self.reading) {
            Course::Line => made.chord(),
            Course::Arc(arc) => Segment::Arc(arc),
            Course::OffRadius { start, end, .. } => {
                return Err(ProofError::Mismatch(say!(
                    the_ends_of_the_arc_lie_apart_from_its_centre,
                    step.to,
                    start,
                    end
                )));
            }
            Course::NoRadius => {
                return Err(ProofError::Mismatch(say!(
                    the_arc_to_a_place_has_no_radius,
                    step.to
                )));
            }
        };
        let piece = scaled(
            &step.piece.moved(-point_of(self.zero).coords),
            self.step_um(),
        );
        proved_aside(&decoded, &piece, 1e-6).map_err(|worst| {
            ProofError::Mismatch(say!(the_move_runs_beside_the_path, step.to, worst))
        })
    }
}
