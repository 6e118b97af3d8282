//! The sequence of blocks: their numbers, and their stated places.

use super::super::around::StatedPoint;
use super::super::entry::{Entry, Move, What};
use super::super::rules::position_mismatch;
use super::{At, Document};
use crate::finding::{Fault, Finding};
use crate::geometry::Vector;
use crate::program::chunks::Reread;
use crate::program::numbering::{self, Numbered, Numbering, Sequence};

/// A block by its number in the program and its place, and by how much its end point is off, µm.
pub(super) type OffPosition = (usize, At, [f64; 2]);

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
    /// The last number before each stretch.
    before: Vec<Option<u32>>,
}

impl Numbers {
    /// The stretches that were not read again but now have another number before them.
    pub(super) fn others(&self, now: &Numbers, reread: &Reread) -> impl Iterator<Item = usize> {
        let moved = self.before.iter().enumerate();
        let moved = moved.filter_map(|(stretch, number)| Some((reread.moved(stretch)?, number)));
        let is_other =
            |(stretch, number): &(usize, &Option<u32>)| now.before.get(*stretch) != Some(*number);
        moved.filter(is_other).map(|(stretch, _)| stretch)
    }
}

impl Document {
    pub(super) fn numbers(&self) -> Numbers {
        let blocks = self.entries(0..self.stretches.len());
        let first = blocks
            .filter(|(_, entry)| entry.block().is_some())
            .map(|(_, entry)| entry.number())
            .take(numbering::FIRST);
        let mut last = None;
        let before = self.stretches.iter().map(|of| {
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
        let own = self.entries_in(at.stretch).get(..at.entry)?;
        let own = own.iter().rev().find_map(Entry::number);
        own.or_else(|| *self.view.numbers.before.get(at.stretch)?)
    }

    pub(super) fn judge_numbers(&self, findings: &mut Vec<Finding>) {
        let numbering = self
            .stretches
            .iter()
            .fold(Numbering::Empty, |before, stretch| {
                before.then(stretch.numbering)
            });
        if numbering != Numbering::Irregular
            || self.stretches.iter().all(|stretch| stretch.numbered == 0)
        {
            return;
        }
        let end = self.view.end;
        let stretches = || 0..end.map_or(self.stretches.len(), |end| end.stretch + 1);
        let from = |stretch: usize| {
            (stretch..stretches().end).flat_map(|stretch| self.numbered_in(stretch, end))
        };
        let head: Vec<Numbered> = from(0)
            .map(|(_, block)| block)
            .take(numbering::FIRST)
            .collect();
        let first = stretches()
            .filter(|stretch| self.stretches[*stretch].numbered > 0)
            .flat_map(|stretch| self.numbered_in(stretch, end));
        let first = first.into_iter().find_map(|(_, block)| block.number);
        let Some(mut sequence) = Sequence::of(&head, first) else {
            return;
        };
        for stretch in stretches() {
            // A stretch in which the numbers continue regularly is not read.
            let regular = match self.stretches[stretch].numbering {
                Numbering::Regular { first, last, step }
                    if end.is_none_or(|end| stretch < end.stretch) =>
                {
                    Some((first, last, step))
                }
                _ => None,
            };
            let count = self.stretches[stretch].numbered;
            if regular.is_some_and(|(first, last, step)| sequence.skip(first, last, step, count)) {
                continue;
            }
            let mut blocks = self.numbered_in(stretch, end).peekable();
            let mut is_first = true;
            while let Some((at, block)) = blocks.next() {
                let next = blocks.peek().copied().or_else(|| from(stretch + 1).next());
                sequence.push(&block, next.map(|(_, next)| next).as_ref(), at);
                let rest = regular.filter(|_| std::mem::take(&mut is_first) && count > 1);
                if rest.is_some_and(|(first, last, step)| {
                    sequence.skip(first + step, last, step, count - 1)
                }) {
                    break;
                }
            }
        }
        for (at, fault, _) in sequence.found() {
            findings.push(Finding::of(fault, self.range_of(at)));
        }
    }

    /// Blocks and numbered words up to the end, with their numbers.
    pub(super) fn numbered(&self, end: Option<At>) -> (Vec<At>, Vec<Numbered>) {
        (0..self.stretches.len())
            .flat_map(|stretch| self.numbered_in(stretch, end))
            .unzip()
    }

    /// Those of one stretch.
    fn numbered_in(
        &self,
        stretch: usize,
        end: Option<At>,
    ) -> impl Iterator<Item = (At, Numbered)> + '_ {
        let entries = self.entries_in(stretch);
        let is_word = |entry: &Entry| matches!(entry.what, What::Word { .. });
        let mut is_after_pause = None;
        entries.iter().enumerate().filter_map(move |(entry, what)| {
            let follows_word = is_after_pause.unwrap_or_else(|| {
                let before = self.stretches[..stretch]
                    .iter()
                    .rev()
                    .find_map(|of| of.entries.last());
                before.is_some_and(is_word)
            });
            is_after_pause = Some(is_word(what));
            let at = At { stretch, entry };
            let (number, is_unread) = (what.number(), what.what == What::Unread);
            let counts = what.block().is_some() || is_unread || (is_word(what) && number.is_some());
            let is_in_program = end.is_none_or(|end| at <= end);
            (counts && is_in_program).then_some((
                at,
                Numbered {
                    number,
                    is_after_pause: follows_word,
                    is_unread,
                },
            ))
        })
    }

    /// The end points that are not where their blocks lead from those before, with the number of their block, by how
    /// much, µm; empty where so many are off that the numbers mean something else.
    pub(super) fn off_positions(&self) -> Vec<OffPosition> {
        let mut anchor = None;
        let (mut compared, mut ordinal) = (0, 0);
        let mut off: Vec<OffPosition> = Vec::new();
        for (stretch, of) in self.stretches.iter().enumerate() {
            let (positions, at) = (&of.positions, |entry: usize| At { stretch, entry });
            if let (Some(before), Some((entry, stated, travel))) = (&anchor, &positions.first) {
                compared += 1;
                let by = position_mismatch::mismatch(before, travel, stated);
                off.extend(by.map(|by| (ordinal, at(*entry), by)));
            }
            compared += positions.compared;
            let own = positions.off.iter();
            off.extend(own.map(|(nth, entry, by)| (ordinal + nth, at(*entry), *by)));
            ordinal += of.blocks;
            anchor = positions.anchor.unwrap_or(anchor);
        }
        if off.len() > 2 && off.len() as f64 > position_mismatch::FOREIGN * compared as f64 {
            off.clear();
        }
        off
    }

    /// Where the wire was taken by hand, after a stop without a way: the first block there, and how far, µm.
    pub(super) fn taken(&self, off: &[OffPosition]) -> Vec<(At, Vector)> {
        let behind_stops = off.iter().filter(|(_, at, _)| {
            let mut before = self.before(*at).map(|(_, entry)| &entry.what);
            let is_stop =
                |what: &&What| matches!(what, What::Block(_) | What::Word { .. } | What::Unread);
            matches!(before.find(is_stop), Some(What::Word { .. }))
        });
        let taken = behind_stops.filter_map(|&(_, at, by)| {
            let own = self.cut_of_part((at.stretch, self.part_of(at)))?;
            let (stretch, part) = own.parts[0];
            let before = part.checked_sub(1).map(|part| (stretch, part));
            let before = before.and_then(|before| self.cut_of_part(before));
            let is_behind_way = before.is_some_and(|cut| cut.is_jump);
            (!is_behind_way && self.returns_beside(at)).then_some((at, Vector::from(by)))
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

    pub(super) fn judge_positions(&self, findings: &mut Vec<Finding>, off: Vec<OffPosition>) {
        let mut before: Option<(usize, [f64; 2])> = None;
        for (ordinal, at, [x, y]) in off {
            if self
                .view
                .taken
                .binary_search_by_key(&at, |(at, _)| *at)
                .is_ok()
            {
                continue;
            }
            // One wrong end point is off once on the way there and once on the way back.
            let goes_back = before.is_some_and(|(last, [a, b])| {
                last + 1 == ordinal && (a + x).abs() <= 4.0 && (b + y).abs() <= 4.0
            });
            before = (!goes_back).then_some((ordinal, [x, y]));
            if !goes_back {
                let fault = Fault::PositionMismatch { x, y };
                findings.push(Finding::of(fault, self.range_of(at)));
            }
        }
    }
}
