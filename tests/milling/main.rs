//! Milling by an electrode that wears: the program as a control runs it, compared with path, feeds and a simulation of our own.

mod pockets;
mod programs;
mod refusals;
mod slots;
use crate::support::generate;
use std::sync::Arc;
use wedm::compare::{Traced, compare};
use wedm::document::{Document, Source};
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Role, Unit, Vertex};
use wedm::finding::{Finding, Rule, Severity};
use wedm::job::{Generated, Refusal};
use wedm::program::{Format, Language};
use wedm::settings::{Effective, from_toml};

const ELECTRODE: &str =
    "[milling]\ntool-diameter = 1.0\ngap = 0.05\nlayer = 0.010\ndepth = 0.2\nwear = 0.02\n";

fn settings(text: &str) -> Effective {
    let (settings, mut errors) = from_toml(text);
    // One step stands in all of them, whether it has an effect or not.
    errors.retain(|error| !error.message.starts_with("milling.step has no effect"));
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

/// Polylines `[x, y, bulge]`, closed or not; the closed ones are openings.
fn drawing(contours: &[(bool, &[[f64; 3]])]) -> Drawing {
    with_role(Role::Opening, contours)
}

/// The same, but what the closed ones are.
fn with_role(role: Role, contours: &[(bool, &[[f64; 3]])]) -> Drawing {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    for (number, (closed, vertices)) in contours.iter().enumerate() {
        drawing.push(Entity {
            handle: format!("A{number}").into(),
            layer: "0".into(),
            role: closed.then_some(role),
            kind: Kind::LightPolyline,
            geometry: Geometry::Polyline {
                closed: *closed,
                vertices: vertices
                    .iter()
                    .map(|&[x, y, bulge]| Vertex::new(x, y, bulge))
                    .collect(),
            },
        });
    }
    drawing
}

const SLOT: &[[f64; 3]] = &[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0]];

/// The path of half the electrode and a gap in it is a circle of R 1 about (5, 5).
fn ring(radius: f64) -> Vec<[f64; 3]> {
    vec![[5.0 + radius, 5.0, 1.0], [5.0 - radius, 5.0, 1.0]]
}

fn generated(drawing: &Drawing, text: &str, format: Format) -> Result<Generated, Refusal> {
    let source = Source::Cad(Arc::new(drawing.clone()));
    let document = Document::new(source, Arc::new(settings(text)));
    generate(&document, format, false)
}

fn milled(drawing: &Drawing, text: &str) -> Generated {
    match generated(drawing, text, Format::Milling) {
        Ok(made) => made,
        Err(refusal) => panic!("{text}: {refusal:?}"),
    }
}
