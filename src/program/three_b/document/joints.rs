//! `spur` and `reversed-arc`: odd joints of blocks. Those within a part are known since its lines were read; here are
//! the joints between stretches, and the decision which of all joints count.

use super::super::entry::{Entry, What};
use super::super::rules::{Counts, TextFix};
use super::super::stretch::{Edge, Local, shape};
use super::{At, Document, JoinedCut};
use crate::finding::{Detail, Fault, Finding};
use crate::geometry::{Point, Segment, Vector};
use crate::program::contours::PartAt;
use crate::program::path::{may_be_odd, odd_joint, tolerance};
use crate::program::repair::without_spur;
use std::ops::Range;

/// Blocks on either side of the end of a stretch that decide about its joints.
const REACH: usize = 3;

impl Document {
    /// The joints about the ends of stretches; returns the parts in which one is reported.
    pub(super) fn judge_joints(&self, findings: &mut Vec<Finding>) -> Vec<PartAt> {
        let mut told = Vec::new();
        let mut odd: Vec<(At, Fault)> = Vec::new();
        let mut before: Option<&Edge> = None;
        for (stretch, of) in self.stretches.iter().enumerate() {
            if of.blocks == 0 && of.words == 0 {
                continue;
            }
            if let (Some(last), Some(first)) = (before, &of.edges[0])
                && (last.is_odd || first.is_odd || may_be_odd(&last.block, &first.block))
            {
                odd.extend(self.odd_about(stretch));
            }
            before = of.edges[1].as_ref();
        }
        // One joint may lie near the ends of several stretches.
        odd.sort_by_key(|(at, _)| *at);
        odd.dedup_by_key(|(at, _)| *at);
        for (at, fault) in odd {
            let part = (at.stretch, self.part_of(at));
            let cut = self.cut_of_part(part);
            if cut.is_some_and(|cut| self.is_told(&cut, at, &fault)) {
                told.push(part);
                findings.push(Finding::of(fault, self.range_of(at)));
            }
        }
        told
    }

    /// The odd joints whose blocks lie on both sides of the beginning of a stretch.
    fn odd_about(&self, stretch: usize) -> Vec<(At, Fault)> {
        let entries = self.entries_in(stretch);
        let Some(entry) = entries.iter().position(|entry| entry.block().is_some()) else {
            return Vec::new();
        };
        let first = At { stretch, entry };
        let placed = |(at, entry): (At, &Entry)| Some((at, shape(&entry.block()?.block())));
        let is_word = |entry: &Entry| matches!(entry.what, What::Word { .. });
        let before = self.before(first).take_while(|(_, entry)| !is_word(entry));
        let mut blocks: Vec<(At, Segment)> = before.filter_map(placed).take(REACH).collect();
        blocks.reverse();
        let own = blocks.len();
        let behind = self.from(first).take_while(|(_, entry)| !is_word(entry));
        blocks.extend(behind.filter_map(placed).take(REACH));
        let odd = (1..blocks.len().saturating_sub(1)).filter_map(|index| {
            let piece = |index: usize| blocks.get(index).map(|(_, piece)| *piece);
            let came = index.checked_sub(2).and_then(piece);
            let fault = odd_joint(came, piece(index - 1)?, piece(index)?, &piece(index + 1)?)?;
            let reach = if let Fault::Spur { .. } = fault { 2 } else { 1 };
            let is_here = index < own + reach && index + 1 >= own;
            is_here.then_some((blocks.get(index)?.0, fault))
        });
        odd.collect()
    }

    /// Whether an odd joint is reported: the contour has no other fault, and a spur is no way out and in again between
    /// two passes.
    pub(super) fn is_told(&self, cut: &JoinedCut, at: At, fault: &Fault) -> bool {
        let tip = || self.stands_before(at);
        let begin = || Some(self.stands_before(self.blocks_of(cut).next()?));
        let is_lead =
            || begin().is_some_and(|begin| (begin - tip()).norm() <= tolerance(cut.sum.arcs));
        cut.sum.errors == 0 && !(matches!(fault, Fault::Spur { .. }) && is_lead())
    }

    /// The same for one within a stretch.
    pub(super) fn is_local_told(&self, stretch: usize, local: &Local) -> bool {
        let (Some(cut), Some(at)) = (
            self.cut_of_part((stretch, local.part)),
            self.entry_of(stretch, local),
        ) else {
            return false;
        };
        matches!(&local.detail, Detail::Program(fault) if self.is_told(&cut, at, fault))
    }

    fn entry_of(&self, stretch: usize, local: &Local) -> Option<At> {
        let entries = self.entries_in(stretch);
        let entry = entries.partition_point(|entry| entry.range().start < local.range.start);
        Some(At { stretch, entry })
    }

    /// The machine's position before an entry, µm.
    fn stands_before(&self, at: At) -> Point {
        let travels = self
            .entries_in(at.stretch)
            .iter()
            .take(at.entry)
            .filter_map(Entry::block);
        let by = travels.map(|block| block.travel().machine);
        let begin = self
            .view
            .begins
            .get(at.stretch)
            .copied()
            .unwrap_or_default();
        let of_stretch = |(own, _): &&(At, Vector)| own.stretch == at.stretch && *own <= at;
        let taken: Vector = self
            .view
            .taken
            .iter()
            .filter(of_stretch)
            .map(|(_, by)| by)
            .sum();
        by.fold(begin + taken, |at, [x, y]| {
            at + Vector::new(x as f64, y as f64)
        })
    }

    /// Whether an odd joint of a cut is reported.
    pub(super) fn is_odd(&self, cut: &JoinedCut) -> bool {
        let [(first_stretch, first), (last_stretch, last)] = cut.parts;
        let of_stretch = |stretch: usize| {
            let faults = self.stretches.get(stretch).map_or(&[][..], |of| &of.faults);
            faults.iter().any(|local| {
                local.counts == Counts::IfAlone
                    && (first_stretch, first) <= (stretch, local.part)
                    && (stretch, local.part) <= (last_stretch, last)
                    && self.is_local_told(stretch, local)
            })
        };
        let first_odd = self.view.odd.partition_point(|part| *part < cut.parts[0]);
        let is_between = self
            .view
            .odd
            .get(first_odd)
            .is_some_and(|part| *part <= cut.parts[1]);
        is_between || (first_stretch..=last_stretch).any(of_stretch)
    }

    /// A way out and back goes, where it returns to its start.
    pub(super) fn spur_fixes(&self, range: &Range<usize>) -> Option<Vec<TextFix>> {
        let back = self.entry_at(range)?;
        let (out, before) = self
            .before(back)
            .find(|(_, entry)| entry.block().is_some())?;
        let both = before
            .block()?
            .travel()
            .plus(self.entry(back)?.block()?.travel());
        for at in [out, back] {
            let number = self.entry(at)?.line;
            let entries = self.entries_in(at.stretch).iter();
            if entries.filter(|entry| entry.line == number).count() > 1 {
                return None;
            }
        }
        let shown = |at: At| {
            let range = self.range_of(at);
            let own = self.text.bytes().get(range.clone()).unwrap_or_default();
            let shown = String::from_utf8_lossy(own).into_owned();
            (self.text.line_of(range.start), shown)
        };
        both.is_within(tolerance(0))
            .then(|| vec![without_spur(&self.text, [out, back].map(shown))])
    }
}

#[cfg(test)]
mod tests {
    use super::super::Document;

    const SPUR: &str = "B0B500B500GYL2\nB1000B0B1000GXL1\nB0B500B500GYL2\nB300B0B300GXL1\nB300B0B300GXL3\nB0B500B500GYL2\nB2000B0B2000GXL3\nB0B1000B1000GYL4\nB1000B0B1000GXL1\nB0B500B500GYL4\nDD\n";
    const REVERSED: &str = "B0B500B500GYL2\nB500B0B500GXL1\nB0B500B1000GXNR4\nB1000B0B1000GXL3\nB0B500B1000GXSR1\nB500B0B500GXL1\nB0B500B500GYL4\nDD\n";

    /// A joint is found once, wherever a stretch ends, even where each block is a stretch away from the next.
    #[test]
    fn an_odd_joint_is_found_wherever_runs_end() {
        for (text, odd) in [(SPUR, "spur"), (REVERSED, "reversed-arc")] {
            let apart = text.replace('\n', &"\n".repeat(100));
            let texts = (0..100)
                .map(|lines| "\n".repeat(lines) + text)
                .chain([apart]);
            for text in texts {
                let found = Document::read(text.clone().into_bytes()).findings();
                let found: Vec<_> = found.iter().map(|finding| finding.rule.name()).collect();
                assert_eq!(found, [odd], "{text}");
            }
        }
    }
}
