//! All findings of a drawing, put together from the observations for each report.

use super::common_line::CommonLines;
use super::notable::{Counted, Kind, Notability, Sums, TightArc};
use super::report::{Report, Tally};
use super::{Analysis, electrode, together};
use crate::drawing::{ContourKey, Drawing, EntityId, Role};
use crate::finding::{Detail, Finding, NoFix, Place, Rule, Severity, Side, SmallRadius};
use crate::rules::{CONTOUR_RULES, ContourRule, Outlook, units};
use crate::settings::SideSetting;
use crate::toolpath;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// The most segments that are looked at to find which repairs of arcs below the correction would
/// cause another fault.
const MOST_TRIED: usize = 40_000;

/// The same for looks at pairs of them: where many arcs crowd, each attempt compares all with each other.
const MOST_LOOKS: u64 = 5_000_000;

/// Arcs below the correction of one contour that are kept.
const MOST_KEPT: usize = 16;

impl Analysis {
    /// Marks arcs whose repair would cause another fault as having no fix. Each takes a look at the
    /// drawing: where that comes to more than [`MOST_TRIED`] segments in all, and beyond
    /// [`MOST_LOOKS`], it is left until the repair is asked for.
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

    /// The number of findings of each kind.
    pub(super) fn tally(&mut self, drawing: &Drawing) -> Tally {
        Tally {
            unseen: self.pairs.uncompared(),
            ..self.report(drawing, 0).tally()
        }
    }

    pub(super) fn report(&mut self, drawing: &Drawing, limit: usize) -> Report {
        self.gathered(drawing, Report::new(self.settings.clone(), limit))
    }

    /// Every finding by itself, where one may stand for several.
    pub(super) fn each_finding(&mut self, drawing: &Drawing) -> Vec<Finding> {
        let mut report = Report::new(self.settings.clone(), usize::MAX);
        report.name_each();
        self.gathered(drawing, report).finish().0
    }

    fn gathered(&mut self, drawing: &Drawing, mut report: Report) -> Report {
        if self.is_vast(drawing) {
            report.doubt_unit();
        }
        // With nesting, the role of each depends on all.
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
        let common_lines = self.common_lines(drawing);
        self.report_notable(drawing, &side_of, &common_lines, &mut report);
        self.report_size(drawing, &mut report);
        self.pairs.report(
            drawing,
            &|key| self.outlook(drawing, key),
            &|key| side_of(self, key),
            &common_lines,
            &mut report,
        );
        self.report_fits(drawing, &mut report);
        self.report_dead_ends(drawing, &side_of, &mut report);
        self.report_set_aside(drawing, &mut report);
        if self.settings.side != SideSetting::Both || self.stated > 0 {
            let ordered = self.in_machining_order(drawing).to_vec();
            let sides: Vec<Option<Side>> = ordered.iter().map(|&key| side_of(self, key)).collect();
            self.report_lost_pockets(drawing, &ordered, &sides, &mut report);
            self.report_roles_said_twice(drawing, &ordered, &mut report);
            self.report_punches_within(drawing, &ordered, &sides, &mut report);
            self.report_doubtful_nesting(drawing, &ordered, &mut report);
        }
        self.report_roles_of_no_layer(drawing, &mut report);
        let mut of_job = Vec::new();
        if self.settings.start_hole.is_some() {
            let outlines = self.outlines(drawing).clone();
            of_job = toolpath::hole_faults(drawing, &outlines, &self.settings);
        }
        if toolpath::is_stated(&self.settings) && report.shows_findings() {
            let outlines = self.outlines(drawing).clone();
            of_job.extend(toolpath::stated_faults(drawing, &outlines, &self.settings));
        }
        if report.shows_findings() {
            of_job.extend(electrode::faults(drawing, self.segments, &self.settings));
        }
        of_job.extend(common_lines.findings.iter().cloned());
        let is_stated = self.stated > 0 && self.known.values().any(|known| known.is_on_line());
        let has_lines = is_stated || !common_lines.is_empty();
        let is_small = self.segments <= toolpath::MOST_SEGMENTS_OF_MISFITS;
        if has_lines && is_small && report.shows_findings() {
            let outlines = self.outlines(drawing).clone();
            of_job.extend(toolpath::line_faults(drawing, &outlines, &self.settings));
        }
        if self.segments <= toolpath::MOST_SEGMENTS_SAID_TWICE && report.shows_findings() {
            let outlines = self.outlines(drawing).clone();
            of_job.extend(toolpath::said_twice(drawing, &outlines, &self.settings));
        }
        for found in of_job {
            let own = Some(found.severity);
            if report.counts(found.rule, own) {
                report.add(found.rule, own, found.place, found.detail, found.related);
            }
        }
        report
    }

    /// The contours' own findings.
    fn report_notable(
        &mut self,
        drawing: &Drawing,
        side_of: &dyn Fn(&Analysis, ContourKey) -> Option<Side>,
        common_lines: &CommonLines,
        report: &mut Report,
    ) {
        let mut notable = std::mem::take(&mut self.notable);
        let open_is_an_error = report.open_is_an_error();
        // What is suspended is not in the drawing.
        let suspended = self.suspended.and_then(|it| self.chains.contour_of(it));
        let mut sums = Sums::default();
        let mut told: Vec<(ContourKey, EntityId, &Counted)> = Vec::new();
        for (&key, notable) in &mut notable {
            if Some(key) == suspended || common_lines.divides(notable.first) {
                continue;
            }
            let side = side_of(self, key);
            if notable.counted.as_ref().is_none_or(|it| it.side != side) {
                let counted = self.count(drawing, key, (notable.what, side), open_is_an_error);
                notable.counted = Some(counted);
            }
            if let Some(counted) = &notable.counted {
                sums.add(counted);
                told.push((key, notable.first, counted));
            }
        }
        if report.shows_findings() {
            told.sort_by_cached_key(|&(key, first, _)| (drawing.rank(first), key));
        }
        let told = told.iter().map(|&(key, _, counted)| (key, counted));
        let of_arcs = told.clone().map(|(key, it)| (key, it, &it.counts.arcs[..]));
        tell(&sums.arcs, of_arcs, report, |key, counted, report| {
            self.report_small_radii(drawing, key, counted, report)
        });
        let of_rules = told
            .clone()
            .map(|(key, it)| (key, it, &it.counts.local[..]));
        for (&(rule, mildest), &count) in &sums.stood_for {
            report.stand_for(rule, mildest, count);
        }
        tell(&sums.local, of_rules, report, |key, counted, report| {
            if let Some((known, outlook)) = self.known.get(&key).zip(self.outlook(drawing, key)) {
                known.report(&outlook, counted.side, report);
            }
        });
        let whole = told.filter(|(_, counted)| !counted.counts.whole.is_empty());
        self.report_contours(drawing, whole.map(|(key, _)| key), &sums.whole, report);
        self.notable = notable;
    }

    /// The number of a contour's own findings with the wire on a side.
    fn count(
        &self,
        drawing: &Drawing,
        key: ContourKey,
        (what, side): (Notability, Option<Side>),
        open_is_an_error: bool,
    ) -> Counted {
        let mut counted = Counted {
            side,
            ..Counted::default()
        };
        let Some(outlook) = self.outlook(drawing, key) else {
            return counted;
        };
        let is_middle = outlook.is_middle();
        if what.has_tight_arcs && !is_middle && !outlook.on_line {
            let arcs = self.small_radii(drawing, key, side);
            let says_the_fit = self.says_the_fit(drawing, key, side);
            counted.says_the_fit = says_the_fit;
            let is_mild = |arc: &&TightArc| is_mild(&arc.numbers, says_the_fit);
            let mild = arcs.iter().filter(is_mild).count();
            let counts = [(arcs.len() - mild, false), (mild, true)].into_iter();
            counted.counts.arcs = counts
                .filter(|(count, _)| *count > 0)
                .map(|(count, is_mild)| ((Rule::SmallRadius, mildest(is_mild)), count))
                .collect();
            counted.arcs = (arcs.len() <= MOST_KEPT).then_some(arcs);
        }
        if what.has_observations
            && !is_middle
            && let Some(known) = self.known.get(&key)
        {
            [counted.counts.local, counted.counts.stood_for] =
                known.counts(&outlook, side, open_is_an_error);
        }
        // An open contour with a side, or cut on the line, is meant to be open.
        if what.as_a_whole && side.is_none() && !outlook.on_line {
            counted.counts.whole = CONTOUR_RULES
                .iter()
                .filter(|rule| holds(rule, &outlook))
                .map(|rule| ((rule.rule, (rule.mildest)(&self.settings)), 1))
                .collect();
        }
        counted
    }

    /// Adds the findings of the rules on whole contours for some contours, which have this many in
    /// all.
    fn report_contours(
        &self,
        drawing: &Drawing,
        keys: impl Iterator<Item = ContourKey> + Clone,
        sums: &BTreeMap<Kind, usize>,
        report: &mut Report,
    ) {
        if sums.is_empty() {
            return;
        }
        let outlook = |key| self.outlook(drawing, key);
        let doubled = self.pairs.doubled(&outlook);
        for rule in CONTOUR_RULES {
            let mildest = (rule.mildest)(&self.settings);
            let in_all = sums.get(&(rule.rule, mildest)).copied().unwrap_or(0);
            if in_all >= rule.many && doubled.is_empty() && !report.names_each() {
                let met = keys.clone().filter_map(outlook);
                let met: Vec<Outlook> = met.filter(|outlook| holds(rule, outlook)).collect();
                report.count(rule.rule, mildest, 1);
                report.weigh(rule.rule, mildest, in_all.saturating_sub(1));
                if !report.is_full(rule.rule, mildest)
                    && let Some((place, detail, related)) = together::of_contours(rule, &met)
                {
                    report.add(rule.rule, mildest, place, detail, related);
                }
                continue;
            }
            // A contour that is drawn twice is reported as a duplicate.
            let is_doubled = |outlook: &Outlook| {
                let mut pieces = outlook.contour.pieces.iter();
                pieces.all(|piece| doubled.contains(&piece.entity))
            };
            if doubled.is_empty() {
                let count = sums.get(&(rule.rule, mildest)).copied();
                report.count(rule.rule, mildest, count.unwrap_or(0));
            }
            for outlook in keys.clone().filter_map(outlook) {
                if doubled.is_empty() && report.is_full(rule.rule, mildest) {
                    break;
                }
                if !holds(rule, &outlook) || is_doubled(&outlook) {
                    continue;
                }
                if !doubled.is_empty() {
                    report.count(rule.rule, mildest, 1);
                }
                if !report.is_full(rule.rule, mildest)
                    && let (Some((place, related)), Some(detail)) =
                        ((rule.places)(&outlook), (rule.detail)(&outlook))
                {
                    report.add(rule.rule, mildest, place, detail, related);
                }
            }
        }
    }

    /// True unless the contour is that of a suspended entity, which is not in the drawing.
    pub(super) fn is_there(&self, drawing: &Drawing, key: ContourKey) -> bool {
        let first = self.chains.first_of(key);
        first.is_some_and(|first| drawing.get(first).is_some())
    }

    /// True where a contour is larger than any machine.
    fn is_vast(&self, drawing: &Drawing) -> bool {
        self.vast.iter().any(|&key| self.is_there(drawing, key))
    }

    /// The size of the largest contour, where it suggests another unit than the drawing's.
    fn report_size(&self, drawing: &Drawing, report: &mut Report) {
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

    /// Arcs below the correction in one contour, which have been counted.
    fn report_small_radii(
        &mut self,
        drawing: &Drawing,
        key: ContourKey,
        counted: &Counted,
        report: &mut Report,
    ) {
        let known = counted.arcs.clone();
        let each = known.unwrap_or_else(|| self.small_radii(drawing, key, counted.side));
        for arc in each.iter() {
            let mildest = mildest(is_mild(&arc.numbers, counted.says_the_fit));
            if report.is_full(Rule::SmallRadius, mildest) {
                continue;
            }
            let numbers = SmallRadius {
                no_fix: self.answer(drawing, key, arc.index),
                ..arc.numbers.clone()
            };
            report.add(
                Rule::SmallRadius,
                mildest,
                arc.place.clone(),
                Detail::SmallRadius(Box::new(numbers)),
                Vec::new(),
            );
        }
    }
}

/// True for an arc below the correction that may be reported.
fn is_mild(numbers: &SmallRadius, says_the_fit: bool) -> bool {
    numbers.taken_by_skims || says_the_fit
}

fn mildest(is_mild: bool) -> Option<Severity> {
    is_mild.then_some(Severity::Warning)
}

fn holds(rule: &ContourRule, outlook: &Outlook) -> bool {
    (outlook.contour.pieces.len() > 1 || !outlook.contour.closed) && (rule.holds)(outlook)
}

/// Counts all findings of some contours, and adds those of each until no more are shown.
fn tell<'a>(
    sums: &BTreeMap<Kind, usize>,
    contours: impl Iterator<Item = (ContourKey, &'a Counted, &'a [(Kind, usize)])>,
    report: &mut Report,
    mut tell: impl FnMut(ContourKey, &Counted, &mut Report),
) {
    for (&(rule, mildest), &count) in sums {
        report.count(rule, mildest, count);
    }
    let mut left = sums.clone();
    for (key, counted, counts) in contours.filter(|(.., counts)| !counts.is_empty()) {
        left.retain(|&(rule, mildest), _| !report.is_full(rule, mildest));
        if left.is_empty() {
            return;
        }
        for (kind, count) in counts {
            if let Some(left) = left.get_mut(kind) {
                *left -= count;
            }
        }
        left.retain(|_, count| *count > 0);
        tell(key, counted, report);
    }
}
