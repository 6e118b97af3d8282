//! A pass that has been followed: what is wrong in it, and what it leaves of its contour.

use super::difference::Difference;
use super::ring::Course;
use super::traced::Motion;
use super::walk::{At, COVERED, WITHIN, Walk};
use crate::finding::DifferenceKind;
use crate::geometry::{Point, Vector};

/// A smaller deviation is the writer's rounding, or the drift of a machine that counts, µm.
pub(super) const SLIGHT: f64 = 8.0;
/// No tab is shorter, µm.
const TAB: f64 = 200.0;
/// Of more than so many wrong blocks, half of a pass may be wrong: more are another contour, and that is said once.
const FEW: usize = 3;

/// A pass that has been followed.
pub(super) struct Judged {
    pub(super) course: Course,
    /// The first block of its contour, and the block behind its last one.
    pub(super) first: usize,
    pub(super) end: usize,
    pub(super) differences: Vec<Difference>,
    pub(super) follows: Vec<usize>,
    /// How many blocks are wrong, whether they are named or not.
    pub(super) wrong: usize,
    /// Where the program lies behind it.
    pub(super) shift: Vector,
    /// What is covered of the way, from its begin in the contour's direction, and how long the way is, µm.
    covered: [f64; 2],
    length: f64,
    /// Where it begins and ends on the way.
    pub(super) ends: [Point; 2],
    /// What to say if nothing else covers the rest, and whether that may be a tab.
    pub(super) gap: Option<Difference>,
    pub(super) is_tab: bool,
}

impl Judged {
    /// Follows a pass from its first block on.
    pub(super) fn of(
        walk: &Walk,
        course: Course,
        (first, entry): (usize, At),
        is_part: bool,
    ) -> Judged {
        let mut judged = Judged {
            course,
            first,
            end: first,
            differences: Vec::new(),
            follows: Vec::new(),
            wrong: 0,
            shift: entry.shift,
            covered: [0.0; 2],
            length: walk.ring.length,
            ends: [Point::origin(); 2],
            gap: None,
            is_tab: false,
        };
        let complete = walk.complete(entry);
        let (mut at, mut index, mut last) = (entry, first, None);
        while let Some(next) = walk.next(index) {
            if let Some(along) = walk.follow(next, at) {
                judged.follows.push(next);
                (at.along, index, last) = (along, next + 1, Some(next));
                at.shift += walk.drift(next, at);
                continue;
            }
            // After a stop the wire goes over to another pass: what is left is a tab.
            if at.along >= complete || is_part || index < next {
                break;
            }
            let Some((again, place)) = walk.resume(next, at, complete) else {
                break;
            };
            // Where it ends amid a piece, or what follows does so from elsewhere, the block before led there.
            let is_lost = place.along > at.along + WITHIN && walk.is_corner(at);
            let is_before = match again == next {
                true => !is_lost,
                false => !walk.is_corner(at) && !walk.runs_along(next, at),
            };
            let wrong = last.filter(|_| is_before).unwrap_or(next);
            let moved = (place.shift - at.shift).norm();
            let off = match moved > WITHIN {
                true => moved,
                false => walk.off(wrong, at),
            };
            // The blocks and the pieces of the way that are left out.
            let pieces = walk.corners(at.along + WITHIN, place.along - WITHIN).len();
            judged.wrong += (again - next).max(pieces).max(1);
            judged.follows.retain(|index| *index != wrong);
            if off > SLIGHT {
                judged.name(walk, wrong, at.along, off, DifferenceKind::Block);
            }
            (at, index, last) = (place, again, None);
        }
        (judged.shift, judged.end) = (at.shift, index);
        let covered = [entry.along, at.along];
        judged.covered = match course.back {
            true => covered.map(|along| walk.ring.length - along),
            false => covered,
        };
        judged.covered.sort_by(f64::total_cmp);
        judged.ends = covered.map(|along| walk.place(along));
        if at.along < complete && !is_part {
            judged.leaves(walk, [entry, at], last);
        }
        if judged.differences.len() > FEW && 2 * judged.differences.len() > judged.follows.len() {
            judged.differences.truncate(1);
            judged.gap = None;
        }
        judged
    }

    /// It ends before the way is complete.
    fn leaves(&mut self, walk: &Walk, [entry, at]: [At; 2], last: Option<usize>) {
        self.gap = self.unfinished(walk, [entry, at], last);
        let end = walk.complete(entry) + COVERED;
        // A tab stands on one side; on a circle, on less than a quarter.
        let sides = walk.corners(at.along + COVERED, end - COVERED).len();
        self.is_tab = sides == 0 && end - at.along >= TAB;
        // It is cut after a stop.
        let rest = walk.blocks.get(self.end..).unwrap_or_default().iter();
        let behind = rest.skip_while(|block| block.motion != Motion::Stop);
        let goes_on = behind.skip(1).any(|block| block.motion != Motion::Stop);
        self.wrong += if goes_on { sides } else { sides.max(1) };
    }

    /// The wrong block of the part of the way that is left, or that it lacks some.
    fn unfinished(
        &self,
        walk: &Walk,
        [entry, at]: [At; 2],
        last: Option<usize>,
    ) -> Option<Difference> {
        let left = walk.complete(entry) + COVERED - at.along;
        let named = |index: usize, off: f64, kind: DifferenceKind| {
            let source = walk.ring.source(at.along + COVERED.min(left / 2.0));
            Some(Difference::of(walk.blocks.get(index)?, source, off, kind))
        };
        // The next one runs on, or straight to where the pass begins.
        let next = walk.next(self.end);
        let closes = |next: usize| {
            let end = walk.segment(next).map(|own| own.end() + at.shift);
            end.is_some_and(|end| (end - self.ends[0]).norm() <= WITHIN)
        };
        if let Some(next) = next.filter(|next| walk.runs_along(*next, at) || closes(*next)) {
            return named(next, walk.off(next, at), DifferenceKind::Block);
        }
        // The block before the first one that follows begins where the pass ends, or runs into it: it is the wrong one.
        // Where each block ends at its own coordinates, it runs there from where the one before led astray.
        let before = self.first.checked_sub(1);
        let before = before.and_then(|index| Some((index, walk.segment(index)?)));
        if let Some((index, own)) = before {
            let start = own.start() + entry.shift;
            let is_there = (start - self.ends[1]).norm() <= 2.0 * WITHIN;
            let runs_into = walk.runs_into(own, entry);
            let way = index
                .checked_sub(1)
                .filter(|way| walk.segment(*way).is_some());
            match way {
                Some(way) if !is_there && runs_into && walk.opening.is_none() => {
                    let [from, to] = walk.ring.whole();
                    let away = walk.ring.nearest(start, from, to);
                    return named(way, away.map_or(0.0, |near| near.1), DifferenceKind::Astray);
                }
                _ if is_there || runs_into => {
                    return named(index, walk.off(index, at), DifferenceKind::Block);
                }
                _ => {}
            }
        }
        match last {
            Some(last) if !walk.is_corner(at) => named(last, left, DifferenceKind::Block),
            _ => named(next.or(last)?, left, DifferenceKind::Unfinished),
        }
    }

    pub(super) fn name(
        &mut self,
        walk: &Walk,
        index: usize,
        along: f64,
        off: f64,
        kind: DifferenceKind,
    ) {
        let block = walk.blocks.get(index);
        let found = block.map(|block| Difference::of(block, walk.ring.source(along), off, kind));
        self.differences.extend(found);
    }

    /// How well it explains its blocks: the least to name, the most that follow or are named, all of the contour
    /// covered, and the nearest to it.
    pub(super) fn rank(&self) -> (usize, usize, bool, u64) {
        let explained = self.follows.len() + self.differences.len();
        let offset = self.course.offset.abs().round() as u64;
        (
            self.wrong,
            usize::MAX - explained,
            self.gap.is_some(),
            offset,
        )
    }

    /// How much of the way it leaves, µm.
    pub(super) fn left(&self) -> f64 {
        self.length - (self.covered[1] - self.covered[0])
    }

    /// It goes round less than half of the way.
    pub(super) fn is_part(&self) -> bool {
        self.left() > self.length / 2.0
    }

    /// Whether it is a part, and covers what another pass leaves of their contour, as shares of the way of each.
    pub(super) fn covers_rest_of(&self, other: &Judged) -> bool {
        const NEAR: f64 = 2e-3;
        let shares = |judged: &Judged| judged.covered.map(|along| along / judged.length);
        let ([from, to], [start, end]) = (shares(other), shares(self));
        let behind = (start - to + NEAR).rem_euclid(1.0) - NEAR;
        // A pass all the way round is one of its own.
        self.is_part() && behind <= NEAR && behind + (end - start) >= 1.0 - (to - from) - NEAR
    }
}
