//! Arcs that a leaning wire cannot follow at its distance.

use super::super::tilt::{Doubtful, STEEPEST, TiltedArc, Unknown};
use super::Report;
use crate::finding::{Fault, Rule, Severity};
use crate::program::path::{UM_IN_MM, is_tight};

impl Report<'_> {
    /// Arcs that have no room for a leaning wire, or vanish in the other plane.
    pub(super) fn taper(&mut self) {
        let Some(taper) = self.document.taper() else {
            return;
        };
        if let Some(Unknown::Height(line)) = taper.unknown {
            let fault = Fault::said(Rule::Taper, say!(how_far_the_wire_leans_needs_the_height));
            self.add_as(Severity::Information, self.document.words_of(line), fault);
        }
        if let Some(Doubtful {
            line,
            degrees,
            is_steep,
        }) = taper.doubtful
        {
            let (severity, sentence) = match is_steep {
                true => (
                    Severity::Warning,
                    say!(
                        the_wire_is_to_lean_more_than_any_machine_does,
                        degrees,
                        STEEPEST
                    ),
                ),
                false => (
                    Severity::Hint,
                    say!(an_angle_in_thousandths_of_a_degree, degrees),
                ),
            };
            let fault = Fault::said(Rule::Taper, sentence);
            self.add_as(severity, self.document.words_of(line), fault);
        }
        for arc in &taper.arcs {
            let TiltedArc {
                line,
                radius,
                narrows,
                is_inside,
                ..
            } = *arc;
            let correction = self.control.correction(arc.offset);
            let least = arc.least(correction);
            // That it is below the correction has its own finding.
            if !is_tight(radius, least) || is_inside && is_tight(radius, correction) {
                continue;
            }
            let [radius, least, narrows] =
                [radius, least, narrows.max(0.0)].map(|um| um / UM_IN_MM);
            let angle = arc.angle.to_degrees();
            let sentence = match is_inside {
                true if narrows <= 0.0 => {
                    say!(
                        an_arc_has_no_room_for_the_leaning_wire,
                        radius,
                        least,
                        angle
                    )
                }
                true => say!(
                    an_arc_has_no_room_for_the_taper,
                    radius,
                    least,
                    angle,
                    narrows
                ),
                false => say!(an_arc_narrows_to_nothing, radius, narrows, angle),
            };
            self.add(
                self.document.words_of(line),
                Fault::said(Rule::Taper, sentence),
            );
        }
    }
}
