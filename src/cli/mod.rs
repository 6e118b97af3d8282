//! The command line: the options of each command, its output, and its exit code.
//!
//! One file a command. Nothing is decided here: reading, rules, fixes and programs are those of the floors below, and
//! JSON output has the types of [`crate::protocol`].

mod beside;
mod calibrate;
mod changes;
mod check;
mod completions;
mod config;
mod contours;
mod convert;
mod demo;
mod draw;
mod ending;
mod excerpt;
mod explain;
mod files;
mod fit;
mod fix;
mod format;
mod generate;
mod help;
mod holes;
mod init;
mod inspect;
mod lisp;
mod man;
mod options;
mod output;
mod pages;
mod pair;
mod report;
mod serve;
mod simulate;
mod view;

use crate::disk::ending_of;
use crate::document::FileKind;
use crate::message::{Asker, Language, help_beside, is_hidden, readable, speak, speak_of_options};
use clap::builder::PossibleValue;
use clap::error::ErrorKind;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;
use std::fmt::Display;
use std::path::Path;
use std::process::ExitCode;

#[derive(Debug, Parser)]
#[command(
    name = "wedm",
    version,
    max_term_width = 100,
    args_conflicts_with_subcommands = true
)]
struct CommandLine {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    server: serve::Arguments,
    #[arg(long, global = true, value_name = "LANGUAGE", value_parser = Language::ALL.map(tag))]
    lang: Option<String>,
}

/// The tag of a language, and its other names in editors and environments.
fn tag(language: Language) -> PossibleValue {
    PossibleValue::new(language.tag()).aliases(language.aliases())
}

#[derive(Debug, Subcommand)]
enum Command {
    Check(check::Arguments),
    Fix(fix::Arguments),
    Format(format::Arguments),
    Generate(generate::Arguments),
    Pair(pair::Arguments),
    Fit(fit::Arguments),
    Holes(holes::Arguments),
    Inspect(inspect::Arguments),
    Draw(draw::Arguments),
    Contours(contours::Arguments),
    Convert(convert::Arguments),
    Simulate(simulate::Arguments),
    Report(pages::Arguments),
    Explain(explain::Arguments),
    Init(init::Arguments),
    Calibrate(calibrate::Arguments),
    Config(config::Arguments),
    View(view::Arguments),
    Demo(demo::Arguments),
    Serve(serve::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Verdict {
    /// Nothing to object to.
    Clean,
    /// The drawing has errors.
    Errors,
    /// Something could not be read, or the usage was wrong.
    Failed,
}

impl Verdict {
    fn of_errors(are_there: bool) -> Verdict {
        if are_there {
            Verdict::Errors
        } else {
            Verdict::Clean
        }
    }

    fn code(self) -> u8 {
        match self {
            Verdict::Clean => 0,
            Verdict::Errors => 1,
            Verdict::Failed => 2,
        }
    }
}

/// Why a command failed: one sentence in lower case without a full stop.
#[derive(Debug, PartialEq)]
struct Failure(String);

impl Failure {
    /// A fault of a file.
    fn of(path: &Path, reason: impl Display) -> Failure {
        Failure(say!(says, path.display(), reason.to_string()))
    }
}

/// The arguments of the command line. A leading `--lang` is moved after the command, where it is
/// declared.
fn words() -> Vec<OsString> {
    let mut words: Vec<OsString> = std::env::args_os().collect();
    let leading = match words.get(1).map(|word| word.to_string_lossy()) {
        Some(word) if word == "--lang" => 2,
        Some(word) if word.starts_with("--lang=") => 1,
        _ => 0,
    };
    let command = words.get(leading + 1);
    if command.is_some_and(|command| !command.to_string_lossy().starts_with('-')) {
        words[1..=leading + 1].rotate_left(leading);
    }
    words
}

/// Chooses the language of `--lang`, else of the environment, before the options are read, since a
/// refusal is worded in that language.
fn choose_language(words: &[OsString]) {
    if let Some(language) = Language::of_environment(|name| std::env::var(name).ok()) {
        speak(language, Asker::Environment);
    }
    let words: Vec<_> = words.iter().map(|word| word.to_string_lossy()).collect();
    let asked = words.windows(2).find_map(|pair| match &*pair[0] {
        "--lang" => Some(&*pair[1]),
        _ => pair[1].strip_prefix("--lang="),
    });
    if let Some(language) = asked.and_then(Language::of) {
        speak(language, Asker::CommandLine);
    }
}

/// All commands, with their help in the language that is spoken.
fn command() -> clap::Command {
    help::explained(CommandLine::command())
}

/// A file or folder where a command is expected.
fn file_for_a_command(words: &[OsString]) -> Option<&Path> {
    let first = Path::new(words.get(1)?);
    let is_file = FileKind::of_ending(&ending_of(first)).is_some() || first.exists();
    is_file.then_some(first)
}

/// Runs the command of this process.
pub fn run() -> ExitCode {
    let words = words();
    choose_language(&words);
    // The help is only needed where this fails.
    let parsed = CommandLine::command().try_get_matches_from(&words);
    let parsed = parsed.or_else(|_| command().try_get_matches_from(&words));
    let parsed = parsed.and_then(|matches| CommandLine::from_arg_matches(&matches));
    let arguments = parsed.unwrap_or_else(|error| {
        if error.kind() == ErrorKind::DisplayHelp {
            let shown = help_beside(error.render().ansi().to_string());
            let code = output::print(shown).map_or(Verdict::Failed, |()| Verdict::Clean);
            std::process::exit(code.code().into());
        }
        if let Some(file) =
            file_for_a_command(&words).filter(|_| error.kind() == ErrorKind::InvalidSubcommand)
        {
            output::complain(&say!(a_file_is_no_command, output::word(file)));
            std::process::exit(Verdict::Failed.code().into());
        }
        let translated = help::refusal(&error).filter(|_| error.use_stderr());
        // Words in the message may be file names that a shell has put there.
        let has_hidden = std::env::args_os().any(|word| word.to_string_lossy().contains(is_hidden));
        if translated.is_some() || (has_hidden && error.use_stderr()) {
            let text = translated.unwrap_or_else(|| error.to_string());
            let lines: Vec<_> = text.trim_end().lines().map(readable).collect();
            output::say(&(lines.join("\n") + "\n"));
            std::process::exit(Verdict::Failed.code().into());
        }
        error.exit()
    });
    if !matches!(arguments.command, None | Some(Command::Serve(_))) {
        speak_of_options();
    }
    let outcome = match arguments.command {
        None if arguments.server.is_asked_by_nobody() => {
            output::print(help_beside(command().render_help().ansi().to_string()))
                .map(|()| Verdict::Clean)
        }
        None => return serve::run(&arguments.server),
        Some(Command::Serve(arguments)) => return serve::run(&arguments),
        Some(Command::Check(arguments)) => check::run(&arguments),
        Some(Command::Fix(arguments)) => fix::run(&arguments),
        Some(Command::Format(arguments)) => format::run(&arguments),
        Some(Command::Generate(arguments)) => generate::run(&arguments),
        Some(Command::Pair(arguments)) => pair::run(&arguments),
        Some(Command::Fit(arguments)) => fit::run(&arguments),
        Some(Command::Holes(arguments)) => holes::run(&arguments),
        Some(Command::Inspect(arguments)) => inspect::run(&arguments),
        Some(Command::Draw(arguments)) => draw::run(&arguments),
        Some(Command::Contours(arguments)) => contours::run(&arguments),
        Some(Command::Convert(arguments)) => convert::run(&arguments),
        Some(Command::Simulate(arguments)) => simulate::run(&arguments),
        Some(Command::Report(arguments)) => pages::run(&arguments),
        Some(Command::Explain(arguments)) => explain::run(&arguments),
        Some(Command::Init(arguments)) => init::run(&arguments),
        Some(Command::Calibrate(arguments)) => calibrate::run(&arguments),
        Some(Command::Config(arguments)) => config::run(&arguments),
        Some(Command::View(arguments)) => view::run(&arguments),
        Some(Command::Demo(arguments)) => demo::run(&arguments),
        Some(Command::Completions(arguments)) => completions::run(&arguments, &mut command()),
        Some(Command::Man(arguments)) => man::run(&arguments, command()),
    };
    let verdict = outcome.unwrap_or_else(|Failure(sentence)| {
        output::complain(&sentence);
        Verdict::Failed
    });
    ExitCode::from(verdict.code())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_commands_are_declared_without_contradiction() {
        CommandLine::command().debug_assert();
    }
}
