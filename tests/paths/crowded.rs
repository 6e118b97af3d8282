//! Corrections much larger than the segments: what a path costs is bounded, and where none is laid, that is said.

use super::{drawing, settings};
use wedm::drawing::{Geometry, Role, Vertex};
use wedm::finding::{Detail, Rule, Severity};
use wedm::settings::Effective;
use wedm::toolpath::{Refusal, plan};

/// A star of this many points with tips 50 mm from its middle.
fn star(points: usize) -> Geometry {
    let vertex = |at: usize| {
        let angle = std::f64::consts::TAU * at as f64 / points as f64;
        let radius = if at.is_multiple_of(2) { 48.0 } else { 50.0 };
        Vertex::new(radius * angle.cos(), radius * angle.sin(), 0.0)
    };
    Geometry::Polyline {
        closed: true,
        vertices: (0..points).map(vertex).collect(),
    }
}

/// The rules that refuse a path along a star, and nothing where there is one.
fn refused(points: usize, role: Role, correction: f64) -> Vec<Rule> {
    let (drawing, outlines) = drawing(&[("2A", Some(role), star(points))]);
    let settings = Effective {
        correction,
        corrections: vec![correction],
        lead_in: 3.0 * correction,
        ..settings()
    };
    match plan(&drawing, &outlines, &settings, None) {
        Ok(_) => Vec::new(),
        Err(Refusal::Findings(found)) => {
            for one in &found {
                let is_crowded = matches!(one.detail, Detail::NotJudged(_));
                assert!(!is_crowded || one.severity == Severity::Error, "{one:?}");
            }
            found.iter().map(|one| one.rule).collect()
        }
        other => panic!("{points} {role:?} {correction}: {other:?}"),
    }
}

#[test]
fn no_path_is_laid_where_too_many_segments_lie_within_the_correction() {
    for role in [Role::Opening, Role::Punch] {
        assert_eq!(refused(3000, role, 50.0), [Rule::NotJudged], "{role:?}");
        // Few segments are looked at, however large the correction is.
        let few = refused(100, role, 50.0);
        assert!(!few.contains(&Rule::NotJudged), "{role:?}: {few:?}");
        let usual = refused(3000, role, 0.1);
        assert!(!usual.contains(&Rule::NotJudged), "{role:?}: {usual:?}");
    }
    assert_eq!(refused(100, Role::Opening, 50.0), [Rule::OffsetCollapse]);
}
