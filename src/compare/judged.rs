//! A pass that has been followed: what it covers of its contour, what is wrong in it, and what it lacks.

use super::difference::Difference;
use super::walk::{At, COVERED, Walk};
use crate::finding::DifferenceKind;
use crate::geometry::{Point, Vector};

/// An arc in a sharp corner leaves no more of it than this, µm.
pub(super) const ROUNDED: f64 = 300.0;
/// A smaller deviation is the writer's rounding, or the drift of a machine that counts, µm.
pub(super) const SLIGHT: f64 = 8.0;

/// What a pass lies beside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pass {
    pub(super) contour: usize,
    /// µm, positive to the left of the contour's direction.
    pub(super) offset: f64,
    /// It goes against the direction of the contour.
    pub(super) back: bool,
}

/// A pass that has been followed.
pub(super) struct Judged {
    pub(super) pass: Pass,
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
    pub(super) covered: [f64; 2],
    pub(super) length: f64,
    /// Where it begins and ends on the way.
    pub(super) ends: [Point; 2],
    /// What it leaves is a tab, or a wrong block; and where that begins and ends.
    pub(super) is_tab: bool,
    pub(super) edges: [Point; 2],
    /// What to say if nothing else covers the rest.
    pub(super) gap: Option<Difference>,
}

/// How well a pass explains its blocks: the least to name, the most that follow or are named, all of the contour covered,
/// and the nearest to it.
pub(super) fn count(judged: &Judged) -> (usize, usize, bool, u64) {
    let explained = judged.follows.len() + judged.differences.len();
    let offset = judged.pass.offset.abs().round() as u64;
    (
        judged.wrong,
        usize::MAX - explained,
        judged.gap.is_some(),
        offset,
    )
}

impl Judged {
    pub(super) fn name(
        &mut self,
        walk: &Walk,
        index: usize,
        at: At,
        off: f64,
        kind: DifferenceKind,
    ) {
        let block = walk.blocks.get(index);
        let found = block.map(|block| Difference::of(block, walk.ring.source(at.along), off, kind));
        self.differences.extend(found);
    }

    /// How much of the way it leaves, µm.
    pub(super) fn left(&self) -> f64 {
        self.length - (self.covered[1] - self.covered[0])
    }

    /// It goes round, but for a tab; what it leaves of one is less.
    pub(super) fn is_whole(&self) -> bool {
        self.left() <= self.length / 2.0
    }

    /// Whether it covers what another pass leaves of their contour, as shares of the way of each.
    pub(super) fn covers_rest_of(&self, other: &Judged) -> bool {
        const NEAR: f64 = 2e-3;
        let shares = |judged: &Judged| judged.covered.map(|along| along / judged.length);
        let ([from, to], [start, end]) = (shares(other), shares(self));
        let behind = (start - to + NEAR).rem_euclid(1.0) - NEAR;
        behind <= NEAR && behind + (end - start) >= 1.0 - (to - from) - NEAR
    }
}

/// What is to be said where a pass ends before the way is complete: the wrong block of it, or that it lacks some.
pub(super) fn unfinished(
    walk: &Walk,
    judged: &Judged,
    [entry, at]: [At; 2],
    last: Option<usize>,
) -> Option<Difference> {
    let from = at.along;
    let to = if walk.ring.closed {
        entry.along + walk.ring.length
    } else {
        walk.ring.length
    };
    let named = |index: usize, off: f64, kind: DifferenceKind| {
        let block = walk.blocks.get(index)?;
        let source = walk.ring.source(from + COVERED.min((to - from) / 2.0));
        Some(Difference::of(block, source, off, kind))
    };
    let next = walk.next(judged.end);
    // The next one runs on, or straight to where the pass begins.
    let closes = |next: &usize| {
        let end = walk.segment(*next).map(|own| own.end() + at.shift);
        end.is_some_and(|end| (end - judged.ends[0]).norm() <= walk.within)
    };
    if let Some(next) = next.filter(|next| walk.runs_along(*next, at) || closes(next)) {
        return named(next, walk.off(next, at), DifferenceKind::Block);
    }
    // The block before the first one that follows begins where the pass ends, or runs into it: it is the wrong one. Where
    // each block ends at its own coordinates, it runs there from where the one before led astray.
    let close = walk.place(from);
    let before = judged.first.checked_sub(1);
    if let Some((index, segment)) = before.and_then(|index| Some((index, walk.segment(index)?))) {
        let is_there = (segment.start() + entry.shift - close).norm() <= 2.0 * walk.within;
        let way = index
            .checked_sub(1)
            .filter(|way| !walk.is_relative && walk.segment(*way).is_some());
        match (is_there, walk.runs_into(segment, entry), way) {
            (false, true, Some(way)) => {
                return named(
                    way,
                    walk.away(segment.start() + entry.shift),
                    DifferenceKind::Astray,
                );
            }
            (false, false, _) => {}
            _ => return named(index, walk.off(index, at), DifferenceKind::Block),
        }
    }
    match last {
        Some(last) if !walk.is_corner(at) => named(last, to - from, DifferenceKind::Block),
        _ => named(next.or(last)?, to - from, DifferenceKind::Unfinished),
    }
}
