//! All safe fixes of a document, until none is left.

use super::Watch;
use crate::document::{Document, Source};
use crate::drawing::{Drawing, DrawingEdit};
use crate::finding::{Edit, Finding, Rule, Severity};
use crate::text::{Patch, TextEdit};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Repairs in several rounds, since one may make room for another.
#[derive(Debug)]
pub(crate) enum Repairs {
    /// For a text, as one edit of its present state; and the document after the repairs.
    OfText {
        edits: Vec<TextEdit>,
        rounds: usize,
        repaired: Box<Document>,
    },
    /// For a drawing without text, each with the drawing that it applies to; and the document after the repairs.
    OfDrawing {
        rounds: Vec<(Arc<Drawing>, DrawingEdit)>,
        repaired: Box<Document>,
    },
}

/// What repairs have done, in findings.
pub(crate) struct Outcome {
    pub(crate) repaired: usize,
    /// Errors and warnings.
    pub(crate) left: usize,
}

/// The rules of drawings whose findings are repaired without being asked for.
pub(crate) const REPAIRED: [Rule; 6] = [
    Rule::SmallRadius,
    Rule::DuplicateEntity,
    Rule::Overlap,
    Rule::ShortSegment,
    Rule::Gap,
    Rule::ArcAsChords,
];

impl Outcome {
    /// Of repairs that made one document of the other. By rule, since a repair may bring hidden faults to light.
    pub(crate) fn of(before: &Document, after: &Document) -> Outcome {
        let is_heavy = |it: &&Finding| it.severity <= Severity::Warning;
        let counts = |document: &Document| {
            let findings = document.all_findings();
            let own = findings.iter();
            let own = own.filter(|it| is_heavy(it) || REPAIRED.contains(&it.rule));
            let mut counts: BTreeMap<Rule, usize> = BTreeMap::new();
            own.for_each(|finding| *counts.entry(finding.rule).or_default() += 1);
            (counts, findings.iter().filter(is_heavy).count())
        };
        let ((before, _), (after, left)) = (counts(before), counts(after));
        let less = |(rule, count): (&Rule, &usize)| {
            count.saturating_sub(after.get(rule).copied().unwrap_or_default())
        };
        let repaired = before.iter().map(less).sum::<usize>().max(1);
        Outcome { repaired, left }
    }

    /// For people.
    pub(crate) fn said(&self) -> String {
        let repaired = say!(findings, self.repaired);
        match self.left {
            0 => say!(repaired_and_none_left, repaired),
            left => say!(repaired_and_left, repaired, left),
        }
    }
}

/// At most this many rounds. Each leaves less to repair than the one before, so that they end by themselves long before.
pub const ROUNDS: usize = 100;

/// Every safe fix, repeated until none is left that repairs anything. After each round it says what part of the findings is repaired.
pub(crate) fn fix_all(document: &Document, watch: &dyn Watch) -> Option<Repairs> {
    let findings = document.all_findings().len();
    let tell = |present: &Document| {
        let repaired = findings.saturating_sub(present.all_findings().len());
        watch.at(say!(looking_for_fixes), Some((repaired, findings)));
    };
    if let Source::Cad(_) = document.source() {
        let mut present = document.clone();
        let mut rounds = Vec::new();
        let next = |present: &Document| {
            let Some(Edit::Drawing(edit)) = present.fix_all() else {
                return None;
            };
            let before = present.drawing()?.clone();
            let mut repaired = present.clone();
            let made = repaired.edit_drawing(|drawing| drawing.apply(&edit));
            let is_less = || repaired.left_to_repair() < present.left_to_repair();
            (matches!(made, Some(Ok(()))) && is_less()).then_some((repaired, before, edit))
        };
        while rounds.len() < ROUNDS
            && watch.is_wanted()
            && let Some((repaired, before, edit)) = next(&present)
        {
            tell(&repaired);
            rounds.push((before, edit));
            present = repaired;
        }
        let repaired = Box::new(present);
        return (!rounds.is_empty()).then_some(Repairs::OfDrawing { rounds, repaired });
    }
    let mut patch = Patch::of(document.text()?.len());
    let mut repaired = None;
    let mut rounds = 0;
    while rounds < ROUNDS
        && watch.is_wanted()
        && let present = repaired.as_ref().unwrap_or(document)
        && let Some((edits, after)) = present.round()
        && let Some(longer) = patch.then(&edits)
    {
        tell(&after);
        rounds += 1;
        patch = longer;
        repaired = Some(after);
    }
    Some(Repairs::OfText {
        edits: patch.edits(),
        rounds,
        repaired: Box::new(repaired?),
    })
}

#[cfg(test)]
mod tests;
