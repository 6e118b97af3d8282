//! Apply the correction to a program that holds the part's contour: the wire's path replaces it.
//!
//! ```text
//! B10000B0B10000GXL1          B9900B0B9900GXL1
//! B10000B0B40000GYNR1    →    B9900B0B39600GYNR1       (R10, correction 0.1 mm, opening)
//! B10000B0B10000GXL3          B9900B0B9900GXL3
//! ```
//!
//! The path is that of `wedm/generate`, with its proof. It begins at the thread hole of the program and goes the same
//! way round. Comments before the first block stay; others would stand at the wrong blocks and go.

use super::Blocks;
use super::blocks::node;
use super::header::{header, new_header};
use crate::drawing::{self, Drawing, Entity, Geometry, Kind, Outline, Role, Unit, Vertex};
use crate::geometry::Segment;
use crate::program::refactor::moves::{Edits, Move, Place, place, point};
use crate::program::refactor::sheet::Sheet;
use crate::program::three_b::{Document, write};
use crate::settings::{Compensation, Direction, Effective, Layout, PointSetting};
use crate::text::TextEdit;
use crate::toolpath::{Refusal, plan};
use std::collections::BTreeMap;

pub(in crate::program) fn corrected(program: &Document, sheet: &Sheet<'_>, role: Role) -> Edits {
    let blocks = Blocks::of(program, &sheet.trace)?;
    blocks.refuse_four_b()?;
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    let mut outlines = Vec::new();
    let (mut threads, mut entries) = (BTreeMap::new(), BTreeMap::new());
    for contour in sheet.contours.iter().filter(|contour| !contour.is_way) {
        sheet.refuse_pause(contour)?;
        if !contour.closed {
            return Err(say!(
                the_contour_is_open_and_the_side_of_the_wire_unknown,
                contour.contour
            ));
        }
        let handle = contour.contour.to_string();
        let first = contour.contour_steps().start;
        let [thread, entry] = [contour.steps.start, first].map(|step| sheet.moves[step].from);
        entries.insert(handle.clone(), in_mm(entry));
        if thread != entry {
            threads.insert(handle.clone(), in_mm(thread));
        }
        let geometry = geometry(&sheet.moves[contour.contour_steps()]);
        let id = drawing.push(Entity {
            handle: handle.into(),
            layer: "0".into(),
            role: Some(role),
            kind: Kind::LightPolyline,
            geometry,
        });
        let is_reversed = matches!(sheet.moves[first].piece, Segment::Arc(arc) if arc.is_full_turn() && arc.sweep < 0.0);
        let contour = drawing::Contour::new(&drawing, [(id, is_reversed)], true);
        let twice_area = contour.twice_area(&drawing);
        outlines.push(Outline {
            contour,
            role,
            twice_area,
        });
    }
    let layout = match blocks.all.first() {
        Some(own) if own.states_end => Layout::Checking,
        Some(own) => blocks.layout(own),
        None => Layout::Compact,
    };
    let of_pass = sheet.settings.of_one_pass();
    // A contour without a way in begins beside itself.
    let leads_in = threads.len() == entries.len();
    let settings = Effective {
        layout,
        compensation: Compensation::Path,
        direction: Direction::AsDrawn,
        thread: Some(PointSetting::ByHandle(threads)),
        entry: Some(PointSetting::ByHandle(entries)),
        lead_in: if leads_in { of_pass.lead_in } else { 0.0 },
        ..of_pass
    };
    let paths = plan(&drawing, &outlines, &settings, None).map_err(|refusal| match refusal {
        Refusal::Sentence(sentence) => sentence,
        Refusal::Cancelled => say!(the_path_was_given_up).into(),
        Refusal::Findings(findings) => findings.first().map_or_else(
            || say!(no_path_can_be_made).into(),
            |finding| crate::finding::sentence(finding, 1.0),
        ),
    })?;
    let written = write(&paths, 1.0, &settings).map_err(|error| error.to_string())?;
    let begin = paths.first().map(|path| path.begin() * 1000.0);
    let begin = begin.and_then(|begin| place(begin.map(f64::round)));
    let begin = begin.filter(|begin| sheet.moves.first().is_some_and(|own| own.from != *begin));
    Ok(replaced(sheet, program, &written.text, begin))
}

/// The new program, replacing all blocks and words; its new start, where that is not the present one.
fn replaced(
    sheet: &Sheet<'_>,
    program: &Document,
    written: &str,
    begin: Option<Place>,
) -> Vec<TextEdit> {
    let text = program.text();
    let first = sheet.moves.first();
    let first = first.map_or(0, |own| text.line_start(own.line));
    let last = sheet.trace.steps.iter().map(|step| step.line).max();
    let end = text.line_range(last.unwrap_or(0)).end;
    // The present header is right as well where the start stays where it was.
    let blocks = match written.strip_prefix("; Start Point") {
        Some(rest) => rest.split_once('\n').map_or(rest, |(_, rest)| rest),
        None => written,
    };
    let mut new = String::new();
    let mut edits = Vec::new();
    match (program.header(), begin.map(node)) {
        (Some(old), Some(begin)) => edits.push(new_header(text, &old, begin)),
        (None, Some(begin)) => new = header(begin),
        (_, None) => {}
    }
    new.push_str(blocks.trim_end());
    let new = new.replace('\n', text.line_end(0));
    edits.push(TextEdit::new(first..end.max(first), new));
    edits
}

/// A circle, or a polyline with an arc for each arc of the program.
fn geometry(own: &[Move]) -> Geometry {
    if let [
        Move {
            piece: Segment::Arc(arc),
            ..
        },
    ] = own
    {
        return Geometry::Circle {
            center: arc.center / 1000.0,
            radius: arc.radius / 1000.0,
        };
    }
    let vertices = own.iter().map(|own| {
        let [x, y] = in_mm(own.from);
        Vertex::new(x, y, own.piece.bulge())
    });
    Geometry::Polyline {
        closed: true,
        vertices: vertices.collect(),
    }
}

fn in_mm(place: Place) -> [f64; 2] {
    (point(place) / 1000.0).into()
}
