//! The gate for repairs of a program: one test for every language.
//!
//! A repair is made by "fix all", or preferred, only where the program is no worse for it: no new
//! finding, no full turn out of nothing, and a closed contour. A repair that only changes the
//! writing and not the machine's way cannot spoil anything. Where a contour stays open, the fault
//! itself must tell what was meant, and the gap may not grow.

use super::keys::is_slip;
use crate::finding::{Detail, Fault, Finding, FixKind, Place, Rule, Severity, TextFix};
use crate::geometry::{Arc, Segment};
use crate::program::path::Kind;
use crate::program::report::Report;
use crate::program::steps::{self, Program};
use crate::text::TextEdit;
use std::collections::BTreeMap;
use std::ops::Range;

/// In texts up to this length each repair is tried by itself; in longer ones all together.
const TRIED: usize = 64 << 10;

/// The number of repairs that are tried one by one where all of them together are refused; and the same in a long text.
const ONE_BY_ONE: usize = 32;
const ONE_BY_ONE_OF_LONG: usize = 4;

/// The guesses about cuts of which it is tried whether each leaves its cut a fault: of one cut, and in all. The others wait
/// until these are made.
const TRIED_OF_CUT: usize = 8;
const TRIED_GUESSES: usize = 64;

/// A program on which repairs can be tried.
pub(in crate::program) trait Tried: Report + Program + Clone {
    /// Replaces a range of bytes and rereads what it touched.
    fn edit(&mut self, range: Range<usize>, replacement: &str);

    /// The lines of the cut around a line.
    fn cut_lines(&self, line: usize) -> Range<usize>;

    /// The repairs of a finding that remove it: those that pass the gate first; the others are neither
    /// preferred nor made by "fix all".
    fn gated(&self, finding: &Finding, mut fixes: Vec<TextFix>) -> Vec<TextFix> {
        if self.text().len() > TRIED || fixes.is_empty() {
            // By what the language found out of it.
            fixes
                .iter_mut()
                .filter(|fix| invents(&fix.kind) || !fix.in_fix_all)
                .for_each(refuse);
            return fixes;
        }
        let before = Judged::of(self, finding);
        let (mut good, mut bad) = (Vec::new(), Vec::new());
        for mut fix in fixes {
            let tried = edited(self, &fix.edit);
            let after = Judged::of(&tried, finding);
            // Unreadable text may have hidden something.
            let spoils = before.standing.is_better_than(&after.standing)
                && (finding.rule != Rule::Syntax || invents(&fix.kind));
            if after.still_says(&before, finding.rule) || spoils {
                continue;
            }
            let (for_itself, by_a_slip) = (
                speaks_for_itself(finding.rule),
                is_by_a_slip(self, &fix.edit),
            );
            let passes = before
                .standing
                .allows(&after.standing, for_itself, by_a_slip)
                && !(is_of_cut(finding.rule) && leaves_faults(&tried, &fix.edit));
            if !passes || invents(&fix.kind) {
                refuse(&mut fix);
            }
            if passes { &mut good } else { &mut bad }.push(fix);
        }
        good.append(&mut bad);
        good
    }

    /// The repairs that fit together and leave the program no worse, as one sorted list of disjoint edits: all, or else one
    /// after another as far as they pass. At most one changes a line.
    fn together(&self, fixes: Vec<(Rule, TextFix)>) -> Vec<TextEdit> {
        let fixes = one_of_each_cut(self, fixes);
        let mut taken = Taken::default();
        let fixes: Vec<(Rule, TextFix)> = fixes
            .into_iter()
            .filter(|(_, fix)| taken.take(self, &fix.edit))
            .collect();
        if fixes.is_empty() {
            return Vec::new();
        }
        let before = Standing::of(self);
        let all = taken.edits();
        let for_itself = fixes.iter().all(|(rule, _)| speaks_for_itself(*rule));
        let by_slips = fixes.iter().all(|(_, fix)| is_by_a_slip(self, &fix.edit));
        if before.allows(&Standing::of(&edited(self, &all)), for_itself, by_slips) {
            return all;
        }
        let (mut kept, mut present) = (Taken::default(), before);
        let most = match self.text().len() > TRIED {
            true => ONE_BY_ONE_OF_LONG,
            false => ONE_BY_ONE,
        };
        for (rule, fix) in fixes.into_iter().take(most) {
            let mut more = kept.clone();
            more.take(self, &fix.edit);
            let after = Standing::of(&edited(self, &more.clone().edits()));
            let by_a_slip = is_by_a_slip(self, &fix.edit);
            if present.allows(&after, speaks_for_itself(rule), by_a_slip) {
                (kept, present) = (more, after);
            }
        }
        kept.edits()
    }
}

/// The properties of a program that a repair must not make worse.
#[derive(Clone, Debug, Default)]
pub(super) struct Standing {
    findings: BTreeMap<&'static str, usize>,
    open: usize,
    /// µm.
    gap: f64,
    full_turns: usize,
    moves: Vec<(Kind, usize, [f64; 3])>,
}

impl Standing {
    fn of(program: &impl Tried) -> Standing {
        Standing::with(program, &program.plain())
    }

    fn with(program: &impl Tried, findings: &[Finding]) -> Standing {
        let mut standing = Standing::default();
        let is_said = |finding: &&Finding| finding.severity <= Severity::Information;
        for finding in findings.iter().filter(is_said) {
            *standing.findings.entry(finding.rule.name()).or_default() += 1;
            if let Some(gap) = gap_of(finding) {
                standing.open += 1;
                standing.gap += gap;
            }
        }
        for step in steps::trace(program)
            .steps
            .iter()
            .filter(|step| step.moves())
        {
            let (arc, by) = (step.ideal.as_ref().and_then(Segment::as_arc), step.meant());
            standing.full_turns += usize::from(arc.is_some_and(Arc::is_full_turn));
            let sweep = arc.map_or(0.0, |arc| arc.sweep);
            let made = (step.kind, step.contour, [by.x, by.y, sweep]);
            standing.moves.push(made);
        }
        standing
    }

    /// True where a repair of such a finding may lead from this to `after`.
    fn allows(&self, after: &Standing, speaks_for_itself: bool, by_a_slip: bool) -> bool {
        if self.moves == after.moves {
            return true;
        }
        let closes = after.open == 0 || after.open < self.open || speaks_for_itself;
        !self.is_better_than(after) && closes && (by_a_slip || after.full_turns <= self.full_turns)
    }

    /// True where `after` has a new finding or closes worse.
    fn is_better_than(&self, after: &Standing) -> bool {
        let mut counts = after.findings.iter();
        let has_new =
            counts.any(|(rule, count)| *count > self.findings.get(rule).copied().unwrap_or(0));
        let opens = after.open > self.open || after.open == self.open && after.gap > self.gap;
        has_new || opens
    }
}

/// The properties of a program, and how often it has a finding.
struct Judged {
    standing: Standing,
    /// How many findings have this content, and how many are of its rule.
    alike: [usize; 2],
}

impl Judged {
    fn of(program: &impl Tried, finding: &Finding) -> Judged {
        let plain = program.plain();
        let alike = match finding.rule {
            Rule::SuspectBlock => alike(&program.all(), finding),
            _ => alike(&plain, finding),
        };
        Judged {
            standing: Standing::with(program, &plain),
            alike,
        }
    }

    /// True where it has the finding as often as before. An equal one elsewhere may stay. A repair does not count if it
    /// leaves something else unreadable, or another crossing close by.
    fn still_says(&self, before: &Judged, rule: Rule) -> bool {
        let needs_fewer = matches!(rule, Rule::Syntax | Rule::PathCrossesItself);
        before.alike[0] > 0
            && self.alike[1] >= before.alike[1]
            && (needs_fewer || self.alike[0] >= before.alike[0])
    }
}

fn alike(findings: &[Finding], finding: &Finding) -> [usize; 2] {
    let of_rule = findings.iter().filter(|other| other.rule == finding.rule);
    let says_the_same = |other: &&Finding| match gap_of(finding) {
        // Distances that agree to the micron are equal.
        Some(gap) => gap_of(other).is_some_and(|its| (its - gap).abs() < 1.0),
        None => other.detail == finding.detail,
    };
    [
        of_rule.clone().filter(says_the_same).count(),
        of_rule.count(),
    ]
}

/// The gap of a contour, µm.
fn gap_of(finding: &Finding) -> Option<f64> {
    match &finding.detail {
        Detail::Program(fault) => match **fault {
            Fault::NotClosed { x, y } => Some(x.hypot(y)),
            _ => None,
        },
        _ => None,
    }
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
            | Rule::MissingEnd
            | Rule::TextAfterEnd
            | Rule::BlockNumber
    )
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

/// True where the cut of the first line that was edited still has a fault.
fn leaves_faults(edited: &impl Tried, edits: &[TextEdit]) -> bool {
    let text = edited.text();
    let Some(first) = edits.first() else {
        return false;
    };
    let lines = edited.cut_lines(text.line_of(first.range.start.min(text.len())));
    let is_fault = |finding: &&Finding| {
        finding.severity <= Severity::Warning
            && (is_of_cut(finding.rule)
                || matches!(finding.rule, Rule::ArcOffRadius | Rule::ArcWithoutRadius))
    };
    let plain = edited.plain();
    plain.iter().filter(is_fault).any(|finding| {
        matches!(&finding.place, Place::Text { range } if lines.contains(&text.line_of(range.start)))
    })
}

/// True for a repair that adds geometry.
fn invents(kind: &FixKind) -> bool {
    matches!(kind, FixKind::Close { .. } | FixKind::InsertBlock { .. })
}

/// Up to this many edits are made one by one; more are made as one, from the first to the last.
const FEW: usize = 8;

/// The program after the edits, which are sorted and disjoint.
fn edited<P: Tried>(program: &P, edits: &[TextEdit]) -> P {
    let mut edited = program.clone();
    if let ([first, .., last], true) = (edits, edits.len() > FEW)
        && let Some(bytes) = crate::text::edited(program.text().bytes(), edits)
    {
        let behind = program.text().len() - last.range.end;
        let between = bytes
            .get(first.range.start..bytes.len() - behind)
            .unwrap_or_default();
        if let Ok(between) = std::str::from_utf8(between) {
            edited.edit(first.range.start..last.range.end, between);
            return edited;
        }
    }
    edits
        .iter()
        .rev()
        .for_each(|edit| edited.edit(edit.range.clone(), &edit.text));
    edited
}

fn is_by_a_slip(program: &impl Tried, edits: &[TextEdit]) -> bool {
    let found = |edit: &TextEdit| program.text().bytes().get(edit.range.clone());
    matches!(edits, [edit] if is_slip(found(edit).unwrap_or_default(), edit.text.as_bytes()))
}

fn refuse(fix: &mut TextFix) {
    (fix.preferred, fix.in_fix_all) = (false, false);
}

/// Without the guesses about a cut in which something else is repaired: that may be what was wrong with it. And without
/// those that leave it a fault.
fn one_of_each_cut(program: &impl Tried, fixes: Vec<(Rule, TextFix)>) -> Vec<(Rule, TextFix)> {
    let text = program.text();
    let line = |fix: &TextFix| fix.edit.first().map(|edit| text.line_of(edit.range.start));
    let (mut guesses, mut others): (Vec<_>, Vec<_>) =
        fixes.into_iter().partition(|(rule, _)| is_of_cut(*rule));
    // The same repair may be that of several findings.
    let mut lines: BTreeMap<usize, Vec<TextEdit>> = BTreeMap::new();
    for (_, fix) in &others {
        lines.extend(line(fix).map(|line| (line, fix.edit.clone())));
    }
    let is_short = text.len() <= TRIED;
    // Findings of one cut come one after another.
    let (mut cut, mut asked) = (0..0, None);
    let (mut of_cut, mut in_all) = (0, 0);
    guesses.retain(|(_, fix)| {
        let Some(own) = line(fix) else {
            return false;
        };
        // Its first and its last line may be those of others, too.
        let is_within = cut.start < own && own + 1 < cut.end;
        if asked.replace(own) != Some(own) && !is_within {
            let its = program.cut_lines(own);
            of_cut = if its == cut { of_cut } else { 0 };
            cut = its;
        }
        let mut in_cut = lines.range(cut.clone());
        let is_alone = in_cut.all(|(_, edit)| *edit == fix.edit);
        let mut is_sound = || {
            if of_cut == TRIED_OF_CUT || in_all == TRIED_GUESSES {
                return false;
            }
            (of_cut, in_all) = (of_cut + 1, in_all + 1);
            !leaves_faults(&edited(program, &fix.edit), &fix.edit)
        };
        let keeps = is_alone && (!is_short || is_sound());
        if keeps {
            lines.insert(own, fix.edit.clone());
        }
        keeps
    });
    others.append(&mut guesses);
    others
}

/// Edits that are made together, by their start: an edit can only touch its neighbours.
#[derive(Clone, Default)]
struct Taken {
    edits: BTreeMap<usize, TextEdit>,
    /// First and last line of each repair.
    lines: BTreeMap<usize, usize>,
}

impl Taken {
    /// Takes the edits of a repair where nothing else changes their lines; false otherwise.
    fn take(&mut self, program: &impl Tried, edits: &[TextEdit]) -> bool {
        let text = program.text();
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
                self.lines
                    .range(..=last)
                    .next_back()
                    .is_none_or(|(_, end)| *end < first)
            })
        };
        if !edits.iter().all(|edit| is_free(edit) && is_line_free(edit)) {
            return false;
        }
        self.lines.extend(edits.iter().filter_map(lines));
        self.edits
            .extend(edits.iter().map(|edit| (edit.range.start, edit.clone())));
        true
    }

    fn edits(self) -> Vec<TextEdit> {
        self.edits.into_values().collect()
    }
}
