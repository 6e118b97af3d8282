//! The machine on its way through a program.

use super::super::around::StatedPoint;
use super::super::decode::meant;
use super::super::entry::{Entry, What};
use super::super::pieces::{Field, pieces};
use super::super::sum::is_jump;
use super::{At, Document, View};
use crate::finding::Side;
use crate::geometry::{Point, Vector};
use crate::program::chunks::Reread;
use crate::program::path::{Kind, Step, Trace, Writing};
use crate::program::steps::{self, Program, Sum};
use crate::text::{SourceText, says_anything};
use rustc_hash::FxHashMap;
use std::ops::Range;

impl Document {
    /// The machine's way, block by block, up to the end word.
    pub fn trace(&self) -> Trace {
        steps::trace(self)
    }

    /// The steps whose text overlaps or touches a range of bytes.
    pub(crate) fn steps_in(&self, range: Range<usize>) -> Vec<Step> {
        steps::steps_in(self, range)
    }

    /// The line of the first block of 4B, from 0.
    pub(crate) fn first_four_b_line(&self) -> Option<usize> {
        let is_of_part = |entry: &Entry| entry.block().is_some_and(|block| block.part().is_some());
        let mut all = self.entries(0..self.stretches.len());
        let (at, entry) = all.find(|(_, entry)| is_of_part(entry))?;
        Some(self.stretches.place(at.stretch).lines.start + entry.line as usize)
    }

    /// On which side of the arcs of the part the wire runs in 4B, by the byte at which their blocks begin.
    pub(in crate::program) fn part_sides(&self) -> FxHashMap<usize, Side> {
        let all = self.entries(0..self.stretches.len());
        let of_part = all.filter_map(|(at, entry)| Some((at, entry.block()?.side_of_wire()?)));
        of_part
            .map(|(at, side)| (self.range_of(at).start, side))
            .collect()
    }

    /// True where remarks stand in the text.
    pub(in crate::program) fn has_comments(&self) -> bool {
        let words = self.words();
        (0..self.text.line_count()).any(|line| {
            let bytes = self.text.line(line);
            let all = pieces(bytes, &words);
            all.iter().any(|piece| {
                let own = bytes.get(piece.range.clone()).unwrap_or_default();
                piece.field == Field::Comment && says_anything(own)
            })
        })
    }

    /// The heading with the start, before the first block, and the start in mm.
    fn heading(&self) -> Option<(At, [f64; 2])> {
        let entries = self.entries(0..self.stretches.len());
        let mut before = entries.take_while(|(_, entry)| entry.block().is_none());
        before.find_map(|(at, entry)| match entry.what {
            What::StartPoint(start) => Some((at, start)),
            _ => None,
        })
    }

    /// Bytes of that heading.
    pub(in crate::program) fn header(&self) -> Option<Range<usize>> {
        self.heading().map(|(at, _)| self.range_of(at))
    }

    /// The end points after blocks, each with the byte at which its block begins.
    pub(in crate::program) fn stated_ends(&self) -> impl Iterator<Item = (usize, StatedPoint)> {
        let all = self.entries(0..self.stretches.len());
        all.filter_map(|(at, entry)| Some((self.range_of(at).start, entry.block()?.stated_end()?)))
    }

    /// The machine's position before each stretch, µm.
    pub(super) fn begins(&self, taken: &[(At, Vector)]) -> Vec<Point> {
        let (mut at, _) = self.begin();
        let mut taken = taken.iter().peekable();
        let begins = self.stretches.iter().enumerate().map(|(index, stretch)| {
            let before = at;
            let [x, y] = stretch.travel.machine;
            at += Vector::new(x as f64, y as f64);
            while let Some((_, by)) = taken.next_if(|(at, _)| at.stretch == index) {
                at += by;
            }
            before
        });
        begins.collect()
    }

    /// The first stretch that was read again, or in which the machine does not stand as it stood `before`.
    pub(super) fn first_moved(&self, before: &View, reread: &Reread) -> usize {
        if self.view.begins.first() != before.begins.first() {
            return 0;
        }
        let elsewhere = self.taken_elsewhere(&before.taken, reread);
        elsewhere
            .min()
            .map_or(reread.chunks.start, |first| first.min(reread.chunks.start))
    }

    /// How far the wire was taken before a block, µm.
    pub(super) fn taken_before(&self, at: At) -> Option<Vector> {
        let taken = &self.view.taken;
        let found = taken.binary_search_by_key(&at, |(at, _)| *at).ok()?;
        Some(taken.get(found)?.1)
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
        let start = self.heading().map(|(_, start)| start);
        let [x, y] = start.unwrap_or([0.0, 0.0]).map(|mm| (mm * 1000.0).round());
        (Point::new(x, y), start.is_some())
    }

    fn unread_line(&self) -> Option<usize> {
        let stretch = self.stretches.iter().position(|of| of.unread > 0)?;
        let entries = &self.stretches.get(stretch)?.entries;
        let entry = entries.iter().find(|entry| entry.what == What::Unread)?;
        Some(self.stretches.place(stretch).lines.start + entry.line as usize)
    }

    fn chunk_count(&self) -> usize {
        self.stretches.len()
    }

    fn lines_of(&self, stretch: usize) -> Range<usize> {
        self.stretches.place(stretch).lines
    }

    fn sum_of(&self, stretch: usize) -> Sum {
        let is_behind_end = self.view.end.is_some_and(|end| end.stretch < stretch);
        let Some(of) = self.stretches.get(stretch).filter(|_| !is_behind_end) else {
            return Sum::default();
        };
        let own_tabs = match of.words {
            0 => 0,
            _ => self.view.contours.tabs_in(stretch),
        };
        let may_be_jump =
            of.words == 0 && of.parts.first().is_some_and(|part| is_jump(&of.sum(part)));
        let is_rapid = may_be_jump && self.is_jump((stretch, 0));
        Sum {
            moves: of.blocks,
            arcs: of.arcs,
            rapids: if is_rapid { of.blocks } else { 0 },
            stops: of.words,
            contours: of.words.saturating_sub(own_tabs),
            travel: of.travel.meant,
        }
    }

    fn walk(&self, stretch: usize, contour: &mut usize, each: &mut dyn FnMut(Step)) {
        let (Some(of), Some(&begin)) = (self.stretches.get(stretch), self.view.begins.get(stretch))
        else {
            return;
        };
        let first_line = self.stretches.place(stretch).lines.start;
        let mut start = begin;
        let mut part = 0;
        let mut is_jump = self.is_jump((stretch, 0));
        for (entry, what) in of.entries.iter().enumerate() {
            let own = At { stretch, entry };
            if self.view.end.is_some_and(|end| own > end) {
                return;
            }
            let (kind, end, ideal) = match &what.what {
                What::Block(block) => {
                    start += self.taken_before(own).unwrap_or_default();
                    let [x, y] = block.travel().machine;
                    let kind = match block.is_line() {
                        _ if is_jump => Kind::Rapid,
                        true => Kind::Line,
                        false => Kind::Arc,
                    };
                    let end = start + Vector::new(x as f64, y as f64);
                    (kind, end, meant(&block.block(), start))
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
                end,
                ideal,
                contour: *contour,
                is_relative: true,
                ..Step::stop(kind, start)
            });
            start = end;
            if let What::Word { .. } = what.what {
                part += 1;
                *contour += usize::from(!self.is_tab((stretch, part)));
                is_jump = self.is_jump((stretch, part));
            }
        }
    }
}
