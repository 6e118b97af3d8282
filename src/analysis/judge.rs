//! All that is found in a drawing: what has been seen is put together anew for each report.

use super::report::{Report, Tally};
use super::{Analysis, Faults, Notability};
use crate::drawing::{ContourKey, Drawing, EntityId, Role};
use crate::finding::{Detail, Finding, NoFix, Place, Rule, Severity, Side, SmallRadius};
use crate::rules::{CONTOUR_RULES, Outlook, units};
use crate::settings::SideSetting;
use crate::toolpath;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// Segments that are looked at to say which repairs of arcs below the correction would bring another fault.
const MOST_TRIED: usize = 40_000;

/// And looks at pairs of them: where many arcs crowd, each try compares them all with each other.
const MOST_LOOKS: u64 = 5_000_000;

/// Arcs below the correction of one contour that are kept.
const MOST_KEPT: usize = 16;

impl Analysis {
    /// The contours that have something to tell, in machining order.
    fn notable_in_order(&self, drawing: &Drawing) -> Vec<(ContourKey, Notability)> {
        // What is suspended is not in the drawing.
        let awake = self
            .notable
            .iter()
            .filter(|(_, notable)| Some(notable.first) != self.suspended);
        let mut notable: Vec<(u64, ContourKey, Notability)> = awake
            .map(|(&key, notable)| (drawing.rank(notable.first), key, notable.what))
            .collect();
        notable.sort_unstable_by_key(|&(rank, key, _)| (rank, key));
        notable
            .into_iter()
            .map(|(_, key, what)| (key, what))
            .collect()
    }

    /// Says of arcs whose repair would bring another fault that there is none. Each takes a look at the drawing: in one where that would be
    /// more than [`MOST_TRIED`] segments in all, and beyond [`MOST_LOOKS`], it is found out when the repair is asked for.
    pub(super) fn give_reasons(&self, drawing: &Drawing, findings: &mut [Finding]) {
        let mut hopeful: Vec<(&mut SmallRadius, EntityId, usize)> = findings
            .iter_mut()
            .filter_map(|finding| match (&mut finding.detail, &finding.place) {
                (Detail::SmallRadius(numbers), Place::Segment { entity, segment })
                    if numbers.no_fix.is_none() =>
                {
                    Some((&mut **numbers, *entity, *segment))
                }
                _ => None,
            })
            .collect();
        if hopeful.len().saturating_mul(self.segments) > MOST_TRIED {
            return;
        }
        let mut looks = 0;
        for (numbers, entity, segment) in &mut hopeful {
            if looks >= MOST_LOOKS {
                break;
            }
            let Some((key, index)) = self.chains.index_of(*entity, *segment) else {
                continue;
            };
            let larger = self.larger_arc(drawing, key, index, &mut looks);
            if larger.is_none() {
                numbers.no_fix = Some(NoFix::Spoils);
            }
        }
    }

    /// How many findings of which kind there are.
    pub(super) fn tally(&mut self, drawing: &Drawing) -> Tally {
        Tally {
            unseen: self.pairs.uncompared(),
            ..self.report(drawing, 0).tally()
        }
    }

    pub(super) fn report(&mut self, drawing: &Drawing, limit: usize) -> Report {
        let mut report = Report::new(self.settings.clone(), limit);
        if self.is_vast(drawing) {
            report.doubt_unit();
        }
        // By nesting, the role of each depends on all.
        let nested: Option<FxHashMap<ContourKey, Role>> = (self.settings.side == SideSetting::Auto)
            .then(|| {
                let ordered = self.in_machining_order(drawing);
                ordered
                    .iter()
                    .copied()
                    .zip(self.roles(drawing, ordered))
                    .collect()
            });
        // Where nothing states a role and none depends on nesting.
        let everywhere = self.settings.side.role().filter(|_| self.stated == 0);
        let role_of = |analysis: &Analysis, key: ContourKey| match (&nested, everywhere) {
            (Some(roles), _) => roles.get(&key).copied().unwrap_or(Role::Both),
            (None, Some(role @ (Role::Both | Role::Opening | Role::Punch))) => role,
            (None, _) => analysis
                .roles(drawing, &[key])
                .first()
                .copied()
                .unwrap_or(Role::Both),
        };
        let side_of =
            |analysis: &Analysis, key: ContourKey| analysis.wire_side(key, role_of(analysis, key));
        let mut pairs = std::mem::take(&mut self.pairs);
        let ends = self.dead_ends(drawing, &mut pairs, &|key| side_of(self, key));
        self.pairs = pairs;
        let notable: Vec<(ContourKey, Notability, Option<Side>)> = self
            .notable_in_order(drawing)
            .into_iter()
            .map(|(key, what)| (key, what, side_of(self, key)))
            .collect();
        let is_middle = |analysis: &Analysis, key: ContourKey| {
            let goes_along = |closed| analysis.settings.goes_along_middle(closed);
            let contour = || analysis.chains.get(key);
            (goes_along(true) || goes_along(false))
                && contour().is_some_and(|it| goes_along(it.closed))
        };
        for &(key, what, wire_side) in &notable {
            if what.has_tight_arcs && !is_middle(self, key) {
                self.report_small_radii(drawing, key, wire_side, &mut report);
            }
        }
        for &(key, what, wire_side) in &notable {
            if what.has_observations
                && !is_middle(self, key)
                && let (Some(known), Some(outlook)) =
                    (self.known.get(&key), self.outlook(drawing, key))
            {
                known.report(&outlook, wire_side, &mut report);
            }
        }
        self.report_contours(
            drawing,
            // An open contour with a side is meant so.
            notable
                .iter()
                .filter(|(_, what, side)| side.is_none() && what.as_a_whole)
                .map(|(key, ..)| *key),
            &mut report,
        );
        self.report_size(drawing, &mut report);
        let mut pairs = std::mem::take(&mut self.pairs);
        pairs.report(
            drawing,
            &|key| self.outlook(drawing, key),
            &|key| side_of(self, key),
            &mut report,
        );
        self.pairs = pairs;
        self.report_fits(drawing, &mut report);
        self.report_dead_ends(drawing, &ends, &mut report);
        self.report_set_aside(drawing, &mut report);
        if self.settings.side != SideSetting::Both || self.stated > 0 {
            let ordered = self.in_machining_order(drawing).to_vec();
            let sides: Vec<Option<Side>> = ordered.iter().map(|&key| side_of(self, key)).collect();
            self.report_lost_pockets(drawing, &ordered, &sides, &mut report);
            self.report_punches_within(drawing, &ordered, &sides, &mut report);
        }
        let mut of_job = Vec::new();
        if self.settings.start_hole.is_some() {
            let outlines = self.outlines(drawing).clone();
            of_job = toolpath::hole_faults(drawing, &outlines, &self.settings);
        }
        if toolpath::is_stated(&self.settings) && report.shows_findings() {
            let outlines = self.outlines(drawing).clone();
            of_job.extend(toolpath::stated_faults(drawing, &outlines, &self.settings));
        }
        for found in of_job {
            let own = Some(found.severity);
            if report.counts(found.rule, own) {
                report.add(found.rule, own, found.place, found.detail, found.related);
            }
        }
        report
    }

    /// What the rules on whole contours see.
    pub(super) fn report_contours(
        &self,
        drawing: &Drawing,
        keys: impl Iterator<Item = ContourKey>,
        report: &mut Report,
    ) {
        let outlook = |key| self.outlook(drawing, key);
        let concerned: Vec<Outlook> = keys
            .filter_map(outlook)
            .filter(|outlook| outlook.contour.pieces.len() > 1 || !outlook.contour.closed)
            .filter(|outlook| CONTOUR_RULES.iter().any(|rule| (rule.holds)(outlook)))
            .collect();
        if concerned.is_empty() {
            return;
        }
        let doubled = self.pairs.doubled(&outlook);
        for rule in CONTOUR_RULES {
            let mildest = (rule.mildest)(&self.settings);
            for outlook in concerned
                .iter()
                .copied()
                .filter(|outlook| (rule.holds)(outlook))
            {
                // What lies there twice is reported as that.
                if !outlook
                    .contour
                    .pieces
                    .iter()
                    .all(|piece| doubled.contains(&piece.entity))
                    && report.counts(rule.rule, mildest)
                    && let (Some((place, related)), Some(detail)) =
                        ((rule.places)(&outlook), (rule.detail)(&outlook))
                {
                    report.add(rule.rule, mildest, place, detail, related);
                }
            }
        }
    }

    /// What is suspended is not in the drawing.
    fn is_there(&self, drawing: &Drawing, key: ContourKey) -> bool {
        let first = self.chains.first_of(key);
        first.is_some_and(|first| drawing.get(first).is_some())
    }

    /// True where a contour is larger than any machine.
    fn is_vast(&self, drawing: &Drawing) -> bool {
        self.vast.iter().any(|&key| self.is_there(drawing, key))
    }

    /// Sizes that speak for another unit than the drawing's: of the largest contour.
    pub(super) fn report_size(&self, drawing: &Drawing, report: &mut Report) {
        let is_there = |key| self.is_there(drawing, key);
        let bounds_of = |key: ContourKey| {
            self.known
                .get(&key)
                .filter(|_| is_there(key))
                .map(|known| known.index.bounds())
        };
        let mut keys = self.known.keys().copied();
        let is_large = self.is_vast(drawing);
        let is_absurd = is_large
            || (self.known.keys().any(|&key| is_there(key))
                && !keys.any(|key| {
                    bounds_of(key)
                        .is_some_and(|bounds| units::is_sizable(&bounds, self.limits.unit_mm))
                }));
        if is_absurd && report.counts(Rule::Units, None) {
            let all: Box<dyn Iterator<Item = &ContourKey>> = if is_large {
                Box::new(self.vast.iter())
            } else {
                Box::new(self.known.keys())
            };
            let size = all
                .filter_map(|&key| bounds_of(key))
                .map(|bounds| units::size(&bounds))
                .fold(0.0, f64::max);
            report.add(
                Rule::Units,
                None,
                Place::Document,
                Detail::Size { size },
                Vec::new(),
            );
        }
    }

    /// Arcs below the correction in one contour.
    fn report_small_radii(
        &mut self,
        drawing: &Drawing,
        key: ContourKey,
        wire_side: Option<Side>,
        report: &mut Report,
    ) {
        let says_the_fit = self.says_the_fit(drawing, key, wire_side);
        let known = self.notable.get(&key).and_then(|it| it.faults.as_ref());
        let known = known.filter(|faults| faults.side == wire_side);
        if let Some(faults) = known
            && !says_the_fit
            && self.limits.last_correction == self.limits.correction
            && report.is_full(Rule::SmallRadius, None)
        {
            report.count(Rule::SmallRadius, None, faults.count);
            return;
        }
        let each: Arc<[(Place, SmallRadius)]> = match known.and_then(|it| it.each.clone()) {
            Some(each) => each,
            None => self.small_radii(drawing, key, wire_side),
        };
        for (place, numbers) in each.iter() {
            let is_mild = numbers.taken_by_skims || says_the_fit;
            let mildest = is_mild.then_some(Severity::Warning);
            if report.counts(Rule::SmallRadius, mildest) {
                let index = place.entity().and_then(|(entity, segment)| {
                    let (_, index) = self.chains.index_of(entity, segment?)?;
                    Some(index)
                });
                let numbers = SmallRadius {
                    no_fix: index.and_then(|index| self.answer(drawing, key, index)),
                    ..numbers.clone()
                };
                report.add(
                    Rule::SmallRadius,
                    mildest,
                    place.clone(),
                    Detail::SmallRadius(Box::new(numbers)),
                    Vec::new(),
                );
            }
        }
    }

    /// The arcs of a contour that are below the correction with the wire on a side: kept, where they are few.
    fn small_radii(
        &mut self,
        drawing: &Drawing,
        key: ContourKey,
        wire_side: Option<Side>,
    ) -> Arc<[(Place, SmallRadius)]> {
        let known = self.known.get(&key);
        let tight = known.into_iter().flat_map(|known| known.index.tight());
        let fault = |index| {
            let (segment, numbers) = self.fault(drawing, key, index, wire_side)?;
            Some((Place::from(&segment), numbers))
        };
        let each: Arc<[(Place, SmallRadius)]> = tight.filter_map(fault).collect();
        if let Some(notable) = self.notable.get_mut(&key) {
            notable.faults = Some(Faults {
                side: wire_side,
                count: each.len(),
                each: (each.len() <= MOST_KEPT).then(|| each.clone()),
            });
        }
        each
    }
}
