//! The path beside a contour of which an edit has changed a stretch: as it was, but for the pieces beside that stretch.
//!
//! Neighbours are cut with each other, and what they use up goes: where three elements that follow each other are all there, what goes on one
//! side of them does not hang on the other side. So the stretch is laid by itself, with some walls about it, from three such elements to
//! three others that are what they were.

use super::clearance::Walls;
use super::corners::{Element, Joining, Raw};
use super::kept::{Kept, NEW};
use super::offset::Wall;
use super::open::there_and_back;
use super::path::Source;
use super::ring::trimmed;
use crate::geometry::Segment;
use std::ops::Range;

/// Walls that are laid anew about what has changed.
const ABOUT: usize = 16;

/// Where what has changed lies so many walls apart, or of a contour of so few, all is laid anew.
const MOST: usize = 128;

/// Some walls that are laid anew, round a contour from the first on.
struct Stretch {
    first: usize,
    count: usize,
    /// Of each wall its pieces, and whether nothing of it has gone.
    pieces: Vec<(Range<usize>, bool)>,
    path: Vec<(usize, Element)>,
}

/// The path beside the walls, where what is kept says most of it; `None` where it does not.
pub(super) fn spliced(kept: &Kept, walls: &[Wall], joining: &Joining) -> Option<Vec<Element>> {
    let count = walls.len();
    if count <= MOST + 4 * ABOUT || !kept.follows.is_sorted() {
        return None;
    }
    let (first, changed) = changed(kept, count)?;
    let stretch = Stretch::laid(walls, (first + count - ABOUT) % count, changed, joining)?;
    let is_as_it_was = |place: usize| {
        let wall = (stretch.first + place) % count;
        let (pieces, is_whole) = &stretch.pieces[place];
        let was = kept.was[wall];
        *is_whole && was != NEW && {
            let now = stretch.path[pieces.clone()].iter();
            let before = of_wall(kept, was);
            before.len() == pieces.len()
                && now.zip(before).all(|((_, element), piece)| {
                    element.geometry == *kept.pieces.segment(piece)
                        && kept.follows[piece] % 2 == u32::from(is_roll(element))
                })
        }
    };
    let parts_two = |place: &usize| (place - 1..=place + 1).all(is_as_it_was);
    let from = (2..ABOUT - 1).rev().find(parts_two)?;
    let to = (stretch.count - ABOUT + 1..stretch.count - 2).find(parts_two)?;
    // What goes where begin and end of the contour meet may hang on what is looked at first.
    let goes_over_the_end = stretch.first + from < count && stretch.first + to >= count;
    if goes_over_the_end
        && !stretch.pieces[from..to]
            .iter()
            .all(|(_, is_whole)| *is_whole)
    {
        return None;
    }
    let mut path = Vec::with_capacity(kept.follows.len() + stretch.path.len());
    let mut next: Option<usize> = None;
    for (wall, of) in walls.iter().enumerate() {
        let place = (wall + count - stretch.first) % count;
        if (from + 1..to).contains(&place) {
            let pieces = &stretch.path[stretch.pieces[place].0.clone()];
            path.extend(
                pieces
                    .iter()
                    .map(|(_, element)| Element { wall, ..*element }),
            );
            next = None;
            continue;
        }
        let was = kept.was[wall];
        let mut piece = next.unwrap_or_else(|| of_wall(kept, was).start);
        while let Some(follows) = kept.follows.get(piece).filter(|it| *it / 2 == was) {
            let source = match of.source {
                Source::Segment { entity, segment } if follows % 2 == 1 => {
                    Source::Corner { entity, segment }
                }
                source => source,
            };
            path.push(Element {
                geometry: *kept.pieces.segment(piece),
                source,
                wall,
            });
            piece += 1;
        }
        next = Some(piece);
    }
    (path.len() >= 2).then_some(path)
}

fn is_roll(element: &Element) -> bool {
    matches!(element.source, Source::Corner { .. })
}

/// The pieces of a wall as they were.
fn of_wall(kept: &Kept, wall: u32) -> Range<usize> {
    let end = |wall: u32| kept.follows.partition_point(|follows| follows / 2 < wall);
    end(wall)..end(wall + 1)
}

/// The first wall of the stretch round the contour that holds all that has changed, and how many it holds.
fn changed(kept: &Kept, count: usize) -> Option<(usize, usize)> {
    let leads_on = |wall: usize| {
        let (was, next) = (
            kept.was[wall],
            kept.was[if wall + 1 == count { 0 } else { wall + 1 }],
        );
        was != NEW && (next == was + 1 || next == 0 && was as usize + 1 == kept.before)
    };
    let breaks: Vec<usize> = (0..count).filter(|&wall| !leads_on(wall)).collect();
    let (Some(&first), Some(&last)) = (breaks.first(), breaks.last()) else {
        return Some((0, 1));
    };
    // The longest way from one to the next is the one that has not changed.
    let longest = breaks.windows(2).max_by_key(|pair| pair[1] - pair[0]);
    let over_the_end = first + count - last;
    let (first, last) = match longest {
        Some(pair) if pair[1] - pair[0] > over_the_end => (pair[1], pair[0] + count),
        _ => (first, last),
    };
    let changed = last + 2 - first;
    (changed <= MOST).then_some((first, changed))
}

impl Stretch {
    /// Lays so many walls that have changed, with those about them.
    fn laid(walls: &[Wall], first: usize, changed: usize, joining: &Joining) -> Option<Stretch> {
        let count = changed + 2 * ABOUT;
        let some = (first..first + count).map(|wall| walls[wall % walls.len()]);
        // Back on the other side, so that the ends are not joined to each other.
        let some = there_and_back(&some.collect::<Vec<Wall>>());
        let segments: Vec<Segment> = some.iter().map(|wall| wall.geometry).collect();
        let own = Walls::by_one_core(segments);
        let raw = Raw::new(&some, own.tangents(), joining);
        let path = trimmed(&raw)?;
        if !path.is_sorted_by_key(|(raw, _)| *raw) {
            return None;
        }
        let pieces = (0..count).map(|wall| {
            let of = raw.of_wall(wall);
            let start = path.partition_point(|(raw, _)| *raw < of.start);
            let end = path.partition_point(|(raw, _)| *raw < of.end);
            let is_whole = (start..end).map(|piece| path[piece].0).eq(of);
            (start..end, is_whole)
        });
        Some(Stretch {
            first,
            count,
            pieces: pieces.collect(),
            path,
        })
    }
}
