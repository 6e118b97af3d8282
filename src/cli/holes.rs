//! `wedm holes`: where the start holes are to be drilled.

use super::options::{Common, Program};
use super::output::{self, styled};
use super::{Failure, Verdict, files, report};
use crate::document::Snapshot;
use crate::drawing::{Drawing, Entity, Geometry, START_HOLES};
use crate::toolpath::StartHole;
use crate::{dxf, job};
use clap::Args;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// List the start holes for the drill, as CSV or on a layer of a DXF
///
/// One row a hole: the drawing, x and y in mm, the diameter in mm where --start-hole or the settings say it, the contour that is cut from it,
/// and whether the hole was given or found. A hole that has no room is said on stderr, and the command ends with 1.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm holes plate.dxf --side opening --start-hole 2
  wedm holes plate.dxf punch.dxf --side auto -o holes.csv
  wedm holes plate.dxf --side opening --start-hole 2 -o holes.dxf      the drawing, with the holes on the layer START-HOLES")]
pub struct Arguments {
    /// The drawings
    #[arg(value_name = "PATH", required = true)]
    paths: Vec<PathBuf>,
    /// Write the list there, as .csv or .dxf [default: CSV to stdout]
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[command(flatten)]
    program: Program,
    #[command(flatten)]
    common: Common,
}

pub fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let is_dxf = match &arguments.output {
        Some(target) => is_dxf(target)?,
        None => false,
    };
    if is_dxf && arguments.paths.len() > 1 {
        let count = arguments.paths.len();
        return Err(Failure(say!(holes_of_several_drawings_are_csv, count)));
    }
    let mut csv = "drawing,x_mm,y_mm,diameter_mm,contour,hole\n".to_owned();
    let (mut drawn, mut count, mut any_errors) = (None, 0, false);
    for path in &arguments.paths {
        if let Some(target) = &arguments.output {
            output::refuse_input(target, path)?;
        }
        let last = arguments.common.settings_with(&arguments.program);
        let opened = files::open_to_use(path, &arguments.common, &last)?;
        let snapshot = opened.snapshot()?;
        let findings = opened.document.all_findings();
        let of_holes = findings
            .iter()
            .filter(|finding| finding.rule == crate::rule::Rule::StartHole);
        let said: Vec<_> = of_holes.cloned().collect();
        report::say(path, &opened.document, &said);
        any_errors |= said
            .iter()
            .any(|finding| finding.severity == crate::finding::Severity::Error);
        let planned = match job::planned(&snapshot, &snapshot.settings, None, false, &()) {
            Ok(planned) => planned,
            Err(refusal) => {
                let advice = |errors| say!(no_holes_of_a_drawing_with, path.display(), errors);
                return report::refuse(path, &opened.document, &refusal, advice);
            }
        };
        count += planned.holes.len();
        rows(&mut csv, path, &snapshot, &planned.holes);
        drawn = Some(with_holes(&snapshot, &planned.holes));
    }
    let bytes = match drawn.filter(|_| is_dxf) {
        Some(drawing) => dxf::write(&drawing).map_err(Failure)?,
        None => csv.into_bytes(),
    };
    output::write(arguments.output.as_deref(), &bytes)?;
    if let Some(target) = &arguments.output {
        output::say(&say!(
            the_holes_are_written,
            styled(output::GOOD, "written"),
            output::name(target),
            say!(holes, count)
        ));
    }
    Ok(Verdict::of_errors(any_errors))
}

fn rows(csv: &mut String, path: &Path, snapshot: &Snapshot, holes: &[StartHole]) {
    let unit_mm = snapshot.settings.unit_of(&snapshot.drawing).mm;
    let diameter = snapshot.settings.start_hole;
    let diameter = diameter.map_or_else(String::new, |diameter| diameter.to_string());
    for hole in holes {
        // A coordinate that rounds to zero has no sign.
        let mm = |along: f64| (along * unit_mm * 1e4).round() / 1e4 + 0.0;
        let contour = snapshot.outlines[hole.outline].name(&snapshot.drawing);
        let _ = writeln!(
            csv,
            "{},{:.4},{:.4},{diameter},{},{}",
            cell(&path.to_string_lossy()),
            mm(hole.at.x),
            mm(hole.at.y),
            cell(contour),
            if hole.is_given { "given" } else { "found" }
        );
    }
}

/// A cell of CSV: in quotes where it has to be.
fn cell(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

/// A new drawing of what is drawn, and of the holes: a circle where a diameter is set, and the mark that keeps the hole where it is when the
/// drawing is read again.
fn with_holes(snapshot: &Snapshot, holes: &[StartHole]) -> Drawing {
    let unit = snapshot.settings.unit_of(&snapshot.drawing);
    let mut drawing = Drawing::new(Some(unit));
    for (_, entity) in snapshot.drawing.entities() {
        drawing.push(entity.clone());
    }
    for &StartHole { at, .. } in holes {
        let circle = snapshot
            .settings
            .start_hole
            .map(|diameter| Geometry::Circle {
                center: at,
                radius: diameter / 2.0 / unit.mm,
            });
        let text = "O".into();
        for geometry in circle.into_iter().chain([Geometry::Text { at, text }]) {
            drawing.push(Entity::new(START_HOLES, START_HOLES, geometry));
        }
    }
    drawing
}

fn is_dxf(target: &Path) -> Result<bool, Failure> {
    let ending = target
        .extension()
        .map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("dxf") => Ok(true),
        Some("csv") => Ok(false),
        _ if target == Path::new("-") => Ok(false),
        Some(ending) => Err(Failure::of(
            target,
            say!(holes_that_are_not_written, ending),
        )),
        None => Err(Failure::of(
            target,
            say!(its_name_has_no_ending, ".csv", ".dxf"),
        )),
    }
}
