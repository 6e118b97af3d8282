//! A program as a picture: the way of the wire in its order, with its faults.
//!
//! Every block is a path of its own whose `data-line` is its line in the text, from 0, in the order in which the machine runs them;
//! beyond [`MOST_BLOCKS`] consecutive blocks share a path with the line of the first.

use super::figure::{Frame, escaped, number, path_data};
use super::{FIGURE_TOP, MARGIN, SHEET_WIDTH, scale_to_fit, style};
use crate::finding::Severity;
use crate::geometry::{Arc, Bounds, Point, Segment};
use crate::program::path::{Kind, Step, Trace};
use rustc_hash::FxHashMap;
use std::fmt::Write;

/// Blocks up to this number have a path each.
const MOST_BLOCKS: usize = 20_000;

/// The picture of a program. `faults` are the lines (from 0) with what is wrong there, worst first.
pub fn program_svg(trace: &Trace, faults: &[(usize, Severity, String)]) -> String {
    let Some(bounds) = trace.bounds().map(|bounds| Bounds {
        min: mm(bounds.min),
        max: mm(bounds.max),
    }) else {
        return style::empty_program();
    };
    let scale = scale_to_fit(&bounds);
    let height = (bounds.height() * scale).max(24.0);
    let left = (SHEET_WIDTH - bounds.width() * scale) / 2.0;
    let frame = Frame {
        origin: bounds.min,
        scale,
        left,
        bottom: FIGURE_TOP + height,
    };
    let legend_top = frame.bottom + 48.0;
    let by_line: FxHashMap<usize, &(usize, Severity, String)> =
        faults.iter().rev().map(|fault| (fault.0, fault)).collect();
    let moving: Vec<&Step> = trace.steps.iter().filter(|step| step.moves()).collect();
    let mut sheet = style::opening(SHEET_WIDTH, legend_top + 48.0, &title(faults));
    header(&mut sheet, trace, &moving, faults);
    let _ = writeln!(sheet, "{}", frame.opening_of_drawing(1.0));
    let per_path = moving.len().div_ceil(MOST_BLOCKS).max(1);
    for steps in moving.chunk_by(|a, b| joins(a, b)) {
        for steps in steps.chunks(per_path) {
            path(&mut sheet, &frame, steps, &by_line);
        }
    }
    thread_holes(&mut sheet, &frame, &moving);
    sheet.push_str("</g>\n");
    let has_ways = moving.iter().any(|step| step.kind == Kind::Rapid);
    style::program_legend(
        &mut sheet,
        legend_top + 12.0,
        has_ways,
        moving.iter().any(|step| by_line.contains_key(&step.line)),
    );
    style::scale_bar(&mut sheet, SHEET_WIDTH - MARGIN, legend_top + 12.0, scale);
    sheet.push_str("</svg>\n");
    sheet
}

/// µm to mm.
fn mm(point: Point) -> Point {
    point / 1000.0
}

fn in_mm(step: &Step) -> Segment {
    match step.ideal {
        Some(Segment::Arc(arc)) => Segment::Arc(Arc {
            center: mm(arc.center),
            radius: arc.radius / 1000.0,
            start: mm(arc.start),
            end: mm(arc.end),
            ..arc
        }),
        Some(Segment::Line(line)) => Segment::line(mm(line.start), mm(line.end)),
        None => Segment::line(mm(step.start), mm(step.end)),
    }
}

/// Blocks of one contour and kind may share a path.
fn joins(a: &Step, b: &Step) -> bool {
    a.contour == b.contour && (a.kind == Kind::Rapid) == (b.kind == Kind::Rapid)
}

fn title(faults: &[(usize, Severity, String)]) -> String {
    let errors = faults
        .iter()
        .filter(|fault| fault.1 == Severity::Error)
        .count();
    match errors {
        0 => "Path of the wire".into(),
        1 => "Path of the wire, with 1 error".into(),
        count => format!("Path of the wire, with {count} errors"),
    }
}

fn header(
    sheet: &mut String,
    trace: &Trace,
    moving: &[&Step],
    faults: &[(usize, Severity, String)],
) {
    let closure = trace.closure();
    let facts = format!(
        "{} blocks · {:.3} mm · ends {:.0}, {:.0} µm from its start",
        moving.len(),
        trace.length() / 1000.0,
        closure.x,
        closure.y
    );
    let _ = writeln!(
        sheet,
        r#"<g class="chrome"><text class="heading" x="{MARGIN}" y="34">{}</text>"#,
        escaped(&title(faults))
    );
    let _ = writeln!(
        sheet,
        r#"<text class="note" x="{MARGIN}" y="52">{}</text></g>"#,
        escaped(&facts)
    );
}

fn path(
    sheet: &mut String,
    frame: &Frame,
    steps: &[&Step],
    faults: &FxHashMap<usize, &(usize, Severity, String)>,
) {
    let Some(first) = steps.first() else { return };
    let data = path_data(frame, steps.iter().map(|step| in_mm(step)), false);
    if data.is_empty() {
        return;
    }
    let fault = steps.iter().find_map(|step| faults.get(&step.line));
    let class = match (first.kind, fault) {
        (_, Some((_, Severity::Error, _))) => "wire fault",
        (_, Some((_, Severity::Warning, _))) => "wire other",
        (Kind::Rapid, _) => "lead",
        _ => "wire",
    };
    let mut label = label(first);
    if let Some((_, _, sentence)) = fault {
        let _ = write!(label, " · {sentence}");
    }
    let _ = writeln!(
        sheet,
        r#"<path class="{class}" data-line="{}" d="{data}"><title>{}</title></path>"#,
        first.line,
        escaped(&label)
    );
}

fn label(step: &Step) -> String {
    let number = step
        .number
        .map_or_else(String::new, |number| format!("N{number} · "));
    let what = match (&step.ideal, step.kind) {
        (Some(Segment::Arc(arc)), _) => format!(
            "arc R {:.3} mm, {:+.1}°",
            arc.radius / 1000.0,
            arc.sweep.to_degrees()
        ),
        (Some(line), Kind::Rapid) => format!("way without a cut, {:.3} mm", line.length() / 1000.0),
        (Some(line), _) => format!("line, {:.3} mm", line.length() / 1000.0),
        (None, _) => "leads nowhere".into(),
    };
    let end = mm(step.end);
    format!(
        "{number}line {} · {what} · to {:.3}, {:.3}",
        step.line + 1,
        end.x,
        end.y
    )
}

/// Where each contour begins, once each place.
fn thread_holes(sheet: &mut String, frame: &Frame, moving: &[&Step]) {
    let begins = moving.iter().enumerate().filter(|(index, step)| {
        let before = index.checked_sub(1).and_then(|before| moving.get(before));
        step.kind != Kind::Rapid && before.is_none_or(|before| before.contour != step.contour)
    });
    for (x, y) in begins.map(|(_, step)| frame.local(mm(step.start))) {
        let (x, y) = (number(x), number(y));
        let _ = writeln!(
            sheet,
            r#"<g class="thread" transform="translate({x} {y})"><circle r="5"/><path d="M-8 0h16M0 -8v16"/></g>"#
        );
    }
}
