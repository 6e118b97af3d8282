//! `wedm init`: a commented `wedm.toml`, from flags or from questions.

use super::{Failure, Verdict, output};
use crate::settings::{self, Effective, FILE_NAME, shipped_profiles};
use clap::Args;
use std::fmt::Write;
use std::io::{BufRead, IsTerminal};
use std::path::PathBuf;

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm init
  wedm init --wire 0.18 --gap 0.01 --side auto --machine 3b
  wedm init --wire 0.25 --gap 0.03 --passes 3 --machine robofil drawings")]
pub(crate) struct Arguments {
    #[arg(value_name = "DIR", default_value = ".")]
    folder: PathBuf,
    #[arg(long, value_name = "MM", value_parser = super::options::positive)]
    wire: Option<f64>,
    #[arg(long, value_name = "MM", value_parser = super::options::positive)]
    gap: Option<f64>,
    #[arg(long, value_name = "MM", value_parser = super::options::positive)]
    fine_gap: Option<f64>,
    #[arg(long, value_name = "MM", value_parser = super::options::positive, default_value = "0.06")]
    stock: f64,
    #[arg(long, value_name = "N", value_parser = passes)]
    passes: Option<u8>,
    #[arg(long, value_name = "SIDE", value_parser = SIDES)]
    side: Option<String>,
    #[arg(long, value_parser = machines())]
    machine: Option<String>,
    #[arg(long)]
    overwrite: bool,
}

/// Where the wire runs, the first one offered.
const SIDES: [&str; 4] = ["auto", "opening", "punch", "both"];

fn passes(text: &str) -> Result<u8, String> {
    let count = text.parse().ok().filter(|count| (1..=9).contains(count));
    count.ok_or_else(|| say!(expected, say!(a_whole_number_from_to, 1, 9)))
}

/// The schema beside a `wedm.toml`, as `wedm config schema` prints it: editors with taplo read the line that names it.
const SCHEMA_NAME: &str = "wedm.schema.json";

fn machines() -> clap::builder::PossibleValuesParser {
    let names = shipped_profiles().map(|name| &*name.to_owned().leak());
    std::iter::once("3b")
        .chain(names)
        .collect::<Vec<&'static str>>()
        .into()
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let path = arguments.folder.join(FILE_NAME);
    if settings::is_there(&path) && !arguments.overwrite {
        return Err(Failure::of(&path, say!(it_is_there_already)));
    }
    let defaults = settings::Settings::default();
    let asks = std::io::stdin().is_terminal() && std::io::stderr().is_terminal();
    let number = |said: Option<f64>, question: &str, default: f64| match said {
        Some(number) => Ok(number),
        None if asks => ask(question, &default.to_string(), super::options::positive),
        None => Ok(default),
    };
    let wire = number(
        arguments.wire,
        say!(wire_diameter_mm),
        defaults.wire_diameter(),
    )?;
    let gap = number(arguments.gap, say!(spark_gap_mm), defaults.gap())?;
    let machines: Vec<&str> = std::iter::once("3b").chain(shipped_profiles()).collect();
    let of = |said: &Option<String>, question: String, known: &[&str]| match said {
        Some(word) => Ok(Some(word.clone())),
        None if asks => one_of(&question, known).map(Some),
        None => Ok(None),
    };
    let question = say!(what_the_machine_reads, machines.join(", "));
    let machine = of(&arguments.machine, question, &machines)?.unwrap_or_else(|| "3b".into());
    let question = say!(side_of_the_wire, SIDES.join(", "));
    let side = of(&arguments.side, question, &SIDES)?;
    let passes = match arguments.passes {
        Some(passes) => passes,
        None if asks => ask(say!(passes_along_each_contour), "1", passes)?,
        None => 1,
    };
    let is_silent_of_side = side.is_none();
    let mut set = vec![
        ("wire-diameter", wire.to_string()),
        ("gap", gap.to_string()),
    ];
    if let Some(side) = side {
        set.push(("side", format!("\"{side}\"")));
    }
    if passes > 1 {
        set.extend(of_passes(arguments, wire, gap, usize::from(passes - 1)));
    }
    if machine != "3b" {
        set.push(("program.format", "\"iso\"".to_owned()));
        set.push(("program.profile", format!("\"{machine}\"")));
    }
    let schema = arguments.folder.join(SCHEMA_NAME);
    let head = match schema.exists() {
        true => format!("#:schema ./{SCHEMA_NAME}\n"),
        false => String::new(),
    };
    let text = head + &file(&set);
    let (written, errors) = settings::from_toml(&text);
    if let Some(error) = errors.first() {
        return Err(Failure(say!(
            not_written_as_it_would_be_refused,
            error.message
        )));
    }
    output::write(Some(&path), text.as_bytes(), true)?;
    output::say(&say!(written_file, output::name(&path)));
    let is_given = [arguments.wire.is_some(), arguments.gap.is_some()];
    let is_given = is_given.into_iter().chain(std::iter::repeat(true));
    for ((key, value), given) in set.iter().zip(is_given) {
        let why = match (given, asks) {
            (true, false) => say!(an_option),
            (_, true) => say!(as_answered),
            (false, false) => say!(the_default),
        };
        output::say(&say!(a_key_and_its_value, key, value, why));
    }
    if is_silent_of_side {
        output::say(&say!(no_side_is_set, SIDES.join(", ")));
    }
    let corrections = Effective::of(&written).each_correction();
    let listed: Vec<String> = corrections.iter().map(|mm| format!("{mm:.4}")).collect();
    output::say(&match listed.len() {
        1 => say!(the_correction_that_follows, listed.join(" / "), wire, gap),
        _ => say!(the_corrections_that_follow, listed.join(" / ")),
    });
    Ok(Verdict::Clean)
}

/// One of the known words, the first of them by default.
fn one_of(question: &str, known: &[&str]) -> Result<String, Failure> {
    ask(question, known[0], |text| {
        let word = known.contains(&text).then(|| text.to_owned());
        word.ok_or_else(|| known.join(", "))
    })
}

/// The keys of a rough pass and skims after it.
fn of_passes(
    arguments: &Arguments,
    wire: f64,
    gap: f64,
    skims: usize,
) -> [(&'static str, String); 2] {
    let fine_gap = arguments.fine_gap.unwrap_or(gap / 2.0);
    let corrections = settings::passes_table(wire / 2.0, [gap, fine_gap], arguments.stock, skims);
    let gaps = |pass: usize| if pass == 0 { gap } else { fine_gap };
    let gaps: Vec<f64> = (0..=skims).map(gaps).collect();
    [
        ("passes.corrections", list(&corrections)),
        ("passes.gaps", list(&gaps)),
    ]
}

/// Lengths as a list of TOML, mm.
pub(crate) fn list(lengths: &[f64]) -> String {
    let numbers: Vec<String> = lengths.iter().map(|mm| format!("{mm:.4}")).collect();
    format!("[{}]", numbers.join(", "))
}

/// Asks until the answer fits; no answer is the default, and so is the end of the input.
fn ask<T>(
    question: &str,
    default: &str,
    read: impl Fn(&str) -> Result<T, String>,
) -> Result<T, Failure> {
    loop {
        output::say(&format!("{question} [{default}]"));
        let mut line = String::new();
        let length = std::io::stdin().lock().read_line(&mut line);
        let answer = match line.trim() {
            "" => default,
            answer => answer,
        };
        match read(answer) {
            Ok(value) => return Ok(value),
            Err(expected) if length.is_ok_and(|length| length > 0) => output::say(&expected),
            Err(expected) => return Err(Failure(expected)),
        }
    }
}

/// The keys of which people ask: those of every file first, then those of its tables.
const SHOWN: [&str; 14] = [
    "wire-diameter",
    "gap",
    "side",
    "units",
    "passes.corrections",
    "program.format",
    "program.profile",
    "program.order",
    "program.lead-in",
    "program.start-hole",
    "program.tab",
    "job.thickness",
    "pair.drawn-as",
    "pair.clearance",
];

/// The keys that are set, each with its meaning, and those that are shown, commented out with their default: wire, gap and
/// side on top, then the tables that hold something.
fn file(set: &[(&str, String)]) -> String {
    let mut text = format!("# {}\n", say!(settings_of_wedm));
    let value = |key: &str| set.iter().find(|(name, _)| *name == key);
    let others = set.iter().map(|(key, _)| *key);
    let others = others.filter(|key| !SHOWN.contains(key));
    let keys: Vec<&str> = SHOWN.into_iter().chain(others).collect();
    let table = |key: &str| {
        key.rsplit_once('.')
            .map_or("", |(table, _)| table)
            .to_owned()
    };
    let mut tables: Vec<String> = Vec::new();
    for key in &keys {
        if !tables.contains(&table(key)) {
            tables.push(table(key));
        }
    }
    let is_set = |name: &str| set.iter().any(|(key, _)| table(key) == name);
    tables.sort_by_key(|name| (!name.is_empty(), !is_set(name)));
    for name in tables {
        if !name.is_empty() {
            let _ = write!(text, "\n[{name}]\n");
        }
        let mut own: Vec<&str> = keys
            .iter()
            .copied()
            .filter(|key| table(key) == name)
            .collect();
        own.sort_by_key(|key| *key != "side" && value(key).is_none());
        for key in own {
            let row = super::options::row(key);
            let short = key.rsplit('.').next().unwrap_or(key);
            let meaning = row.first_sentence();
            let meaning = match row.words.is_empty() {
                true => meaning,
                false => say!(says, meaning, row.words.join(", ")),
            };
            let _ = match (value(key), &row.default) {
                (Some((_, value)), _) => write!(text, "# {meaning}\n{short} = {value}\n"),
                (None, Some(default)) => write!(text, "# {meaning}\n# {short} = {default}\n"),
                (None, None) => writeln!(text, "# {short}: {meaning}"),
            };
        }
    }
    let _ = write!(text, "\n# {}\n", say!(list_of_all_keys));
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_without_a_complaint() {
        for set in [
            vec![],
            vec![
                ("wire-diameter", "0.25".to_owned()),
                ("gap", "0.03".to_owned()),
                ("passes.corrections", list(&[0.215, 0.17, 0.14])),
                ("passes.gaps", list(&[0.03, 0.015, 0.015])),
                ("program.profile", "\"robofil\"".to_owned()),
            ],
        ] {
            let text = file(&set);
            let (settings, errors) = settings::from_toml(&text);
            assert_eq!(errors, [], "{text}");
            let uncommented = text
                .lines()
                .filter(|line| line.contains(" = ") && !line.starts_with('#'));
            assert_eq!(uncommented.count(), set.len(), "{text}");
            assert!(
                settings.drawings.is_none(),
                "a drawing that nobody has: {text}"
            );
            assert_eq!(settings.wire_diameter.is_some(), !set.is_empty());
        }
    }
}
