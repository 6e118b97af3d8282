//! The findings about single contours: those that do not close, and those that cross themselves.
//!
//! They depend on the contour's own lines, on those of the cuts around it, and on a little that
//! comes before it: after an edit only contours for which one of these may have changed are judged
//! again. The search for the block to blame is repeated only where one of the lines that it looks
//! at has changed.

use super::super::repair::FEWEST_BLAMED;
use super::super::rules;
use super::{At, Document, JoinedCut, View};
use crate::finding::{Axis, Fault, Finding};
use crate::geometry::Vector;
use crate::program::by_chunk::{Begun, ByChunk};
use crate::program::chunks::Reread;
use crate::program::contours::{PartAt, Touched};
use crate::program::followed::Followed;
use crate::program::numbering;
use crate::program::of_cut::OfCut;
use crate::program::path::{HasCuts, tolerance};
use crate::program::work::{self, Work};
use crate::toolpath::each;
use rustc_hash::FxHashMap;

/// The findings about a contour may depend on the lines of this many cuts with blocks on either
/// side of it: on its stops, on those of the contour before, and on the cuts beside it.
const CUTS_ABOUT: usize = 24;

/// Contours that are judged together, and how many of them one core takes at a time: an edit touches fewer.
const JUDGED_AT_ONCE: usize = 1024;
const FEW_JUDGED: usize = 128;

/// An open contour, and what is said of it.
struct Opened {
    cut: JoinedCut,
    /// With the open ones beside it.
    whole: Option<JoinedCut>,
    /// Equal for equal searches for a block to blame; none is searched for where it is not there.
    mark: Option<u64>,
    findings: Vec<Finding>,
}

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
    pub(super) found: ByChunk<OfCut>,
    searched: ByChunk<Searched>,
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
        let (mut searched, known_before) = (Vec::new(), known.len());
        let begins: Vec<PartAt> = contours.open_within(from..to).collect();
        let some = begins.chunks(JUDGED_AT_ONCE);
        let judged = some.flat_map(|some| self.judge_open(some, &mut known, &mut searched));
        let kept = (&self.stretches, contours);
        let found = OfCut::all(self, kept, from..to, judged, |cut| !self.is_odd(cut));
        work::add(Work::Blames, known.len() - known_before);
        told.found.splice(&touched, found);
        told.searched.splice(&touched, searched);
        self.view.told = told;
    }

    /// The stretches that were not read again in which the wire is taken elsewhere by hand now but
    /// was not `before`, or the reverse.
    pub(super) fn taken_elsewhere(
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

    /// `not-closed` of the contours that begin at some parts, and the blocks to blame where that is plain, with the searches
    /// for them, of which the results of some are `known`.
    fn judge_open(
        &self,
        begins: &[PartAt],
        known: &mut FxHashMap<u64, Blamed>,
        searched: &mut Vec<Searched>,
    ) -> Vec<(PartAt, Vec<Finding>)> {
        let opened = each(begins.len(), FEW_JUDGED, |nth| self.opened(begins[nth]));
        let mut opened: Vec<Opened> = opened.into_iter().flatten().collect();
        // Equal searches are made once.
        let asked = opened.iter().flat_map(|one| Some((one.mark?, one)));
        let mut unknown: Vec<(u64, &Opened)> = asked
            .filter(|(mark, _)| !known.contains_key(mark))
            .collect();
        unknown.sort_by_key(|(mark, _)| *mark);
        unknown.dedup_by_key(|(mark, _)| *mark);
        let blamed = each(unknown.len(), FEW_JUDGED, |nth| {
            let (mark, Opened { cut, whole, .. }) = unknown[nth];
            let blamed = self.blamed(cut, whole.as_ref().unwrap_or(cut));
            (mark, blamed.map(Box::new))
        });
        known.extend(blamed);
        for Opened {
            cut,
            mark,
            findings,
            ..
        } in &mut opened
        {
            let Some((mark, blamed)) = mark.and_then(|mark| Some((mark, known.get(&mark)?))) else {
                continue;
            };
            findings.extend(blamed.as_ref().and_then(|blamed| self.blame(cut, blamed)));
            searched.push(Searched {
                begin: cut.parts[0],
                mark,
                blamed: blamed.clone(),
            });
        }
        let told = |one: Opened| (one.cut.parts[0], one.findings);
        opened.into_iter().map(told).collect()
    }

    /// What is known of the open contour that begins at a part without a search.
    fn opened(&self, begin: PartAt) -> Option<Opened> {
        let cut = self.cut_from(begin)?;
        let is_fragment = self.view.end.is_none() || self.is_fragment(&cut);
        let mut opened = Opened {
            whole: None,
            mark: None,
            findings: Vec::new(),
            cut,
        };
        let cut = &opened.cut;
        if cut.sum.unread > 0 || (is_fragment && self.leads_out(cut)) {
            return Some(opened);
        }
        opened.findings.extend(self.not_closed(cut, is_fragment));
        let may_be_one_field =
            cut.sum.errors == 0 && cut.sum.blocks >= FEWEST_BLAMED && !self.lacks_a_number(cut);
        if may_be_one_field && !is_fragment {
            opened.whole = self.with_open_beside(cut);
            opened.mark = self.mark_of_search(cut, opened.whole.as_ref().unwrap_or(cut));
        }
        Some(opened)
    }

    /// The finding of the block to blame.
    fn blame(&self, cut: &JoinedCut, (nth, fault): &(usize, Fault)) -> Option<Finding> {
        let at = self.blocks_of(cut).nth(*nth)?;
        let spot = match fault {
            Fault::QuadrantKeepsOpen { .. } => rules::Spot::Motion,
            Fault::AxisKeepsOpen { .. } => rules::Spot::Axis,
            Fault::JKeepsOpen { .. } => rules::Spot::J,
            Fault::NumberKeepsOpen { axis: Axis::X, .. } => rules::Spot::X,
            Fault::NumberKeepsOpen { axis: Axis::Y, .. } => rules::Spot::Y,
            _ => rules::Spot::Block,
        };
        let range = self.spot_range(spot, self.range_of(at));
        Some(Finding::of(fault.clone(), range))
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
