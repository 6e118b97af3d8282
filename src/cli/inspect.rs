//! `wedm inspect`: the radius list, every segment with its verdict.

use super::contours;
use super::files::{self, Opened};
use super::options::{Common, Form};
use super::output::{self, flush_left, flush_right, push_line, styled};
use super::report::{self, Row};
use super::{Failure, Verdict};
use crate::document::Snapshot;
use crate::drawing::Outline;
use crate::finding::Severity;
use crate::geometry::Bounds;
use crate::message::readable;
use crate::protocol::{
    Against, Contours, ContoursContour, InspectedEntity, InspectedSegment, Inspection, SegmentKind,
};
use clap::Args;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::PathBuf;

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm inspect plate.dxf
  wedm inspect plate.dxf --handle 2A --correction 0.12
  wedm inspect plate.dxf --output json | jq '.entities[].segments[] | select(.verdict != \"ok\")'")]
pub(crate) struct Arguments {
    #[arg(value_name = "PATH")]
    path: PathBuf,
    #[arg(long, value_enum, default_value_t = Form::Text)]
    output: Form,
    #[arg(long, value_name = "HANDLE")]
    handle: Option<String>,
    #[command(flatten)]
    common: Common,
}

#[derive(Serialize)]
struct Printed {
    #[serde(flatten)]
    inspection: Inspection,
    diagnostics: Vec<Row>,
    #[serde(skip_serializing_if = "Option::is_none")]
    against: Option<Against>,
    #[serde(skip)]
    contours: Vec<Measured>,
    /// Which wire is thin enough, for people.
    #[serde(skip)]
    wire: Option<String>,
}

/// A contour with its extents.
struct Measured {
    listed: ContoursContour,
    bounds: Bounds,
    layers: BTreeSet<String>,
}

impl Measured {
    fn all(snapshot: &Snapshot) -> Vec<Measured> {
        let Snapshot {
            drawing,
            outlines,
            settings,
        } = snapshot;
        let listed = Contours::new(drawing, outlines, settings).contours;
        let measured = |(listed, outline): (ContoursContour, &Outline)| {
            let pieces = outline.contour.pieces.iter();
            let layers =
                pieces.filter_map(|piece| Some(drawing.get(piece.entity)?.layer.to_string()));
            Measured {
                listed,
                bounds: outline.contour.bounds(drawing),
                layers: layers.collect(),
            }
        };
        listed
            .into_iter()
            .zip(outlines.iter())
            .map(measured)
            .collect()
    }

    /// Extents, smallest radius, handles.
    fn measures(&self, unit_mm: f64) -> String {
        let corner = self.bounds.min * unit_mm;
        let extents = say!(
            extents_from,
            self.bounds.width() * unit_mm,
            self.bounds.height() * unit_mm,
            corner.x,
            corner.y
        );
        let radii = self.listed.segments.iter();
        let smallest = radii
            .filter_map(|piece| piece.shape.radius)
            .fold(f64::INFINITY, f64::min);
        let smallest = match smallest.is_finite() {
            true => say!(smallest_radius, smallest * unit_mm),
            false => String::new(),
        };
        let mut handles: Vec<&str> = self
            .listed
            .segments
            .iter()
            .map(|piece| piece.handle.as_str())
            .collect();
        handles.dedup();
        let more = if handles.len() > LISTED { " …" } else { "" };
        handles.truncate(LISTED);
        let handles = handles.join(" ");
        let layers: Vec<&str> = self.layers.iter().map(String::as_str).collect();
        let layers = say!(on_layers, readable(&layers.join(say!(comma))));
        let handles = format!("{}{more}", readable(&handles));
        say!(says, format!("{extents}{smallest}{layers}"), handles)
    }
}

/// The most handles of a contour that are named.
const LISTED: usize = 12;

impl Printed {
    fn of(inspection: Option<Inspection>, diagnostics: Vec<Row>) -> Printed {
        let nothing = Inspection {
            units_to_mm: 1.0,
            entities: Vec::new(),
            largest_wire: None,
        };
        Printed {
            inspection: inspection.unwrap_or(nothing),
            diagnostics,
            against: None,
            contours: Vec::new(),
            wire: None,
        }
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let common = &arguments.common;
    let opened = files::open(&arguments.path, common, &common.settings())
        .and_then(|opened| opened.snapshot().map(|_| opened));
    let (printed, failure) = match opened.map(|opened| inspected(arguments, opened)) {
        Ok(printed) => (printed, None),
        Err(failure) => (Printed::of(None, Vec::new()), Some(failure)),
    };
    match (arguments.output, failure) {
        (Form::Text, Some(failure)) => return Err(failure),
        (Form::Text, None) => output::print(table(&printed))?,
        (Form::Json, failure) => {
            output::print_json(&printed)?;
            failure.map_or(Ok(()), Err)?;
        }
    }
    let errors = printed
        .diagnostics
        .iter()
        .any(|row| row.severity == Severity::Error);
    Ok(Verdict::of_errors(errors))
}

fn inspected(arguments: &Arguments, mut opened: Opened) -> Printed {
    let mut diagnostics = opened.settings_rows;
    diagnostics.extend(report::rows(&opened.path, &mut opened.document));
    let inspection = Inspection::of(&opened.document, arguments.handle.as_deref());
    let (settings, gaps) = (
        opened.document.settings(),
        opened.document.settings().passes.gaps.is_some(),
    );
    let has_arcs = inspection.iter().any(|inspection| {
        let mut segments = inspection
            .entities
            .iter()
            .flat_map(|entity| &entity.segments);
        segments.any(|segment| segment.shape.radius.is_some())
    });
    let largest = inspection
        .as_ref()
        .and_then(|inspection| inspection.largest_wire.as_ref())
        .map(|largest| largest.sentence());
    let needs_gap = settings.gap.is_none() && !gaps && has_arcs;
    let wire = largest.or_else(|| needs_gap.then(|| say!(the_largest_wire_needs_the_gap).into()));
    let mut printed = Printed {
        wire,
        against: Against::of(&opened.document),
        ..Printed::of(inspection, diagnostics)
    };
    if arguments.output == Form::Text
        && let Some(snapshot) = opened.document.snapshot()
    {
        printed.contours = Measured::all(&snapshot);
    }
    printed
}

/// A table for each contour, then one for each entity outside all contours.
fn table(printed: &Printed) -> String {
    let mut text = String::new();
    let unit = printed.inspection.units_to_mm;
    let mut segments_of: BTreeMap<(&str, usize), VecDeque<&InspectedSegment>> = BTreeMap::new();
    for entity in printed.inspection.entities.iter().filter(|it| it.cut) {
        for segment in &entity.segments {
            let named = (entity.handle.as_str(), segment.index);
            segments_of.entry(named).or_default().push_back(segment);
        }
    }
    for (index, contour) in printed.contours.iter().enumerate() {
        let lines: Vec<String> = contour
            .listed
            .segments
            .iter()
            .filter_map(|piece| {
                let named = (piece.handle.as_str(), piece.segment);
                let segment = segments_of.get_mut(&named)?.pop_front()?;
                Some(line(&piece.handle, segment, unit))
            })
            .collect();
        if lines.is_empty() {
            continue;
        }
        let heading = contours::heading(index, &contour.listed, unit);
        push_line(&mut text, styled(output::STRONG, heading));
        push_line(&mut text, contour.measures(unit));
        push_line(&mut text, styled(output::FAINT, columns()));
        lines.iter().for_each(|line| push_line(&mut text, line));
        text.push('\n');
    }
    for entity in printed.inspection.entities.iter().filter(|it| !it.cut) {
        push_line(&mut text, styled(output::STRONG, heading(entity)));
        push_line(&mut text, styled(output::FAINT, columns()));
        for segment in &entity.segments {
            push_line(&mut text, line(&entity.handle, segment, unit));
        }
        text.push('\n');
    }
    let apart = |row: &&Row| row.data.segment.is_none();
    for row in printed.diagnostics.iter().filter(apart) {
        push_line(&mut text, row.rendered() + "\n");
    }
    if let Some(wire) = &printed.wire {
        push_line(&mut text, wire);
    }
    let segments: usize = printed
        .inspection
        .entities
        .iter()
        .map(|entity| entity.segments.len())
        .sum();
    let faulty = printed
        .inspection
        .entities
        .iter()
        .flat_map(|entity| &entity.segments)
        .filter(|segment| segment.verdict != "ok");
    let any_errors = printed
        .diagnostics
        .iter()
        .any(|row| row.severity == Severity::Error);
    let result = match faulty.count() {
        // What could not be read is no praise for the rest.
        0 if any_errors || segments == 0 => styled(output::WARNING, say!(see_wedm_check)),
        0 => styled(output::GOOD, say!(all_of_them_can_be_cut)),
        count => styled(output::ERROR, say!(not_ok, count)),
    };
    let entities = say!(entities, printed.inspection.entities.len());
    let segments = say!(segments, segments);
    let units = if unit == 1.0 {
        "mm".into()
    } else {
        say!(in_mm_whatever_the_drawing_s_unit, unit)
    };
    push_line(
        &mut text,
        say!(all_in_units, entities, segments, units, result),
    );
    if let Some(against) = &printed.against {
        let line = say!(judged_against, against.on_a_terminal());
        push_line(&mut text, styled(output::FAINT, line));
    }
    text
}

fn heading(entity: &InspectedEntity) -> String {
    let closed = if entity.closed {
        say!(closed)
    } else {
        say!(open)
    };
    let cut = if entity.cut { "" } else { say!(and_not_cut) };
    say!(
        on_layer,
        entity.r#type,
        readable(&entity.handle),
        readable(&entity.layer),
        closed,
        cut
    )
}

fn columns() -> String {
    format!(
        "{} {} {:>13} {:>13}  {} {} {}  {}",
        flush_left(say!(column_of_handles), 8),
        flush_right(say!(vertex), 7),
        "x mm",
        "y mm",
        flush_left(say!(column_of_segments), 7),
        flush_right(&format!("{} mm", say!(radius)), 10),
        flush_right(say!(column_of_sweeps), 9),
        say!(column_of_verdicts)
    )
}

fn line(handle: &str, segment: &InspectedSegment, unit_mm: f64) -> String {
    let shape = &segment.shape;
    let kind = match shape.kind {
        SegmentKind::Line => say!(line),
        SegmentKind::Arc => say!(arc),
        SegmentKind::Circle => say!(circle),
    };
    let radius = shape
        .radius
        .map_or_else(String::new, |radius| format!("{:.3}", radius * unit_mm));
    let sweep = shape
        .sweep
        .map_or_else(String::new, |sweep| format!("{sweep:.2}"));
    let kind = flush_left(kind, 7);
    let handle = flush_left(&readable(handle), 8);
    let row = format!(
        "{handle} {:>7} {:>13.4} {:>13.4}  {kind} {radius:>10} {sweep:>9}  ",
        segment.index,
        shape.start.0 * unit_mm,
        shape.start.1 * unit_mm
    );
    let style = if segment.verdict == "ok" {
        output::GOOD
    } else {
        output::ERROR
    };
    format!("{row}{}", styled(style, &segment.verdict))
}
