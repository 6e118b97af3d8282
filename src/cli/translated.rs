//! The help of the command line in the language that is spoken.

use super::options::{row_of_option, shown_default};
use crate::message::help;
use clap::error::ContextKind;
use clap::{Arg, Command, Error};
use std::error::Error as _;

/// The command with its help in the language that is spoken.
pub(super) fn translated(mut command: Command) -> Command {
    if help("wedm").is_none() {
        return command;
    }
    command.build();
    translate(command)
}

fn translate(command: Command) -> Command {
    let name = command.get_name().to_owned();
    let mut command = command
        .help_template(format!(
            "{{about-with-newline}}\n{}{{usage}}\n\n{{all-args}}{{after-help}}",
            help("heading Usage").unwrap_or_default()
        ))
        .subcommand_help_heading(help("heading Commands").unwrap_or_default());
    if let Some(about) = help(&name) {
        command = command.about(about);
        if let Some(more) = help(&format!("{name}/")) {
            command = command.long_about(format!("{about}\n\n{more}"));
        }
    }
    if let Some(examples) = command.get_after_help().map(ToString::to_string) {
        let own = help(&format!("{name}-examples")).map(str::to_owned);
        let first = help("wedm-examples").and_then(|all| all.lines().next());
        let translated = examples.replacen("Examples:", first.unwrap_or_default(), 1);
        command = command.after_help(own.unwrap_or(translated));
    }
    command
        .mut_args(|argument| translate_argument(&name, argument))
        .mut_subcommands(translate)
}

fn translate_argument(command: &str, argument: Arg) -> Arg {
    let id = argument.get_id().to_string();
    let english = argument.get_help().map(ToString::to_string);
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
        Some(row) => Some(row.first_sentence() + &shown_default(row)),
        None if id == "config" => help("config-file").map(str::to_owned),
        None => help(&format!("{command} {id}"))
            .or_else(|| help(&id))
            .map(str::to_owned),
    };
    let argument = argument.help_heading(help(&heading).unwrap_or_default());
    match text.or(english) {
        // A text for `--help` alone is none of ours, but of the option that clap adds by itself.
        Some(text) => argument.long_help(None::<&str>).help(text),
        None => argument,
    }
}

/// What is wrong with the words that the process was called with; `None` in the language that clap speaks by itself.
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
    use crate::message::{Asker, Language, speak};
    use crate::settings::rows;
    use clap::CommandFactory;

    fn is_chinese(text: &str) -> bool {
        text.contains(|letter| ('\u{4e00}'..='\u{9fff}').contains(&letter))
    }

    /// Names of what is still said in English.
    fn untranslated(command: &Command, found: &mut Vec<String>) {
        let name = command.get_name();
        let texts = [command.get_about(), command.get_long_about()];
        let texts = texts.into_iter().flatten().map(ToString::to_string);
        found.extend(
            texts
                .filter(|text| !is_chinese(text))
                .map(|_| name.to_owned()),
        );
        for argument in command.get_arguments() {
            let text = argument.get_help().map(ToString::to_string);
            if !text.is_some_and(|text| is_chinese(&text)) {
                found.push(format!("{name} {}", argument.get_id()));
            }
        }
        command
            .get_subcommands()
            .for_each(|one| untranslated(one, found));
    }

    /// Every command, every option and every key of the settings is explained in Chinese. One process speaks one language: the test
    /// speaks it in a process of its own, `tests/cli` asks the binary.
    #[test]
    fn all_help_has_its_twin() {
        if std::env::var_os("WEDM_TEST_OF_HELP").is_none() {
            let own = std::env::current_exe().unwrap();
            let ended = std::process::Command::new(own)
                .args([
                    "--exact",
                    "cli::translated::tests::all_help_has_its_twin",
                    "--nocapture",
                ])
                .env("WEDM_TEST_OF_HELP", "1")
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&ended.stdout).into_owned();
            assert!(
                ended.status.success(),
                "{said}{}",
                String::from_utf8_lossy(&ended.stderr)
            );
            return;
        }
        speak(Language::Chinese, Asker::CommandLine);
        let mut found = Vec::new();
        untranslated(&translated(CommandLine::command()), &mut found);
        let mut rows = rows();
        rows.retain(|row| !is_chinese(&row.first_sentence()));
        found.extend(rows.into_iter().map(|row| row.key));
        found.sort();
        found.dedup();
        assert!(
            found.is_empty(),
            "no Chinese help in src/message/help.rs or meanings.rs of {found:?}"
        );
        translated(CommandLine::command()).debug_assert();
    }
}
