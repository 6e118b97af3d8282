//! The findings of a program: those of its blocks, where they count, those of contours that cross themselves, and those of
//! the whole.

use super::super::cut::Local;
use super::super::entry::What;
use super::super::fields::fields_of;
use super::super::rules::{self, Counts};
use super::Document;
use super::contours::OneContour;
use crate::finding::{Detail, Fault, Finding, Severity};
use crate::program::contours::Divided;
use crate::program::path;
use crate::program::report::{Report, Unmade};
use crate::program::steps::Program;
use crate::settings::SideSetting;
use std::ops::Range;

impl Report for Document {
    fn each(&self, take: &mut dyn FnMut(&Unmade<'_>)) {
        for (cut, own) in self.cuts.iter().enumerate() {
            let faults = own.rare().faults.iter();
            for local in faults.filter(|local| self.counts(cut, local)) {
                take(&Unmade {
                    rule: local.rule,
                    severity: self.own_severity(cut, local),
                    start: self.cuts.byte(cut) + local.range.start,
                    make: &|| self.materialized(cut, local),
                });
            }
        }
        for (cuts, found) in self.crossing() {
            let ranges = self.blocks_of(&cuts).map(|at| self.range_of(at));
            let ranges: Vec<Range<usize>> = ranges.collect();
            let found = found.findings(&self.way_of(&cuts), &ranges, &self.text);
            found.iter().for_each(|own| Unmade::hand_out(own, take));
        }
        let of_whole = self.view.findings.iter();
        of_whole.for_each(|own| Unmade::hand_out(own, take));
    }
}

impl Document {
    /// The lines of the cut around a line.
    pub(in crate::program) fn cut_lines(&self, line: usize) -> Range<usize> {
        let own = || {
            let cuts = self.contour_at(self.entry_at(&self.text.line_range(line))?)?;
            let line_of = |at| self.text.line_of(self.range_of(at).start);
            let mut entries = self.entries_of(&cuts);
            let first = line_of(entries.next()?);
            let last = entries.next_back().map_or(first, line_of);
            Some(first.min(line)..last.max(line) + 1)
        };
        own().unwrap_or(line..line + 1)
    }
}

impl Document {
    /// All findings as the reader and the rules see them, in no order.
    pub fn findings(&self) -> Vec<Finding> {
        self.all()
    }

    /// The contours that cross themselves, or of which an offset loses something, where that is to be said: no block of them
    /// has a fault, and no joint is odd.
    fn crossing(&self) -> impl Iterator<Item = (OneContour, &path::Found)> {
        let with_tabs = self.view.contours.iter();
        let with_tabs = with_tabs.filter(|contour| contour.ends_with_tab);
        let with_tabs = with_tabs.map(|contour| (contour.cuts.clone(), contour.found()));
        let is_whole = |cut: &usize| {
            let contour = self.view.contours.of_cut(*cut);
            contour.is_none_or(|contour| !contour.ends_with_tab)
        };
        let cuts = (0..self.cut_count()).filter(move |cut| is_whole(cut));
        let cuts = cuts.map(|cut| (cut..cut + 1, &self.cuts[cut].rare().found));
        let all = with_tabs.chain(cuts);
        all.filter(|(cuts, found)| {
            !found.is_clean()
                && self.errors(cuts) == 0
                && !self.is_jump(cuts.start)
                && !self.is_odd(cuts)
        })
    }

    /// Whether an odd joint of a contour is reported.
    fn is_odd(&self, cuts: &OneContour) -> bool {
        cuts.clone().any(|cut| {
            let mut faults = self.cuts[cut].rare().faults.iter();
            faults.any(|local| local.counts == Counts::IfAlone && self.counts(cut, local))
        })
    }

    /// Whether an odd joint is reported: the contour has no other fault, and a spur is no way out and in again between two
    /// passes.
    fn is_odd_joint(&self, cut: usize, local: &Local) -> bool {
        let Detail::Program(fault) = &local.detail else {
            return false;
        };
        let cuts = self.view.contours.cuts_of(cut);
        let is_lead = || {
            let entries = self.cuts[cut].entries.iter();
            let before = entries.take_while(|entry| entry.range().start < local.range.start);
            let before = before
                .filter(|entry| matches!(entry.what, What::Block(_)))
                .count();
            let earlier = self.block_count(&(cuts.start..cut));
            let tip = self.way_of(&cuts).node(earlier + before);
            let tolerance = path::tolerance(self.ends_of(&cuts).arcs);
            tip.machine.coords.norm() <= tolerance
        };
        self.errors(&cuts) == 0 && !(matches!(**fault, Fault::Spur { .. }) && is_lead())
    }

    fn is_unusual_only(&self, cut: usize, local: &Local) -> bool {
        local.counts == Counts::MildIfClosed && self.closes_at(cut)
    }

    /// Whether the contour of a cut closes; what stands after the end closes, too.
    fn closes_at(&self, cut: usize) -> bool {
        cut >= self.cut_count() || self.closes(&self.view.contours.cuts_of(cut))
    }

    fn own_severity(&self, cut: usize, local: &Local) -> Severity {
        if self.is_unusual_only(cut, local) {
            Severity::Information
        } else {
            local.rule.default_severity()
        }
    }

    fn counts(&self, cut: usize, local: &Local) -> bool {
        let is_in_program = cut < self.cut_count();
        match local.counts {
            Counts::Always | Counts::MildIfClosed => true,
            Counts::IfAlone => is_in_program && self.is_odd_joint(cut, local),
            // What is no cut, a way between contours, closes nothing.
            Counts::IfOpen => !is_in_program || self.is_jump(cut) || !self.closes_at(cut),
            Counts::IfInside { turns_left } => {
                let runs_left = || self.twice_area(&self.view.contours.cuts_of(cut)) > 0.0;
                let wire_is_inside = self.settings.side == SideSetting::Opening;
                is_in_program && (runs_left() == wire_is_inside) == turns_left
            }
        }
    }

    /// The bytes of a spot of a block.
    pub(super) fn spot_range(&self, spot: rules::Spot, block: Range<usize>) -> Range<usize> {
        if spot == rules::Spot::Block {
            return block;
        }
        let fields = fields_of(self.text.bytes(), block.clone());
        fields.map_or(block.clone(), |fields| spot.range(&fields, block))
    }

    fn materialized(&self, cut: usize, local: &Local) -> Finding {
        let base = self.cuts.byte(cut);
        let block = local.range.start + base..local.range.end + base;
        let range = self.spot_range(local.spot, block);
        let detail = match &local.detail {
            Detail::Program(fault) if self.is_unusual_only(cut, local) => {
                Detail::Program(Box::new(fault.as_unusual()))
            }
            detail => detail.clone(),
        };
        Finding::in_text(local.rule, range, detail).with(self.own_severity(cut, local))
    }
}
