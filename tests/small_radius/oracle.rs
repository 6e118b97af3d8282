//! Outlines whose faults and corrected forms are known.

use super::support::{all_segments, apart, drawing_of, faults, fix, polyline, settings};
use serde::Deserialize;
use std::path::PathBuf;
use wedm::drawing::Role;
use wedm::geometry::Segment;

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
    let folder = std::env::var_os("WEDM_SHARED").map_or_else(
        || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared"),
        PathBuf::from,
    );
    let text = std::fs::read_to_string(folder.join("oracles").join(name)).ok()?;
    Some(serde_json::from_str(&text).expect("the oracle is JSON of the form above"))
}

#[test]
fn faults_and_corrected_outlines_of_the_oracle() {
    let Some(oracle) = oracle("small_radius.json") else {
        println!("skipped: no oracle on this machine");
        return;
    };
    let mut wrong = Vec::new();
    for case in &oracle.cases {
        let role = if case.role == "die" {
            Role::Opening
        } else {
            Role::Punch
        };
        let settings = settings(case.correction);
        let mut drawing = drawing_of(polyline(&case.vertices, case.closed), role);
        let found = faults(&drawing, &settings);
        let same = found.len() == case.violations.len()
            && found
                .iter()
                .zip(&case.violations)
                .all(|(f, v)| f.0 == v.segment && (f.1 - v.radius).abs() < 1e-9);
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
