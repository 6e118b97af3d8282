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

use super::slot::new_header;
use super::{ThreeB, refuse_four_b};
use crate::drawing::{self, Drawing, Entity, Geometry, Outline, Role, Unit, Vertex};
use crate::geometry::Segment;
use crate::program::grid::{Node, point_of, snap};
use crate::program::path::Cut;
use crate::program::refactor::{Content, Edits, Refactoring, Sheet};
use crate::program::three_b::layout::push_start_point;
use crate::program::three_b::write;
use crate::settings::{Compensation, Direction, Effective, Layout, PointSetting};
use crate::text::TextEdit;
use crate::toolpath::{Refusal, plan};
use std::collections::BTreeMap;

pub(super) const OPENING: Refactoring<ThreeB> = Refactoring {
    id: "refactor.rewrite.correct.opening",
    title: |settings| say!(apply_the_correction_inside, settings.correction),
    rewrite: |sheet| corrected(sheet, Role::Opening),
};
pub(super) const PUNCH: Refactoring<ThreeB> = Refactoring {
    id: "refactor.rewrite.correct.punch",
    title: |settings| say!(apply_the_correction_outside, settings.correction),
    rewrite: |sheet| corrected(sheet, Role::Punch),
};

fn corrected(sheet: &Sheet<'_, ThreeB>, role: Role) -> Edits {
    let content = sheet.content()?;
    refuse_four_b(content)?;
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    let mut outlines = Vec::new();
    let (mut threads, mut entries) = (BTreeMap::new(), BTreeMap::new());
    for contour in content.contours.iter().filter(|contour| !contour.is_way) {
        content.refuse_pause(contour)?;
        if !contour.closed {
            return Err(say!(
                the_contour_is_open_and_the_side_of_the_wire_unknown,
                contour.contour
            ));
        }
        let handle = contour.contour.to_string();
        let first = contour.contour_steps().start;
        let [thread, entry] = [contour.steps.start, first].map(|step| content.rows[step].from);
        entries.insert(handle.clone(), in_mm(entry));
        if thread != entry {
            threads.insert(handle.clone(), in_mm(thread));
        }
        let geometry = geometry(content, contour);
        let id = drawing.push(Entity {
            handle: handle.into(),
            layer: "0".into(),
            role: Some(role),
            kind: crate::drawing::Kind::LightPolyline,
            geometry,
        });
        let is_reversed = matches!(content.rows[first].piece, Segment::Arc(arc) if arc.is_full_turn() && arc.sweep < 0.0);
        let outline = drawing::Contour::new(&drawing, [(id, is_reversed)], true);
        let twice_area = outline.twice_area(&drawing);
        outlines.push(Outline {
            contour: outline,
            role,
            twice_area,
        });
    }
    let is_any_without_lead = threads.len() < entries.len();
    let layout = match content.rows.first() {
        Some(row) if row.own.coordinates.is_some() => Layout::Checking,
        Some(row) => row.own.layout,
        None => Layout::Compact,
    };
    let of_pass = sheet.settings.of_one_pass();
    let settings = Effective {
        layout,
        compensation: Compensation::Path,
        direction: Direction::AsDrawn,
        thread: Some(PointSetting::ByHandle(threads)),
        entry: Some(PointSetting::ByHandle(entries)),
        // A contour without a way in begins beside itself.
        lead_in: if is_any_without_lead {
            0.0
        } else {
            of_pass.lead_in
        },
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
    let program = write(&paths, 1.0, &settings).map_err(|error| error.to_string())?;
    let begin = paths.first().and_then(|path| snap(path.begin() * 1000.0));
    let begin = begin.filter(|begin| content.rows.first().is_some_and(|row| row.from != *begin));
    replaced(sheet, content, &program.text, begin)
}

/// The new program, replacing all blocks and words; its new start, where that is not the present one.
fn replaced(
    sheet: &Sheet<'_, ThreeB>,
    content: &Content<ThreeB>,
    program: &str,
    begin: Option<Node>,
) -> Edits {
    let text = sheet.document.text();
    let first = content
        .rows
        .first()
        .map_or(0, |row| text.line_start(row.line));
    let last = sheet
        .trace
        .steps
        .iter()
        .map(|step| step.line)
        .max()
        .unwrap_or(0);
    let end = text.line_range(last).end;
    let header = sheet.document.header();
    // The present header is right as well where the start stays where it was.
    let blocks = match program.strip_prefix("; Start Point") {
        Some(rest) => rest.split_once('\n').map_or(rest, |(_, rest)| rest),
        None => program,
    };
    let mut new = String::new();
    let mut edits = Vec::new();
    match (&header, begin) {
        (Some(header), Some(begin)) => edits.push(new_header(text, header, begin)?),
        (None, Some(begin)) => {
            let mut line = Vec::new();
            push_start_point(&mut line, begin);
            new = String::from_utf8(line).map_err(|error| error.to_string())?;
        }
        (_, None) => {}
    }
    new.push_str(blocks.trim_end());
    let new = new.replace('\n', text.line_end(0));
    edits.push(TextEdit::new(first..end.max(first), new));
    Ok(edits)
}

fn geometry(content: &Content<ThreeB>, contour: &Cut) -> Geometry {
    let own = &content.rows[contour.contour_steps()];
    if let [row] = own
        && let Segment::Arc(arc) = row.piece
    {
        return Geometry::Circle {
            center: arc.center / 1000.0,
            radius: arc.radius / 1000.0,
        };
    }
    let vertices = own.iter().map(|row| {
        let [x, y] = in_mm(row.from);
        Vertex::new(x, y, row.piece.bulge())
    });
    Geometry::Polyline {
        closed: true,
        vertices: vertices.collect(),
    }
}

fn in_mm(node: Node) -> [f64; 2] {
    let point = point_of(node) / 1000.0;
    [point.x, point.y]
}
