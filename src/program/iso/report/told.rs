//! The findings about single cuts, kept from one edit to the next where they depend on the cut
//! alone; and all findings before they are worded.

use super::super::cut::JoinedCut;
use super::super::document::Document;
use super::super::repair::Troubles;
use super::{Report, sort, suspects};
use crate::finding::Finding;
use crate::program::by_chunk::Begun;
use crate::program::contours::PartAt;
use crate::program::of_cut::OfCut;
use crate::program::path::HasCuts;
use crate::program::report::{self, Counted, Found, place_of};
use std::ops::Range;

/// The source of a finding.
pub(in crate::program) enum Kept {
    Found(Finding),
    OfCut { stretch: usize, index: usize },
}

impl report::Report for Document {
    type Kept = Kept;

    /// Those that are not kept, and those of the cuts that begin in each stretch.
    fn groups(&self) -> usize {
        1 + self.told().len()
    }

    fn tally(&self, group: usize) -> Option<(usize, &[Counted])> {
        let tally = self.told().sum(group.checked_sub(1)?)?;
        Some(tally.told(self.chunks()))
    }

    fn found_in(&self, group: usize) -> impl Iterator<Item = Found<Kept>> {
        let not_kept = || {
            let mut others = self.report().finish();
            let mut troubles = Troubles::of(self, &others, Some(self.told()));
            others.extend(suspects(self, &mut troubles));
            sort(&mut others);
            others
        };
        let others = (group == 0).then(not_kept).into_iter().flatten();
        let others = others.map(|finding: Finding| Found {
            rule: finding.rule,
            severity: finding.severity,
            place: place_of(&finding),
            kept: Kept::Found(finding),
        });
        let stretch = group.wrapping_sub(1);
        let of_cuts = self.told().of(stretch).iter().enumerate();
        others.chain(of_cuts.map(move |(index, told)| {
            let Range { start, end } = told.range(self.chunks());
            Found {
                rule: told.rule,
                severity: told.severity,
                place: (start, end),
                kept: Kept::OfCut { stretch, index },
            }
        }))
    }

    fn worded(&self, kept: Kept) -> Option<Finding> {
        match kept {
            Kept::Found(finding) => Some(finding),
            Kept::OfCut { stretch, index } => {
                let told = self.told().of(stretch).get(index)?;
                Some(told.finding(self.chunks(), self.text()))
            }
        }
    }

    fn plain(&self) -> Vec<Finding> {
        self.plain_findings()
    }
}

impl Document {
    /// How many findings are looked up to find the slips that explain them.
    #[cfg(test)]
    pub(in crate::program) fn troubles_looked_up(&self) -> usize {
        let others = self.report().finish();
        let mut troubles = Troubles::of(self, &others, Some(self.told()));
        let mut fresh = self.clone();
        fresh.repairs = Default::default();
        suspects(&fresh, &mut troubles);
        troubles.looked_up()
    }

    /// Judges and marks the `doubtful` cuts that begin in a range, where the verdict depends on
    /// nothing else, and reports where cuts there cross themselves.
    pub(in crate::program::iso) fn tell(
        &mut self,
        places: Range<PartAt>,
        doubtful: &mut [JoinedCut],
    ) -> Vec<OfCut> {
        if self.order().is_some() {
            return Vec::new();
        }
        let mut report = Report::new(self);
        let judged = doubtful.iter_mut().map(|cut| {
            cut.is_told = report.stands_alone(cut);
            if cut.is_told {
                report.judge(cut, None);
            }
            (cut.begin(), std::mem::take(&mut report.findings))
        });
        let kept = (self.chunks(), self.contours());
        let (told, asked) = OfCut::all(self, kept, places, judged, |_| true);
        #[cfg(test)]
        (self.judged = asked);
        #[cfg(not(test))]
        let _ = asked;
        told
    }
}

impl Report<'_> {
    /// Whether the findings about a cut depend on it alone: it is open, and the wire stays on one
    /// side. Otherwise sides are compared with those of neighbouring cuts and with the words before
    /// them, and arcs are reported at their place.
    fn stands_alone(&self, cut: &JoinedCut) -> bool {
        !self.document.is_closed(cut) && cut.flip.is_none() && self.tight_of(cut).is_empty()
    }
}
