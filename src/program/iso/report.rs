//! The findings of a program, from those of its stretches.

mod arcs;
mod passes;
mod text;
mod told;

use super::block::Code;
use super::cut::JoinedCut;
use super::document::{Document, Table};
use super::limits::Limits;
use super::moves::{Place as Spot, Reading, apart, meet, micrometres};
use super::part::{Part, Spur, WireSide};
use super::repair::found::Repair;
use super::repair::{Troubles, cut_within};
use super::stretch::Stretch;
use crate::finding::{Detail, Fault, Finding, Place, Rule, Severity, Side};
use crate::geometry::cross;
use crate::program::by_chunk::ByChunk;
use crate::program::followed::Followed;
use crate::program::path::{HasCuts, tolerance};
use crate::program::repair::gate::Tried;
use crate::program::report::{self, place_of};
use crate::settings::{CenterRule, SideSetting};
use crate::text::SourceText;
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;

/// Twice the area of anything more than a line there and back, nm².
const LEAST_TWICE_AREA: u128 = 2_000_000;

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
        let mut report = self.report();
        let told = self.told.iter();
        let told = told.map(|told| told.finding(|chunk| self.byte_of(chunk), self.text()));
        report.findings.extend(told);
        report.finish()
    }

    /// The findings beside those that are kept.
    pub(super) fn report(&self) -> Report<'_> {
        let mut report = Report::new(self);
        let mut last_words = None;
        let mut is_ended = false;
        let mut behind_end = None;
        for placed in self.placed() {
            let (stretch, offset) = (placed.stretch, placed.offset);
            report.line_faults(stretch, offset);
            report.note(stretch, offset);
            is_ended = stretch.after.ended;
            if let Some(words) = stretch.last_words {
                last_words = Some(at(offset, words));
            }
            if let Some(behind) = stretch.behind_end {
                behind_end.get_or_insert(at(offset, behind));
            }
        }
        // Subprograms stand behind the end, and of some calls nobody knows which.
        if let Some(behind) = behind_end
            && !report.foreign.keys().any(|code| code.calls())
        {
            let word = report.end_before(behind.start);
            report.add(behind, Fault::TextAfterEnd { word });
        }
        for cut in self.doubtful.untold() {
            report.judge(cut, Some(&self.doubtful));
        }
        if self.order().is_none() {
            report.passes_between_stops();
        }
        // With subprograms nothing is kept.
        if self.order().is_some() {
            for (cut, found) in self.contours.crossing() {
                report
                    .findings
                    .extend(self.crosses_itself(cut, found, self.text()));
            }
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
            && report.moves > 0
            && report.is_whole()
        {
            let word = self.limits.end.clone();
            report.add(words, Fault::MissingEnd { word });
        }
        if self.evidence().leaves_centers_open()
            && let Some(range) = report.first_center()
        {
            let reading = self.reading();
            let rules = [reading.absolute, reading.incremental];
            let taken = match self.evidence().absolute.all {
                0 => rules[1],
                _ => rules[0],
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

    /// Those of some stretches whose own cuts are sound: cuts that begin and end there have no
    /// fault as a whole.
    pub(super) fn clean(&self, stretches: Range<usize>) -> Vec<usize> {
        let mut report = Report::new(self);
        let crossing = self.contours.crossing();
        let places = crossing.flat_map(|(cut, _)| &cut.parts);
        let touched: FxHashSet<usize> = places.map(|(stretch, _)| *stretch).collect();
        let mut is_clean = |index: &usize| {
            let of = &self.stretches[*index];
            let mut inner = of.inner();
            let is_sound = |part: usize| {
                let cut = JoinedCut::of(of, *index, part);
                // A pass is compared with the next one, behind a stop.
                cut.is_none_or(|cut| cut.sum.switched_on != 1 && report.is_sound(&cut))
            };
            !of.is_clean && (inner.is_empty() || !touched.contains(index) && inner.all(is_sound))
        };
        stretches.filter(|index| is_clean(index)).collect()
    }

    /// A test for cuts with possible findings, and for those that may belong together with one of them.
    pub(super) fn doubts(&self) -> impl FnMut(&JoinedCut) -> bool + '_ {
        let mut report = Report::new(self);
        move |cut| {
            let is_beside = matches!(cut.sum.side, WireSide::One(_));
            (is_beside && report.may_belong_to_others(cut)) || report.says(cut)
        }
    }
}

/// The blocks that may explain the findings by one slip, unless they have a finding already.
fn suspects(document: &Document, troubles: &mut Troubles<'_>) -> Vec<Finding> {
    let found = document.repairs_of(troubles);
    let mut is_said = |line: usize| !troubles.within(&(line..line + 1)).is_empty();
    let first = |(_, repairs): &(Range<usize>, Vec<Repair>)| repairs.first().cloned();
    let repairs = found.of_cuts.iter().filter_map(first);
    let suspect = |repair: Repair| {
        let range = document.words_of(repair.line);
        let fault = Fault::Suspect {
            found: repair.found,
            meant: repair.meant,
            closes: repair.closes,
        };
        let severity = match repair.is_sure {
            true => Rule::SuspectBlock.default_severity(),
            false => Severity::Information,
        };
        Finding::of(fault, range).with(severity)
    };
    repairs
        .filter(|repair| repair.explains && !repair.closes_anywhere() && !is_said(repair.line))
        .map(suspect)
        .collect()
}

impl Tried for Document {
    fn edit(&mut self, range: Range<usize>, replacement: &str) {
        Document::edit(self, range, replacement);
    }

    fn cut_lines(&self, line: usize) -> Range<usize> {
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
    reading: &'a Reading,
    limits: &'a Limits,
    findings: Vec<Finding>,
    foreign: FxHashMap<Code, (Range<usize>, usize)>,
    definitions: &'a Table,
    /// µm; an arc of at least this radius suits every correction.
    largest_correction: f64,
    moves: u32,
}

fn at(offset: usize, range: (u32, u32)) -> Range<usize> {
    offset + range.0 as usize..offset + range.1 as usize
}

impl<'a> Report<'a> {
    fn new(document: &'a Document) -> Report<'a> {
        let mut report = Report {
            document,
            text: document.text(),
            reading: document.reading(),
            limits: &document.limits,
            findings: Vec::new(),
            foreign: FxHashMap::default(),
            definitions: &document.table,
            largest_correction: 0.0,
            moves: 0,
        };
        report.largest_correction = report.largest_correction();
        report
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

    fn line_faults(&mut self, stretch: &Stretch, offset: usize) {
        for found in &stretch.faults {
            let Some(range) = found.place.in_text() else {
                continue;
            };
            let mut range = range.start + offset..range.end + offset;
            if found.rule == Rule::MissingOffset {
                range = self.switch_range(range.start);
            }
            self.findings.push(Finding {
                place: Place::Text { range },
                ..found.clone()
            });
        }
    }

    /// Adds up the evidence for the program as a whole.
    fn note(&mut self, stretch: &Stretch, offset: usize) {
        self.moves = self.moves.saturating_add(stretch.moves);
        for word in &stretch.foreign {
            let known = self
                .foreign
                .entry(word.code)
                .or_insert_with(|| (at(offset, word.range), 0));
            known.1 += word.count as usize;
        }
    }

    /// False where a part of the program was not run because of the limit.
    fn is_whole(&self) -> bool {
        self.document
            .order()
            .is_none_or(|order| order.left_out.is_none())
    }

    /// Whether a cut is sound as a whole, and need not be compared with others.
    fn is_sound(&mut self, cut: &JoinedCut) -> bool {
        !self.may_belong_to_others(cut) && !self.says(cut)
    }

    /// Whether a cut may be a part of a contour with others.
    fn may_belong_to_others(&self, cut: &JoinedCut) -> bool {
        // Passes to and fro close by themselves, and may belong to the next or to the one before.
        let only = self.document.only_lay(cut);
        let may_be_tab = only.is_some_and(|lay| lay.closes && !lay.goes_round);
        // So may cuts that end open.
        let is_open = cut.sum.whole && !self.document.is_closed(cut);
        may_be_tab || is_open || self.may_lack_its_tab(&cut.sum)
    }

    /// Whether a cut by itself has a finding.
    fn says(&mut self, cut: &JoinedCut) -> bool {
        let known = self.findings.len();
        self.judge(cut, None);
        let says = self.findings.len() > known;
        self.findings.truncate(known);
        says
    }

    /// Whether a cut beside which the wire runs leads back to the thread hole from elsewhere than where it came.
    fn may_lack_its_tab(&self, sum: &Part) -> bool {
        let tolerance = self.document.tolerance(sum);
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

    /// Checks a cut as a whole: does it close, does the wire run on the right side, is an arc too tight. `all` are
    /// those with which it may belong together.
    fn judge(&mut self, cut: &JoinedCut, all: Option<&ByChunk<JoinedCut>>) {
        let sum = &*cut.sum;
        self.spurs(cut);
        if sum.open && !self.is_whole() {
            // A cut that was not read completely tells nothing about the whole.
            return;
        }
        let closes = self.document.is_closed(cut);
        let is_fragment = self.document.is_fragment(cut);
        if !closes && sum.whole && !sum.ends_open {
            let finding = self.document.not_closed(cut, is_fragment);
            self.findings.extend(finding);
        }
        let is_last = self.document.behind(cut).0 >= self.document.stretches.len();
        if closes
            && !is_last
            && let Some(length) = self.document.leads_on(cut)
        {
            let range = self.document.bytes_of(cut.last_line);
            self.add(range, Fault::LeadsOn { length });
        }
        self.off_too_early(cut);
        let has_passes = self.passes(cut);
        // Contours that are only a line there and back have no inside.
        let orientation = if closes && sum.twice_area.unsigned_abs() > LEAST_TWICE_AREA {
            sum.twice_area.signum()
        } else {
            0
        };
        let side = match sum.side {
            WireSide::One(side) if !is_fragment && orientation != 0 && !has_passes => Some(side),
            _ => None,
        };
        if let Some(side) = side {
            let is_inside = |area: i128| (side == Side::Left) == (area > 0);
            let is_wrong = |inside: bool| match self.limits.side {
                SideSetting::Opening => !inside,
                SideSetting::Punch => inside,
                _ => false,
            };
            let range = || self.switch_range(self.document.bytes_of(cut.first_line).start);
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
            } else if self.side_of_entry(sum).is_some_and(|entry| entry != side) {
                self.add(range(), Fault::EntrySide { side });
            }
        }
        if let Some((place, line)) = &cut.flip {
            // The next pass, back along the same contour, has the wire on its other side.
            let begins = [sum.first[0].from, sum.first[0].to];
            if !begins
                .iter()
                .any(|begin| meet(*begin, *place, self.document.tolerance(&cut.sum)))
            {
                self.side_change(self.document.bytes_of(*line));
            }
        }
        self.tight_arcs(cut, orientation);
    }

    /// A way out and in again between two passes is no spur: its tip is the start of the cut.
    fn spurs(&mut self, cut: &JoinedCut) {
        let (document, begin) = (self.document, cut.sum.start());
        let tolerance = document.tolerance(&cut.sum);
        for &(stretch, part) in &cut.parts {
            let own = document.stretches.get(stretch);
            let all = own.into_iter().flat_map(|own| own.spurs_of(part));
            for spur in all.filter(|spur| !meet(begin, spur.tip, tolerance)) {
                let Spur { length, range, .. } = spur;
                let range = document.bytes_of((stretch, range));
                self.add(range, Fault::Spur { length });
            }
        }
    }

    /// Twice the area of the contour of which a cut is the tab, or all but the tab, where both are cut from and to the
    /// thread hole.
    fn area_with_tab(&self, cut: &JoinedCut, all: Option<&ByChunk<JoinedCut>>) -> Option<i128> {
        let begins = |sum: &Part| sum.first.map(|step| step.to);
        let ends = |sum: &Part| sum.last.map(|step| step.from);
        let tolerance = self.document.tolerance(&cut.sum);
        let meet = |one: Spot, other: Spot| meet(one, other, tolerance);
        let common = |some: [Spot; 2], others: [Spot; 2]| {
            let is_met = move |spot: &Spot| others.iter().any(|other| meet(*spot, *other));
            some.into_iter().filter(is_met)
        };
        let own = &*cut.sum;
        let area = |other: &Part| {
            let from = common(begins(own), ends(other));
            let mut tabs =
                from.flat_map(|from| common(ends(own), begins(other)).map(move |to| (from, to)));
            let area = own.twice_area.wrapping_add(other.twice_area);
            let are_one = other.start() == own.start()
                && other.side == own.side
                && area.unsigned_abs() > LEAST_TWICE_AREA
                && tabs.any(|(from, to)| !meet(from, to));
            are_one.then_some(area)
        };
        all?.iter().find_map(|other| area(&other.sum))
    }

    /// A G41 that becomes G42 within a cut, at the word that does so.
    fn side_change(&mut self, line: Range<usize>) {
        let range = self.switch_range(line.start);
        let side = if self
            .text
            .bytes()
            .get(range.clone())
            .is_some_and(|word| word.ends_with(b"42"))
        {
            Side::Right
        } else {
            Side::Left
        };
        self.add(range, Fault::SideChange { side });
    }

    /// The side of the contour from which the way in comes, by the contour's directions at its start and end; `None`
    /// where they disagree, or the cut has no way in with the correction on.
    fn side_of_entry(&self, sum: &Part) -> Option<Side> {
        let lead = &sum.first[0];
        if lead.switches != Some(true) || lead.is_arc() {
            return None;
        }
        let near = |spot: Spot| meet(spot, lead.to, tolerance(sum.arcs as usize));
        let last = sum.last.iter().rev().find(|step| near(step.to))?;
        let ahead = sum.first[1]
            .at_origin()
            .segment(self.reading)
            .start_tangent();
        let behind = last.at_origin().segment(self.reading).end_tangent();
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
