//! A program as a picture: the wire's path in the order of travel, with its faults.
//!
//! Every block is a path whose `data-line` is its line in the text, from 0, in the order in which the machine runs
//! them; beyond [`MOST_BLOCKS`] consecutive blocks share a path with the line of the first.

use super::numbers::number;
use super::pieces::{MANY, Piece, What};
use super::sheet::{Frame, MARGIN, SHEET_WIDTH, Sheet};
use super::style::{self, JUMP, THREAD, WIRE, class_of};
use super::{Drawn, marks, titled};
use crate::finding::Severity;
use crate::geometry::{Arc, Bounds, Point, Segment};
use crate::program::path::{Kind, Step, Trace};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Up to this many blocks have a path each.
const MOST_BLOCKS: usize = 20_000;

/// The picture of a program, with the name of its file. `faults` are lines (from 0) with their faults, worst first. With `in_pieces`
/// a program of many blocks comes as numbers, as drawings do.
pub(crate) fn program(
    trace: &Trace,
    faults: &[(usize, Severity, String)],
    name: Option<&str>,
    mills: bool,
    in_pieces: bool,
) -> Drawn {
    let Some(bounds) = trace.bounds().map(|bounds| Bounds {
        min: mm(bounds.min),
        max: mm(bounds.max),
    }) else {
        return style::empty(say!(the_program_moves_nothing)).into();
    };
    let frame = Frame::fitting(&bounds);
    let legend_top = frame.bottom + 48.0;
    let by_line: FxHashMap<usize, &(usize, Severity, String)> =
        faults.iter().rev().map(|fault| (fault.0, fault)).collect();
    let moving: Vec<&Step> = trace.steps.iter().filter(|step| step.moves()).collect();
    let (what, along) = match mills {
        false => (say!(path_of_the_wire), say!(the_wire)),
        true => (say!(path_of_the_electrode), say!(the_electrode)),
    };
    let title = titled(name, what);
    let mut entries = vec![(WIRE, along), (THREAD, say!(start_of_a_contour))];
    if trace.upper.iter().any(|pieces| !pieces.is_empty()) {
        entries.push((UPPER, say!(the_upper_end)));
    }
    if moving.iter().any(|step| step.kind == Kind::Rapid) {
        entries.push((JUMP, say!(the_jump)));
    }
    let of_step = moving.iter().filter_map(|step| by_line.get(&step.line));
    let severities: BTreeSet<Severity> = of_step.map(|fault| fault.1).collect();
    entries.extend(severities.into_iter().map(style::of_severity));
    let mut sheet = style::opening(legend_top + style::height_of(&entries), &title);
    sheet.pieces = (in_pieces && moving.len() > MANY).then(Vec::new);
    let closure = trace.closure();
    let (cut, jumps) = trace.lengths();
    let facts = [
        say!(blocks, moving.len()),
        say!(extents_mm, bounds.width(), bounds.height()),
        crate::message::lengths(cut / 1000.0, jumps / 1000.0, " · "),
        say!(where_it_ends, closure.x, closure.y),
    ];
    let alert = alert(faults, trace.upper_unknown.as_deref());
    let alert = alert.as_ref().map(|(class, text)| (*class, text.as_str()));
    sheet.heading(&title, &facts.join(" · "), alert);
    sheet.line(format_args!(
        "{}",
        frame.opening_of_drawing(1.0, Some(cut / 1000.0))
    ));
    let per_path = moving.len().div_ceil(MOST_BLOCKS).max(1);
    for steps in moving.chunk_by(|a, b| joins(a, b)) {
        for steps in steps.chunks(per_path) {
            path(&mut sheet, &frame, steps, &by_line);
        }
    }
    let leaning: Vec<Leaning> = moving.iter().zip(&trace.upper).collect();
    for run in leaning.chunk_by(leans_on) {
        upper_path(&mut sheet, &frame, run);
    }
    thread_holes(&mut sheet, &frame, &moving);
    sheet.line(format_args!("</g>"));
    sheet.line(format_args!(r#"<g class="chrome">"#));
    style::legend(&mut sheet, legend_top + 12.0, &entries);
    sheet.line(format_args!("</g>"));
    let right = SHEET_WIDTH - MARGIN;
    style::scale_bar(&mut sheet, right, legend_top + 12.0, frame.scale);
    sheet.line(format_args!("</svg>"));
    sheet.into()
}

/// µm to mm.
fn mm(point: Point) -> Point {
    point / 1000.0
}

const UPPER: &str = r#"<path class="upper" d="M0 0h24"/>"#;

/// A move, and the path of the wire's upper end.
type Leaning<'a> = (&'a &'a Step, &'a Vec<Segment>);

/// True where the wire leans on both moves, in one contour.
fn leans_on(a: &Leaning, b: &Leaning) -> bool {
    !a.1.is_empty() && !b.1.is_empty() && a.0.contour == b.0.contour
}

/// The path of the wire's upper end along consecutive moves.
fn upper_path(sheet: &mut Sheet, frame: &Frame, run: &[Leaning]) {
    let pieces = run.iter().flat_map(|(_, pieces)| pieces.iter());
    let pieces = pieces.map(|piece| scaled(*piece));
    sheet.draw(frame, &What::of("upper"), pieces, false, || {
        say!(the_upper_end).into()
    });
}

fn in_mm(step: &Step) -> Segment {
    let chord = Segment::line(step.start, step.end);
    scaled(step.ideal.unwrap_or(chord))
}

/// µm to mm.
fn scaled(segment: Segment) -> Segment {
    match segment {
        Segment::Arc(arc) => Segment::Arc(Arc {
            center: mm(arc.center),
            radius: arc.radius / 1000.0,
            start: mm(arc.start),
            end: mm(arc.end),
            ..arc
        }),
        Segment::Line(line) => Segment::line(mm(line.start), mm(line.end)),
    }
}

/// Blocks of one contour and kind may share a path.
fn joins(a: &Step, b: &Step) -> bool {
    a.contour == b.contour && (a.kind == Kind::Rapid) == (b.kind == Kind::Rapid)
}

/// The number of errors and warnings, with the class of the worst.
fn alert(
    faults: &[(usize, Severity, String)],
    unknown: Option<&str>,
) -> Option<(&'static str, String)> {
    let count = |severity| faults.iter().filter(|fault| fault.1 == severity).count();
    let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
    let told = [
        (errors > 0).then(|| (Severity::Error, say!(errors, errors))),
        (warnings > 0).then(|| (Severity::Warning, say!(warnings, warnings))),
        unknown.map(|why| (Severity::Information, why.to_owned())),
    ];
    let (severities, told): (Vec<Severity>, Vec<String>) = told.into_iter().flatten().unzip();
    Some((class_of(*severities.first()?), told.join(" · ")))
}

fn path(
    sheet: &mut Sheet,
    frame: &Frame,
    steps: &[&Step],
    faults: &FxHashMap<usize, &(usize, Severity, String)>,
) {
    let Some(first) = steps.first() else { return };
    let fault = steps.iter().find_map(|step| faults.get(&step.line));
    let way = match first.kind {
        Kind::Rapid => "jump",
        _ => "wire",
    };
    let class = match fault {
        Some((_, severity, _)) => format!("{way} fault {}", class_of(*severity)),
        None => way.into(),
    };
    let what = What {
        line: Some(first.line),
        ..What::of(&class)
    };
    let segments = steps.iter().map(|step| in_mm(step));
    sheet.draw(frame, &what, segments, false, || {
        let mut label = label(first);
        if let Some((_, _, sentence)) = fault {
            let _ = write!(label, " · {sentence}");
        }
        label
    });
}

fn label(step: &Step) -> String {
    let number = step
        .number
        .map_or_else(String::new, |number| format!("N{number} · "));
    let what = match (&step.ideal, step.kind) {
        (Some(Segment::Arc(arc)), _) => say!(
            arc_r_mm,
            arc.radius / 1000.0,
            format!("{:+.1}", arc.sweep.to_degrees())
        ),
        (Some(line), Kind::Rapid) => say!(way_without_a_cut_mm, line.length() / 1000.0),
        (Some(line), _) => say!(line_mm, line.length() / 1000.0),
        (None, _) => say!(leads_nowhere).into(),
    };
    let end = mm(step.end);
    say!(step_in_line, number, step.line + 1, what, end.x, end.y)
}

/// The start of each contour, with its number where there are several.
fn thread_holes(sheet: &mut Sheet, frame: &Frame, moving: &[&Step]) {
    let begins = moving.iter().enumerate().filter(|(index, step)| {
        let before = index.checked_sub(1).and_then(|before| moving.get(before));
        step.kind != Kind::Rapid && before.is_none_or(|before| before.contour != step.contour)
    });
    let begins: Vec<Point> = begins.map(|(_, step)| mm(step.start)).collect();
    for (index, &begin) in begins.iter().enumerate() {
        let order = (begins.len() > 1).then_some(index + 1);
        if let Some(pieces) = &mut sheet.pieces {
            pieces.push(Piece::thread(frame.place(begin), order));
            continue;
        }
        let at = frame.local(begin);
        if let Some(order) = order {
            marks::order(sheet, at, (13.0, -9.0), order);
        }
        let (x, y) = (number(at.0), number(at.1));
        sheet.line(format_args!(
            r#"<g class="thread" transform="translate({x} {y})"><circle r="5"/><path d="M-8 0h16M0 -8v16"/></g>"#
        ));
    }
}
