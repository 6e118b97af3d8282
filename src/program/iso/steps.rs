//! A running ISO program: the moves of its lines, the state at a line, and the cut in progress there.

use super::block::Stop;
use super::document::Document;
use super::machine::{Machine, Ran};
use super::moves::{Move, micrometres};
use crate::finding::{Rule, Severity};
use crate::geometry::Point;
use crate::program::path::{Kind, Step, Trace, Way, Writing};
use crate::program::report::place_of;
use crate::program::steps::{self, Program};
use crate::text::SourceText;

impl Document {
    /// The machine's way, move by move.
    pub fn trace(&self) -> Trace {
        steps::trace(self)
    }

    /// Hands out the lines of a cut that run.
    pub(super) fn run_lines(&self, cut: usize, each: &mut dyn FnMut(&Ran<'_>)) {
        self.run_again(cut, self.cuts.lines(cut).end, each);
    }

    /// Hands out the moves in the order in which they run, each with its line and the state after it.
    pub(crate) fn moves(&self, each: &mut dyn FnMut(usize, Move, &Machine)) {
        for cut in 0..self.cuts.len() {
            self.run_lines(cut, &mut |ran| {
                for made in ran.moves() {
                    each(ran.line, made, ran.machine);
                }
            });
        }
    }

    /// True where the control makes corners of its own.
    pub(crate) fn has_corners(&self) -> bool {
        self.cuts.iter().any(|cut| cut.has_corners)
    }

    // The state at a line.

    /// The state before a line, with the wire's position; `None` for a line that does not run.
    pub(crate) fn machine_before(&self, line: usize) -> Option<Machine> {
        self.run_up_to(line, false).map(|(_, run)| run.after)
    }

    /// The state after a line.
    pub(crate) fn machine_behind(&self, line: usize) -> Option<Machine> {
        self.run_up_to(line, true).map(|(_, run)| run.after)
    }

    /// The cut in progress before a line, µm.
    pub(crate) fn begun_cut(&self, line: usize) -> Way {
        steps::way_before(self, self.text().line_start(line))
    }

    /// The cut in progress after a line.
    pub(crate) fn begun_cut_with(&self, line: usize) -> Way {
        steps::way_before(self, self.text().line_range(line).end)
    }
}

impl Program for Document {
    fn text(&self) -> &SourceText {
        Document::text(self)
    }

    fn writing(&self) -> Writing {
        self.reading().writing()
    }

    fn begin(&self) -> (Point, bool) {
        let mut begin = None;
        if let Some(first) = (0..self.cuts.len()).find(|cut| self.has_steps(*cut)) {
            self.run_lines(first, &mut |ran| {
                if ran.step_count() > 0 && begin.is_none() {
                    let from = ran.moves().next().map_or(ran.machine.at, |made| made.from);
                    begin = Some((micrometres(from), ran.machine.stated));
                }
            });
        }
        begin.unwrap_or((Point::origin(), false))
    }

    fn unread_line(&self) -> Option<usize> {
        self.cuts.iter().enumerate().find_map(|(index, cut)| {
            let fault = cut.rare().faults.iter().find(|fault| {
                fault.severity == Severity::Error
                    && matches!(fault.rule, Rule::Syntax | Rule::TooManyDigits)
            })?;
            let (start, _) = place_of(fault);
            Some(self.text().line_of(self.cuts.byte(index) + start))
        })
    }

    fn cut_count(&self) -> usize {
        self.cuts.len()
    }

    fn cuts_at(&self, line: usize) -> Vec<usize> {
        let mut cuts: Vec<usize> = match self.order() {
            None => vec![self.cuts.first_at(line)],
            Some(order) => order
                .of_line(line)
                .map(|nth| self.cuts.first_at(nth))
                .collect(),
        };
        cuts.retain(|cut| *cut < self.cuts.len());
        cuts.dedup();
        cuts
    }

    fn first_behind(&self, line: usize) -> usize {
        self.order().map_or_else(|| self.cuts.first_at(line), |_| 0)
    }

    fn contours_in(&self, cut: usize) -> usize {
        let own = &self.cuts[cut];
        let is_pause = matches!(own.stop, Some((Stop::Pause, _)));
        own.pauses_before as usize + usize::from(is_pause && !self.contours.goes_on(cut))
    }

    fn has_steps(&self, cut: usize) -> bool {
        let own = &self.cuts[cut];
        own.steps > 0 || own.pauses_before > 0 || own.stop.is_some()
    }

    fn walk(&self, cut: usize, contour: &mut usize, each: &mut dyn FnMut(Step)) {
        self.run_lines(cut, &mut |ran| {
            let mut said = |step| {
                each(Step {
                    range: self.words_of(ran.line),
                    line: ran.line,
                    number: ran.block.number,
                    contour: *contour,
                    is_relative: ran.machine.incremental,
                    ..step
                });
            };
            for made in ran.moves() {
                said(made.step(made.curve(self.reading())));
            }
            let Some(stop) = ran.block.stop else { return };
            let kind = match stop {
                Stop::End => Kind::End,
                Stop::Pause => Kind::Pause,
            };
            said(Step::stop(kind, micrometres(ran.machine.at)));
            let start = self.words_of(ran.line).start;
            let is_last = self.cuts[cut]
                .stop
                .is_some_and(|(_, byte)| self.cuts.byte(cut) + byte as usize == start);
            let goes_on = is_last && self.contours.goes_on(cut);
            *contour += usize::from(stop == Stop::Pause && !goes_on);
        });
    }
}
