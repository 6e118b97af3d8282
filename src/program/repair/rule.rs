//! Finds the one slip that explains the faults of a cut, and says when it is sure: one search for every language.
//!
//! A slip is a typing or transmission error at one place of the text. Each that is possible is undone, and *restores* where
//! nothing contradicts the cut any more: it closes, every block is sound by itself, stated coordinates and block numbers agree,
//! the wire neither runs back on itself nor crosses its own way. A repair is sure where nothing else explains the text:
//!
//! 1. Exactly one slip restores, and its own block is wrong by itself or contradicts what is stated. Where only the
//!    gap speaks, it must also do better by evidence than any lost line and any block too many.
//! 2. Of several, one does better than all others by the leads, by two joints, or by two kinds of evidence.
//! 3. None restores: what coordinates state is sure where a language says so.
//!
//! A language gives its slips and the pieces that they lead to; it knows nothing of evidence. All is bounded by counts, so that the
//! result depends on the text alone.

use super::beside::Beside;
use super::cut::{Against, Piece, SAME, are_alike, is_mirrored, lead};
use super::gap::fillings;
use super::slip::{Cut, Ends, Repair, Slip, Sort};
use super::weigh::{Candidate, JOINTS, LAST, NEARLY, Search};
use super::{HANDED_OUT, MOST_FOLLOWED};
use crate::geometry::{Point, Segment, Vector};
use crate::program::path::tolerance;
use rustc_hash::FxHashMap;

/// The most slips of a cut that are followed along all of it, and the most pieces that are read for them. Beyond them nothing is sure.
const FINALISTS: usize = 200;
const MOST_READ: usize = 200_000;

/// Changes of blocks this far apart may lead the same way, and lead as the others do beyond so many blocks.
const FARTHEST: usize = 8;

/// Where nothing is sure, no more slips are compared: a few are handed out.
const COMPARED: usize = 16 * HANDED_OUT;

/// The repairs of a cut, the most likely one first.
pub(in crate::program) fn search<C: Cut>(cut: &C) -> Vec<Repair<C::Meant>> {
    Search::of(cut).repairs()
}

impl<'a, C: Cut> Search<'a, C> {
    fn of(cut: &'a C) -> Search<'a, C> {
        let pieces = cut.pieces();
        let before = pieces.against();
        let arcs = pieces.all.iter().filter(|piece| piece.is_arc()).count();
        let mut radii = FxHashMap::default();
        for radius in pieces.all.iter().filter_map(Piece::radius) {
            *radii.entry(radius.round() as i64).or_insert(0) += 1;
        }
        let tolerance = tolerance(arcs + before.unread).max(pieces.writing.slack);
        let gaps = pieces.gaps();
        Search {
            cut,
            pieces,
            beside: Beside::of(pieces),
            before,
            ends: Ends {
                gaps: gaps.clone(),
                drift: pieces.drift(),
                within: tolerance + NEARLY,
                is_any: !before.is_open,
            },
            gaps,
            is_mirrored: is_mirrored(pieces.all.iter()),
            radii,
            tolerance,
            left: MOST_READ,
            is_complete: true,
            found: Vec::new(),
        }
    }

    fn repairs(mut self) -> Vec<Repair<C::Meant>> {
        let (cut, count) = (self.cut, self.pieces.all.len());
        for index in 0..count {
            if !self.may_be_wrong(index) {
                continue;
            }
            let slips = self.cut.slips(index, &self.ends);
            slips
                .into_iter()
                .chain(self.cut.deleted(index))
                .for_each(|slip| self.judge(slip));
        }
        for slip in (0..count).filter_map(|index| cut.exchanged(index)) {
            self.judge(slip);
        }
        if self.may_lack_a_block() {
            for index in 0..=count {
                self.insert_before(index);
            }
        }
        self.ranked()
    }

    /// Whether one slip in a piece may be all that is wrong.
    fn may_be_wrong(&self, index: usize) -> bool {
        let all = self.pieces.all.iter().skip(index);
        let mut reached = all.take(self.cut.reach(index));
        match self.before {
            Against { unread: 1.., .. } | Against { unsound: 1.., .. } => {
                reached.any(|own| own.is_unread || own.is_unsound)
            }
            Against { off: 1.., .. } => self.pieces.is_off(index),
            before => before.is_open || self.pieces.is_tangled,
        }
    }

    /// Whether a lost block may be all that is wrong.
    fn may_lack_a_block(&self) -> bool {
        let is_read = self.before.unread + self.before.unsound == 0;
        is_read && (self.before.is_open || self.before.off > 0)
    }

    /// Lines, and arcs, that fill the gap before a piece.
    fn insert_before(&mut self, index: usize) {
        let pieces = self.pieces;
        let total = self.gaps[0];
        let mut gaps = Vec::new();
        if let Some((from, to)) = pieces
            .stated_before(index)
            .zip(pieces.all.get(index).and_then(|piece| piece.stated))
            && pieces.is_off(index)
        {
            gaps.push(to.at - from.at - pieces.all[index].by);
        } else if self.before.is_open && self.before.off == 0 {
            gaps.push(total);
            if !self.is_mirrored {
                gaps.extend(self.gaps.get(1));
            }
        }
        let is_at_lead = self.is_mirrored && (index <= 1 || index + 1 >= pieces.all.len());
        let curve = |piece: Option<&Piece>| piece.and_then(|piece| piece.curve);
        let headings = curve(pieces.before(index)).zip(curve(pieces.all.get(index)));
        let headings = headings.filter(|_| !is_at_lead);
        let headings = headings.map(|(one, other)| [one.end_tangent(), other.start_tangent()]);
        for gap in gaps {
            let gap = Vector::new(gap.x.round(), gap.y.round());
            for way in fillings(gap, headings) {
                if let Some(slip) = self.cut.inserted(index, &way) {
                    self.judge(slip);
                }
            }
        }
        // The way out backwards.
        if index == 0
            && self.before.is_open
            && let Some(last) = pieces.all.last().filter(|last| !last.is_arc())
            && (last.by + self.gaps[0]).norm() > 0.0
            && (last.by + self.gaps[0]).norm() <= 2.0
        {
            let way = Segment::line(Point::origin(), Point::origin() - last.by);
            if let Some(slip) = self.cut.inserted(0, &way) {
                self.judge(slip);
            }
        }
    }

    /// Takes a slip that explains anything.
    fn judge(&mut self, mut slip: Slip<C::Meant>) {
        let (pieces, index) = (self.pieces, slip.change.index());
        let count = pieces.all.len();
        // What is calculated from the gap closes it: to find out again costs all of the cut.
        let is_calculated =
            slip.sort == Sort::Calculated && pieces.writing.names_places && slip.keys > 3;
        let closes_gap = matches!(slip.sort, Sort::Insertion | Sort::WayIn);
        let is_filled = closes_gap && self.before.is_open;
        let own = pieces
            .all
            .get(index..index + slip.count)
            .unwrap_or_default();
        let [is, was_by] = [&slip.pieces[..], own].map(|pieces| {
            let sum = |by: fn(&Piece) -> Vector| pieces.iter().map(by).sum::<Vector>();
            [sum(|piece| piece.by), sum(|piece| piece.machine)]
        });
        if self.before.is_open
            && !is_filled
            && !self.ends.may_be(is[0] - was_by[0], is[1] - was_by[1])
        {
            return;
        }
        let mut after = pieces.against_with(self.before, index, slip.count, &slip.pieces);
        let was = self.before.count();
        let worse = after.unread > self.before.unread
            || after.unsound > self.before.unsound
            || after.off > self.before.off;
        let is_tangled = was == 0 && (slip.sort == Sort::Exchange || pieces.is_tangled);
        if worse || (!self.before.is_open && after.count() >= was && !is_tangled) {
            return;
        }
        if slip.sort == Sort::Insertion && index == 0 && self.is_way_in(&slip.pieces) {
            slip.sort = Sort::WayIn;
        }
        let mut is_near = false;
        let is_open = self.before.is_open || after.unread < self.before.unread;
        if pieces.closes && after.unread == 0 {
            let is_known = is_filled || is_calculated && self.before.is_open;
            let read = if is_known { 0 } else { count };
            if self.left < read {
                self.is_complete = false;
                return;
            }
            self.left -= read;
            let all = || pieces.with(index, slip.count, &slip.pieces);
            after.is_open = !is_known && !pieces.is_closed(&all());
            if after.is_open && is_open {
                is_near = self.is_nearly_closed(&all());
            }
        }
        let is_restored = after.count() == 0 || (is_near && after.count() == 1);
        let is_reread = after.unread < self.before.unread;
        if is_reread && !is_restored && pieces.all[index].is_unread {
            // By its own content, where nothing tells its end.
            is_near = false;
        }
        let joints = pieces.joints_with(index, slip.count, &slip.pieces);
        let is_better = match slip.sort {
            // Where there is no other fault it must make the joints better.
            sort if was == 0 => {
                let is_better = match sort {
                    Sort::Exchange => joints.good >= 2,
                    _ => joints.good >= 1 || joints.doubled < 0,
                };
                after.count() == 0 && is_better && joints.doubled <= 0
            }
            Sort::Insertion | Sort::WayIn => after.count() == 0,
            _ => after.count() < was || is_near || (is_reread && after.count() <= was),
        };
        let is_stated = self.before.off > after.off;
        if !is_better || (joints.doubled > 0 && !is_stated && !is_reread) {
            return;
        }
        let home = -self.gaps[0] + is[0] - was_by[0];
        self.weigh(slip, after, joints, is_near, home);
    }

    fn ranked(mut self) -> Vec<Repair<C::Meant>> {
        // A lost block closes any gap: it must join better than a slip.
        let order = |one: &Candidate<C::Meant>| {
            let mut evidence = one.evidence;
            let closes_anywhere = one.slip.sort == Sort::Insertion && !one.is_wrong;
            evidence[JOINTS] += i32::from(closes_anywhere);
            (one.left, one.is_near, evidence, -one.smooth)
        };
        self.found
            .sort_by(|a, b| order(a).cmp(&order(b)).then(a.miss.total_cmp(&b.miss)));
        let least = self.found.first().map_or(0, |best| best.left);
        self.found.retain(|candidate| candidate.left == least);
        self.is_complete &= self.found.iter().filter(|one| one.is_text()).count() <= FINALISTS;
        if !self.is_complete {
            self.found.truncate(COMPARED);
        }
        self.drop_crossing();
        let mut kept = self.with_different_ways();
        let sure = match least {
            0 if self.is_complete => self.sure(&kept),
            _ => None,
        };
        if let Some(sure) = sure {
            let sure = kept.remove(sure);
            kept.insert(0, sure);
        }
        // A line along an axis runs back under the other quadrant, and may do so in 3B.
        let is_any_plain = self.pieces.writing.names_places && kept.iter().any(|one| !one.doubles);
        let offered = kept
            .into_iter()
            .filter(|one| !one.is_near && one.slip.sort != Sort::Deletion)
            .filter(|one| !(one.doubles && is_any_plain));
        let repair = |(nth, one): (usize, Candidate<C::Meant>)| Repair {
            change: one.slip.change,
            is_sure: nth == 0 && sure.is_some(),
            is_whole: one.left == 0,
        };
        offered.take(HANDED_OUT).enumerate().map(repair).collect()
    }

    /// Of slips with the same way the plainest stays.
    fn with_different_ways(&mut self) -> Vec<Candidate<C::Meant>> {
        let mut kept: Vec<Candidate<C::Meant>> = Vec::new();
        // The places among those that are kept of those that others are compared with.
        let mut known: Vec<usize> = Vec::new();
        for candidate in std::mem::take(&mut self.found) {
            let index = candidate.slip.change.index();
            let apart = |place: &usize| kept[*place].slip.change.index().abs_diff(index);
            // A block more or less leads the same way only beside the one that may be wrong.
            let is_beside = |place: &usize| apart(place) <= 1;
            if !candidate.is_text() && known.len() >= HANDED_OUT && !known.iter().any(is_beside) {
                kept.push(candidate);
                continue;
            }
            // Blocks farther apart that are changed lead differently, however often a line goes on.
            let about = known.iter().filter(|place| apart(place) <= FARTHEST);
            let is_one_way =
                |place: usize, within| self.are_one_way(&kept[place].slip, &candidate.slip, within);
            match about.copied().find(|place| is_one_way(*place, SAME)) {
                Some(place) => {
                    let is_equal = !candidate.is_text() || is_one_way(place, 1.0);
                    kept[place].has_double |= !is_equal;
                }
                None => {
                    known.push(kept.len());
                    kept.push(candidate);
                }
            }
        }
        kept
    }

    /// Whether two slips lead the same way.
    fn are_one_way(&self, one: &Slip<C::Meant>, other: &Slip<C::Meant>, within: f64) -> bool {
        let [(first, end), (its_first, its_end)] = [one, other].map(|slip| {
            let index = slip.change.index();
            (index, index + slip.count)
        });
        let part = first.min(its_first).saturating_sub(FARTHEST)
            ..(end.max(its_end) + FARTHEST).min(self.pieces.all.len());
        let [own, its] = [one, other].map(|slip| {
            let (index, part) = (slip.change.index(), part.clone());
            let all = self.pieces.part_with(part, index, slip.count, &slip.pieces);
            lead(&all)
        });
        are_alike(&own, &its, within)
    }

    /// Ways that cross themselves come last where the present one does, else they are none.
    fn drop_crossing(&mut self) {
        let mut left = MOST_FOLLOWED;
        let mut crosses = |pieces: &[Piece]| {
            let mut at = Vector::zeros();
            let curves: Vec<Segment> = pieces
                .iter()
                .filter_map(|piece| {
                    let own = piece.curve.map(|curve| curve.moved(at));
                    at += piece.by;
                    own
                })
                .collect();
            let arcs = pieces.iter().filter(|piece| piece.is_arc()).count();
            super::crosses_itself(&curves, arcs, &mut left)
        };
        let now = self.found.is_empty() || crosses(&self.pieces.all) == Some(true);
        let (mut kept, mut crossing) = (Vec::new(), Vec::new());
        let (mut insertions, mut calculated) = (0, 0);
        for candidate in std::mem::take(&mut self.found) {
            let many = match candidate.slip.sort {
                Sort::Insertion | Sort::Deletion => Some(&mut insertions),
                Sort::Calculated => Some(&mut calculated),
                _ => None,
            };
            if let Some(many) = many {
                *many += 1;
                if *many > 2 * HANDED_OUT {
                    kept.push(candidate);
                    continue;
                }
            }
            let slip = &candidate.slip;
            let all = self
                .pieces
                .with(slip.change.index(), slip.count, &slip.pieces);
            match crosses(&all) {
                Some(false) => kept.push(candidate),
                Some(true) if now && slip.sort != Sort::Exchange => crossing.push(candidate),
                Some(true) => {}
                None => {
                    self.is_complete = false;
                    break;
                }
            }
        }
        if kept.is_empty() {
            self.is_complete = false;
            kept = crossing;
        }
        self.found = kept;
    }

    /// The one that is sure, if any.
    fn sure(&self, all: &[Candidate<C::Meant>]) -> Option<usize> {
        let texts = || all.iter().enumerate().filter(|(_, one)| one.is_text());
        let whole = || texts().filter(|(_, one)| !one.is_near);
        let Some((nth, best)) = whole().next() else {
            // What coordinates state.
            return all
                .iter()
                .position(|one| one.slip.sort == Sort::Stated && !one.is_near);
        };
        let is_other = |(other, _): &(usize, &Candidate<C::Meant>)| *other != nth;
        let sort = best.slip.sort;
        let is_twin = sort == Sort::Twin;
        let is_never = best.parts_leads
            || self.before.count() == 0 && !best.turns_round && sort != Sort::Exchange
            || best.has_double && self.pieces.writing.names_places
            || best.must_fit && !best.fits()
            || sort == Sort::Kind && !best.speaks
            || !best.speaks && matches!(sort, Sort::Alike | Sort::Exchange);
        let beats_others = whole()
            .filter(is_other)
            .all(|(_, other)| best.beats_clearly(other));
        let is_elsewhere =
            |one: &Candidate<C::Meant>| one.slip.change.index() != best.slip.change.index();
        let mut near = texts().filter(|(_, one)| one.is_near && is_elsewhere(one));
        let beats_near = near.all(|(_, other)| best.beats(other));
        let is_blocker = |one: &&Candidate<C::Meant>| match one.slip.sort {
            Sort::Insertion => !one.slip.pieces.iter().any(Piece::is_arc),
            sort => sort == Sort::Deletion,
        };
        let mut blockers = all.iter().filter(is_blocker);
        // A line along an axis between two places that are stated may be lost as well.
        let is_beside = |other: &Candidate<C::Meant>| {
            other
                .slip
                .pieces
                .iter()
                .any(|piece| piece.by.x == 0.0 || piece.by.y == 0.0)
                && other.evidence[..LAST] <= best.evidence[..LAST]
        };
        let beats_blockers = match (best.is_wrong || is_twin, best.speaks) {
            (true, _) => true,
            (_, true) => sort != Sort::Key || !blockers.any(is_beside),
            _ => blockers.all(|other| best.beats(other)),
        };
        // A number that is calculated, or a line before the arc, puts it on its circle as well.
        let mut calculated = all.iter().filter(|one| {
            matches!(one.slip.sort, Sort::Calculated | Sort::Insertion) && !one.is_near
        });
        let beats_calculated = !best.must_fit || calculated.all(|other| best.beats_clearly(other));
        let is_sure = beats_others && beats_near && beats_blockers && beats_calculated;
        (!is_never && is_sure).then_some(nth)
    }
}
