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

/// Answers for several places: the last cut read is kept.
pub(crate) struct Whereabouts<'a> {
    program: &'a dyn Program,
    /// After this line the position is unknown; it is only searched for when needed.
    lost: Option<usize>,
    cut: Option<usize>,
    steps: Vec<Step>,
    /// Where the machine starts; only where there are steps.
    begin: Option<Option<Point>>,
}

impl<'a> Whereabouts<'a> {
    pub(super) fn within(program: &'a dyn Program) -> Whereabouts<'a> {
        Whereabouts {
            program,
            lost: None,
            cut: None,
            steps: Vec::new(),
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
        let at = program.cuts_at(line);
        // The cut read last mostly holds the next place, too.
        let held = self.cut.filter(|cut| at.contains(cut));
        let is_of_it = |step: &Step| step.range.end > range.start && step.range.start < range.end;
        for &cut in held.iter().chain(&at) {
            if let Some(step) = self.steps_of(cut).iter().find(|step| is_of_it(step)) {
                return Some(Stand {
                    start: in_mm(step.start),
                    end: step.moves().then(|| in_mm(step.end)),
                });
            }
        }
        // No step is here: the machine stands where the last one before ends, in whichever cut that is.
        let cut = held.or_else(|| at.first().copied())?;
        let is_before = |step: &&Step| step.range.end <= range.start;
        let own = self.steps_of(cut).iter().take_while(is_before).last();
        let mut before = own.map(|step| step.end);
        if before.is_none() {
            before = match (0..cut).rev().find(|cut| program.has_steps(*cut)) {
                Some(earlier) => self.steps_of(earlier).last().map(|step| step.end),
                None => *self.begin.get_or_insert_with(|| {
                    let mut all = 0..program.cut_count();
                    let has_steps = all.any(|cut| program.has_steps(cut));
                    has_steps.then(|| program.begin().0)
                }),
            };
        }
        Some(Stand {
            start: in_mm(before?),
            end: None,
        })
    }

    fn steps_of(&mut self, cut: usize) -> &[Step] {
        if self.cut != Some(cut) {
            self.cut = Some(cut);
            self.steps.clear();
            let steps = &mut self.steps;
            self.program.walk(cut, &mut 0, &mut |step| steps.push(step));
        }
        &self.steps
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
    fn a_place_has_one_position_whichever_was_asked_for_before() {
        for head in ["", "G00 X1. Y2.\n"] {
            let calls: String = (2..200).map(|number| format!("M98 P{number}\n")).collect();
            let text = format!("G90\nG92 X0. Y0.\n{head}{calls}M30\n");
            let document = Document::read(text.into_bytes());
            let mut whereabouts = Whereabouts::within(&document);
            let findings = document.findings();
            assert!(findings.len() >= 190, "{}", findings.len());
            for finding in findings {
                let Some(range) = finding.place.in_text() else {
                    continue;
                };
                let stand = whereabouts.of(range);
                assert_eq!(Whereabouts::within(&document).of(range), stand);
            }
        }
    }
}
