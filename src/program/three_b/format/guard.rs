//! A layout never changes what is found in a program: end points and block numbers come and go with it only where
//! they are no evidence.

use super::{Ends, format, layout_of};
use crate::finding::{Finding, Rule};
use crate::program::three_b::Document;
use crate::settings::{Effective, Layout};
use crate::text::{TextEdit, edited};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Up to this many edits are made in a copy of the document; with more, their text is read anew.
const FEW_EDITS: usize = 8;

/// The edits that bring lines into a layout.
pub(crate) struct Formatted {
    pub(crate) edits: Vec<TextEdit>,
    pub(crate) kept: Option<Reason>,
}

/// Why end points and block numbers stay as they stand: a finding that would go or come with them, or that says that
/// they would be worked out from wrong blocks.
pub(crate) struct Reason {
    pub(crate) rule: Rule,
    /// From 0.
    pub(crate) line: usize,
}

/// The edits that bring `lines` into a layout, sorted and disjoint; without a layout, into that of most blocks. As many
/// findings of each rule are made afterwards as before.
pub(crate) fn guarded(
    document: &Document,
    settings: &Effective,
    layout: Option<Layout>,
    lines: Range<usize>,
) -> Formatted {
    let (text, words) = (document.text(), document.words());
    let layout = layout.unwrap_or_else(|| layout_of(text, &words));
    let laid = |ends| format(text, layout, ends, &words, lines.clone());
    let edits = laid(Ends::OfLayout);
    let before = document.findings();
    let adds = layout == Layout::Checking;
    let is_sound = before.is_empty() && (adds || !document.states_ends());
    let changed_by = |edits: &[TextEdit]| {
        let after = findings_after(document, settings, edits);
        changed(&before, &after).cloned()
    };
    let reason = if edits.is_empty() || is_sound {
        None
    } else {
        let is_doubtful = |finding: &&Finding| tells_of_wrong_ends(finding.rule);
        let doubtful = before.iter().find(is_doubtful).filter(|_| adds).cloned();
        doubtful.or_else(|| changed_by(&edits))
    };
    let kept = reason.map(|reason| (reason, laid(Ends::Kept)));
    let Some((reason, mut kept)) = kept.filter(|(_, kept)| *kept != edits) else {
        return Formatted { edits, kept: None };
    };
    if changed_by(&kept).is_some() {
        kept.clear();
    }
    let place = reason.place.in_text();
    let line = place.map_or(0, |range| text.line_of(range.start.min(text.len())));
    let rule = reason.rule;
    Formatted {
        edits: kept,
        kept: Some(Reason { rule, line }),
    }
}

/// True for rules by which the numbers of a block are wrong, and with them its end.
fn tells_of_wrong_ends(rule: Rule) -> bool {
    matches!(
        rule,
        Rule::WrongQuadrant
            | Rule::WrongJ
            | Rule::WrongCountingAxis
            | Rule::LengthInJ
            | Rule::JOverTurn
            | Rule::ArcOffRadius
            | Rule::ArcWithoutRadius
            | Rule::ReversedArc
            | Rule::SuspectBlock
            | Rule::DoubledBlock
    )
}

/// What is found in the program after some edits.
fn findings_after(document: &Document, settings: &Effective, edits: &[TextEdit]) -> Vec<Finding> {
    if edits.len() <= FEW_EDITS {
        let mut after = document.clone();
        let backwards = edits.iter().rev();
        backwards.for_each(|edit| {
            after.edit(edit.range.clone(), &edit.text);
        });
        return after.findings();
    }
    let bytes = edited(document.text().bytes(), edits).unwrap_or_default();
    Document::read_with(bytes, settings).findings()
}

/// A finding of a rule that is found more often before or after: where it can be, one of before.
fn changed<'a>(before: &'a [Finding], after: &'a [Finding]) -> Option<&'a Finding> {
    let mut more: FxHashMap<Rule, isize> = FxHashMap::default();
    for (findings, by) in [(before, -1), (after, 1)] {
        for finding in findings {
            *more.entry(finding.rule).or_default() += by;
        }
    }
    let differs = |one: &&Finding| more.get(&one.rule).is_some_and(|more| *more != 0);
    let gone = before.iter().find(differs);
    let new = || after.iter().find(differs);
    gone.or_else(|| new().map(|new| before.first().unwrap_or(new)))
}
