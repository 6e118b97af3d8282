//! The help of the command line: its texts are in `message/`, by the names of commands and options.

use super::options::{row_of_option, shown_default};
use crate::message::help;
use clap::error::ContextKind;
use clap::{Arg, Command, Error};
use std::error::Error as _;

/// The command with its help in the language in force.
pub(super) fn explained(mut command: Command) -> Command {
    // `clap` has only English for the rest: the options that it adds, headings, refusals.
    if help("help").is_some() {
        command.build();
    }
    explain(command)
}

fn explain(mut command: Command) -> Command {
    let name = command.get_name().to_owned();
    if let Some(usage) = help("heading Usage") {
        command = command.help_template(format!(
            "{{about-with-newline}}\n{usage}{{usage}}\n\n{{all-args}}{{after-help}}"
        ));
    }
    if let Some(heading) = help("heading Commands") {
        command = command.subcommand_help_heading(heading);
    }
    if let Some(about) = help(&name) {
        command = command.about(about);
        if let Some(more) = help(&format!("{name}/")) {
            command = command.long_about(format!("{about}\n\n{more}"));
        }
    }
    let first = help("wedm-examples").and_then(|all| all.lines().next());
    let declared = command.get_after_help().map(ToString::to_string);
    let declared = declared.map(|all| all.replacen("Examples:", first.unwrap_or_default(), 1));
    if let Some(examples) = help(&format!("{name}-examples"))
        .map(str::to_owned)
        .or(declared)
    {
        command = command.after_help(examples);
    }
    command
        .mut_args(|argument| explain_argument(&name, argument))
        .mut_subcommands(explain)
}

fn explain_argument(command: &str, mut argument: Arg) -> Arg {
    let id = argument.get_id().to_string();
    let heading = match argument.get_help_heading() {
        Some(heading) => format!("heading {heading}"),
        None if argument.is_positional() => "heading Arguments".to_owned(),
        None => "heading Options".to_owned(),
    };
    let of_settings = match argument.get_help_heading() {
        Some(_) if id != "config" => row_of_option(&id),
        _ => None,
    };
    let text = match of_settings {
        // A fit goes by what is stated of the wire, and without that the correction has its own default.
        Some(row) if heading == "heading Pair" || ["wire-diameter", "gap"].contains(&&*row.key) => {
            Some(row.first_sentence())
        }
        Some(row) => Some(row.first_sentence() + &shown_default(row)),
        None if id == "config" => help("config-file").map(str::to_owned),
        None => help(&format!("{command} {id}"))
            .or_else(|| help(&id))
            .map(str::to_owned),
    };
    if let Some(heading) = help(&heading) {
        argument = argument.help_heading(heading);
    }
    match text {
        // `clap` gives an option of its own a longer text, too.
        Some(text) => argument.long_help(None::<&str>).help(text),
        None => argument,
    }
}

/// What is wrong with the words that the process was called with; `None` in English, the language of `clap` itself.
pub(super) fn refusal(error: &Error) -> Option<String> {
    let value = |kind| error.get(kind).map(ToString::to_string);
    let row = match value(ContextKind::InvalidValue) {
        Some(none) if none.is_empty() => "NoValue".to_owned(),
        _ => format!("{:?}", error.kind()),
    };
    let mut sentence = help(&format!("refused {row}"))?.to_owned();
    for (kind, value) in error.context() {
        sentence = sentence.replace(&format!("{{{kind:?}}}"), &value.to_string());
    }
    let source = error.source().map_or_else(String::new, ToString::to_string);
    let mut text = format!(
        "{}{}",
        help("refused")?,
        sentence.replace("{source}", &source)
    );
    for kind in [
        ContextKind::ValidValue,
        ContextKind::ValidSubcommand,
        ContextKind::SuggestedArg,
        ContextKind::SuggestedSubcommand,
        ContextKind::SuggestedValue,
    ] {
        if let (Some(heading), Some(value)) = (help(&format!("refused {kind:?}")), value(kind))
            && !value.is_empty()
        {
            text += &format!("\n  {heading}{value}");
        }
    }
    if let Some(usage) = value(ContextKind::Usage) {
        let usage = usage.trim_start_matches("Usage:").trim();
        text += &format!("\n\n{}{usage}", help("heading Usage")?);
    }
    Some(format!("{text}\n\n{}", help("refused-more")?))
}

#[cfg(test)]
mod tests {
    use super::super::CommandLine;
    use super::*;
    use crate::message::{Asker, Language, help_names, speak};
    use crate::settings::rows;
    use clap::CommandFactory;
    use std::collections::BTreeSet;

    /// Hands each text of a help to `each`, with the names under which it may be.
    fn texts(command: &Command, each: &mut dyn FnMut(Vec<String>, Option<String>)) {
        let name = command.get_name();
        let about = command.get_long_about().or(command.get_about());
        let names = [name.to_owned(), format!("{name}/")].to_vec();
        each(names, about.map(ToString::to_string));
        for argument in command.get_arguments() {
            let (id, help) = (argument.get_id().as_str(), argument.get_help());
            let names = match row_of_option(id) {
                Some(_) if argument.get_help_heading().is_some() => Vec::new(),
                _ if id == "config" => vec!["config-file".to_owned()],
                _ => vec![format!("{name} {id}"), id.to_owned()],
            };
            each(names, help.map(ToString::to_string));
        }
        command.get_subcommands().for_each(|one| texts(one, each));
    }

    /// No help stands in `src/cli`, all of it has a row in English, and each row belongs to something.
    #[test]
    fn all_help_is_in_its_table() {
        texts(&CommandLine::command(), &mut |names, text| {
            assert_eq!(text, None, "{names:?} belongs into src/message/en/help.rs");
        });
        let mut asked: BTreeSet<String> = BTreeSet::new();
        texts(&explained(CommandLine::command()), &mut |names, text| {
            assert!(
                text.is_some(),
                "no row in src/message/en/help.rs of {names:?}"
            );
            asked.extend(names);
        });
        for name in help_names(Language::English) {
            let of_command = name.strip_suffix("-examples");
            let is_asked = asked.contains(of_command.unwrap_or(name));
            let is_word = name.starts_with("check output ");
            assert!(is_asked || is_word, "{name:?} is the help of nothing");
        }
        explained(CommandLine::command()).debug_assert();
    }

    /// Chinese has the rows of English, and those for what `clap` says by itself.
    #[test]
    fn all_help_has_its_twin() {
        let by_clap = |name: &str| {
            name.starts_with("heading ")
                || name.starts_with("refused")
                || ["help", "version", "subcommand"].contains(&name)
        };
        let chinese: BTreeSet<_> = help_names(Language::Chinese)
            .filter(|name| !by_clap(name))
            .collect();
        assert_eq!(chinese, help_names(Language::English).collect());
    }

    /// A process speaks one language, so this test runs in a process of its own; `tests/cli` asks the binary.
    #[test]
    fn all_help_is_spoken_in_chinese() {
        if std::env::var_os("WEDM_TEST_OF_HELP").is_none() {
            let own = std::env::current_exe().unwrap();
            let ended = std::process::Command::new(own)
                .args([
                    "--exact",
                    "cli::help::tests::all_help_is_spoken_in_chinese",
                    "--nocapture",
                ])
                .env("WEDM_TEST_OF_HELP", "1")
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&ended.stdout).into_owned();
            let wrong = String::from_utf8_lossy(&ended.stderr).into_owned();
            assert!(ended.status.success(), "{said}{wrong}");
            return;
        }
        let is_chinese =
            |text: &str| text.contains(|letter| ('\u{4e00}'..='\u{9fff}').contains(&letter));
        speak(Language::Chinese, Asker::CommandLine);
        texts(&explained(CommandLine::command()), &mut |names, text| {
            let text = text.unwrap_or_default();
            assert!(is_chinese(&text), "{names:?} is {text:?}");
        });
        for row in rows() {
            let text = row.first_sentence();
            assert!(is_chinese(&text), "{} means {text:?}", row.key);
        }
        explained(CommandLine::command()).debug_assert();
    }
}
