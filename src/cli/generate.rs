//! `wedm generate`: a program for the machine.

use super::options::{Common, Program};
use super::output::{self, counted, styled};
use super::{Failure, Verdict, files, report};
use crate::document::Document;
use crate::finding::{Detail, Finding, Severity};
use crate::program::{Format, ProofError, ProvedProgram};
use crate::settings::Settings;
use crate::toolpath::{self, Refusal, WirePath};
use clap::Args;
use std::path::PathBuf;

/// Write the program of a drawing
///
/// Every block is decoded again and held against the path before anything is written. A drawing with errors is refused, unless
/// --force says otherwise. The program goes to stdout, or to a file with -o; what it came to is said on stderr.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm generate plate.dxf --side opening -o plate.3b
  wedm generate plate.dxf --side opening --format iso --profile robofil --compensation controller -o plate.iso
  wedm generate plate.dxf --handle 2A --thread -115,-10 --layout checking
  wedm generate plate.dxf --side punch --correction 0.12 --corner intersection --direction cw")]
pub struct Arguments {
    /// The drawing
    #[arg(value_name = "PATH")]
    path: PathBuf,
    /// Language of the program: 3b, 4b, iso
    #[arg(long, default_value = "3b", value_parser = Format::of)]
    format: Format,
    /// Write the program there [default: stdout]
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// Only the contour that holds this entity; may be given several times, in the order of the cuts
    #[arg(long, value_name = "HANDLE")]
    handle: Vec<String>,
    /// Write it although the drawing has errors
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    program: Program,
    #[command(flatten)]
    common: Common,
}

pub fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let path = &arguments.path;
    if let Some(target) = &arguments.output {
        output::refuse_input(target, path)?;
    }
    let last = Settings {
        program: Some(arguments.program.settings()),
        ..arguments.common.settings()
    };
    let opened = files::open_drawing(path, &arguments.common, &last)?;
    files::refuse_faulty_settings(&opened)?;
    let document = opened.document;
    let concerned = concerned(arguments, &document);
    if !arguments.force && refused_for_errors(arguments, &document, &concerned) {
        return Ok(Verdict::Errors);
    }
    let Some(paths) = planned(arguments, &document)? else {
        return Ok(Verdict::Errors);
    };
    let unit_mm = document
        .drawing()
        .map_or(1.0, |drawing| document.settings().unit_of(drawing).mm);
    let program = match arguments
        .format
        .write(&paths, unit_mm, document.settings(), &mut |_, _| true)
    {
        Ok(program) => program,
        Err(ProofError::Unwritable(finding)) => {
            list(arguments, &document, &[*finding]);
            return Ok(Verdict::Errors);
        }
        Err(ProofError::Refused(sentence)) => {
            output::complain(&format!("{}: {sentence}", path.display()));
            return Ok(Verdict::Errors);
        }
        // What comes of errors that were passed over is theirs.
        Err(error) if arguments.force || report::has_errors(&document) => {
            output::complain(&format!(
                "{}: no program could be proved for this drawing, and none is written: {error}",
                path.display()
            ));
            return Ok(Verdict::Errors);
        }
        Err(error) => {
            return Err(Failure(format!(
                "{}: internal error, no program is written: {error}",
                path.display()
            )));
        }
    };
    output::write(arguments.output.as_deref(), program.text.as_bytes())?;
    let stands =
        |finding: &&Finding| matches!(finding.detail, Detail::OffsetCollapse { point: true, .. });
    concerned.iter().filter(stands).for_each(|finding| {
        output::say(&format!(
            "{}\n",
            report::row(path, &document, finding).rendered()
        ))
    });
    if let Some(finding) = document.settings().one_pass() {
        output::say(&format!(
            "{}\n",
            report::row(path, &document, &finding).rendered()
        ));
    }
    summarise(arguments, &program, paths.len());
    Ok(Verdict::Clean)
}

/// What is said of the contours that are cut.
fn concerned(arguments: &Arguments, document: &Document) -> Vec<Finding> {
    let handles = (!arguments.handle.is_empty()).then_some(arguments.handle.as_slice());
    let entities = document
        .snapshot()
        .and_then(|snapshot| toolpath::entities_of(&snapshot.drawing, &snapshot.outlines, handles));
    document
        .all_findings()
        .iter()
        .filter(|finding| finding.concerns(entities.as_ref()))
        .cloned()
        .collect()
}

/// True when errors stand in the contours that are cut; they are listed then.
fn refused_for_errors(arguments: &Arguments, document: &Document, concerned: &[Finding]) -> bool {
    let errors = concerned
        .iter()
        .filter(|finding| finding.severity == Severity::Error)
        .take(report::MOST);
    let rows: Vec<report::Row> = errors
        .map(|finding| report::row(&arguments.path, document, finding))
        .collect();
    if rows.is_empty() {
        return false;
    }
    rows.iter()
        .for_each(|row| output::say(&format!("{}\n", row.rendered())));
    let path = arguments.path.display();
    let errors = counted(rows.len(), "error");
    output::complain(&format!(
        "{path}: no program is written, the drawing has {errors}; repair it (wedm fix {path}), or insist with --force"
    ));
    true
}

/// The paths of the wire; `None` after the reason has been said.
fn planned(arguments: &Arguments, document: &Document) -> Result<Option<Vec<WirePath>>, Failure> {
    let path = &arguments.path;
    let Some(snapshot) = document.snapshot() else {
        return Err(Failure(format!(
            "{}: there is no drawing in it",
            path.display()
        )));
    };
    let handles = (!arguments.handle.is_empty()).then_some(arguments.handle.as_slice());
    let settings = arguments.format.settings(&snapshot.settings);
    match toolpath::plan(&snapshot.drawing, &snapshot.outlines, &settings, handles) {
        Ok(paths) if paths.is_empty() => {
            output::complain(&format!("{}: it has no contour to cut", path.display()));
            Ok(None)
        }
        Ok(paths) => Ok(Some(paths)),
        Err(Refusal::Sentence(sentence)) => {
            output::complain(&format!("{}: {sentence}", path.display()));
            Ok(None)
        }
        Err(Refusal::Cancelled) => Ok(None),
        Err(Refusal::Findings(findings)) => {
            list(arguments, document, &findings);
            Ok(None)
        }
    }
}

fn list(arguments: &Arguments, document: &Document, findings: &[Finding]) {
    for finding in findings {
        output::say(&format!(
            "{}\n",
            report::row(&arguments.path, document, finding).rendered()
        ));
    }
    output::complain(&format!(
        "{}: no program is written",
        arguments.path.display()
    ));
}

fn summarise(arguments: &Arguments, program: &ProvedProgram, contours: usize) {
    let target = arguments
        .output
        .as_ref()
        .map_or_else(|| "stdout".into(), |path| output::name(path));
    // A drift that rounds to zero has no sign.
    let [x, y] = program
        .closure
        .map(|drift| (drift * 100.0).round() / 100.0 + 0.0);
    output::say(&format!(
        "{} {target}: {}, {}, wire path {:.3} mm",
        styled(output::GOOD, "written"),
        counted(program.blocks, "block"),
        counted(contours, "contour"),
        program.length
    ));
    let drift = match arguments.format {
        Format::ThreeB | Format::FourB => {
            format!("; a controller that counts J drifts by {x:.2}, {y:.2} µm")
        }
        Format::Iso => String::new(),
    };
    output::say(&format!(
        "decoded again: at most {:.2} µm from the path{drift}",
        program.deviation
    ));
}
