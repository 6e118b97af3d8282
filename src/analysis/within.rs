//! Sides that contradict the nesting: a punch that is cut out of another punch; and a nesting that is in doubt, since an outline lies so near
//! another one everywhere that it may be a copy of it.

use super::Analysis;
use super::known::Known;
use super::report::Report;
use crate::drawing::{Contour, ContourKey, Drawing, are_twins, lies_within, twins};
use crate::finding::{Detail, Place, Rule, Severity, Side};
use crate::settings::SideSetting;

/// More contours than these are not compared at every edit.
const MOST_CONTOURS: usize = 500;

/// mm: no wire leaves a wall that is thinner than this everywhere, nor is an outline drawn again so badly that it is further off.
const THIN: f64 = 0.1;

impl Analysis {
    /// The first punch that lies within another one of its workpiece, and how many more there are. Nesting alone gives
    /// none.
    pub(super) fn report_punches_within(
        &self,
        drawing: &Drawing,
        ordered: &[ContourKey],
        sides: &[Option<Side>],
        report: &mut Report,
    ) {
        let severity = Some(Severity::Warning);
        let by_nesting = self.settings.side == SideSetting::Auto && self.stated == 0;
        if by_nesting || !(2..=MOST_CONTOURS).contains(&ordered.len()) || !report.shows_findings() {
            return;
        }
        let ordered_sides = ordered.iter().zip(sides);
        let ordered_sides = ordered_sides.filter(|(key, _)| !self.is_on_line(**key));
        let closed = ordered_sides.filter_map(|(key, side)| {
            let (contour, known) = (self.chains.get(*key)?, &**self.known.get(key)?);
            let is_punch = side.is_some_and(|it| it.sign() * known.index.twice_area() < 0.0);
            contour.closed.then_some((contour, known, is_punch))
        });
        let closed: Vec<(&Contour, &Known, bool)> = closed.collect();
        let same_place = self.limits.tolerances.same_place;
        let within = |&(inner, known, is_punch): &(&Contour, &Known, bool)| {
            if !is_punch {
                return None;
            }
            let own = known.index.bounds();
            let holds = |(outer, other, _): &&(&Contour, &Known, bool)| {
                let bounds = other.index.bounds();
                other.part == known.part
                    && bounds != own
                    && bounds.merged(&own) == bounds
                    && lies_within(drawing, inner, outer)
                    && !are_twins(drawing, (outer, &bounds), (inner, &own), same_place)
            };
            let area = |(_, known, _): &&(&Contour, &Known, bool)| known.index.twice_area().abs();
            let holder = closed.iter().filter(holds);
            let holder = holder.min_by(|one, other| area(one).total_cmp(&area(other)))?;
            let first = |of: &Contour| of.pieces.first().map(|piece| piece.entity);
            Some((first(inner)?, first(holder.0).filter(|_| holder.2)?))
        };
        let within: Vec<_> = closed.iter().filter_map(within).collect();
        let Some(&(inner, outer)) = within.first() else {
            return;
        };
        if !report.counts(Rule::Settings, severity) {
            return;
        }
        let name = |of| drawing.get(of).map_or("", |entity| &entity.handle);
        let others = match within.len() - 1 {
            0 => String::new(),
            more => say!(and_more_punches, more),
        };
        let sentence = say!(a_punch_within_a_punch, name(inner), name(outer), others);
        report.add(
            Rule::Settings,
            severity,
            Place::Entity { entity: inner },
            Detail::Said(sentence),
            vec![Place::Entity { entity: outer }],
        );
    }
    /// Contours with sides by nesting that run beside another one everywhere, further off than what lies in one place and
    /// nearer than the cut is wide: copies, or walls; the sides of all that lies within them depend on it.
    pub(super) fn report_doubtful_nesting(
        &self,
        drawing: &Drawing,
        ordered: &[ContourKey],
        report: &mut Report,
    ) {
        if self.settings.side != SideSetting::Auto || report.is_for_a_path() {
            return;
        }
        let same_place = self.limits.tolerances.same_place;
        let thin = (2.0 * self.limits.correction).min(THIN / self.limits.unit_mm);
        let all = ordered
            .iter()
            .filter(|key| !self.is_on_line(**key))
            .filter_map(|key| Some((self.chains.get(*key)?, &**self.known.get(key)?)));
        let all: Vec<(&Contour, &Known)> = all.collect();
        let contours: Vec<_> = all
            .iter()
            .map(|(contour, known)| (*contour, known.index.bounds()))
            .collect();
        for [one, other] in twins(drawing, &contours, thin) {
            let (Some(first), Some(second)) = (all.get(one), all.get(other)) else {
                continue;
            };
            let is_wall = match (first.1.stated, second.1.stated) {
                (Some(own), Some(theirs)) => own != theirs,
                _ => false,
            };
            let is_copy = || {
                let [own, met] = [first, second].map(|it| (it.0, it.1.index.bounds()));
                are_twins(drawing, (own.0, &own.1), (met.0, &met.1), same_place)
            };
            let entity = |of: &Contour| of.pieces.first().map(|piece| piece.entity);
            let (Some(own), Some(met)) = (entity(first.0), entity(second.0)) else {
                continue;
            };
            if first.1.part != second.1.part || is_wall || is_copy() {
                continue;
            }
            let severity = Some(Severity::Error);
            if !report.counts(Rule::NarrowSlot, severity) {
                continue;
            }
            let name = |of| drawing.get(of).map_or("", |entity| &entity.handle);
            let sentence = say!(
                an_outline_that_may_be_a_copy,
                name(met),
                name(own),
                thin * self.limits.unit_mm
            );
            report.add(
                Rule::NarrowSlot,
                severity,
                Place::Entity { entity: met },
                Detail::Said(sentence),
                vec![Place::Entity { entity: own }],
            );
        }
    }
}
