//! `wedm convert`: a program as a drawing, or in another language.

use super::options::{Common, Program};
use super::output::{self, counted, styled};
use super::{Failure, Verdict, files, report};
use crate::document::Document;
use crate::dxf;
use crate::finding::Severity;
use crate::program::{Format, ProofError, convert};
use crate::settings::Settings;
use clap::Args;
use std::path::{Path, PathBuf};

/// Turn a program into a drawing, or into a program of another language
///
/// The contours become polylines with arcs on the layer CUT, the ways in and out lines on LEAD, ways without the wire lines on WAY.
/// Where a 3B program holds coordinates (the checking layout) these are taken; else what the machine drifts on the way round is said.
/// A program with errors is refused, unless --force says otherwise.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm convert plate.3b -o plate.dxf
  wedm convert plate.3b -o plate.iso --profile fast-wire
  wedm convert plate.iso -o plate.3b --layout checking")]
pub struct Arguments {
    /// The program: .3b, .4b, .iso or .nc
    #[arg(value_name = "PROG")]
    path: PathBuf,
    /// Write it there; its ending says what it becomes: .dxf, .3b, .4b, .iso or .nc
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// What it becomes, where no OUT says it: dxf, 3b, 4b, iso
    #[arg(long, value_parser = Target::of)]
    format: Option<Target>,
    /// Convert it although it has errors; blocks that lead nowhere are left out
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    program: Program,
    #[command(flatten)]
    common: Common,
}

/// What a program becomes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Target {
    Drawing,
    Program(Format),
}

impl Target {
    fn of(name: &str) -> Result<Target, String> {
        if name.eq_ignore_ascii_case("dxf") {
            return Ok(Target::Drawing);
        }
        if name.eq_ignore_ascii_case("nc") {
            return Ok(Target::Program(Format::Iso));
        }
        Format::of(name).map(Target::Program).map_err(|_| {
            let names = Format::ALL.map(Format::name).join(", ");
            format!("{name:?} is not written, expected dxf, {names}")
        })
    }
}

pub fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let path = &arguments.path;
    let target = target(arguments)?;
    if let Some(out) = &arguments.output {
        output::refuse_input(out, path)?;
    }
    let last = Settings {
        program: Some(arguments.program.settings()),
        ..arguments.common.settings()
    };
    let opened = files::open(path, &arguments.common, &last)?;
    files::refuse_faulty_settings(&opened)?;
    let mut document = opened.document;
    if document.program().is_none() {
        return Err(Failure(format!(
            "{}: it is a drawing, expected a program: wedm generate makes one of it",
            path.display()
        )));
    }
    if !arguments.force && refused_for_errors(path, &mut document) {
        return Ok(Verdict::Errors);
    }
    let Some(program) = document.program() else {
        return Ok(Verdict::Errors);
    };
    let cuts = convert::cuts(program);
    if cuts.cuts.is_empty() {
        output::complain(&format!("{}: it cuts nothing", path.display()));
        return Ok(Verdict::Errors);
    }
    let Some((bytes, what)) = converted(arguments, target, &document, &cuts)? else {
        return Ok(Verdict::Errors);
    };
    output::write(arguments.output.as_deref(), &bytes)?;
    summarise(arguments, target, &cuts, &what);
    Ok(Verdict::Clean)
}

fn target(arguments: &Arguments) -> Result<Target, Failure> {
    let ending = arguments
        .output
        .as_deref()
        .and_then(Path::extension)
        .map(|ending| ending.to_string_lossy().into_owned());
    match (&arguments.format, &arguments.output, ending) {
        (Some(format), ..) => Ok(*format),
        (None, Some(out), Some(ending)) => Target::of(&ending.to_ascii_lowercase())
            .map_err(|reason| Failure(format!("{}: {reason}", out.display()))),
        (None, Some(out), None) => Err(Failure(format!(
            "{}: its name has no ending, expected .dxf, .3b, .4b, .iso or .nc",
            out.display()
        ))),
        (None, None, _) => Err(Failure(
            "nothing says what the program becomes, expected -o OUT or --format".into(),
        )),
    }
}

/// True when errors stand in the program; they are listed then.
fn refused_for_errors(path: &Path, document: &mut Document) -> bool {
    let mut rows = report::rows(path, document);
    // A radius that the wire cannot follow does not change where it goes.
    rows.retain(|row| {
        row.severity == Severity::Error && row.rule != crate::finding::Rule::SmallRadius
    });
    rows.iter()
        .for_each(|row| output::say(&format!("{}\n", row.rendered())));
    if !rows.is_empty() {
        let errors = counted(rows.len(), "error");
        output::complain(&format!(
            "{}: nothing is written, the program has {errors}; repair them, or insist with --force",
            path.display()
        ));
    }
    !rows.is_empty()
}

/// The bytes, and what they are; `None` after the reason has been said.
fn converted(
    arguments: &Arguments,
    target: Target,
    document: &Document,
    cuts: &convert::Cuts,
) -> Result<Option<(Vec<u8>, String)>, Failure> {
    let format = match target {
        Target::Drawing => {
            let bytes = dxf::write(&cuts.drawing()).map_err(Failure)?;
            return Ok(Some((bytes, counted(cuts.cuts.len(), "contour"))));
        }
        Target::Program(format) => format,
    };
    let settings = document.settings();
    if let Some(reason) = cuts.refusal(format, settings) {
        output::complain(&format!("{}: {reason}", arguments.path.display()));
        return Ok(None);
    }
    // µm are the unit of the cuts.
    match format.write(&cuts.paths(), 1e-3, settings, &mut |_, _| true) {
        Ok(written) => Ok(Some((
            written.text.into_bytes(),
            format!(
                "{}, {}",
                counted(written.blocks, "block"),
                counted(cuts.cuts.len(), "contour")
            ),
        ))),
        Err(refused @ (ProofError::Refused(_) | ProofError::Unwritable(_))) => {
            output::complain(&format!("{}: {refused}", arguments.path.display()));
            Ok(None)
        }
        // What comes of errors that were passed over is theirs.
        Err(error) if arguments.force || report::has_errors(document) => {
            let path = arguments.path.display();
            output::complain(&format!(
                "{path}: no other program could be proved for this one, and none is written: {error}"
            ));
            Ok(None)
        }
        Err(error) => Err(Failure(format!(
            "{}: internal error, nothing is written: {error}",
            arguments.path.display()
        ))),
    }
}

fn summarise(arguments: &Arguments, target: Target, cuts: &convert::Cuts, what: &str) {
    let written = arguments
        .output
        .as_ref()
        .map_or_else(|| "stdout".into(), |path| output::name(path));
    output::say(&format!(
        "{} {written}: {what}",
        styled(output::GOOD, "written")
    ));
    if target == Target::Drawing
        && (cuts.four_b.is_some() || cuts.cuts.iter().any(|cut| cut.side.is_some()))
    {
        output::say("the contours are those of the part: the correction is not in them");
    }
    cuts.losses().iter().for_each(|loss| output::say(loss));
    if cuts.closure >= 0.005 {
        output::say(&format!(
            "the machine misses the begin of a contour by up to {:.2} µm; its ends are made one there",
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
        output::say(&format!(
            "left out, since they lead nowhere: lines {}{more}",
            lines.join(", ")
        ));
    }
}
