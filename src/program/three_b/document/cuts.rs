//! The division of a program into contours and the ways between them: the blocks from one word to the next.

use super::super::entry::{BlockEntry, Entry};
use super::super::stretch::Stretch;
use super::super::sum::{Sum, is_jump};
use super::{At, Document, JoinedCut, PartAt, View};
use crate::program::chunks::Reread;
use std::ops::Range;

impl Document {
    /// The word that ends the program: the first of the controller's own, else the last that ends programs elsewhere,
    /// else a pause with no block behind it.
    pub(super) fn end_word(&self) -> Option<At> {
        let place = |stretch: usize, entry: Option<usize>| entry.map(|entry| At { stretch, entry });
        let mut stretches = self.stretches.iter().enumerate();
        let own = stretches.find_map(|(stretch, of)| place(stretch, of.own_end));
        let back = || self.stretches.iter().enumerate().rev();
        let foreign = || back().find_map(|(stretch, of)| place(stretch, of.last_end));
        let pause = || {
            let last = back().find_map(|(stretch, of)| place(stretch, of.last_word))?;
            self.last_block(None)
                .filter(|block| *block < last)
                .map(|_| last)
        };
        own.or_else(foreign).or_else(pause)
    }

    /// The content of a stretch.
    pub(super) fn entries_in(&self, stretch: usize) -> &[Entry] {
        self.stretches.get(stretch).map_or(&[], |of| &of.entries)
    }

    /// The content of some stretches, in order.
    pub(super) fn entries(
        &self,
        stretches: Range<usize>,
    ) -> impl DoubleEndedIterator<Item = (At, &Entry)> {
        stretches.flat_map(move |stretch| {
            let entries = self.entries_in(stretch).iter().enumerate();
            entries.map(move |(entry, what)| (At { stretch, entry }, what))
        })
    }

    /// The entries from one on.
    pub(super) fn from(&self, at: At) -> impl Iterator<Item = (At, &Entry)> {
        let all = self.entries(at.stretch..self.stretches.len());
        all.skip_while(move |(own, _)| *own < at)
    }

    /// The entries before one, the nearest first.
    pub(super) fn before(&self, at: At) -> impl Iterator<Item = (At, &Entry)> {
        let all = self.entries(0..at.stretch + 1).rev();
        all.skip_while(move |(own, _)| *own >= at)
    }

    /// The entry that a range lies in or before.
    pub(super) fn entry_at(&self, range: &Range<usize>) -> Option<At> {
        let stretch = self.stretches.at(range.start);
        let entries = self.entries_in(stretch);
        let local = range.start.checked_sub(self.stretches.byte(stretch))?;
        let entry = entries.partition_point(|entry| entry.range().end <= local);
        (entry < entries.len()).then_some(At { stretch, entry })
    }

    /// The block that a range lies in or before.
    pub(super) fn block_at(&self, range: &Range<usize>) -> Option<(At, &BlockEntry)> {
        let at = self.entry_at(range)?;
        Some((at, self.entry(at)?.block()?))
    }

    pub(super) fn last_block(&self, end: Option<At>) -> Option<At> {
        let mut blocks = self
            .entries(0..self.stretches.len())
            .rev()
            .filter(|(_, what)| what.block().is_some());
        let (last, _) = blocks.find(|(at, _)| end.is_none_or(|end| *at < end))?;
        Some(last)
    }

    /// The blocks from a part on, up to the next word; `None` behind the end of the program.
    pub(super) fn cut_from(&self, start: PartAt, end: Option<At>) -> Option<JoinedCut> {
        let mut cut: Option<JoinedCut> = None;
        let (mut stretch, mut index) = start;
        while let Some(of) = self.stretches.get(stretch) {
            let at = |entry: usize| At { stretch, entry };
            for (nth, part) in of.parts.iter().enumerate().skip(index) {
                if end.is_some_and(|end| end < at(part.entries().start)) {
                    return cut;
                }
                let own = cut.get_or_insert(JoinedCut {
                    parts: [(stretch, nth); 2],
                    sum: Sum::default(),
                    is_jump: false,
                    stop: None,
                    goes_round: false,
                    crosses_nothing: false,
                });
                own.parts[1] = (stretch, nth);
                own.sum = own.sum.then(&of.sum(part));
                if part.word.is_some() {
                    let is_end = end == Some(at(part.entries().end));
                    own.is_jump = start != (0, 0)
                        && self.is_behind_word(start)
                        && !is_end
                        && is_jump(&own.sum)
                        && !self.stops_again((stretch, nth), end);
                    return cut;
                }
            }
            (stretch, index) = (stretch + 1, 0);
        }
        cut
    }

    /// Whether a word stands somewhere before a part at which a cut begins.
    fn is_behind_word(&self, (stretch, part): PartAt) -> bool {
        part > 0
            || self.stretches[..stretch.min(self.stretches.len())]
                .iter()
                .rev()
                .any(|stretch| stretch.words > 0)
    }

    /// Whether another word follows the one behind a part, with no block between: an open contour before them is meant
    /// to end there. The word that ends the program does not count: a tab may be left standing.
    pub(super) fn stops_again(&self, part: PartAt, end: Option<At>) -> bool {
        let (mut stretch, mut index) = self.part_behind(part);
        while let Some(of) = self.stretches.get(stretch) {
            for part in of.parts.iter().skip(index) {
                if part.has_blocks {
                    return false;
                }
                if part.word.is_some() {
                    let entry = part.entries().end;
                    return Some(At { stretch, entry }) != end;
                }
            }
            (stretch, index) = (stretch + 1, 0);
        }
        false
    }

    /// The part behind another one.
    pub(super) fn part_behind(&self, (stretch, part): PartAt) -> PartAt {
        if self
            .stretches
            .get(stretch)
            .is_some_and(|of| part + 1 < of.parts.len())
        {
            (stretch, part + 1)
        } else {
            (stretch + 1, 0)
        }
    }

    /// The cuts that are not parts of one stretch.
    pub(super) fn outer_cuts(&self, end: Option<At>) -> Vec<JoinedCut> {
        let mut cuts = Vec::new();
        let mut start = Some((0, 0));
        while let Some(cut) = start.and_then(|start| self.cut_from(start, end)) {
            start = self.outer_start_behind(&cut);
            cuts.push(cut);
        }
        cuts
    }

    /// Where the next of them begins; `None` behind the last.
    fn outer_start_behind(&self, cut: &JoinedCut) -> Option<PartAt> {
        let (stretch, part) = cut.parts[1];
        let parts = self.stretches.get(stretch)?.parts.len();
        (part + 1 < parts).then_some((stretch, parts - 1))
    }

    /// The same after an edit: what lies apart from what was read again is as it was before, behind it perhaps some stretches on.
    pub(super) fn outer_cuts_after(
        &self,
        before: View,
        reread: &Reread,
        end: Option<At>,
    ) -> Vec<JoinedCut> {
        let moved = |at: At| {
            let stretch = reread.moved(at.stretch)?;
            Some(At { stretch, ..at })
        };
        if before.end.map(moved) != end.map(Some) {
            return self.outer_cuts(end);
        }
        let mut cuts = before.outer;
        // How the last one before the edit ends may depend on what stands behind its word: it is asked again.
        let kept = cuts
            .partition_point(|cut| cut.parts[1].0 < reread.chunks.start)
            .saturating_sub(1);
        let mut fresh: Vec<JoinedCut> = Vec::new();
        let mut start = match kept.checked_sub(1).and_then(|last| cuts.get(last)) {
            Some(last) => self.outer_start_behind(last),
            None => Some((0, 0)),
        };
        let mut same_from = cuts.len();
        while let Some(at) = start {
            if at.0 >= reread.chunks.end
                && let Some(same) = place_of_moved(&cuts, reread, at)
                && same > 0
                && kept + fresh.len() > 0
            {
                same_from = same;
                break;
            }
            let Some(cut) = self.cut_from(at, end) else {
                break;
            };
            start = self.outer_start_behind(&cut);
            fresh.push(cut);
        }
        if reread.chunks.len() != reread.before {
            for cut in cuts.iter_mut().skip(same_from) {
                for part in &mut cut.parts {
                    part.0 = reread.moved(part.0).unwrap_or(part.0);
                }
            }
        }
        cuts.splice(kept..same_from, fresh);
        cuts
    }

    /// The contour that a part belongs to, or the way between two: its cut, and those before and behind at its tabs.
    pub(super) fn cut_of_part(&self, view: &View, part: PartAt) -> Option<JoinedCut> {
        let mut cut = self.own_cut_of_part(view, part)?;
        while view.tabs.binary_search(&cut.parts[0]).is_ok() {
            let (stretch, part) = cut.parts[0];
            // Its word stands at the end of the part before.
            let Some(before) = part
                .checked_sub(1)
                .and_then(|part| self.own_cut_of_part(view, (stretch, part)))
            else {
                break;
            };
            cut = joined(before, &cut);
        }
        loop {
            let next = self.part_behind(cut.parts[1]);
            let Some(behind) = view
                .tabs
                .binary_search(&next)
                .ok()
                .and_then(|_| self.cut_from(next, view.end))
            else {
                break;
            };
            cut = joined(cut, &behind);
        }
        Some(cut)
    }

    /// The cut that a part belongs to.
    fn own_cut_of_part(&self, view: &View, (stretch, part): PartAt) -> Option<JoinedCut> {
        let of = self.stretches.get(stretch)?;
        if part > 0 && part + 1 < of.parts.len() {
            return self.cut_from((stretch, part), view.end);
        }
        let index = view
            .outer
            .partition_point(|cut| cut.parts[1] < (stretch, part));
        view.outer.get(index).cloned()
    }

    pub(super) fn is_jump(&self, part: PartAt) -> bool {
        let parts = self.stretches.get(part.0).map_or(&[][..], |of| &of.parts);
        let is_inner = part.1 > 0 && part.1 + 1 < parts.len();
        if is_inner && parts.get(part.1).is_some_and(|own| !own.may_be_jump) {
            return false;
        }
        self.cut_of_part(&self.view, part)
            .is_some_and(|cut| cut.is_jump)
    }

    /// Whether the cut that begins with a part continues the contour before it.
    pub(super) fn is_tab(&self, part: PartAt) -> bool {
        self.view.tabs.binary_search(&part).is_ok()
    }

    pub(super) fn closes(&self, view: &View, cut: &JoinedCut) -> bool {
        view.open.binary_search(&cut.parts[0]).is_err()
    }

    /// Of the cuts within one stretch that it names, those up to the end of the program.
    pub(super) fn inner_cuts<'a>(
        &'a self,
        end: Option<At>,
        named: fn(&Stretch) -> &[usize],
    ) -> impl Iterator<Item = JoinedCut> + 'a {
        let up_to = end.map_or(usize::MAX, |end| end.stretch);
        let stretches = self
            .stretches
            .iter()
            .enumerate()
            .take_while(move |(stretch, _)| *stretch <= up_to);
        stretches.flat_map(move |(stretch, of)| {
            named(of)
                .iter()
                .filter_map(move |part| self.cut_from((stretch, *part), end))
        })
    }

    /// The entries of a cut in their order.
    pub(super) fn entries_of(&self, cut: &JoinedCut) -> impl DoubleEndedIterator<Item = At> + '_ {
        let [(first_stretch, first_part), (last_stretch, last_part)] = cut.parts;
        let entries = |(stretch, part): PartAt| {
            let parts = self
                .stretches
                .get(stretch)
                .and_then(|of| of.parts.get(part));
            parts.map_or(0..0, |part| part.entries())
        };
        let (first, last) = (
            entries((first_stretch, first_part)),
            entries((last_stretch, last_part)),
        );
        let is_within = move |at: &At| {
            (at.stretch > first_stretch || at.entry >= first.start)
                && (at.stretch < last_stretch || at.entry < last.end)
        };
        let all = self
            .entries(first_stretch..last_stretch + 1)
            .map(|(at, _)| at);
        all.filter(is_within)
    }

    /// The blocks of a cut in their order.
    pub(super) fn blocks_of(&self, cut: &JoinedCut) -> impl DoubleEndedIterator<Item = At> + '_ {
        let is_block = |at: &At| self.entry(*at).is_some_and(|entry| entry.block().is_some());
        self.entries_of(cut).filter(is_block)
    }

    pub(super) fn last_block_of(&self, cut: &JoinedCut) -> Option<At> {
        self.blocks_of(cut).next_back()
    }

    pub(super) fn cut_of(&self, at: At) -> Option<JoinedCut> {
        self.stretches.get(at.stretch)?;
        self.cut_of_part(&self.view, (at.stretch, self.part_of(at)))
    }

    /// The part of its stretch that an entry lies in.
    pub(super) fn part_of(&self, at: At) -> usize {
        self.stretches.get(at.stretch).map_or(0, |of| {
            of.parts
                .partition_point(|part| part.entries().end <= at.entry)
        })
    }
}

/// A cut and the one behind its stop as one contour.
pub(super) fn joined(cut: JoinedCut, behind: &JoinedCut) -> JoinedCut {
    JoinedCut {
        parts: [cut.parts[0], behind.parts[1]],
        sum: cut.sum.then(&behind.sum),
        is_jump: false,
        stop: cut.stop.or(Some(cut.sum.blocks)),
        goes_round: false,
        crosses_nothing: false,
    }
}

/// The cut that begins at a part which stood elsewhere before, perhaps.
fn place_of_moved(cuts: &[JoinedCut], reread: &Reread, at: PartAt) -> Option<usize> {
    let begin = |cut: &JoinedCut| {
        let (stretch, part) = cut.parts[0];
        (reread.moved(stretch).unwrap_or(reread.chunks.start), part)
    };
    let first = cuts.partition_point(|cut| begin(cut) < at);
    cuts.get(first)
        .filter(|cut| begin(cut) == at)
        .map(|_| first)
}
