//! What is kept with a drawing: programs that were written for it, and what a program was found to be written under.
//!
//! A program that we write hangs on the drawing, the settings and the format alone, not on the one that is held against it: it is kept as
//! long as the drawing is, so that an edit of the program writes nothing.

use super::anew::{Anew, Asked, Of, Under};
use super::traced::Traced;
use super::way::{Way, way};
use std::sync::{Arc, Mutex, PoisonError};

/// Blocks of programs that are kept, at most.
const MOST: usize = 60_000;
/// Blocks that may be others in a program that was searched before.
const EDITED: usize = 8;

/// What has been written for a drawing.
#[derive(Debug, Default)]
pub(super) struct Kept {
    /// With what it was written by; nothing where that cannot be.
    written: Mutex<Vec<(Asked, Option<Arc<Anew>>)>>,
    /// Under what a program was found to be written last.
    guess: Mutex<Option<Guess>>,
}

/// What came of the last search.
#[derive(Clone, Debug)]
pub(super) struct Guess {
    pub under: Option<Under>,
    /// What the program that was searched does otherwise.
    pub left: usize,
    of: Vec<Way>,
}

impl Guess {
    pub fn of(traced: &Traced, under: Option<Under>, left: usize) -> Guess {
        let of = traced.blocks.iter().map(|block| way(block, true)).collect();
        Guess { under, left, of }
    }

    /// Whether a program is that which was searched, but for a few blocks in one place.
    pub fn is_near(&self, traced: &Traced) -> bool {
        let ways = || traced.blocks.iter().map(|block| way(block, true));
        let alike = |(one, other): &(Way, Way)| one == other;
        let of = self.of.iter().copied();
        let before = ways().zip(of.clone()).take_while(alike).count();
        let behind = ways().rev().zip(of.rev()).take_while(alike).count();
        before + behind + EDITED >= self.of.len().max(traced.blocks.len())
    }
}

impl Kept {
    pub fn anew(&self, of: &Of<'_>, traced: &Traced, under: &Under) -> Option<Arc<Anew>> {
        let asked = Asked::of(traced, under);
        let lock = || self.written.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = lock().iter().find(|(other, _)| *other == asked) {
            return known.clone();
        }
        let made = Anew::of(of, &asked).map(Arc::new);
        let mut kept = lock();
        let blocks = |anew: &Option<Arc<Anew>>| {
            100 + anew.as_ref().map_or(0, |anew| anew.traced.blocks.len())
        };
        let sum: usize = kept.iter().map(|(_, anew)| blocks(anew)).sum();
        if sum + blocks(&made) > MOST {
            // The first is the one that the settings ask for.
            kept.truncate(1);
        }
        kept.push((asked, made.clone()));
        made
    }

    pub fn guess(&self) -> Option<Guess> {
        let guess = self.guess.lock().unwrap_or_else(PoisonError::into_inner);
        guess.clone()
    }

    pub fn note(&self, guess: Guess) {
        *self.guess.lock().unwrap_or_else(PoisonError::into_inner) = Some(guess);
    }
}
