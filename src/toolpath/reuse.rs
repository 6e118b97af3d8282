//! A path as it was before an edit, beside walls of which most are where they were.

use super::clearance::Walls;
use super::corners::Element;
use super::offset::Wall;
use super::path::Source;
use crate::geometry::Bounds;
use std::ops::Range;

/// A wall that was not there before.
pub(super) const NEW: u32 = u32::MAX;

/// The path beside a contour as it was before an edit, proved at the same correction on the same side.
pub(super) struct PathBefore<'a> {
    /// How many walls there were.
    pub(super) before: usize,
    /// For each wall, the index that it had before.
    pub(super) was: Vec<u32>,
    pub(super) pieces: &'a Walls,
    /// What each piece followed before.
    pub(super) follows: &'a [u32],
}

/// Of each that was there before which one it is now, or that it is gone, [`NEW`]; `was` says of each which it was.
pub(super) fn which_it_is(was: &[u32], before: usize) -> Vec<u32> {
    let mut is = vec![NEW; before];
    for (was, now) in was.iter().zip(0..) {
        if let Some(is) = is.get_mut(*was as usize) {
            *is = now;
        }
    }
    is
}

impl<'a> PathBefore<'a> {
    /// `was` says of each wall which it was; `follows` is what [`follows`] said of the path.
    pub(crate) fn new(
        before: usize,
        was: Vec<u32>,
        pieces: &'a Walls,
        follows: &'a [u32],
    ) -> PathBefore<'a> {
        PathBefore {
            before,
            was,
            pieces,
            follows,
        }
    }

    /// The boxes of what was not there before, among the walls as they are now, grown by `distance`.
    pub(crate) fn about(&self, walls: &Walls, distance: f64) -> Vec<Bounds> {
        let new = (0..self.was.len()).filter(|&wall| self.was[wall] == NEW);
        new.map(|wall| walls.bounds_of(wall).grown(distance))
            .collect()
    }

    /// What an element beside a wall followed before the edit; `None` beside a new one.
    pub(super) fn followed(&self, element: &Element, wall: usize) -> Option<u32> {
        let was = self.was[wall];
        (was != NEW).then(|| follows_of(was, element))
    }

    /// True for a wall that was there, and before the one that it is before now.
    pub(super) fn leads_on(&self, wall: usize) -> bool {
        let next = if wall + 1 == self.was.len() {
            0
        } else {
            wall + 1
        };
        let (was, next) = (self.was[wall], self.was[next]);
        was != NEW && (next == was + 1 || next == 0 && was as usize + 1 == self.before)
    }

    /// A stretch of pieces and what stands in their place, without those at its ends that are as they were.
    pub(super) fn changed(
        &self,
        (mut gone, mut new): (Range<usize>, Vec<Element>),
    ) -> (Range<usize>, Vec<Element>) {
        let stays = |piece: usize, element: &Element| {
            self.followed(element, element.wall) == Some(self.follows[piece])
                && (!element.is_roll() || self.leads_on(element.wall))
                && *self.pieces.segment(piece) == element.geometry
        };
        let both = gone.clone().zip(&new);
        let first = both.take_while(|(piece, it)| stays(*piece, it)).count();
        gone.start += first;
        new.drain(..first);
        while let Some(last) = new.last()
            && !gone.is_empty()
            && stays(gone.end - 1, last)
        {
            gone.end -= 1;
            new.pop();
        }
        (gone, new)
    }

    /// A piece as it was, beside a wall that is now that one.
    pub(super) fn piece(&self, piece: usize, wall: usize, walls: &[Wall]) -> Element {
        let source = match walls.get(wall).map_or(Source::Tab, |wall| wall.source) {
            Source::Segment { entity, segment } if self.follows[piece] % 2 == 1 => {
                Source::Corner { entity, segment }
            }
            source => source,
        };
        Element {
            geometry: *self.pieces.segment(piece),
            source,
            wall,
        }
    }
}

/// Of each element twice its wall, and one more for the way round the end of that.
pub(super) fn follows(path: &[Element]) -> Vec<u32> {
    let follows = |element: &Element| follows_of(element.wall as u32, element);
    path.iter().map(follows).collect()
}

pub(super) fn follows_of(wall: u32, element: &Element) -> u32 {
    2 * wall + u32::from(element.is_roll())
}
