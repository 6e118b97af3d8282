//! `wedm format`: programs in their layout, with the same blocks.

use super::changes::print_diff;
use super::options::{Common, Words, parser, row};
use super::output::{self, STRONG, styled};
use super::{Failure, Verdict, ending, files};
use crate::compare::is_program;
use crate::finding::Rule;
use crate::program;
use crate::settings::Settings;
use crate::text::edited;
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm format plate.3b                     the formatted program, to stdout
  wedm format --check programs/            which ones are not in their layout
  wedm format --in-place --layout compact plate.3b")]
pub(crate) struct Arguments {
    #[arg(value_name = "PATH", required = true)]
    paths: Vec<PathBuf>,
    #[command(flatten)]
    target: Target,
    #[arg(long, requires = "output")]
    overwrite: bool,
    #[arg(long, value_parser = parser(row("program.layout")))]
    layout: Option<Settings>,
    #[command(flatten)]
    words: Words,
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
}

#[derive(Args, Debug)]
#[group(multiple = false)]
struct Target {
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[arg(long)]
    in_place: bool,
    #[arg(long)]
    check: bool,
    #[arg(long)]
    diff: bool,
}

impl Target {
    /// True for a single program, which is written out as a whole.
    fn is_one(&self) -> bool {
        !(self.in_place || self.check || self.diff)
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let target = &arguments.target;
    let files::Found {
        mut files,
        failures,
    } = files::search(&arguments.paths, &files::Search::default());
    // Folders hold drawings, too; a drawing that is named explicitly is refused.
    files.retain(|path| arguments.paths.contains(path) || is_program(path));
    if target.is_one() && !failures.is_empty() {
        failures
            .iter()
            .for_each(|Failure(sentence)| output::complain(sentence));
        return Ok(Verdict::Failed);
    }
    if target.is_one() && (files.len() != 1 || arguments.paths.len() != 1) {
        return Err(Failure(say!(
            several_files_are_found,
            say!(programs, files.len())
        )));
    }
    let mut verdict = Verdict::Clean;
    for Failure(sentence) in &failures {
        output::complain(sentence);
        verdict = Verdict::Failed;
    }
    let (mut changed, mut unchanged) = (0, 0);
    for path in &files {
        match format(arguments, path) {
            Ok(true) => changed += 1,
            Ok(false) => unchanged += 1,
            Err(Failure(sentence)) => {
                output::complain_once(&sentence);
                verdict = Verdict::Failed;
            }
        }
    }
    if !target.is_one() {
        let programs = say!(programs, changed);
        output::say(&if target.in_place {
            say!(programs_formatted, programs, unchanged)
        } else {
            say!(programs_would_be_formatted, programs, unchanged)
        });
    }
    let differs = changed > 0 && (target.check || target.diff);
    Ok(verdict.max(Verdict::of_errors(differs)))
}

/// Formats one program and delivers it; true where it was not in its layout.
fn format(arguments: &Arguments, path: &Path) -> Result<bool, Failure> {
    let common = Common {
        config: arguments.config.clone(),
        ..Common::default()
    };
    if arguments.target.in_place {
        output::refuse_irregular(path)?;
    }
    let layout = arguments.layout.clone().unwrap_or_default();
    let last = arguments.words.0.overlaid(&layout);
    let opened = files::open_to_use(path, arguments.target.output.as_deref(), &common, &last)?;
    if let Some(target) = &arguments.target.output {
        ending::as_read(&opened, target)?;
    }
    let settings = opened.document.settings().clone();
    let program = opened.program()?;
    let text = program.text();
    let edits = program::format(program, &settings, 0..text.line_count());
    let before = text.bytes();
    let after = edited(before, &edits)
        .ok_or_else(|| Failure::of(path, say!(internal_error, say!(the_edits_overlap))))?;
    let is_changed = after != before;
    let target = &arguments.target;
    if target.diff {
        print_diff(path, before, &after, opened.writing)?;
    } else if target.check {
        if is_changed {
            output::print(format!(
                "{} {}\n",
                styled(STRONG, say!(would_be_formatted_heading)),
                output::name(path)
            ))?;
        }
    } else if !target.in_place {
        let bytes = opened.writing.written(&after);
        output::write(target.output.as_deref(), &bytes, arguments.overwrite)?;
    } else if is_changed {
        output::write_over(path, opened.seen.as_ref(), &opened.writing.written(&after))?;
    }
    let findings = opened.document.all_findings();
    // Even where the meaning is plain and the block was read, its text is damaged.
    let is_of_text =
        |rule: Rule| matches!(rule, Rule::Syntax | Rule::MissingB | Rule::BlockNumberAsB);
    let damaged = findings
        .iter()
        .filter(|finding| is_of_text(finding.rule))
        .count();
    if damaged > 0 {
        output::say(&say!(
            left_as_they_stand,
            output::name(path),
            say!(lines, damaged)
        ));
    }
    Ok(is_changed)
}
