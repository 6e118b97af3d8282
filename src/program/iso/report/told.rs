//! All findings before they are worded.

use super::super::document::Document;
use super::super::repair::Troubles;
use super::suspects;
use crate::finding::Finding;
use crate::program::report::{Found, Report, place_of};

impl Report for Document {
    type Source = Finding;

    fn found(&self) -> impl Iterator<Item = Found<Finding>> {
        let mut all = self.report().finish();
        let mut troubles = Troubles::of(self, &all);
        all.extend(suspects(self, &mut troubles));
        all.into_iter().map(|finding| Found {
            rule: finding.rule,
            severity: finding.severity,
            place: place_of(&finding),
            source: finding,
        })
    }

    fn worded(&self, source: Finding) -> Option<Finding> {
        Some(source)
    }

    fn plain(&self) -> Vec<Finding> {
        self.plain_findings()
    }
}
