//! Start holes, leads and what the cuts come to on the machine.

mod leads;
mod order;
mod places;
mod prices;
mod work;
use crate::support::generate;
use proptest::prelude::*;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::document::{Document, Source as Of};
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Outline, Role, Unit, Vertex};
use wedm::finding::{Rule, Severity, sentence};
use wedm::geometry::{Point, Segment};
use wedm::job::{self, Generated};
use wedm::program::{self, Format};
use wedm::settings::{Effective, from_toml};
use wedm::toolpath::{Source, WirePath};

fn settings(text: &str) -> Effective {
    let (settings, errors) = from_toml(text);
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

fn entity(handle: &str, role: Option<Role>, geometry: Geometry) -> Entity {
    Entity {
        handle: handle.into(),
        layer: "0".into(),
        role,
        kind: Kind::LightPolyline,
        geometry,
    }
}

fn polygon(handle: &str, role: Role, vertices: &[[f64; 3]]) -> Entity {
    let vertices = vertices
        .iter()
        .map(|&[x, y, bulge]| Vertex::new(x, y, bulge));
    let geometry = Geometry::Polyline {
        closed: true,
        vertices: vertices.collect(),
    };
    entity(handle, Some(role), geometry)
}

fn rectangle(handle: &str, role: Role, from: [f64; 2], to: [f64; 2]) -> Entity {
    let ([x, y], [x1, y1]) = (from, to);
    let corners = [[x, y, 0.0], [x1, y, 0.0], [x1, y1, 0.0], [x, y1, 0.0]];
    polygon(handle, role, &corners)
}

fn circle(handle: &str, role: Role, center: [f64; 2], radius: f64) -> Entity {
    let center = Point::new(center[0], center[1]);
    entity(handle, Some(role), Geometry::Circle { center, radius })
}

fn drawing(entities: Vec<Entity>) -> Drawing {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    for entity in entities {
        drawing.push(entity);
    }
    drawing
}

fn document(drawing: &Drawing, settings: &Effective) -> Document {
    Document::new(
        Of::Cad(Arc::new(drawing.clone())),
        Arc::new(settings.clone()),
    )
}

fn planned(drawing: &Drawing, settings: &Effective) -> wedm::toolpath::Planned {
    let snapshot = document(drawing, settings).snapshot().expect("a drawing");
    match job::planned(&snapshot, settings, None, false, &()) {
        Ok(planned) => planned,
        Err(refusal) => panic!("{refusal:?}"),
    }
}

fn refusal(drawing: &Drawing, settings: &Effective) -> String {
    let snapshot = document(drawing, settings).snapshot().expect("a drawing");
    let refused = job::planned(&snapshot, settings, None, false, &()).expect_err("no path");
    refused.sentence(1.0)
}

fn generated(drawing: &Drawing, settings: &Effective, format: Format) -> Generated {
    match generate(&document(drawing, settings), format, false) {
        Ok(generated) => generated,
        Err(refusal) => panic!("{format:?}: {}", refusal.sentence(1.0)),
    }
}

/// What is said of start holes, worst first.
fn said(drawing: &Drawing, settings: &Effective) -> Vec<(Severity, String)> {
    let found = document(drawing, settings).all_findings();
    let of_holes = found.iter().filter(|found| found.rule == Rule::StartHole);
    of_holes
        .map(|found| (found.severity, sentence(found, 1.0)))
        .collect()
}

fn is_lead(piece: &wedm::toolpath::PathSegment) -> bool {
    matches!(piece.source, Source::LeadIn | Source::LeadOut)
}

fn distance(
    outlines: &[Outline],
    drawing: &Drawing,
    point: Point,
    of: impl Fn(usize) -> bool,
) -> f64 {
    let chosen = outlines.iter().enumerate().filter(|(index, _)| of(*index));
    let segments = chosen.flat_map(|(_, outline)| outline.contour.segments(drawing));
    segments
        .map(|segment| segment.geometry.distance_to(point))
        .fold(f64::INFINITY, f64::min)
}

const L: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [30.0, 0.0, 0.0],
    [30.0, 10.0, 0.0],
    [12.0, 10.0, 0.0],
    [12.0, 40.0, 0.0],
    [0.0, 40.0, 0.0],
];

/// A plate of a grid of holes and slots, none nearer to another than 3 mm.
fn plate() -> impl Strategy<Value = Vec<Entity>> {
    let cell = (0..3_usize, 1.0..4.0_f64, 1.0..4.0_f64, -0.9..0.9_f64);
    prop::collection::vec(cell, 1..9).prop_map(|cells| {
        let place = |number: usize| [(number % 3) as f64 * 12.0, (number / 3) as f64 * 12.0];
        let one = |(number, (kind, a, b, bulge)): (usize, (usize, f64, f64, f64))| {
            let ([x, y], handle) = (place(number), format!("{:X}", number + 16));
            match kind {
                0 => circle(&handle, Role::Opening, [x, y], a),
                1 => rectangle(&handle, Role::Opening, [x - a, y - b], [x + a, y + b]),
                _ => polygon(
                    &handle,
                    Role::Opening,
                    &[
                        [x - a, y - b, 0.0],
                        [x + a, y - b, bulge.abs()],
                        [x + a, y + b, 0.0],
                        [x - a, y + b, 0.3],
                    ],
                ),
            }
        };
        cells.into_iter().enumerate().map(one).collect()
    })
}
