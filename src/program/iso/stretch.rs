//! Some lines of a program, run: the state after them, their findings, and their cuts.
//!
//! A program is kept as stretches of lines, so that an edit runs only the stretch that it touched, and those after it
//! whose state changes. A stretch that only moved is shifted, not run.

use super::block::{Code, Offset};
use super::evidence::Evidence;
use super::machine::Machine;
use super::moves::{Place, Reading, added, micrometres};
use super::part::{Part, Spur, Tight, Tightest, Ways};
use super::word::Term;
use crate::finding::Finding;
use crate::geometry::Bounds;
use crate::program::path::Lay;
use crate::program::steps::Sum;
use std::ops::Range;

/// Lines that have been run, without their paths yet.
pub(crate) struct Pathless {
    pub(crate) stretch: Stretch,
    pub(crate) ways: Vec<Ways>,
}

impl Pathless {
    /// The state after it.
    pub(crate) fn after(&self) -> Machine {
        self.stretch.after
    }

    /// How each part lies relative to itself: this takes time, and depends only on the moves and on how numbers are
    /// read. `old` stretches may know it for some parts.
    pub(crate) fn with_paths(self, old: &[Stretch]) -> Stretch {
        let Pathless { mut stretch, ways } = self;
        stretch.parts.shrink_to_fit();
        let inner = stretch.inner();
        for (index, ways) in ways.into_iter().enumerate() {
            let is_whole = inner.contains(&index);
            let old = old.iter().filter(|old| old.reading == stretch.reading);
            let old = old.flat_map(|old| &old.lays);
            let lay = ways.lay(&stretch.reading, is_whole, &stretch.lays, old);
            stretch.lays.push(lay);
        }
        stretch.lays.shrink_to_fit();
        let own = stretch.parts.iter().zip(&stretch.lays);
        let placed = own.map(|(part, lay)| lay.bounds.moved(micrometres(part.start()).coords));
        stretch.bounds = placed.reduce(|one, other| one.merged(&other));
        stretch
    }
}

/// A word whose meaning depends on the machine, its first place, and how often it occurs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Foreign {
    pub(crate) code: Code,
    pub(crate) range: (u32, u32),
    pub(crate) count: u32,
}

/// A value for the control's table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Definition {
    pub(crate) offset: Offset,
    pub(crate) terms: Vec<Term>,
    pub(crate) inch: bool,
    pub(crate) range: (u32, u32),
}

/// Lines that have been run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Stretch {
    pub(crate) before: Machine,
    pub(crate) after: Machine,
    /// How the numbers were read.
    pub(crate) reading: Reading,
    pub(crate) evidence: Evidence,
    /// The first line with an arc that counts as evidence.
    pub(crate) first_center: Option<(u32, u32)>,
    /// The faults of single lines; places are bytes from the start of the stretch.
    pub(crate) faults: Vec<Finding>,
    /// In the order of their parts, at their places before the stretch was moved, as `parts`.
    pub(crate) tight: Vec<Tight>,
    pub(crate) tightest: Tightest,
    /// In the same order, and at the same places.
    pub(crate) spurs: Vec<Spur>,
    pub(crate) parts: Vec<Part>,
    /// How far it has been moved since its lines were run.
    pub(crate) moved: Place,
    /// For each part, how it lies relative to itself.
    pub(crate) lays: Vec<Lay>,
    /// Around all of them, µm, at their places before the stretch was moved.
    pub(crate) bounds: Option<Bounds>,
    /// The parts that begin and end here are known to be sound as a whole.
    pub(crate) is_clean: bool,
    /// Those of them that are no longer held: knowing that they are sound is enough.
    pub(crate) gone: Range<usize>,
    /// Nothing is known yet about the cuts that run through it.
    pub(crate) is_fresh: bool,
    pub(crate) foreign: Vec<Foreign>,
    pub(crate) definitions: Vec<Definition>,
    /// The first lengths without a decimal point that are not 0, and the first with one.
    pub(crate) lengths: [Vec<(u32, u32)>; 2],
    /// How many lines after its own decide how its last ones run.
    pub(crate) ahead: u32,
    /// Whether the wire's position was lost since the last rapid or stop matters before the first
    /// one here, and not only to the part that goes on from before.
    pub(crate) heeds_loss: bool,
    /// There is a rapid or a stop.
    pub(crate) leaves_cut: bool,
    /// A word of it has the control make a corner.
    pub(crate) has_corners: bool,
    /// N words with the byte at which they stand.
    pub(crate) numbers: Vec<(u32, u32)>,
    /// Each of them is larger than the one before.
    pub(crate) numbers_rise: bool,
    /// Lines that may have an N word.
    pub(crate) blocks: u32,
    /// Where a program or subprogram begins (`O`), which has its own numbers: how many N words stand before it.
    pub(crate) programs: Vec<u32>,
    /// A cut that was in progress before these lines ends without a move of theirs; true where all of it could be read.
    pub(crate) ends_cut_before: Option<bool>,
    /// The stop before the first cut of these lines, as [`Part::stop`].
    pub(crate) stop_before: Option<u32>,
    /// As [`Part::ends_open`] of the last cut before these lines.
    pub(crate) ends_open_before: bool,
    /// A line of that cut has a fault.
    pub(crate) faulty_before: bool,
    /// The first words after the end.
    pub(crate) behind_end: Option<(u32, u32)>,
    /// The last line with any content.
    pub(crate) last_words: Option<(u32, u32)>,
    /// A subprogram is called.
    pub(crate) calls: bool,
    /// Blocks that move the wire, and stops on the way.
    pub(crate) moves: u32,
    pub(crate) pauses: u32,
    /// The totals of its lines' steps, wherever the stops of contours are.
    pub(crate) sum: Sum,
    /// It holds coordinates under G90, or an absolute centre, or G92: its effect depends on the wire's position before
    /// it.
    pub(crate) fixed: bool,
}

/// A stretch and its place.
pub(crate) struct Placed<'a> {
    pub stretch: &'a Stretch,
    pub lines: Range<usize>,
    /// Byte of the text from which the stretch's places count.
    pub offset: usize,
}

/// A stop: the index of its stretch, and its byte counted from there.
pub(crate) type StopAt = (usize, usize);

impl Stretch {
    /// True when these lines do the same wherever the wire stands before them.
    pub(crate) fn is_loose(&self) -> bool {
        !self.fixed
    }

    /// Moves the effects of these lines by `by`.
    pub(crate) fn shift(&mut self, by: Place) {
        self.before.at = added(self.before.at, by);
        self.after.at = added(self.after.at, by);
        self.moved = added(self.moved, by);
    }

    /// Sets whether the wire's position was lost since the last rapid or stop before; false where
    /// that changes more than whether the continued part could be read.
    pub(crate) fn tear(&mut self, torn: bool) -> bool {
        if torn != self.before.torn {
            if self.heeds_loss {
                return false;
            }
            self.before.torn = torn;
            if !self.leaves_cut {
                self.after.torn = torn;
            }
            if let Some(part) = self.parts.first_mut().filter(|part| part.continues) {
                part.whole = !torn;
            }
            self.is_fresh = true;
        }
        true
    }

    /// A cut begins or ends in here: the lines after do not depend on those before.
    pub(crate) fn bounds_cuts(&self) -> bool {
        self.ends_cut_before.is_some()
            || !self.gone.is_empty()
            || self.parts.iter().any(|part| !part.continues)
    }

    pub(crate) fn part_count(&self) -> usize {
        self.parts.len() + self.gone.len()
    }

    /// Where a part is held; `None` for one that is gone.
    fn held(&self, index: usize) -> Option<usize> {
        match index.checked_sub(self.gone.start) {
            Some(behind) => Some(self.gone.start + behind.checked_sub(self.gone.len())?),
            None => Some(index),
        }
    }

    /// A part at its place; `None` for one that is gone.
    pub(crate) fn part_at(&self, index: usize) -> Option<Part> {
        let mut part = *self.parts.get(self.held(index)?)?;
        part.shift(self.moved);
        Some(part)
    }

    /// Those that are held.
    pub(crate) fn parts(&self) -> impl Iterator<Item = Part> + '_ {
        (0..self.part_count()).filter_map(|index| self.part_at(index))
    }

    pub(crate) fn lay(&self, index: usize) -> Option<&Lay> {
        self.lays.get(self.held(index)?)
    }

    /// The start of a part, its number of moves and of arcs.
    pub(crate) fn extent(&self, index: usize) -> Option<(Place, u32, u32)> {
        let part = self.parts.get(self.held(index)?)?;
        Some((added(part.start(), self.moved), part.moves, part.arcs))
    }

    /// The parts that begin and end here.
    pub(crate) fn inner(&self) -> Range<usize> {
        let first = usize::from(self.parts.first().is_some_and(|part| part.continues));
        let open = usize::from(self.parts.last().is_some_and(|part| part.open));
        first..(self.part_count() - open).max(first)
    }

    /// Marks the parts that begin and end here as sound, and drops them.
    pub(crate) fn let_go(&mut self) {
        self.is_clean = true;
        if !self.gone.is_empty() {
            return;
        }
        let gone = self.inner();
        self.parts.drain(gone.clone());
        self.lays.drain(gone.clone());
        self.tight
            .retain(|tight| !gone.contains(&(tight.part as usize)));
        self.parts.shrink_to_fit();
        self.lays.shrink_to_fit();
        self.tight.shrink_to_fit();
        self.spurs
            .retain(|spur| !gone.contains(&(spur.part as usize)));
        self.spurs.shrink_to_fit();
        self.gone = gone;
    }

    /// Forgets what is known to be sound; false where its lines must be run again for that.
    pub(crate) fn look_again(&mut self) -> bool {
        self.is_clean = false;
        self.gone.is_empty()
    }

    /// The arcs of a part that may be tighter than a correction, at their places.
    pub(crate) fn tight_of(&self, part: usize) -> impl Iterator<Item = Tight> + '_ {
        let first = self
            .tight
            .partition_point(|tight| (tight.part as usize) < part);
        let of_run = self.tight[first..]
            .iter()
            .take_while(move |tight| tight.part as usize == part);
        of_run.map(|tight| Tight {
            arc: tight.arc.shifted(self.moved),
            ..*tight
        })
    }

    /// The ways out and back within a part, at their places.
    pub(crate) fn spurs_of(&self, part: usize) -> impl Iterator<Item = Spur> + '_ {
        let of_part = self
            .spurs
            .iter()
            .filter(move |spur| spur.part as usize == part);
        of_part.map(|spur| Spur {
            tip: added(spur.tip, self.moved),
            ..*spur
        })
    }
}
