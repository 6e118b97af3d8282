//! Punch and plate: their corrections, whether they fit, the rule, its fix, and the programs of both.

mod across;
mod corners;
mod drawn;
mod fixes;
mod places;
mod refusals;
mod sampled;
mod sizes;

use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::document::{Document, Snapshot, Source};
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Unit, Vertex};
use wedm::finding::{Finding, Rule};
use wedm::fit::{Fit, fit};
use wedm::geometry::Point;
use wedm::settings::{Effective, from_toml};

const DRAWN: &str = "wire-diameter = 0.18\ngap = 0.01\n[layers]\nPU = \"punch\"\nPL = \"opening\"\n[pair]\nclearance = 0.01\n[workpieces]\nPUNCH = [\"PU\"]\nPLATE = [\"PL\"]\n";

fn settings(text: &str) -> Effective {
    let (settings, mut errors) = from_toml(text);
    // What that makes of the fit is measured here.
    errors.retain(|error| !error.message.contains("beyond the contour"));
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

/// A wire and a gap that come to half a kerf, a clearance, and what is drawn.
fn pair(drawn_as: &str, half: f64, clearance: f64) -> Effective {
    let wire = 2.0 * (half - 0.01);
    settings(&format!(
        "wire-diameter = {wire:?}\ngap = 0.01\n[pair]\ndrawn-as = \"{drawn_as}\"\nclearance = {clearance:?}\n"
    ))
}

fn polyline(layer: &str, handle: &str, vertices: Vec<Vertex>) -> Entity {
    Entity {
        handle: handle.into(),
        layer: layer.into(),
        role: None,
        kind: Kind::LightPolyline,
        geometry: Geometry::Polyline {
            closed: true,
            vertices,
        },
    }
}

fn drawing(entities: Vec<Entity>) -> Drawing {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    for entity in entities {
        drawing.push(entity);
    }
    drawing
}

fn circle(radius: f64) -> Drawing {
    let geometry = Geometry::Circle {
        center: Point::new(3.0, -2.0),
        radius,
    };
    drawing(vec![Entity {
        handle: "2A".into(),
        layer: "0".into(),
        role: None,
        kind: Kind::Circle,
        geometry,
    }])
}

/// A closed polyline through corners, each with its fillet (0: sharp).
fn rounded(corners: &[(Point, f64)]) -> Vec<Vertex> {
    let count = corners.len();
    let mut vertices = Vec::new();
    for at in 0..count {
        let (corner, radius) = corners[at];
        let before = (corner - corners[(at + count - 1) % count].0).normalize();
        let behind = (corners[(at + 1) % count].0 - corner).normalize();
        let turn = (before.x * behind.y - before.y * behind.x).atan2(before.dot(&behind));
        if radius == 0.0 {
            vertices.push(Vertex::new(corner.x, corner.y, 0.0));
            continue;
        }
        let length = radius * (turn.abs() / 2.0).tan();
        let (from, to) = (corner - before * length, corner + behind * length);
        vertices.push(Vertex::new(from.x, from.y, (turn / 4.0).tan()));
        vertices.push(Vertex::new(to.x, to.y, 0.0));
    }
    vertices
}

/// A kite whose corner at (0, 0) turns by `turn` degrees, with a fillet there; the other corners are wide or amply rounded.
fn corner(turn: f64, radius: f64) -> Vec<Vertex> {
    let half = (180.0 - turn).to_radians() / 2.0;
    let (x, y) = (10.0 * half.cos(), 10.0 * half.sin());
    rounded(&[
        (Point::new(0.0, 0.0), radius),
        (Point::new(x, -y), 2.0),
        (Point::new(x + 12.0, 0.0), 2.0),
        (Point::new(x, y), 2.0),
    ])
}

/// The same corner pointing inwards: the wire of the punch runs inside of it.
fn notch(turn: f64, radius: f64) -> Vec<Vertex> {
    let half = (180.0 - turn).to_radians() / 2.0;
    let (x, y) = (10.0 * half.cos(), 10.0 * half.sin());
    rounded(&[
        (Point::new(0.0, 0.0), radius),
        (Point::new(x, -y), 2.0),
        (Point::new(-12.0, -y - 12.0), 2.0),
        (Point::new(-12.0, y + 12.0), 2.0),
        (Point::new(x, y), 2.0),
    ])
}

fn snapshot(drawing: &Drawing, settings: &Effective) -> Snapshot {
    document(drawing, settings).snapshot().expect("a drawing")
}

fn document(drawing: &Drawing, settings: &Effective) -> Document {
    let source = Source::Cad(Arc::new(drawing.clone()));
    Document::new(source, Arc::new(settings.clone()))
}

fn fit_of(drawing: &Drawing, settings: &Effective) -> Fit {
    let snapshot = snapshot(drawing, settings);
    match fit(&snapshot.drawing, &snapshot.outlines, settings, &|| true) {
        Ok(fit) => fit,
        Err(refusal) => panic!("{refusal:?}"),
    }
}

fn findings(drawing: &Drawing, settings: &Effective, rule: Rule) -> Vec<Finding> {
    let mut analysis = Analysis::new(drawing, Arc::new(settings.clone()));
    let (mut findings, _) = analysis.findings(drawing, usize::MAX);
    findings.retain(|finding| finding.rule == rule);
    findings
}
