//! `wedm contours`: the chained contours.

use super::options::{Common, Form};
use super::output::{self, push_line, styled};
use super::{Failure, Verdict, files};
use crate::drawing::Role;
use crate::message::readable;
use crate::protocol::{ContourPiece, Contours, ContoursContour, Direction};
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm contours plate.dxf
  wedm contours plate.dxf --side auto --output json")]
pub(crate) struct Arguments {
    #[arg(value_name = "PATH")]
    path: PathBuf,
    #[arg(long, value_enum, default_value_t = Form::Text)]
    output: Form,
    #[command(flatten)]
    common: Common,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let common = &arguments.common;
    let (_, snapshot) = files::drawing_to_use(&arguments.path, None, common, &common.settings())?;
    let contours = Contours::new(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
    match arguments.output {
        Form::Text => output::print(list(&contours))?,
        Form::Json => output::print_json(&contours)?,
    }
    Ok(Verdict::Clean)
}

fn list(contours: &Contours) -> String {
    let mut text = String::new();
    for (index, contour) in contours.contours.iter().enumerate() {
        let heading = heading(index, contour, contours.units_to_mm);
        push_line(&mut text, styled(output::STRONG, heading));
        for run in contour.segments.chunk_by(goes_on) {
            let (Some(first), Some(last)) = (run.first(), run.last()) else {
                continue;
            };
            let against = if first.reversed {
                say!(against_its_own_direction)
            } else {
                ""
            };
            let range = if run.len() == 1 {
                say!(segment_by_number, first.segment)
            } else {
                say!(segments_from_to, first.segment, last.segment)
            };
            let _ = writeln!(text, "  {:<12} {range}{against}", readable(&first.handle));
        }
        for gap in &contour.gaps {
            let distance = gap.distance * contours.units_to_mm * 1000.0;
            let gap = say!(gap_of_um_closed_after_segment, distance, gap.after);
            push_line(&mut text, format!("  {}", styled(output::WARNING, gap)));
        }
        text.push('\n');
    }
    text + &say!(contours, contours.contours.len()) + "\n"
}

/// In one row; the entities of a block all have the handle of its reference, and each its own segments.
fn goes_on(one: &ContourPiece, next: &ContourPiece) -> bool {
    one.handle == next.handle && one.segment != next.segment
}

/// The kind of a contour, or the wire's side.
pub(super) fn role(role: Role) -> &'static str {
    match role {
        Role::Opening => say!(opening),
        Role::Punch => say!(punch),
        Role::Both => say!(both_sides),
        Role::Left => say!(wire_on_the_left),
        Role::Right => say!(wire_on_the_right),
        Role::Line => say!(cut_on_the_line),
        Role::Ignore => say!(not_cut),
    }
}

pub(super) fn heading(index: usize, contour: &ContoursContour, unit_mm: f64) -> String {
    let shape = match (contour.closed, contour.direction) {
        (false, _) => say!(open),
        (true, Some(Direction::Ccw)) => say!(closed_counter_clockwise),
        (true, Some(Direction::Cw)) => say!(closed_clockwise),
        (true, None) => say!(closed_without_area),
    };
    let role = role(contour.role);
    let length = contour.length * unit_mm;
    let area = contour
        .area
        .map_or_else(String::new, |area| say!(area_of, area * unit_mm * unit_mm));
    let order = contour
        .order
        .map_or_else(String::new, |order| say!(cut_number, order + 1));
    let mark = contour.mark.map_or_else(String::new, |[x, y]| {
        say!(start_mark_at, x * unit_mm, y * unit_mm)
    });
    let segments = say!(segments, contour.segments.len());
    let what = say!(
        contour_and_what_it_is,
        index + 1,
        shape,
        role,
        segments,
        length
    );
    format!("{what}{area}{order}{mark}")
}
