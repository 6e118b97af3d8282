//! The sequence of blocks: their numbers, and their stated places.

use super::super::around::StatedPoint;
use super::super::entry::{Entry, Move, What};
use super::super::rules::position_mismatch;
use super::{At, Document};
use crate::finding::{Fault, Finding};
use crate::geometry::Vector;
use crate::program::numbering::{self, Numbered};
use crate::program::steps::Program;
use std::collections::BTreeMap;

/// A block, and by how much its end point is off, µm.
pub(super) type OffPosition = (At, [f64; 2]);

/// How far coordinates may miss the place that they come back to, mm.
const RETURNS: f64 = 0.01;

/// Within this many stops a contour that begins elsewhere must come back.
const STOPS: usize = 16;

/// The place from which a block leads to a stated one.
pub(super) fn place_before(stated: &StatedPoint, travel: &Move) -> StatedPoint {
    let [x, y] = travel.meant_um();
    StatedPoint {
        at: [stated.at[0] - x / 1e3, stated.at[1] - y / 1e3],
        ..*stated
    }
}

/// What is known of the numbers before a block.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Numbers {
    /// The usual step of the program's numbers, by the first of them.
    pub(super) step: Option<u32>,
    /// The last number before each cut.
    pub(super) before: Vec<Option<u32>>,
}

impl Document {
    pub(super) fn numbers(&self) -> Numbers {
        let first = self
            .all_entries()
            .filter(|(_, entry)| entry.block().is_some())
            .map(|(_, entry)| entry.number())
            .take(numbering::FIRST);
        let mut last = None;
        let before = self.cuts.iter().map(|of| {
            let own = || of.entries.iter().rev().find_map(Entry::number);
            let next = if of.numbered > 0 {
                own().or(last)
            } else {
                last
            };
            std::mem::replace(&mut last, next)
        });
        Numbers {
            step: numbering::usual_step(&first.collect::<Vec<_>>()),
            before: before.collect(),
        }
    }

    /// The last number before a block.
    pub(super) fn number_before(&self, at: At) -> Option<u32> {
        let own = self.entries_in(at.cut).get(..at.entry)?;
        let own = own.iter().rev().find_map(Entry::number);
        own.or_else(|| *self.view.numbers.before.get(at.cut)?)
    }

    /// The blocks with a wrong number, and the number of each one's turn, where that is known.
    pub(super) fn judge_numbers(&self, findings: &mut Vec<Finding>) -> BTreeMap<At, Option<u32>> {
        let mut faulty = BTreeMap::new();
        if self.cuts.iter().all(|cut| cut.numbered == 0) {
            return faulty;
        }
        let (places, blocks) = self.numbered(self.view.end);
        for (index, fault, meant) in numbering::check(&blocks) {
            let at = places[index];
            findings.push(Finding::of(fault, self.range_of(at)));
            // Of several findings of one block the first.
            faulty.entry(at).or_insert(meant);
        }
        faulty
    }

    /// Blocks and numbered words up to the end, with their numbers.
    pub(super) fn numbered(&self, end: Option<At>) -> (Vec<At>, Vec<Numbered>) {
        let mut is_after_pause = false;
        let numbered = |(at, entry): (At, &Entry)| {
            let is_word = matches!(entry.what, What::Word { .. });
            let is_after_pause = std::mem::replace(&mut is_after_pause, is_word);
            let (number, is_unread) = (entry.number(), entry.what == What::Unread);
            let counts = entry.block().is_some() || is_unread || (is_word && number.is_some());
            let is_in_program = end.is_none_or(|end| at <= end);
            let block = Numbered {
                number,
                is_after_pause,
                is_unread,
            };
            (counts && is_in_program).then_some((at, block))
        };
        self.all_entries().filter_map(numbered).unzip()
    }

    /// The end points that are not where their blocks lead from those before, by how much, µm; empty where so many are off
    /// that the numbers mean something else.
    pub(super) fn off_positions(&self) -> Vec<OffPosition> {
        let (mut before, mut compared) = (None, 0);
        let mut off: Vec<OffPosition> = Vec::new();
        for (cut, own) in self.cuts.iter().enumerate() {
            let positions = &own.rare().positions;
            if let (Some(before), Some(first)) = (&before, &positions.first) {
                compared += 1;
                let (entry, stated, travel) = &**first;
                let by = position_mismatch::mismatch(before, travel, stated);
                off.extend(by.map(|by| (At { cut, entry: *entry }, by)));
            }
            compared += positions.compared;
            let wrong = positions.off.iter();
            off.extend(wrong.map(|(entry, by)| (At { cut, entry: *entry }, *by)));
            // Blocks without an end point leave nothing to compare the next one with.
            before = match positions.last {
                Some(last) => last,
                None => before.filter(|_| !own.has_blocks()),
            };
        }
        if off.len() > 2 && off.len() as f64 > position_mismatch::FOREIGN * compared as f64 {
            off.clear();
        }
        off
    }

    /// Where the wire was taken by hand, after a stop without a way: the first block there, and how far, µm.
    pub(super) fn taken(&self, off: &[OffPosition]) -> Vec<(At, Vector)> {
        let behind_stops = off.iter().filter(|(at, _)| self.is_behind_stop(*at));
        let taken = behind_stops.filter_map(|&(at, by)| {
            let is_behind_way = at.cut > 0 && self.is_jump(at.cut - 1);
            let is_in_program = at.cut < self.cut_count();
            let is_it = is_in_program && !is_behind_way && self.returns_beside(at);
            is_it.then_some((at, Vector::from(by)))
        });
        taken.collect()
    }

    /// Whether the coordinates after the blocks from this one on, which are not where it leads to from the place
    /// before, come back to where it begins by them, and not to the place before: then the wire was taken there, and
    /// the block is right.
    fn returns_beside(&self, at: At) -> bool {
        let first = self.entry(at).and_then(Entry::block);
        let (Some(first), Some(before)) = (first, self.stated_before(at)) else {
            return false;
        };
        let Some(stated) = first.stated_end() else {
            return false;
        };
        let begin = place_before(&stated, &first.travel());
        let is_at = |one: &StatedPoint, other: &StatedPoint| {
            let rounding = 10_f64.powi(-i32::from(one.decimals.min(other.decimals)));
            let near = |axis: usize| (one.at[axis] - other.at[axis]).abs() <= RETURNS + rounding;
            near(0) && near(1)
        };
        let mut travel = Move::default();
        let (mut last, mut goes_on) = (stated, None);
        let mut stops = 0;
        for (_, entry) in self.from(at) {
            match &entry.what {
                What::Block(block) => {
                    if travel != Move::default() && goes_on.is_none() {
                        let next = block.stated_end();
                        let off =
                            |next| position_mismatch::mismatch(&stated, &block.travel(), &next);
                        goes_on = Some(next.is_none_or(|next| off(next).is_none()));
                    }
                    travel = travel.plus(block.travel());
                    last = block.stated_end().unwrap_or(last);
                }
                What::Unread => return false,
                What::Word { .. } => {
                    stops += 1;
                    if stops > STOPS || goes_on == Some(false) || is_at(&last, &before) {
                        return false;
                    }
                    if is_at(&last, &begin) {
                        return true;
                    }
                }
                _ => {}
            }
        }
        goes_on != Some(false) && !is_at(&last, &before) && is_at(&last, &begin)
    }

    pub(super) fn judge_positions(&self, findings: &mut Vec<Finding>, off: &[OffPosition]) {
        let mut before: Option<OffPosition> = None;
        for &(at, [x, y]) in off {
            if self.taken_before(at).is_some() {
                continue;
            }
            // One wrong end point is off once on the way there and once on the way back.
            let goes_back = before.is_some_and(|(last, [a, b])| {
                let is_back = (a + x).abs() <= 4.0 && (b + y).abs() <= 4.0;
                is_back && self.next_block(last).is_some_and(|(next, _)| next == at)
            });
            before = (!goes_back).then_some((at, [x, y]));
            if !goes_back {
                let fault = Fault::PositionMismatch { x, y };
                findings.push(Finding::of(fault, self.range_of(at)));
            }
        }
    }
}
