//! What of a path holds since before an edit: a piece that is where it was, beside walls that are where they were, is not proved again.

use super::clearance::Walls;
use super::corners::Element;
use crate::geometry::{Bounds, Segment};

/// Where more walls have changed, all is looked at.
const MOST_CHANGED: usize = 64;

/// So many pieces of the path as it was are looked at for one.
const AHEAD: usize = 8;

/// The path beside a contour as it was before an edit, proved at the same correction on the same side.
pub(super) struct Kept<'a> {
    /// The walls that stand elsewhere since, rising.
    changed: Vec<usize>,
    pieces: &'a Walls,
    /// Of each piece its wall.
    follows: &'a [u32],
    at: usize,
}

impl<'a> Kept<'a> {
    /// `None` where too much has changed: `before` and `now` are the walls.
    pub(crate) fn new<'w>(
        before: impl ExactSizeIterator<Item = &'w Segment>,
        now: impl ExactSizeIterator<Item = &'w Segment>,
        pieces: &'a Walls,
        follows: &'a [u32],
    ) -> Option<Kept<'a>> {
        if before.len() != now.len() {
            return None;
        }
        let pairs = before.zip(now).enumerate();
        let changed = pairs.filter(|(_, (before, now))| before != now);
        let changed: Vec<usize> = changed
            .map(|(wall, _)| wall)
            .take(MOST_CHANGED + 1)
            .collect();
        (changed.len() <= MOST_CHANGED).then_some(Kept {
            changed,
            pieces,
            follows,
            at: 0,
        })
    }

    /// The boxes of what stands elsewhere, among the walls as they are now, and so far about them.
    pub(crate) fn about(&self, walls: &Walls, distance: f64) -> Vec<Bounds> {
        let boxes = self.changed.iter().map(|&wall| walls.bounds_of(wall));
        boxes.map(|bounds| bounds.grown(distance)).collect()
    }

    /// True for a piece that is as proved as it was; `about` are the boxes of what has changed.
    pub(crate) fn holds(&mut self, element: &Element, about: &[Bounds]) -> bool {
        let known = self.follows.len().min(self.at + AHEAD);
        let is_same = |&piece: &usize| {
            self.follows[piece] as usize == element.wall
                && *self.pieces.segment(piece) == element.geometry
        };
        let Some(piece) = (self.at..known).find(is_same) else {
            return false;
        };
        self.at = piece + 1;
        let bounds = self.pieces.bounds_of(piece);
        self.changed.binary_search(&element.wall).is_err()
            && !about.iter().any(|changed| changed.touches(bounds))
    }
}

/// Of each element its wall.
pub(super) fn follows(path: &[Element]) -> Vec<u32> {
    path.iter().map(|element| element.wall as u32).collect()
}
