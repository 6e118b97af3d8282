//! Open contours with a side: the path beside them, its proof by distances alone, and the programs that come of it.

mod judged;
mod paths;
use crate::support::generate;
use proptest::prelude::*;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use wedm::document::{self, Source as Of};
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Unit, Vertex};
use wedm::finding::{Finding, Rule, Severity};
use wedm::geometry::Point;
use wedm::job::{self, Refusal};
use wedm::program::{Document, Format};
use wedm::settings::{Effective, from_toml};
use wedm::toolpath::{Source, WirePath};

/// x, y, bulge.
type Corners<'a> = &'a [[f64; 3]];

const STRIP: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [10.0, 0.0, 0.5],
    [16.0, 0.0, 0.0],
    [16.0, 8.0, -0.3],
    [22.0, 8.0, 0.0],
    [30.0, 8.0, 0.0],
];

fn settings(text: &str) -> Effective {
    let (settings, mut errors) = from_toml(text);
    // A lead may be next to nothing here, which is only warned of.
    errors.retain(|error| !error.message.contains("within the kerf"));
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

/// Polylines by handle, each open or closed.
fn drawing(polylines: &[(&str, bool, Corners)]) -> Drawing {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    for (handle, closed, corners) in polylines {
        let vertices = corners
            .iter()
            .map(|&[x, y, bulge]| Vertex::new(x, y, bulge));
        drawing.push(Entity {
            handle: (*handle).into(),
            layer: "0".into(),
            role: None,
            kind: Kind::LightPolyline,
            geometry: Geometry::Polyline {
                closed: *closed,
                vertices: vertices.collect(),
            },
        });
    }
    drawing
}

fn document(drawing: &Drawing, settings: &Effective) -> document::Document {
    document::Document::new(
        Of::Cad(Arc::new(drawing.clone())),
        Arc::new(settings.clone()),
    )
}

fn rules(drawing: &Drawing, settings: &Effective) -> Vec<(Rule, Severity)> {
    let findings = document(drawing, settings).all_findings().to_vec();
    let told = |finding: &Finding| (finding.rule, finding.severity);
    findings.iter().map(told).collect()
}

fn paths(drawing: &Drawing, settings: &Effective) -> Result<Vec<WirePath>, Refusal> {
    let snapshot = document(drawing, settings).snapshot().expect("a drawing");
    Ok(job::planned(&snapshot, settings, None, false, &())?.paths)
}
