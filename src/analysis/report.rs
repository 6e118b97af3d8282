//! Findings as they are gathered: counted all, kept up to a limit, the worst first.

use crate::finding::{Detail, Finding, Place, Rule, Severity};
use crate::settings::{Compensation, Effective};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Gathers findings. The first of each severity are kept.
#[derive(Debug)]
pub(crate) struct Report {
    pub(super) settings: Arc<Effective>,
    limit: usize,
    kept: BTreeMap<Severity, Vec<Finding>>,
    count: usize,
    tally: Tally,
    unit_is_in_doubt: bool,
    names_each: bool,
}

/// The numbers of findings, by severity and by rule.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Tally {
    pub(crate) errors: usize,
    pub(crate) warnings: usize,
    pub(crate) of_rule: BTreeMap<Rule, usize>,
    /// Runs of segments that have not been compared with everything near them.
    pub(crate) unseen: usize,
}

/// Rules that may find more when a contour becomes cleaner: corners that were hidden by a short segment or a gap.
const CORNERS: [Rule; 3] = [Rule::SharpCorner, Rule::NearTangent, Rule::ArcAsChords];

/// Rules that are silent beside a tight arc.
const SLOTS: [Rule; 2] = [Rule::NarrowSlot, Rule::OffsetCollapse];

/// What a line that closes a contour may run into.
const LINES_IN_THE_WAY: [Rule; 5] = [
    Rule::DuplicateEntity,
    Rule::Overlap,
    Rule::SelfIntersection,
    Rule::ShortSegment,
    Rule::OpenContour,
];

impl Tally {
    pub(crate) fn of(&self, rule: Rule) -> usize {
        self.of_rule.get(&rule).copied().unwrap_or(0)
    }

    /// True when nothing got worse since `before`: no more errors, no more errors and warnings together, and no rule
    /// that speaks of damage, except `mended`, has more findings.
    pub(crate) fn is_no_worse_than(&self, before: &Tally, mended: Rule) -> bool {
        self.errors <= before.errors
            && self.errors + self.warnings <= before.errors + before.warnings
            && self.brings_nothing_new(before, |rule| rule == mended || CORNERS.contains(&rule))
    }

    /// True when there are no more errors, and nothing new except kinks, slots, which may have been beside a tight arc
    /// all the time, and findings of a `spared` rule.
    pub(crate) fn spoils_nothing(&self, before: &Tally, spared: Option<Rule>) -> bool {
        let is_spared =
            |rule| CORNERS.contains(&rule) || SLOTS.contains(&rule) || spared == Some(rule);
        self.errors <= before.errors && self.brings_nothing_new(before, is_spared)
    }

    /// Where new pairs have been compared, more findings do not mean more faults.
    fn brings_nothing_new(&self, before: &Tally, is_spared: impl Fn(Rule) -> bool) -> bool {
        // Where a contour has become closed, ends that do not quite meet are what is left of the opening.
        let is_closed = self.of(Rule::OpenContour) < before.of(Rule::OpenContour);
        let is_spared = |rule| is_spared(rule) || (rule == Rule::Gap && is_closed);
        self.unseen < before.unseen
            || self
                .of_rule
                .iter()
                .all(|(&rule, &count)| is_spared(rule) || count <= before.of(rule))
    }

    /// True when closing a contour has added nothing except corners. The wire now has a side on it: what was one hint
    /// for all its corners is a warning for each one inside which the wire runs, and what was a warning may be an
    /// error.
    pub(crate) fn is_no_worse_once_closed(&self, before: &Tally) -> bool {
        let corners = self
            .of(Rule::SharpCorner)
            .saturating_sub(before.of(Rule::SharpCorner));
        self.errors + self.warnings <= before.errors + before.warnings + corners
            && self.brings_nothing_new(before, |rule| !LINES_IN_THE_WAY.contains(&rule))
    }
}

impl Report {
    pub(crate) fn new(settings: Arc<Effective>, limit: usize) -> Report {
        Report {
            settings,
            limit,
            kept: BTreeMap::new(),
            count: 0,
            tally: Tally::default(),
            unit_is_in_doubt: false,
            names_each: false,
        }
    }

    /// Has every finding named by itself: no other one of its contour stands for it.
    pub(crate) fn name_each(&mut self) {
        self.names_each = true;
    }

    pub(crate) fn names_each(&self) -> bool {
        self.names_each
    }

    /// Counts findings that another one stands for, or that are named by themselves, too.
    pub(crate) fn stand_for(&mut self, rule: Rule, mildest: Option<Severity>, count: usize) {
        match self.names_each {
            true => self.count(rule, mildest, count),
            false => self.weigh(rule, mildest, count),
        }
    }

    /// False where findings are only counted.
    pub(crate) fn shows_findings(&self) -> bool {
        self.limit > 0
    }

    /// True where the settings say that contours are the path of the wire itself.
    pub(crate) fn is_for_a_path(&self) -> bool {
        self.settings.compensation == Compensation::None
    }

    /// Records that the size of the drawing contradicts its unit: what is measured in it is in doubt, and only a hint
    /// until the unit is settled. Errors stay.
    pub(crate) fn doubt_unit(&mut self) {
        self.unit_is_in_doubt = true;
    }

    /// True where an open contour is reported as an error: what only spoils a cut along it can wait until it is closed.
    pub(crate) fn open_is_an_error(&self) -> bool {
        !self.is_for_a_path()
            && !self.settings.mills
            && self.severity(Rule::OpenContour, None) == Some(Severity::Error)
    }

    /// The severity of a rule, `mildest` where the case is milder than the rule and nobody has set it; `None` where it is off.
    fn severity(&self, rule: Rule, mildest: Option<Severity>) -> Option<Severity> {
        let set = self.settings.severity(rule)?;
        let own = mildest.map_or(set, |mildest| set.max(mildest));
        let doubtful = self.unit_is_in_doubt && own == Severity::Warning && rule != Rule::Units;
        self.settings
            .severity_over(rule, if doubtful { Severity::Hint } else { own })
    }

    /// Counts a finding. True when the finding should be worked out and added.
    pub(crate) fn counts(&mut self, rule: Rule, mildest: Option<Severity>) -> bool {
        self.count(rule, mildest, 1);
        !self.is_full(rule, mildest)
    }

    /// Counts this many findings, which are not added.
    pub(crate) fn count(&mut self, rule: Rule, mildest: Option<Severity>, count: usize) {
        let Some(severity) = self.severity(rule, mildest).filter(|_| count > 0) else {
            return;
        };
        self.count += count;
        self.enter(rule, severity, count);
    }

    /// Counts findings that another one stands for: they count when drawings are compared, and are not reported.
    pub(crate) fn weigh(&mut self, rule: Rule, mildest: Option<Severity>, count: usize) {
        if let Some(severity) = self.severity(rule, mildest) {
            self.enter(rule, severity, count);
        }
    }

    fn enter(&mut self, rule: Rule, severity: Severity, count: usize) {
        match severity {
            Severity::Error => self.tally.errors += count,
            Severity::Warning => self.tally.warnings += count,
            Severity::Information | Severity::Hint => {}
        }
        *self.tally.of_rule.entry(rule).or_default() += count;
    }

    /// True when no finding of this severity is added any more, or the rule is off.
    pub(crate) fn is_full(&self, rule: Rule, mildest: Option<Severity>) -> bool {
        self.room(rule, mildest) == 0
    }

    /// The number of findings of this severity that may still be added.
    pub(crate) fn room(&self, rule: Rule, mildest: Option<Severity>) -> usize {
        let kept = |severity| self.kept.get(&severity).map_or(0, Vec::len);
        let severity = self.severity(rule, mildest);
        severity.map_or(0, |severity| self.limit.saturating_sub(kept(severity)))
    }

    /// Adds a finding that has been counted.
    pub(crate) fn add(
        &mut self,
        rule: Rule,
        mildest: Option<Severity>,
        place: Place,
        detail: Detail,
        related: Vec<Place>,
    ) {
        if let Some(severity) = self.severity(rule, mildest) {
            self.kept.entry(severity).or_default().push(Finding {
                rule,
                severity,
                place,
                detail,
                related,
            });
        }
    }

    pub(crate) fn tally(self) -> Tally {
        self.tally
    }

    /// The findings, the worst first, and their number in all.
    pub(crate) fn finish(self) -> (Vec<Finding>, usize) {
        let mut findings: Vec<Finding> = self.kept.into_values().flatten().collect();
        findings.truncate(self.limit);
        (findings, self.count)
    }
}
