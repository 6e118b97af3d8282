//! `wedm check`: diagnostics of files and folders.

mod sarif;
mod text;

use super::files::{self, Opened};
use super::options::Common;
use super::report::{self, Row};
use super::{Failure, Verdict, output};
use crate::finding::Severity;
use crate::settings::Settings;
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Say what is wrong in drawings and programs
///
/// Folders are searched for .dxf, .dxb, .3b, .4b, .iso and .nc. Ends with 0 when no error was found, with 1 when one was, and with 2
/// when something could not be read.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm check plate.dxf
  wedm check --correction 0.12 --side opening drawings/
  wedm check --output sarif drawings/ > findings.sarif
  wedm check --deny warning plate.dxf program.3b")]
pub struct Arguments {
    /// Files, and folders to search
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// Form of what is printed
    #[arg(long, value_enum, default_value_t = Format::Text)]
    output: Format,
    /// End with 1 also for findings of this severity
    #[arg(long, value_enum, value_name = "SEVERITY")]
    deny: Option<Deny>,
    #[command(flatten)]
    common: Common,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    Text,
    Json,
    Sarif,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Deny {
    Warning,
}

/// What became of one file.
struct Checked {
    rows: Vec<Row>,
    /// Some of it is repaired by `wedm fix`.
    fixable: bool,
    failure: Option<Failure>,
}

/// All that was looked at.
struct Survey {
    files: usize,
    rows: Vec<Row>,
    fixable: Vec<PathBuf>,
    failures: Vec<Failure>,
}

pub fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let survey = survey(arguments);
    match arguments.output {
        Format::Text => output::print(text::render(&survey))?,
        Format::Json => output::print_json(&serde_json::json!({ "diagnostics": survey.rows }))?,
        Format::Sarif => output::print_json_text(&format!("{:#}\n", sarif::log(&survey)))?,
    }
    survey
        .failures
        .iter()
        .for_each(|Failure(sentence)| output::complain(sentence));
    Ok(verdict(&survey, arguments.deny))
}

fn verdict(survey: &Survey, deny: Option<Deny>) -> Verdict {
    let limit = match deny {
        Some(Deny::Warning) => Severity::Warning,
        None => Severity::Error,
    };
    let worst = survey.rows.iter().map(|row| row.severity).min();
    match worst {
        _ if !survey.failures.is_empty() => Verdict::Failed,
        Some(severity) if severity <= limit => Verdict::Errors,
        _ => Verdict::Clean,
    }
}

fn survey(arguments: &Arguments) -> Survey {
    let found = files::search(&arguments.paths);
    let settings = arguments.common.settings();
    let progress = progress(found.files.len());
    let check_and_count = |path: &PathBuf| {
        let checked = check(path, &arguments.common, &settings);
        progress.inc(1);
        checked
    };
    let checked: Vec<Checked> = found.files.par_iter().map(check_and_count).collect();
    progress.finish_and_clear();
    let mut survey = Survey {
        files: 0,
        rows: Vec::new(),
        fixable: Vec::new(),
        failures: found.failures,
    };
    for (path, file) in found.files.into_iter().zip(checked) {
        survey.files += usize::from(file.failure.is_none());
        survey.failures.extend(file.failure);
        survey.rows.extend(file.rows);
        if file.fixable {
            survey.fixable.push(path);
        }
    }
    // Several drawings may share one faulty settings file: it is said once.
    let mut said = std::collections::HashSet::new();
    let of_settings = [
        crate::finding::Rule::Settings,
        crate::finding::Rule::PassOrder,
    ];
    survey.rows.retain(|row| {
        !of_settings.contains(&row.rule)
            || said.insert((row.path.clone(), row.line, row.message.clone()))
    });
    survey
}

fn check(path: &Path, common: &Common, settings: &Settings) -> Checked {
    match files::open(path, common, settings) {
        Err(failure) => Checked {
            rows: Vec::new(),
            fixable: false,
            failure: Some(failure),
        },
        Ok(Opened {
            path,
            mut document,
            settings_rows,
            ..
        }) => {
            let mut rows = settings_rows;
            rows.extend(report::rows(&path, &mut document));
            Checked {
                rows,
                fixable: document.can_be_fixed(),
                failure: None,
            }
        }
    }
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
