//! What the program says of a fault, and what its repairs make of it.

use super::contours::Group;
use super::inject::Faulty;
use std::sync::Arc;
use wedm::document::{Document, Source};
use wedm::finding::{Edit, Finding, Place, Severity, Side};
use wedm::geometry::{Segment, Vector};
use wedm::job::ROUNDS;
use wedm::program::{self, path::Kind};
use wedm::settings::Effective;
use wedm::text::{TextEdit, edited};

/// What became of a program under fix-all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Outcome {
    /// It means again what it meant.
    Right,
    /// It means what the fault made of it, or what some of several slips made.
    Untouched,
    /// It means something else, which closes as exactly as what was meant, and nothing is reported about it.
    Plausible,
    Wrong,
}

/// How one fault came out.
#[derive(Clone, Debug)]
pub struct Verdict {
    pub found: bool,
    pub right_line: bool,
    /// The first fix of the first finding that has one makes of the program what it was.
    pub first_fix: bool,
    pub outcome: Outcome,
    /// Findings, and what fix-all left: to look at.
    pub said: Vec<String>,
    pub first: Option<String>,
    pub left: String,
}

pub fn read(group: Group, text: &str) -> Document {
    let settings = Arc::new(Effective::default());
    Document::new(
        Source::Program(program::Document::read(
            group.language(),
            text.as_bytes().to_vec(),
            &settings,
        )),
        settings,
    )
}

/// What is said of a program, hints left out.
pub fn findings(document: &mut Document) -> Vec<Finding> {
    let mut findings = document.findings(usize::MAX).0;
    findings.retain(|finding| finding.severity <= Severity::Information);
    findings
}

/// One thing that the machine does, whatever the text says it with.
#[derive(Clone, Debug, PartialEq)]
struct Act {
    contour: usize,
    is_rapid: bool,
    side: Option<Side>,
    by: Vector,
    /// Of an arc, from its start to places on it: what it is, however small the arc is beside its circle.
    bend: Option<[Vector; 3]>,
}

/// Where the machine goes.
fn acts(document: &Document) -> Vec<Act> {
    let Some(program) = document.program() else {
        return Vec::new();
    };
    let steps = program.trace().steps;
    let act = |step: &program::path::Step| {
        let by = step.meant();
        let bend = match &step.ideal {
            Some(segment @ Segment::Arc(arc)) => {
                Some([0.25, 0.5, 0.75].map(|share| segment.point_at(share) - arc.start))
            }
            _ => None,
        };
        let is_still = by.norm() < 1e-6 && bend.is_none();
        (step.moves() && !is_still).then(|| Act {
            contour: step.contour,
            is_rapid: step.kind == Kind::Rapid,
            side: step.side,
            by,
            bend,
        })
    };
    steps.iter().filter_map(act).collect()
}

/// How far two decoded blocks may be apart that mean the same, µm.
const SAME: f64 = 3.0;

/// The same for those of which nothing was calculated.
const EQUAL: f64 = 1.0;

fn is_same(one: &[Act], other: &[Act]) -> bool {
    is_within(SAME, one, other)
}

fn is_within(um: f64, one: &[Act], other: &[Act]) -> bool {
    let same = |(a, b): (&Act, &Act)| {
        let is_near = |a: Vector, b: Vector| (a - b).norm() <= um;
        let bends = match (a.bend, b.bend) {
            (None, None) => true,
            (Some(a), Some(b)) => a.iter().zip(b).all(|(a, b)| is_near(*a, b)),
            _ => false,
        };
        (a.contour, a.is_rapid, a.side) == (b.contour, b.is_rapid, b.side)
            && is_near(a.by, b.by)
            && bends
    };
    one.len() == other.len() && one.iter().zip(other).all(same)
}

/// How far the machine ends from where it began, µm.
fn closure(acts: &[Act]) -> f64 {
    acts.iter().map(|act| act.by).sum::<Vector>().norm()
}

fn with(document: &Document, edits: &[TextEdit]) -> Option<String> {
    String::from_utf8(edited(document.text()?.bytes(), edits)?).ok()
}

/// The program that fix-all leaves.
fn fixed(document: &Document) -> Document {
    let mut present = document.clone();
    for _ in 0..ROUNDS {
        let Some((_, repaired)) = present.round() else {
            break;
        };
        present = repaired;
    }
    present
}

/// What fix-all leaves of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Left {
    /// What it was before the fault.
    Right,
    /// What the fault made of it.
    Alone,
    Wrong,
}

/// What fix-all leaves of a program with a fault, and the text of it.
pub fn left_of(group: Group, sound: &str, faulty: &str) -> (Left, String) {
    let document = read(group, faulty);
    let left = fixed(&document);
    let text = left.text().map(|text| text.as_str_lossy().into_owned());
    let text = text.unwrap_or_default();
    let made = acts(&left);
    let how = if text == sound || is_within(EQUAL, &made, &acts(&read(group, sound))) {
        Left::Right
    } else if is_within(EQUAL, &made, &acts(&document)) {
        Left::Alone
    } else {
        Left::Wrong
    };
    (how, text)
}

/// Judges one fault; `None` where it changes nothing: neither what the program means nor what is said of it.
pub fn judge(group: Group, sound: &str, faulty: &Faulty) -> Option<Verdict> {
    let meant = acts(&read(group, sound));
    let mut document = read(group, &faulty.text);
    let of_fault = acts(&document);
    let findings = findings(&mut document);
    if is_same(&meant, &of_fault) && findings.is_empty() {
        return None;
    }
    let text = document.text()?.clone();
    let line_of = |finding: &Finding| match &finding.place {
        Place::Text { range } => Some(text.line_of(range.start)),
        _ => None,
    };
    let right_line = findings
        .iter()
        .filter_map(line_of)
        .any(|line| faulty.lines.contains(&line));
    let first = findings
        .iter()
        .find_map(|finding| document.fixes(finding).into_iter().next());
    let first_text = first.as_ref().and_then(|fix| match &fix.edit {
        Edit::Text(edits) => with(&document, edits),
        Edit::Drawing(_) | Edit::Settings(_) => None,
    });
    let first_fix = first_text
        .as_ref()
        .is_some_and(|text| is_same(&meant, &acts(&read(group, text))));
    let mut present = fixed(&document);
    let left = acts(&present);
    let is_between = || {
        let mut between = faulty.between.iter();
        between.any(|text| is_same(&left, &acts(&read(group, text))))
    };
    let outcome = if is_same(&left, &meant) {
        Outcome::Right
    } else if is_same(&left, &of_fault) || is_between() {
        Outcome::Untouched
    } else if closure(&left) <= closure(&meant) + 1.0 && self::findings(&mut present).is_empty() {
        Outcome::Plausible
    } else {
        Outcome::Wrong
    };
    let said = |finding: &Finding| {
        format!(
            "{}: {}: {}",
            line_of(finding).map_or(0, |line| line + 1),
            finding.rule.name(),
            wedm::finding::sentence(finding, 1.0)
        )
    };
    let left = present.text()?.as_str_lossy().into_owned();
    Some(Verdict {
        found: !findings.is_empty(),
        right_line,
        first_fix,
        outcome,
        said: findings.iter().map(said).collect(),
        first: first.map(|fix| format!("{:?} ({}, {})", fix.kind, fix.preferred, fix.in_fix_all)),
        left,
    })
}
