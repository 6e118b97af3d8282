//! The contours of a program: its cuts, and those that belong together.

use super::super::cut::Cut;
use super::super::entry::{BlockEntry, Entry, What};
use super::super::rules::control_offset;
use super::super::words::Word;
use super::{At, Document};
use crate::geometry::{Vector, cross};
use crate::program::contours::Divided;
use crate::program::path::{ControlOffset, Ends, Verdict, Way};
use crate::program::steps::Program;
use std::borrow::Cow;
use std::ops::Range;

/// Cuts that are one contour, or the way between two.
pub(super) type OneContour = Range<usize>;

impl Divided for Document {
    const PIECES_ARE_ONE: bool = true;

    fn id(&self, cut: usize) -> u64 {
        self.cuts.id(cut)
    }

    fn verdict(&self, cut: usize) -> Cow<'_, Verdict> {
        self.cuts[cut].verdict()
    }

    fn way(&self, cut: usize) -> Way {
        self.cuts[cut].way()
    }

    fn may_go_on(&self, cut: usize) -> bool {
        let own = &self.cuts[cut];
        let ends_here = own.stop.is_some() && self.stops_again(cut);
        own.has_blocks() && !own.goes_round && !ends_here && !self.is_jump(cut)
    }

    fn behind_stop(&self, cut: usize) -> Option<usize> {
        Some(cut + 1).filter(|next| *next < self.cut_count())
    }

    fn stands_alone(&self, cut: usize) -> bool {
        let own = &self.cuts[cut];
        own.blocks > 0 && (self.is_jump(cut) || own.closes)
    }

    fn is_doubtful(&self, cuts: &Range<usize>) -> bool {
        self.errors(cuts) > 0
    }

    fn control_offset(&self, cuts: &Range<usize>) -> Option<ControlOffset> {
        let blocks = self.cuts[cuts.clone()].iter().flat_map(Cut::blocks);
        control_offset(&self.settings, blocks, self.twice_area(cuts))
    }
}

impl Document {
    /// The word that ends the program: the first of the controller's own, else the last that ends programs elsewhere,
    /// else a stop with no block after it.
    pub(super) fn end_word(&self) -> Option<At> {
        let stops = || self.cuts.iter().enumerate();
        let ends = |is_own: bool| {
            let is_end = move |stop: &(Word, bool)| stop.0 == Word::End && (stop.1 || !is_own);
            move |(_, cut): &(usize, &Cut)| cut.stop.as_ref().is_some_and(is_end)
        };
        let own = stops().find(ends(true));
        let foreign = || stops().rfind(ends(false));
        let stop = || {
            let (last, cut) = stops().rfind(|(_, cut)| cut.stop.is_some())?;
            let is_last = self.cuts[last + 1..].iter().all(|cut| cut.blocks == 0);
            let has_blocks = || self.last_block(None).is_some();
            (is_last && has_blocks()).then_some((last, cut))
        };
        let (cut, own) = own.or_else(foreign).or_else(stop)?;
        Some(At {
            cut,
            entry: own.stop_entry()?,
        })
    }

    /// The content of a cut.
    pub(super) fn entries_in(&self, cut: usize) -> &[Entry] {
        self.cuts.get(cut).map_or(&[], |cut| &cut.entries)
    }

    /// The content of some cuts, in order.
    pub(super) fn entries(
        &self,
        cuts: Range<usize>,
    ) -> impl DoubleEndedIterator<Item = (At, &Entry)> {
        cuts.flat_map(move |cut| {
            let entries = self.entries_in(cut).iter().enumerate();
            entries.map(move |(entry, what)| (At { cut, entry }, what))
        })
    }

    /// That of the whole program.
    pub(super) fn all_entries(&self) -> impl DoubleEndedIterator<Item = (At, &Entry)> {
        self.entries(0..self.cuts.len())
    }

    /// The entries from one on.
    pub(super) fn from(&self, at: At) -> impl Iterator<Item = (At, &Entry)> {
        let all = self.entries(at.cut..self.cuts.len());
        all.skip_while(move |(own, _)| *own < at)
    }

    /// The entries before one, the nearest first.
    pub(super) fn before(&self, at: At) -> impl Iterator<Item = (At, &Entry)> {
        let all = self.entries(0..at.cut + 1).rev();
        all.skip_while(move |(own, _)| *own >= at)
    }

    /// The entry that a range lies in or before.
    pub(super) fn entry_at(&self, range: &Range<usize>) -> Option<At> {
        let first = self.cuts.first_at(self.text.line_of(range.start));
        let from = self.entries(first..self.cuts.len());
        let mut behind = from.filter(|(at, _)| self.range_of(*at).end > range.start);
        behind.next().map(|(at, _)| at)
    }

    /// The block that a range lies in or before.
    pub(super) fn block_at(&self, range: &Range<usize>) -> Option<(At, &BlockEntry)> {
        let at = self.entry_at(range)?;
        Some((at, self.entry(at)?.block()?))
    }

    pub(super) fn last_block(&self, end: Option<At>) -> Option<At> {
        let cuts = 0..end.map_or(self.cuts.len(), |end| end.cut + 1);
        let mut all = self.entries(cuts).rev();
        let last = all.find(|(at, what)| what.block().is_some() && end.is_none_or(|end| *at < end));
        last.map(|(at, _)| at)
    }

    /// Whether another stop follows the one after a cut, with no block between: an open contour before them is meant to
    /// end there. The word that ends the program does not count: a tab may be left standing.
    pub(super) fn stops_again(&self, cut: usize) -> bool {
        let next = self.cuts.get(cut + 1);
        let stops = next.is_some_and(|next| !next.has_blocks() && next.stop.is_some());
        !self.is_end(cut) && stops && !self.is_end(cut + 1)
    }

    /// Whether the stop after a cut ends the program.
    fn is_end(&self, cut: usize) -> bool {
        self.view.end.is_some_and(|end| end.cut == cut)
    }

    /// The way between two contours, without the wire.
    pub(super) fn is_jump(&self, cut: usize) -> bool {
        let own = &self.cuts[cut];
        own.may_be_jump
            && cut > 0
            && own.stop.is_some()
            && !self.is_end(cut)
            && !self.stops_again(cut)
            && self.view.contours.of_cut(cut).is_none()
    }

    /// The contour that an entry lies in, or the way between two; `None` after the end.
    pub(super) fn contour_at(&self, at: At) -> Option<OneContour> {
        (at.cut < self.cut_count()).then(|| self.view.contours.cuts_of(at.cut))
    }

    /// An open contour, and those before and after its stops that are open too, as one: the fault may be in any of them.
    /// `None` where it is the only one.
    pub(super) fn with_open_beside(&self, cuts: &OneContour) -> Option<OneContour> {
        let is_open = |cut: &usize| self.is_open(*cut);
        if !self.is_open(cuts.start) {
            return None;
        }
        let before = cuts.start.checked_sub(1).filter(is_open);
        let behind = Some(cuts.end).filter(|cut| *cut < self.cut_count() && is_open(cut));
        let all = before.unwrap_or(cuts.start)..behind.map_or(cuts.end, |cut| cut + 1);
        (all != *cuts).then_some(all)
    }

    /// Whether a cut is a contour that does not close, and with which no other goes on.
    pub(super) fn is_open(&self, cut: usize) -> bool {
        let closes = self.cuts[cut].closes;
        !closes && self.view.contours.of_cut(cut).is_none() && self.may_go_on(cut)
    }

    pub(super) fn closes(&self, cuts: &OneContour) -> bool {
        !self.is_open(cuts.start)
    }

    /// The entries of a contour in their order, without its last stop.
    pub(super) fn entries_of(&self, cuts: &OneContour) -> impl DoubleEndedIterator<Item = At> + '_ {
        let last = cuts.end.saturating_sub(1);
        let stop = self.cuts.get(last).and_then(Cut::stop_entry);
        let is_own = move |at: &At| at.cut < last || stop.is_none_or(|stop| at.entry < stop);
        self.entries(cuts.clone()).map(|(at, _)| at).filter(is_own)
    }

    /// The blocks of a contour in their order.
    pub(super) fn blocks_of(&self, cuts: &OneContour) -> impl DoubleEndedIterator<Item = At> + '_ {
        let all = self.entries(cuts.clone());
        all.filter(|(_, entry)| entry.block().is_some())
            .map(|(at, _)| at)
    }

    pub(super) fn ends_of(&self, cuts: &OneContour) -> Ends {
        let mut all = self.cuts[cuts.clone()].iter().map(|cut| cut.verdict().ends);
        let first = all.next().unwrap_or_default();
        all.fold(first, |before, next| before.then(&next))
    }

    /// Twice the area between a contour and its chord, µm²; above 0 where it runs to the left.
    pub(super) fn twice_area(&self, cuts: &OneContour) -> f64 {
        let (mut area, mut at) = (0.0, Vector::zeros());
        for cut in &self.cuts[cuts.clone()] {
            let by = Vector::from(cut.travel.meant_um());
            area += cut.twice_area + cross(at, by);
            at += by;
        }
        area
    }

    pub(super) fn block_count(&self, cuts: &OneContour) -> usize {
        let blocks = self.cuts[cuts.clone()].iter().map(|cut| cut.blocks);
        blocks.sum::<u32>() as usize
    }

    pub(super) fn errors(&self, cuts: &OneContour) -> usize {
        let errors = self.cuts[cuts.clone()].iter().map(|cut| cut.rare().errors);
        errors.sum()
    }

    pub(super) fn unread(&self, cuts: &OneContour) -> usize {
        let unread = self.cuts[cuts.clone()].iter().map(|cut| cut.rare().unread);
        unread.sum()
    }

    /// Whether a stop follows the last stop before an entry: nothing is cut between.
    pub(super) fn is_behind_stop(&self, at: At) -> bool {
        let mut before = self.before(at).map(|(_, entry)| &entry.what);
        let is_stop =
            |what: &&What| matches!(what, What::Block(_) | What::Word { .. } | What::Unread);
        matches!(before.find(is_stop), Some(What::Word { .. }))
    }
}
