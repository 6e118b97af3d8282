//! What lies near each wall of a contour, for paths that run beside it. Knows nothing of walls but their boxes.

use crate::geometry::Bounds;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The number of consecutive walls in a group, which is called "few" here.
pub(super) const FAN: usize = 8;

/// The most walls that are kept for each few, on average.
const MOST_ABOUT: usize = 64;

/// Where more than this lies near a few, its walls share one list.
const MOST_OF_EACH: usize = 24;

/// Walls that one core takes at a time.
const AT_A_TIME: usize = 2048;

/// For each wall, the walls whose boxes come near its own.
#[derive(Clone, Debug)]
pub(super) struct Vicinity {
    pub(super) reach: f64,
    /// Where those of each wall begin and end in `walls`; all walls of a few that lies close to many have the same range.
    ranges: Vec<[u32; 2]>,
    walls: Vec<u32>,
}

impl Vicinity {
    /// What lies within `reach` of each wall, by the boxes of all; `None` where that is too much. `few_near` adds every few whose box touches a
    /// given one, by its first wall and with its box.
    pub(super) fn of(
        boxes: &[Bounds],
        reach: f64,
        few_near: impl Fn(&Bounds, &mut Vec<(u32, Bounds)>) + Sync,
    ) -> Option<Vicinity> {
        let (most, found) = (MOST_ABOUT * boxes.len().div_ceil(FAN), AtomicUsize::new(0));
        let part = |first: usize| {
            let last = (first + AT_A_TIME).min(boxes.len());
            let mut about = Vicinity {
                reach,
                ranges: Vec::with_capacity(last - first),
                walls: Vec::with_capacity(4 * (last - first)),
            };
            let (mut near_all, mut near) = (Vec::new(), Vec::new());
            for (at, few) in boxes[first..last].chunks(FAN).enumerate() {
                if at.is_multiple_of(FAN) {
                    // What is near to one few is among what is near to several of them.
                    let several = &boxes[first + at * FAN..last];
                    let several = several.iter().take(FAN * FAN);
                    near_all.clear();
                    few_near(&merged(several).grown(reach), &mut near_all);
                }
                let all = merged(few.iter()).grown(reach);
                near.clear();
                for &(first, _) in near_all.iter().filter(|(_, few)| few.touches(&all)) {
                    let walls = (first..).zip(&boxes[first as usize..]).take(FAN);
                    let walls = walls.filter(|(_, bounds)| bounds.touches(&all));
                    near.extend(walls.map(|(wall, _)| wall));
                }
                let begin = about.walls.len() as u32;
                if near.len() > MOST_OF_EACH {
                    about.walls.extend_from_slice(&near);
                    let end = about.walls.len() as u32;
                    about.ranges.extend(few.iter().map(|_| [begin, end]));
                } else {
                    for own in few {
                        let begin = about.walls.len() as u32;
                        let own = own.grown(reach);
                        let is_about = |wall: &&u32| boxes[**wall as usize].touches(&own);
                        about.walls.extend(near.iter().filter(is_about));
                        about.ranges.push([begin, about.walls.len() as u32]);
                    }
                }
                if found.fetch_add(near.len(), Ordering::Relaxed) + near.len() > most {
                    return None;
                }
            }
            Some(about)
        };
        let firsts: Vec<usize> = (0..boxes.len()).step_by(AT_A_TIME).collect();
        let parts: Vec<Vicinity> = match &firsts[..] {
            [only] => vec![part(*only)?],
            several => several
                .par_iter()
                .map(|first| part(*first))
                .collect::<Option<_>>()?,
        };
        let mut about = Vicinity {
            reach,
            ranges: Vec::with_capacity(boxes.len()),
            walls: Vec::with_capacity(parts.iter().map(|part| part.walls.len()).sum()),
        };
        for part in parts {
            let before = about.walls.len() as u32;
            let ranges = part.ranges.iter();
            about
                .ranges
                .extend(ranges.map(|ends| ends.map(|end| before + end)));
            about.walls.extend(part.walls);
        }
        Some(about)
    }

    /// The walls near one.
    pub(super) fn walls_of(&self, wall: usize) -> impl Iterator<Item = usize> {
        let [begin, end] = self.ranges[wall].map(|place| place as usize);
        self.walls[begin..end].iter().map(|&wall| wall as usize)
    }
}

/// The box around all.
pub(super) fn merged<'a>(boxes: impl Iterator<Item = &'a Bounds>) -> Bounds {
    let mut all = Bounds::EMPTY;
    boxes.for_each(|one| all.merge(one));
    all
}

/// An order of boxes in which those near each other in the plane are near each other in the list:
/// by the bits of column and row of their middles in turn.
pub(super) fn by_place(boxes: &[Bounds]) -> Vec<u32> {
    let all = merged(boxes.iter());
    let scale = f64::from(u16::MAX) / all.width().max(all.height()).max(f64::MIN_POSITIVE);
    let spread = |coordinate: f64| {
        let mut bits = u32::from((coordinate * scale) as u16);
        for (shift, mask) in [
            (8, 0x00ff_00ff),
            (4, 0x0f0f_0f0f),
            (2, 0x3333_3333),
            (1, 0x5555_5555),
        ] {
            bits = (bits | bits << shift) & mask;
        }
        bits
    };
    let place = |one: &Bounds| {
        let middle = (one.min - all.min + (one.max - all.min)) / 2.0;
        spread(middle.x) | spread(middle.y) << 1
    };
    let mut keys: Vec<(u32, u32)> = boxes.iter().map(place).zip(0..).collect();
    keys.par_sort_unstable();
    keys.into_iter().map(|(_, index)| index).collect()
}
