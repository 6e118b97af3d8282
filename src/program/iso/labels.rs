//! Block numbers near a line, and the subprograms that are called by them.

use super::document::Document;
use crate::program::numbering::step;
use std::collections::BTreeMap;
use std::ops::Range;

/// How many lines back block numbers are searched for.
pub(super) const LOOKED_BACK: usize = 50;

impl Document {
    /// Whether some line calls the subprogram with a number.
    pub(crate) fn calls(&self, number: u32) -> bool {
        self.order()
            .is_some_and(|order| order.called.contains(&number))
    }

    /// The line of the subprogram with a number, where it is called.
    pub(crate) fn called_line(&self, number: u32) -> Option<usize> {
        self.order()?.labels.get(&number).copied()
    }

    /// The subprograms that a call may name, with their lines: those that are called, and in a
    /// program without calls those after its end, which are not run yet.
    pub(crate) fn subprograms(&self) -> BTreeMap<u32, usize> {
        if let Some(order) = self.order() {
            let called = order.called.iter();
            return called
                .filter_map(|number| Some((*number, *order.labels.get(number)?)))
                .collect();
        }
        let behind = self
            .last_line()
            .map_or(0..0, |last| last + 1..self.text().line_count());
        let numbers = behind.flat_map(|line| {
            let block = self.block(line);
            let numbers = [block.number, block.program].into_iter().flatten();
            numbers.map(move |number| (number, line))
        });
        numbers.filter(|(number, _)| *number < u32::MAX).collect()
    }

    /// The line that ends a program without calls.
    fn last_line(&self) -> Option<usize> {
        let ending = self.cuts.iter().position(|cut| cut.ended)?;
        let (_, byte) = self.cuts[ending].stop?;
        let byte = self.cuts.byte(ending) + byte as usize;
        Some(self.text().line_of(byte))
    }

    /// The last block number before a line, and the step of the numbers there.
    pub(crate) fn numbers_before(&self, line: usize) -> Option<(u32, u32)> {
        let mut numbers = (line.saturating_sub(LOOKED_BACK)..line)
            .rev()
            .filter_map(|line| self.block(line).number)
            .filter(|number| *number < u32::MAX);
        let last = numbers.next()?;
        let step = numbers.next().and_then(|before| step(before, last));
        Some((
            last,
            step.unwrap_or(if last.is_multiple_of(10) { 10 } else { 1 }),
        ))
    }

    /// The number of the next block after a line that has one.
    pub(crate) fn number_behind(&self, line: usize) -> Option<u32> {
        self.lines_behind(line)
            .find_map(|line| self.block(line).number)
    }

    fn lines_behind(&self, line: usize) -> Range<usize> {
        line + 1..self.text().line_count().min(line + 1 + LOOKED_BACK)
    }

    /// The numbers that are missing from the sequence of a cut's blocks: each with its line.
    pub(super) fn lacking_numbers(&self, cut: usize) -> Vec<(usize, u32)> {
        let mut found = Vec::new();
        for nth in self.cuts.lines(cut) {
            let line = self.sequence().line(nth);
            let own = self.block(line);
            if own.empty || own.number.is_some() || own.program.is_some() {
                continue;
            }
            let Some((last, step)) = self.numbers_before(line) else {
                continue;
            };
            let next = self
                .lines_behind(line)
                .map(|line| self.block(line))
                .find(|block| !block.empty);
            if let (Some(expected), Some(next)) =
                (last.checked_add(step), next.and_then(|next| next.number))
                && expected.checked_add(step) == Some(next)
            {
                found.push((line, expected));
            }
        }
        found
    }
}
