//! The path beside a contour of which an edit has changed a stretch: it stays as it was, except for the pieces beside that stretch.
//!
//! Neighbours are cut with each other, and what they use up is taken out. Where three consecutive elements are all still there, or only one
//! between two of them has been used up by these two, what is taken out on one side of them does not depend on the other side. So the
//! stretch is made by itself, with some walls on either side of it, between two such groups of three that are what they were.

use super::clearance::Walls;
use super::corners::{Element, Joining, Offsets, Raw};
use super::offset::Wall;
use super::open_contour::there_and_back;
use super::reuse::{PathBefore, which_it_is};
use super::ring::trimmed_from;
use crate::geometry::Segment;
use std::ops::Range;

/// Walls on either side of the change that are laid again.
const ABOUT: usize = 16;

/// Where the changes spread over more walls, or the contour has hardly more, everything is made
/// again.
const MOST: usize = 128;

/// Some consecutive walls of a contour that are laid again.
struct RelaidStretch {
    first: usize,
    count: usize,
    /// In their order, each with its raw element.
    pieces: Vec<(usize, Element)>,
}

/// What takes the place of some pieces of a path.
pub(super) struct Splice {
    /// The last piece before and the first one after, which stay, by their old indices.
    left: usize,
    right: usize,
    /// The new pieces between them, in the order of travel.
    new: Vec<Element>,
    /// How many of them come before the end of the contour, where it lies among them.
    before_the_end: Option<usize>,
}

impl Splice {
    /// The pieces beside the walls that have changed; `None` where the kept path does not give all the others.
    pub(super) fn of(kept: &PathBefore, walls: &[Wall], joining: &Joining) -> Option<Splice> {
        let count = walls.len();
        if count <= MOST + 4 * ABOUT || !kept.follows.is_sorted() {
            return None;
        }
        let (first, changed) = changed(kept, count)?;
        let stretch =
            RelaidStretch::laid(walls, (first + count - ABOUT) % count, changed, joining)?;
        let on_left = |piece: &usize| (2..ABOUT - 2).contains(&stretch.place(*piece));
        let (right_first, right_last) = (stretch.count - ABOUT + 1, stretch.count - 2);
        let on_right = |piece: &usize| (right_first..right_last).contains(&stretch.place(*piece));
        let parted = |piece: usize| Some((piece, stretch.parts_two(kept, count, piece)?));
        let mut all = 1..stretch.pieces.len().checked_sub(1)?;
        let (first, left) = all.clone().rev().filter(on_left).find_map(parted)?;
        let (last, right) = all.find_map(|piece| parted(piece).filter(|_| on_right(&piece)))?;
        let is_behind = |piece: usize| stretch.first + stretch.place(piece) >= count;
        let goes_over_the_end = is_behind(last) != is_behind(first);
        let new = stretch.pieces.get(first + 1..last)?.iter();
        let new: Vec<Element> = new
            .map(|(_, element)| Element {
                wall: (stretch.first + element.wall) % count,
                ..*element
            })
            .collect();
        let before_the_end = goes_over_the_end.then(|| {
            let mut between = first + 1..last;
            between.position(is_behind).unwrap_or(new.len())
        });
        Some(Splice {
            left,
            right,
            new,
            before_the_end,
        })
    }

    /// The stretches where the path is not as it was, the last one first: which pieces go, and what takes their place.
    pub(super) fn stretches(self, kept: &PathBefore) -> Option<Vec<(Range<usize>, Vec<Element>)>> {
        let is = which_it_is(&kept.was, kept.before);
        let wall_of = |piece: usize| is[kept.follows[piece] as usize / 2] as usize;
        let walls = std::iter::once(wall_of(self.left))
            .chain(self.new.iter().map(|element| element.wall))
            .chain([wall_of(self.right)]);
        let walls: Vec<usize> = walls.collect();
        // They pass the end of the contour at most once.
        let falls = walls.windows(2).filter(|pair| pair[0] > pair[1]).count();
        let (left, right, mut new) = (self.left + 1, self.right, self.new);
        let stretches = match self.before_the_end {
            Some(before) if falls == 1 && right <= left => {
                let behind = new.split_off(before);
                vec![(left..kept.follows.len(), new), (0..right, behind)]
            }
            None if falls == 0 && left <= right => vec![(left..right, new)],
            _ => return None,
        };
        let changed = stretches.into_iter().map(|stretch| kept.changed(stretch));
        Some(
            changed
                .filter(|(gone, new)| !gone.is_empty() || !new.is_empty())
                .collect(),
        )
    }
}

/// The first wall of the stretch round the contour that holds all that has changed, and how many it holds.
fn changed(kept: &PathBefore, count: usize) -> Option<(usize, usize)> {
    let breaks: Vec<usize> = (0..count).filter(|&wall| !kept.leads_on(wall)).collect();
    let (Some(&first), Some(&last)) = (breaks.first(), breaks.last()) else {
        return Some((0, 1));
    };
    // The longest stretch from one to the next is the one that has not changed.
    let longest = breaks.windows(2).max_by_key(|pair| pair[1] - pair[0]);
    let over_the_end = first + count - last;
    let (first, last) = match longest {
        Some(pair) if pair[1] - pair[0] > over_the_end => (pair[1], pair[0] + count),
        _ => (first, last),
    };
    let changed = last + 2 - first;
    (changed <= MOST).then_some((first, changed))
}

impl RelaidStretch {
    /// Lays this many changed walls, with those on either side of them.
    fn laid(
        walls: &[Wall],
        first: usize,
        changed: usize,
        joining: &Joining,
    ) -> Option<RelaidStretch> {
        let count = changed + 2 * ABOUT;
        let some = (first..first + count).map(|wall| walls[wall % walls.len()]);
        // There and back, so that the two ends are not joined to each other.
        let some = there_and_back(&some.collect::<Vec<Wall>>());
        let segments: Vec<Segment> = some.iter().map(|wall| wall.geometry).collect();
        let own = Walls::by_one_core(segments);
        let raw = Raw::new(Offsets {
            walls: &some,
            tangents: own.tangents(),
            joining,
        });
        // What is taken out may depend on where that begins: for the whole contour it begins with the first wall.
        let begin = walls
            .len()
            .checked_sub(first)
            .filter(|begin| *begin < count);
        let pieces = trimmed_from(&raw, begin.map_or(0, |wall| raw.first_of(wall)))?;
        let pieces = pieces.pairs().filter(|(_, piece)| piece.wall < count);
        let pieces: Vec<(usize, Element)> = pieces.collect();
        let is_sorted = pieces.is_sorted_by(|a, b| a.0 < b.0);
        is_sorted.then_some(RelaidStretch {
            first,
            count,
            pieces,
        })
    }

    /// The wall of a piece, counted from the first one of the stretch.
    fn place(&self, piece: usize) -> usize {
        self.pieces[piece].1.wall
    }

    /// The old index of a piece that, with its two neighbours, parts what comes before it from what comes after it, now as before.
    fn parts_two(&self, kept: &PathBefore, count: usize, piece: usize) -> Option<usize> {
        let was = |piece: usize| {
            let element = &self.pieces[piece].1;
            let follows = kept.followed(element, (self.first + element.wall) % count)?;
            let at = kept.follows.partition_point(|other| *other < follows);
            let is_same = kept.follows.get(at) == Some(&follows)
                && *kept.pieces.segment(at) == element.geometry;
            is_same.then_some(at)
        };
        let (before, at, behind) = (was(piece - 1)?, was(piece)?, was(piece + 1)?);
        let raw = [piece - 1, piece, piece + 1].map(|piece| self.pieces[piece].0);
        let stand_together = raw.windows(2).all(|pair| pair[1] - pair[0] <= 2);
        (stand_together && before + 1 == at && at + 1 == behind).then_some(at)
    }
}
