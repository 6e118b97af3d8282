//! Contours of a program that lie elsewhere than the others, although all should have one datum.

use super::pairs::{Pair, Pairs};
use super::traced::{Block, Motion};
use crate::drawing::EntityId;
use crate::geometry::Vector;
use std::ops::Range;

/// The places of one contour count as moved alike within this, µm.
const ALIKE: f64 = 4.0;
/// The most displacements that are kept apart.
const GROUPS: usize = 32;

/// A contour that is moved as a whole.
pub(super) struct Displaced {
    /// Numbers of the pairs that lead to it.
    pub ways: Range<usize>,
    /// The pair among them that goes wrong; the first one of the contour where none of them does.
    pub way: usize,
    /// The segment of the drawing where it begins.
    pub segment: Option<(EntityId, usize)>,
    /// Numbers of its own pairs, with the way out.
    ///
    /// `by` is their distance from where the drawing has them, `off` how much of it the others do not have, µm.
    pub contour: Range<usize>,
    pub by: Vector,
    pub off: f64,
    /// It lies as it should relative to the contour before it.
    pub is_behind_one: bool,
}

/// The contours that lie farther than `least` from where the drawing has them beside most of the others, or beside the
/// first, where the program lies at `from`.
pub(super) fn displaced(pairs: &Pairs, from: Vector, least: f64) -> Vec<Displaced> {
    let number = |nth: usize| pairs.pairs.partition_point(|pair| pair.nth < nth);
    let cuts = pairs.reference.traced.cuts.iter();
    let all: Vec<(Range<usize>, Option<Vector>)> = cuts
        .map(|[_, contour]| number(contour.start)..number(contour.end))
        .map(|own| (own.clone(), moved(&pairs.pairs[own], from)))
        .collect();
    let known: Vec<Vector> = all.iter().filter_map(|(_, by)| *by).collect();
    let Some(base) = shared_by_most(&known) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    let (mut end, mut last): (usize, Option<Vector>) = (0, None);
    let (mut before, mut before_it) = (base, 0..0);
    for (nth, (own, at)) in all.iter().enumerate() {
        let (own, at) = (own.clone(), *at);
        let next = all
            .get(nth + 1)
            .map_or(pairs.pairs.len(), |(next, _)| next.start);
        let by = at.map(|by| by - base).filter(|by| by.norm() > least);
        if let Some(by) = by {
            let first = &pairs.pairs[own.start];
            let ways = end..own.start;
            let apart = |number: usize| {
                let pair = pairs.pairs.get(number)?;
                let ([start, end], [from, to]) =
                    (pair.own.motion.ends()?, pair.meant.motion.ends()?);
                Some((end - start) - (to - from))
            };
            let step = by + base - before;
            let leads_there = |number: &usize| {
                let apart = apart(*number);
                apart.is_some_and(|apart| (apart - step).norm() <= ALIKE)
            };
            let is_way =
                |number: &usize| matches!(pairs.pairs[*number].own.motion, Motion::Way(..));
            let leading = ways.clone().find(leads_there);
            let begins = first.own.motion.ends().zip(first.meant.motion.ends());
            let begins_there = begins.is_none_or(|([start, _], [meant, _])| {
                (start - from - meant - (by + base)).norm() <= ALIKE
            });
            // Where places are stated, its first block may lead there.
            let is_within = pairs.traced.counts && leading.is_none() && !begins_there;
            // A block of the contour before it moves all that comes after.
            let is_moved_before = leading.is_none()
                && (before_it.clone().any(|number| leads_there(&number)) || pairs.skips(step));
            let way = leading.or_else(|| ways.clone().find(is_way));
            if !is_within {
                found.push(Displaced {
                    way: way.unwrap_or(own.start),
                    ways,
                    segment: pairs.reference.source_of(&first.meant.motion),
                    contour: own.start..next.max(own.end),
                    by: by + base,
                    off: by.norm(),
                    is_behind_one: is_moved_before
                        || last.is_some_and(|last| (last - by).norm() <= ALIKE),
                });
            }
        }
        before_it = own.clone();
        (end, last, before) = (own.end.max(end), by, at.unwrap_or(before));
    }
    found
}

impl Pairs<'_> {
    /// Whether a block that is lost or superfluous moves what comes after it by this.
    fn skips(&self, step: Vector) -> bool {
        let by = self.gap.and_then(|(_, of)| {
            let [start, end] = of.motion.ends()?;
            Some(end - start)
        });
        by.is_some_and(|by| (by - step).norm().min((by + step).norm()) <= ALIKE)
    }
}

/// The vector that occurs most often among these, the first one of equals.
fn shared_by_most(all: &[Vector]) -> Option<Vector> {
    let mut groups: Vec<(Vector, usize)> = Vec::new();
    for by in all {
        let known = groups
            .iter_mut()
            .take(GROUPS)
            .find(|(own, _)| (own - by).norm() <= ALIKE);
        match known {
            Some((_, count)) => *count += 1,
            None => groups.push((*by, 1)),
        }
    }
    let most = groups.iter().map(|(_, count)| *count).max()?;
    groups
        .into_iter()
        .find(|(_, count)| *count == most)
        .map(|(by, _)| by)
}

/// By how much most of these blocks are moved, from where the drawing has them.
fn moved(contour: &[Pair], from: Vector) -> Option<Vector> {
    let middle = contour.get(contour.len() / 2)?;
    let away = |pair: &Pair| {
        let ([_, end], [_, to]) = (pair.own.motion.ends()?, pair.meant.motion.ends()?);
        let center = |pair: [&Block; 2]| {
            let [own, meant] = pair.map(|block| block.segment()?.as_arc());
            own.zip(meant)
                .map(|(own, meant)| own.center - from - meant.center)
        };
        let by = end - from - to;
        Some((by, center([pair.own, pair.meant]).unwrap_or(by)))
    };
    let (by, _) = away(middle)?;
    let is_alike = |other: Vector| (other - by).norm() <= ALIKE;
    let is_moved =
        |pair: &&Pair| away(pair).is_some_and(|(end, center)| is_alike(end) && is_alike(center));
    let count = contour.iter().filter(is_moved).count();
    (3 * count >= 2 * contour.len()).then_some(by)
}
