//! Some lines of a program, run: what they leave in force, what is wrong in them, and the cuts that they make.
//!
//! A program is kept as stretches of lines so that an edit runs again only the stretch that it touched, and those behind it for which
//! something else is in force. One that has only been moved is shifted, not run.

use super::block::Motion;
use super::block::{Block, Code, Note, Offset, Stop, read_line};
use super::corner::{self, Turned, turned};
use super::evidence::Evidence;
use super::machine::{Bend, Course, Machine, Move, Place, Reading, Trail, added};
use super::shape;
use super::word::Term;
use crate::finding::{Fault, Finding, Side};
use crate::geometry::{Bounds, Point, Segment};
use crate::program::path::{HeldWay, Node, closing, goes_round, mixed, near_each_other};
use crate::program::steps::Sum;
use std::ops::Range;

/// An arc that may be tighter than a correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tight {
    pub arc: Move,
    /// µm, taken about its own start: the same wherever it lies.
    pub radius: f64,
    /// Bytes from the start of the stretch; the whole line's words.
    pub range: (u32, u32),
    /// The run that it is part of, by its index in the stretch.
    pub run: u32,
}

/// The smallest radii among some arcs, µm; infinite where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tightest {
    /// Of those beside which the control lets the wire run on a side, and of the others.
    pub offset: f64,
    pub plain: f64,
}

impl Default for Tightest {
    fn default() -> Self {
        Tightest {
            offset: f64::INFINITY,
            plain: f64::INFINITY,
        }
    }
}

/// Arcs of a larger radius than this are not kept: no correction comes near, nm.
const LARGEST_CORRECTION: f64 = 5e6;

/// Consecutive cuts without rapid or stop between, or the part of them that lies in one stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// The first two and the last two moves that lead anywhere; the same one may be several of them.
    pub first: [Move; 2],
    pub last: [Move; 2],
    pub moves: u32,
    pub arcs: u32,
    /// Twice the signed area in nm², about the place where the run begins.
    pub twice_area: i128,
    /// The line that begins it, bytes from the start of the stretch.
    pub range: (u32, u32),
    /// The line that ends it.
    pub last_range: (u32, u32),
    /// Nothing of it was lost to lines that could not be read.
    pub whole: bool,
    /// In one of its lines, or between them, something is wrong.
    pub faulty: bool,
    /// It goes on in the next stretch.
    pub open: bool,
    /// It is the continuation of the one before.
    pub continues: bool,
    /// The stop behind it, before anything else moves, bytes from the start of the stretch; [`SEVERAL`] for more than one.
    pub stop: Option<u32>,
    /// The side that the control let the wire run on, where that was one and the same from the second move to the one before the last.
    pub side: RunSide,
    /// Where the wire was sent to the other side first, and the line that did so.
    pub flip: Option<(Place, (u32, u32))>,
}

/// Stands for more than one stop.
pub const SEVERAL: u32 = u32::MAX;

/// On which side of a run the wire was sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunSide {
    None,
    One(Side),
    Both,
}

impl Run {
    fn begin(first: Move, cap: f64, range: (u32, u32), continues: bool, whole: bool) -> Run {
        let side = first.side.map_or(RunSide::None, RunSide::One);
        let twice_area = cap as i128;
        Run {
            first: [first; 2],
            last: [first; 2],
            moves: 1,
            arcs: u32::from(first.is_arc()),
            twice_area,
            range,
            last_range: range,
            whole,
            faulty: false,
            open: true,
            continues,
            stop: None,
            side,
            flip: None,
        }
    }

    pub fn start(&self) -> Place {
        self.first[0].from
    }

    /// What a move adds to the area.
    fn term(&self, step: &Move, cap: f64) -> i128 {
        let origin = self.start();
        let from = [
            step.from[0].wrapping_sub(origin[0]),
            step.from[1].wrapping_sub(origin[1]),
        ];
        let to = [
            step.to[0].wrapping_sub(origin[0]),
            step.to[1].wrapping_sub(origin[1]),
        ];
        (i128::from(from[0]) * i128::from(to[1]))
            .wrapping_sub(i128::from(from[1]) * i128::from(to[0]))
            .wrapping_add(cap as i128)
    }

    fn push(&mut self, step: Move, cap: f64, range: (u32, u32)) {
        self.twice_area = self.twice_area.wrapping_add(self.term(&step, cap));
        if self.moves == 1 {
            self.first[1] = step;
        }
        if changes_side(&self.last[1], &step) {
            self.flip.get_or_insert((step.from, range));
        }
        self.last = [self.last[1], step];
        self.moves += 1;
        self.arcs += u32::from(step.is_arc());
        self.last_range = range;
        self.side = joined(self.side, step.side.map_or(RunSide::None, RunSide::One));
    }

    /// Appends the continuation of a run; the ranges stay those of the beginning.
    pub fn append(&mut self, next: &Run) {
        // The area of the continuation was taken about its own beginning.
        let (origin, its) = (self.start(), next.start());
        let shift = [
            its[0].wrapping_sub(origin[0]),
            its[1].wrapping_sub(origin[1]),
        ];
        let along = [
            next.last[1].to[0].wrapping_sub(its[0]),
            next.last[1].to[1].wrapping_sub(its[1]),
        ];
        let between = (i128::from(shift[0]) * i128::from(along[1]))
            .wrapping_sub(i128::from(shift[1]) * i128::from(along[0]));
        self.twice_area = self
            .twice_area
            .wrapping_add(next.twice_area)
            .wrapping_add(between);
        if self.moves == 1 {
            self.first[1] = next.first[0];
        }
        self.last = if next.moves == 1 {
            [self.last[1], next.last[1]]
        } else {
            next.last
        };
        self.moves += next.moves;
        self.arcs += next.arcs;
        self.whole &= next.whole;
        self.faulty |= next.faulty;
        self.open = next.open;
        self.stop = next.stop;
        self.side = joined(self.side, next.side);
    }

    fn shift(&mut self, by: Place) {
        for step in self.first.iter_mut().chain(&mut self.last) {
            *step = step.shifted(by);
        }
        if let Some((at, _)) = &mut self.flip {
            *at = added(*at, by);
        }
    }
}

/// The second move has the wire on the other side than the first.
pub fn changes_side(one: &Move, other: &Move) -> bool {
    matches!((one.side, other.side), (Some(one), Some(other)) if one != other)
}

fn joined(a: RunSide, b: RunSide) -> RunSide {
    match (a, b) {
        (RunSide::None, other) | (other, RunSide::None) => other,
        (one, other) if one == other => one,
        _ => RunSide::Both,
    }
}

/// How a run lies on itself: what tells where the way crosses itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Tells two runs apart: equal ways have equal marks.
    pub mark: u64,
    /// µm, seen from where the run begins.
    pub bounds: Bounds,
    /// Moves of it that come near each other, by their number in the run.
    pub near: Box<[(u32, u32)]>,
    /// It holds a closed contour, and one that goes round something.
    pub closes: bool,
    pub goes_round: bool,
}

/// Hears of every move of a run: the run's index, the move, the place of its words.
pub type Hears<'a> = dyn FnMut(usize, &Move, (u32, u32)) + 'a;

/// The moves of a run as they are made.
#[derive(Default)]
struct Ways(Vec<Move>);

impl Ways {
    fn path(self, reading: &Reading) -> Path {
        let start = self.0.first().map_or([0, 0], |step| step.from);
        let ways: Vec<Segment> = self
            .0
            .iter()
            .map(|step| step.seen_from(start).segment(reading))
            .collect();
        let boxes: Vec<Bounds> = ways.iter().map(Segment::bounds).collect();
        let mut near = Vec::new();
        near_each_other(&ways, &boxes, &mut |first, second| {
            near.push((first as u32, second as u32))
        });
        let bounds = boxes
            .iter()
            .fold(Bounds::EMPTY, |whole, part| whole.merged(part));
        let way = self.held(&ways, reading);
        let closes = closing(&way).is_some_and(|closing| closing.closed);
        Path {
            mark: self.mark(reading),
            bounds,
            near: near.into(),
            closes,
            goes_round: closes && goes_round(&way) == Some(true),
        }
    }

    fn held(&self, ways: &[Segment], reading: &Reading) -> HeldWay {
        let mut held = HeldWay::from(Node::at(Point::origin()), reading.writing());
        for (step, piece) in self.0.iter().zip(ways) {
            held.push(*piece, step.is_arc(), Node::at(piece.end()));
        }
        held
    }

    fn mark(&self, reading: &Reading) -> u64 {
        let mix = |mark: u64, field: i64| mixed(mark, field as u64);
        let with = |mark: u64, step: &Move| {
            let along = step.at_origin();
            let bend = match along.bend {
                Bend::Center { .. } => along
                    .center(reading.rule(along.incremental))
                    .unwrap_or_default(),
                Bend::Radius(radius) => [radius, i64::MIN],
                Bend::Nothing => [0, i64::MAX],
            };
            let fields = [
                along.to[0],
                along.to[1],
                bend[0],
                bend[1],
                along.motion as i64,
            ];
            fields.into_iter().fold(
                mark.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(1),
                mix,
            )
        };
        self.0.iter().fold(0, with)
    }
}

/// Lines that have been run, whose paths are yet to be found.
pub struct Pathless {
    stretch: Stretch,
    ways: Vec<Ways>,
}

impl Pathless {
    /// What is in force behind it.
    pub fn after(&self) -> Machine {
        self.stretch.after
    }

    /// How each run lies on itself: what takes time, and hangs on nothing but the moves.
    pub fn with_paths(self) -> Stretch {
        let Pathless { mut stretch, ways } = self;
        stretch.paths = ways
            .into_iter()
            .map(|ways| ways.path(&stretch.reading))
            .collect();
        stretch
    }
}

/// A word whose meaning is a matter of the machine, where it stands first, and how often.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foreign {
    pub code: Code,
    pub range: (u32, u32),
    pub count: u32,
}

/// A value for the control's table.
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    pub offset: Offset,
    pub terms: Vec<Term>,
    pub inch: bool,
    pub range: (u32, u32),
}

/// Of so many lengths of a stretch, with a point and without, their places are kept.
const MOST_LENGTHS: usize = 4;

/// Lines that have been run.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    pub before: Machine,
    pub after: Machine,
    /// How the numbers were read.
    pub reading: Reading,
    pub evidence: Evidence,
    /// What is wrong in single lines; places are bytes from the start of the stretch.
    pub faults: Vec<Finding>,
    /// In the order of their runs, where they lay before the stretch was moved, as `runs`.
    tight: Vec<Tight>,
    pub tightest: Tightest,
    runs: Vec<Run>,
    /// By how much it has been moved since its lines were run.
    moved: Place,
    /// Of each run, how it lies on itself.
    pub paths: Vec<Path>,
    /// The runs that begin and end here are known to have nothing wrong with them as a whole.
    pub is_quiet: bool,
    pub foreign: Vec<Foreign>,
    pub definitions: Vec<Definition>,
    /// The first lengths without a decimal point that are not 0, and the first with one.
    pub lengths: [Vec<(u32, u32)>; 2],
    /// How many lines behind its own say how its last ones run.
    pub ahead: u32,
    /// A word of it has the control make a corner.
    pub has_corners: bool,
    /// N words with the byte at which they stand.
    pub numbers: Vec<(u32, u32)>,
    /// Each of them is larger than the one before.
    pub numbers_rise: bool,
    /// Lines that may have an N word.
    pub blocks: u32,
    /// Where a program or subprogram begins (`O`), whose numbers count for themselves: how many N words stand before it.
    pub programs: Vec<u32>,
    /// A cut that was going on before these lines ends with none of them; true where all of it could be read.
    pub ends_run_before: Option<bool>,
    /// The stop before the first cut of these lines, as [`Run::stop`].
    pub stop_before: Option<u32>,
    /// Something is wrong in a line that belongs to that cut.
    pub faulty_before: bool,
    /// The first words behind the end.
    pub behind_end: Option<(u32, u32)>,
    /// The last line that says anything.
    pub last_words: Option<(u32, u32)>,
    /// A subprogram is called.
    pub calls: bool,
    /// Blocks that move the wire, and stops on the way.
    pub moves: u32,
    pub pauses: u32,
    /// What the steps of its lines come to, wherever the stops of contours are.
    pub sum: Sum,
    /// It holds coordinates under G90, or an absolute centre, or G92: what it does hangs on where the wire stands before.
    fixed: bool,
}

impl Stretch {
    /// Runs the first `count` of `lines`, each with the byte at which it begins, counted from `start`; those behind say how the last of
    /// them run.
    pub fn run<'a>(
        lines: impl Lines<'a>,
        count: usize,
        start: usize,
        before: Machine,
        reading: Reading,
    ) -> Pathless {
        let mut ways: Vec<Ways> = Vec::new();
        let stretch =
            Stretch::run_with(lines, count, start, before, reading, &mut |run, step, _| {
                if ways.len() <= run {
                    ways.resize_with(run + 1, Ways::default);
                }
                ways[run].0.push(*step);
            });
        Pathless { stretch, ways }
    }

    /// The same without paths; `each` hears of every move of a run.
    pub fn run_with<'a>(
        mut lines: impl Lines<'a>,
        count: usize,
        start: usize,
        before: Machine,
        reading: Reading,
        each: &mut Hears<'_>,
    ) -> Stretch {
        let mut stretch = Stretch {
            before,
            after: before,
            reading,
            evidence: Evidence::default(),
            faults: Vec::new(),
            tight: Vec::new(),
            tightest: Tightest::default(),
            runs: Vec::new(),
            moved: [0, 0],
            paths: Vec::new(),
            is_quiet: false,
            foreign: Vec::new(),
            definitions: Vec::new(),
            lengths: [Vec::new(), Vec::new()],
            ahead: 0,
            has_corners: false,
            numbers: Vec::new(),
            numbers_rise: true,
            blocks: 0,
            programs: Vec::new(),
            ends_run_before: None,
            stop_before: None,
            faulty_before: false,
            behind_end: None,
            last_words: None,
            calls: false,
            moves: 0,
            pauses: 0,
            sum: Sum::default(),
            fixed: false,
        };
        for left in (0..count).rev() {
            let Some((offset, line)) = lines.next() else {
                break;
            };
            let known = stretch.faults.len();
            stretch.line(
                line,
                offset - start,
                &Ahead {
                    lines: &lines,
                    left,
                },
                each,
            );
            if stretch.faults.len() > known {
                stretch.mark_fault();
            }
        }
        stretch
    }

    fn line<'a>(
        &mut self,
        line: &[u8],
        offset: usize,
        ahead: &Ahead<'_, impl Lines<'a>>,
        each: &mut Hears<'_>,
    ) {
        let Stretch {
            faults,
            foreign,
            definitions,
            lengths,
            after,
            ..
        } = &mut *self;
        let (inch, known_faults) = (after.inch, faults.len());
        let block = read_line(line, offset, |note| match note {
            Note::Fault { fault, range } => {
                // One fault a line is enough: the others may come of it.
                if faults.len() == known_faults {
                    faults.push(fault.finding(line, range.start - offset, range));
                }
            }
            Note::Foreign { code, range } => {
                match foreign.iter_mut().find(|word| word.code == code) {
                    Some(word) => word.count += 1,
                    None => foreign.push(Foreign {
                        code,
                        range: pair(range),
                        count: 1,
                    }),
                }
            }
            Note::Definition {
                offset,
                terms,
                range,
            } => definitions.push(Definition {
                offset,
                terms,
                inch,
                range: pair(range),
            }),
            Note::Length { pointed, range } => {
                let kept = &mut lengths[usize::from(pointed)];
                if kept.len() < MOST_LENGTHS {
                    kept.push(pair(range));
                }
            }
            Note::Twice { letter, range } => {
                if faults.len() == known_faults {
                    let letter = letter as char;
                    faults.push(Finding::of(Fault::WordTwice { letter }, range));
                }
            }
        });
        if block.empty {
            return;
        }
        let range = words_of(line, offset);
        self.last_words = Some(range);
        if block.program.is_some() {
            self.programs.push(self.numbers.len() as u32);
        }
        self.blocks += u32::from(block.program.is_none());
        if let Some(number) = block.number {
            self.numbers_rise &= self
                .numbers
                .last()
                .is_none_or(|(before, _)| number > *before);
            self.numbers.push((number, range.0));
        }
        self.calls |= block.call.is_some();
        if self.after.ended {
            self.behind_end.get_or_insert(range);
            return;
        }
        self.evidence.numbers(&block);
        self.fixed |= block.sets_position;
        let torn = self.after.torn;
        let cut_short = self.after.cut_short;
        let made = self.after.run(&block, &self.reading);
        let is_free = self.faults.len() == known_faults;
        if is_free && self.has_stray_center(&block) {
            self.fault(Fault::CenterOnLine, range);
        }
        match made {
            Some(made) => {
                if made.is_arc() && cut_short.is_none() {
                    self.evidence.arc(&made, self.reading.tolerance);
                }
                self.moves += 1;
                if is_free {
                    self.said(&block, &made, range);
                }
                let Turned {
                    made,
                    corner,
                    is_fixed,
                    ..
                } = self.turned(made, range, ahead);
                self.fixed |= is_fixed;
                self.made(made, range, torn, ahead, each);
                if let Some(corner) = corner {
                    self.made(corner, range, torn, ahead, each);
                }
            }
            None if self.after.torn => self.interrupt(false),
            None => {}
        }
        if let Some(stop) = block.stop {
            self.sum.stops += 1;
            self.interrupt(true);
            if stop == Stop::Pause {
                self.pauses += 1;
                let known = self
                    .runs
                    .last_mut()
                    .map_or(&mut self.stop_before, |run| &mut run.stop);
                *known = Some(known.map_or(range.0, |_| SEVERAL));
            }
            if stop == Stop::End && self.after.side.is_some() && self.after.switches.is_none() {
                self.fault(Fault::StillOn, range);
            }
        }
    }

    fn fault(&mut self, fault: Fault, range: (u32, u32)) {
        let range = range.0 as usize..range.1 as usize;
        self.faults.push(Finding::of(fault, range));
    }

    /// I or J in a line that makes no arc of them.
    fn has_stray_center(&self, block: &Block) -> bool {
        (block.i.is_some() || block.j.is_some())
            && !matches!(
                self.after.motion,
                Motion::Clockwise | Motion::CounterClockwise
            )
            && !block.takes_coordinates
            && !block.sets_position
            && !block.broken
    }

    /// Makes the corner at the end of a move.
    fn turned<'a>(
        &mut self,
        made: Move,
        range: (u32, u32),
        ahead: &Ahead<'_, impl Lines<'a>>,
    ) -> Turned {
        if made.corner.is_none() {
            return Turned {
                made,
                corner: None,
                looked_at: 0,
                is_fixed: false,
            };
        }
        self.has_corners = true;
        let turned = turned(made, &mut self.after, ahead.lines(), &self.reading);
        self.ahead = self.ahead.max(ahead.beyond(turned.looked_at));
        if turned.corner.is_none() {
            self.fault(Fault::NoCorner, range);
        }
        turned
    }

    /// Whether a line says once more what the last one with a move said.
    fn said(&mut self, block: &Block, made: &Move, range: (u32, u32)) {
        let said = mark_of(block, made);
        let is_again = std::mem::replace(&mut self.after.trail.said, said) == said;
        if is_again
            && !made.incremental
            && made.is_cut()
            && made.from == made.to
            && made.switches.is_none()
        {
            self.fault(Fault::DoubledBlock { arc: made.is_arc() }, range);
        }
    }

    /// Notes that something is wrong in a line of the cut that is going on.
    fn mark_fault(&mut self) {
        match self.runs.last_mut() {
            Some(run) => run.faulty |= run.open,
            None => self.faulty_before |= self.ends_run_before.is_none(),
        }
    }

    /// What comes next is a cut of its own; `whole` is false where lines between cannot be read.
    fn interrupt(&mut self, whole: bool) {
        self.after.trail = Trail::default();
        match self.runs.last_mut() {
            Some(run) if run.open => (run.open, run.whole) = (false, run.whole && whole),
            Some(_) => {}
            None => _ = self.ends_run_before.get_or_insert(whole),
        }
    }

    fn made<'a>(
        &mut self,
        made: Move,
        range: (u32, u32),
        torn: bool,
        ahead: &Ahead<'_, impl Lines<'a>>,
        each: &mut Hears<'_>,
    ) {
        self.fixed |= !made.incremental;
        self.sum.moves += 1;
        self.sum.arcs += usize::from(made.is_arc());
        self.sum.rapids += usize::from(!made.is_cut());
        for (axis, along) in self.sum.travel.iter_mut().enumerate() {
            *along = along.wrapping_add(made.to[axis].wrapping_sub(made.from[axis]));
        }
        if made.switches == Some(true) && made.offset.is_none() {
            let side = made.side.unwrap_or(Side::Left);
            self.fault(Fault::NoOffset { side }, range);
        }
        if let Some(on) = made.switches
            && (made.is_arc() || (on && !made.is_cut()))
        {
            self.fault(
                Fault::Switch {
                    on,
                    arc: made.is_arc(),
                },
                range,
            );
        }
        let mut cap = 0.0;
        if made.is_arc() {
            // About its own start, so that it comes to the same to the last bit wherever it lies.
            match made.at_origin().course(&self.reading) {
                Course::Arc(arc) => {
                    // µm² to nm².
                    cap = (arc.twice_cap_area() * 1e6).round();
                    if arc.radius * 1e3 < LARGEST_CORRECTION {
                        let goes_on = self.runs.last().is_some_and(|run| run.open);
                        let run = (self.runs.len() - usize::from(goes_on)) as u32;
                        let tightest = if made.side.is_some() {
                            &mut self.tightest.offset
                        } else {
                            &mut self.tightest.plain
                        };
                        *tightest = tightest.min(arc.radius);
                        self.tight.push(Tight {
                            arc: made,
                            radius: arc.radius,
                            range,
                            run,
                        });
                    }
                }
                Course::OffRadius { start, end, .. } => {
                    self.fault(Fault::OffRadius { start, end }, range);
                }
                Course::NoRadius => self.fault(Fault::NoRadius, range),
                Course::Line => {}
            }
        }
        if !made.is_cut() {
            return self.interrupt(true);
        }
        if made.from == made.to && !made.is_arc() {
            return;
        }
        self.examine(&made, range, ahead);
        self.after.trail.push(&made);
        match self.runs.last_mut() {
            Some(run) if run.open => run.push(made, cap, range),
            last => {
                let continues = last.is_none() && self.ends_run_before.is_none();
                self.runs
                    .push(Run::begin(made, cap, range, continues, !torn));
            }
        }
        each(self.runs.len() - 1, &made, range);
    }

    /// Whether the way turns back on itself at the beginning of a move.
    fn examine<'a>(&mut self, made: &Move, range: (u32, u32), ahead: &Ahead<'_, impl Lines<'a>>) {
        let Some(joint) = shape::joint(&self.after.trail, made, &self.reading) else {
            return;
        };
        let (next, looked_at) = corner::next_move(self.after, ahead.lines(), &self.reading);
        self.ahead = self.ahead.max(ahead.beyond(looked_at));
        self.fixed |= next.is_some_and(|next| !next.incremental);
        if let Some(fault) = joint.fault(next.as_ref(), &self.reading) {
            self.fault(fault, range);
        }
    }

    /// True when these lines do the same wherever the wire stands before them.
    pub fn is_loose(&self) -> bool {
        !self.fixed
    }

    /// Moves everything that these lines do by `by`.
    pub fn shift(&mut self, by: Place) {
        self.before.at = added(self.before.at, by);
        self.after.at = added(self.after.at, by);
        self.moved = added(self.moved, by);
    }

    /// A cut begins or ends in here: what comes behind does not hang on those before.
    pub fn parts_cuts(&self) -> bool {
        self.ends_run_before.is_some() || self.runs.iter().any(|run| !run.continues)
    }

    pub fn run_count(&self) -> usize {
        self.runs.len()
    }

    /// A run, where it lies.
    pub fn run_at(&self, index: usize) -> Option<Run> {
        let mut run = *self.runs.get(index)?;
        run.shift(self.moved);
        Some(run)
    }

    pub fn runs(&self) -> impl Iterator<Item = Run> + '_ {
        (0..self.runs.len()).filter_map(|index| self.run_at(index))
    }

    /// Where a run begins, how many moves and arcs it has.
    pub fn extent(&self, index: usize) -> Option<(Place, u32, u32)> {
        self.runs
            .get(index)
            .map(|run| (added(run.start(), self.moved), run.moves, run.arcs))
    }

    /// The runs that begin and end here.
    pub fn inner(&self) -> Range<usize> {
        let first = usize::from(self.runs.first().is_some_and(|run| run.continues));
        let end = self.runs.len() - usize::from(self.runs.last().is_some_and(|run| run.open));
        first..end.max(first)
    }

    /// The arcs of a run that may be tighter than a correction, where they lie.
    pub fn tight_of(&self, run: usize) -> impl Iterator<Item = Tight> + '_ {
        let first = self
            .tight
            .partition_point(|tight| (tight.run as usize) < run);
        let of_run = self.tight[first..]
            .iter()
            .take_while(move |tight| tight.run as usize == run);
        of_run.map(|tight| Tight {
            arc: tight.arc.shifted(self.moved),
            ..*tight
        })
    }
}

/// Lines, each with the byte at which it begins, that can be gone through more than once.
pub trait Lines<'a>: Iterator<Item = (usize, &'a [u8])> + Clone {}

impl<'a, I: Iterator<Item = (usize, &'a [u8])> + Clone> Lines<'a> for I {}

/// What stands behind a line.
struct Ahead<'l, L> {
    lines: &'l L,
    /// How many lines of the stretch.
    left: usize,
}

impl<'a, L: Lines<'a>> Ahead<'_, L> {
    fn lines(&self) -> impl Iterator<Item = &'a [u8]> {
        self.lines.clone().map(|(_, line)| line)
    }

    /// How many of the lines looked at stand behind the stretch.
    fn beyond(&self, looked_at: usize) -> u32 {
        looked_at.saturating_sub(self.left) as u32
    }
}

/// Lines with a move that say the same have the same mark, whatever their number.
fn mark_of(block: &Block, made: &Move) -> u64 {
    let numbers = [
        block.x,
        block.y,
        block.i,
        block.j,
        block.r,
        block.corner.map(|corner| corner.size),
    ];
    numbers
        .into_iter()
        .fold(1 + made.motion as u64, |mark, number| match number {
            Some(number) => mixed(
                mark,
                number.mantissa as u64 ^ u64::from(number.decimals) << 56,
            ),
            None => mixed(mark, 1 << 55),
        })
}

/// From the first to the last byte of a line that is no space.
pub fn words_of(line: &[u8], offset: usize) -> (u32, u32) {
    let leading = line
        .iter()
        .take_while(|byte| byte.is_ascii_whitespace())
        .count();
    let trailing = line[leading..]
        .iter()
        .rev()
        .take_while(|byte| byte.is_ascii_whitespace())
        .count();
    (
        (offset + leading) as u32,
        (offset + line.len() - trailing) as u32,
    )
}

fn pair(range: Range<usize>) -> (u32, u32) {
    (range.start as u32, range.end as u32)
}
