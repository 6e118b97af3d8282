//! What an electrode cannot mill of a drawing that a wire is set for, too.

use super::Analysis;
use crate::drawing::Drawing;
use crate::finding::{Detail, Finding, Severity, Telling, sentence};
use crate::rule::Rule;
use crate::settings::Effective;
use std::sync::Arc;

/// In drawings of more segments this is only said when a program for the electrode is asked for.
const MOST_SEGMENTS: usize = 2_000;

/// The settings of the electrode, where the findings are those for a wire.
pub(super) fn beside_wire(settings: &Effective) -> Option<Effective> {
    match settings.mills {
        true => None,
        false => settings.milled().ok(),
    }
}

/// The errors of the drawing that are due to the electrode's size, as faults of its settings: programs for the wire may be made.
pub(super) fn faults(drawing: &Drawing, segments: usize, settings: &Effective) -> Vec<Finding> {
    if segments > MOST_SEGMENTS {
        return Vec::new();
    }
    let Some(milled) = beside_wire(settings) else {
        return Vec::new();
    };
    let telling = Telling {
        unit_mm: milled.unit_of(drawing).mm,
        mills: true,
    };
    let severity = milled.severity_over(Rule::Settings, Severity::Error);
    let (found, _) = Analysis::new(drawing, Arc::new(milled)).findings(drawing, usize::MAX);
    let is_of_size = |found: &Finding| {
        found.severity == Severity::Error
            && matches!(
                found.rule,
                Rule::SmallRadius | Rule::NarrowSlot | Rule::OffsetCollapse | Rule::LostPocket
            )
    };
    let said = |found: Finding| {
        let detail = Detail::Said(say!(for_milling, sentence(&found, telling)));
        Some(Finding {
            rule: Rule::Settings,
            severity: severity?,
            detail,
            ..found
        })
    };
    found
        .into_iter()
        .filter(is_of_size)
        .filter_map(said)
        .collect()
}
