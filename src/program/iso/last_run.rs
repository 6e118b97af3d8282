//! The moves of the stretch that was run last: who asks for one of its contours mostly asks for the next one, too.

use super::moves::Move;
use super::part::Hears;
use std::sync::{Arc, Mutex, PoisonError};

/// A move with its part, and its bytes counted from the stretch's start.
type Heard = (usize, Move, (u32, u32));

/// Kept for as long as no stretch changes; a copy of a document has none.
#[derive(Debug, Default)]
pub(super) struct LastRun(Mutex<Option<(usize, Arc<[Heard]>)>>);

impl Clone for LastRun {
    fn clone(&self) -> LastRun {
        LastRun::default()
    }
}

impl LastRun {
    /// The moves of a stretch, by its index; `run` runs it where another one was run last.
    pub(super) fn of(&self, stretch: usize, run: impl FnOnce(&mut Hears<'_>)) -> Arc<[Heard]> {
        let last = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, moves)) = last().as_ref().filter(|(index, _)| *index == stretch) {
            return moves.clone();
        }
        let mut moves = Vec::new();
        run(&mut |part, step, range| moves.push((part, *step, range)));
        let moves: Arc<[Heard]> = moves.into();
        *last() = Some((stretch, moves.clone()));
        moves
    }
}
