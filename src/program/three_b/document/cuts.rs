//! The division of a program into contours and the ways between them: the blocks from one word to the next.

use super::super::entry::{BlockEntry, Entry};
use super::{At, Document, JoinedCut, PartAt};
use crate::program::chunks::Reread;
use crate::program::followed::Followed;
use std::ops::Range;

impl Document {
    /// The word that ends the program: the first of the controller's own, else the last that ends programs elsewhere,
    /// else a pause with no block after it.
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

    /// Whether a word stands somewhere before a part at which a cut begins.
    pub(super) fn is_behind_word(&self, (stretch, part): PartAt) -> bool {
        part > 0
            || self.stretches[..stretch.min(self.stretches.len())]
                .iter()
                .rev()
                .any(|stretch| stretch.words > 0)
    }

    /// Whether another word follows the one after a part, with no block between: an open contour before them is meant
    /// to end there. The word that ends the program does not count: a tab may be left standing.
    pub(super) fn stops_again(&self, part: PartAt) -> bool {
        let (mut stretch, mut index) = self.part_behind(part);
        while let Some(of) = self.stretches.get(stretch) {
            for part in of.parts.iter().skip(index) {
                if part.has_blocks {
                    return false;
                }
                if part.word.is_some() {
                    let entry = part.entries().end;
                    return Some(At { stretch, entry }) != self.view.end;
                }
            }
            (stretch, index) = (stretch + 1, 0);
        }
        false
    }

    /// The part after another one.
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

    /// Where the next cut that is not a part of one stretch begins; `None` after the last.
    fn outer_start_behind(&self, cut: &JoinedCut) -> Option<PartAt> {
        let (stretch, part) = cut.parts[1];
        let parts = self.stretches.get(stretch)?.parts.len();
        (part + 1 < parts).then_some((stretch, parts - 1))
    }

    /// Finds the cuts that are not parts of one stretch: cuts away from the lines that were read
    /// again are as before, after these lines perhaps from a few stretches on. Returns where the
    /// first of the others begins and the last ends.
    pub(super) fn find_outer(&self, cuts: &mut Vec<JoinedCut>, reread: &Reread) -> [PartAt; 2] {
        // How the last cut before the edit ends may depend on what follows its word: it is found again.
        let kept = cuts
            .partition_point(|cut| cut.parts[1].0 < reread.chunks.start)
            .saturating_sub(1);
        let mut fresh: Vec<JoinedCut> = Vec::new();
        let from = match kept.checked_sub(1).and_then(|last| cuts.get(last)) {
            Some(last) => self.outer_start_behind(last),
            None => Some((0, 0)),
        };
        let behind = (self.stretches.len(), 0);
        let mut to = behind;
        let mut start = from;
        let mut same_from = cuts.len();
        while let Some(at) = start {
            if at.0 >= reread.chunks.end
                && let Some(same) = place_of_moved(cuts, reread, at)
                && same > 0
                && kept + fresh.len() > 0
            {
                (same_from, to) = (same, at);
                break;
            }
            let Some(cut) = self.cut_from(at) else {
                break;
            };
            start = self.outer_start_behind(&cut);
            fresh.push(cut);
        }
        if reread.chunks.len() != reread.before {
            let moved = |stretch: usize| reread.moved(stretch).unwrap_or(stretch);
            for cut in cuts.iter_mut().skip(same_from) {
                cut.parts = cut.parts.map(|(stretch, part)| (moved(stretch), part));
            }
        }
        cuts.splice(kept..same_from, fresh);
        [from.unwrap_or(behind), to]
    }

    /// The contour that a part belongs to, or the way between two: its cut, and those before and after at its tabs.
    pub(super) fn cut_of_part(&self, part: PartAt) -> Option<JoinedCut> {
        let mut cut = self.own_cut_of_part(part)?;
        while self.is_tab(cut.parts[0]) {
            let (stretch, part) = cut.parts[0];
            // Its word stands at the end of the part before.
            let Some(before) = part
                .checked_sub(1)
                .and_then(|part| self.own_cut_of_part((stretch, part)))
            else {
                break;
            };
            cut = self.joined(before, &cut);
        }
        loop {
            let next = self.part_behind(cut.parts[1]);
            let is_tab = self.is_tab(next);
            let Some(behind) = is_tab.then(|| self.cut_from(next)).flatten() else {
                break;
            };
            cut = self.joined(cut, &behind);
        }
        Some(cut)
    }

    /// An open cut, and those before and after its stops that are open too, as one: the fault may
    /// be in any of them. `None` where it is the only one.
    pub(super) fn with_open_beside(&self, cut: &JoinedCut) -> Option<JoinedCut> {
        let is_open = |cut: &JoinedCut| !self.closes(cut);
        if !is_open(cut) {
            return None;
        }
        let (stretch, part) = cut.parts[0];
        let before = part
            .checked_sub(1)
            .and_then(|part| self.own_cut_of_part((stretch, part)))
            .filter(is_open);
        let behind = self
            .cut_from(self.part_behind(cut.parts[1]))
            .filter(is_open);
        let whole = match &before {
            Some(before) => self.joined(before.clone(), cut),
            None => cut.clone(),
        };
        match behind {
            Some(behind) => Some(self.joined(whole, &behind)),
            None => before.map(|_| whole),
        }
    }

    /// The cut that a part belongs to.
    fn own_cut_of_part(&self, (stretch, part): PartAt) -> Option<JoinedCut> {
        let of = self.stretches.get(stretch)?;
        if part > 0 && part + 1 < of.parts.len() {
            return self.cut_from((stretch, part));
        }
        let outer = &self.view.outer;
        let index = outer.partition_point(|cut| cut.parts[1] < (stretch, part));
        outer.get(index).cloned()
    }

    pub(super) fn is_jump(&self, part: PartAt) -> bool {
        let parts = self.stretches.get(part.0).map_or(&[][..], |of| &of.parts);
        let is_inner = part.1 > 0 && part.1 + 1 < parts.len();
        if is_inner && parts.get(part.1).is_some_and(|own| !own.may_be_jump) {
            return false;
        }
        self.cut_of_part(part).is_some_and(|cut| cut.is_jump)
    }

    /// Whether the cut that begins with a part continues the contour before it.
    pub(super) fn is_tab(&self, part: PartAt) -> bool {
        self.view.contours.is_tab(part)
    }

    pub(super) fn closes(&self, cut: &JoinedCut) -> bool {
        !self.view.contours.is_open(cut.parts[0])
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
        (first_stretch..last_stretch + 1).flat_map(move |stretch| {
            let from = if stretch == first_stretch {
                first.start
            } else {
                0
            };
            let all = self.entries_in(stretch).len();
            let to = if stretch == last_stretch {
                last.end
            } else {
                all
            };
            (from..to).map(move |entry| At { stretch, entry })
        })
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
        self.cut_of_part((at.stretch, self.part_of(at)))
    }

    /// The part of its stretch that an entry lies in.
    pub(super) fn part_of(&self, at: At) -> usize {
        self.stretches.get(at.stretch).map_or(0, |of| {
            of.parts
                .partition_point(|part| part.entries().end <= at.entry)
        })
    }
}

/// The index of the cut that begins at a part, which may have been elsewhere before the edit.
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
