//! A cut: lines up to the stop behind moves that cut, or up to a rapid behind them, run.
//!
//! Places count from where the wire stands when it enters these lines, bytes from the first of them, so that an edit
//! elsewhere changes nothing here.

use super::block::{Code, Register, Stop};
use super::evidence::Evidence;
use super::machine::Machine;
use super::moves::{Move, Place};
use super::summary::{Spur, Summary, WireSide};
use super::word::Term;
use crate::finding::Finding;
use crate::geometry::Bounds;
use crate::program::path::{Found, Verdict};
use std::sync::Arc;

/// The state in which the machine enters a cut.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    /// Where the wire stands, nm.
    pub(crate) at: Place,
    /// All else: many cuts share it.
    rest: Arc<Machine>,
}

impl Entry {
    /// The state of a machine; `before` may be the same but for its place.
    pub(crate) fn of(machine: Machine, before: Option<&Entry>) -> Entry {
        let rest = Machine {
            at: [0, 0],
            ..machine
        };
        let before = before.filter(|before| *before.rest == rest);
        Entry {
            at: machine.at,
            rest: before.map_or_else(|| Arc::new(rest), |before| before.rest.clone()),
        }
    }

    pub(crate) fn machine(&self) -> Machine {
        Machine {
            at: self.at,
            ..*self.rest
        }
    }

    /// Whether it is another one in its place alone.
    pub(crate) fn is_like(&self, other: &Entry) -> bool {
        Arc::ptr_eq(&self.rest, &other.rest) || self.rest == other.rest
    }

    /// The same elsewhere.
    pub(crate) fn at(&self, at: Place) -> Entry {
        Entry {
            at,
            rest: self.rest.clone(),
        }
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
    pub(crate) offset: Register,
    pub(crate) terms: Vec<Term>,
    pub(crate) inch: bool,
    pub(crate) range: (u32, u32),
}

/// Lines that have been run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Cut {
    /// The moves that cut; also `None` where they are sound and nothing else is to be known of them.
    pub(crate) moves: Option<Box<Moves>>,
    /// There are moves that cut.
    pub(crate) cuts: bool,
    /// Around these, µm, from where the wire enters.
    pub(crate) bounds: Option<Bounds>,
    /// Pauses before these, and whether nothing has moved between two of them.
    pub(crate) pauses_before: u32,
    pub(crate) pauses_again: bool,
    /// The stop that ends it, or the program; the byte at which its line begins.
    pub(crate) stop: Option<(Stop, u32)>,
    /// Moves, with those that do not cut.
    pub(crate) steps: u32,
    /// What few lines have.
    pub(super) rare: Option<Box<Rare>>,
    /// What its lines say of how numbers are meant.
    pub(crate) evidence: Evidence,
    /// The decimals that its numbers have: a bit for each count of them.
    pub(crate) places: u8,
    /// There are lengths without a decimal point that are not 0, and with one.
    pub(crate) has_bare: bool,
    pub(crate) has_pointed: bool,
    /// A word of it has the control make a corner.
    pub(crate) has_corners: bool,
    /// A subprogram is called.
    pub(crate) calls: bool,
    /// The program has ended.
    pub(crate) ended: bool,
    /// It holds coordinates under G90, or an absolute centre, or G92: its effect depends on where the wire stands before it.
    pub(crate) fixed: bool,
    /// Lines that may have an N word.
    pub(crate) blocks: u32,
    /// The numbers of N words, with the byte at which their lines begin; none for the `O` of another program, which has its
    /// own numbers.
    pub(crate) numbers: Vec<(Option<u32>, u32)>,
    /// The last line with any content.
    pub(crate) last_words: Option<(u32, u32)>,
}

/// What few lines have.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Rare {
    /// The faults of single lines.
    pub(crate) faults: Vec<Finding>,
    pub(crate) foreign: Vec<Foreign>,
    pub(crate) definitions: Vec<Definition>,
    /// The first line with an arc that counts as evidence.
    pub(crate) first_center: Option<(u32, u32)>,
    /// The first words after the end.
    pub(crate) behind_end: Option<(u32, u32)>,
}

/// The moves of a cut that cut, and what is known of them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Moves {
    pub(crate) sum: Summary,
    pub(crate) verdict: Verdict,
    /// Where they cross each other, if they do, and what an offset loses of them.
    pub(crate) found: Option<Box<Found>>,
    pub(crate) spurs: Vec<Spur>,
    /// Whether there may be a finding about them as a whole, once that was looked at.
    pub(crate) is_doubtful: Option<bool>,
}

impl Moves {
    /// Whether others must know more of them than that they are there.
    pub(crate) fn tell_nothing(&self) -> bool {
        self.is_doubtful == Some(false)
            && self.verdict.goes_round
            && self.sum.side == WireSide::None
            && self.sum.switched_on == 0
    }
}

impl Cut {
    pub(crate) fn rare(&self) -> &Rare {
        static NONE: Rare = Rare {
            faults: Vec::new(),
            foreign: Vec::new(),
            definitions: Vec::new(),
            first_center: None,
            behind_end: None,
        };
        self.rare.as_deref().unwrap_or(&NONE)
    }

    pub(crate) fn keep(&mut self, rare: Rare) {
        self.rare = (rare != Rare::default()).then(|| Box::new(rare));
    }

    pub(crate) fn sum(&self) -> Option<&Summary> {
        self.moves.as_ref().map(|moves| &moves.sum)
    }

    /// Whether each of its numbers is larger than the one before.
    pub(crate) fn rise(&self) -> bool {
        let mut numbers = self.numbers.iter().filter_map(|(number, _)| *number);
        let Some(mut last) = numbers.next() else {
            return true;
        };
        numbers.all(|number| std::mem::replace(&mut last, number) < number)
    }
}

/// A move that cuts, and the bytes of its words in the text.
pub(crate) type Heard = (Move, std::ops::Range<usize>);
