//! The machine on its way through a program.

use super::super::decode::meant;
use super::super::entry::{Entry, What};
use super::super::run::is_jump;
use super::{At, Document};
use crate::geometry::{Point, Vector};
use crate::program::path::{Kind, Step, Trace, Writing};
use crate::program::steps::{self, Program, Sum};
use crate::text::SourceText;
use std::ops::Range;

impl Document {
    /// Where the machine goes, block by block, up to the end word.
    pub fn trace(&self) -> Trace {
        steps::trace(self)
    }

    /// The steps whose text overlaps or touches a range of bytes.
    pub(crate) fn steps_in(&self, range: Range<usize>) -> Vec<Step> {
        steps::steps_in(self, range)
    }

    /// The line of the first block of 4B, from 0.
    pub(in crate::program) fn first_four_b_line(&self) -> Option<usize> {
        let is_of_part = |entry: &Entry| entry.block().is_some_and(|block| block.part().is_some());
        let mut all = self.entries(0..self.runs.len());
        let (at, entry) = all.find(|(_, entry)| is_of_part(entry))?;
        Some(self.runs.place(at.run).lines.start + entry.line as usize)
    }

    /// Where the machine stands before each run, µm.
    pub(super) fn begins(&self) -> Vec<Point> {
        let (mut at, _) = self.begin();
        let begins = self.runs.iter().map(|run| {
            let before = at;
            let [x, y] = run.travel.machine;
            at += Vector::new(x as f64, y as f64);
            before
        });
        begins.collect()
    }
}

impl Program for Document {
    fn text(&self) -> &SourceText {
        &self.text
    }

    fn writing(&self) -> Writing {
        Writing::default()
    }

    fn begin(&self) -> (Point, bool) {
        let entries = self.entries(0..self.runs.len());
        let mut heading = entries.take_while(|(_, entry)| entry.block().is_none());
        let start = heading.find_map(|(_, entry)| match entry.what {
            What::StartPoint(at) => Some(at),
            _ => None,
        });
        let [x, y] = start.unwrap_or([0.0, 0.0]).map(|mm| (mm * 1000.0).round());
        (Point::new(x, y), start.is_some())
    }

    fn chunk_count(&self) -> usize {
        self.runs.len()
    }

    fn lines_of(&self, run: usize) -> Range<usize> {
        self.runs.place(run).lines
    }

    fn sum_of(&self, run: usize) -> Sum {
        let is_behind_end = self.view.end.is_some_and(|end| end.run < run);
        let Some(of) = self.runs.get(run).filter(|_| !is_behind_end) else {
            return Sum::default();
        };
        let tabs = &self.view.tabs;
        let tabs_before = |run: usize| tabs.partition_point(|tab| tab.0 < run);
        let own_tabs = match tabs.is_empty() || of.words == 0 {
            true => 0,
            false => tabs_before(run + 1) - tabs_before(run),
        };
        let may_be_jump = of.words == 0 && of.parts.first().is_some_and(|part| is_jump(&part.sum));
        let is_rapid = may_be_jump && self.is_jump((run, 0));
        Sum {
            moves: of.blocks,
            arcs: of.arcs,
            rapids: if is_rapid { of.blocks } else { 0 },
            stops: of.words,
            contours: of.words.saturating_sub(own_tabs),
            travel: of.travel.meant,
        }
    }

    fn walk(&self, run: usize, contour: &mut usize, each: &mut dyn FnMut(Step)) {
        let (Some(of), Some(&begin)) = (self.runs.get(run), self.view.begins.get(run)) else {
            return;
        };
        let first_line = self.runs.place(run).lines.start;
        let mut start = begin;
        let mut part = 0;
        let mut is_jump = self.is_jump((run, 0));
        for (entry, what) in of.entries.iter().enumerate() {
            let own = At { run, entry };
            if self.view.end.is_some_and(|end| own > end) {
                return;
            }
            let (kind, end, ideal) = match &what.what {
                What::Block(block) => {
                    let [x, y] = block.travel.machine;
                    let kind = match block.is_line() {
                        _ if is_jump => Kind::Rapid,
                        true => Kind::Line,
                        false => Kind::Arc,
                    };
                    let end = start + Vector::new(x as f64, y as f64);
                    (kind, end, meant(&block.block, start))
                }
                What::Word { .. } if self.view.end == Some(own) => (Kind::End, start, None),
                What::Word { .. } => (Kind::Pause, start, None),
                What::StartPoint(_)
                | What::Text { .. }
                | What::CommentedBlock { .. }
                | What::Unread => continue,
            };
            each(Step {
                range: self.range_of(own),
                line: first_line + what.line as usize,
                number: what.number(),
                kind,
                start,
                end,
                ideal,
                contour: *contour,
                side: None,
                is_relative: true,
            });
            start = end;
            if let What::Word { .. } = what.what {
                part += 1;
                *contour += usize::from(!self.is_tab((run, part)));
                is_jump = self.is_jump((run, part));
            }
        }
    }
}
