//! Figures, and what the rules say of them.

mod contacts;
mod room;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Role, Vertex};
use wedm::finding::{Detail, Finding, Rule, Severity};
use wedm::settings::{Effective, Settings};

fn closed(vertices: &[[f64; 3]]) -> Geometry {
    Geometry::Polyline {
        closed: true,
        vertices: vertices
            .iter()
            .map(|&[x, y, bulge]| Vertex::new(x, y, bulge))
            .collect(),
    }
}

fn ring(points: &[[f64; 2]]) -> Geometry {
    closed(&points.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>())
}

fn open(points: &[[f64; 2]]) -> Geometry {
    Geometry::Polyline {
        closed: false,
        vertices: points
            .iter()
            .map(|&[x, y]| Vertex::new(x, y, 0.0))
            .collect(),
    }
}

fn circle(center: [f64; 2], radius: f64) -> Geometry {
    Geometry::Circle {
        center: center.into(),
        radius,
    }
}

fn arc(center: [f64; 2], radius: f64, from: f64, to: f64) -> Geometry {
    Geometry::Arc {
        center: center.into(),
        radius,
        start_angle: from,
        end_angle: to,
    }
}

fn square(x: f64, y: f64, side: f64) -> Geometry {
    ring(&[[x, y], [x + side, y], [x + side, y + side], [x, y + side]])
}

/// What the rule finds among `entities` at a correction of 0.1 mm.
fn found(entities: &[Geometry], role: Role, rule: Rule) -> (Drawing, Analysis, Vec<Finding>) {
    let mut drawing = Drawing::new(None);
    for geometry in entities {
        let role = (role != Role::Both).then_some(role);
        drawing.push(Entity {
            handle: "A".into(),
            layer: "0".into(),
            role,
            kind: wedm::drawing::Kind::Line,
            geometry: geometry.clone(),
        });
    }
    // Where open contours are errors, little is asked of them.
    let open_contours_are_let_be = [(
        "open-contour".to_owned(),
        wedm::settings::RuleSeverity::Warning,
    )];
    let settings = Arc::new(Effective::of(&Settings {
        correction: Some(0.1),
        rules: Some(open_contours_are_let_be.into()),
        ..Settings::default()
    }));
    let mut analysis = Analysis::new(&drawing, settings);
    let (mut findings, _) = analysis.findings(&drawing, usize::MAX);
    findings.retain(|finding| finding.rule == rule);
    (drawing, analysis, findings)
}
