//! The findings about single cuts, kept from one edit to the next where they depend on the cut
//! alone; and all findings before they are worded.

use super::super::cut::JoinedCut;
use super::super::document::Document;
use super::super::repair::troubles;
use super::{Report, sort, suspects};
use crate::finding::Finding;
use crate::program::contours::PartAt;
use crate::program::of_cut::OfCut;
use crate::program::path::HasCuts;
use crate::program::report::{self, Found, place_of};
use std::ops::Range;

/// The source of a finding.
pub(in crate::program) enum Kept {
    Found(Finding),
    OfCut { index: usize },
}

impl report::Report for Document {
    type Kept = Kept;

    fn found(&self) -> impl Iterator<Item = Found<Kept>> {
        let mut others = self.report().finish();
        others.extend(suspects(self, &troubles(self, &others, self.told())));
        sort(&mut others);
        let found = |finding: Finding| Found {
            rule: finding.rule,
            severity: finding.severity,
            place: place_of(&finding),
            kept: Kept::Found(finding),
        };
        let of_cut = |(index, told): (usize, &OfCut)| {
            let Range { start, end } = told.range(self.chunks());
            Found {
                rule: told.rule,
                severity: told.severity,
                place: (start, end),
                kept: Kept::OfCut { index },
            }
        };
        let of_cuts = self.told().iter().enumerate().map(of_cut);
        others.into_iter().map(found).chain(of_cuts)
    }

    fn worded(&self, kept: Kept) -> Option<Finding> {
        match kept {
            Kept::Found(finding) => Some(finding),
            Kept::OfCut { index } => {
                let told = self.told().get(index)?;
                Some(told.finding(self.chunks(), self.text()))
            }
        }
    }

    fn plain(&self) -> Vec<Finding> {
        self.plain_findings()
    }
}

impl Document {
    /// Judges and marks the doubtful cuts that begin in a range, where the verdict depends on
    /// nothing else, and reports where cuts there cross themselves.
    pub(in crate::program::iso) fn tell(&mut self, places: Range<PartAt>) -> Vec<OfCut> {
        if self.order().is_some() {
            return Vec::new();
        }
        let mut alone = Vec::new();
        let mut report = Report::new(self);
        let first = self
            .doubtful()
            .partition_point(|cut| cut.begin() < places.start);
        let doubtful = self.doubtful().iter().enumerate().skip(first);
        let doubtful = doubtful.take_while(|(_, cut)| cut.begin() < places.end);
        let judged = doubtful.map(|(index, cut)| {
            if report.stands_alone(cut) {
                alone.push(index);
                report.judge(cut, &[]);
            }
            (cut.begin(), std::mem::take(&mut report.findings))
        });
        let kept = (self.chunks(), self.contours());
        let (told, asked) = OfCut::all(&*self, kept, places.clone(), judged, |_| true);
        #[cfg(test)]
        (self.judged = asked);
        #[cfg(not(test))]
        let _ = asked;
        for index in alone {
            self.doubtful_mut()[index].is_told = true;
        }
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
