//! A running ISO program: the moves of its lines, the state at a line, and the cut in progress there.

use super::block::{Block, Stop, read_under};
use super::control::lines_from;
use super::corner::turned;
use super::document::Document;
use super::machine::Machine;
use super::moves::{Move, Place, micrometres};
use super::part::Part;
use super::read::words_of;
use super::stretch::{Placed, Stretch};
use super::variables::Variables;
use crate::finding::{Rule, Severity};
use crate::geometry::Point;
use crate::program::chunks::ChunkReader;
use crate::program::path::{Kind, Step, Trace, Writing};
use crate::program::report::place_of;
use crate::program::steps::{self, Program, Sum};
use crate::text::SourceText;
use std::ops::Range;

/// A cut that has begun before some line and may go on in it, nm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BegunCut {
    /// Its first move, which is the way in where it has one.
    pub(crate) from: Place,
    pub(crate) to: Place,
    pub(crate) last: Move,
    pub(crate) moves: u32,
}

/// A line that runs, and its effect.
pub(super) struct Ran<'a> {
    pub(super) line: usize,
    /// Its words, bytes of the text.
    words: Range<usize>,
    pub(super) block: &'a Block,
    /// What the lines before it say of the control's variables.
    pub(super) variables: Variables,
    /// Its move, and the corner that the control makes at its end.
    made: [Option<Move>; 2],
    /// The state after it.
    pub(super) machine: &'a Machine,
}

impl Ran<'_> {
    pub(super) fn moves(&self) -> impl Iterator<Item = Move> {
        self.made.into_iter().flatten()
    }

    /// A step for each move, and one for a stop.
    fn step_count(&self) -> usize {
        self.moves().count() + usize::from(self.block.stop.is_some())
    }
}

impl Document {
    /// The machine's way, move by move.
    pub fn trace(&self) -> Trace {
        steps::trace(self)
    }

    /// Hands out the lines of a stretch that run.
    pub(super) fn run_lines(&self, stretch: usize, each: &mut dyn FnMut(&Ran<'_>)) {
        let Some(placed) = self.placed_at(stretch) else {
            return;
        };
        let mut machine = placed.stretch.before;
        for line in placed.lines {
            if machine.ended {
                return;
            }
            let range = self.text().line_range(line);
            let bytes = self.line_bytes(line);
            let variables = machine.variables;
            let block = read_under(&mut machine.variables, bytes, range.start, |_| {});
            if block.empty {
                continue;
            }
            let (made, corner) = match machine.run(&block, self.reading()) {
                Some(made) => {
                    let (made, corner) = self.turned(line, made, &mut machine);
                    (Some(made), corner)
                }
                None => (None, None),
            };
            let words = words_of(bytes, range.start);
            each(&Ran {
                line,
                words: words.0 as usize..words.1 as usize,
                block: &block,
                variables,
                made: [made, corner],
                machine: &machine,
            });
        }
    }

    /// Hands out the moves in the order in which they run, each with its line and the state after it.
    pub(crate) fn moves(&self, each: &mut dyn FnMut(usize, Move, &Machine)) {
        for stretch in 0..self.stretches.len() {
            self.run_lines(stretch, &mut |ran| {
                for made in ran.moves() {
                    each(ran.line, made, ran.machine);
                }
            });
        }
    }

    /// A move up to where the corner at its end begins, and that corner.
    pub(crate) fn turned(
        &self,
        line: usize,
        made: Move,
        machine: &mut Machine,
    ) -> (Move, Option<Move>) {
        if made.corner.is_none() {
            return (made, None);
        }
        let turned = turned(
            made,
            machine,
            lines_from(self.text(), self.leader(), line + 1).map(|(_, line)| line),
            self.reading(),
        );
        (turned.made, turned.corner)
    }

    /// True where the control makes corners of its own.
    pub(crate) fn has_corners(&self) -> bool {
        self.stretches.iter().any(|stretch| stretch.has_corners)
    }

    // The state at a line.

    /// Runs the lines before `line`, and itself where `behind` is set, in the stretch in which it first runs; `None`
    /// for a line that does not run.
    fn run_up_to(&self, line: usize, behind: bool) -> Option<(usize, Stretch)> {
        let (index, placed) = self
            .placed()
            .enumerate()
            .find(|(_, placed)| placed.lines.contains(&line))?;
        let lines = placed.lines.start..line + usize::from(behind);
        let (begun, _) = self
            .control()
            .run(self.text(), lines, placed.stretch.before);
        Some((index, self.control().finish(self.text(), begun, &[])))
    }

    /// The state before a line, with the wire's position; `None` for a line that does not run.
    pub(crate) fn machine_before(&self, line: usize) -> Option<Machine> {
        self.run_up_to(line, false)
            .map(|(_, stretch)| stretch.after)
    }

    /// The state after a line.
    pub(crate) fn machine_behind(&self, line: usize) -> Option<Machine> {
        self.run_up_to(line, true).map(|(_, stretch)| stretch.after)
    }

    /// The cut in progress before a line.
    pub(crate) fn begun_cut(&self, line: usize) -> Option<BegunCut> {
        self.begun(self.run_up_to(line, false)?)
    }

    /// The cut in progress after a line.
    pub(crate) fn begun_cut_with(&self, line: usize) -> Option<BegunCut> {
        self.begun(self.run_up_to(line, true)?)
    }

    fn begun(&self, (index, own): (usize, Stretch)) -> Option<BegunCut> {
        // Only the last stretch with the start of a cut matters, and those after.
        let before = &self.stretches[..index];
        let from = before.iter().rposition(Stretch::bounds_cuts).unwrap_or(0);
        let mut begun: Option<BegunCut> = None;
        for stretch in before[from..].iter().chain([&own]) {
            if stretch.ends_cut_before.is_some() {
                begun = None;
            }
            for part in stretch.parts() {
                begun = begun_by(begun.filter(|_| part.continues), &part);
            }
        }
        begun
    }
}

/// The cut in progress after a part, which goes on with the one before.
fn begun_by(before: Option<BegunCut>, part: &Part) -> Option<BegunCut> {
    let last = part.last[1];
    let first = before.unwrap_or(BegunCut {
        from: part.first[0].from,
        to: part.first[0].to,
        last,
        moves: 0,
    });
    part.open.then_some(BegunCut {
        last,
        moves: first.moves + part.moves,
        ..first
    })
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
        let has_steps = |stretch: &Stretch| stretch.sum.moves + stretch.sum.stops > 0;
        if let Some(first) = self.stretches.iter().position(has_steps) {
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
        let of_stretch = |placed: Placed<'_>| {
            let mut faults = placed.stretch.faults.iter();
            let fault = faults.find(|fault| {
                fault.severity == Severity::Error
                    && matches!(fault.rule, Rule::Syntax | Rule::TooManyDigits)
            })?;
            let (start, _) = place_of(fault);
            Some(self.text().line_of(placed.offset + start))
        };
        self.placed().find_map(of_stretch)
    }

    fn chunk_count(&self) -> usize {
        self.stretches.len()
    }

    fn lines_of(&self, stretch: usize) -> Range<usize> {
        self.placed_at(stretch).map_or(0..0, |placed| placed.lines)
    }

    fn sum_of(&self, stretch: usize) -> Sum {
        self.stretches
            .get(stretch)
            .map_or_else(Sum::default, |own| Sum {
                contours: (own.pauses as usize).saturating_sub(self.contours.tabs_in(stretch)),
                ..own.sum
            })
    }

    fn walk(&self, stretch: usize, contour: &mut usize, each: &mut dyn FnMut(Step)) {
        let offset = self.placed_at(stretch).map_or(0, |placed| placed.offset);
        self.run_lines(stretch, &mut |ran| {
            let mut said = |step| {
                each(Step {
                    range: ran.words.clone(),
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
            let is_tab = self.is_tab((stretch, ran.words.start.saturating_sub(offset)));
            *contour += usize::from(stop == Stop::Pause && !is_tab);
        });
    }
}
