//! Runs lines: the meaning of each, the state after it, and its faults.

#![warn(clippy::indexing_slicing)]

use super::block::{Block, Note, Stop, read_under};
use super::corner::turned;
use super::cut::{Cut, Definition, Foreign, Moves, Rare};
use super::evidence::Evidence;
use super::machine::{Behind, Machine, Ran, mark_of};
use super::moves::{Course, Move, Place, Reading};
use super::order::Sequence;
use super::summary::Summary;
use crate::finding::{Fault, Finding, Rule};
use crate::geometry::Side;
use crate::program::path::Verdict;
use std::f64::consts::PI;
use std::ops::Range;

/// A move, and the bytes of its words.
pub(crate) type Placed = (Move, (u32, u32));

/// Lines up to the end of a cut as they are run.
pub(crate) struct Run<'a> {
    /// All lines, and the number of that which runs.
    sequence: Sequence<'a>,
    nth: usize,
    pub(crate) cut: Cut,
    pub(crate) rare: Rare,
    /// The state after the last of them.
    pub(crate) after: Machine,
    /// Where the wire stood before the first.
    begin: Place,
    pub(crate) reading: Reading,
    pub(crate) evidence: Evidence,
    /// Their moves that cut, from there.
    pub(crate) way: Vec<Placed>,
    sum: Option<Summary>,
}

impl<'a> Run<'a> {
    pub(crate) fn new(sequence: Sequence<'a>, before: Machine, reading: Reading) -> Run<'a> {
        Run {
            sequence,
            nth: 0,
            cut: Cut::default(),
            rare: Rare::default(),
            after: before,
            begin: before.at,
            reading,
            evidence: Evidence::default(),
            way: Vec::new(),
            sum: None,
        }
    }

    /// Runs lines up to the end of a cut, and hands out what each does; places count from the byte `base`. Returns the
    /// line behind the last.
    pub(crate) fn lines(
        &mut self,
        lines: Range<usize>,
        base: usize,
        mut each: impl FnMut(&Ran<'_>),
    ) -> usize {
        self.nth = lines.start;
        while self.nth < lines.end && !self.is_over() {
            let known = self.rare.faults.len();
            self.line(self.sequence.line(self.nth), base, &mut each);
            self.nth += 1;
            if self.rare.faults.len() > known
                && let Some(sum) = &mut self.sum
            {
                sum.faulty |= sum.open;
            }
        }
        self.after.said = 0;
        self.nth
    }

    /// The lines behind the one that runs.
    fn behind(&self) -> impl Iterator<Item = &'a [u8]> + use<'a> {
        self.sequence.behind(self.nth)
    }

    /// Something has ended moves that cut.
    fn is_over(&self) -> bool {
        self.sum.as_ref().is_some_and(|sum| !sum.open)
    }

    /// What was run.
    pub(crate) fn finished(self) -> (Cut, Vec<Placed>) {
        let places = self.evidence.places.iter().enumerate();
        let used = places.filter(|(_, count)| **count > 0);
        let places = used.fold(0, |bits, (place, _)| bits | 1 << place);
        let Run {
            mut cut,
            rare,
            after,
            sum,
            way,
            evidence,
            ..
        } = self;
        cut.keep(rare);
        cut.evidence = evidence;
        cut.cuts = sum.is_some();
        cut.places = places;
        cut.ended = after.ended;
        cut.moves = sum.map(|sum| {
            Box::new(Moves {
                sum,
                verdict: Verdict::default(),
                found: None,
                spurs: Vec::new(),
                is_doubtful: None,
            })
        });
        (cut, way)
    }

    /// The block of a line, whether the wire's upper end may go elsewhere than before, and whether a length stands in a
    /// word beside the wire's way.
    fn block(&mut self, line: &[u8], offset: usize) -> (Block, bool, bool) {
        let Run {
            after,
            evidence,
            cut,
            rare,
            ..
        } = &mut *self;
        let Rare {
            faults,
            foreign,
            definitions,
            ..
        } = rare;
        let (inch, known_faults) = (after.inch, faults.len());
        let (mut leans, mut measures, mut is_unread) = (false, false, false);
        let block = read_under(&mut after.variables, line, offset, |note| match note {
            Note::Fault { fault, range } => {
                // One of a kind is enough for a line: the others may follow from it.
                let is_new = match fault.is_read() {
                    true => faults.len() == known_faults,
                    false => !std::mem::replace(&mut is_unread, true),
                };
                if is_new {
                    faults.push(fault.finding(line, range.start - offset, range));
                }
            }
            Note::Foreign { code, range } => {
                leans |= code.tilts();
                measures |= code.measures();
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
            } => {
                evidence.correction(&terms);
                let range = pair(range);
                definitions.push(Definition {
                    offset,
                    terms,
                    inch,
                    range,
                });
            }
            Note::Length { pointed, .. } => {
                cut.has_pointed |= pointed;
                cut.has_bare |= !pointed;
            }
            Note::Twice { letter, range } => {
                if faults.len() == known_faults {
                    let sentence = say!(stands_twice_in_this_line, letter as char);
                    faults.push(Finding::of(Fault::said(Rule::WordTwice, sentence), range));
                }
            }
        });
        (block, leans, measures)
    }

    /// Runs a line of the text: its content, its move, and the corner that the control makes at its end.
    fn line(&mut self, line: usize, base: usize, each: &mut impl FnMut(&Ran<'_>)) {
        let bytes = self.sequence.bytes(line);
        let offset = self.sequence.text.line_start(line) - base;
        let (known_faults, variables) = (self.rare.faults.len(), self.after.variables);
        let (block, leans, measures) = self.block(bytes, offset);
        if block.empty {
            return;
        }
        let range = words_of(bytes, offset);
        self.cut.last_words = Some(range);
        self.number(&block, range.0);
        self.cut.calls |= block.call.is_some();
        if self.after.ended {
            self.rare.behind_end.get_or_insert(range);
            return;
        }
        let incremental = block.incremental.unwrap_or(self.after.incremental);
        self.evidence.numbers(&block, incremental);
        self.cut.fixed |= block.sets_position;
        let (torn, behind) = (self.after.torn, self.after.behind);
        self.rare.faults.extend(self.too_far(&block, range));
        if measures {
            self.rare
                .faults
                .extend(self.beside_too_far(bytes, offset, &block));
        }
        let steered = self.after.steer(&block, &self.reading);
        // A line that says where to go fixes the position even where it makes no move because the
        // position before it is unknown.
        self.cut.fixed |= !self.after.incremental && block.has_coordinates();
        let is_free = self.rare.faults.len() == known_faults;
        if is_free && !block.broken && block.has_stray_center(self.after.motion) {
            let sentence = say!(i_and_j_stand_beside_a_straight_cut);
            self.fault(Fault::said(Rule::CenterOnLine, sentence), range);
        }
        let mut all = [None; 2];
        match steered {
            Some(steered) => {
                // The move as its words say it: whether there is a corner before it depends on the
                // meaning of I and J.
                let said = steered.said;
                match self.after.center {
                    _ if !said.is_arc() => {}
                    Some(stated) => self.evidence.states(&said, stated),
                    None if self.evidence.arc(&said, self.reading.tolerance) => {
                        self.rare.first_center.get_or_insert(range);
                    }
                    None => {}
                }
                if is_free && let Some(fault) = self.contradicts(&block, &said) {
                    self.fault(fault, range);
                }
                let made = steered.made(&self.reading);
                if is_free && !leans {
                    self.said(&block, &made, range);
                }
                let (made, corner) = self.turned(made, range);
                all = [Some(made), corner];
                for made in all.into_iter().flatten() {
                    self.made(made, range, torn);
                }
            }
            None if self.after.torn => self.interrupt(false),
            None => {}
        }
        if let Some(stop) = block.stop {
            self.stop(stop, steered.is_none() && behind == Behind::Stop, range);
        }
        each(&Ran {
            line,
            block: &block,
            variables,
            made: all,
            machine: &self.after,
        });
    }

    /// The number of a block, or where a program begins.
    fn number(&mut self, block: &Block, place: u32) {
        match block.program {
            Some(_) => self.cut.numbers.push((None, place)),
            None => self.cut.blocks += 1,
        }
        if block.number.is_some() {
            self.cut.numbers.push((block.number, place));
        }
    }

    /// The machine stops, `again` where nothing moves between this stop and the one before.
    fn stop(&mut self, stop: Stop, again: bool, range: (u32, u32)) {
        self.interrupt(true);
        match self.sum.is_none() && stop == Stop::Pause {
            true => {
                self.cut.pauses_before += 1;
                self.cut.pauses_again |= again;
            }
            false => self.cut.stop = Some((stop, range.0)),
        }
        if stop == Stop::End && self.after.side.is_some() && self.after.switches.is_none() {
            self.fault(Fault::StillOn, range);
        }
    }

    fn fault(&mut self, fault: Fault, range: (u32, u32)) {
        let range = range.0 as usize..range.1 as usize;
        self.rare.faults.push(Finding::of(fault, range));
    }

    /// An arc whose I and J lead along another arc than its R: some controls take the one, some the other.
    fn contradicts(&self, block: &Block, said: &Move) -> Option<Fault> {
        let stated = block.r.filter(|_| block.has_center())?;
        let Course::Arc(arc) = said.at_origin().course(&self.reading) else {
            return None;
        };
        let stated = self.reading.length(stated, self.after.inch) as f64 / 1e3;
        let (radius, tolerance) = (arc.radius, self.reading.tolerance as f64 / 1e3);
        let half = (arc.end - arc.start).norm() / 2.0;
        // How far the centre is from the chord: nothing at a half turn, where R tells it only roughly.
        let aside = (radius * radius - half * half).max(0.0).sqrt();
        let is_plain = aside > (2.0 * radius * tolerance).sqrt() + tolerance && half > 0.0;
        let is_other_turn = is_plain && (arc.sweep.abs() > PI) != (stated < 0.0);
        let differs = (stated.abs() - radius).abs() > tolerance || is_other_turn;
        differs.then(|| {
            let sentence = say!(r_is_not_the_radius_of_i_and_j, stated / 1e3, radius / 1e3);
            Fault::said(Rule::ArcOffRadius, sentence)
        })
    }

    /// Makes the corner at the end of a move.
    fn turned(&mut self, made: Move, range: (u32, u32)) -> (Move, Option<Move>) {
        if made.corner.is_none() {
            return (made, None);
        }
        self.cut.has_corners = true;
        let behind = self.behind();
        let (made, corner) = turned(
            made,
            &mut self.after,
            behind,
            &self.reading,
            &mut self.cut.fixed,
        );
        if corner.is_none() {
            let sentence = say!(the_word_for_a_corner_finds_none_here);
            self.fault(Fault::said(Rule::CornerWord, sentence), range);
        }
        (made, corner)
    }

    /// Whether a line repeats the last one with a move.
    fn said(&mut self, block: &Block, made: &Move, range: (u32, u32)) {
        let said = mark_of(block, made);
        let is_again = std::mem::replace(&mut self.after.said, said) == said;
        if is_again
            && !made.incremental
            && made.is_cut()
            && made.from == made.to
            && made.switches.is_none()
        {
            self.fault(Fault::DoubledBlock { arc: made.is_arc() }, range);
        }
    }

    /// Ends the moves that cut; `whole` is false where lines between cannot be read.
    fn interrupt(&mut self, whole: bool) {
        self.after.said = 0;
        if let Some(sum) = &mut self.sum {
            sum.whole &= whole || !sum.open;
            sum.open = false;
        }
    }

    fn made(&mut self, made: Move, range: (u32, u32), torn: bool) {
        self.cut.fixed |= !made.incremental || self.after.center.is_some();
        self.cut.steps += 1;
        if self.after.mills {
            // Layers are neither contours of a part nor passes along one.
            return self.interrupt(true);
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
        self.arc(made, range);
        if !made.is_cut() {
            return self.interrupt(true);
        }
        if !made.goes_anywhere() {
            return;
        }
        let local = made.seen_from(self.begin);
        match &mut self.sum {
            Some(sum) => sum.push(local, range),
            None => self.sum = Some(Summary::begin(local, range, !torn)),
        }
        self.way.push((local, range));
    }

    /// The fault of an arc that leads nowhere.
    fn arc(&mut self, made: Move, range: (u32, u32)) {
        // Relative to its own start, so that the result is the same to the last bit anywhere.
        match made.at_origin().course(&self.reading) {
            Course::OffRadius { start, end, .. } => {
                self.fault(Fault::OffRadius { start, end }, range);
            }
            Course::NoRadius => self.fault(Fault::ArcWithoutRadius, range),
            Course::Line | Course::Arc(_) => {}
        }
    }
}

/// From the first to the last byte of a line that is not a space.
pub(crate) fn words_of(line: &[u8], offset: usize) -> (u32, u32) {
    let leading = line
        .iter()
        .take_while(|byte| byte.is_ascii_whitespace())
        .count();
    let trailing = line
        .iter()
        .skip(leading)
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
