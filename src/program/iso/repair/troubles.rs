//! The findings that one slip may explain.

use crate::finding::{Detail, Fault, Finding, Rule, Severity};
use crate::program::iso::document::Document;
use std::ops::Range;

/// The first bytes of these findings, in the order of the text.
pub(crate) struct Troubles<'a> {
    document: &'a Document,
    all: Vec<usize>,
    /// How many of them were handed out.
    handed: usize,
}

impl<'a> Troubles<'a> {
    /// Those of all findings, in the order of the text.
    pub(crate) fn of(document: &'a Document, findings: &[Finding]) -> Troubles<'a> {
        let findings = findings.iter().filter(|finding| is_trouble(finding));
        let places = findings.filter_map(|finding| finding.place.in_text());
        Troubles {
            document,
            all: places.map(|range| range.start).collect(),
            handed: 0,
        }
    }

    pub(super) fn next(&mut self) -> Option<usize> {
        self.handed += 1;
        self.all.get(self.handed - 1).copied()
    }

    /// Those in some lines.
    pub(crate) fn within(&self, lines: &Range<usize>) -> &[usize] {
        let text = self.document.text();
        let [first, behind] = [lines.start, lines.end]
            .map(|line| self.all.partition_point(|at| text.line_of(*at) < line));
        self.all.get(first..behind).unwrap_or_default()
    }
}

/// Whether one slip may explain a finding.
pub(crate) fn is_trouble(finding: &Finding) -> bool {
    may_be_slip(finding.rule, finding.severity, &finding.detail)
}

fn may_be_slip(rule: Rule, severity: Severity, detail: &Detail) -> bool {
    match rule {
        Rule::Syntax | Rule::NotClosed | Rule::MixedNumbers => severity <= Severity::Warning,
        Rule::TooManyDigits
        | Rule::ArcOffRadius
        | Rule::ArcWithoutRadius
        | Rule::PathCrossesItself
        | Rule::ReversedArc
        | Rule::CenterOnLine
        | Rule::WordTwice
        | Rule::Spur => true,
        Rule::DoubledBlock => !matches!(
            detail,
            Detail::Program(fault) if matches!(**fault, Fault::DoubledBlock { arc: false })
        ),
        _ => false,
    }
}

pub(crate) fn line_of(document: &Document, finding: &Finding) -> Option<usize> {
    let range = finding.place.in_text()?;
    Some(document.text().line_of(range.start))
}
