//! Questions about the cuts of an open document, in any language.

use super::contour::{Ends, closing, goes_round, not_closed};
use super::crossings::{Found, Known};
use super::lay::Lay;
use super::offset_losses::ControlOffset;
use super::parted::PartedWay;
use crate::finding::{Finding, Severity};
use crate::text::SourceText;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// A cut of fewer blocks does not cross itself.
pub(crate) const FEWEST_CROSSING: usize = 4;

/// Up to this many blocks are a fragment, which may well be meant to be open.
const FRAGMENT: usize = 2;

/// Twice an area that no way to and fro reaches by rounding, µm²: 1 mm².
const LARGE: f64 = 2e6;

/// A document that knows its cuts by their parts. A part lies within one stretch of lines, which an edit elsewhere
/// leaves alone. For nearly every cut its ends give the answer, else the lay of a single part, else
/// all its blocks.
pub(crate) trait HasCuts {
    type Cut;

    fn ends(&self, cut: &Self::Cut) -> Ends;

    /// Twice the area between a cut and its chord, µm²; above 0 where it runs to the left.
    fn twice_area(&self, cut: &Self::Cut) -> f64;

    /// The lay of a cut that is one part.
    fn only_lay<'a>(&'a self, cut: &Self::Cut) -> Option<Cow<'a, Lay>>;

    fn way<'a>(&'a self, cut: &Self::Cut) -> PartedWay<'a>;

    /// Cuts with the same way, the same parts and the same stop have the same mark.
    fn mark(&self, cut: &Self::Cut) -> u64;

    /// Bytes of the last block of a cut.
    fn last_block(&self, cut: &Self::Cut) -> Option<Range<usize>>;

    fn part_count(&self, cut: &Self::Cut) -> usize;

    /// It has a fault, so the way after it is not the intended one; or it cuts nothing.
    fn is_doubtful(&self, cut: &Self::Cut) -> bool;

    /// The offset that the control makes of a cut; `None` where it runs as it is written, or nothing is known of it.
    fn control_offset(&self, cut: &Self::Cut) -> Option<ControlOffset>;

    fn is_closed(&self, cut: &Self::Cut) -> bool {
        let by_way = || closing(&self.way(cut)).is_some_and(|closing| closing.closed);
        self.ends(cut).close() || self.only_lay(cut).map_or_else(by_way, |lay| lay.closes)
    }

    /// Whether it encloses something: passes to and fro do not.
    fn goes_round(&self, cut: &Self::Cut) -> bool {
        let by_way = || goes_round(&self.way(cut)) == Some(true);
        let is_large = self.twice_area(cut).abs() > LARGE;
        (is_large && self.ends(cut).close())
            || self.only_lay(cut).map_or_else(by_way, |lay| lay.goes_round)
    }

    /// How far a cut leads on from its start, to which it had come back, µm.
    fn leads_on(&self, cut: &Self::Cut) -> Option<f64> {
        self.ends(cut).lead_on()
    }

    /// `not-closed`, of a cut that is not.
    fn not_closed(&self, cut: &Self::Cut, is_fragment: bool) -> Option<Finding> {
        let finding = Finding::of(not_closed(&self.way(cut))?, self.last_block(cut)?);
        Some(match is_fragment {
            true => finding.with(Severity::Information),
            false => finding,
        })
    }

    /// What is said of a cut that crosses itself in these places, or of which an offset loses these.
    fn crosses_itself(&self, cut: &Self::Cut, found: &Found, text: &SourceText) -> Vec<Finding> {
        found.findings(&self.way(cut), self.last_block(cut), text)
    }

    /// So short that it may well be meant to be open.
    fn is_fragment(&self, cut: &Self::Cut) -> bool {
        self.ends(cut).blocks <= FRAGMENT
    }

    /// Where a cut crosses itself, and what the control's offset loses of it, as is known or found; `None` for one that
    /// does not cross itself, by its parts, or that is doubtful.
    fn crossings(&self, known: &mut Known, cut: &Self::Cut) -> Option<Arc<Found>> {
        let is_short = self.ends(cut).blocks < FEWEST_CROSSING;
        let crosses_nothing = || self.only_lay(cut).is_some_and(|lay| !lay.may_cross());
        if is_short || self.is_doubtful(cut) {
            return None;
        }
        let offset = self.control_offset(cut);
        let is_asked = offset.is_some() || !crosses_nothing();
        let way = || self.way(cut);
        is_asked.then(|| known.crossings(self.mark(cut), offset, self.part_count(cut), way))
    }
}
