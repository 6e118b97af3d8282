//! Whether there is a repair, asked without making all of them.

use super::Analysis;
use crate::drawing::{Drawing, Entity, Geometry, Vertex};
use crate::geometry::Point;
use crate::settings::Effective;
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A fault, or a sound neighbour, about the origin. Sizes are in hundredths of the correction's order, 0.01 mm.
fn figure(kind: usize, size: f64) -> Vec<Geometry> {
    let small = 0.01 * size;
    let line = |from: (f64, f64), to: (f64, f64)| Geometry::Line {
        start: Point::new(from.0, from.1),
        end: Point::new(to.0, to.1),
    };
    let outline = |closed, corners: &[(f64, f64, f64)]| Geometry::Polyline {
        closed,
        vertices: corners
            .iter()
            .map(|&(x, y, b)| Vertex::new(x, y, b))
            .collect(),
    };
    let square = |x: f64| {
        outline(
            true,
            &[
                (x, 0.0, 0.0),
                (x + 1.0, 0.0, 0.0),
                (x + 1.0, 1.0, 0.0),
                (x, 1.0, 0.0),
            ],
        )
    };
    let circle = |radius| Geometry::Circle {
        center: Point::new(0.5, 0.5),
        radius,
    };
    let bulge = (TAU / 16.0).tan();
    match kind {
        // A corner with a tight arc.
        0 => vec![outline(
            true,
            &[
                (small, 0.0, 0.0),
                (1.0, 0.0, 0.0),
                (1.0, 1.0, 0.0),
                (0.0, 1.0, 0.0),
                (0.0, small, bulge),
            ],
        )],
        // A short segment.
        1 => vec![outline(
            true,
            &[
                (0.0, 0.0, 0.0),
                (0.5, 0.0, 0.0),
                (0.5 + 0.04 * small, 0.0, 0.0),
                (1.0, 0.0, 0.0),
                (1.0, 1.0, 0.0),
            ],
        )],
        // Lines that nearly meet, and cross others that come near.
        2 => vec![
            line((0.0, 0.0), (1.0, 0.0)),
            line((1.0, 0.1 * small), (1.0, 1.0)),
            line((1.0, 1.0), (0.0, 0.0)),
        ],
        // Doubles, whole and in part.
        3 => vec![square(0.0), square(0.0)],
        4 => {
            let corners = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0)];
            let others = [(1.0, 1.0, 0.0), (1.0, 0.2 + small, 0.0)];
            vec![outline(false, &corners), outline(false, &others)]
        }
        // A circle of chords.
        5 => {
            let chord = |at: usize| {
                let angle = TAU * at as f64 / 24.0;
                (0.5 + 0.5 * angle.cos(), 0.5 + 0.5 * angle.sin(), 0.0)
            };
            vec![outline(true, &(0..24).map(chord).collect::<Vec<_>>())]
        }
        // Crumbs, one of them twice.
        6 => vec![line((0.0, 0.0), (0.001 * small, 0.0))],
        7 => vec![square(0.0), square(1.0 + small)],
        8 => vec![circle(small.max(0.001))],
        9 => vec![circle(0.02), circle(0.02)],
        _ => vec![square(0.0)],
    }
}

fn moved(geometry: &Geometry, by: (f64, f64)) -> Geometry {
    let to = |point: Point| Point::new(point.x + by.0, point.y + by.1);
    match geometry.clone() {
        Geometry::Line { start, end } => Geometry::Line {
            start: to(start),
            end: to(end),
        },
        Geometry::Circle { center, radius } => Geometry::Circle {
            center: to(center),
            radius,
        },
        Geometry::Polyline { closed, vertices } => Geometry::Polyline {
            closed,
            vertices: vertices
                .into_iter()
                .map(|it| Vertex {
                    point: to(it.point),
                    ..it
                })
                .collect(),
        },
        other => other,
    }
}

/// A kind of figure, its size, its column and row, and its offset from that place.
type Figure = (usize, f64, (i32, i32), (f64, f64));

fn drawn(figures: &[Figure], pitch: f64) -> Drawing {
    let mut drawing = Drawing::new(None);
    for &(kind, size, (column, row), (x, y)) in figures {
        let at = (f64::from(column) * pitch + x, f64::from(row) * pitch + y);
        for geometry in figure(kind, size) {
            drawing.push(Entity::new("A", "0", moved(&geometry, at)));
        }
    }
    drawing
}

/// Whether making all repairs changes a drawing, and whether each way to ask for that says so.
fn asked(drawing: &Drawing) -> [bool; 3] {
    let mut analysis = Analysis::new(drawing, Arc::new(Effective::default()));
    let (found, _) = analysis.findings(drawing, usize::MAX);
    let all = analysis.fix_all(drawing);
    let by_found = analysis.has_fix_that(drawing, Some(&found), &|_| true);
    let by_itself = analysis.has_fix_that(drawing, None, &|_| true);
    [all.is_some(), by_found, by_itself]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// At a small pitch the figures lie within each other's reach.
    #[test]
    fn there_is_a_repair_where_all_repairs_change_something(
        figures in prop::collection::vec(
            (0..11usize, prop_oneof![0.5..12.0f64, Just(10.0)], (0..6i32, 0..6i32), (-0.3..0.3f64, -0.3..0.3f64)),
            4..24,
        ),
        far in prop::collection::vec((0..11usize, 0.5..12.0f64, (20..60i32, 0..40i32)), 8..24),
        pitch in prop::sample::select(vec![1.0, 1.05, 1.2, 1.45, 2.0]),
    ) {
        let far = far.into_iter().map(|(kind, size, at)| (kind, size, at, (0.0, 0.0)));
        let figures: Vec<_> = figures.into_iter().chain(far).collect();
        let [all, by_found, by_itself] = asked(&drawn(&figures, pitch));
        prop_assert_eq!((by_found, by_itself), (all, all));
    }
}

#[test]
fn there_is_a_repair_of_each_fault_that_lies_apart() {
    let apart = |kind: usize| {
        let fault = [(kind, 8.0, (0, 0), (0.0, 0.0))];
        let sound = (1..40).map(|at| (10, 1.0, (at, 0), (0.0, 0.0)));
        asked(&drawn(
            &fault.into_iter().chain(sound).collect::<Vec<_>>(),
            3.0,
        ))
    };
    assert_eq!([0, 1, 2, 3, 4, 5, 9].map(apart), [[true; 3]; 7]);
    assert_eq!(apart(10), [false; 3]);
}
