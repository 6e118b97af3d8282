//! The fit of random polygons against an erosion and dilation by sampling alone.

use super::{drawing, pair, polyline, rounded, snapshot};
use crate::size::by_day;
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::Drawing;
use wedm::finding::{Rule, Severity};
use wedm::fit::fit;
use wedm::geometry::{Point, Vector};
use wedm::settings::Effective;

/// A contour as points, for an independent erosion and dilation.
fn sampled(drawing: &Drawing, settings: &Effective, step: f64) -> Vec<(Point, Vector)> {
    let snapshot = snapshot(drawing, settings);
    let mut points = Vec::new();
    let segments: Vec<_> = snapshot.outlines[0]
        .contour
        .segments(drawing)
        .map(|segment| segment.geometry)
        .collect();
    for (at, segment) in segments.iter().enumerate() {
        let count = (segment.length() / step).ceil().max(2.0) as usize;
        for share in 0..count {
            let share = share as f64 / count as f64;
            let tangent = segment.tangent_at(share);
            points.push((segment.point_at(share), Vector::new(-tangent.y, tangent.x)));
        }
        // The fan of a corner.
        let next = &segments[(at + 1) % segments.len()];
        let (from, to) = (segment.end_tangent(), next.start_tangent());
        let turn = (from.x * to.y - from.y * to.x).atan2(from.dot(&to));
        let fan = (turn.abs() * 60.0).ceil() as usize;
        for step in 0..=fan {
            let angle = from.y.atan2(from.x) + turn * step as f64 / fan.max(1) as f64;
            points.push((segment.end(), Vector::new(-angle.sin(), angle.cos())));
        }
    }
    points
}

/// Points by cells, to ask for the nearest.
struct Cloud {
    cells: std::collections::HashMap<(i64, i64), Vec<Point>>,
    size: f64,
}

impl Cloud {
    fn new(points: impl Iterator<Item = Point>, size: f64) -> Cloud {
        let mut cells: std::collections::HashMap<(i64, i64), Vec<Point>> = Default::default();
        for point in points {
            cells
                .entry((
                    (point.x / size).floor() as i64,
                    (point.y / size).floor() as i64,
                ))
                .or_default()
                .push(point);
        }
        Cloud { cells, size }
    }

    /// The distance to the nearest point, where that is within a few cells.
    fn distance(&self, at: Point) -> f64 {
        let (column, row) = (
            (at.x / self.size).floor() as i64,
            (at.y / self.size).floor() as i64,
        );
        let mut least = f64::INFINITY;
        for reach in 0..10_i64 {
            if least <= (reach - 1) as f64 * self.size {
                break;
            }
            for x in -reach..=reach {
                for y in -reach..=reach {
                    if x.abs().max(y.abs()) == reach {
                        for point in self.cells.get(&(column + x, row + y)).into_iter().flatten() {
                            least = least.min((point - at).norm());
                        }
                    }
                }
            }
        }
        least
    }
}

/// Places beside a contour (to the left where `off` is above 0) that are not nearer than `least` to any point of a cloud, by sampling alone;
/// where they end, to a micrometre.
fn beside(contour: &[(Point, Vector)], cloud: &Cloud, off: f64, least: f64) -> Vec<Point> {
    let is_free = |at: Point| cloud.distance(at) >= least;
    let mut free = Vec::new();
    for (at, &(point, normal)) in contour.iter().enumerate() {
        let (next, next_normal) = contour[(at + 1) % contour.len()];
        let between = |share: f64| {
            let normal = normal + (next_normal - normal) * share;
            point + (next - point) * share + normal.try_normalize(0.0).unwrap_or(normal) * off
        };
        let is_here = is_free(between(0.0));
        if is_here {
            free.push(between(0.0));
        }
        if is_here != is_free(between(1.0)) {
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..14 {
                let middle = (low + high) / 2.0;
                if is_free(between(middle)) == is_here {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            free.push(between(if is_here { low } else { high }));
        }
    }
    free
}

/// How deep punch and plate stand in each other by sampling; below 0 where they do not.
fn depth_by_sampling(contour: &[(Point, Vector)], corrections: [f64; 2], half: f64) -> f64 {
    let walls = Cloud::new(contour.iter().map(|(point, _)| *point), 0.04);
    // Counter-clockwise: the punch's wire runs on the right, the plate's on the left.
    let ways = [-1.0, 1.0].map(|side| {
        let correction = corrections[usize::from(side > 0.0)];
        let way = beside(contour, &walls, side * correction, correction - 2e-5);
        Cloud::new(way.into_iter(), 0.04)
    });
    let mut deepest = f64::NEG_INFINITY;
    for (own, side) in [(0, -1.0), (1, 1.0)] {
        // What a wire leaves of its part lies at half a kerf from its way, and nowhere nearer.
        let off = side * (corrections[own] - half);
        for edge in beside(contour, &ways[own], off, half - 3e-5) {
            deepest = deepest.max(ways[1 - own].distance(edge) - half);
        }
    }
    deepest
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: by_day(1, 4), ..ProptestConfig::default() })]

    /// Every misfit is found, and none invented.
    #[test]
    fn the_fit_is_that_of_erosion_and_dilation_by_sampling(
        radii in proptest::collection::vec((0.4..0.9f64, prop_oneof![2 => Just(0.0), 3 => 0.02..0.14f64]), 4..8),
        is_punch in any::<bool>(),
        half in 0.06..0.12f64,
        clearance in 0.008..0.03f64,
    ) {
        let count = radii.len();
        let corners: Vec<(Point, f64)> = radii
            .iter()
            .enumerate()
            .map(|(at, (radius, fillet))| {
                let angle = TAU * at as f64 / count as f64;
                (Point::new(radius * angle.cos(), radius * angle.sin()), *fillet)
            })
            .collect();
        let drawing = drawing(vec![polyline("0", "2A", rounded(&corners))]);
        let own = pair(if is_punch { "punch" } else { "plate" }, half, clearance);
        let errors = Analysis::new(&drawing, Arc::new(own.clone())).findings(&drawing, usize::MAX).0;
        let is_sound = errors.iter().all(|finding| finding.rule == Rule::DoesNotFit || finding.severity != Severity::Error);
        prop_assume!(is_sound);
        let snapshot = snapshot(&drawing, &own);
        let Ok(found) = fit(&drawing, &snapshot.outlines, &own, &|| true) else {
            return Err(TestCaseError::reject("no path"));
        };
        let corrections = match is_punch {
            true => [half, half - clearance],
            false => [half - clearance, half],
        };
        let contour = sampled(&drawing, &own, 0.002);
        let depth = depth_by_sampling(&contour, corrections, half);
        let left = found.least();
        if left < -1e-4 || depth > 1e-4 {
            prop_assert!((depth + left).abs() < 1.5e-4, "sampled {depth}, found {left}");
        }
    }
}
