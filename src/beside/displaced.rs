//! Contours of a program that lie elsewhere than the others: all have one datum.

use super::pairs::{Pair, Pairs};
use super::traced::Block;
use crate::drawing::EntityId;
use crate::geometry::Vector;
use std::ops::Range;

/// Places of one contour are moved alike within this, µm.
const ALIKE: f64 = 4.0;

/// A contour that is moved as a whole.
pub(super) struct Displaced {
    /// Numbers of the pairs that lead there, and of those of its contour.
    pub ways: Range<usize>,
    /// The segment of the drawing where it begins.
    pub segment: Option<(EntityId, usize)>,
    /// By how much, µm.
    pub off: f64,
    /// It lies beside the contour before it as it should.
    pub is_behind_one: bool,
}

/// The contours that lie farther than `least` from where the drawing has them, where the program lies at `from`.
pub(super) fn displaced(pairs: &Pairs, from: Vector, least: f64) -> Vec<Displaced> {
    let mut found = Vec::new();
    let (mut end, mut last): (usize, Option<Vector>) = (0, None);
    let mut is_one_in_place = false;
    for [_, contour] in &pairs.reference.traced.cuts {
        let number = |nth: usize| pairs.pairs.partition_point(|pair| pair.nth < nth);
        let own = number(contour.start)..number(contour.end);
        let by = moved(&pairs.pairs[own.clone()], from);
        is_one_in_place |= by.is_some_and(|by| by.norm() <= ALIKE);
        let by = by.filter(|by| by.norm() > least);
        if let Some(by) = by {
            let first = &pairs.pairs[own.start];
            found.push(Displaced {
                ways: end..own.start,
                segment: pairs.reference.source_of(&first.meant.motion),
                off: by.norm(),
                is_behind_one: last.is_some_and(|last| (last - by).norm() <= ALIKE),
            });
        }
        (end, last) = (own.end.max(end), by);
    }
    // All of them together lie where the program lies.
    if !is_one_in_place {
        found.clear();
    }
    found
}

/// By how much most of these blocks are moved, with the place where they begin.
fn moved(contour: &[Pair], from: Vector) -> Option<Vector> {
    let middle = contour.get(contour.len() / 2)?;
    let away = |pair: &Pair| {
        let ([start, end], [from_start, to]) = (pair.own.motion.ends()?, pair.meant.motion.ends()?);
        let center = |pair: [&Block; 2]| {
            let [own, meant] = pair.map(|block| block.segment()?.as_arc());
            own.zip(meant)
                .map(|(own, meant)| own.center - from - meant.center)
        };
        let by = end - from - to;
        Some((
            start - from - from_start,
            by,
            center([pair.own, pair.meant]).unwrap_or(by),
        ))
    };
    let (_, by, _) = away(middle)?;
    let is_alike = |other: Vector| (other - by).norm() <= ALIKE;
    let is_moved =
        |pair: &&Pair| away(pair).is_some_and(|(_, end, center)| is_alike(end) && is_alike(center));
    let count = contour.iter().filter(is_moved).count();
    let (start, ..) = away(contour.first()?)?;
    (3 * count >= 2 * contour.len() && is_alike(start)).then_some(by)
}
