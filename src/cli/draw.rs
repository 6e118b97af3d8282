//! `wedm draw`: a picture of contour, faults and wire path; or contour and wire path as a new drawing.

use super::options::{Common, Program};
use super::output::{self, styled};
use super::{Failure, Verdict, files};
use crate::document::{Document, Snapshot};
use crate::drawing::{Drawing, Entity, Geometry};
use crate::finding::{self, Finding, Severity};
use crate::job;
use crate::message::readable;
use crate::toolpath::WirePath;
use crate::{dxf, picture};
use clap::Args;
use std::path::{Path, PathBuf};

/// Draw contours, faults and wire path of a drawing, or the path of a program, as SVG; contours and wire path also as DXF
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm draw plate.dxf -o plate.svg
  wedm draw plate.3b -o plate.svg                      the path that the blocks lead along
  wedm draw plate.dxf --side opening -o plate.svg      with the path of the wire
  wedm draw plate.dxf --side opening -o path.dxf       contours, and the path on the layer WIRE")]
pub(crate) struct Arguments {
    /// The drawing or program
    #[arg(value_name = "PATH")]
    path: PathBuf,
    /// Write the picture there, as .svg or .dxf [default: SVG to stdout]
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[command(flatten)]
    program: Program,
    #[command(flatten)]
    common: Common,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    if let Some(target) = &arguments.output {
        refuse_other_formats(target)?;
        output::refuse_input(target, &arguments.path)?;
    }
    let last = arguments.common.settings_with(&arguments.program);
    let opened = files::open_to_use(&arguments.path, &arguments.common, &last)?;
    if opened.document.program().is_some() {
        return draw_program(arguments, &opened.document);
    }
    let snapshot = opened.snapshot()?;
    let findings = opened.document.all_findings();
    let unit_mm = opened.document.unit_mm();
    let paths = job::paths(&snapshot, &snapshot.settings, None, &()).unwrap_or_else(|refusal| {
        let note = styled(output::NOTE, say!(note));
        let reason = refusal.sentence(unit_mm);
        output::say(&say!(drawn_without_the_path, note, readable(&reason)));
        Vec::new()
    });
    let picture = match arguments.output.as_deref().and_then(ending_of).as_deref() {
        Some("dxf") => dxf::write(&with_paths(&snapshot, &paths)).map_err(Failure)?,
        _ => picture::svg(
            &snapshot.drawing,
            &snapshot.outlines,
            &findings,
            &paths,
            &snapshot.settings,
        )
        .into_bytes(),
    };
    output::write(arguments.output.as_deref(), &picture)?;
    Ok(Verdict::Clean)
}

/// The way of the wire of a program.
fn draw_program(arguments: &Arguments, document: &Document) -> Result<Verdict, Failure> {
    if arguments.output.as_deref().and_then(ending_of).as_deref() == Some("dxf") {
        let path = arguments.path.display();
        return Err(Failure(say!(
            a_program_is_drawn_as_svg,
            path,
            output::word(&arguments.path)
        )));
    }
    let trace = document
        .program()
        .map(crate::program::Document::trace)
        .unwrap_or_default();
    let line = |finding: &Finding| {
        Some(
            document
                .text()?
                .line_of(document.range_of(&finding.place)?.start),
        )
    };
    let findings = document.all_findings();
    let fault = |finding: &Finding| {
        Some((
            line(finding)?,
            finding.severity,
            finding::sentence(finding, 1.0),
        ))
    };
    let faults: Vec<(usize, Severity, String)> = findings.iter().filter_map(fault).collect();
    let svg = picture::program_svg(&trace, &faults);
    output::write(arguments.output.as_deref(), svg.as_bytes())?;
    Ok(Verdict::Clean)
}

/// Layer of the wire's path in a drawing that is made; the passes after the first have their number behind it.
const WIRE: &str = "WIRE";

/// A new drawing of the contours as they are, and of the wire's path as LINE, ARC and CIRCLE on layers of its own.
fn with_paths(snapshot: &Snapshot, paths: &[WirePath]) -> Drawing {
    let mut drawing = Drawing::new(Some(snapshot.settings.unit_of(&snapshot.drawing)));
    for (_, entity) in snapshot.drawing.entities() {
        drawing.push(entity.clone());
    }
    let pieces = paths.iter().flat_map(|path| {
        let layer = match path.pass {
            1 => WIRE.to_owned(),
            pass => format!("{WIRE}{pass}"),
        };
        path.segments
            .iter()
            .map(move |segment| (segment, layer.clone()))
    });
    for (segment, layer) in pieces {
        let geometry = Geometry::of_segment(&segment.geometry);
        drawing.push(Entity::new(WIRE, layer, geometry));
    }
    drawing
}

fn ending_of(path: &Path) -> Option<String> {
    Some(path.extension()?.to_string_lossy().to_ascii_lowercase())
}

fn refuse_other_formats(target: &Path) -> Result<(), Failure> {
    match ending_of(target).as_deref() {
        Some("svg" | "dxf") => Ok(()),
        _ if target == Path::new("-") => Ok(()),
        Some(ending) => Err(Failure::of(
            target,
            say!(a_picture_that_is_not_written, ending),
        )),
        None => Err(Failure::of(
            target,
            say!(its_name_has_no_ending, ".svg", ".dxf"),
        )),
    }
}
