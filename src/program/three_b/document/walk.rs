//! The machine on its way through a program, and the blocks about a place in the text.

use super::super::block::{Block, PartArc};
use super::super::decode::meant;
use super::super::run::{Entry, Move, What};
use super::way::SectionWay;
use super::{At, Document, Section};
use crate::geometry::{Point, Vector};
use crate::program::path::Way;
use crate::program::path::{Chain, Kind, Step, Trace};
use std::ops::Range;

/// A block and what stands about it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedBlock {
    /// Bytes of the text, from the first `B` to the quadrant.
    pub range: Range<usize>,
    /// From 0.
    pub line: usize,
    pub number: Option<u32>,
    pub block: Block,
    /// What a 4B block says beside a 3B block.
    pub part: Option<PartArc>,
    /// Coordinates behind the block, mm.
    pub stated_end: Option<[f64; 2]>,
}

impl Document {
    /// Where the machine goes, block by block, up to the end word.
    pub fn trace(&self) -> Trace {
        let mut trace = Trace::default();
        let mut walk = self.walk();
        (trace.start, trace.start_is_known) = (walk.at, walk.start_is_known);
        for run in 0..self.runs.len() {
            walk.run(run, |_| true, &mut |step| trace.steps.push(step));
        }
        trace
    }

    /// The steps whose text overlaps or touches a range of bytes.
    pub fn steps_in(&self, range: Range<usize>) -> Vec<Step> {
        let (first, last) = (self.run_at(range.start), self.run_at(range.end));
        let mut walk = self.walk();
        (0..first).for_each(|run| walk.skip(run));
        let mut steps = Vec::new();
        for run in first..=last {
            walk.run(
                run,
                |bytes| bytes.start <= range.end && range.start <= bytes.end,
                &mut |step| steps.push(step),
            );
        }
        steps
    }

    /// The blocks whose text overlaps or touches a range of bytes, as they stand there.
    pub fn blocks_in(&self, range: Range<usize>) -> Vec<PlacedBlock> {
        let mut blocks = Vec::new();
        for run in self.run_at(range.start)..=self.run_at(range.end) {
            let (Some(of), (base, first_line)) = (
                self.runs.get(run),
                self.view.starts.get(run).copied().unwrap_or_default(),
            ) else {
                continue;
            };
            for entry in &of.entries {
                let own = entry.range().start + base..entry.range().end + base;
                if let Some(block) = entry
                    .block()
                    .filter(|_| own.start <= range.end && range.start <= own.end)
                {
                    let (line, number) = (first_line + entry.line as usize, entry.number());
                    let (part, stated_end) =
                        (block.part(), block.stated_end().map(|stated| stated.at));
                    blocks.push(PlacedBlock {
                        range: own,
                        line,
                        number,
                        block: block.block,
                        part,
                        stated_end,
                    });
                }
            }
        }
        blocks
    }

    /// The blocks between two words of which one touches a byte, by their ends, and the number of that one among them.
    pub fn chain_at(&self, offset: usize) -> Option<(Chain<'static>, usize)> {
        let at = self.block_touching(offset)?;
        let section = self.section_of(at)?;
        let nth = self.count_before(&section, at);
        Some((self.chain(&section, None)?, nth))
    }

    /// The blocks from the last word on that stand before a byte, by their ends; `None` where there is none.
    pub fn chain_before(&self, offset: usize) -> Option<Chain<'static>> {
        let run = self.run_at(offset);
        let local = offset.saturating_sub(self.base(run));
        let entries = &self.runs.get(run)?.entries;
        let behind = At {
            run,
            entry: entries.partition_point(|entry| entry.range().end <= local),
        };
        if self.view.end.is_some_and(|end| end < behind) {
            return None;
        }
        let parts = &self.runs.get(run)?.parts;
        let part = parts
            .partition_point(|part| part.entries.end < behind.entry)
            .min(parts.len().saturating_sub(1));
        self.chain(
            &self.section_of_part(&self.view, (run, part))?,
            Some(behind),
        )
    }

    /// The first word behind a byte, up to the end of the program.
    pub fn word_behind(&self, offset: usize) -> Option<Range<usize>> {
        let first = self.run_at(offset);
        let words = self
            .runs
            .iter()
            .enumerate()
            .skip(first)
            .flat_map(|(run, of)| {
                of.parts
                    .iter()
                    .filter(|part| part.word.is_some())
                    .map(move |part| At {
                        run,
                        entry: part.entries.end,
                    })
            });
        let found = words
            .map(|at| self.range_of(at, &self.view.starts))
            .find(|range| range.start > offset)?;
        let is_over = self
            .view
            .end
            .is_some_and(|end| self.range_of(end, &self.view.starts).start < found.start);
        (!is_over).then_some(found)
    }

    /// The line of the first block of 4B, from 0.
    pub(in crate::program) fn first_four_b_line(&self) -> Option<usize> {
        let mut all = self
            .runs
            .iter()
            .enumerate()
            .flat_map(|(run, of)| of.entries.iter().map(move |entry| (run, entry)));
        let is_four_b = |entry: &Entry| entry.block().is_some_and(|block| block.part().is_some());
        let (run, entry) = all.find(|(_, entry)| is_four_b(entry))?;
        Some(self.view.starts.get(run)?.1 + entry.line as usize)
    }

    pub fn first_block(&self) -> Option<Range<usize>> {
        let run = self.runs.iter().position(|run| run.blocks > 0)?;
        let entry = self.runs[run]
            .entries
            .iter()
            .position(|entry| entry.block().is_some())?;
        Some(self.range_of(At { run, entry }, &self.view.starts))
    }

    /// Where the program begins, µm: the origin where it does not say.
    pub fn start(&self) -> Point {
        self.walk().at
    }

    fn block_touching(&self, offset: usize) -> Option<At> {
        // Of two that touch the byte the one that begins there.
        let touches = |at: &At| {
            let range = self.range_of(*at, &self.view.starts);
            range.start <= offset && offset <= range.end
        };
        let run = self.run_at(offset);
        let entries = self
            .runs
            .get(run)?
            .entries
            .iter()
            .enumerate()
            .filter(|(_, entry)| entry.block().is_some());
        let is_in_program = |at: &At| self.view.end.is_none_or(|end| *at < end);
        entries
            .map(|(entry, _)| At { run, entry })
            .rfind(|at| touches(at) && is_in_program(at))
    }

    /// Blocks of a section before one of its entries.
    fn count_before(&self, section: &Section, at: At) -> usize {
        let mut count = 0;
        for run in section.parts[0].0..=at.run {
            let Some(of) = self.runs.get(run) else { break };
            let parts = if run == section.parts[0].0 {
                section.parts[0].1..
            } else {
                0..
            };
            for part in of.parts.get(parts).unwrap_or_default() {
                if (At {
                    run,
                    entry: part.entries.end,
                }) <= at
                {
                    count += part.sum.blocks;
                } else if (At {
                    run,
                    entry: part.entries.start,
                }) <= at
                {
                    let before = of
                        .entries
                        .get(part.entries.start..at.entry.min(part.entries.end));
                    count += before
                        .unwrap_or_default()
                        .iter()
                        .filter(|entry| entry.block().is_some())
                        .count();
                }
            }
        }
        count
    }

    /// The blocks of a section, up to an entry where one is named, by their ends.
    pub(super) fn chain(&self, section: &Section, until: Option<At>) -> Option<Chain<'static>> {
        let end = until.unwrap_or(At {
            run: usize::MAX,
            entry: 0,
        });
        let [(first_run, first_part), (last_run, last_part)] = section.parts;
        // Entries of the section in a run, as far as they count.
        let entries = |run: usize| -> Range<usize> {
            let Some(of) = self.runs.get(run) else {
                return 0..0;
            };
            let from = if run == first_run {
                of.parts
                    .get(first_part)
                    .map_or(0, |part| part.entries.start)
            } else {
                0
            };
            let to = if run == last_run {
                of.parts.get(last_part).map_or(0, |part| part.entries.end)
            } else {
                of.entries.len()
            };
            let to = if run == end.run {
                to.min(end.entry)
            } else {
                to
            };
            from..to.max(from)
        };
        let last_run = last_run.min(end.run);
        let blocks_in = |run: usize| {
            let of = self.runs.get(run).map_or(&[][..], |of| &of.entries[..]);
            of.get(entries(run))
                .unwrap_or_default()
                .iter()
                .filter_map(Entry::block)
        };
        let is_whole = |run: usize| run != first_run && run != last_run;
        let (mut count, mut arcs, mut travel) = (0, 0, Move::default());
        for run in first_run..=last_run {
            match self
                .runs
                .get(run)
                .filter(|of| is_whole(run) && of.parts.len() == 1)
            {
                Some(of) => {
                    let sum = &of.parts[0].sum;
                    (count, arcs, travel) =
                        (count + sum.blocks, arcs + sum.arcs, travel.plus(sum.travel));
                }
                None => blocks_in(run).for_each(|block| {
                    (count, arcs, travel) = (
                        count + 1,
                        arcs + usize::from(!block.is_line()),
                        travel.plus(block.travel),
                    );
                }),
            }
        }
        // Runs that hold the first and the last blocks.
        let (mut head_end, mut held) = (first_run, 0);
        while head_end <= last_run && held < Chain::ENDS {
            held += blocks_in(head_end).count();
            head_end += 1;
        }
        let (mut tail_start, mut held) = (last_run + 1, 0);
        while tail_start > head_end && held < Chain::ENDS {
            tail_start -= 1;
            held += blocks_in(tail_start).count();
        }
        let mut walk = self.walk();
        (0..first_run).for_each(|run| walk.skip(run));
        let steps_of = |runs: Range<usize>, walk: &mut Walk<'_>| {
            let mut steps = Vec::new();
            for run in runs {
                let own = entries(run);
                walk.run(run, |_| true, &mut |step| steps.push((run, step)));
                let range = |entry: usize| self.range_of(At { run, entry }, &self.view.starts);
                let (from, to) = (
                    range(own.start).start,
                    own.end.checked_sub(1).map_or(0, |last| range(last).end),
                );
                steps.retain(|(of, step)| {
                    *of != run
                        || (step.moves()
                            && step.range.start >= from
                            && step.range.end <= to
                            && !own.is_empty())
                });
            }
            steps
                .into_iter()
                .map(|(_, step)| step)
                .collect::<Vec<Step>>()
        };
        let head = steps_of(first_run..head_end.max(first_run), &mut walk);
        (head_end..tail_start).for_each(|run| walk.skip(run));
        let tail = steps_of(tail_start..(last_run + 1).max(tail_start), &mut walk);
        let [x, y] = travel.meant_um();
        let stop = SectionWay::of(self, section)
            .stop()
            .filter(|stop| *stop < count);
        (count > 0)
            .then(|| Chain::by_ends(head, tail, (count, arcs), Vector::new(x, y)).stopping(stop))
    }

    fn walk(&self) -> Walk<'_> {
        let mut starts = self
            .runs
            .iter()
            .take_while(|run| run.blocks == 0)
            .chain(self.runs.iter().find(|run| run.blocks > 0));
        let start = starts.find_map(|run| {
            run.entries
                .iter()
                .take_while(|entry| entry.block().is_none())
                .find_map(|entry| match entry.what {
                    What::StartPoint(at) => Some(at),
                    _ => None,
                })
        });
        let [x, y] = start.unwrap_or([0.0, 0.0]).map(|mm| (mm * 1000.0).round());
        Walk {
            document: self,
            at: Point::new(x, y),
            start_is_known: start.is_some(),
            section: 0,
        }
    }
}

/// The machine on its way through the program.
struct Walk<'a> {
    document: &'a Document,
    at: Point,
    start_is_known: bool,
    section: usize,
}

impl Walk<'_> {
    /// Goes through a run, and hands out the steps whose bytes are `wanted`.
    fn run(
        &mut self,
        index: usize,
        wanted: impl Fn(&Range<usize>) -> bool,
        each: &mut dyn FnMut(Step),
    ) {
        let document = self.document;
        let Some(run) = document.runs.get(index) else {
            return;
        };
        let (base, first_line) = document.view.starts.get(index).copied().unwrap_or_default();
        let mut part = 0;
        let mut is_jump = document.is_jump((index, 0));
        for (entry_index, entry) in run.entries.iter().enumerate() {
            let at = At {
                run: index,
                entry: entry_index,
            };
            if document.view.end.is_some_and(|end| at > end) {
                return;
            }
            let range = entry.range().start + base..entry.range().end + base;
            let (line, number, contour, start) = (
                first_line + entry.line as usize,
                entry.number(),
                self.section,
                self.at,
            );
            match &entry.what {
                What::Block(block) => {
                    let [x, y] = block.travel.machine;
                    let end = start + Vector::new(x as f64, y as f64);
                    self.at = end;
                    if wanted(&range) {
                        let kind = match block.is_line() {
                            _ if is_jump => Kind::Rapid,
                            true => Kind::Line,
                            false => Kind::Arc,
                        };
                        each(Step {
                            range,
                            line,
                            number,
                            kind,
                            start,
                            end,
                            ideal: meant(&block.block, start),
                            contour,
                        });
                    }
                }
                What::Word { .. } => {
                    let kind = if document.view.end == Some(at) {
                        Kind::End
                    } else {
                        Kind::Pause
                    };
                    if wanted(&range) {
                        each(Step {
                            range,
                            line,
                            number,
                            kind,
                            start,
                            end: start,
                            ideal: None,
                            contour,
                        });
                    }
                    part += 1;
                    self.section += usize::from(!document.is_tab((index, part)));
                    is_jump = document.is_jump((index, part));
                }
                What::StartPoint(_)
                | What::Text { .. }
                | What::CommentedBlock { .. }
                | What::Unread => {}
            }
        }
    }

    /// Goes through a run without a look.
    fn skip(&mut self, index: usize) {
        let Some(run) = self.document.runs.get(index) else {
            return;
        };
        if self.document.view.end.is_some_and(|end| end.run <= index) {
            return self.run(index, |_| false, &mut |_| {});
        }
        let [x, y] = run.travel.machine;
        self.at += Vector::new(x as f64, y as f64);
        let tabs = &self.document.view.tabs;
        let before = |run: usize| tabs.partition_point(|tab| tab.0 < run);
        self.section += run.words - (before(index + 1) - before(index)).min(run.words);
    }
}
