//! Sides that contradict the nesting: a punch that is cut out of another punch.

use super::Analysis;
use super::known::Known;
use super::report::Report;
use crate::drawing::{Contour, ContourKey, Drawing, winding};
use crate::finding::{Detail, Place, Rule, Severity, Side};
use crate::settings::SideSetting;

/// More contours than these are not compared at every edit.
const MOST_CONTOURS: usize = 500;

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
        let closed = ordered.iter().zip(sides).filter_map(|(key, side)| {
            let (contour, known) = (self.chains.get(*key)?, &**self.known.get(key)?);
            let is_punch = side.is_some_and(|it| it.sign() * known.index.twice_area() < 0.0);
            contour.closed.then_some((contour, known, is_punch))
        });
        let closed: Vec<(&Contour, &Known, bool)> = closed.collect();
        let within = |&(inner, known, is_punch): &(&Contour, &Known, bool)| {
            let first = inner.segment(drawing, 0).filter(|_| is_punch)?;
            let point = first.geometry.point_at(0.5);
            let own = known.index.bounds();
            let holds = |(outer, other, _): &&(&Contour, &Known, bool)| {
                let bounds = other.index.bounds();
                other.part == known.part
                    && bounds != own
                    && bounds.merged(&own) == bounds
                    && winding(drawing, outer, point) != 0
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
}
