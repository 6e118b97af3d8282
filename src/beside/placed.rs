//! Where the blocks of a program stand beside those of the rewritten one, `from` as far as all of it lies elsewhere, µm.

use super::comparison::FEW;
use super::pairs::{Pair, Pairs};
use super::traced::Motion;
use crate::geometry::{Segment, Vector};

/// The largest deviation of a block, or of one of its numbers, from the rewritten one, µm; and that under settings that
/// are not known to the last digit.
pub(super) const ALIKE: f64 = 2.0;
pub(super) const ROUNDED: f64 = 1.5;
/// A larger deviation of a way in or out, or between contours, is meant: its hole is elsewhere, µm.
pub(super) const SLIP: f64 = 50.0;

impl Pairs<'_> {
    /// Whether a block ends where it should.
    pub(super) fn is_placed(&self, number: usize, from: Vector) -> bool {
        self.ends_near(number, from, ROUNDED)
    }

    /// Whether a block ends as far from where it should as it deviates.
    pub(super) fn moves_on(&self, number: usize, from: Vector, off: f64) -> bool {
        let ends = self.pairs.get(number).and_then(|pair| {
            let ([_, end], [_, meant]) = (pair.own.motion.ends()?, pair.meant.motion.ends()?);
            Some((end - from - meant).norm())
        });
        ends.is_none_or(|away| (away - off).abs() <= ROUNDED)
    }

    /// Whether a contour lies where it should: a program that says no place lies where its contours lie.
    pub(super) fn has_placed_contour(&self, from: Vector) -> bool {
        let mut all = self.pairs.iter().enumerate();
        all.any(|(at, pair)| self.is_placed(at, from) && self.is_of_contour(pair))
    }

    pub(super) fn is_of_contour(&self, pair: &Pair) -> bool {
        self.reference.source_of(&pair.meant.motion).is_some()
    }

    /// Whether the next contour begins elsewhere than where it should, and not on its way either: no other hole does that.
    pub(super) fn leads_astray(&self, number: usize, from: Vector) -> bool {
        let mut behind = self.pairs.iter().skip(number + 1);
        let next = behind.find(|pair| self.is_of_contour(pair));
        let begins = next.and_then(|pair| {
            let ([start, _], [meant, _]) = (pair.own.motion.ends()?, pair.meant.motion.ends()?);
            Some((start - from, meant))
        });
        begins.is_some_and(|(start, meant)| {
            (start - meant).norm() > SLIP && !self.reference.is_on_wall(start, ROUNDED)
        })
    }

    /// Whether a block may be a part of a wall, and the next one, too: a tab or an overlap ends within one.
    pub(super) fn lies_on_wall(&self, number: usize, from: Vector) -> bool {
        let is_on = |place| self.reference.is_on_wall(place - from, ROUNDED);
        let lies = |pair: &Pair| {
            let own = pair.own.segment();
            own.is_none_or(|own| is_on(own.point_at(0.5)) && is_on(own.end()))
        };
        let next = self.pairs.get(number + 1);
        let next = next.filter(|next| self.is_of_contour(next));
        self.pairs.get(number).is_none_or(lies) && next.is_none_or(lies)
    }

    pub(super) fn ends_on_wall(&self, number: usize, from: Vector) -> bool {
        let end = self
            .pairs
            .get(number)
            .and_then(|pair| pair.own.motion.ends());
        end.is_some_and(|[_, end]| self.reference.is_on_wall(end - from, ROUNDED))
    }

    /// Whether a way in ends beside the path of its contour, which then goes on from there to where it should.
    pub(super) fn ends_astray(&self, number: usize, from: Vector) -> bool {
        let next = self.pairs.get(number + 1);
        let is_way_in =
            next.is_some_and(|next| next.own.segment().is_some() && self.is_of_contour(next));
        is_way_in
            && !self.traced.four_b
            && self.is_placed(number + 1, from)
            && !self.ends_near(number, from, ALIKE)
            && !self.ends_on_wall(number, from)
    }

    pub(super) fn ends_near(&self, number: usize, from: Vector, most: f64) -> bool {
        let Some(pair) = self.pairs.get(number) else {
            return true;
        };
        match (pair.own.motion.ends(), pair.meant.motion.ends()) {
            (Some([_, end]), Some([_, meant])) => (end - from - meant).norm() <= most,
            _ => true,
        }
    }

    /// A block that begins its contour on a wall and ends where it should; or one that ends on a wall, where its
    /// contour began or its tab begins.
    pub(super) fn is_at_its_entry(&self, number: usize, from: Vector) -> bool {
        let blocks = &self.traced.blocks;
        let Some(own) = self.pairs.get(number).map(|pair| pair.own) else {
            return false;
        };
        // The tab before it begins elsewhere, too.
        let at = blocks.iter().position(|block| block.range == own.range);
        let next = at.and_then(|at| blocks.get(at + 1));
        let goes_to_tab = next.is_some_and(|next| next.motion == Motion::Stop)
            && number > 0
            && self.is_placed(number - 1, from);
        let tab = own.segment().filter(|_| goes_to_tab).map(Segment::end);
        let entry = self.traced.cuts.iter().find_map(|[_, contour]| {
            let begin = blocks.get(contour.start)?;
            let entry = begin.segment()?.start();
            if begin.range == own.range && self.is_placed(number, from) {
                return Some(entry);
            }
            let last = blocks.get(contour.end.checked_sub(1)?)?;
            let closes = (entry - last.segment()?.end()).norm() <= ROUNDED;
            (last.range == own.range && closes).then_some(entry)
        });
        let moved = entry.or(tab);
        moved.is_some_and(|place| self.reference.is_on_wall(place - from, ROUNDED))
    }

    /// After this block, or one of the next few, the program is where it should be.
    pub(super) fn comes_back(&self, number: usize, from: Vector) -> bool {
        (number..number + FEW).any(|number| self.is_placed(number, from))
    }
}
