//! Options that several commands share. Those for keys of the settings are declared in `settings`;
//! here they are only listed.

use super::{Failure, output};
use crate::settings::{LARGEST, MissingForFit, Row, Settings, SideSetting, camel_case, rows};
use clap::builder::{PossibleValuesParser, TypedValueParser, ValueParser};
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches, ValueEnum};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// Groups of options: their heading, the table whose keys they set, and their names.
const GROUPS: [(&str, &str, &[&str]); 8] = [
    (
        "Settings",
        "",
        // A correction that is given together with the wire wins.
        &[
            "wire-diameter",
            "gap",
            "correction",
            "passes",
            "side",
            "join",
            "chord-fit",
        ],
    ),
    (
        "Program",
        "program.",
        &[
            "direction",
            "corner",
            "thread",
            "entry",
            "lead-in",
            "lead",
            "start-hole",
            "tab",
            "order",
            "common-line",
            "layout",
            "compensation",
            "digits",
            "profile",
            "end",
            "pause",
        ],
    ),
    ("Words", "program.", &["end", "pause"]),
    (
        "Pair",
        "pair.",
        &["drawn-as", "clearance", "stripper", "holder"],
    ),
    // A conversion takes the path as it is: nothing that plans one.
    (
        "Program",
        "program.",
        &["layout", "digits", "profile", "end", "pause"],
    ),
    ("Settings", "", &["correction"]),
    (
        "Job",
        "job.",
        &[
            "title",
            "part",
            "material",
            "thickness",
            "machine",
            "revision",
            "programmer",
        ],
    ),
    ("Settings", "", &["wire-diameter", "correction", "passes"]),
];

/// `--passes` is the list of their corrections.
const PASSES: &str = "passes.corrections";

/// Form of what a command prints.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum Form {
    Text,
    Json,
}

/// How `--output lisp` writes what is not ASCII.
#[derive(Clone, Copy, Debug, Default, PartialEq, ValueEnum)]
pub(crate) enum LispEncoding {
    #[default]
    #[value(name = "utf-8")]
    Utf8,
    #[value(alias = "936")]
    Gbk,
    Ascii,
}

/// What `--output` names: files, or `lisp` for an answer in that form. A file of that name is `./lisp`.
pub(crate) fn targets(outputs: &[PathBuf]) -> Result<(Option<&Path>, bool), Failure> {
    let is_form = |path: &&PathBuf| path.as_os_str() == "lisp";
    let (forms, files): (Vec<&PathBuf>, Vec<&PathBuf>) = outputs.iter().partition(is_form);
    match files[..] {
        [] => Ok((None, !forms.is_empty())),
        [file] => Ok((Some(file), !forms.is_empty())),
        [one, other, ..] => {
            let [one, other] = [one, other].map(|file| output::word(file));
            Err(Failure(say!(one_output_is_expected, one, other)))
        }
    }
}

// The options of every command that reads a drawing. No doc comment: `clap` would take it for help.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct Common {
    #[command(flatten)]
    pub(super) keys: Keys<0>,
    #[arg(long, value_name = "FILE", help_heading = "Settings")]
    pub(crate) config: Option<PathBuf>,
    #[arg(long, value_enum, value_name = "LANGUAGE")]
    pub(crate) language: Option<FileLanguage>,
}

/// The kinds of files.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum FileLanguage {
    Dxf,
    #[value(name = "3b", alias = "4b")]
    ThreeB,
    Iso,
}

/// How a program is written.
pub(crate) type Program = Keys<1>;

/// How a program that holds its path already is written.
pub(crate) type Written = Keys<4>;

/// The head of a page for the workshop.
pub(crate) type Head = Keys<6>;

/// The correction that 4B needs.
pub(crate) type Corrected = Keys<5>;

/// Words of a program.
pub(crate) type Words = Keys<2>;

/// What a test piece was cut with.
pub(crate) type CutWith = Keys<7>;

/// The settings of a pair.
pub(crate) type Pairing = Keys<3>;

/// Why there is no pair where keys are missing: a side on the command line has ended the one of a `wedm.toml`.
pub(crate) fn no_pair(settings: &Settings, missing: &MissingForFit, else_said: String) -> String {
    let key = "pair.drawn-as";
    let side = settings.side.filter(|side| *side != SideSetting::Both);
    match side {
        Some(side) if missing.0.contains(&key) => {
            let refused = say!(a_pair_on_one_side, key, side.name());
            say!(says, "--side", refused)
        }
        _ => else_said,
    }
}

/// The settings from the options of a group.
#[derive(Clone, Debug, Default)]
pub(crate) struct Keys<const GROUP: usize>(pub(crate) Settings);

impl Common {
    /// The last level of settings: the command line.
    pub(crate) fn settings(&self) -> Settings {
        self.keys.0.clone()
    }

    /// The same with the options for programs.
    pub(crate) fn settings_with(&self, program: &Program) -> Settings {
        self.keys.0.overlaid(&program.0)
    }
}

/// The options of a group and their rows.
fn options(group: usize) -> impl Iterator<Item = (&'static str, &'static Row)> {
    let (_, table, names) = GROUPS[group];
    names
        .iter()
        .map(move |&name| (name, row(&format!("{table}{name}"))))
}

impl<const GROUP: usize> Args for Keys<GROUP> {
    fn augment_args(command: Command) -> Command {
        command.args(options(GROUP).map(|(name, row)| {
            let arg = Arg::new(name).long(name).value_parser(parser(row));
            let arg = arg.help_heading(GROUPS[GROUP].0).allow_hyphen_values(true);
            let value = match row.read {
                "number" | "length_setting" => "MM",
                "numbers" => "MM,MM",
                "point_setting" => "X,Y",
                "whole" => "N",
                "truth" => "true|false",
                "word" => "WORD",
                "label" => "TEXT",
                _ => "NAME",
            };
            let arg = arg.value_name(value);
            // Each says the correction of every pass.
            match name {
                "passes" => arg.conflicts_with("correction"),
                _ => arg,
            }
        }))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<const GROUP: usize> FromArgMatches for Keys<GROUP> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut keys = Keys::default();
        keys.update_from_arg_matches(matches)?;
        Ok(keys)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        for (name, _) in options(GROUP) {
            if let Some(stated) = matches.get_one::<Settings>(name) {
                self.0 = self.0.overlaid(stated);
            }
        }
        Ok(())
    }
}

/// A key by its option.
#[expect(
    clippy::expect_used,
    reason = "the options are a constant list, and every start of the program asks for all of them"
)]
pub(crate) fn row(key: &str) -> &'static Row {
    static ROWS: LazyLock<Vec<Row>> = LazyLock::new(rows);
    let key = if key == "passes" { PASSES } else { key };
    let row = ROWS.iter().find(|row| row.key == key);
    row.expect("options are keys of the settings")
}

/// The default of a key, after its meaning.
pub(super) fn shown_default(row: &Row) -> String {
    let default = row
        .default
        .as_deref()
        .map(|default| default.trim_matches('"'));
    default.map_or_else(String::new, |default| {
        format!(" [{}]", say!(default_is, default))
    })
}

/// The key that an option sets, where it sets one.
pub(super) fn row_of_option(option: &str) -> Option<&'static Row> {
    let all = (0..GROUPS.len()).flat_map(options);
    all.into_iter()
        .find(|(name, _)| *name == option)
        .map(|(_, row)| row)
}

/// The options that are given and set this key, else all of those that may contradict a file; `None` without any.
pub(super) fn at_fault(given: &Settings, key: &str) -> Option<String> {
    let json = serde_json::to_value(given).ok()?;
    let is_given = |row: &Row| {
        let pointer: String = row
            .key
            .split('.')
            .map(|key| format!("/{}", camel_case(key)))
            .collect();
        json.pointer(&pointer).is_some_and(|value| !value.is_null())
    };
    let mut names: Vec<&str> = Vec::new();
    for (name, row) in (0..GROUPS.len()).flat_map(options) {
        if is_given(row) && !names.contains(&name) {
            if row.key == key {
                return Some(format!("--{name}"));
            }
            names.push(name);
        }
    }
    // Those about how a program is written contradict nothing in a file.
    let names: Vec<String> = names.iter().map(|name| format!("--{name}")).collect();
    (!names.is_empty()).then(|| names.join(say!(comma)))
}

/// Reads the value of a key as the settings do.
pub(crate) fn parser(row: &'static Row) -> ValueParser {
    if row.words.is_empty() {
        return ValueParser::new(|text: &str| Settings::of_option(row, text));
    }
    let words = PossibleValuesParser::new(row.words.iter().map(String::as_str));
    words.try_map(|word| Settings::of_option(row, &word)).into()
}

pub(crate) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length) if length > 0.0 && length <= LARGEST => Ok(length),
        Ok(length) if length.is_finite() && length > 0.0 => Err(say!(a_number_up_to, LARGEST)),
        _ => Err(say!(expected_a_length_in_mm_above_0).into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::PointSetting;

    #[test]
    fn points_are_two_finite_numbers() {
        let point = |text: &str| {
            let settings = Settings::of_option(row("program.thread"), text).ok()?;
            settings.program?.thread
        };
        let expected = [
            ("1,2", [1.0, 2.0]),
            ("-115,-10.5", [-115.0, -10.5]),
            ("1, 2", [1.0, 2.0]),
        ];
        for (text, point_of_text) in expected {
            assert_eq!(
                point(text),
                Some(PointSetting::One(point_of_text)),
                "{text}"
            );
        }
        for text in ["", "1", "1,2,3", "nan,1", "1,inf", "a,b", "1;2"] {
            assert_eq!(point(text), None, "{text}");
        }
    }

    #[test]
    fn a_correction_is_above_zero() {
        assert_eq!(positive("0.1"), Ok(0.1));
        for text in ["0", "-0.1", "nan", "inf", "1e308", "thick"] {
            assert!(positive(text).is_err(), "{text}");
            assert!(
                Settings::of_option(row("correction"), text).is_err(),
                "{text}"
            );
        }
    }

    #[test]
    fn every_option_is_a_key_of_the_settings() {
        let all = (0..GROUPS.len()).flat_map(options);
        assert_eq!(all.filter(|(_, row)| row.words.is_empty()).count(), 36);
        assert_eq!(row("program.corner").words, ["arc", "intersection"]);
    }
}
