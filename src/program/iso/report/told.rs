//! The findings about single cuts, kept from one edit to the next where they depend on the cut
//! alone; and all findings before they are worded.

use super::super::cut::JoinedCut;
use super::super::document::Document;
use super::super::repair::Troubles;
use super::{Report, suspects};
use crate::finding::Finding;
use crate::program::by_chunk::{Begun, ByChunk};
use crate::program::contours::PartAt;
use crate::program::of_cut::OfCut;
use crate::program::path::HasCuts;
use crate::program::report::{self, Found, Source, place_of};
use std::ops::Range;

impl report::Report for Document {
    type Own = Finding;

    fn byte_of(&self, chunk: usize) -> usize {
        self.stretches.byte(chunk)
    }

    fn of_cuts(&self) -> &ByChunk<OfCut> {
        &self.told
    }

    /// Those that are not kept.
    fn own_groups(&self) -> usize {
        1
    }

    fn own_in(&self, _: usize) -> impl Iterator<Item = Found<Source<Finding>>> {
        let mut others = self.report().finish();
        let mut troubles = Troubles::of(self, &others);
        others.extend(suspects(self, &mut troubles));
        others.into_iter().map(|finding| Found {
            rule: finding.rule,
            severity: finding.severity,
            place: place_of(&finding),
            source: Source::Own(finding),
        })
    }

    fn own_worded(&self, own: Finding) -> Option<Finding> {
        Some(own)
    }

    fn plain(&self) -> Vec<Finding> {
        self.plain_findings()
    }
}

impl Document {
    /// Judges and marks the `doubtful` cuts that begin in a range, where the verdict depends on
    /// nothing else, and reports where cuts there cross themselves.
    pub(in crate::program::iso) fn tell(
        &self,
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
        let kept = (&self.stretches, &self.contours);
        OfCut::all(self, kept, places, judged, |_| true)
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
