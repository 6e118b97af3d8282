//! Which repairs of a program are offered and made, whatever its language. Each is tried: after it its finding is gone, its
//! cut closes, and nothing else is found. What does not pass is offered all the same, neither preferred nor made by "fix all".

mod places;

use self::places::{Moved, Ranges};
use super::document::Document;
use super::numbering::Renumbering;
use super::report::place_of;
use crate::finding::{Detail, Fault, Finding, FixKind, Rule, Severity, TextFix};
use crate::settings::Effective;
use crate::text::{SourceText, TextEdit, edited};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::collections::BTreeMap;
use std::ops::Range;

/// In texts up to this length each repair that is offered is tried.
const TRIED: usize = 64 << 10;

/// Up to this many edits are made one by one; more are made as one, from the first to the last.
const FEW: usize = 8;

/// So many times repairs that are made together are tried, each time without those that did not repair.
const TRIES: usize = 12;

/// What is left of a finding, and around it, after a repair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Repaired,
    /// The finding is gone, but the cut stays open or has another fault that was there before.
    InPart,
    /// The finding is still there, or another one has come.
    Not,
}

impl Document {
    /// The fixes of one finding as edits of the text, the preferred one first.
    pub fn fixes(&self, finding: &Finding) -> Vec<TextFix> {
        if self.is_no_text().is_some() {
            return Vec::new();
        }
        let mut fixes = self.offered(finding, Renumbering::Offered);
        if self.text().len() > TRIED {
            // By what the language found out of it.
            let doubtful = |fix: &&mut TextFix| invents(&fix.kind) || !fix.in_fix_all;
            fixes.iter_mut().filter(doubtful).for_each(refuse);
            return fixes;
        }
        let found = self.all();
        let mut tried: Vec<(Verdict, TextFix)> = Vec::new();
        for mut fix in fixes {
            let lines = self.cut_lines(line_of(self.text(), &fix.edit));
            let made = Tried::of(self, &found, &[finding], &fix.edit);
            // Unreadable text may have hidden something.
            let may_hide = finding.rule == Rule::Syntax && !invents(&fix.kind);
            let verdict = match spoils(finding, &made.was.0, &made.is.0) {
                _ if made.leaves(finding, &fix.edit) => Verdict::Not,
                true if may_hide => Verdict::InPart,
                true => Verdict::Not,
                false => made.verdict(finding, &fix.edit, &lines),
            };
            if verdict != Verdict::Repaired || invents(&fix.kind) {
                refuse(&mut fix);
            }
            tried.push((verdict, fix));
        }
        tried.retain(|(verdict, _)| *verdict != Verdict::Not);
        tried.sort_by_key(|(verdict, _)| *verdict != Verdict::Repaired);
        tried.into_iter().map(|(_, fix)| fix).collect()
    }

    /// The safe fixes of all findings that are not switched off, as one sorted list of disjoint edits; `None` where
    /// there is none.
    pub(crate) fn fix_all(&self, settings: &Effective) -> Option<Vec<TextEdit>> {
        Some(self.fixed(settings)?.0)
    }

    /// The same, and the program after them.
    pub(crate) fn fixed(&self, settings: &Effective) -> Option<(Vec<TextEdit>, Document)> {
        let (findings, _) = self.findings(settings, usize::MAX);
        let fixes = findings
            .par_iter()
            .filter_map(|finding| Some((finding, self.safe_fix(finding)?)));
        self.mended(&findings, fixes.collect())
    }

    /// Whether [`Document::fix_all`] would change anything, by the first finding of all `found` for which it would. Where none of very many
    /// can be repaired the others are not looked at, and each try reads the program again: only a few are made alone.
    pub(crate) fn can_be_fixed(&self, found: &[Finding]) -> bool {
        const MOST_LOOKED_AT: usize = 1_000;
        const TRIED_ALONE: usize = 4;
        let mends = |fixes| self.mended(found, fixes).is_some();
        let mut fixes = Vec::new();
        for finding in found.iter().take(MOST_LOOKED_AT) {
            let Some(fix) = self.safe_fix(finding) else {
                continue;
            };
            if fixes.len() < TRIED_ALONE && mends(vec![(finding, fix.clone())]) {
                return true;
            }
            fixes.push((finding, fix));
        }
        fixes.len() > 1 && mends(fixes)
    }

    /// The fix of a finding that is safe to make with others.
    fn safe_fix(&self, finding: &Finding) -> Option<TextFix> {
        let is_said = finding.severity <= Severity::Information;
        let offered = is_said.then(|| self.offered(finding, Renumbering::LeftOut))?;
        let mut fixes = offered.into_iter();
        fixes.find(|fix| fix.preferred && fix.in_fix_all)
    }

    /// What of these fixes fits together and repairs, and the program after it; `found` are all findings. A fix that does not
    /// repair is left out, and the others are made without it.
    fn mended(
        &self,
        found: &[Finding],
        fixes: Vec<(&Finding, TextFix)>,
    ) -> Option<(Vec<TextEdit>, Document)> {
        let mut fixes = self.one_of_each_cut(fixes);
        for _ in 0..TRIES {
            let mut taken = Taken::default();
            fixes.retain(|(_, fix, _)| taken.take(self.text(), &fix.edit));
            let edits: Vec<TextEdit> = taken.edits.into_values().collect();
            if edits.is_empty() {
                return None;
            }
            let repaired: Vec<&Finding> = fixes.iter().map(|(finding, ..)| *finding).collect();
            let tried = Tried::of(self, found, &repaired, &edits);
            let count = fixes.len();
            fixes.retain(|(finding, fix, lines)| {
                tried.verdict(finding, &fix.edit, lines) == Verdict::Repaired
            });
            if fixes.len() == count {
                let after = tried.after;
                return Some((edits, after));
            }
        }
        None
    }

    /// Each with the lines of its cut; without the guesses about a cut in which something else is repaired: that may be what
    /// was wrong with it.
    fn one_of_each_cut<'a>(
        &self,
        fixes: Vec<(&'a Finding, TextFix)>,
    ) -> Vec<(&'a Finding, TextFix, Range<usize>)> {
        let mut lines = 0..0;
        let of_cuts = fixes.into_iter().map(|(finding, fix)| {
            let line = line_of(self.text(), &fix.edit);
            // Findings of one cut come one after another. Its first and its last line may be those of others, too.
            if !(lines.start < line && line + 1 < lines.end) {
                lines = self.cut_lines(line);
            }
            (finding, fix, lines.clone())
        });
        let (guesses, mut others): (Vec<_>, Vec<_>) =
            of_cuts.partition(|(finding, ..)| is_of_cut(finding.rule));
        let placed = |fix: &TextFix| (line_of(self.text(), &fix.edit), fix.edit.clone());
        let mut by_line: BTreeMap<usize, Vec<TextEdit>> =
            others.iter().map(|(_, fix, _)| placed(fix)).collect();
        for (finding, fix, lines) in guesses {
            let mut in_cut = by_line.range(lines.clone());
            if in_cut.all(|(_, edit)| *edit == fix.edit) {
                by_line.extend([placed(&fix)]);
                others.push((finding, fix, lines));
            }
        }
        others
    }

    /// The program after the edits, which are sorted and disjoint.
    fn with(&self, edits: &[TextEdit]) -> Document {
        let mut after = self.clone();
        if let ([first, .., last], true) = (edits, edits.len() > FEW)
            && let Some(bytes) = edited(self.text().bytes(), edits)
        {
            let behind = self.text().len() - last.range.end;
            let between = bytes.get(first.range.start..bytes.len() - behind);
            if let Ok(between) = std::str::from_utf8(between.unwrap_or_default()) {
                after.edit(first.range.start..last.range.end, between);
                return after;
            }
        }
        let backwards = edits.iter().rev();
        backwards.for_each(|edit| after.edit(edit.range.clone(), &edit.text));
        after
    }
}

/// The line of the first edit of a repair.
fn line_of(text: &SourceText, edits: &[TextEdit]) -> usize {
    let start = edits.first().map_or(0, |edit| edit.range.start);
    text.line_of(start.min(text.len()))
}

/// True for faults whose place does not tell which block is wrong: their repairs are guesses about the whole cut.
fn is_of_cut(rule: Rule) -> bool {
    matches!(
        rule,
        Rule::NotClosed
            | Rule::SuspectBlock
            | Rule::PathCrossesItself
            | Rule::Spur
            | Rule::ReversedArc
            | Rule::DoubledBlock
    )
}

/// True for faults that tell what was meant whether the contour closes or not.
fn speaks_for_itself(rule: Rule) -> bool {
    matches!(
        rule,
        Rule::LengthInJ
            | Rule::MissingB
            | Rule::BlockNumberAsB
            | Rule::Syntax
            | Rule::ZeroBlock
            | Rule::PositionMismatch
            | Rule::BlockNumber
    ) || is_of_end(rule)
}

/// True for faults whose repairs change where the program ends: they cannot spoil the machine's way, and what comes to light was
/// there before. The numbers of blocks are no such thing: two blocks that are equal but for them are no longer one block twice.
fn is_of_end(rule: Rule) -> bool {
    matches!(
        rule,
        Rule::MissingEnd | Rule::TextAfterEnd | Rule::MissingReturn
    )
}

/// True for a repair that adds geometry.
fn invents(kind: &FixKind) -> bool {
    matches!(kind, FixKind::Close { .. } | FixKind::InsertBlock { .. })
}

fn refuse(fix: &mut TextFix) {
    (fix.preferred, fix.in_fix_all) = (false, false);
}

/// A program before and after some edits.
struct Tried<'a> {
    text: &'a SourceText,
    after: Document,
    moved: Moved<'a>,
    /// The findings before and after.
    was: ByLine,
    is: ByLine,
    left: Ranges,
    /// The findings that nobody has repaired, where they stand now.
    unrepaired: Ranges,
}

impl<'a> Tried<'a> {
    fn of(
        before: &'a Document,
        found: &[Finding],
        repaired: &[&Finding],
        edits: &'a [TextEdit],
    ) -> Tried<'a> {
        let (after, moved) = (before.with(edits), Moved::by(edits));
        let left = after.all();
        let repaired = Ranges::of(repaired.iter().copied(), Range::clone);
        let is_repaired = |finding: &&Finding| {
            let range = finding.place.in_text();
            range.is_some_and(|range| repaired.has(finding.rule, range))
        };
        let unrepaired = found.iter().filter(|finding| !is_repaired(finding));
        Tried {
            unrepaired: Ranges::of(unrepaired, |range| moved.range(range)),
            text: before.text(),
            was: ByLine::of(found, before.text()),
            is: ByLine::of(&left, after.text()),
            left: Ranges::of(&left, Range::clone),
            after,
            moved,
        }
    }

    /// Whether a finding is still there, or where its repair has edited: two blocks that are exchanged take it along.
    fn leaves(&self, finding: &Finding, edits: &[TextEdit]) -> bool {
        finding.place.in_text().is_none_or(|range| {
            let mut places = edits.iter().map(|edit| &edit.range).chain([range]);
            places.any(|place| {
                let now = self.moved.range(place);
                self.left.has_at(finding.rule, &now, &self.unrepaired)
            })
        })
    }

    /// What is left of a finding after its repair by `edits`, and in the lines of its cut before them.
    fn verdict(&self, finding: &Finding, edits: &[TextEdit], lines: &Range<usize>) -> Verdict {
        let last = lines.end.saturating_sub(1).max(lines.start);
        let bytes = self.text.line_start(lines.start)..self.text.line_range(last).end;
        let bytes = self.moved.range(&bytes);
        let text = self.after.text();
        let now = text.line_of(bytes.start)..text.line_of(bytes.end) + 1;
        let (was, is) = (self.was.within(lines), self.is.within(&now));
        if self.leaves(finding, edits) || spoils(finding, was, is) {
            return Verdict::Not;
        }
        let is_open = is.iter().any(|own| own.rule == Rule::NotClosed);
        let is_open = is_open && !speaks_for_itself(finding.rule);
        let is_fault = |own: &Found| {
            let is_of_arc = matches!(own.rule, Rule::ArcOffRadius | Rule::ArcWithoutRadius);
            own.severity <= Severity::Warning && (is_of_cut(own.rule) || is_of_arc)
        };
        match is_open || is_of_cut(finding.rule) && is.iter().any(is_fault) {
            true => Verdict::InPart,
            false => Verdict::Repaired,
        }
    }
}

/// By how much a cut is open, µm.
fn gap_of(finding: &Finding) -> f64 {
    match &finding.detail {
        Detail::Program(fault) => match **fault {
            Fault::NotClosed { x, y } => x.hypot(y),
            _ => 0.0,
        },
        _ => 0.0,
    }
}

/// Whether what is found after a repair is more than before, or a cut is open by more. Which block is to blame is no finding of
/// its own.
fn spoils(finding: &Finding, was: &[Found], is: &[Found]) -> bool {
    let count = |all: &[Found], rule: Rule| all.iter().filter(|own| own.rule == rule).count();
    let mut rules: Vec<Rule> = is.iter().map(|own| own.rule).collect();
    rules.sort_unstable();
    rules.dedup();
    rules.retain(|rule| *rule != Rule::SuspectBlock);
    let has_come = rules
        .iter()
        .any(|rule| count(is, *rule) > count(was, *rule));
    let [gap_before, gap] = [was, is].map(|all| all.iter().map(|own| own.gap).sum::<f64>());
    // Where closing is the repair, it has to come nearer: else the same gap is only found at another block.
    let is_too_wide = if finding.rule == Rule::NotClosed {
        gap >= gap_before
    } else {
        gap > gap_before
    };
    let is_wider = is_too_wide && count(is, Rule::NotClosed) == count(was, Rule::NotClosed);
    (has_come || is_wider) && !is_of_end(finding.rule)
}

/// A finding by its line.
struct Found {
    line: usize,
    rule: Rule,
    severity: Severity,
    /// By how much a cut is open, µm.
    gap: f64,
}

/// Findings in the order of their lines, without those that are only hints.
struct ByLine(Vec<Found>);

impl ByLine {
    fn of(findings: &[Finding], text: &SourceText) -> ByLine {
        let said = findings
            .iter()
            .filter(|own| own.severity <= Severity::Information);
        let mut all: Vec<Found> = said
            .map(|own| Found {
                line: text.line_of(place_of(own).0),
                rule: own.rule,
                severity: own.severity,
                gap: gap_of(own),
            })
            .collect();
        all.sort_by_key(|own| own.line);
        ByLine(all)
    }

    fn within(&self, lines: &Range<usize>) -> &[Found] {
        let [first, behind] =
            [lines.start, lines.end].map(|line| self.0.partition_point(|own| own.line < line));
        self.0.get(first..behind).unwrap_or_default()
    }
}

/// Edits that are made together, by their start: an edit can only touch its neighbours.
#[derive(Default)]
struct Taken {
    edits: BTreeMap<usize, TextEdit>,
    /// First and last line of each repair.
    lines: BTreeMap<usize, usize>,
}

impl Taken {
    /// Takes the edits of a repair where nothing else changes their lines; false otherwise.
    fn take(&mut self, text: &SourceText, edits: &[TextEdit]) -> bool {
        // The same repair may be that of several findings.
        if edits
            .iter()
            .all(|edit| self.edits.get(&edit.range.start) == Some(edit))
        {
            return true;
        }
        let is_free = |edit: &TextEdit| {
            let before = self.edits.range(..=edit.range.end).next_back();
            before.is_none_or(|(_, other)| other.range.end < edit.range.start)
        };
        let lines = |edit: &TextEdit| {
            // An insertion after a line does not change it.
            let (first, last) = (text.line_of(edit.range.start), text.line_of(edit.range.end));
            let is_behind = edit.range.is_empty()
                && edit.range.start == text.line_range(first).end
                && edit.text.starts_with(['\r', '\n']);
            (!is_behind).then_some((first, last))
        };
        let is_line_free = |edit: &TextEdit| {
            lines(edit).is_none_or(|(first, last)| {
                let before = self.lines.range(..=last).next_back();
                before.is_none_or(|(_, end)| *end < first)
            })
        };
        if !edits.iter().all(|edit| is_free(edit) && is_line_free(edit)) {
            return false;
        }
        self.lines.extend(edits.iter().filter_map(lines));
        let by_start = edits.iter().map(|edit| (edit.range.start, edit.clone()));
        self.edits.extend(by_start);
        true
    }
}
