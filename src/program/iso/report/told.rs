//! All findings, with the blocks that may explain them.

use super::super::document::Document;
use super::super::repair::found::Repair;
use super::super::repair::{troubles, within};
use crate::finding::{Fault, Finding, FixKind, Rule, Severity};
use crate::program::report::{Report, Unmade};
use std::ops::Range;

impl Report for Document {
    fn each(&self, take: &mut dyn FnMut(&Unmade<'_>)) {
        let mut all = self.plain_findings();
        let troubles = troubles(&all);
        all.extend(suspects(self, &troubles));
        all.iter().for_each(|own| Unmade::hand_out(own, take));
    }
}

/// The blocks that may explain the findings by one slip, unless they have a finding already.
fn suspects(document: &Document, troubles: &[usize]) -> Vec<Finding> {
    let found = document.repairs_of(troubles);
    let is_said = |line: usize| !within(document, troubles, &(line..line + 1)).is_empty();
    let first = |(_, repairs): &(Range<usize>, Vec<Repair>)| repairs.first().cloned();
    let repairs = found.iter().filter_map(first);
    let suspect = |repair: Repair| {
        let range = document.words_of(repair.line);
        if repair.is_sure && repair.closes && matches!(repair.kind, FixKind::DeleteBlock) {
            return Finding::of(Fault::TwinKeepsOpen, range);
        }
        let fault = Fault::Suspect {
            found: repair.found,
            meant: repair.meant,
            closes: repair.closes,
        };
        let severity = match repair.is_sure {
            true => Rule::SuspectBlock.default_severity(),
            false => Severity::Information,
        };
        Finding::of(fault, range).with(severity)
    };
    repairs
        .filter(|repair| repair.explains && !repair.closes_anywhere() && !is_said(repair.line))
        .map(suspect)
        .collect()
}
