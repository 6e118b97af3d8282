//! The findings about open contours, and the searches for the slips behind them: each is repeated only where something has
//! changed that it looks at.

use super::super::repair::{Change, FEWEST_BLAMED, Number, Repair, Slip};
use super::super::rules::Spot;
use super::Document;
use super::contours::OneContour;
use crate::finding::{Fault, Finding, Rule};
use crate::program::contours::Divided;
use crate::program::numbering;
use crate::program::steps::Program;
use crate::toolpath::each;
use rustc_hash::FxHasher;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// The search for a block to blame looks at this many cuts on either side of a contour at most: at its stops, and at the
/// cuts beside it.
const CUTS_ABOUT: usize = 24;

/// Searches that one core makes at a time.
const FEW_SEARCHES: usize = 16;

/// One slip has at most this many faults.
const MOST_ERRORS: usize = 6;

/// What a search for the slip of a contour has found.
#[derive(Debug)]
pub(super) struct Found {
    /// How many cuts before the contour were searched with it, since they are open, too; and how many behind it.
    before: usize,
    behind: usize,
    pub(super) repairs: Vec<Repair>,
}

impl Found {
    /// The cuts that were searched.
    pub(super) fn cuts(&self, contour: &OneContour) -> OneContour {
        contour.start - self.before..contour.end + self.behind
    }
}

impl Document {
    /// What a search may see of each cut from beside it.
    pub(super) fn marks(&self) -> Vec<u64> {
        let mark = |cut: usize| 2 * self.id(cut) + u64::from(self.is_open(cut));
        (0..self.cut_count()).map(mark).collect()
    }

    /// Judges the contours that do not close.
    pub(super) fn judge_contours(&self, findings: &mut Vec<Finding>) {
        let mut searched: Vec<OneContour> = Vec::new();
        for cut in (0..self.cut_count()).filter(|cut| self.is_open(*cut)) {
            let contour = cut..cut + 1;
            let own = &self.cuts[cut];
            let ends = own.verdict().ends;
            let is_fragment = self.view.end.is_none() || ends.is_fragment();
            if own.rare().unread > 0 || (is_fragment && self.leads_out(cut)) {
                continue;
            }
            if let Some(last) = self.blocks_of(&contour).next_back() {
                findings.push(ends.not_closed_at(self.range_of(last), is_fragment));
            }
            let may_be_one_field = own.rare().errors == 0 && own.blocks as usize >= FEWEST_BLAMED;
            if may_be_one_field && !is_fragment && !self.lacks_a_number(&contour) {
                searched.push(contour);
            }
        }
        let blamed = each(searched.len(), FEW_SEARCHES, |nth| {
            self.blame(&searched[nth])
        });
        findings.extend(blamed.into_iter().flatten());
    }

    /// The slips that may be behind the faults of a contour, the most likely one first.
    pub(super) fn found(&self, contour: &OneContour) -> Arc<Found> {
        let search = || Arc::new(self.search(contour));
        let searches = &self.view.searches;
        searches.found(self.mark_of_search(contour), search)
    }

    fn search(&self, contour: &OneContour) -> Found {
        let found = |cuts: &OneContour, repairs| Found {
            before: contour.start - cuts.start,
            behind: cuts.end - contour.end,
            repairs,
        };
        if self.errors(contour) > MOST_ERRORS {
            return found(contour, Vec::new());
        }
        let Some(whole) = self.with_open_beside(contour) else {
            return found(contour, self.repairs(contour));
        };
        // A single slip may leave both open; of two slips nothing says in which of the two each is.
        let mut repairs = self.repairs(&whole);
        repairs.retain(|repair| repair.is_whole);
        if !repairs.is_empty() {
            return found(&whole, repairs);
        }
        let mut repairs = self.repairs(contour);
        repairs.iter_mut().for_each(|repair| repair.is_sure = false);
        found(contour, repairs)
    }

    /// A mark of all that a search looks at: the cuts about it, and what is known at its beginning.
    fn mark_of_search(&self, cuts: &OneContour) -> u64 {
        let mut hasher = FxHasher::default();
        let marks = &self.view.marks;
        let end = (cuts.end + CUTS_ABOUT).min(marks.len());
        marks[cuts.start.saturating_sub(CUTS_ABOUT)..end].hash(&mut hasher);
        let numbers = &self.view.numbers;
        (
            marks[cuts.start],
            cuts.len(),
            numbers.before[cuts.start],
            numbers.step,
        )
            .hash(&mut hasher);
        let first = self.blocks_of(cuts).next();
        let stated = first.and_then(|first| self.stated_begin(first));
        let stated = stated.map(|stated| (stated.at.map(f64::to_bits), stated.decimals));
        stated.hash(&mut hasher);
        hasher.finish()
    }

    /// True for the way back to the thread hole, after a stop at the end of a closed contour.
    fn leads_out(&self, cut: usize) -> bool {
        let Some(before) = cut.checked_sub(1).filter(|before| !self.is_jump(*before)) else {
            return false;
        };
        let before = self.ends_of(&self.view.contours.cuts_of(before));
        before.then(&self.cuts[cut].verdict().ends).returns()
    }

    /// The finding of the block that keeps a contour open, where no other repair is as likely.
    fn blame(&self, contour: &OneContour) -> Option<Finding> {
        let found = self.found(contour);
        let cuts = found.cuts(contour);
        let whole = self.with_open_beside(contour);
        if cuts != whole.unwrap_or_else(|| contour.clone()) {
            return None;
        }
        let is_of_blocks = |repair: &&Repair| {
            !matches!(
                repair.change,
                Change::Insert { .. } | Change::Exchange { .. }
            )
        };
        let mut repairs = found.repairs.iter().filter(is_of_blocks);
        let best = repairs.next().filter(|best| best.is_whole)?;
        let at = self.blocks_of(&cuts).nth(best.change.index())?;
        let (block, slip) = match &best.change {
            Change::Replace { meant, .. } => meant,
            _ if best.is_sure && contour.contains(&at.cut) => {
                return Some(Finding::of(Fault::TwinKeepsOpen, self.range_of(at)));
            }
            _ => return None,
        };
        // One field of another block would do as well.
        let is_field =
            |slip: &Slip| matches!(slip, Slip::Motion | Slip::Axis | Slip::Number(Number::J));
        let is_rival = |other: &Repair| match &other.change {
            Change::Replace { meant, .. } => other.is_whole && is_field(&meant.1),
            _ => false,
        };
        let is_plain = best.is_sure || is_field(slip) && !repairs.any(is_rival);
        let both = [&self.entry(at)?.block()?.block(), block];
        let (spot, rule) = match slip {
            Slip::Motion => (Spot::Motion, Rule::WrongQuadrant),
            Slip::Axis => (Spot::Axis, Rule::WrongCountingAxis),
            Slip::Number(Number::J) => (Spot::J, Rule::WrongJ),
            Slip::Number(Number::X) => (Spot::X, Rule::SuspectBlock),
            Slip::Number(Number::Y) => (Spot::Y, Rule::SuspectBlock),
            Slip::Exchanged([Number::X, Number::Y]) => (Spot::Block, Rule::SuspectBlock),
            Slip::Coordinates | Slip::Unread | Slip::Exchanged(_) => return None,
        };
        let numbers = match slip {
            Slip::Number(number) => Some(both.map(|block| number.of(block))),
            _ => None,
        };
        let [found, meant] = match (slip, numbers) {
            (Slip::Number(number), Some(both)) => both.map(|own| format!("{number:?} {own}")),
            (Slip::Axis, _) => both.map(|block| format!("G{}", block.axis.letter())),
            _ => both.map(|block| block.motion.name().to_owned()),
        };
        let fault = match slip {
            Slip::Exchanged(_) => Fault::ExchangedKeepsOpen,
            _ => Fault::FieldKeepsOpen {
                rule,
                found,
                meant,
                numbers,
                is_sure: best.is_sure,
            },
        };
        let range = self.spot_range(spot, self.range_of(at));
        (is_plain && contour.contains(&at.cut)).then(|| Finding::of(fault, range))
    }

    /// Whether the numbers of a cut have a gap: a block is lost then.
    fn lacks_a_number(&self, cuts: &OneContour) -> bool {
        let blocks = self.blocks_of(cuts);
        let numbers: Vec<u32> = blocks.filter_map(|at| self.entry(at)?.number()).collect();
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
