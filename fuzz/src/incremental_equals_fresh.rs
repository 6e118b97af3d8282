//! After any edits a document is as if it were opened from scratch: DXF text, and a drawing that a CAD program sends.

use super::{Script, described, edit_of, segment_count, text_and_script};
use std::sync::Arc;
use wedm::document::{Document, Source};
use wedm::drawing::{Delta, Drawing, Entity, Geometry, Kind, Touched, Vertex};
use wedm::dxf;
use wedm::settings::{Effective, Settings, SideSetting};

/// A document beyond this is left alone: every step looks at all of it.
const SEGMENTS: usize = 150;
const STEPS: usize = 24;

const PHRASES: [&str; 24] = [
    "\n0\nLINE\n5\nF1\n10\n7\n20\n7\n11\n8\n21\n8\n",
    "\n0\nENDSEC\n",
    "\n0\nSECTION\n2\nENTITIES\n",
    "\n0\nSECTION\n2\nBLOCKS\n",
    "\n0\nSECTION\n2\nTABLES\n",
    "\n0\nEOF\n",
    "\n10\n5\n20\n5\n",
    "\n42\n0.1\n",
    "\n999\nx\n",
    "\nx\ny\n",
    "\n99999\nz\n",
    "\n0\nPOLYLINE\n",
    "\n0\nVERTEX\n10\n1\n20\n1\n",
    "\n0\nLAYER\n2\nA\n70\n1\n62\n-7\n",
    "\n5\nA2\n",
    "\n102\n{X\n",
    "\n1001\nX\n",
    "\r\n",
    "\r",
    "\u{feff}",
    "\n70\n5\n",
    "0\nHATCH\n",
    "nan",
    "\n0\nINSERT\n2\nB\n10\n1\n20\n1\n",
];

pub fn run(data: &[u8]) {
    let (text, script) = text_and_script(data);
    let mut script = Script(script);
    let first = script.byte();
    let side = [
        SideSetting::Both,
        SideSetting::Auto,
        SideSetting::Opening,
        SideSetting::Punch,
    ][first / 2 % 4];
    let settings = Arc::new(Effective::of(&Settings {
        correction: Some(0.4),
        side: Some(side),
        ..Settings::default()
    }));
    let read = dxf::Document::read(text.to_vec());
    if segment_count(read.drawing()) > SEGMENTS {
        return;
    }
    if first % 2 == 0 {
        in_text(Document::new(Source::Dxf(read), settings), &mut script);
    } else {
        let drawing = editable(read.drawing());
        in_drawing(
            Document::new(Source::Cad(Arc::new(drawing)), settings),
            &mut script,
        );
    }
}

fn in_text(mut document: Document, script: &mut Script) {
    for _ in 0..STEPS {
        if script.is_empty() {
            return;
        }
        let length = document.text().expect("a text").len();
        let (range, typed) = edit_of(script, length, &PHRASES);
        document.edit_text(range.clone(), &typed);
        if segment_count(document.drawing().expect("a drawing")) > SEGMENTS {
            return;
        }
        let bytes = document.text().expect("a text").bytes().to_vec();
        let fresh = Document::new(
            Source::Dxf(dxf::Document::read(bytes)),
            document.settings().clone(),
        );
        compare(&document, &fresh, || format!("{range:?} became {typed:?}"));
    }
}

fn in_drawing(mut document: Document, script: &mut Script) {
    for _ in 0..STEPS {
        if script.is_empty() {
            return;
        }
        let mut said = String::new();
        document.edit_drawing(|drawing| {
            let touched = change(drawing, script);
            said = format!("{touched:?}");
            Ok::<_, ()>(Delta {
                touched: touched.into_iter().collect(),
            })
        });
        let drawing = document.drawing().expect("a drawing");
        if segment_count(drawing) > SEGMENTS {
            return;
        }
        let fresh = Document::new(Source::Cad(drawing.clone()), document.settings().clone());
        compare(&document, &fresh, || said.clone());
    }
}

fn compare(edited: &Document, fresh: &Document, what: impl Fn() -> String) {
    let (edited, fresh) = (described(edited), described(fresh));
    let only_in = |one: &[String], other: &[String]| -> String {
        one.iter()
            .filter(|line| !other.contains(line))
            .map(|line| format!("{line}\n"))
            .collect()
    };
    assert!(
        edited == fresh,
        "{}\nedited:\n{}fresh:\n{}",
        what(),
        only_in(&edited, &fresh),
        only_in(&fresh, &edited)
    );
}

/// The same entities, none of them a part of something else.
fn editable(drawing: &Drawing) -> Drawing {
    let mut copy = Drawing::new(drawing.unit);
    for (_, entity) in drawing.entities() {
        copy.push(entity.clone());
    }
    copy
}

/// One change of a drawing; `None` where it could not be made.
fn change(drawing: &mut Drawing, script: &mut Script) -> Option<Touched> {
    let kind = script.byte();
    let at = script.byte();
    let picked = (!drawing.is_empty()).then(|| drawing.order()[at % drawing.len()]);
    match kind % 8 {
        0 => {
            let position = at % (drawing.len() + 1);
            let entity = entity(script);
            Some(Touched::Entity {
                entity: drawing.insert_at(position, entity),
            })
        }
        1 => {
            let id = picked?;
            drawing.replace(id, entity(script));
            Some(Touched::Entity { entity: id })
        }
        2 => {
            let id = picked?;
            drawing.remove(id);
            Some(Touched::Removed { entity: id })
        }
        _ => {
            let id = picked?;
            let Geometry::Polyline { vertices, .. } = &drawing.get(id)?.geometry else {
                return None;
            };
            let start = script.byte() % (vertices.len() + 1);
            let count = (kind / 8 % 4).min(vertices.len() - start);
            let insert: Vec<Vertex> = (0..kind / 32).map(|_| vertex(script)).collect();
            drawing.splice(id, start, count, &insert).ok()
        }
    }
}

/// Places of a coarse grid, so that ends often coincide; now and then a little off.
fn vertex(script: &mut Script) -> Vertex {
    let (place, more) = (script.byte(), script.byte());
    let off = [0.0, 0.0, 0.0, 0.004, 0.02, 0.0, 0.0, 0.3][more % 8];
    let bulge = [0.0, 0.0, 0.5, -0.5, 1.0, -1.0, 0.03, -2.5][more / 8 % 8];
    Vertex::new(
        (place % 16) as f64 / 2.0 + off,
        (place / 16) as f64 / 2.0,
        bulge,
    )
}

fn entity(script: &mut Script) -> Entity {
    let kind = script.byte();
    let (first, second) = (vertex(script), vertex(script));
    let quarters = |count: usize| count as f64 * std::f64::consts::FRAC_PI_2;
    let (geometry, kind) = match kind % 4 {
        0 => (
            Geometry::Line {
                start: first.point,
                end: second.point,
            },
            Kind::Line,
        ),
        1 => {
            let (start_angle, end_angle) = (quarters(kind / 4 % 4), quarters(kind / 16 % 4));
            (
                Geometry::Arc {
                    center: first.point,
                    radius: 0.5 + (kind / 64) as f64 / 2.0,
                    start_angle,
                    end_angle,
                },
                Kind::Arc,
            )
        }
        2 => (
            Geometry::Circle {
                center: first.point,
                radius: 0.4 + (kind / 8) as f64 / 16.0,
            },
            Kind::Circle,
        ),
        _ => {
            let vertices = [first, second]
                .into_iter()
                .chain((0..kind / 16).map(|_| vertex(script)))
                .collect();
            (
                Geometry::Polyline {
                    closed: (kind / 4).is_multiple_of(2),
                    vertices,
                },
                Kind::LightPolyline,
            )
        }
    };
    Entity {
        handle: "A".into(),
        layer: "0".into(),
        role: None,
        kind,
        geometry,
    }
}
