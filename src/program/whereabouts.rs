//! The machine's position at a finding of a program's text.

use super::path::Step;
use super::steps::Program;
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
}

impl<'a> Whereabouts<'a> {
    pub(super) fn within(program: &'a dyn Program) -> Whereabouts<'a> {
        Whereabouts {
            program,
            lost: None,
            chunk: None,
            steps: Vec::new(),
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
            let has_steps = |chunk: &usize| !program.sum_of(*chunk).is_empty();
            let earlier = (0..chunk).rev().find(has_steps);
            before = match earlier {
                Some(earlier) => self.steps_of(earlier).last().map(|step| step.end),
                None => (0..program.chunk_count())
                    .any(|chunk| has_steps(&chunk))
                    .then(|| program.begin().0),
            };
        }
        Some(Stand {
            start: in_mm(before?),
            end: None,
        })
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
