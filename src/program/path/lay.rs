//! How consecutive blocks lie relative to themselves: an edit elsewhere does not change it.

use super::contour::{closing, goes_round};
use super::crossing::{MOST_PAIRS, near_each_other};
use super::way::HeldWay;
use crate::geometry::{Bounds, Segment};

/// The properties of a part of a cut by itself.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lay {
    /// Tells two parts apart: equal ways have equal marks.
    pub(crate) mark: u64,
    /// µm, relative to its beginning.
    pub(crate) bounds: Bounds,
    /// Blocks of it that come near each other, by their number in the part, except neighbours: as many as
    /// [`keep_first`] keeps.
    pub(crate) near: Box<[(u32, u32)]>,
    /// It holds a closed contour, and one that encloses something.
    pub(crate) closes: bool,
    pub(crate) goes_round: bool,
}

impl Lay {
    /// For a way that begins at the origin.
    pub(crate) fn of(way: &HeldWay, mark: u64) -> Lay {
        let boxes: Vec<Bounds> = way.pieces().iter().map(Segment::bounds).collect();
        let mut near = Vec::new();
        near_each_other(way.pieces(), &boxes, &mut |first, second| {
            near.push((first as u32, second as u32))
        });
        keep_first(&mut near);
        let whole = |whole: Bounds, part: &Bounds| whole.merged(part);
        let closes = closing(way).is_some_and(|closing| closing.closed);
        Lay {
            mark,
            bounds: boxes.iter().fold(Bounds::EMPTY, whole),
            near: near.into(),
            closes,
            goes_round: closes && goes_round(way) == Some(true),
        }
    }
}

/// Keeps the pairs whose later block comes first along the way: one more than are used, to show that there are more.
pub(super) fn keep_first(near: &mut Vec<(u32, u32)>) {
    if near.len() > MOST_PAIRS + 1 {
        near.sort_unstable_by_key(|&(first, second)| (second, first));
        near.truncate(MOST_PAIRS + 1);
    }
}

/// The mark of a way with one more field.
pub(crate) fn mixed(mark: u64, field: u64) -> u64 {
    (mark ^ field)
        .wrapping_mul(0x2545_f491_4f6c_dd1d)
        .rotate_left(23)
}
