//! The findings about open contours. The search for the block to blame is repeated only where something has changed that
//! it looks at.

use super::super::repair::FEWEST_BLAMED;
use super::super::rules;
use super::Document;
use super::contours::OneContour;
use crate::finding::{Axis, Fault, Finding};
use crate::program::contours::Divided;
use crate::program::numbering;
use crate::program::steps::Program;
use crate::toolpath::each;
use rustc_hash::{FxHashMap, FxHasher};
use std::hash::{Hash, Hasher};

/// The search for a block to blame looks at this many cuts on either side of a contour at most: at its stops, and at the
/// cuts beside it.
const CUTS_ABOUT: usize = 24;

/// Searches that one core makes at a time.
const FEW_SEARCHES: usize = 16;

/// The block to blame in an open contour, by its number in there, for each mark of what the search looks at.
pub(super) type Blamed = FxHashMap<u64, Option<Box<(usize, Fault)>>>;

impl Document {
    /// Judges the contours that do not close; the results of some searches are `known`.
    pub(super) fn judge_contours(&mut self, mut known: Blamed, findings: &mut Vec<Finding>) {
        let open = (0..self.cut_count()).filter(|cut| self.is_open(*cut));
        let mark = |cut: usize| 2 * self.id(cut) + u64::from(self.is_open(cut));
        let marks: Vec<u64> = (0..self.cut_count()).map(mark).collect();
        let mut searched: Vec<(OneContour, u64)> = Vec::new();
        for cut in open {
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
                let mark = self.mark_of_search(&contour, &marks);
                searched.push((contour, mark));
            }
        }
        let is_new = |(_, mark): &&(OneContour, u64)| !known.contains_key(mark);
        let mut unknown: Vec<&(OneContour, u64)> = searched.iter().filter(is_new).collect();
        unknown.sort_by_key(|(_, mark)| *mark);
        unknown.dedup_by_key(|(_, mark)| *mark);
        let blamed = each(unknown.len(), FEW_SEARCHES, |nth| {
            let (cuts, mark) = unknown[nth];
            let whole = self.with_open_beside(cuts);
            let blamed = self.blamed(cuts, whole.as_ref().unwrap_or(cuts));
            (*mark, blamed.map(Box::new))
        });
        known.extend(blamed);
        let mut kept = Blamed::default();
        for (cuts, mark) in &searched {
            let Some(blamed) = known.get(mark) else {
                continue;
            };
            findings.extend(blamed.as_ref().and_then(|blamed| self.blame(cuts, blamed)));
            kept.insert(*mark, blamed.clone());
        }
        self.view.blamed = kept;
    }

    /// A mark of all that the search for a block to blame looks at: the cuts about it, by the `marks` of all, and what is
    /// known at its beginning.
    fn mark_of_search(&self, cuts: &OneContour, marks: &[u64]) -> u64 {
        let mut hasher = FxHasher::default();
        let end = (cuts.end + CUTS_ABOUT).min(marks.len());
        marks[cuts.start.saturating_sub(CUTS_ABOUT)..end].hash(&mut hasher);
        let numbers = &self.view.numbers;
        (marks[cuts.start], numbers.before[cuts.start], numbers.step).hash(&mut hasher);
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

    /// The finding of the block to blame.
    fn blame(&self, cuts: &OneContour, (nth, fault): &(usize, Fault)) -> Option<Finding> {
        let at = self.blocks_of(cuts).nth(*nth)?;
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
