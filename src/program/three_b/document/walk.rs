//! The machine on its way through a program.

use super::super::decode::meant;
use super::super::entry::{BlockEntry, Entry, What};
use super::super::pieces::{Field, pieces};
use super::super::words::switch;
use super::{At, Document};
use crate::geometry::{Point, Vector};
use crate::program::path::{Kind, Step, Trace, Writing};
use crate::program::steps::{self, Program};
use crate::text::{SourceText, says_anything};
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
        let mut all = self.all_entries();
        let (at, entry) = all.find(|(_, entry)| is_of_part(entry))?;
        Some(self.line_of(at, entry))
    }

    /// The switches of pump and wire, each with its line, and whether remarks stand in the text.
    pub(in crate::program) fn beside_blocks(&self) -> (Vec<(usize, String)>, bool) {
        let words = self.words();
        let (mut switches, mut has_comments) = (Vec::new(), false);
        for line in 0..self.text.line_count() {
            let bytes = self.text.line(line);
            let all = pieces(bytes, &words).into_iter();
            for piece in all.filter(|piece| piece.field == Field::Comment) {
                let mut own = bytes.get(piece.range).unwrap_or_default().trim_ascii();
                while let Some((word, behind)) =
                    switch(own).and_then(|len| own.split_at_checked(len))
                {
                    switches.push((line, String::from_utf8_lossy(word).into_owned()));
                    own = behind.trim_ascii_start();
                }
                has_comments |= says_anything(own);
            }
        }
        (switches, has_comments)
    }

    /// The heading with the start, before the first block, and the start in mm.
    fn heading(&self) -> Option<(At, [f64; 2])> {
        let entries = self.all_entries();
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

    /// Whether end points stand after blocks.
    pub(in crate::program) fn states_ends(&self) -> bool {
        let mut blocks = self.all_entries().filter_map(|(_, entry)| entry.block());
        blocks.any(|block| block.stated_end().is_some())
    }

    /// The line of an entry, from 0.
    fn line_of(&self, at: At, entry: &Entry) -> usize {
        let first = self.text.line_of(self.cuts.byte(at.cut));
        first + entry.line as usize
    }

    /// The machine's position before each cut, µm.
    pub(super) fn begins(&self, taken: &[(At, Vector)]) -> Vec<Point> {
        let (mut at, _) = self.begin();
        let mut taken = taken.iter().peekable();
        let begins = self.cuts.iter().enumerate().map(|(index, cut)| {
            let before = at;
            let [x, y] = cut.travel.machine;
            at += Vector::new(x as f64, y as f64);
            while let Some((_, by)) = taken.next_if(|(of, _)| of.cut == index) {
                at += by;
            }
            before
        });
        begins.collect()
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
        let cut = self.cuts.iter().position(|cut| cut.rare().unread > 0)?;
        let mut entries = self.entries(cut..cut + 1);
        let (at, entry) = entries.find(|(_, entry)| entry.what == What::Unread)?;
        Some(self.line_of(at, entry))
    }

    /// Those up to the word that ends the program.
    fn cut_count(&self) -> usize {
        self.view.end.map_or(self.cuts.len(), |end| end.cut + 1)
    }

    fn cuts_at(&self, line: usize) -> Vec<usize> {
        let from = self.cuts.first_at(line);
        let holds = |cut: &usize| self.cuts.lines(*cut).contains(&line);
        (from..self.cut_count()).take_while(holds).collect()
    }

    fn first_behind(&self, line: usize) -> usize {
        self.cuts.first_at(line)
    }

    fn contours_in(&self, cut: usize) -> usize {
        usize::from(self.cuts[cut].stop.is_some() && !self.view.contours.goes_on(cut))
    }

    fn has_steps(&self, cut: usize) -> bool {
        self.cuts[cut].stop.is_some() || self.cuts[cut].blocks > 0
    }

    fn walk(&self, cut: usize, contour: &mut usize, each: &mut dyn FnMut(Step)) {
        let Some(&begin) = self.view.begins.get(cut) else {
            return;
        };
        let mut start = begin;
        let is_jump = self.is_jump(cut);
        for (own, what) in self.entries(cut..cut + 1) {
            if self.view.end.is_some_and(|end| own > end) {
                return;
            }
            let block = what.block();
            let fine = block.and_then(BlockEntry::stated_end);
            let fine = fine.filter(|stated| stated.decimals >= 3);
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
                line: self.line_of(own, what),
                number: what.number(),
                end,
                ideal,
                contour: *contour,
                part_side: block.and_then(BlockEntry::side_of_wire),
                is_relative: true,
                stated: fine.map(|stated| {
                    let [x, y] = stated.at.map(|mm| (mm * 1e6).round() / 1e3);
                    Point::new(x, y)
                }),
                ..Step::stop(kind, start)
            });
            start = end;
            if let What::Word { .. } = what.what {
                *contour += usize::from(!self.view.contours.goes_on(cut));
            }
        }
    }
}
