//! `wedm convert`: a program as a drawing, or in another language.

use super::options::{Common, Corrected, FileLanguage, Written};
use super::output::{self, styled};
use super::{Failure, Verdict, ending, files, report};
use crate::job::{self, Converted, Target};
use crate::program::Format;
use crate::settings::Settings;
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm convert plate.3b -o plate.dxf
  wedm convert plate.3b -o plate.iso --profile fast-wire
  wedm convert plate.iso -o plate.3b --layout checking")]
pub(crate) struct Arguments {
    #[arg(value_name = "PROG")]
    path: PathBuf,
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[arg(long, requires = "output")]
    overwrite: bool,
    #[arg(long, value_parser = Target::of)]
    format: Option<Target>,
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    written: Written,
    #[command(flatten)]
    corrected: Corrected,
    #[arg(long, value_name = "FILE", help_heading = "Settings")]
    config: Option<PathBuf>,
    #[arg(long, value_enum, value_name = "LANGUAGE")]
    language: Option<FileLanguage>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let path = files::shown(&arguments.path);
    let target = target(arguments)?;
    let last = arguments.corrected.0.overlaid(&arguments.written.0);
    let idle = idle(&last, target);
    if idle.contains(&CORRECTION) {
        return Err(Failure(say!(the_option_is_for_4b_alone, CORRECTION)));
    }
    let common = Common {
        config: arguments.config.clone(),
        language: arguments.language,
        ..Common::default()
    };
    let files::Opened {
        document, writing, ..
    } = files::open_to_use(&arguments.path, arguments.output.as_deref(), &common, &last)?;
    let settings = document.settings().clone();
    // The profile is that of the new program, and says nothing of the given one.
    let of_input = without_profile(&last);
    let document = match of_input == last {
        true => document,
        false => files::open(path, &common, &of_input)?.document,
    };
    if document.program().is_none() {
        return Err(Failure::of(
            path,
            say!(a_drawing_where_a_program_is_expected),
        ));
    }
    let made = match job::convert(&document, target, &settings, arguments.force) {
        Ok(made) => made,
        Err(refusal) => {
            let advice = |errors| say!(nothing_of_a_program_with, path.display(), errors);
            return report::refuse(path, &document, &refusal, advice);
        }
    };
    let bytes = match target {
        Target::Drawing => made.bytes.as_slice().into(),
        _ => writing.written(&made.bytes),
    };
    output::write(arguments.output.as_deref(), &bytes, arguments.overwrite)?;
    summarise(arguments, target, &made);
    let places_nothing = target == Target::Drawing && made.cuts.placed_by.is_none();
    let unplaced = (places_nothing && last.correction.is_some()).then_some(CORRECTION);
    for option in idle.into_iter().chain(unplaced) {
        output::say(&say!(the_option_does_nothing_there, option));
    }
    Ok(Verdict::Clean)
}

fn without_profile(given: &Settings) -> Settings {
    let mut given = given.clone();
    given.program.iter_mut().for_each(|own| own.profile = None);
    given
}

const CORRECTION: &str = "--correction";

/// The options that are given and mean nothing for a target.
fn idle(given: &Settings, target: Target) -> Vec<&'static str> {
    let program = given.program.as_ref();
    let is_3b = matches!(target, Target::Program(Format::ThreeB | Format::FourB));
    let is_iso = target == Target::Program(Format::Iso);
    // A drawing of a 4B program has its contours beside the wire's path.
    let takes_correction = matches!(target, Target::Program(Format::FourB) | Target::Drawing);
    let all = [
        (
            "--layout",
            is_3b,
            program.is_some_and(|own| own.layout.is_some()),
        ),
        (
            "--digits",
            is_3b,
            program.is_some_and(|own| own.digits.is_some()),
        ),
        (
            "--profile",
            is_iso,
            program.is_some_and(|own| own.profile.is_some()),
        ),
        (CORRECTION, takes_correction, given.correction.is_some()),
    ];
    let idle = all
        .into_iter()
        .filter(|(_, has_use, is_given)| *is_given && !has_use);
    idle.map(|(name, ..)| name).collect()
}

fn target(arguments: &Arguments) -> Result<Target, Failure> {
    let ending = arguments
        .output
        .as_deref()
        .and_then(Path::extension)
        .map(|ending| ending.to_string_lossy().into_owned());
    match (&arguments.format, &arguments.output, ending) {
        (Some(format), Some(out), _) => ending::of_conversion(*format, out).map(|()| *format),
        (Some(format), None, _) => Ok(*format),
        (None, Some(out), Some(ending)) => {
            Target::of(&ending).map_err(|reason| Failure::of(out, reason))
        }
        (None, Some(out), None) => Err(Failure::of(
            out,
            say!(its_name_has_no_ending, ".dxf, .3b, .4b, .iso", ".nc"),
        )),
        (None, None, _) => Err(Failure(say!(nothing_says_what_the_program_becomes).into())),
    }
}

fn summarise(arguments: &Arguments, target: Target, made: &Converted) {
    let cuts = &made.cuts;
    let contours = match target {
        Target::Drawing => say!(contours, cuts.contour_count()),
        // Each pass is one of a program.
        Target::Program(_) => say!(contours, cuts.cuts.len()),
    };
    let what = match made.blocks {
        Some(blocks) => format!("{}{}{contours}", say!(blocks, blocks), say!(comma)),
        None => contours,
    };
    let written = output::target_name(arguments.output.as_deref());
    let written = format!("{} {written}", styled(output::GOOD, say!(written)));
    output::say(&say!(says, written, what));
    if target == Target::Drawing
        && (cuts.four_b.is_some() || cuts.cuts.iter().any(|cut| cut.side.is_some()))
    {
        match cuts.placed_by {
            Some(correction) => {
                output::say(&say!(the_contours_are_placed_by_a_correction, correction));
            }
            None => output::say(say!(the_correction_is_not_in_the_contours)),
        }
    }
    let way = made.dropped.way();
    let corrections = made.corrections.iter().cloned();
    let format = match target {
        Target::Program(format) => Some(format),
        Target::Drawing => None,
    };
    let losses = way
        .into_iter()
        .chain(corrections)
        .chain(cuts.losses(format));
    losses.for_each(|loss| output::say(&loss));
    made.dropped
        .sentences()
        .iter()
        .for_each(|loss| output::say(loss));
    if cuts.closure >= 0.005 {
        output::say(&say!(
            the_machine_misses_the_begin_of_a_contour_by_up_to_um,
            cuts.closure
        ));
    }
    if !cuts.lost.is_empty() {
        let lines: Vec<String> = cuts
            .lost
            .iter()
            .take(5)
            .map(|line| (line + 1).to_string())
            .collect();
        let more = if cuts.lost.len() > 5 { ", …" } else { "" };
        output::say(&say!(
            left_out_since_they_lead_nowhere,
            lines.join(", "),
            more
        ));
    }
}
