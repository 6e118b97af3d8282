//! How consecutive blocks lie relative to each other, which an edit elsewhere does not change.

use super::contour::{closing, goes_round};
use super::crossing::near_each_other;
use super::passes::crosses_itself;
use super::way::HeldWay;
use crate::geometry::{Bounds, Segment};

/// Further pairs in a part that come near each other are searched for only when they are needed:
/// then a few such parts show all that counts.
const KEPT: usize = 64;

/// Holes of one shape follow each other: up to this many parts back, one with the same lay is looked for.
const LOOKED_BACK: usize = 8;

/// The properties of a part of a cut by itself.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lay {
    /// Tells two parts apart: equal ways have equal marks.
    pub(crate) mark: u64,
    /// µm, relative to its beginning.
    pub(crate) bounds: Bounds,
    /// Blocks of it that come near each other, by their number in the part, except neighbours: none where it is tangled.
    pub(crate) near: Box<[(u32, u32)]>,
    /// More than [`KEPT`] pairs do.
    pub(crate) is_tangled: bool,
    /// For a part that is a cut by itself, if two of its blocks come near each other: whether it crosses itself, or too
    /// much lies on one place to tell.
    crosses: Option<bool>,
    /// It holds a closed contour, and one that encloses something.
    pub(crate) closes: bool,
    pub(crate) goes_round: bool,
}

impl Lay {
    /// One of the last of these with a mark, or of those that are gone.
    pub(crate) fn known<'a, 'b>(
        before: impl Iterator<Item = &'a Lay>,
        mut old: impl Iterator<Item = &'b Lay>,
        mark: u64,
        is_whole: bool,
    ) -> Option<Lay> {
        let is_it = |lay: &&Lay| {
            lay.mark == mark && (!is_whole || !lay.may_cross() || lay.crosses.is_some())
        };
        let mut before = before.take(LOOKED_BACK);
        let known = before.find(is_it).cloned();
        known.or_else(|| old.find(is_it).cloned())
    }

    /// For a way that begins at the origin, and may be a cut by itself.
    pub(crate) fn of(way: &HeldWay, mark: u64, is_whole: bool) -> Lay {
        let (near, is_all) = match way.pieces().len() {
            // Of fewer all are neighbours.
            ..3 => (Vec::new(), true),
            _ => near_each_other(way.pieces().iter().copied(), KEPT),
        };
        let pair = |(first, second)| (first as u32, second as u32);
        let comes_near = !near.is_empty() || !is_all;
        let crosses = (is_whole && comes_near).then(|| crosses_itself(way));
        let near = near.into_iter().filter(|_| is_all).map(pair);
        let whole = |whole: Bounds, piece: &Segment| whole.merged(&piece.bounds());
        let closes = closing(way).is_some_and(|closing| closing.closed);
        Lay {
            mark,
            bounds: way.pieces().iter().fold(Bounds::EMPTY, whole),
            near: near.collect(),
            is_tangled: !is_all,
            crosses,
            closes,
            goes_round: closes && goes_round(way) == Some(true),
        }
    }

    /// As a cut by itself it may cross itself, as far as is known.
    pub(crate) fn may_cross(&self) -> bool {
        self.crosses
            .unwrap_or(self.is_tangled || !self.near.is_empty())
    }
}

/// The mark of a way with one more field.
pub(crate) fn mixed(mark: u64, field: u64) -> u64 {
    (mark ^ field)
        .wrapping_mul(0x2545_f491_4f6c_dd1d)
        .rotate_left(23)
}
