//! The order in which the lines of a program run: from the first to the last, or through the subprograms that `M98 P…` calls.

use super::block::{Stop, read_line};
use crate::text::SourceText;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Subprograms within each other; more than controls take.
const DEEPEST: usize = 16;

/// A program runs at most so many lines, or eight times those it has.
const MOST_LINES: usize = 1_000_000;

/// A program calls subprograms at most so often.
const MOST_CALLS: usize = 20_000;

/// The lines of a program in the order in which they run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Order {
    pub lines: Vec<Range<usize>>,
    /// Lines that call a subprogram which is not in the text, with its number.
    pub missing: Vec<(usize, u32)>,
    /// The line at which the calls were no longer followed: they go too deep or never end.
    pub endless: Option<usize>,
}

/// Follows the calls of a program that has some.
pub fn order(text: &SourceText) -> Order {
    let mut walk =
        Walk { text, labels: labels(text), order: Order::default(), left: MOST_LINES.max(text.line_count() * 8), calls: MOST_CALLS };
    walk.run(0, 0);
    walk.order
}

/// The line of each N and O number; the last one where it stands several times, since subprograms stand behind the end.
pub(super) fn labels(text: &SourceText) -> FxHashMap<u32, usize> {
    let mut labels = FxHashMap::default();
    for line in 0..text.line_count() {
        let range = text.line_range(line);
        let block = read_line(&text.bytes()[range], 0, |_| {});
        for number in [block.number, block.program].into_iter().flatten() {
            labels.insert(number, line);
        }
    }
    labels
}

struct Walk<'a> {
    text: &'a SourceText,
    labels: FxHashMap<u32, usize>,
    order: Order,
    /// How many lines may still run.
    left: usize,
    /// How many calls may still be followed.
    calls: usize,
}

impl Walk<'_> {
    /// Runs from a line to the end or to the return; false where nothing is to run behind it.
    fn run(&mut self, first: usize, depth: usize) -> bool {
        let mut begun = first;
        let mut line = first;
        while line < self.text.line_count() {
            if self.left == 0 {
                self.order.endless.get_or_insert(line);
                return false;
            }
            self.left -= 1;
            let range = self.text.line_range(line);
            let block = read_line(&self.text.bytes()[range], 0, |_| {});
            line += 1;
            if let Some(number) = block.call {
                self.order.lines.push(begun..line);
                begun = line;
                let times = if self.labels.contains_key(&number) { block.repeat.unwrap_or(1) } else { 1 };
                for _ in 0..times {
                    if !self.call(number, line - 1, depth) {
                        return false;
                    }
                }
            }
            if block.stop == Some(Stop::End) || block.returns {
                self.order.lines.push(begun..line);
                return block.stop.is_none();
            }
        }
        self.order.lines.push(begun..line);
        true
    }

    fn call(&mut self, number: u32, from: usize, depth: usize) -> bool {
        match self.labels.get(&number) {
            Some(&line) if depth < DEEPEST && self.calls > 0 => {
                self.calls -= 1;
                self.run(line, depth + 1)
            }
            Some(_) => {
                self.order.endless.get_or_insert(from);
                false
            }
            None => {
                if !self.order.missing.contains(&(from, number)) {
                    self.order.missing.push((from, number));
                }
                true
            }
        }
    }
}
