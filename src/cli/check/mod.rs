//! `wedm check`: diagnostics of files and folders.

mod lines;
mod sarif;
mod text;
mod watch;

use super::beside::Folders;
use super::explain::rule_name;
use super::files::{self, Opened};
use super::options::Common;
use super::report::{MOST, Row};
use super::{Failure, Verdict, output, output::styled};
use crate::disk::Fence;
use crate::document::FileKind;
use crate::finding::{Rule, Severity};
use crate::job;
use crate::message::help;
use crate::protocol::Against;
use crate::settings::{self, Settings};
use crate::text::SourceText;
use crate::view::Counts;
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use serde::Serialize;
use std::path::{Path, PathBuf};

#[derive(Args, Debug, Default)]
#[command(after_help = "\
Examples:
  wedm check plate.dxf
  wedm check --correction 0.12 --side opening drawings/
  wedm check --output concise --ignore sharp-corner,near-tangent
  wedm check --statistics --exclude 'old/**' drawings/
  wedm check --output sarif drawings/ > findings.sarif
  wedm check --deny warning plate.dxf program.3b
  generate-plate | wedm check -
  generate-plate | wedm check - --stdin-name drawings/plate.dxf")]
pub(crate) struct Arguments {
    #[arg(value_name = "PATH", default_value = ".")]
    paths: Vec<PathBuf>,
    #[arg(long, value_enum)]
    output: Option<Format>,
    #[arg(long)]
    statistics: bool,
    #[arg(long, value_name = "RULE", value_delimiter = ',', value_parser = rule_name(), hide_possible_values = true)]
    select: Vec<Rule>,
    #[arg(long, value_name = "RULE", value_delimiter = ',', value_parser = rule_name(), hide_possible_values = true)]
    ignore: Vec<Rule>,
    #[arg(long, value_name = "PATTERN")]
    exclude: Vec<String>,
    #[arg(long)]
    no_ignore: bool,
    #[arg(long, value_name = "NAME")]
    stdin_name: Option<PathBuf>,
    #[arg(long)]
    watch: bool,
    #[arg(long)]
    show_suppressed: bool,
    #[arg(long, value_enum, value_name = "SEVERITY")]
    deny: Option<Deny>,
    #[command(flatten)]
    common: Common,
}

impl Arguments {
    fn search(&self) -> files::Search<'_> {
        files::Search {
            exclude: &self.exclude,
            all: self.no_ignore,
            depth: None,
        }
    }

    /// True where only some rules are selected: `wedm fix` applies all of them.
    fn is_choosy(&self) -> bool {
        !self.select.is_empty() || !self.ignore.is_empty()
    }

    /// True for a finding of a selected rule, and for the error of a file that could not be judged.
    fn wants(&self, row: &Row) -> bool {
        let is_unread = row.severity == Severity::Error
            && matches!(row.rule, Rule::Syntax | Rule::Settings | Rule::NotJudged);
        let selected = self.select.is_empty() || self.select.contains(&row.rule) || is_unread;
        selected && !self.ignore.contains(&row.rule)
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    Text,
    #[value(help = help("check output concise"))]
    Concise,
    #[value(help = help("check output grouped"))]
    Grouped,
    Json,
    Sarif,
    #[value(help = help("check output github"))]
    Github,
    #[value(help = help("check output junit"))]
    Junit,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Deny {
    Warning,
}

/// The result for one file.
#[derive(Default)]
struct Checked {
    rows: Vec<Row>,
    suppressed: Vec<Row>,
    /// `wedm fix` repairs some of it.
    fixable: bool,
    failure: Option<Failure>,
    /// The address of the rules' pages.
    docs_url: Option<String>,
    /// What a drawing was judged against.
    against: Option<Against>,
    /// What a drawing without contours holds.
    empty: Option<String>,
}

/// The findings as JSON.
#[derive(Serialize)]
struct Printed<'a> {
    diagnostics: &'a [Row],
    #[serde(skip_serializing_if = "Option::is_none")]
    suppressed: Option<&'a Vec<Row>>,
    against: Vec<PrintedAgainst<'a>>,
}

/// What one drawing was judged against.
#[derive(Serialize)]
struct PrintedAgainst<'a> {
    path: String,
    #[serde(flatten)]
    against: &'a Against,
}

/// Everything that was checked.
struct Survey {
    files: usize,
    rows: Vec<Row>,
    /// Suppressed findings do not count.
    suppressed: Vec<Row>,
    shows_suppressed: bool,
    fixable: Vec<PathBuf>,
    failures: Vec<Failure>,
    docs_url: Option<String>,
    against: Vec<(PathBuf, Against)>,
    /// Drawings without contours, and what they hold.
    empty: Vec<(PathBuf, String)>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    if !arguments.watch {
        return report(arguments);
    }
    if arguments.paths.iter().any(|path| path == Path::new("-")) {
        return Err(Failure(say!(stdin_is_not_watched).into()));
    }
    match watch::run(arguments)? {}
}

fn report(arguments: &Arguments) -> Result<Verdict, Failure> {
    let survey = survey(arguments);
    match arguments.output {
        _ if arguments.statistics => {
            output::print(lines::statistics(&survey) + &text::summary(&survey))?
        }
        None => output::print(text::render(&survey))?,
        Some(format) => printed(arguments, format, &survey)?,
    }
    survey
        .failures
        .iter()
        .for_each(|Failure(sentence)| output::complain(sentence));
    if survey.files == 0 && survey.failures.is_empty() {
        let warning = styled(output::WARNING, say!(warning));
        let endings: Vec<String> = FileKind::endings()
            .map(|ending| format!(".{ending}"))
            .collect();
        let sentence = say!(no_document_is_found, endings.join(say!(comma)));
        output::say(&say!(says, warning, sentence));
    }
    Ok(verdict(&survey, arguments.deny))
}

/// In one of the forms that can be chosen.
fn printed(arguments: &Arguments, format: Format, survey: &Survey) -> Result<(), Failure> {
    match format {
        Format::Text => output::print(text::excerpts(survey)),
        Format::Concise => output::print(lines::concise(survey) + &text::summary(survey)),
        Format::Grouped => output::print(lines::grouped(survey) + &text::summary(survey)),
        Format::Github => output::print(lines::github(survey)),
        Format::Junit => output::print(lines::junit(survey, limit(arguments.deny))),
        Format::Json => output::print_json(&Printed {
            diagnostics: &survey.rows,
            suppressed: survey.shows_suppressed.then_some(&survey.suppressed),
            against: (survey.against.iter())
                .map(|(path, against)| PrintedAgainst {
                    path: path.display().to_string(),
                    against,
                })
                .collect(),
        }),
        Format::Sarif => output::print_json_text(&format!("{:#}\n", sarif::log(survey))),
    }
}

/// The slightest severity that the command ends with 1 for.
fn limit(deny: Option<Deny>) -> Severity {
    match deny {
        Some(Deny::Warning) => Severity::Warning,
        None => Severity::Error,
    }
}

fn verdict(survey: &Survey, deny: Option<Deny>) -> Verdict {
    let limit = limit(deny);
    let worst = survey.rows.iter().map(|row| row.severity).min();
    match worst {
        _ if !survey.failures.is_empty() => Verdict::Failed,
        Some(severity) if severity <= limit => Verdict::Errors,
        _ => Verdict::Clean,
    }
}

fn survey(arguments: &Arguments) -> Survey {
    let found = files::search(&arguments.paths, &arguments.search());
    let settings = arguments.common.settings();
    let progress = progress(found.files.len());
    let folders = Folders::default();
    let is_last = found.files.len() == 1 && !arguments.watch;
    let check_and_count = |path: &PathBuf| {
        let checked = check(path, arguments, &settings, &folders, is_last);
        progress.inc(1);
        checked
    };
    let checked = largest_first(&found.files, check_and_count);
    progress.finish_and_clear();
    let mut survey = Survey {
        files: 0,
        rows: Vec::new(),
        suppressed: Vec::new(),
        shows_suppressed: arguments.show_suppressed,
        fixable: Vec::new(),
        failures: found.failures,
        docs_url: None,
        against: Vec::new(),
        empty: Vec::new(),
    };
    for (path, file) in found.files.into_iter().zip(checked) {
        survey.files += usize::from(file.failure.is_none());
        // An option that does not fit is the fault of no file, and said once.
        let failure = file
            .failure
            .filter(|failure| !survey.failures.contains(failure));
        survey.failures.extend(failure);
        survey.rows.extend(file.rows);
        survey.suppressed.extend(file.suppressed);
        survey.docs_url = survey.docs_url.or(file.docs_url);
        let named = |path: &PathBuf| files::shown(path).to_path_buf();
        (survey.against).extend(file.against.map(|against| (named(&path), against)));
        (survey.empty).extend(file.empty.map(|holds| (named(&path), holds)));
        if file.fixable {
            survey.fixable.push(path);
        }
    }
    // Several drawings may share one faulty settings file: it is reported once.
    let mut said = std::collections::HashSet::new();
    let of_settings = [Rule::Settings, Rule::PassOrder];
    survey.rows.retain(|row| arguments.wants(row));
    survey.suppressed.retain(|row| arguments.wants(row));
    survey.rows.retain(|row| {
        !of_settings.contains(&row.rule)
            || said.insert((row.path.clone(), row.span.line, row.message.clone()))
    });
    survey
}

/// The result for each file, in their order. The largest are begun first, spread over all cores: if
/// a large one began last, the other cores would wait for it.
fn largest_first<T: Send>(files: &[PathBuf], of: impl Fn(&PathBuf) -> T + Sync) -> Vec<T> {
    let size = |file: &PathBuf| std::fs::metadata(file).map_or(0, |about| about.len());
    let mut order: Vec<usize> = (0..files.len()).collect();
    order.sort_by_cached_key(|&index| std::cmp::Reverse(size(&files[index])));
    // Shared out in chunks, as other lists are, small files would be begun before large ones.
    let each = order.into_iter().par_bridge();
    let mut made: Vec<(usize, T)> = each.map(|index| (index, of(&files[index]))).collect();
    made.sort_unstable_by_key(|(index, _)| *index);
    made.into_iter().map(|(_, made)| made).collect()
}

/// The findings of a file; after the last file the process ends.
fn check(
    path: &Path,
    arguments: &Arguments,
    settings: &Settings,
    folders: &Folders,
    is_last: bool,
) -> Checked {
    let (common, stdin) = (&arguments.common, path == Path::new("-"));
    let given = arguments.stdin_name.as_deref();
    let name = if stdin {
        given.unwrap_or(Path::new("stdin"))
    } else {
        path
    };
    let checked = |opened: Opened| {
        let (mut document, mut rows) = (opened.document, opened.settings_rows);
        document.set_beside(folders.beside(name, &document, common, settings));
        let (findings, count) = job::check(&mut document, MOST);
        rows.extend(super::report::rows_of(name, &document, &findings));
        let all = (count <= MOST).then_some(&*findings);
        let checked = Checked {
            rows,
            suppressed: super::report::suppressed(name, &document),
            // Text from stdin is in no file that could be repaired, and deselected rules are not mentioned.
            fixable: !stdin && !arguments.is_choosy() && document.can_be_fixed(all),
            failure: None,
            docs_url: document.settings().docs_url.clone(),
            against: Against::of(&document),
            empty: files::holds_no_contour(&document),
        };
        let is_lost = document.text().is_some_and(SourceText::is_lost);
        if is_last {
            // Freeing all memory piece by piece takes longer than ending.
            std::mem::forget(document);
        }
        (!is_lost).then_some(checked)
    };
    let once = || {
        let opened = if stdin {
            files::open_stdin(given, name, common, settings)?
        } else {
            files::open_to_check(name, common, settings)?
        };
        match checked(opened) {
            Some(checked) => Ok(checked),
            // The file has been written to meanwhile.
            None => Ok(checked(files::open(name, common, settings)?).unwrap_or_default()),
        }
    };
    once().unwrap_or_else(|failure| Checked {
        failure: Some(failure),
        ..Checked::default()
    })
}

/// Errors and warnings of a file, as the command finds them; the drawings and programs beside it are read within the fence.
pub(crate) fn count(path: &Path, fence: &Fence) -> Result<Counts, String> {
    let arguments = Arguments::default();
    let rows = match path.file_name() == Some(settings::FILE_NAME.as_ref()) {
        true => {
            // It holds for itself, too.
            let read = files::settings_for(path, &arguments.common, &Settings::default());
            read.map_err(|Failure(sentence)| sentence)?.1
        }
        false => {
            let folders = Folders::within(fence);
            let checked = check(path, &arguments, &Settings::default(), &folders, false);
            if let Some(Failure(sentence)) = checked.failure {
                return Err(sentence);
            }
            checked.rows
        }
    };
    let mut counts = Counts::default();
    for row in rows.iter().filter(|row| arguments.wants(row)) {
        counts.errors += usize::from(row.severity == Severity::Error);
        counts.warnings += usize::from(row.severity == Severity::Warning);
    }
    Ok(counts)
}

/// Shown on a terminal only, and only where there is something to wait for.
fn progress(files: usize) -> ProgressBar {
    if files < 2 {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(files as u64);
    match ProgressStyle::with_template("{bar:32} {pos}/{len} files") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
