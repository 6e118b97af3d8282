//! Several passes: the path of each, its program, and what all of them leave.

mod drawn;
mod overlap;
mod programs;
mod standing;
mod stock;
mod stops;
mod tabs;

use crate::support::generate;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Outline, Role, Unit, Vertex};
use wedm::job;
use wedm::program::{Document, Format};
use wedm::settings::{Effective, from_toml};
use wedm::toolpath::{Source, WirePath, plan};

/// A wire of 0.25, gaps 0.03 and 0.015, 0.06 left by the rough pass.
const THREE: &str = "wire-diameter = 0.25\n[passes]\ncorrections = [0.215, 0.170, 0.140]\ngaps = [0.03, 0.015, 0.015]\n";

fn settings(text: &str) -> Effective {
    let (settings, mut errors) = from_toml(text);
    // What that leaves is measured here.
    errors.retain(|error| !error.message.contains("beyond the contour"));
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

/// One closed polyline `[x, y, bulge]`, handle 2A.
fn drawing(role: Role, vertices: &[[f64; 3]]) -> Drawing {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    drawing.push(Entity {
        handle: "2A".into(),
        layer: "0".into(),
        role: Some(role),
        kind: Kind::LightPolyline,
        geometry: Geometry::Polyline {
            closed: true,
            vertices: vertices
                .iter()
                .map(|&[x, y, bulge]| Vertex::new(x, y, bulge))
                .collect(),
        },
    });
    drawing
}

const SQUARE: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [10.0, 0.0, 0.0],
    [10.0, 10.0, 0.0],
    [0.0, 10.0, 0.0],
];

/// 40 × 20, entered in the middle of its lower side.
const PLATE: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [40.0, 0.0, 0.0],
    [40.0, 20.0, 0.0],
    [0.0, 20.0, 0.0],
];

fn outlines(drawing: &Drawing, settings: &Effective) -> Arc<Vec<Outline>> {
    Analysis::new(drawing, Arc::new(settings.clone()))
        .outlines(drawing)
        .clone()
}

fn paths(drawing: &Drawing, settings: &Effective) -> Vec<WirePath> {
    plan(drawing, &outlines(drawing, settings), settings, None).expect("paths")
}

fn document(drawing: &Drawing, settings: &Effective) -> wedm::document::Document {
    let source = wedm::document::Source::Cad(Arc::new(drawing.clone()));
    wedm::document::Document::new(source, Arc::new(settings.clone()))
}

fn generated(drawing: &Drawing, settings: &Effective, format: Format) -> job::Generated {
    match generate(&document(drawing, settings), format, false) {
        Ok(generated) => generated,
        Err(refusal) => panic!("{refusal:?}"),
    }
}

fn length(path: &WirePath, is_it: impl Fn(&Source) -> bool) -> f64 {
    let pieces = path.segments.iter().filter(|piece| is_it(&piece.source));
    pieces.map(|piece| piece.geometry.length()).sum()
}

/// What a program says when it is read again.
#[track_caller]
fn held(drawing: &Drawing, settings: &Effective, format: Format) -> Document {
    let made = generated(drawing, settings, format);
    assert_eq!(made.contours, 1);
    let language = format.language();
    let text = made.program.text;
    let document = Document::read(language, text.clone().into(), settings);
    let (findings, _) = document.findings(settings, usize::MAX);
    assert_eq!(findings, [], "{text}");
    document
}
