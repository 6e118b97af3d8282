//! `wedm holes`: the start holes for the drill.

use super::files;
use super::options::{Common, Program};
use super::output::{self, styled};
use super::{Failure, Verdict, report};
use crate::disk::ending_of;
use crate::job;
use crate::job::drill;
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm holes plate.dxf --side opening --start-hole 2
  wedm holes plate.dxf punch.dxf --side auto -o holes.csv
  wedm holes plate.dxf --side opening --start-hole 2 -o holes.dxf      the drawing, with the holes on the layer START-HOLES")]
pub(super) struct Arguments {
    #[arg(value_name = "PATH", required = true)]
    paths: Vec<PathBuf>,
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[arg(long, requires = "output")]
    overwrite: bool,
    #[command(flatten)]
    program: Program,
    #[command(flatten)]
    common: Common,
}

pub(super) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let is_dxf = match &arguments.output {
        Some(target) => is_dxf(target)?,
        None => false,
    };
    if is_dxf && arguments.paths.len() > 1 {
        let count = arguments.paths.len();
        return Err(Failure(say!(holes_of_several_drawings_are_csv, count)));
    }
    let mut list = drill::List::default();
    let (mut drawn, mut any_errors) = (None, false);
    for path in &arguments.paths {
        let last = arguments.common.settings_with(&arguments.program);
        let target = arguments.output.as_deref();
        let (opened, snapshot) = files::drawing_to_use(path, target, &arguments.common, &last)?;
        let path = files::shown(path);
        let findings = opened.document.all_findings();
        let of_holes = findings
            .iter()
            .filter(|finding| finding.rule == crate::rule::Rule::StartHole);
        let said: Vec<_> = of_holes.cloned().collect();
        report::say(path, &opened.document, &said);
        any_errors |= said
            .iter()
            .any(|finding| finding.severity == crate::finding::Severity::Error);
        let cuts = match job::cuts(&snapshot, &()) {
            Ok(cuts) => cuts,
            Err(refusal) => {
                let advice = |errors| say!(no_holes_of_a_drawing_with, path.display(), errors);
                return report::refuse(path, &opened.document, &refusal, advice);
            }
        };
        list.add(&path.to_string_lossy(), &cuts);
        if is_dxf {
            let source = opened.document.source();
            drawn = Some(drill::as_dxf(source, &snapshot, &cuts).map_err(Failure)?);
        }
    }
    let is_new = drawn.as_ref().is_some_and(|drawn| drawn.is_new);
    let bytes = drawn.map_or_else(|| list.csv().into_bytes(), |drawn| drawn.bytes);
    output::write(arguments.output.as_deref(), &bytes, arguments.overwrite)?;
    if let Some(target) = &arguments.output {
        output::say(&say!(
            the_holes_are_written,
            styled(output::GOOD, say!(written)),
            output::name(target),
            say!(holes, list.count())
        ));
        if is_new {
            output::say(say!(the_holes_are_in_a_new_drawing));
        }
    }
    Ok(Verdict::of_errors(any_errors))
}

fn is_dxf(target: &Path) -> Result<bool, Failure> {
    let refusal = match ending_of(target).as_str() {
        "dxf" => return Ok(true),
        "csv" => return Ok(false),
        _ if target == Path::new("-") => return Ok(false),
        "" => say!(its_name_has_no_ending, ".csv", ".dxf"),
        ending => say!(holes_that_are_not_written, ending),
    };
    Err(Failure::of(target, refusal))
}
