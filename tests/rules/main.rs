//! The rules on segments and on contours: what they see in a drawing, however it is drawn, and that a fix lets it go.

mod chords;
mod corners;
mod crumbs;
mod doubles;
mod ends;
mod joined;
mod sides;
mod whole;

use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Role, Vertex};
use wedm::finding::{Detail, Finding, Rule, Severity};
use wedm::geometry::{Segment, positive_angle};
use wedm::settings::{Effective, Settings};

/// A contour by its vertices.
#[derive(Clone, Debug)]
struct Shape {
    closed: bool,
    vertices: Vec<(f64, f64, f64)>,
}

fn closed(vertices: &[(f64, f64, f64)]) -> Shape {
    Shape {
        closed: true,
        vertices: vertices.to_vec(),
    }
}

fn open(vertices: &[(f64, f64, f64)]) -> Shape {
    Shape {
        closed: false,
        vertices: vertices.to_vec(),
    }
}

fn entity(geometry: Geometry, role: Option<Role>) -> Entity {
    Entity {
        handle: "A".into(),
        layer: "0".into(),
        role,
        kind: Kind::Line,
        geometry,
    }
}

/// A drawing of these, in their order.
fn drawing_of(geometries: impl IntoIterator<Item = Geometry>, role: Option<Role>) -> Drawing {
    let mut drawing = Drawing::new(None);
    for geometry in geometries {
        drawing.push(entity(geometry, role));
    }
    drawing
}

impl Shape {
    fn geometry(&self) -> Geometry {
        Geometry::Polyline {
            closed: self.closed,
            vertices: self
                .vertices
                .iter()
                .map(|&(x, y, bulge)| Vertex::new(x, y, bulge))
                .collect(),
        }
    }

    fn as_polyline(&self, role: Option<Role>) -> Drawing {
        drawing_of([self.geometry()], role)
    }

    fn as_chain(&self, role: Option<Role>) -> Drawing {
        let mut drawing = Drawing::new(None);
        for segment in self.geometry().segments() {
            let geometry = match segment {
                Segment::Line(line) => Geometry::Line {
                    start: line.start,
                    end: line.end,
                },
                Segment::Arc(arc) => {
                    let arc = if arc.sweep > 0.0 { arc } else { arc.reversed() };
                    let (start_angle, end_angle) = (
                        positive_angle(arc.start_angle),
                        positive_angle(arc.start_angle + arc.sweep),
                    );
                    Geometry::Arc {
                        center: arc.center,
                        radius: arc.radius,
                        start_angle,
                        end_angle,
                    }
                }
            };
            drawing.push(entity(geometry, role));
        }
        drawing
    }

    /// Mirrored at the y axis: what turned left turns right.
    fn mirrored(&self) -> Shape {
        Shape {
            vertices: self
                .vertices
                .iter()
                .map(|&(x, y, bulge)| (-x, y, -bulge))
                .collect(),
            ..*self
        }
    }

    /// The other way round.
    fn reversed(&self) -> Shape {
        let count = self.vertices.len();
        let vertices = (0..count).map(|at| {
            let (x, y, _) = self.vertices[count - 1 - at];
            let bulge = match (at + 2).cmp(&(count + 1)) {
                std::cmp::Ordering::Less => self.vertices[count - 2 - at].2,
                _ => self.vertices[count - 1].2,
            };
            (x, y, -bulge)
        });
        Shape {
            vertices: vertices.collect(),
            ..*self
        }
    }

    fn begun_elsewhere(&self) -> Shape {
        let mut vertices = self.vertices.clone();
        if self.closed {
            vertices.rotate_left(self.vertices.len() / 2);
        }
        Shape { vertices, ..*self }
    }
}

/// The rules are tried on all that they see; what is too small to be said has a test of its own.
fn settings() -> Arc<Effective> {
    saying_from(0.0)
}

fn saying_from(resolution: f64) -> Arc<Effective> {
    Arc::new(Effective::of(&Settings {
        correction: Some(0.1),
        resolution: Some(resolution),
        ..Settings::default()
    }))
}

fn analysed(drawing: &Drawing) -> (Analysis, Vec<Finding>) {
    analysed_under(drawing, settings())
}

fn analysed_under(drawing: &Drawing, settings: Arc<Effective>) -> (Analysis, Vec<Finding>) {
    let mut analysis = Analysis::new(drawing, settings);
    let (findings, count) = analysis.findings(drawing, usize::MAX);
    assert_eq!(findings.len(), count, "what is counted is told");
    (analysis, findings)
}

fn severities(findings: &[Finding], rule: Rule) -> Vec<Severity> {
    let of_rule = findings.iter().filter(|finding| finding.rule == rule);
    of_rule.map(|finding| finding.severity).collect()
}

/// The places of a rule: one finding may stand for several.
fn count(findings: &[Finding], rule: Rule) -> usize {
    let places = |finding: &Finding| match finding.detail {
        Detail::SharpCorners { count, .. } | Detail::NearTangents { count, .. } => count,
        Detail::ArcsAsChords { arcs, .. } => arcs,
        _ => 1,
    };
    let of_rule = findings.iter().filter(|finding| finding.rule == rule);
    of_rule.map(places).sum()
}

/// The drawing after the first fix of a finding.
fn repaired(drawing: &Drawing, analysis: &Analysis, finding: &Finding) -> Drawing {
    let fixes = analysis.fixes(drawing, finding);
    let mut repaired = drawing.clone();
    repaired.apply(&fixes.first().expect("a fix").edit).unwrap();
    repaired
}

/// Every way to draw the shape.
fn drawings(shape: &Shape, role: Option<Role>) -> Vec<Drawing> {
    let shapes = [
        shape.clone(),
        shape.mirrored(),
        shape.reversed(),
        shape.begun_elsewhere(),
        shape.reversed().mirrored().begun_elsewhere(),
    ];
    shapes
        .iter()
        .flat_map(|shape| [shape.as_polyline(role), shape.as_chain(role)])
        .collect()
}

/// Asserts that the rule sees this many places however the shape is drawn, and, one at a time, that its fixes let them go where
/// `fixable` says so, leaving nothing worse behind.
fn check(shape: &Shape, role: Option<Role>, rule: Rule, expected: usize, fixable: bool) {
    for (way, mut drawing) in drawings(shape, role).into_iter().enumerate() {
        let (mut analysis, mut findings) = analysed(&drawing);
        assert_eq!(count(&findings, rule), expected, "way {way}: {findings:#?}");
        let worse = |findings: &[Finding]| {
            findings
                .iter()
                .filter(|finding| finding.severity <= Severity::Warning)
                .count()
        };
        let before = worse(&findings);
        for left in (0..expected).rev().filter(|_| fixable) {
            let finding = findings
                .iter()
                .find(|finding| finding.rule == rule)
                .unwrap();
            let fixes = analysis.fixes(&drawing, finding);
            let fix = fixes
                .first()
                .unwrap_or_else(|| panic!("way {way}: no fix for {finding:?}"));
            drawing.apply(&fix.edit).unwrap();
            (analysis, findings) = analysed(&drawing);
            assert_eq!(
                count(&findings, rule),
                left,
                "way {way}: {fix:#?} {findings:#?}"
            );
        }
        assert!(worse(&findings) <= before, "way {way}: {findings:#?}");
    }
}

const SQUARE: [(f64, f64, f64); 4] = [
    (0.0, 0.0, 0.0),
    (10.0, 0.0, 0.0),
    (10.0, 10.0, 0.0),
    (0.0, 10.0, 0.0),
];

/// The drawing after "fix all", again and again until it has nothing more to offer.
fn all_fixed(mut drawing: Drawing) -> Drawing {
    for _ in 0..12 {
        let Some(edit) = Analysis::new(&drawing, settings()).fix_all(&drawing) else {
            return drawing;
        };
        // An arc in the place of chords, whose kinks were none, may nearly be tangent at its ends.
        let left = |drawing: &Drawing| {
            let findings = analysed(drawing).1;
            let others = findings
                .iter()
                .filter(|finding| finding.rule != Rule::NearTangent);
            let entities = drawing.entities();
            let segments = entities.map(|(_, entity)| entity.geometry.segment_count());
            (others.count(), segments.sum::<usize>())
        };
        let before = left(&drawing);
        drawing.apply(&edit).unwrap();
        assert!(left(&drawing) < before);
    }
    panic!("there is no end to the fixes");
}
