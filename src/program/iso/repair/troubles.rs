//! The findings that one slip may explain.

use crate::finding::{Detail, Fault, Finding, Rule, Severity};
use crate::program::iso::document::Document;
use std::ops::Range;

/// The first bytes of those among findings in the order of the text.
pub(in crate::program::iso) fn troubles(findings: &[Finding]) -> Vec<usize> {
    let troubles = findings.iter().filter(|finding| is_trouble(finding));
    let places = troubles.filter_map(|finding| finding.place.in_text());
    places.map(|range| range.start).collect()
}

/// Those in some lines.
pub(in crate::program::iso) fn within<'a>(
    document: &Document,
    troubles: &'a [usize],
    lines: &Range<usize>,
) -> &'a [usize] {
    let text = document.text();
    let [first, behind] = [lines.start, lines.end]
        .map(|line| troubles.partition_point(|at| text.line_of(*at) < line));
    troubles.get(first..behind).unwrap_or_default()
}

/// Whether one slip may explain a finding.
pub(in crate::program::iso) fn is_trouble(finding: &Finding) -> bool {
    match finding.rule {
        Rule::Syntax | Rule::NotClosed | Rule::MixedNumbers => {
            finding.severity <= Severity::Warning
        }
        Rule::TooManyDigits
        | Rule::ArcOffRadius
        | Rule::ArcWithoutRadius
        | Rule::PathCrossesItself
        | Rule::ReversedArc
        | Rule::CenterOnLine
        | Rule::WordTwice
        | Rule::Spur => true,
        Rule::DoubledBlock => !matches!(
            &finding.detail,
            Detail::Program(fault) if matches!(**fault, Fault::DoubledBlock { arc: false })
        ),
        _ => false,
    }
}
