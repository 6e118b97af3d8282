//! The small-radius rule against outlines whose faults and corrected forms are known.

use serde::Deserialize;
use std::path::PathBuf;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Role, Vertex};
use wedm::finding::{Detail, Place};
use wedm::geometry::{Point, Segment};
use wedm::settings::{Effective, Settings};

#[derive(Deserialize)]
struct Oracle {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    id: String,
    role: String,
    correction: f64,
    closed: bool,
    vertices: Vec<[f64; 3]>,
    violations: Vec<Violation>,
    fixed: Vec<[f64; 3]>,
}

#[derive(Deserialize)]
struct Violation {
    segment: usize,
    radius: f64,
}

/// The folder with the oracles, where this machine has one.
fn oracle(name: &str) -> Option<Oracle> {
    let folder = std::env::var_os("WEDM_SHARED").map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared"), PathBuf::from);
    let text = std::fs::read_to_string(folder.join("oracles").join(name)).ok()?;
    Some(serde_json::from_str(&text).expect("the oracle is JSON of the form above"))
}

fn polyline(vertices: &[[f64; 3]], closed: bool) -> Geometry {
    Geometry::Polyline { closed, vertices: vertices.iter().map(|&[x, y, bulge]| Vertex::new(x, y, bulge)).collect() }
}

fn drawing_of(geometry: Geometry, role: Role) -> Drawing {
    let mut drawing = Drawing::new(None);
    drawing.push(Entity { handle: "2A".into(), layer: "0".into(), role: Some(role), kind: "LWPOLYLINE", geometry });
    drawing
}

fn settings(correction: f64) -> Arc<Effective> {
    Arc::new(Effective::of(&Settings { correction: Some(correction), margin: Some(0.0), ..Settings::default() }))
}

/// Faults as (segment, radius).
fn faults(drawing: &Drawing, settings: &Arc<Effective>) -> Vec<(usize, f64)> {
    let (findings, _) = Analysis::new(drawing, settings.clone()).findings(drawing, usize::MAX);
    let fault = |finding: wedm::finding::Finding| match (finding.place, finding.detail) {
        (Place::Segment { segment, .. }, Detail::SmallRadius(numbers)) => (segment, numbers.radius),
        other => panic!("{other:?}"),
    };
    findings.into_iter().map(fault).collect()
}

/// Fix-all first, then single preferred fixes, until nothing is left to do.
fn fix(drawing: &mut Drawing, settings: &Arc<Effective>) {
    for _ in 0..12 {
        let mut analysis = Analysis::new(drawing, settings.clone());
        let single = || {
            let (findings, _) = analysis.findings(drawing, usize::MAX);
            findings.iter().find_map(|finding| analysis.fixes(drawing, finding).into_iter().find(|fix| fix.preferred)).map(|fix| fix.edit)
        };
        let Some(edit) = Analysis::new(drawing, settings.clone()).fix_all(drawing).or_else(single) else { return };
        drawing.apply(&edit).expect("a fix applies");
    }
}

/// Largest distance of either outline's samples from the other.
fn apart(one: &[Segment], other: &[Segment]) -> f64 {
    let one_way = |from: &[Segment], to: &[Segment]| {
        let samples = from.iter().flat_map(|segment| (0..24).map(|k| segment.point_at(k as f64 / 24.0)));
        let nearest = |point: Point| to.iter().map(|segment| segment.distance_to(point)).fold(f64::INFINITY, f64::min);
        samples.map(nearest).fold(0.0, f64::max)
    };
    one_way(one, other).max(one_way(other, one))
}

fn all_segments(drawing: &Drawing) -> Vec<Segment> {
    drawing.entities().flat_map(|(_, entity)| entity.geometry.segments().collect::<Vec<_>>()).collect()
}

#[test]
fn faults_and_corrected_outlines_of_the_oracle() {
    let Some(oracle) = oracle("small_radius.json") else {
        println!("skipped: no oracle on this machine");
        return;
    };
    let mut wrong = Vec::new();
    for case in &oracle.cases {
        let role = if case.role == "die" { Role::Opening } else { Role::Punch };
        let settings = settings(case.correction);
        let mut drawing = drawing_of(polyline(&case.vertices, case.closed), role);
        let found = faults(&drawing, &settings);
        let same = found.len() == case.violations.len()
            && found.iter().zip(&case.violations).all(|(f, v)| f.0 == v.segment && (f.1 - v.radius).abs() < 1e-9);
        if !same {
            wrong.push(format!("{}: found {found:?}", case.id));
        }
        fix(&mut drawing, &settings);
        let left = faults(&drawing, &settings);
        let expected: Vec<Segment> = polyline(&case.fixed, case.closed).segments().collect();
        let off = apart(&all_segments(&drawing), &expected);
        if !left.is_empty() || off > 1e-6 {
            wrong.push(format!("{}: left {left:?}, off by {off}", case.id));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
