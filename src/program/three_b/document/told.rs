//! The findings about single contours: those that do not close, and those that cross themselves.
//!
//! They depend on the contour's own lines, on those of the cuts around it, and on a little that
//! comes before it: after an edit only contours for which one of these may have changed are judged
//! again. The search for the block to blame is repeated only where one of the lines that it looks
//! at has changed.

use super::super::fields::fields_of;
use super::super::repair::FEWEST_BLAMED;
use super::super::rules;
use super::{At, Document, JoinedCut, View};
use crate::finding::{Axis, Fault, Finding};
use crate::geometry::Vector;
use crate::program::by_chunk::{Begun, ByChunk};
use crate::program::chunks::Reread;
use crate::program::contours::{PartAt, Touched};
use crate::program::numbering;
use crate::program::of_cut::OfCut;
use crate::program::path::{HasCuts, tolerance};
use rustc_hash::FxHashMap;

/// The findings about a contour may depend on the lines of this many cuts with blocks on either
/// side of it: on its stops, on those of the contour before, and on the cuts beside it.
const CUTS_ABOUT: usize = 24;

/// An open contour in which a block to blame was searched for.
#[derive(Clone, Debug, PartialEq)]
struct Searched {
    begin: PartAt,
    /// Equal for searches with the same result.
    mark: u64,
    blamed: Blamed,
}

impl Begun for Searched {
    type Sum = ();

    fn begin(&self) -> PartAt {
        self.begin
    }

    fn renumber(&mut self, moved: &dyn Fn(usize) -> usize) {
        self.begin.0 = moved(self.begin.0);
    }

    fn sum(_: &[Searched]) {}
}

/// The block to blame, by its number in the contour.
type Blamed = Option<Box<(usize, Fault)>>;

/// All findings about single contours, in the order in which the contours begin.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Told {
    found: ByChunk<OfCut>,
    searched: ByChunk<Searched>,
    /// How many contours were judged for the last edit, and in how many of them a block to blame
    /// was searched for.
    #[cfg(test)]
    pub(super) judged: [usize; 2],
}

impl Told {
    pub(super) fn found(&self) -> &ByChunk<OfCut> {
        &self.found
    }
}

impl Document {
    /// Judges the contours between two places, and all others that may depend on lines that were
    /// read again, or on differences from the view `before`.
    pub(super) fn judge_contours(&mut self, before: View, touched: Touched<'_>) {
        let Touched { reread, from, to } = touched;
        let View {
            mut told,
            numbers,
            taken,
            ..
        } = before;
        let is_all = reread.before == 0 || numbers.step != self.view.numbers.step;
        let all = Reread::all(&self.stretches);
        let reread = if is_all { &all } else { reread };
        let [from, to] = if is_all {
            told = Told::default();
            [(0, 0), (self.stretches.len(), 0)]
        } else {
            let all = [
                (reread.chunks.start, 0).min(from),
                (reread.chunks.end, 0).max(to),
            ];
            let others = numbers.others(&self.view.numbers, reread);
            let others = others.chain(self.taken_elsewhere(&taken, reread));
            let [from, to] = others.fold(all, |[from, to], stretch| {
                [from.min((stretch, 0)), to.max((stretch + 1, 0))]
            });
            [self.cuts_before(from), self.cuts_behind(to)]
        };
        let touched = Touched { reread, from, to };
        let gone = told.searched.touched(&touched);
        let mut known: FxHashMap<u64, Blamed> =
            gone.map(|one| (one.mark, one.blamed.clone())).collect();
        let contours = &self.view.contours;
        let (mut searched, mut searches) = (Vec::new(), 0);
        let judged = contours.open_within(from..to).map(|begin| {
            let before = known.len();
            let cut = self.cut_from(begin);
            let (findings, own) =
                cut.map_or_else(Default::default, |cut| self.judge_open(&cut, &mut known));
            searched.extend(own);
            searches += known.len() - before;
            (begin, findings)
        });
        let kept = (&self.stretches, contours);
        let (found, asked) = OfCut::all(self, kept, from..to, judged, |cut| !self.is_odd(cut));
        told.found.splice(&touched, found);
        told.searched.splice(&touched, searched);
        #[cfg(test)]
        (told.judged = [asked, searches]);
        #[cfg(not(test))]
        let _ = (asked, searches);
        self.view.told = told;
    }

    /// The stretches that were not read again in which the wire is taken elsewhere by hand now but
    /// was not `before`, or the reverse.
    fn taken_elsewhere(
        &self,
        before: &[(At, Vector)],
        reread: &Reread,
    ) -> impl Iterator<Item = usize> + use<> {
        let moved = |(at, _): &(At, Vector)| {
            let stretch = reread.moved(at.stretch)?;
            Some(At { stretch, ..*at })
        };
        let before: Vec<At> = before.iter().filter_map(moved).collect();
        let now = self.view.taken.iter().map(|(at, _)| *at);
        let now: Vec<At> = now
            .filter(|at| !reread.chunks.contains(&at.stretch))
            .collect();
        let only_in = |some: &[At], others: &[At]| -> Vec<usize> {
            let only = some.iter().filter(|at| others.binary_search(at).is_err());
            only.map(|at| at.stretch).collect()
        };
        let [gone, come] = [only_in(&before, &now), only_in(&now, &before)];
        gone.into_iter().chain(come)
    }

    /// Where the cut begins that lies [`CUTS_ABOUT`] cuts before a place.
    fn cuts_before(&self, mut at: PartAt) -> PartAt {
        let mut cuts = 0;
        loop {
            let before = match at {
                (0, 0) => return at,
                (stretch, 0) => {
                    let parts = self.stretches[stretch - 1].parts.len();
                    (stretch - 1, parts.saturating_sub(1))
                }
                (stretch, part) => (stretch, part - 1),
            };
            cuts += usize::from(self.ends_cut(before));
            if cuts > CUTS_ABOUT {
                return at;
            }
            at = before;
        }
    }

    /// Where the cut begins that lies as many cuts after a place.
    fn cuts_behind(&self, mut at: PartAt) -> PartAt {
        let mut cuts = 0;
        while at.0 < self.stretches.len() && cuts <= CUTS_ABOUT {
            cuts += usize::from(self.ends_cut(at));
            at = self.part_behind(at);
        }
        at
    }

    /// Whether a part that has blocks ends with a word.
    fn ends_cut(&self, (stretch, part): PartAt) -> bool {
        let of = self.stretches.get(stretch);
        of.and_then(|of| of.parts.get(part))
            .is_some_and(|part| part.has_blocks && part.word.is_some())
    }

    /// True for the way back to the thread hole, after a stop at the end of a closed contour.
    fn leads_out(&self, cut: &JoinedCut) -> bool {
        let (stretch, part) = cut.parts[0];
        let before = part
            .checked_sub(1)
            .and_then(|part| self.cut_of_part((stretch, part)));
        before.is_some_and(|before| {
            let whole = before.sum.then(&cut.sum);
            !before.is_jump && whole.travel.is_within(tolerance(whole.arcs))
        })
    }

    /// `not-closed`, and the block to blame where that is plain, with the search for it.
    fn judge_open(
        &self,
        cut: &JoinedCut,
        known: &mut FxHashMap<u64, Blamed>,
    ) -> (Vec<Finding>, Option<Searched>) {
        let is_fragment = self.view.end.is_none() || self.is_fragment(cut);
        if cut.sum.unread > 0 || (is_fragment && self.leads_out(cut)) {
            return (Vec::new(), None);
        }
        let mut findings: Vec<Finding> = self.not_closed(cut, is_fragment).into_iter().collect();
        let may_be_one_field =
            cut.sum.errors == 0 && cut.sum.blocks >= FEWEST_BLAMED && !self.lacks_a_number(cut);
        if is_fragment || !may_be_one_field {
            return (findings, None);
        }
        let searched = self.searched_for_blame(cut, known);
        if let Some(Searched {
            blamed: Some(blamed),
            ..
        }) = &searched
            && let Some(at) = self.blocks_of(cut).nth(blamed.0)
        {
            let fault = blamed.1.clone();
            let spot = match &fault {
                Fault::QuadrantKeepsOpen { .. } => rules::Spot::Motion,
                Fault::AxisKeepsOpen { .. } => rules::Spot::Axis,
                Fault::JKeepsOpen { .. } => rules::Spot::J,
                Fault::NumberKeepsOpen { axis: Axis::X, .. } => rules::Spot::X,
                Fault::NumberKeepsOpen { axis: Axis::Y, .. } => rules::Spot::Y,
                _ => rules::Spot::Block,
            };
            let block = self.range_of(at);
            let range = fields_of(self.text.bytes(), block.clone())
                .map_or(block.clone(), |fields| spot.range(&fields, block));
            findings.push(Finding::of(fault, range));
        }
        (findings, searched)
    }

    /// Searches an open contour for the block to blame, where the result is not `known`.
    fn searched_for_blame(
        &self,
        cut: &JoinedCut,
        known: &mut FxHashMap<u64, Blamed>,
    ) -> Option<Searched> {
        let whole = self.with_open_beside(cut);
        let whole = whole.as_ref().unwrap_or(cut);
        let mark = self.mark_of_search(cut, whole)?;
        let search = || self.blamed(cut, whole).map(Box::new);
        Some(Searched {
            begin: cut.parts[0],
            mark,
            blamed: known.entry(mark).or_insert_with(search).clone(),
        })
    }

    /// Whether the numbers of a cut have a gap: a block is lost then.
    fn lacks_a_number(&self, cut: &JoinedCut) -> bool {
        let numbers: Vec<u32> = self
            .blocks_of(cut)
            .filter_map(|at| self.entry(at)?.number())
            .collect();
        let steps = || {
            numbers
                .windows(2)
                .filter_map(|pair| numbering::step(pair[0], pair[1]))
        };
        steps()
            .min()
            .is_some_and(|usual| steps().any(|step| step > usual))
    }
}
