//! What a program does, noted block by block while it is written: a comparison then need not read the text.

use super::path::{Kind, Step, Trace, Writing};
use crate::geometry::Point;
use std::ops::Range;

/// What the machine does at each block as it is written: the trace that reading the text would
/// give, except for what only the whole text shows. Lines are not counted.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    pub(crate) steps: Vec<Step>,
    /// Where the program says that it begins.
    pub(crate) start: Option<Point>,
    pub(crate) writing: Writing,
    /// Stops so far.
    stops: usize,
    /// A block of 4B is among them.
    pub(crate) four_b: bool,
}

impl Notes {
    /// Where the machine stands.
    pub(crate) fn at(&self) -> Point {
        let last = self.steps.last().map(|step| step.end);
        last.or(self.start).unwrap_or_default()
    }

    /// The machine moves, or it stops.
    pub(crate) fn note(&mut self, step: Step) {
        let is_stop = step.kind == Kind::Pause;
        self.steps.push(Step {
            contour: self.stops,
            ..step
        });
        self.stops += usize::from(is_stop);
    }

    /// The machine stops at a word.
    pub(crate) fn stop(&mut self, range: Range<usize>, at: Point, is_end: bool) {
        self.note(Step {
            range,
            ..Step::stop(if is_end { Kind::End } else { Kind::Pause }, at)
        });
    }

    /// The way through a written text.
    pub(crate) fn into_trace(self, text: &[u8]) -> Trace {
        let Notes {
            mut steps,
            start,
            writing,
            ..
        } = self;
        let (mut line, mut read) = (0, 0);
        for step in &mut steps {
            let before = text.get(read..step.range.start).unwrap_or_default();
            line += memchr::memchr_iter(b'\n', before).count();
            read = step.range.start;
            step.line = line;
        }
        Trace {
            steps,
            start: start.unwrap_or_default(),
            start_is_known: start.is_some(),
            writing,
            ..Trace::default()
        }
    }
}
