//! What the wire leaves beyond a place where it comes no further, against an opening by samples: every place of a contour is as deep as it is
//! far from the nearest disc of the correction that finds room.

mod random;
mod told;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Role, Vertex};
use wedm::finding::{Detail, Finding, Place, Rule, Severity};
use wedm::geometry::{Point, Segment, Vector, direction, left_normal, turn};
use wedm::settings::{Effective, Settings};

const CORRECTION: f64 = 0.1;

/// Distance of the samples, and what a depth that is told may be off by them.
const SPACING: f64 = 1e-3;

const OFF: f64 = 3e-3;

/// The corner at `at`, between the ways to `before` and `behind`, cut off by so much of each.
fn chamfer(at: Point, before: Point, behind: Point, legs: [f64; 2]) -> Vec<Point> {
    [(before, legs[0]), (behind, legs[1])]
        .map(|(to, leg)| at + (to - at).normalize() * leg)
        .to_vec()
}

/// The opening of the region on one side of an outline.
struct Opening {
    segments: Vec<Segment>,
    /// +1 where the wire runs to the left.
    side: f64,
    centers: Vec<Point>,
}

impl Opening {
    fn new(vertices: &[Vertex], role: Role) -> Opening {
        let segments: Vec<Segment> = Geometry::Polyline {
            closed: true,
            vertices: vertices.to_vec(),
        }
        .segments()
        .collect();
        let area: f64 = segments
            .iter()
            .map(|segment| segment.twice_area(Point::origin()))
            .sum();
        let side = if (area > 0.0) == (role == Role::Opening) {
            1.0
        } else {
            -1.0
        };
        let mut centers = Vec::new();
        for (at, segment) in segments.iter().enumerate() {
            let samples = (segment.length() / SPACING).ceil() as usize;
            centers.extend(
                (0..=samples)
                    .map(|k| k as f64 / samples as f64)
                    .map(|share| {
                        segment.point_at(share)
                            + left_normal(segment.tangent_at(share)) * (side * CORRECTION)
                    }),
            );
            let next = &segments[(at + 1) % segments.len()];
            let (from, to) = (
                left_normal(segment.end_tangent()) * side,
                left_normal(next.start_tangent()) * side,
            );
            let turned = turn(from, to);
            if turned * side < 0.0 {
                let steps = (turned.abs() * CORRECTION / SPACING).ceil() as usize;
                let angle = from.y.atan2(from.x);
                centers.extend((0..=steps).map(|k| {
                    segment.end() + direction(angle + turned * k as f64 / steps as f64) * CORRECTION
                }));
            }
        }
        centers.retain(|&center| {
            segments
                .iter()
                .all(|segment| segment.distance_to(center) >= CORRECTION - 1e-7)
        });
        Opening {
            segments,
            side,
            centers,
        }
    }

    fn depth(&self, point: Point) -> f64 {
        self.centers
            .iter()
            .map(|center| (point - center).norm())
            .fold(f64::INFINITY, f64::min)
            - CORRECTION
    }

    /// The turn towards the wire in the vertex where a segment starts.
    fn turn(&self, index: usize) -> f64 {
        let before = &self.segments[(index + self.segments.len() - 1) % self.segments.len()];
        turn(before.end_tangent(), self.segments[index].start_tangent()) * self.side
    }

    /// How much deeper the vertex is than a single corner.
    fn beyond(&self, index: usize) -> f64 {
        self.depth(self.segments[index].start()) - self.share(index)
    }

    /// What stays of a single corner like the one in that vertex.
    fn share(&self, index: usize) -> f64 {
        CORRECTION * (1.0 / (self.turn(index).max(0.0) / 2.0).cos() - 1.0)
    }
}

fn found(vertices: &[Vertex], role: Role) -> Vec<Finding> {
    let (drawing, mut analysis) = analysed(vertices, role);
    analysis.findings(&drawing, usize::MAX).0
}

fn analysed(vertices: &[Vertex], role: Role) -> (Drawing, Analysis) {
    let mut drawing = Drawing::new(None);
    let geometry = Geometry::Polyline {
        closed: true,
        vertices: vertices.to_vec(),
    };
    drawing.push(Entity {
        handle: "A".into(),
        layer: "0".into(),
        role: Some(role),
        kind: wedm::drawing::Kind::LightPolyline,
        geometry,
    });
    let settings = Arc::new(Effective::of(&Settings {
        correction: Some(CORRECTION),
        ..Settings::default()
    }));
    let analysis = Analysis::new(&drawing, settings);
    (drawing, analysis)
}

fn count(findings: &[Finding], rule: Rule) -> usize {
    findings
        .iter()
        .filter(|finding| finding.rule == rule)
        .count()
}

/// What is told of dead ends: the segment, the farthest point, its depth.
fn dead_ends(findings: &[Finding]) -> Vec<(usize, Point, f64)> {
    let told = |finding: &Finding| match (&finding.place, &finding.detail) {
        (Place::Segment { segment, .. }, Detail::DeadEnd { near, uncut }) => {
            Some((*segment, *near, *uncut))
        }
        _ => None,
    };
    findings.iter().filter_map(told).collect()
}
