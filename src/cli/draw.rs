//! `wedm draw`: a picture of contour, faults and wire path as SVG, PNG or PDF; or contour and wire path as a new drawing.

use super::files;
use super::options::{Common, Program};
use super::output::{self, styled};
use super::{Failure, Verdict};
use crate::disk::ending_of;
use crate::document::{Document, Snapshot};
use crate::drawing::{Drawing, Entity, Geometry};
use crate::dxf;
use crate::job::{self, Cut};
use crate::message::readable;
use crate::picture::Image;
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm draw plate.dxf -o plate.svg
  wedm draw plate.dxf -o plate.pdf                     to print, or .png to paste
  wedm draw plate.3b -o plate.svg                      the path that the blocks lead along
  wedm draw plate.dxf --side opening -o plate.svg      with the path of the wire
  wedm draw plate.dxf --side opening -o path.dxf       contours, and the path on the layer WIRE")]
pub(crate) struct Arguments {
    #[arg(value_name = "PATH")]
    path: PathBuf,
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[arg(long, requires = "output")]
    overwrite: bool,
    #[command(flatten)]
    program: Program,
    #[command(flatten)]
    common: Common,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    if let Some(target) = &arguments.output {
        refuse_other_formats(target)?;
    }
    let last = arguments.common.settings_with(&arguments.program);
    let target = arguments.output.as_deref();
    let opened = files::open_to_use(&arguments.path, target, &arguments.common, &last)?;
    if opened.document.program().is_some() {
        return draw_program(arguments, &opened.document);
    }
    let snapshot = opened.snapshot()?;
    let findings = opened.document.all_findings();
    let (cuts, svg) = job::picture(&snapshot, &findings, &());
    if let Err(refusal) = &cuts {
        let note = styled(output::NOTE, say!(note));
        let reason = refusal.sentence(opened.document.telling());
        output::say(&say!(drawn_without_the_path, note, readable(&reason)));
    }
    let picture = match form_of(arguments.output.as_deref()) {
        None => {
            let cuts = cuts.unwrap_or_default();
            dxf::write(&with_paths(&snapshot, &cuts)).map_err(Failure)?
        }
        Some(form) => form.of_svg(&svg).map_err(Failure)?,
    };
    output::write(arguments.output.as_deref(), &picture, arguments.overwrite)?;
    Ok(Verdict::Clean)
}

/// The path of the wire in a program.
fn draw_program(arguments: &Arguments, document: &Document) -> Result<Verdict, Failure> {
    let Some(form) = form_of(arguments.output.as_deref()) else {
        let path = files::shown(&arguments.path).display();
        return Err(Failure(say!(
            a_program_is_drawn_as_svg,
            path,
            output::word(&arguments.path)
        )));
    };
    let svg = document.program().map_or_else(String::new, |program| {
        job::picture_of_program(document, program)
    });
    let picture = form.of_svg(&svg).map_err(Failure)?;
    output::write(arguments.output.as_deref(), &picture, arguments.overwrite)?;
    Ok(Verdict::Clean)
}

/// Layer of the wire's path in a new drawing; for the passes after the first their number follows, and the name of the part of a pair.
const WIRE: &str = "WIRE";

/// A new drawing of the contours as they are, with the wire's path as LINE, ARC and CIRCLE on layers of its own.
fn with_paths(snapshot: &Snapshot, cuts: &[Cut]) -> Drawing {
    let mut drawing = Drawing::new(Some(snapshot.settings.unit_of(&snapshot.drawing)));
    for (_, entity) in snapshot.drawing.entities() {
        drawing.push(entity.clone());
    }
    for cut in cuts {
        let part = cut.name().map(|name| format!("-{name}"));
        let part = part.unwrap_or_default();
        for path in &cut.planned.paths {
            let layer = match path.pass {
                1 => format!("{WIRE}{part}"),
                pass => format!("{WIRE}{pass}{part}"),
            };
            for segment in &path.segments {
                let geometry = Geometry::of_segment(&segment.geometry);
                drawing.push(Entity::new(WIRE, layer.clone(), geometry));
            }
        }
    }
    drawing
}

/// The format of the picture, SVG by default; `None` for a drawing.
fn form_of(target: Option<&Path>) -> Option<Image> {
    let ending = target.map(ending_of).unwrap_or_default();
    (ending != "dxf").then(|| Image::of_ending(&ending).unwrap_or(Image::Svg))
}

fn refuse_other_formats(target: &Path) -> Result<(), Failure> {
    let refusal = match ending_of(target).as_str() {
        "dxf" => return Ok(()),
        _ if target == Path::new("-") => return Ok(()),
        "" => say!(its_name_has_no_ending, ".svg, .png, .pdf", ".dxf"),
        ending if Image::of_ending(ending).is_some() => return Ok(()),
        ending => say!(a_picture_that_is_not_written, ending),
    };
    Err(Failure::of(target, refusal))
}
