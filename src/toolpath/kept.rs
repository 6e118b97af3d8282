//! What of a path holds since before an edit: a piece that is where it was, beside walls that are where they were, is not proved again.

use super::clearance::Walls;
use super::corners::Element;
use crate::geometry::{Bounds, Segment};

/// Where more walls have changed, all is looked at.
const MOST_CHANGED: usize = 64;

/// Where a wall, or a piece, is not what it was, so many behind it are looked at for where the two are the same again.
const AHEAD: usize = 8;

/// A wall that was not there before.
const NEW: u32 = u32::MAX;

/// The path beside a contour as it was before an edit, proved at the same correction on the same side.
pub(super) struct Kept<'a> {
    /// Of each wall which it was.
    was: Vec<u32>,
    pieces: &'a Walls,
    /// Of each piece its wall, as they were.
    follows: &'a [u32],
    at: usize,
}

impl<'a> Kept<'a> {
    /// `None` where too much has changed: `before` and `now` are the walls.
    pub(crate) fn new<'w>(
        before: &[&'w Segment],
        now: &[Segment],
        pieces: &'a Walls,
        follows: &'a [u32],
    ) -> Option<Kept<'a>> {
        let mut was = Vec::with_capacity(now.len());
        let (mut at, mut changed) = (0, 0);
        while let Some(wall) = now.get(was.len()) {
            if before.get(at).is_some_and(|before| *before == wall) {
                was.push(at as u32);
                at += 1;
                continue;
            }
            let is_same = |&(old, new): &(usize, usize)| {
                let pair = before.get(at + old).zip(now.get(was.len() + new));
                pair.is_some_and(|(before, now)| *before == now)
            };
            let mut steps =
                (1..2 * AHEAD).flat_map(|all| (0..=all).map(move |old| (old, all - old)));
            let (gone, new) = steps.find(is_same).unwrap_or((AHEAD, AHEAD));
            at += gone;
            changed += new;
            if changed > MOST_CHANGED {
                return None;
            }
            let new = new.min(now.len() - was.len());
            was.extend(std::iter::repeat_n(NEW, new));
        }
        Some(Kept {
            was,
            pieces,
            follows,
            at: 0,
        })
    }

    /// The boxes of what was not there before, among the walls as they are now, and so far about them.
    pub(crate) fn about(&self, walls: &Walls, distance: f64) -> Vec<Bounds> {
        let new = (0..self.was.len()).filter(|&wall| self.was[wall] == NEW);
        new.map(|wall| walls.bounds_of(wall).grown(distance))
            .collect()
    }

    /// True for a piece that is as proved as it was; `about` are the boxes of what is new.
    pub(crate) fn holds(&mut self, element: &Element, about: &[Bounds]) -> bool {
        let wall = self.was[element.wall];
        let known = self.follows.len().min(self.at + AHEAD);
        let is_same = |&piece: &usize| {
            self.follows[piece] == wall && *self.pieces.segment(piece) == element.geometry
        };
        let Some(piece) = (self.at..known).find(is_same) else {
            return false;
        };
        self.at = piece + 1;
        let bounds = self.pieces.bounds_of(piece);
        !about.iter().any(|new| new.touches(bounds))
    }
}

/// Of each element its wall.
pub(super) fn follows(path: &[Element]) -> Vec<u32> {
    path.iter().map(|element| element.wall as u32).collect()
}
