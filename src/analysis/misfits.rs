//! Where two parts of a pair bind, and why, as findings.

use super::Analysis;
use super::report::Report;
use crate::drawing::{ContourKey, Drawing, Outline};
use crate::finding::{Cause, Detail, Misfit, Place, Rule};
use crate::fit::{SegmentOf, Spot};
use std::sync::Arc;

impl Analysis {
    /// Reports where the two parts of a pair bind.
    pub(super) fn report_pair(
        &mut self,
        drawing: &Drawing,
        both: [(ContourKey, &Outline); 2],
        report: &mut Report,
    ) {
        let is_cut_twice = both[0].0 == both[1].0;
        let Some(fitted) = self.fit_of(drawing, both) else {
            return;
        };
        let held = &fitted.held;
        let (rounding, wanted) = (
            self.limits.tolerances.report,
            self.settings.pair.clearance.unwrap_or(0.0) / self.limits.unit_mm,
        );
        // Walls are deepest where they end, in a corner.
        let corner_of = |spot: &Spot| {
            if spot.turn > 0.0 {
                return Some(spot.of.clone());
            }
            let wide = self.wide(wanted, spot.clearance);
            let corner = held.corner_near(fitted.both(), spot.at, wide);
            corner.cloned()
        };
        let arc_radius = |(entity, segment): SegmentOf| {
            let geometry = drawing.segment(entity, segment)?;
            Some(geometry.as_arc()?.radius)
        };
        let cause = |spot: &Spot, at: SegmentOf, other: SegmentOf| {
            if let Some(sharper) = &spot.sharper {
                let ([sharp, round], name) = match sharper.is_of_plate {
                    true => ([spot.other, spot.segment], &spot.partner),
                    false => ([spot.segment, spot.other], &spot.of),
                };
                let round = arc_radius(round).unwrap_or(0.0);
                let sharp = arc_radius(sharp).filter(|radius| *radius < round);
                return Cause::Sharper(name.clone(), [sharp.unwrap_or(0.0), round]);
            }
            let radii = arc_radius(at).zip(arc_radius(other));
            let radii = radii.filter(|(own, other)| {
                !is_cut_twice && ((own - other).abs() - wanted).abs() > rounding
            });
            match (corner_of(spot), radii) {
                (Some(of), _) => Cause::Corner(of),
                (None, Some((own, other))) => Cause::Radii([own, other]),
                (None, None) => Cause::Wall,
            }
        };
        let is_binding = |clearance: f64| clearance < -rounding;
        let count = held.clearances().filter(|it| is_binding(it.1)).count();
        let of_each = if is_cut_twice { 1 } else { 2 };
        report.count(Rule::DoesNotFit, None, of_each * count);
        for spot in fitted.spots().filter(|spot| is_binding(spot.clearance)) {
            if report.is_full(Rule::DoesNotFit, None) {
                break;
            }
            let mut add = |at: SegmentOf, other: SegmentOf, of: &Arc<str>, partner: &Arc<str>| {
                if !report.is_full(Rule::DoesNotFit, None) {
                    let misfit = Misfit {
                        at: spot.at,
                        clearance: spot.clearance,
                        wanted,
                        of: of.clone(),
                        partner: partner.clone(),
                        cause: cause(&spot, at, other),
                    };
                    let detail = Detail::DoesNotFit(Box::new(misfit));
                    report.add(
                        Rule::DoesNotFit,
                        None,
                        place(at),
                        detail,
                        vec![place(other)],
                    );
                }
            };
            add(spot.segment, spot.other, &spot.of, &spot.partner);
            if !is_cut_twice {
                add(spot.other, spot.segment, &spot.partner, &spot.of);
            }
        }
    }

    /// The largest distance of what belongs to a corner from its spot, where this much clearance is `missing`.
    pub(super) fn wide(&self, clearance: f64, missing: f64) -> f64 {
        2.0 * self.limits.correction.max(clearance) + missing.abs()
    }
}

fn place((entity, segment): SegmentOf) -> Place {
    Place::Segment { entity, segment }
}
