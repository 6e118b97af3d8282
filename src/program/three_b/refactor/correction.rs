//! Apply the correction to a program that holds the part's contour: the wire's path beside it, in its place.
//!
//! ```text
//! B10000B0B10000GXL1          B9900B0B9900GXL1
//! B10000B0B40000GYNR1    →    B9900B0B39600GYNR1       (R10, correction 0.1 mm, opening)
//! B10000B0B10000GXL3          B9900B0B9900GXL3
//! ```
//!
//! The path is that of `wedm/generate` and proved as that is. It begins at the thread hole of the program and goes the same way round.
//! Comments before the first block stay; others would stand at the wrong blocks and go.

use super::Refactoring;
use super::sheet::{Content, Contour, Sheet};
use crate::drawing::{self, Drawing, Entity, Geometry, Outline, Role, Unit, Vertex};
use crate::geometry::{Point, Segment};
use crate::program::three_b::write;
use crate::settings::{Compensation, Direction, Effective, Layout, PointSetting};
use crate::text::TextEdit;
use crate::toolpath::{Refusal, plan};
use std::collections::BTreeMap;

pub const OPENING: Refactoring = Refactoring {
    id: "refactor.rewrite.correct.opening",
    title: |settings| {
        format!(
            "Apply the correction of {:.3} mm inside (opening)",
            settings.correction
        )
    },
    rewrite: |sheet| corrected(sheet, Role::Opening),
};
pub const PUNCH: Refactoring = Refactoring {
    id: "refactor.rewrite.correct.punch",
    title: |settings| {
        format!(
            "Apply the correction of {:.3} mm outside (punch)",
            settings.correction
        )
    },
    rewrite: |sheet| corrected(sheet, Role::Punch),
};

fn corrected(sheet: &Sheet<'_>, role: Role) -> Result<Vec<TextEdit>, String> {
    let content = sheet.content()?;
    content.refuse_four_b()?;
    let nodes = content.nodes()?;
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    let mut outlines = Vec::new();
    let (mut threads, mut entries) = (BTreeMap::new(), BTreeMap::new());
    for contour in content.contours.iter().filter(|contour| !contour.is_way) {
        content.refuse_pause(contour)?;
        if !contour.closed {
            return Err(format!(
                "contour {} is open: the side of the wire is not known",
                contour.ordinal
            ));
        }
        let handle = contour.ordinal.to_string();
        let first = contour.own_rows().start;
        entries.insert(handle.clone(), in_mm(point(nodes[first].0)));
        threads.insert(handle.clone(), in_mm(point(nodes[contour.rows.start].0)));
        let geometry = geometry(content, contour, &nodes);
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
    let layout = match content.rows.first() {
        Some(row) if row.coordinates.is_some() => Layout::Checking,
        Some(row) => row.layout,
        None => Layout::Compact,
    };
    let settings = Effective {
        layout,
        compensation: Compensation::Path,
        direction: Direction::AsDrawn,
        thread: Some(PointSetting::ByHandle(threads)),
        entry: Some(PointSetting::ByHandle(entries)),
        ..sheet.settings.clone()
    };
    let paths = plan(&drawing, &outlines, &settings, None).map_err(|refusal| match refusal {
        Refusal::Sentence(sentence) => sentence,
        Refusal::Cancelled => "the path was given up".into(),
        Refusal::Findings(findings) => findings.first().map_or_else(
            || "no path can be made".into(),
            |finding| crate::finding::sentence(finding, 1.0),
        ),
    })?;
    let program = write(&paths, 1.0, &settings).map_err(|error| error.to_string())?;
    replaced(sheet, content, &program.text)
}

/// The new program in the place of all blocks, words included.
fn replaced(sheet: &Sheet<'_>, content: &Content, program: &str) -> Result<Vec<TextEdit>, String> {
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
    // The header that stands there is right as well, and the start stays where it was.
    let blocks = match program.strip_prefix("; Start Point") {
        Some(rest) if content.header.is_some() || !sheet.trace.start_is_known => {
            rest.split_once('\n').map_or(rest, |(_, rest)| rest)
        }
        _ => program,
    };
    let line_end = text
        .bytes()
        .get(text.line_range(0).end..text.line_start(1))
        .filter(|end| !end.is_empty())
        .unwrap_or(b"\n");
    let line_end = std::str::from_utf8(line_end).map_err(|error| error.to_string())?;
    let new = blocks.trim_end().replace('\n', line_end);
    Ok(vec![TextEdit {
        range: first..end.max(first),
        text: new,
    }])
}

fn geometry(
    content: &Content,
    contour: &Contour,
    nodes: &[(crate::program::three_b::Node, crate::program::three_b::Node)],
) -> Geometry {
    let own = contour.own_rows();
    if let (1, Segment::Arc(arc)) = (own.len(), content.piece_from(own.start, nodes[own.start].0)) {
        return Geometry::Circle {
            center: arc.center / 1000.0,
            radius: arc.radius / 1000.0,
        };
    }
    let vertex = |index: usize| {
        let [x, y] = in_mm(point(nodes[index].0));
        Vertex::new(x, y, content.rows[index].piece.bulge())
    };
    Geometry::Polyline {
        closed: true,
        vertices: own.map(vertex).collect(),
    }
}

fn point(node: crate::program::three_b::Node) -> Point {
    Point::new(node.x as f64, node.y as f64)
}

fn in_mm(point: Point) -> [f64; 2] {
    [point.x / 1000.0, point.y / 1000.0]
}
