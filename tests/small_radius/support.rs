//! What the tests of the small-radius rule share: drawings, faults, fixes, distances.

use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Role, Vertex};
use wedm::finding::{Detail, Place};
use wedm::geometry::{Point, Segment};
use wedm::settings::{Effective, Settings};

pub fn polyline(vertices: &[[f64; 3]], closed: bool) -> Geometry {
    Geometry::Polyline {
        closed,
        vertices: vertices
            .iter()
            .map(|&[x, y, bulge]| Vertex::new(x, y, bulge))
            .collect(),
    }
}

pub fn drawing_of(geometry: Geometry, role: Role) -> Drawing {
    let mut drawing = Drawing::new(None);
    drawing.push(Entity {
        handle: "2A".into(),
        layer: "0".into(),
        role: Some(role),
        kind: wedm::drawing::Kind::LightPolyline,
        geometry,
    });
    drawing
}

pub fn settings(correction: f64) -> Arc<Effective> {
    Arc::new(Effective::of(&Settings {
        correction: Some(correction),
        margin: Some(0.0),
        ..Settings::default()
    }))
}

/// Faults as (segment, radius).
pub fn faults(drawing: &Drawing, settings: &Arc<Effective>) -> Vec<(usize, f64)> {
    let (findings, _) = Analysis::new(drawing, settings.clone()).findings(drawing, usize::MAX);
    let fault = |finding: wedm::finding::Finding| match (finding.place, finding.detail) {
        (Place::Segment { segment, .. }, Detail::SmallRadius(numbers)) => {
            Some((segment, numbers.radius))
        }
        _ => None,
    };
    findings.into_iter().filter_map(fault).collect()
}

/// Fix-all first, then single preferred fixes, until nothing is left to do.
pub fn fix(drawing: &mut Drawing, settings: &Arc<Effective>) {
    for _ in 0..12 {
        let mut analysis = Analysis::new(drawing, settings.clone());
        let single = || {
            let (findings, _) = analysis.findings(drawing, usize::MAX);
            findings
                .iter()
                .find_map(|finding| {
                    analysis
                        .fixes(drawing, finding)
                        .into_iter()
                        .find(|fix| fix.preferred)
                })
                .map(|fix| fix.edit)
        };
        let Some(edit) = Analysis::new(drawing, settings.clone())
            .fix_all(drawing)
            .or_else(single)
        else {
            return;
        };
        drawing.apply(&edit).expect("a fix applies");
    }
}

/// Largest distance of either outline's samples from the other.
pub fn apart(one: &[Segment], other: &[Segment]) -> f64 {
    let one_way = |from: &[Segment], to: &[Segment]| {
        let samples = from
            .iter()
            .flat_map(|segment| (0..24).map(|k| segment.point_at(k as f64 / 24.0)));
        let nearest = |point: Point| {
            to.iter()
                .map(|segment| segment.distance_to(point))
                .fold(f64::INFINITY, f64::min)
        };
        samples.map(nearest).fold(0.0, f64::max)
    };
    one_way(one, other).max(one_way(other, one))
}

pub fn all_segments(drawing: &Drawing) -> Vec<Segment> {
    drawing
        .entities()
        .flat_map(|(_, entity)| entity.geometry.segments().collect::<Vec<_>>())
        .collect()
}
