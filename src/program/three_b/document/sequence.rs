//! The sequence of blocks: their numbers, and their stated places.

use super::super::entry::{Entry, What};
use super::super::rules::block_number::{self, Numbered, Numbering, Sequence};
use super::super::rules::position_mismatch;
use super::{At, Document, View};
use crate::finding::{Fault, Finding};

impl Document {
    pub(super) fn judge_numbers(&self, view: &mut View) {
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
        let end = view.end;
        let stretches = || 0..end.map_or(self.stretches.len(), |end| end.stretch + 1);
        let from = |stretch: usize| {
            (stretch..stretches().end).flat_map(|stretch| self.numbered_in(stretch, end))
        };
        let head: Vec<Numbered> = from(0)
            .map(|(_, block)| block)
            .take(block_number::FIRST)
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
            view.findings.push(Finding::of(fault, self.range_of(at)));
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

    pub(super) fn judge_positions(&self, view: &mut View) {
        let mut anchor = None;
        let (mut compared, mut ordinal) = (0, 0);
        let mut off: Vec<(usize, At, [f64; 2])> = Vec::new();
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
            return;
        }
        let mut before: Option<(usize, [f64; 2])> = None;
        for (ordinal, at, [x, y]) in off {
            // One wrong end point is off once on the way there and once on the way back.
            let goes_back = before.is_some_and(|(last, [a, b])| {
                last + 1 == ordinal && (a + x).abs() <= 4.0 && (b + y).abs() <= 4.0
            });
            before = (!goes_back).then_some((ordinal, [x, y]));
            if !goes_back {
                let fault = Fault::PositionMismatch { x, y };
                view.findings.push(Finding::of(fault, self.range_of(at)));
            }
        }
    }
}
