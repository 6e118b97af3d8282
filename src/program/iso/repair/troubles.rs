//! The findings that one slip may explain.

use crate::finding::{Detail, Fault, Finding, Rule, Severity};
use crate::program::iso::document::Document;
use crate::program::work::{self, Work};
use std::ops::Range;

/// The first bytes of these findings, in the order of the text. Of very many only those are looked up that are asked for.
pub(crate) struct Troubles<'a> {
    document: &'a Document,
    known: Vec<usize>,
    /// How many were handed out.
    handed: usize,
    rest: Box<dyn Iterator<Item = usize> + 'a>,
}

impl<'a> Troubles<'a> {
    /// Those among some findings, and among what is kept of cuts.
    pub(crate) fn of(document: &'a Document, findings: &[Finding]) -> Troubles<'a> {
        let findings = findings.iter().filter(|one| is_trouble(one));
        let findings = findings.filter_map(|one| Some(one.place.in_text()?.start));
        let mut findings: Vec<usize> = findings.collect();
        findings.sort_unstable();
        // Cuts follow each other, and what is found of one stands in it.
        let of_chunk = move |chunk: usize| {
            let all = document.told.of(chunk).iter();
            let own = all.filter(|one| may_be_slip(one.rule, one.severity, &one.detail));
            let mut own: Vec<usize> = own
                .map(|one| one.range(|chunk| document.byte_of(chunk)).start)
                .collect();
            own.sort_unstable();
            own
        };
        let told = (0..document.told.len()).flat_map(of_chunk);
        let (mut findings, mut told) = (findings.into_iter().peekable(), told.peekable());
        let next = move || {
            work::add(Work::Troubles, 1);
            match (findings.peek(), told.peek()) {
                (Some(finding), Some(told_at)) if told_at < finding => told.next(),
                (Some(_), _) => findings.next(),
                (None, _) => told.next(),
            }
        };
        Troubles {
            document,
            known: Vec::new(),
            handed: 0,
            rest: Box::new(std::iter::from_fn(next)),
        }
    }

    pub(super) fn next(&mut self) -> Option<usize> {
        if self.handed == self.known.len() {
            self.known.push(self.rest.next()?);
        }
        self.handed += 1;
        self.known.get(self.handed - 1).copied()
    }

    /// Those in some lines.
    pub(crate) fn within(&mut self, lines: &Range<usize>) -> &[usize] {
        let text = self.document.text();
        let is_before = |at: usize, line: usize| text.line_of(at) < line;
        while self
            .known
            .last()
            .is_none_or(|last| is_before(*last, lines.end))
            && let Some(next) = self.rest.next()
        {
            self.known.push(next);
        }
        let [first, behind] = [lines.start, lines.end]
            .map(|line| self.known.partition_point(|known| is_before(*known, line)));
        self.known.get(first..behind).unwrap_or_default()
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
