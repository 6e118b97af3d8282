//! The findings of a program: those of its blocks, where they count, and those of the whole.

use super::super::fields::fields_of;
use super::super::rules::{self, Counts};
use super::super::stretch::Local;
use super::{Document, JoinedCut};
use crate::finding::{Detail, Finding, Severity};
use crate::program::by_chunk::ByChunk;
use crate::program::of_cut::{Counted, OfCut};
use crate::program::repair::gate::Tried;
use crate::program::report::{Found, Report, Source, place_of};
use crate::settings::SideSetting;
use std::ops::Range;

/// The place where a finding is stored.
#[derive(Clone, Copy, Debug)]
pub(in crate::program) enum Stored {
    InBlock { stretch: usize, index: usize },
    OnWhole { index: usize },
}

impl Report for Document {
    type Own = Stored;

    fn byte_of(&self, chunk: usize) -> usize {
        self.stretches.byte(chunk)
    }

    fn of_cuts(&self) -> &ByChunk<OfCut> {
        &self.view.told.found
    }

    /// The faults of each stretch, and those of the whole.
    fn own_groups(&self) -> usize {
        self.stretches.len() + 1
    }

    fn own_tally(&self, group: usize) -> Option<(usize, &[Counted])> {
        let tally = self.stretches.get(group)?.tally.as_deref()?;
        Some((self.stretches.byte(group), tally))
    }

    fn own_in(&self, stretch: usize) -> impl Iterator<Item = Found<Source<Stored>>> {
        let of = self.stretches.get(stretch);
        let faults = of.map_or(&[][..], |of| &of.faults).iter().enumerate();
        let counting = faults.filter(move |(_, local)| self.counts(stretch, local));
        let in_blocks = counting.map(move |(index, local)| {
            let base = self.stretches.byte(stretch);
            Found {
                rule: local.rule,
                severity: self.own_severity(stretch, local),
                place: (base + local.range.start, base + local.range.end),
                source: Source::Own(Stored::InBlock { stretch, index }),
            }
        });
        let of_whole = self.view.findings.iter().enumerate();
        let of_whole = of_whole.filter(move |_| of.is_none());
        in_blocks.chain(of_whole.map(|(index, finding)| Found {
            rule: finding.rule,
            severity: finding.severity,
            place: place_of(finding),
            source: Source::Own(Stored::OnWhole { index }),
        }))
    }

    fn own_worded(&self, own: Stored) -> Option<Finding> {
        match own {
            Stored::InBlock { stretch, index } => {
                let local = self.stretches.get(stretch)?.faults.get(index)?;
                Some(self.materialized(stretch, local))
            }
            Stored::OnWhole { index } => self.view.findings.get(index).cloned(),
        }
    }
}

impl Tried for Document {
    fn edit(&mut self, range: Range<usize>, replacement: &str) {
        Document::edit(self, range, replacement);
    }

    fn cut_lines(&self, line: usize) -> Range<usize> {
        let own = || {
            let cut = self.cut_of(self.entry_at(&self.text.line_range(line))?)?;
            let line_of = |at| self.text.line_of(self.range_of(at).start);
            let mut entries = self.entries_of(&cut);
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

    fn cut_of_local(&self, stretch: usize, local: &Local) -> Option<JoinedCut> {
        self.cut_of_part((stretch, local.part))
    }

    fn is_unusual_only(&self, stretch: usize, local: &Local) -> bool {
        local.counts == Counts::MildIfClosed
            && self
                .cut_of_local(stretch, local)
                .is_none_or(|cut| self.closes(&cut))
    }

    fn own_severity(&self, stretch: usize, local: &Local) -> Severity {
        if self.is_unusual_only(stretch, local) {
            Severity::Information
        } else {
            local.rule.default_severity()
        }
    }

    fn counts(&self, stretch: usize, local: &Local) -> bool {
        let cut = || self.cut_of_local(stretch, local);
        match local.counts {
            Counts::Always | Counts::MildIfClosed => true,
            Counts::IfAlone => self.is_local_told(stretch, local),
            // What is no cut, a way between contours, closes nothing.
            Counts::IfOpen => cut().is_none_or(|cut| cut.is_jump || !self.closes(&cut)),
            Counts::IfInside { turns_left } => cut().is_some_and(|cut| {
                let runs_left = cut.sum.twice_area > 0.0;
                let wire_is_inside = self.limits.side == SideSetting::Opening;
                (runs_left == wire_is_inside) == turns_left
            }),
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

    fn materialized(&self, stretch: usize, local: &Local) -> Finding {
        let base = self.stretches.byte(stretch);
        let block = local.range.start + base..local.range.end + base;
        let range = self.spot_range(local.spot, block);
        let detail = match &local.detail {
            Detail::Program(fault) if self.is_unusual_only(stretch, local) => {
                Detail::Program(Box::new(fault.as_unusual()))
            }
            detail => detail.clone(),
        };
        Finding::in_text(local.rule, range, detail).with(self.own_severity(stretch, local))
    }
}
