//! Where no fix is offered the finding says why; and an arc that is drawn in two, or beside a wall that a larger arc all but uses up,
//! is mended as the same arc is elsewhere.

use super::support::{drawing_of, faults};
use crate::size::by_day;
use crate::star::{Corner, Star, star};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Geometry, Role, Vertex};
use wedm::finding::{Detail, NoFix, Severity};
use wedm::geometry::Segment;
use wedm::settings::{Effective, Settings};

const CORRECTION: f64 = 0.2;

fn settings() -> Arc<Effective> {
    Arc::new(Effective::of(&Settings {
        correction: Some(CORRECTION),
        ..Settings::default()
    }))
}

fn outline(vertices: &[Vertex], role: Role) -> Drawing {
    drawing_of(
        Geometry::Polyline {
            closed: true,
            vertices: vertices.to_vec(),
        },
        role,
    )
}

/// Errors and warnings.
fn grave(drawing: &Drawing) -> usize {
    let (findings, _) = Analysis::new(drawing, settings()).findings(drawing, usize::MAX);
    findings
        .iter()
        .filter(|finding| finding.severity <= Severity::Warning)
        .count()
}

/// How many arcs at fault have no preferred fix; the reasons of those that say one.
fn refused(drawing: &Drawing) -> (usize, Vec<NoFix>) {
    let mut analysis = Analysis::new(drawing, settings());
    let (findings, _) = analysis.findings(drawing, usize::MAX);
    let (mut refused, mut reasons) = (0, Vec::new());
    for finding in &findings {
        let Detail::SmallRadius(numbers) = &finding.detail else {
            continue;
        };
        let preferred = analysis
            .fixes(drawing, finding)
            .into_iter()
            .find(|fix| fix.preferred);
        refused += usize::from(preferred.is_none());
        reasons.extend(numbers.no_fix);
        if let Some(fix) = preferred {
            let mut fixed = drawing.clone();
            fixed.apply(&fix.edit).expect("a fix applies");
            assert!(grave(&fixed) < grave(drawing), "{finding:?}");
        }
    }
    (refused, reasons)
}

/// The outline with every arc at fault split at a share of it; the new vertex is rounded to this many decimals.
fn split(vertices: &[Vertex], share: f64, decimals: i32) -> Vec<Vertex> {
    let scale = 10f64.powi(decimals);
    let round = |number: f64| (number * scale).round() / scale;
    let mut more = Vec::new();
    for (at, &vertex) in vertices.iter().enumerate() {
        let next = vertices[(at + 1) % vertices.len()].point;
        match Segment::from_bulge(vertex.point, next, vertex.bulge) {
            Segment::Arc(arc) if arc.radius < CORRECTION => {
                let middle = arc.point_at(share);
                let middle = wedm::geometry::Point::new(round(middle.x), round(middle.y));
                let bulge = |share: f64| (arc.sweep * share / 4.0).tan();
                more.push(Vertex {
                    bulge: bulge(share),
                    ..vertex
                });
                more.push(Vertex {
                    point: middle,
                    bulge: bulge(1.0 - share),
                });
            }
            _ => more.push(vertex),
        }
    }
    more
}

fn stars_of_fillets() -> impl Strategy<Value = Star> {
    (
        proptest::collection::vec((0.6..1.4f64, 3.0..6.0f64, 0.03..0.12f64), 4..8),
        any::<bool>(),
    )
        .prop_map(|(corners, clockwise)| {
            let corner = |(step, radius, length)| (step, radius, 0.0, Corner::Fillet { length });
            Star {
                corners: corners.into_iter().map(corner).collect(),
                clockwise,
            }
        })
}

fn cases(usual: u32) -> u32 {
    std::env::var("PROPTEST_CASES")
        .ok()
        .and_then(|number| number.parse().ok())
        .map_or(usual, |cases: u32| cases.min(usual))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(4, 30)), failure_persistence: None, rng_seed: RngSeed::Fixed(20261122), ..ProptestConfig::default() })]

    #[test]
    fn every_refusal_says_why(star in star(), role in 0..3usize, share in 0.1..0.9f64, decimals in 3..13i32) {
        let role = [Role::Opening, Role::Punch, Role::Both][role];
        for vertices in [star.vertices(), split(&star.vertices(), share, decimals)] {
            prop_assume!(!super::opening::crosses_itself(&vertices));
            let drawing = outline(&vertices, role);
            let (refused, reasons) = refused(&drawing);
            prop_assert_eq!(refused, reasons.len(), "{:?} {:?}", reasons, vertices);
        }
    }

    #[test]
    fn an_arc_in_two_is_mended_as_one(star in stars_of_fillets(), role in 0..3usize, share in 0.1..0.9f64, decimals in 3..13i32) {
        let role = [Role::Opening, Role::Punch, Role::Both][role];
        let (whole, parts) = (star.vertices(), split(&star.vertices(), share, decimals));
        let (whole, parts) = (outline(&whole, role), outline(&parts, role));
        let (refused_whole, refused_parts) = (refused(&whole), refused(&parts));
        prop_assert!(refused_whole.0 > 0 || refused_parts.0 == 0, "{:?} {:?}", refused_parts, faults(&parts, &settings()));
    }
}

/// A wall between two fillets that the larger arcs leave only a crumb of.
#[test]
fn a_wall_that_is_all_but_used_up_is_swallowed() {
    // Corners of a square pocket with a step: the fillet of 0.1 beside a wall whose other end is a corner of the part.
    let bulge = (std::f64::consts::PI / 8.0).tan();
    for left in [0.0, 1e-7, 1e-5, 1e-3, 0.003, 0.0049, 0.0051, 0.02] {
        // The larger arc, of 0.201 mm, ends so much before the wall does.
        let wall = 0.101 + left;
        let vertices = [
            (0.0, 0.0, 0.0),
            (9.9, 0.0, bulge),
            (10.0, 0.1, 0.0),
            (10.0, 0.1 + wall, 0.0),
            (12.0, 0.1 + wall, 0.0),
            (12.0, 10.0, 0.0),
            (0.0, 10.0, 0.0),
        ];
        let vertices: Vec<Vertex> = vertices
            .iter()
            .map(|&(x, y, bulge)| Vertex::new(x, y, bulge))
            .collect();
        for role in [Role::Opening, Role::Both] {
            let (refused, reasons) = refused(&outline(&vertices, role));
            assert_eq!(
                (refused, reasons),
                (0, vec![]),
                "{left} of the wall would be left"
            );
        }
    }
}
