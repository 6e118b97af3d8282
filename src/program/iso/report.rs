//! The findings of a program, from what is known of its cuts.

mod arcs;
mod passes;
mod text;
mod told;

use super::block::Code;
use super::contours::Contour;
use super::control::Control;
use super::cut::Cut;
use super::document::Document;
use super::moves::{Place as Spot, added, apart, meet, micrometres};
use super::repair::cut_within;
use super::summary::{Spur, Summary, WireSide};
use crate::finding::{Detail, Fault, Finding, Place, Rule, Severity, Side};
use crate::geometry::cross;
use crate::program::contours::Divided;
use crate::program::path::tolerance;
use crate::program::report::{self, place_of};
use crate::settings::{CenterRule, SideSetting};
use crate::text::SourceText;
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;

/// Twice the area of anything more than a line there and back, nm².
const LEAST_TWICE_AREA: f64 = 2.0;

/// A cut of fewer moves has no ways in and out of two blocks each.
const LONGEST_LEADS: u32 = 6;

impl Document {
    /// The findings of the program, in the order of the text.
    pub fn findings(&self) -> Vec<Finding> {
        let mut findings = report::Report::all(self);
        sort(&mut findings);
        findings
    }

    /// The same without merely suspected blocks, and without a search for the slip behind them.
    pub(crate) fn plain_findings(&self) -> Vec<Finding> {
        self.report().finish()
    }

    /// The findings, without suspected blocks.
    pub(super) fn report(&self) -> Report<'_> {
        let mut report = Report::new(self);
        let mut last_words = None;
        let mut is_ended = false;
        let mut behind_end = None;
        for (index, cut) in self.cuts.iter().enumerate() {
            report.line_faults(index, cut);
            report.note(index, cut);
            is_ended = cut.ended;
            if let Some(words) = cut.last_words {
                last_words = Some(self.bytes_in(index, words));
            }
            if let Some(behind) = cut.rare().behind_end {
                behind_end.get_or_insert(self.bytes_in(index, behind));
            }
        }
        // Subprograms stand behind the end, and of some calls nobody knows which.
        if let Some(behind) = behind_end
            && !report.foreign.keys().any(|code| code.calls())
        {
            let word = report.end_before(behind.start);
            report.add(behind, Fault::TextAfterEnd { word });
        }
        let is_doubtful = |cut: usize| {
            let moves = self.cuts[cut].moves.as_ref();
            let is_one = self.contours.of_cut(cut).is_none();
            moves.is_some_and(|moves| !is_one || moves.is_doubtful != Some(false))
        };
        let doubtful = (0..self.cuts.len()).filter(|cut| is_doubtful(*cut));
        let doubtful: Vec<Contour<'_>> = doubtful.filter_map(|cut| self.contour(cut)).collect();
        for contour in &doubtful {
            report.judge(contour, &doubtful);
            report.crossings(contour);
        }
        if self.order().is_none() {
            report.passes_between_stops();
        }
        report.taper();
        report.definitions();
        report.bare_numbers();
        report.odd_places();
        report.unit();
        report.foreign_words();
        report.block_numbers();
        report.calls();
        if let (false, Some(words)) = (is_ended, last_words)
            && report.steps > 0
            && report.is_whole()
        {
            let word = self.control.limits.end.clone();
            report.add(words, Fault::MissingEnd { word });
        }
        if self.evidence().leaves_centers_open()
            && let Some(range) = report.first_center()
        {
            let reading = self.reading();
            let rules = [reading.absolute, reading.incremental];
            let taken = match self.evidence().has_absolute_arcs() {
                true => rules[0],
                false => rules[1],
            };
            let sentence = match taken {
                CenterRule::StartToCenter => {
                    say!(the_arcs_do_not_tell_how_i_and_j_are_meant)
                }
                CenterRule::CenterToStart => say!(i_and_j_are_taken_from_the_center_to_the_start),
                CenterRule::Absolute => say!(i_and_j_are_taken_as_the_centers_coordinates),
            };
            report.add(range, Fault::said(Rule::AmbiguousCenter, sentence));
        }
        report
    }

    /// Whether there may be a finding about the moves of each cut as a whole, of those of which that is not known.
    pub(super) fn doubts(&self) -> Vec<Option<bool>> {
        let mut report = Report::new(self);
        let doubt = |cut: usize| {
            let moves = self.cuts[cut].moves.as_ref()?;
            if moves.is_doubtful.is_some() || self.contours.of_cut(cut).is_some() {
                return None;
            }
            let contour = self.contour(cut)?;
            let leads_on = contour.verdict.ends.lead_on().is_some();
            Some(
                moves.found.is_some()
                    || leads_on
                    || report.may_belong_to_others(&contour)
                    || report.says(&contour),
            )
        };
        (0..self.cuts.len()).map(doubt).collect()
    }
}

impl Document {
    /// The lines of the cut around a line.
    pub(in crate::program) fn cut_lines(&self, line: usize) -> Range<usize> {
        cut_within(self, line, usize::MAX)
    }
}

/// By place.
fn sort(findings: &mut [Finding]) {
    findings.sort_by_key(|finding| (place_of(finding), finding.rule));
}

pub(super) struct Report<'a> {
    document: &'a Document,
    text: &'a SourceText,
    control: &'a Control,
    findings: Vec<Finding>,
    foreign: FxHashMap<Code, (Range<usize>, usize)>,
    steps: u32,
}

impl<'a> Report<'a> {
    fn new(document: &'a Document) -> Report<'a> {
        Report {
            document,
            text: document.text(),
            control: &document.control,
            findings: Vec::new(),
            foreign: FxHashMap::default(),
            steps: 0,
        }
    }

    fn add(&mut self, range: Range<usize>, fault: Fault) {
        self.findings.push(Finding::of(fault, range));
    }

    fn add_as(&mut self, severity: Severity, range: Range<usize>, fault: Fault) {
        self.findings.push(Finding::of(fault, range).with(severity));
    }

    fn push(&mut self, rule: Rule, range: Range<usize>, detail: Detail) {
        self.findings.push(Finding::in_text(rule, range, detail));
    }

    fn line_faults(&mut self, index: usize, cut: &Cut) {
        let offset = self.document.cuts.byte(index);
        for found in &cut.rare().faults {
            let Some(range) = found.place.in_text() else {
                continue;
            };
            let mut range = range.start + offset..range.end + offset;
            if matches!(found.rule, Rule::MissingOffset | Rule::SideChange) {
                range = self.switch_range(range.start);
            }
            self.findings.push(Finding {
                place: Place::Text { range },
                ..found.clone()
            });
        }
    }

    /// Adds up the evidence for the program as a whole.
    fn note(&mut self, index: usize, cut: &Cut) {
        self.steps = self.steps.saturating_add(cut.steps);
        for word in &cut.rare().foreign {
            let place = || (self.document.bytes_in(index, word.range), 0);
            let known = self.foreign.entry(word.code).or_insert_with(place);
            known.1 += word.count as usize;
        }
    }

    /// False where a part of the program was not run because of the limit.
    fn is_whole(&self) -> bool {
        self.document
            .order()
            .is_none_or(|order| order.left_out.is_none())
    }

    /// Whether a cut may be a part of a contour with others.
    fn may_belong_to_others(&self, contour: &Contour<'_>) -> bool {
        // Passes to and fro close by themselves, and may belong to the next or to the one before.
        let closes = contour.verdict.closes();
        let may_be_tab = contour.verdict.closing.closed && !contour.verdict.goes_round;
        // So may cuts that end open.
        let is_open = contour.sum.whole && !closes;
        may_be_tab || is_open || self.may_lack_its_tab(contour)
    }

    /// Whether a cut by itself has a finding.
    fn says(&mut self, contour: &Contour<'_>) -> bool {
        let known = self.findings.len();
        self.judge(contour, &[]);
        let says = self.findings.len() > known;
        self.findings.truncate(known);
        says
    }

    /// Whether a cut beside which the wire runs leads back to the thread hole from elsewhere than where it came.
    fn may_lack_its_tab(&self, contour: &Contour<'_>) -> bool {
        let (sum, tolerance) = (&contour.sum, contour.tolerance());
        let meet = |one: Spot, other: Spot| meet(one, other, tolerance);
        let [[first, second], [before, last]] = [sum.first, sum.last];
        let mut closes = meet(first.to, last.from) || meet(first.to, last.to);
        if sum.moves >= LONGEST_LEADS {
            let longer = [
                (second.to, before.from),
                (first.to, before.from),
                (second.to, last.from),
            ];
            closes |= longer.into_iter().any(|(one, other)| meet(one, other));
        }
        matches!(sum.side, WireSide::One(_)) && !closes
    }

    /// Where a contour crosses itself, and what an offset loses of it.
    fn crossings(&mut self, contour: &Contour<'_>) {
        let document = self.document;
        let of_whole = document.contours.of_cut(contour.cuts.start);
        let of_cut = document.cuts[contour.cuts.start].moves.as_ref();
        let found = match of_whole {
            Some(whole) => Some(whole.found()),
            None => of_cut.and_then(|moves| moves.found.as_deref()),
        };
        let Some(found) = found.filter(|found| !found.is_clean()) else {
            return;
        };
        let heard = contour.cuts.clone().flat_map(|cut| document.moves_of(cut));
        let ranges: Vec<Range<usize>> = heard.map(|(_, range)| range).collect();
        let way = document.way_of(&contour.cuts);
        self.findings
            .extend(found.findings(&way, &ranges, self.text));
    }

    /// Checks a contour as a whole: does it close, does the wire run on the right side. `all` are
    /// those with which it may belong together.
    fn judge(&mut self, cut: &Contour<'_>, all: &[Contour<'_>]) {
        let sum = &cut.sum;
        let [first_line, last_line] = sum.ends();
        self.spurs(cut);
        if sum.open && !self.is_whole() {
            // A cut that was not read completely tells nothing about the whole.
            return;
        }
        let closes = cut.verdict.closes();
        let is_fragment = cut.verdict.ends.is_fragment();
        if !closes && sum.whole && !cut.ends_open {
            let last = last_line.clone();
            let finding = cut.verdict.ends.not_closed_at(last, is_fragment);
            self.findings.push(finding);
        }
        let (_, next) = self.document.stops_behind(cut.cuts.end - 1);
        if closes
            && next < self.document.cuts.len()
            && let Some(length) = cut.verdict.ends.lead_on()
        {
            self.add(last_line, Fault::LeadsOn { length });
        }
        self.off_too_early(cut);
        let has_passes = self.passes(cut);
        // Contours that are only a line there and back have no inside.
        let area = cut.verdict.twice_area;
        let orientation = if closes && area.abs() > LEAST_TWICE_AREA {
            area
        } else {
            0.0
        };
        let side = match sum.side {
            WireSide::One(side) if !is_fragment && orientation != 0.0 && !has_passes => Some(side),
            _ => None,
        };
        if let Some(side) = side {
            let is_inside = |area: f64| (side == Side::Left) == (area > 0.0);
            let is_wrong = |inside: bool| match self.control.limits.settings.side {
                SideSetting::Opening => !inside,
                SideSetting::Punch => inside,
                _ => false,
            };
            let range = || self.switch_range(first_line.start);
            let mut inside = is_inside(orientation);
            if is_wrong(inside) {
                inside = self.area_with_tab(cut, all).map_or(inside, is_inside);
            }
            if is_wrong(inside) {
                self.add(
                    range(),
                    Fault::RoleSide {
                        side,
                        punch: !inside,
                    },
                );
            } else if self.side_of_entry(cut).is_some_and(|entry| entry != side) {
                self.add(range(), Fault::EntrySide { side });
            }
        }
    }

    /// A way out and in again between two passes is no spur: its tip is the start of the cut.
    fn spurs(&mut self, contour: &Contour<'_>) {
        let (document, begin) = (self.document, contour.sum.start());
        let tolerance = contour.tolerance();
        for cut in contour.cuts.clone() {
            let at = document.cuts.state_before(cut).at;
            let moves = document.cuts[cut].moves.as_ref();
            let all = moves.into_iter().flat_map(|moves| &moves.spurs);
            for Spur { tip, length, range } in all {
                if !meet(begin, added(*tip, at), tolerance) {
                    let range = document.bytes_in(cut, *range);
                    self.add(range, Fault::Spur { length: *length });
                }
            }
        }
    }

    /// Twice the area of the contour of which a cut is the tab, or all but the tab, where both are cut from and to the
    /// thread hole.
    fn area_with_tab(&self, cut: &Contour<'_>, all: &[Contour<'_>]) -> Option<f64> {
        let begins = |sum: &Summary| sum.first.map(|step| step.to);
        let ends = |sum: &Summary| sum.last.map(|step| step.from);
        let tolerance = cut.tolerance();
        let meet = |one: Spot, other: Spot| meet(one, other, tolerance);
        let common = |some: [Spot; 2], others: [Spot; 2]| {
            let is_met = move |spot: &Spot| others.iter().any(|other| meet(*spot, *other));
            some.into_iter().filter(is_met)
        };
        let own = &cut.sum;
        let area = |other: &Contour<'_>| {
            let (area, other) = (
                cut.verdict.twice_area + other.verdict.twice_area,
                &other.sum,
            );
            let from = common(begins(own), ends(other));
            let mut tabs =
                from.flat_map(|from| common(ends(own), begins(other)).map(move |to| (from, to)));
            let are_one = other.start() == own.start()
                && other.side == own.side
                && area.abs() > LEAST_TWICE_AREA
                && tabs.any(|(from, to)| !meet(from, to));
            are_one.then_some(area)
        };
        all.iter().find_map(area)
    }

    /// The side of the contour from which the way in comes, by the contour's directions at its start and end; `None`
    /// where they disagree, or the cut has no way in with the correction on.
    fn side_of_entry(&self, cut: &Contour<'_>) -> Option<Side> {
        let (sum, arcs) = (&cut.sum, cut.verdict.ends.arcs);
        let lead = &sum.first[0];
        if lead.switches != Some(true) || lead.is_arc() {
            return None;
        }
        let near = |spot: Spot| meet(spot, lead.to, tolerance(arcs));
        let last = sum.last.iter().rev().find(|step| near(step.to))?;
        let ahead = sum.first[1]
            .at_origin()
            .segment(&self.control.reading)
            .start_tangent();
        let behind = last
            .at_origin()
            .segment(&self.control.reading)
            .end_tangent();
        let way = micrometres(apart(lead.from, lead.to)).coords;
        // A way in along the contour tells nothing.
        let clear = way.norm() * 0.02;
        let sides = [cross(ahead, way), cross(behind, way)];
        if sides.iter().all(|&side| side > clear) {
            Some(Side::Left)
        } else if sides.iter().all(|&side| side < -clear) {
            Some(Side::Right)
        } else {
            None
        }
    }

    /// Sorted by place; a line that a subprogram runs several times is reported once.
    pub(super) fn finish(mut self) -> Vec<Finding> {
        sort(&mut self.findings);
        if self.document.order().is_some() {
            let mut said = FxHashSet::default();
            self.findings
                .retain(|finding| said.insert((place_of(finding), finding.rule)));
        }
        self.findings
    }
}
