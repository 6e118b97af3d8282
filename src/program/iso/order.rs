//! The order in which the lines of a program run: from the first to the last, or through the subprograms that `M98 P…` calls.

use super::block::{Block, Stop};
use super::leader::leader;
use crate::text::SourceText;
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;

/// Subprograms within each other; more than controls take.
const DEEPEST: usize = 16;

/// A program runs at most this many lines plus twice those it has.
const MOST_LINES: usize = 100_000;

/// A program calls subprograms at most this often.
pub(super) const MOST_CALLS: usize = 20_000;

/// The lines of a program in the order in which they run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Order {
    pub(crate) lines: Vec<Range<usize>>,
    /// How many lines run up to the end of each of these ranges.
    counts: Vec<usize>,
    /// The line of each N and O number.
    pub(crate) labels: FxHashMap<u32, usize>,
    /// The numbers that are called.
    pub(crate) called: FxHashSet<u32>,
    /// Lines that call a subprogram which is not in the text, with its number.
    pub(crate) missing: Vec<(usize, u32)>,
    /// Subprograms that run on into the blocks after them: the line after which M99 is missing, with the number.
    pub(crate) unreturned: Vec<(usize, u32)>,
    /// The line at which the calls were no longer followed: they go too deep or never end.
    pub(crate) endless: Option<usize>,
    /// The line at which running stopped at the limit.
    pub(crate) left_out: Option<usize>,
    /// How many lines may run in all.
    pub(crate) most_lines: usize,
}

impl Order {
    /// How many lines run.
    pub(super) fn count(&self) -> usize {
        self.counts.last().copied().unwrap_or(0)
    }

    /// The line of the text that runs as one of them.
    pub(super) fn line(&self, nth: usize) -> usize {
        let range = self.counts.partition_point(|count| *count <= nth);
        let before = range
            .checked_sub(1)
            .and_then(|before| self.counts.get(before));
        let first = self.lines.get(range).map_or(0, |lines| lines.start);
        first + nth - before.copied().unwrap_or(0)
    }

    /// The numbers of the lines that run as one of the text.
    pub(super) fn of_line(&self, line: usize) -> impl Iterator<Item = usize> + '_ {
        let ranges = self.lines.iter().zip(&self.counts);
        let holding = ranges.filter(move |(lines, _)| lines.contains(&line));
        holding.map(move |(lines, count)| count - (lines.end - line))
    }
}

/// The lines of a text in the order in which they run.
#[derive(Clone, Copy)]
pub(super) struct Sequence<'a> {
    pub(super) text: &'a SourceText,
    /// The first lines, which are not read.
    pub(super) leader: usize,
    /// Where it is not that of the text.
    pub(super) order: Option<&'a Order>,
}

impl<'a> Sequence<'a> {
    pub(super) fn count(&self) -> usize {
        let of_text = self.text.line_count();
        self.order.map_or(of_text, Order::count)
    }

    /// The line of the text that runs as one of these.
    pub(super) fn line(&self, nth: usize) -> usize {
        self.order.map_or(nth, |order| order.line(nth))
    }

    /// Byte from which places count in a cut that begins with one of them: the first of the text where lines run in another
    /// order.
    pub(super) fn base(&self, nth: usize) -> usize {
        match self.order {
            None => self.text.line_start(nth),
            Some(_) => 0,
        }
    }

    /// The bytes of a line of the text; none of the leader.
    pub(super) fn bytes(&self, line: usize) -> &'a [u8] {
        let read = (line >= self.leader).then(|| self.text.line(line));
        read.unwrap_or_default()
    }

    /// Those behind one.
    pub(super) fn behind(self, nth: usize) -> impl Iterator<Item = &'a [u8]> + use<'a> {
        (nth + 1..self.count()).map(move |nth| self.bytes(self.line(nth)))
    }
}

/// Follows the calls of a program that has some.
pub(crate) fn order(text: &SourceText) -> Order {
    let most_lines = MOST_LINES + 2 * text.line_count();
    let order = Order {
        most_lines,
        labels: labels(text),
        called: called(text),
        ..Order::default()
    };
    let mut walk = Walk {
        text,
        order,
        told: FxHashSet::default(),
        left: most_lines,
        calls: MOST_CALLS,
    };
    walk.run(leader(text), 0, None);
    walk.order
}

/// The line of each N and O number; the last one where it stands several times, since subprograms stand after the end.
pub(super) fn labels(text: &SourceText) -> FxHashMap<u32, usize> {
    let mut labels = FxHashMap::default();
    for line in leader(text)..text.line_count() {
        let block = Block::of(text.line(line));
        for number in [block.number, block.program].into_iter().flatten() {
            labels.insert(number, line);
        }
    }
    labels
}

/// The numbers that are called.
pub(super) fn called(text: &SourceText) -> FxHashSet<u32> {
    let call = |line: usize| Block::of(text.line(line)).call;
    (leader(text)..text.line_count()).filter_map(call).collect()
}

struct Walk<'a> {
    text: &'a SourceText,
    order: Order,
    /// The calls that lead nowhere and the subprograms that run on: a line may run many times.
    told: FxHashSet<(usize, u32)>,
    /// How many lines may still run.
    left: usize,
    /// How many calls may still be followed.
    calls: usize,
}

impl Walk<'_> {
    /// Runs from a line to the end or to the return; false where nothing is to run after it.
    fn run(&mut self, first: usize, depth: usize, number: Option<u32>) -> bool {
        let mut begun = first;
        let mut line = first;
        let mut last = first;
        while line < self.text.line_count() {
            if self.left == 0 {
                self.push(begun..line);
                self.order.left_out.get_or_insert(line.saturating_sub(1));
                return false;
            }
            self.left -= 1;
            let block = Block::of(self.text.line(line));
            // Another program begins: a subprogram that runs into it has no end of its own.
            if let Some(own) = number.filter(|_| line > first)
                && [
                    block.program,
                    block
                        .number
                        .filter(|number| self.order.called.contains(number)),
                ]
                .into_iter()
                .flatten()
                .any(|other| other != own)
            {
                self.unreturned(last, own);
                if block.program.is_some() {
                    self.push(begun..line);
                    return true;
                }
            }
            if !block.empty {
                last = line;
            }
            line += 1;
            if let Some(number) = block.call {
                self.push(begun..line);
                begun = line;
                let times = if self.order.labels.contains_key(&number) {
                    block.repeat.unwrap_or(1)
                } else {
                    1
                };
                for _ in 0..times {
                    if !self.call(number, line - 1, depth) {
                        return false;
                    }
                }
            }
            if block.stop == Some(Stop::End) || block.returns {
                self.push(begun..line);
                return block.stop.is_none();
            }
        }
        self.push(begun..line);
        if let Some(own) = number {
            self.unreturned(last, own);
        }
        true
    }

    fn unreturned(&mut self, line: usize, number: u32) {
        if self.told.insert((line, number)) {
            self.order.unreturned.push((line, number));
        }
    }

    /// Lines that run one after another.
    fn push(&mut self, lines: Range<usize>) {
        if !lines.is_empty() {
            self.order.counts.push(self.order.count() + lines.len());
            self.order.lines.push(lines);
        }
    }

    fn call(&mut self, number: u32, from: usize, depth: usize) -> bool {
        match self.order.labels.get(&number) {
            Some(&line) if depth < DEEPEST && self.calls > 0 => {
                self.calls -= 1;
                self.run(line, depth + 1, Some(number))
            }
            Some(_) if depth < DEEPEST => {
                self.order.left_out.get_or_insert(from);
                false
            }
            Some(_) => {
                self.order.endless.get_or_insert(from);
                false
            }
            None => {
                if self.told.insert((from, number)) {
                    self.order.missing.push((from, number));
                }
                true
            }
        }
    }
}
