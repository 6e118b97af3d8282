//! Arcs that the wire cannot follow at its distance, upright or leaning.

use super::super::block::Motion;
use super::super::contours::Contour;
use super::super::moves::Course;
use super::super::summary::Tight;
use super::super::tilt::{Doubtful, STEEPEST, TiltedArc, Unknown};
use super::Report;
use crate::drawing::wire_side;
use crate::finding::{Detail, Fault, NoFix, Rule, Severity, Side, SmallRadius};
use crate::program::path::{UM_IN_MM, is_tight};
use crate::settings::Compensation;
use std::ops::Range;

impl Report<'_> {
    /// The arcs of a contour that may be too tight, with their places in the text.
    fn tight_of(&self, contour: &Contour<'_>) -> Vec<(Tight, Range<usize>)> {
        let is_offset_only = self.limits.compensation == Compensation::Path;
        let may_be_tight = |tight: &&Tight| {
            is_tight(tight.radius, self.largest_correction)
                && (tight.arc.side.is_some() || !is_offset_only)
        };
        let of_cut = |cut: usize| {
            let at = self.document.cuts.state_before(cut).at;
            let moves = self.document.cuts[cut].moves.as_ref();
            let all = moves.into_iter().flat_map(|moves| &moves.tight);
            all.filter(may_be_tight).map(move |tight| {
                let arc = tight.arc.shifted(at);
                (
                    Tight { arc, ..*tight },
                    self.document.bytes_in(cut, tight.range),
                )
            })
        };
        contour.cuts.clone().flat_map(of_cut).collect()
    }

    /// Arcs that the wire cannot follow at its distance: those of a part's contour, whether the control offsets it or
    /// nobody does.
    pub(super) fn tight_arcs(&mut self, cut: &Contour<'_>, orientation: f64) {
        for (
            Tight {
                arc: step, radius, ..
            },
            range,
        ) in &self.tight_of(cut)
        {
            let side_of_center = if step.motion == Motion::CounterClockwise {
                Side::Left
            } else {
                Side::Right
            };
            let wire_side = match step.side {
                Some(side) => side,
                None if self.limits.compensation == Compensation::Path => continue,
                None => {
                    let role = self.limits.side.role();
                    let by_settings = role.and_then(|role| wire_side(role, true, orientation));
                    by_settings.unwrap_or(side_of_center)
                }
            };
            let required = self.document.correction(step.offset);
            if wire_side == side_of_center
                && is_tight(*radius, required)
                && let Course::Arc(arc) = step.course(self.reading)
            {
                let detail = SmallRadius {
                    no_fix: Some(NoFix::Program),
                    ..SmallRadius::of(&arc, arc.radius, required, UM_IN_MM)
                };
                let detail = Detail::SmallRadius(Box::new(detail));
                self.push(Rule::SmallRadius, range.clone(), detail);
            }
        }
    }

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
            let correction = self.document.correction(arc.offset);
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

    /// The largest correction of a move, µm.
    pub(super) fn largest_correction(&self) -> f64 {
        let stated = self
            .definitions
            .values()
            .map(|&value| (value as f64 / 1e3).abs());
        stated.fold(self.limits.correction * 1e3, f64::max)
    }
}
