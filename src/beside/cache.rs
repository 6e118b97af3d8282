//! Results kept with a drawing: programs that were written for it, and the settings under which a program was found to
//! be written.
//!
//! A program that we write depends only on the drawing, the settings and the format, not on the program compared with
//! it: it is kept as long as the drawing is, so that an edit of the program writes nothing.

use super::reference::{Asked, Of, Reference, Under};
use super::traced::Traced;
use super::way::{Way, way};
use std::sync::{Arc, Mutex, PoisonError};

/// The most blocks of programs that are kept.
const MOST: usize = 60_000;
/// The most blocks that may differ in a program that was searched before.
const EDITED: usize = 8;

/// The programs written for a drawing.
#[derive(Debug, Default)]
pub(super) struct Cache {
    /// With their settings; `None` where it cannot be written.
    written: Mutex<Vec<(Asked, Option<Arc<Reference>>)>>,
    /// The settings under which a program was last found to be written.
    guess: Mutex<Option<Guess>>,
}

/// The result of the last search.
#[derive(Clone, Debug)]
pub(super) struct Guess {
    pub(crate) under: Option<Under>,
    /// The differences of the searched program.
    pub(crate) left: usize,
    of: Vec<Way>,
}

impl Guess {
    pub(super) fn of(traced: &Traced, under: Option<Under>, left: usize) -> Guess {
        let of = traced.blocks.iter().map(|block| way(block, true)).collect();
        Guess { under, left, of }
    }

    /// Whether a program is the searched one, except for a few blocks in one place.
    pub(super) fn is_near(&self, traced: &Traced) -> bool {
        let ways = || traced.blocks.iter().map(|block| way(block, true));
        let alike = |(one, other): &(Way, Way)| one == other;
        let of = self.of.iter().copied();
        let before = ways().zip(of.clone()).take_while(alike).count();
        let behind = ways().rev().zip(of.rev()).take_while(alike).count();
        before + behind + EDITED >= self.of.len().max(traced.blocks.len())
    }
}

impl Cache {
    pub(super) fn reference(
        &self,
        of: &Of<'_>,
        traced: &Traced,
        under: &Under,
    ) -> Option<Arc<Reference>> {
        let asked = Asked::of(traced, under);
        let lock = || self.written.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = lock().iter().find(|(other, _)| *other == asked) {
            return known.clone();
        }
        let made = Reference::of(of, &asked).map(Arc::new);
        let mut written = lock();
        let blocks = |reference: &Option<Arc<Reference>>| {
            100 + reference
                .as_ref()
                .map_or(0, |reference| reference.traced.blocks.len())
        };
        let sum: usize = written.iter().map(|(_, reference)| blocks(reference)).sum();
        if sum + blocks(&made) > MOST {
            // The first is the one that the settings ask for.
            written.truncate(1);
        }
        written.push((asked, made.clone()));
        made
    }

    pub(super) fn guess(&self) -> Option<Guess> {
        let guess = self.guess.lock().unwrap_or_else(PoisonError::into_inner);
        guess.clone()
    }

    pub(super) fn note(&self, guess: Guess) {
        *self.guess.lock().unwrap_or_else(PoisonError::into_inner) = Some(guess);
    }
}
