//! `wedm fix`: every safe repair of a drawing or program, in its own bytes.

use super::changes::print_diff;
use super::lisp::Answer;
use super::options::{Common, LispEncoding, targets};
use super::output::{self, styled};
use super::report::{self, Row};
use super::{Failure, Verdict, ending, files};
use crate::disk::Seen;
use crate::document::{Document, Source};
use crate::drawing::DrawingEdit;
use crate::finding::{Detail, Edit, Finding, Fix, FixKind, Place, Rule, Severity};
use crate::job::{self, Outcome, REPAIRED, Repairs};
use crate::message::{readable, said};
use crate::protocol::FindingData;
use crate::text::Writing;
use clap::Args;
use serde_json::json;
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm fix plate.dxf --diff                what would change
  wedm fix plate.dxf -o fixed.dxf
  wedm fix --in-place drawings/
  wedm fix plate.dxf --in-place --correction 0.12")]
pub(crate) struct Arguments {
    #[arg(value_name = "PATH", required = true)]
    paths: Vec<PathBuf>,
    #[command(flatten)]
    target: Target,
    #[arg(long, requires = "output")]
    overwrite: bool,
    #[arg(long, value_enum, default_value_t, hide_default_value = true)]
    encoding: LispEncoding,
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    common: Common,
}

#[derive(Args, Debug)]
#[group(required = true, multiple = false)]
struct Target {
    #[arg(short, long, value_name = "OUT")]
    output: Vec<PathBuf>,
    #[arg(long)]
    in_place: bool,
    #[arg(long)]
    diff: bool,
}

/// The words for a number of repaired findings.
type Counted = fn(&usize) -> String;

/// The rules whose findings are repaired without being asked for, with the words for their number.
fn repaired_rules() -> impl Iterator<Item = (Rule, Counted)> {
    let words: [Counted; REPAIRED.len()] = [
        said::arcs,
        said::doubles,
        said::overlaps,
        said::short_segments,
        said::gaps,
        said::chorded_arcs,
    ];
    REPAIRED.into_iter().zip(words)
}

fn is_repaired(finding: &Finding) -> bool {
    REPAIRED.contains(&finding.rule)
}

/// The most findings for which it is worked out why they were not repaired: each costs a look at
/// the drawing.
const LISTED: usize = 100;

/// If more findings than this are left, they are counted by rule.
const LEFT: usize = 8;

/// At most this many repairs have a line of their own: each is worked out once more for it.
const LINES: usize = 40;

/// Of more findings only the sums are said: working a repair out takes as long as a drawing is crowded, and nobody reads forty of thousands.
const MOST_LISTED: usize = 1_000;

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let found = files::search(&arguments.paths, &files::Search::default());
    let (target, is_for_lisp) = targets(&arguments.target.output)?;
    let mut answer = is_for_lisp.then(|| Answer::new("fix", arguments.encoding));
    let mut verdict = Verdict::Clean;
    for failure in &found.failures {
        output::complain(&failure.0);
        if let Some(answer) = &mut answer {
            answer.push_failure(failure);
        }
        verdict = Verdict::Failed;
    }
    if let ([_, _, ..], Some(_)) = (&found.files[..], target) {
        let files = say!(files, found.files.len());
        return Err(Failure(say!(several_files_for_one_output, files)));
    }
    for path in &found.files {
        match fix(path, arguments, target, answer.as_mut()) {
            Ok(own) => verdict = verdict.max(own),
            Err(failure) => {
                output::complain_once(&failure.0);
                if let Some(answer) = &mut answer {
                    answer.push_failure(&failure);
                }
                verdict = Verdict::Failed;
            }
        }
    }
    answer.map_or(Ok(()), Answer::print)?;
    Ok(verdict)
}

fn fix(
    path: &Path,
    arguments: &Arguments,
    target: Option<&Path>,
    answer: Option<&mut Answer>,
) -> Result<Verdict, Failure> {
    if arguments.target.in_place {
        output::refuse_irregular(path)?;
    }
    let common = &arguments.common;
    let opened = files::open_to_use(path, target, common, &common.settings())?;
    if let Some(target) = target {
        ending::as_read(&opened, target)?;
    }
    let input = path;
    let path = files::shown(path);
    let before = answer.is_some().then(|| opened.document.clone());
    let repair = repair(path, opened.document, !arguments.quiet)?;
    // With `--output lisp` alone nothing is written.
    if target.is_some() || arguments.target.output.is_empty() {
        deliver(
            input,
            arguments,
            target,
            &repair,
            opened.seen.as_ref(),
            opened.writing,
        )?;
    }
    if let (Some(answer), Some(before)) = (answer, before) {
        add_to(answer, path, &before, &repair);
    }
    if !arguments.quiet {
        summarise(path, &repair);
        go_on(input, arguments, target, &repair);
        output::say_against(&repair.document);
    }
    let errors_left = repair
        .after
        .iter()
        .any(|row| row.severity == Severity::Error);
    Ok(Verdict::of_errors(
        errors_left || !repair.refused.is_empty(),
    ))
}

/// A drawing or program before and after.
struct Repair {
    bytes_before: Vec<u8>,
    before: Vec<Row>,
    document: Document,
    after: Vec<Row>,
    /// The repairs that cannot be written, and why.
    refused: Vec<(Row, String)>,
    /// The findings of a program that several repairs explain equally well: the line of each, and the repairs.
    choices: Vec<(usize, String)>,
    rounds: usize,
    /// Findings that were repaired.
    gone: usize,
    /// A line for each repair, as far as they were worked out.
    made: Vec<String>,
}

impl Repair {
    fn bytes(&self) -> &[u8] {
        self.document.text().map_or(&[], |text| text.bytes())
    }

    fn is_changed(&self) -> bool {
        self.bytes() != self.bytes_before
    }
}

/// Applies all fixes until none is left, and proves that the result is no worse.
fn repair(path: &Path, mut document: Document, lists: bool) -> Result<Repair, Failure> {
    if let Source::Dxf(text) = document.source()
        && text.is_binary()
    {
        return Err(Failure::of(path, say!(binary_dxf_is_not_edited)));
    }
    let before = report::rows(path, &mut document);
    let bytes_before = document
        .text()
        .map_or_else(Vec::new, |text| text.bytes().to_vec());
    let (mut rounds, mut gone) = (0, 0);
    let planned = match lists {
        true => planned(path, &document),
        false => Vec::new(),
    };
    if let Some(Repairs::OfText {
        repaired,
        rounds: of_all,
        ..
    }) = job::fix_all(&document, &())
    {
        gone = Outcome::of(&document, &repaired).repaired;
        (document, rounds) = (*repaired, of_all);
    }
    let after = report::rows(path, &mut document);
    let refused = refused(path, &document);
    let choices = choices(&document);
    let name = |row: &Row| {
        let FindingData {
            handle, segment, ..
        } = &row.data;
        let line = handle.is_none().then_some(row.span.line);
        (
            row.rule,
            handle.clone(),
            *segment,
            line,
            row.message.clone(),
        )
    };
    let left: Vec<_> = after.iter().map(name).collect();
    let made = planned
        .into_iter()
        .filter(|(row, _)| !left.contains(&name(row)));
    let made = made.map(|(_, line)| line).collect();
    let repair = Repair {
        bytes_before,
        before,
        document,
        after,
        refused,
        choices,
        rounds,
        gone,
        made,
    };
    let errors = |rows: &[Row]| {
        rows.iter()
            .filter(|row| row.severity == Severity::Error)
            .count()
    };
    if errors(&repair.after) > errors(&repair.before) {
        return Err(Failure::of(
            path,
            say!(internal_error, say!(more_errors_than_before)),
        ));
    }
    Ok(repair)
}

/// What will be repaired, as a line for each: the place, and what becomes of it.
fn planned(path: &Path, document: &Document) -> Vec<(Row, String)> {
    let findings = document.all_findings();
    if findings.len() > MOST_LISTED {
        return Vec::new();
    }
    let is_of_program = document.program().is_some();
    let may_go = |finding: &&Finding| is_of_program || is_repaired(finding);
    let line = |finding: &Finding| {
        let fix = document.safe_fix(finding, &|_| true)?;
        let row = report::row(path, document, finding);
        let unit_mm = document.unit_mm();
        let place = match (&row.data.handle, row.data.segment) {
            (Some(handle), Some(segment)) => say!(segment, readable(handle), segment),
            (Some(handle), None) => readable(handle).into_owned(),
            _ => say!(line_of_a_repair, row.span.line),
        };
        let what = match (&fix.kind, &finding.detail) {
            (FixKind::Refillet { radius, moved, .. }, Detail::SmallRadius(numbers)) => say!(
                an_arc_becomes_larger,
                numbers.radius * unit_mm,
                radius * unit_mm,
                moved * unit_mm
            ),
            _ => fix.kind.title(unit_mm),
        };
        Some((row, say!(says, place, what)))
    };
    findings
        .iter()
        .filter(may_go)
        .take(LINES)
        .filter_map(line)
        .collect()
}

/// The command that comes next, with the name of the file that was written.
fn go_on(input: &Path, arguments: &Arguments, target: Option<&Path>, repair: &Repair) {
    let stdout = Path::new(output::STDIN);
    let file = target.or(arguments.target.in_place.then_some(input));
    let Some(file) = file.filter(|file| *file != stdout) else {
        return;
    };
    let has_errors = (repair.after.iter()).any(|row| row.severity == Severity::Error);
    let word = output::word(file);
    let next = match has_errors || repair.document.program().is_some() {
        true => say!(next_is_checking, word),
        false => say!(next_is_the_program, word),
    };
    output::say(&styled(output::NOTE, next));
}

/// Findings with a safe fix that the text cannot take, each with the reason.
fn refused(path: &Path, document: &Document) -> Vec<(Row, String)> {
    let Source::Dxf(text) = document.source() else {
        return Vec::new();
    };
    let findings = document.all_findings();
    // Nothing is repaired where not all is judged, and the finding of that says why.
    if findings.iter().any(|it| it.rule == Rule::NotJudged) {
        return Vec::new();
    }
    let repaired = findings.iter().filter(|finding| is_repaired(finding));
    let is_refused = |edit: &DrawingEdit| text.text_edits(edit).is_err();
    let reason = |finding: &Finding| {
        let Edit::Drawing(edit) = document.safe_fix(finding, &is_refused)?.edit else {
            return None;
        };
        Some((
            report::row(path, document, finding),
            text.text_edits(&edit).err()?,
        ))
    };
    repaired.take(LISTED).filter_map(reason).collect()
}

/// The repairs between which only the user can choose, each once.
fn choices(document: &Document) -> Vec<(usize, String)> {
    let (Source::Program(_), Some(text)) = (document.source(), document.text()) else {
        return Vec::new();
    };
    let findings = document.all_findings();
    let left = findings
        .iter()
        .filter(|finding| finding.severity <= Severity::Warning);
    let mut choices: Vec<(usize, String)> = Vec::new();
    for finding in left.take(LEFT) {
        let Place::Text { range } = &finding.place else {
            continue;
        };
        let fixes = document.fixes(finding);
        if fixes.len() < 2 || fixes.iter().any(|fix| fix.preferred) {
            continue;
        }
        let title = |fix: &Fix<Edit>| {
            let Edit::Text(edits) = &fix.edit else {
                return None;
            };
            let line = text.line_of(edits.first()?.range.start) + 1;
            Some(say!(a_choice, line, fix.kind.title(document.unit_mm())))
        };
        let titles: Vec<String> = fixes.iter().filter_map(title).collect();
        let titles = titles.join(say!(semicolon));
        if !choices.iter().any(|(_, known)| *known == titles) {
            choices.push((text.line_of(range.start) + 1, titles));
        }
    }
    choices
}

fn deliver(
    path: &Path,
    arguments: &Arguments,
    target: Option<&Path>,
    repair: &Repair,
    seen: Option<&Seen>,
    writing: Writing,
) -> Result<(), Failure> {
    if arguments.target.diff {
        return print_diff(path, &repair.bytes_before, repair.bytes(), writing);
    }
    let bytes = writing.written(repair.bytes());
    match target {
        Some(path) => output::write(Some(path), &bytes, arguments.overwrite),
        None if repair.is_changed() => output::write_over(path, seen, &bytes),
        None => Ok(()),
    }
}

/// What was repaired, for AutoLISP: the sentences, what becomes of each entity, and the findings that are left.
fn add_to(answer: &mut Answer, path: &Path, before: &Document, repair: &Repair) {
    let fixed = json!({
        "path": path.display().to_string(),
        "rounds": repair.rounds,
        "repaired": repair.gone,
        "made": repair.made,
    });
    answer.push("fixed", &fixed);
    if let (Source::Dxf(before), Source::Dxf(after)) = (before.source(), repair.document.source()) {
        answer.push_changes(&after.changes_since(before));
    }
    for (row, reason) in &repair.refused {
        let refused =
            json!({ "message": row.message, "reason": reason, "handle": row.data.handle });
        answer.push("not-repaired", &refused);
    }
    for row in &repair.after {
        row.add_to(answer);
    }
}

/// Reports to stderr what was repaired, and what is left and why: stdout may be the drawing.
fn summarise(path: &Path, repair: &Repair) {
    let of_rule = |rows: &[Row], rule: Rule| -> usize {
        // One finding stands for all that lie in one place.
        let count = |row: &Row| match rule {
            Rule::DuplicateEntity => row.related.len().max(1),
            Rule::ArcAsChords => row.related.len() + 1,
            _ => 1,
        };
        let own = rows.iter().filter(|row| row.rule == rule);
        own.map(count).sum()
    };
    let repaired = repaired_rules().filter_map(|(rule, counted)| {
        let count = of_rule(&repair.before, rule).saturating_sub(of_rule(&repair.after, rule));
        (count > 0).then(|| counted(&count))
    });
    let repaired = repaired.collect::<Vec<_>>().join(say!(comma));
    let is_sound = (REPAIRED.into_iter()).all(|rule| of_rule(&repair.before, rule) == 0);
    let name = output::name(path);
    for line in &repair.made {
        output::say(&say!(says, name, line));
    }
    if !repaired.is_empty() {
        let rounds = if repair.rounds > 1 {
            say!(in_rounds, repair.rounds)
        } else {
            String::new()
        };
        let repaired = styled(output::GOOD, say!(repaired, repaired));
        output::say(&say!(says, name, format!("{repaired}{rounds}")));
    } else if repair.is_changed() {
        let repaired = styled(output::GOOD, say!(repaired, say!(findings, repair.gone)));
        output::say(&say!(says, name, repaired));
    } else if is_sound {
        output::say(&say!(nothing_to_repair, name));
    } else {
        output::say(&say!(nothing_could_be_repaired_safely, name));
    }
    let place = |row: &Row| format!("{name}:{}:{}", row.span.line, row.span.column);
    for (row, reason) in &repair.refused {
        let reason = readable(reason);
        let why = say!(says, place(row), say!(says, row.message, reason));
        let heading = styled(output::WARNING, say!(not_repaired));
        output::say(&say!(says, heading, why));
    }
    let is_refused = |row: &Row| {
        repair.refused.iter().any(|(other, _)| {
            let begin = |row: &Row| (row.rule, row.span.line, row.span.column);
            begin(other) == begin(row)
        })
    };
    let is_left = |row: &&Row| row.severity <= Severity::Warning && !is_refused(row);
    let left: Vec<&Row> = repair.after.iter().filter(is_left).collect();
    if left.len() > LEFT {
        let mut rules: Vec<Rule> = left.iter().map(|row| row.rule).collect();
        rules.sort_unstable();
        let counts = rules
            .chunk_by(|one, other| one == other)
            .map(|same| format!("{} {}", same.len(), same[0].name()))
            .collect::<Vec<_>>()
            .join(say!(comma));
        let heading = styled(output::WARNING, say!(left));
        let counts = say!(left_in_all, counts, output::word(path));
        output::say(&say!(says, heading, counts));
        return;
    }
    for row in left {
        let reason = match &row.data.no_fix {
            None if row.rule == Rule::SmallRadius => {
                say!(its_fix_moves_the_contour_by_more_than_the_correction)
            }
            _ => "",
        };
        let what = say!(says, place(row), format!("{}{reason}", row.message));
        output::say(&say!(says, styled(output::WARNING, say!(left)), what));
    }
    for (line, titles) in &repair.choices {
        let place = format!("{name}:{line}");
        output::say(&say!(says, place, say!(one_of_these_may_be_meant, titles)));
    }
}
