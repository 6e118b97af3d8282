//! The machine's position at a finding of a program's text.

use super::path::Step;
use super::steps::Program;
use super::work::{self, Work};
use crate::geometry::{Point, Vector};
use std::ops::Range;

/// The machine's position before a place of the text, and after the block there, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stand {
    pub(crate) start: Point,
    pub(crate) end: Option<Point>,
}

/// Answers for several places: the last chunk read is kept.
pub(crate) struct Whereabouts<'a> {
    program: &'a dyn Program,
    /// After this line the position is unknown; it is only searched for when needed.
    lost: Option<usize>,
    chunk: Option<usize>,
    steps: Vec<Step>,
    /// Chunks without steps, all those behind one with steps, or from the first on.
    empty: Range<usize>,
    /// Where the machine stands before all steps, once that was needed; `None` where there are none.
    begin: Option<Option<Point>>,
}

impl<'a> Whereabouts<'a> {
    pub(super) fn within(program: &'a dyn Program) -> Whereabouts<'a> {
        Whereabouts {
            program,
            lost: None,
            chunk: None,
            steps: Vec::new(),
            empty: 0..0,
            begin: None,
        }
    }

    pub(crate) fn of(&mut self, range: &Range<usize>) -> Option<Stand> {
        let program = self.program;
        let line = program.text().line_of(range.start);
        let unread = || program.unread_line().unwrap_or(usize::MAX);
        if line > *self.lost.get_or_insert_with(unread) {
            return None;
        }
        let chunk = self.chunk_of(line)?;
        let is_before = |step: &&Step| step.range.end <= range.start;
        let steps = self.steps_of(chunk);
        if let Some(step) = steps.iter().find(|step| !is_before(step))
            && step.range.start < range.end
        {
            return Some(Stand {
                start: in_mm(step.start),
                end: step.moves().then(|| in_mm(step.end)),
            });
        }
        // No step is here: the machine stands where the last one before ends, in whichever chunk that is.
        let mut before = steps
            .iter()
            .take_while(is_before)
            .last()
            .map(|step| step.end);
        if before.is_none() {
            before = match self.with_steps_before(chunk) {
                Some(earlier) => self.steps_of(earlier).last().map(|step| step.end),
                None => *self.begin.get_or_insert_with(|| {
                    let mut chunks = 0..program.chunk_count();
                    let has_steps = |chunk| !program.sum_of(chunk).is_empty();
                    chunks.any(has_steps).then(|| program.begin().0)
                }),
            };
        }
        Some(Stand {
            start: in_mm(before?),
            end: None,
        })
    }

    /// The last chunk before one that has steps. Those that are passed on the way are not looked at again for the next place.
    fn with_steps_before(&mut self, chunk: usize) -> Option<usize> {
        let mut first = chunk;
        while let Some(before) = first.checked_sub(1) {
            work::add(Work::ChunksPassed, 1);
            if self.empty.contains(&before) {
                first = self.empty.start;
            } else if self.program.sum_of(before).is_empty() {
                first = before;
            } else {
                break;
            }
        }
        self.empty = first..chunk;
        first.checked_sub(1)
    }

    fn steps_of(&mut self, chunk: usize) -> &[Step] {
        if self.chunk != Some(chunk) {
            self.chunk = Some(chunk);
            self.steps.clear();
            let steps = &mut self.steps;
            self.program
                .walk(chunk, &mut 0, &mut |step| steps.push(step));
        }
        &self.steps
    }

    /// The first chunk that holds a line: where the chunks run in the order of the text, not all are searched for it.
    fn chunk_of(&self, line: usize) -> Option<usize> {
        let count = self.program.chunk_count();
        let holds = |chunk: &usize| self.program.lines_of(*chunk).contains(&line);
        let (mut from, mut to) = (0, count);
        while from < to {
            let middle = from.midpoint(to);
            match self.program.lines_of(middle).end <= line {
                true => from = middle + 1,
                false => to = middle,
            }
        }
        let at_hand = self.chunk.into_iter().chain([from]);
        at_hand.chain(0..count).find(holds)
    }
}

fn in_mm(point: Point) -> Point {
    Point::origin() + Vector::new(point.x, point.y) / 1e3
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::iso::Document;

    #[test]
    fn chunks_without_steps_are_passed_once() {
        for head in ["", "G00 X1. Y2.\n"] {
            let calls: String = (2..2_002)
                .map(|number| format!("M98 P{number}\n"))
                .collect();
            let text = format!("G90\nG92 X0. Y0.\n{head}{calls}M30\n");
            let document = Document::read(text.into_bytes());
            let mut whereabouts = Whereabouts::within(&document);
            let findings = document.findings();
            assert!(findings.len() >= 2_000, "{}", findings.len());
            let mut places: Vec<Range<usize>> = Vec::new();
            for finding in findings {
                let crate::finding::Place::Text { range } = finding.place else {
                    continue;
                };
                places.push(range);
            }
            work::take(Work::ChunksPassed);
            let stands: Vec<_> = places.iter().map(|range| whereabouts.of(range)).collect();
            let (chunks, passed) = (document.chunk_count(), work::take(Work::ChunksPassed));
            assert!(passed <= 3 * chunks, "{passed} {chunks}");
            for (range, stand) in places.iter().zip(stands) {
                assert_eq!(Whereabouts::within(&document).of(range), stand);
            }
        }
    }
}
