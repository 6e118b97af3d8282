//! The contours of a program: its cuts, and those that belong together, with stops within.

use super::block::Stop;
use super::document::Document;
use super::summary::Summary;
use crate::program::contours::Divided;
use crate::program::path::{ControlOffset, Verdict, Way};
use std::borrow::Cow;
use std::ops::Range;

/// Cuts that are one contour, with all their moves as one; bytes are those of the text.
#[derive(Clone, Debug)]
pub(crate) struct Contour<'a> {
    pub(crate) cuts: Range<usize>,
    pub(crate) sum: Summary,
    pub(crate) verdict: &'a Verdict,
    /// Another stop follows the one after it without a move between: an open contour is meant to end there.
    pub(crate) ends_open: bool,
}

impl Contour<'_> {
    /// The tolerance for its end at a place, µm.
    pub(crate) fn tolerance(&self) -> f64 {
        self.verdict.ends.tolerance()
    }
}

impl Divided for Document {
    const PIECES_ARE_ONE: bool = false;

    fn id(&self, cut: usize) -> u64 {
        self.cuts.id(cut)
    }

    fn verdict(&self, cut: usize) -> Cow<'_, Verdict> {
        match &self.cuts[cut].moves {
            Some(moves) => Cow::Borrowed(&moves.verdict),
            None => Cow::Owned(Verdict::default()),
        }
    }

    fn way(&self, cut: usize) -> Way {
        match &self.cuts[cut].moves {
            Some(_) => self.way_in(cut),
            None => Way::default(),
        }
    }

    /// A single stop is after it.
    fn may_go_on(&self, cut: usize) -> bool {
        self.encloses_nothing(cut) && self.stops_behind(cut).0 == 1
    }

    /// After a single stop the wire goes on from where it stands.
    fn behind_stop(&self, cut: usize) -> Option<usize> {
        let (stops, next) = self.stops_behind(cut);
        let end = self.sum_at(cut)?.last[1].to;
        let goes_on = self.sum_at(next)?.first[0].from == end;
        (stops == 1 && goes_on && self.encloses_nothing(next)).then_some(next)
    }

    fn stands_alone(&self, _: usize) -> bool {
        false
    }

    fn is_doubtful(&self, cuts: &Range<usize>) -> bool {
        let mut sums = self.cuts[cuts.clone()].iter().filter_map(|cut| cut.sum());
        sums.any(|sum| !sum.whole || sum.faulty)
    }

    fn control_offset(&self, cuts: &Range<usize>) -> Option<ControlOffset> {
        self.sum_of(cuts)?.control_offset(&self.control)
    }
}

impl Document {
    /// The moves of a cut, summed up, in their place.
    pub(super) fn sum_at(&self, cut: usize) -> Option<Summary> {
        let (at, byte) = (self.cuts.state_before(cut).at, self.cuts.byte(cut));
        self.cuts.get(cut)?.sum().map(|sum| sum.shifted(at, byte))
    }

    fn sum_of(&self, cuts: &Range<usize>) -> Option<Summary> {
        let mut sums = cuts.clone().filter_map(|cut| self.sum_at(cut));
        let first = sums.next()?;
        Some(sums.fold(first, |mut sum, next| {
            sum.append(&next);
            sum
        }))
    }

    /// It does not enclose anything by itself.
    fn encloses_nothing(&self, cut: usize) -> bool {
        let moves = self.cuts[cut].moves.as_ref();
        moves.is_some_and(|moves| moves.sum.whole && !moves.verdict.goes_round)
    }

    /// How many pauses are between a cut and the next one that cuts; and that one, or the end.
    pub(super) fn stops_behind(&self, cut: usize) -> (usize, usize) {
        let own = matches!(self.cuts[cut].stop, Some((Stop::Pause, _)));
        let next = self.cuts.get(cut + 1);
        let before = next.map_or(0, |next| next.pauses_before as usize);
        let cuts = next.is_some_and(|next| next.cuts);
        let next = if cuts { cut + 1 } else { self.cuts.len() };
        (usize::from(own) + before, next)
    }

    /// The contour that begins with a cut; `None` for one without moves, and for the tab of another.
    pub(super) fn contour(&self, cut: usize) -> Option<Contour<'_>> {
        let known = self.contours.of_cut(cut);
        let cuts = known.map_or(cut..cut + 1, |known| known.cuts.clone());
        let moves = self.cuts[cut]
            .moves
            .as_ref()
            .filter(|_| cuts.start == cut)?;
        let ends_open = self
            .cuts
            .get(cuts.end)
            .is_some_and(|behind| behind.pauses_again);
        let verdict = match known {
            Some(known) => known.verdict(),
            None => &moves.verdict,
        };
        Some(Contour {
            sum: self.sum_of(&cuts)?,
            verdict,
            ends_open,
            cuts,
        })
    }
}
