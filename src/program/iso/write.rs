//! Writes paths as one ISO program, by a profile; each line is read back at once.

mod fixed;
mod offsets;
mod proof;

pub(crate) use offsets::{Carried, read_of_profile};

use super::block::{Block, Motion, Register};
use super::encode::{Encoded, Moves};
use super::machine::Machine;
use super::moves::{CenterRule, MICROMETRE, Place, Reading, to_center};
use crate::finding::Side;
use crate::program::encode::encode_all;
use crate::program::grid::Node;
use crate::program::write::{
    BETWEEN_PASSES, MOST_BLOCKS, Piece, ProofError, Proved, ProvedProgram, TAB_STOP, Writer, cuts,
    does_not_stop, nothing_to_write, push_number, push_places, room, walk, way,
};
use crate::settings::{Coordinates, Effective, LineEnd, NumberUnit, Profile, Zero};
use crate::toolpath::{Source, WirePath, each};
use fixed::Leading;

/// Lines that one core reads back at a time.
const AT_A_TIME: usize = 128;

/// Writes the paths as one program and proves it. `unit_mm` is the drawing's unit in mm. An unknown profile, or one
/// whose lines do not do what they should, is a refusal.
pub fn write(paths: &[WirePath], unit_mm: f64, settings: &Effective) -> Proved<ProvedProgram> {
    write_with(paths, unit_mm, settings, None, &mut |_, _| true)
}

/// As [`write()`], with what the paths keep of the program that they come from.
pub(crate) fn write_keeping(
    paths: &[WirePath],
    kept: &[Carried],
    unit_mm: f64,
    settings: &Effective,
) -> Proved<ProvedProgram> {
    let mut lines = Lines::of(settings)?;
    lines.kept = kept;
    lines.written(paths, unit_mm, &mut |_, _| true)
}

/// As [`write()`]; `go_on` gets the progress every few thousand segments, and ends the work with `false`. `sources` get
/// what each move follows.
pub(crate) fn write_with(
    paths: &[WirePath],
    unit_mm: f64,
    settings: &Effective,
    sources: Option<&mut Vec<Source>>,
    go_on: &mut dyn FnMut(usize, usize) -> bool,
) -> Proved<ProvedProgram> {
    let mut lines = Lines::of(settings)?;
    lines.sources = sources;
    lines.written(paths, unit_mm, go_on)
}

pub(super) struct Lines<'a> {
    pub(super) profile: &'a Profile,
    settings: &'a Effective,
    /// 1-based number of the pass.
    pass: usize,
    /// What the paths keep of another program.
    kept: &'a [Carried],
    /// That of the path that is written.
    own: Carried,
    /// nm in one step of the grid.
    pub(super) step: i64,
    pub(super) reading: Reading,
    /// The control that runs every line again.
    pub(super) machine: Machine,
    pub(super) out: Vec<u8>,
    /// The origin of absolute coordinates.
    zero: Node,
    side: Option<Side>,
    /// The control offsets one of the contours.
    has_offsets: bool,
    is_switched_off: bool,
    /// The path goes on from the end of the last one, with the same modal state.
    goes_on: bool,
    /// The stops so far, as they are read again.
    pauses: usize,
    /// What the lines of the profile do to the moves after them.
    leading: Leading,
    number: u32,
    /// The modal words that a terse profile leaves out.
    motion: Option<Motion>,
    /// The totals so far, in steps.
    pub(super) made: ProvedProgram,
    /// What each register that a contour has named has to hold, mm.
    holding: Vec<(Register, f64)>,
    /// What each move follows.
    pub(super) sources: Option<&'a mut Vec<Source>>,
    /// The most blocks.
    room: usize,
}

impl Writer for Lines<'_> {
    fn begin(&mut self, from: Option<Node>, first: Node, path: &WirePath) -> Proved {
        self.pass = path.pass;
        let kept = self.kept;
        self.own = kept.first().copied().unwrap_or_default();
        self.kept = kept.get(1..).unwrap_or_default();
        match from {
            None => {
                if self.profile.zero == Zero::Start {
                    self.zero = first;
                }
                self.fixed(&self.profile.begin, first)?;
                if !self.machine.stated {
                    self.machine.at = self.place(first);
                }
                if self.machine.at != self.place(first) {
                    return Err(self.refused(say!(its_begin_does_not_say_where_the_wire_stands)));
                }
                if self.has_offsets {
                    self.say_offsets(kept, first)?;
                }
            }
            Some(from) if self.own.goes_on && from == first => {}
            Some(from) => self.go_over(from, first, path, self.settings)?,
        }
        if std::mem::take(&mut self.goes_on) {
            return Ok(());
        }
        (self.side, self.is_switched_off) = (path.side, false);
        self.fixed(&self.profile.contour_begin, first)?;
        if path.side.is_some() && path.pass > 1 && !self.names_registers() {
            return Err(self.refused(say!(all_passes_would_have_one_correction)));
        }
        if path.side.is_some() && self.machine.side != path.side {
            return Err(self.refused(say!(its_contour_begin_does_not_switch_the_correction_on)));
        }
        let named = self.machine.offset.map(|offset| offset.index);
        if let Some(register) = self.own.register.filter(|_| path.side.is_some())
            && named != Some(register)
        {
            return Err(self.refused(&say!(its_contour_begin_names_no_register, register)));
        }
        if path.side.is_some() && self.own.register.is_none() {
            self.hold_one_correction()?;
        }
        Ok(())
    }

    fn pieces(&mut self, pieces: &[Piece]) -> Proved {
        let moves = Moves {
            step: self.step_um(),
            full_circles: self.profile.full_circles,
        };
        let left = self.room.saturating_sub(self.made.blocks);
        let encoded = encode_all(&moves, pieces, left, |Piece { from, to, .. }| {
            say!(no_moves_within_tolerance_lead_from_to, from, to)
        })?;
        let mut left = encoded.into_iter().flatten().peekable();
        let mut steps = Vec::with_capacity(2 * pieces.len());
        for (nth, piece) in pieces.iter().enumerate() {
            // No control switches its correction off on an arc.
            if piece.source == Source::LeadOut && piece.segment.as_arc().is_none() {
                self.put(&std::mem::take(&mut steps))?;
                self.switch_off(piece.from)?;
            }
            while let Some((_, step)) = left.next_if(|(of, _)| *of == nth) {
                steps.push(step);
                self.follows(piece.source);
            }
            self.made.length += piece.segment.length();
        }
        self.put(&steps)
    }

    fn end(&mut self, last: Node, goes_on: bool) -> Proved {
        self.goes_on = goes_on;
        match goes_on {
            true => Ok(()),
            false => self.switch_off(last),
        }
    }

    fn end_open(&mut self, last: Node, for_good: bool, stops: usize) -> Proved {
        let stops = if for_good && !self.own.goes_on {
            stops
        } else {
            0
        };
        (0..stops).try_for_each(|_| self.stop(last))
    }

    fn stop(&mut self, at: Node) -> Proved {
        self.fixed(&self.profile.pause, at)
    }

    fn between_passes(&mut self, at: Node, word: Option<&str>) -> Proved {
        match word {
            Some("") => Ok(()),
            Some(word) => self.stop_by(BETWEEN_PASSES, word, at),
            None => self.fixed(&self.profile.pause_between_passes, at),
        }
    }

    fn stop_before_tab(&mut self, at: Node, word: Option<&str>) -> Proved {
        if let Some(word) = word {
            return self.stop_by(TAB_STOP, word, at);
        }
        let before = self.pauses;
        self.fixed(&self.profile.pause, at)?;
        match self.pauses - before {
            1 => Ok(()),
            _ => Err(self.refused(say!(its_pause_has_to_stop_before_a_tab))),
        }
    }

    fn move_over(&mut self, from: Node, to: Node) -> Proved {
        let piece = way(from, to);
        self.made.jumps += piece.length();
        self.follows(Source::LeadIn);
        self.put(&[Encoded {
            motion: Motion::Rapid,
            from,
            to,
            center: from,
            piece,
        }])
    }

    fn moved_by_hand(&mut self, to: Node) -> Proved {
        self.fixed(&["G92 X{x} Y{y}".to_owned()], to)?;
        match self.machine.at == self.place(to) {
            true => Ok(()),
            false => Err(self.refused(say!(its_pause_has_to_stop_the_machine))),
        }
    }
}

impl<'a> Lines<'a> {
    /// No lines yet, in the profile of the settings; an error for an unknown profile.
    pub(super) fn of(settings: &'a Effective) -> Proved<Lines<'a>> {
        let profile = settings
            .profile
            .as_ref()
            .map_err(|sentence| ProofError::Refused(sentence.clone()))?;
        let per_mm = 10_i64.pow(u32::from(profile.decimals.clamp(3, 6)));
        let reading = Reading {
            whole_numbers_are_fine: profile.unit == NumberUnit::Um,
            absolute: profile.center,
            incremental: if profile.center == CenterRule::Absolute {
                CenterRule::StartToCenter
            } else {
                profile.center
            },
            tolerance: 3 * MICROMETRE,
        };
        Ok(Lines {
            profile,
            settings,
            pass: 1,
            kept: &[],
            own: Carried::default(),
            step: 1_000_000 / per_mm,
            reading,
            machine: Machine::default(),
            out: Vec::new(),
            zero: Node { x: 0, y: 0 },
            side: None,
            has_offsets: false,
            is_switched_off: false,
            goes_on: false,
            pauses: 0,
            leading: Leading::of(reading),
            number: 0,
            motion: None,
            made: ProvedProgram::default(),
            holding: Vec::new(),
            sources: None,
            room: MOST_BLOCKS,
        })
    }

    fn follows(&mut self, source: Source) {
        if let Some(sources) = &mut self.sources {
            sources.push(source);
        }
    }

    /// A stop by the word that is set under `key`.
    fn stop_by(&mut self, key: &str, word: &str, at: Node) -> Proved {
        let before = self.pauses;
        let made = self.fixed(&[word.to_owned()], at);
        made.map_err(|_| does_not_stop(key, word))?;
        match self.pauses - before {
            1 => Ok(()),
            _ => Err(does_not_stop(key, word)),
        }
    }

    /// The program along the paths.
    fn written(
        mut self,
        paths: &[WirePath],
        unit_mm: f64,
        go_on: &mut dyn FnMut(usize, usize) -> bool,
    ) -> Proved<ProvedProgram> {
        self.room = room(paths, self.sources.is_some());
        self.has_offsets = paths.iter().any(|path| path.side.is_some());
        let (steps, step_um) = (unit_mm * self.per_mm(), self.step_um());
        walk(paths, steps, step_um, go_on, &mut self)?;
        self.finish(cuts(paths))
    }

    /// Steps of the grid in 1 mm.
    pub(super) fn per_mm(&self) -> f64 {
        1e6 / self.step as f64
    }

    fn step_um(&self) -> f64 {
        self.step as f64 / MICROMETRE as f64
    }

    /// The control's position at a node.
    fn place(&self, node: Node) -> Place {
        [
            (node.x - self.zero.x) * self.step,
            (node.y - self.zero.y) * self.step,
        ]
    }

    pub(super) fn refused(&self, why: &str) -> ProofError {
        ProofError::Refused(say!(of_profile, self.profile.name, why))
    }

    /// The lines before the way out of a contour that the control offsets.
    fn switch_off(&mut self, at: Node) -> Proved {
        if self.side.is_none() || std::mem::replace(&mut self.is_switched_off, true) {
            return Ok(());
        }
        self.fixed(&self.profile.contour_end, at)
    }

    pub(super) fn end_line(&mut self) {
        self.out.extend_from_slice(match self.profile.line_end {
            LineEnd::Lf => b"\n",
            LineEnd::Crlf => b"\r\n",
        });
    }

    /// Writes moves, and reads them back.
    pub(super) fn put(&mut self, steps: &[Encoded]) -> Proved {
        if !steps.is_empty() {
            self.lead_nowhere_else()?;
        }
        let mut lines = Vec::with_capacity(steps.len());
        for step in steps {
            let start = self.out.len();
            self.push_move(step);
            lines.push(start..self.out.len());
            self.end_line();
        }
        self.made.blocks += steps.len();
        let out = &self.out;
        let read = each(lines.len(), AT_A_TIME, |nth| {
            Block::of(&out[lines[nth].clone()])
        });
        let run = |block: &Block| self.machine.run(block, &self.reading);
        let made: Vec<_> = read.iter().map(run).collect();
        let own = &*self;
        let checked = each(steps.len(), AT_A_TIME, |nth| {
            own.check(&steps[nth], made[nth])
        });
        for aside in checked {
            self.made.deviation = self.made.deviation.max(aside?);
        }
        Ok(())
    }

    /// The beginning of a line with a move: its number, and G00 to G03.
    pub(super) fn push_head(&mut self, out: &mut Vec<u8>, motion: Motion) -> Separator {
        let mut separate = Separator {
            wanted: self.profile.spaces,
            first: true,
        };
        if self.profile.numbers > 0 {
            self.number = self.number.saturating_add(self.profile.numbers);
            separate.push(out, b"N");
            push_number(out, u64::from(self.number), 0);
        }
        if !self.profile.modal || self.motion != Some(motion) {
            separate.push(out, motion.word().as_bytes());
            self.motion = Some(motion);
        }
        separate
    }

    fn push_move(&mut self, step: &Encoded) {
        let modal = self.profile.modal;
        let mut out = std::mem::take(&mut self.out);
        let mut separate = self.push_head(&mut out, step.motion);
        let from = match self.profile.coordinates {
            Coordinates::Absolute => self.zero,
            Coordinates::Incremental => step.from,
        };
        // An arc without coordinates is a full circle: both are kept for it.
        let keep = !modal || step.from == step.to;
        if keep || step.to.x != step.from.x {
            separate.push(&mut out, b"X");
            self.push_length(&mut out, step.to.x - from.x);
        }
        if keep || step.to.y != step.from.y {
            separate.push(&mut out, b"Y");
            self.push_length(&mut out, step.to.y - from.y);
        }
        if step.motion.is_arc() {
            let is_incremental = self.profile.coordinates == Coordinates::Incremental;
            let [center, from, zero] = [step.center, step.from, self.zero].map(|at| [at.x, at.y]);
            let [i, j] = to_center(self.reading.rule(is_incremental), center, from, zero);
            separate.push(&mut out, b"I");
            self.push_length(&mut out, i);
            separate.push(&mut out, b"J");
            self.push_length(&mut out, j);
        }
        self.out = out;
    }

    /// A length in steps, as the profile writes lengths.
    pub(super) fn push_length(&self, out: &mut Vec<u8>, steps: i64) {
        if steps < 0 {
            out.push(b'-');
        }
        let magnitude = steps.unsigned_abs();
        if self.profile.unit == NumberUnit::Um {
            return push_number(out, magnitude, 0);
        }
        let per_mm = 10_u64.pow(u32::from(self.profile.decimals));
        push_number(out, magnitude / per_mm, 0);
        out.push(b'.');
        push_places(out, magnitude % per_mm, self.profile.decimals.into());
    }

    /// `cuts` says that the paths hold more than thread holes.
    pub(super) fn finish(mut self, cuts: bool) -> Proved<ProvedProgram> {
        if self.made.blocks == 0 && cuts {
            return Err(nothing_to_write());
        }
        self.side = None;
        self.last_lines(&self.profile.end, self.zero)?;
        let step_um = self.step_um();
        self.made.finished(self.out, step_um)
    }
}

/// A space before every word but the first.
pub(super) struct Separator {
    wanted: bool,
    first: bool,
}

impl Separator {
    pub(super) fn push(&mut self, out: &mut Vec<u8>, word: &[u8]) {
        if self.wanted && !self.first {
            out.push(b' ');
        }
        self.first = false;
        out.extend_from_slice(word);
    }
}
