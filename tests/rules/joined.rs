//! Ends that lie apart, and belong together under a wider `join`.

use super::{drawing_of, entity};
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Geometry, Role};
use wedm::finding::{Finding, Rule};
use wedm::geometry::{Point, Segment, Vector, direction, turn};
use wedm::settings::{Effective, Settings};
use wedm::toolpath::{Source, plan};

const CORRECTION: f64 = 0.1;

fn settings(join: Option<f64>) -> Arc<Effective> {
    Arc::new(Effective::of(&Settings {
        correction: Some(CORRECTION),
        join,
        ..Settings::default()
    }))
}

/// A corner of an outline: by distance from the middle; how it is rounded, and the bulge of the side behind it where both corners are sharp.
#[derive(Clone, Copy, Debug)]
struct Corner {
    radius: f64,
    cut: Cut,
    bulge: f64,
}

#[derive(Clone, Copy, Debug)]
enum Cut {
    Sharp,
    /// Tangent arc, this far along both sides.
    Fillet(f64),
    /// A line, shorter than what is joined, whose ends meet their neighbours.
    Chamfer,
}

fn corners() -> impl Strategy<Value = Vec<Corner>> {
    let cut = prop_oneof![
        2 => Just(Cut::Sharp),
        3 => (0.4_f64..1.5).prop_map(Cut::Fillet),
        1 => Just(Cut::Chamfer),
    ];
    let bulge = prop_oneof![2 => Just(0.0), 1 => -0.2_f64..0.3];
    let corner =
        (8.0_f64..20.0, cut, bulge).prop_map(|(radius, cut, bulge)| Corner { radius, cut, bulge });
    prop::collection::vec(corner, 3..9)
}

/// The segments of the outline, each with whether its start is drawn exactly where the one before it ends.
fn outline(corners: &[Corner], chamfer: f64) -> Vec<(Segment, bool)> {
    let count = corners.len();
    let at = |index: usize| {
        let angle = TAU * (index % count) as f64 / count as f64;
        Point::origin() + direction(angle) * corners[index % count].radius
    };
    let along = |from: usize, to: usize| (at(to) - at(from)).normalize();
    let ends = |index: usize| {
        let own = at(index);
        let back = match corners[index % count].cut {
            Cut::Sharp => return (own, own),
            Cut::Fillet(back) => back,
            Cut::Chamfer => chamfer / 2.0,
        };
        let (before, behind) = (
            along(index + count - 1, index + count),
            along(index, index + 1),
        );
        (own - before * back, own + behind * back)
    };
    let mut segments = Vec::new();
    for index in 0..count {
        let (from, to) = ends(index);
        let is_exact = matches!(corners[index].cut, Cut::Chamfer);
        match corners[index].cut {
            Cut::Sharp => {}
            Cut::Fillet(_) => {
                let turned = turn(
                    along(index + count - 1, index + count),
                    along(index, index + 1),
                );
                segments.push((Segment::from_bulge(from, to, (turned / 4.0).tan()), false));
            }
            Cut::Chamfer => segments.push((Segment::line(from, to), true)),
        }
        let (next, _) = ends(index + 1);
        let are_sharp = [index, index + 1]
            .iter()
            .all(|at| matches!(corners[at % count].cut, Cut::Sharp));
        let bulge = if are_sharp { corners[index].bulge } else { 0.0 };
        segments.push((Segment::from_bulge(to, next, bulge), is_exact));
    }
    segments
}

/// As LINE and ARC, each end moved by up to `apart` but where it is drawn exactly, in another order.
fn apart(segments: &[(Segment, bool)], moves: &[(f64, f64)], apart: f64, step: usize) -> Drawing {
    let count = segments.len();
    let moved = |number: usize| {
        let (angle, share) = moves[number % moves.len()];
        direction(angle) * (share * apart)
    };
    let geometries: Vec<Geometry> = (0..count)
        .map(|index| {
            let (segment, is_exact) = segments[index];
            let next_is_exact = segments[(index + 1) % count].1;
            let at = |is_exact: bool, number: usize| match is_exact {
                true => Vector::zeros(),
                false => moved(number),
            };
            let start = segment.start() + at(is_exact, 2 * index);
            let end = segment.end() + at(next_is_exact, 2 * index + 1);
            match segment {
                Segment::Line(_) if index % 3 == 1 => Geometry::Line {
                    start: end,
                    end: start,
                },
                Segment::Line(_) => Geometry::Line { start, end },
                Segment::Arc(arc) => {
                    let bulge = (arc.sweep / 4.0).tan();
                    let Segment::Arc(arc) = Segment::from_bulge(start, end, bulge) else {
                        unreachable!()
                    };
                    let arc = if arc.sweep > 0.0 { arc } else { arc.reversed() };
                    Geometry::Arc {
                        center: arc.center,
                        radius: arc.radius,
                        start_angle: arc.start_angle.rem_euclid(TAU),
                        end_angle: (arc.start_angle + arc.sweep).rem_euclid(TAU),
                    }
                }
            }
        })
        .collect();
    let coprime = (step..).find(|step| gcd(*step, count) == 1).unwrap();
    let order = (0..count).map(|index| geometries[index * coprime % count].clone());
    drawing_of(order, Some(Role::Punch))
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

fn findings(drawing: &Drawing, settings: &Arc<Effective>) -> Vec<Finding> {
    let mut analysis = Analysis::new(drawing, settings.clone());
    analysis.findings(drawing, usize::MAX).0
}

fn of(findings: &[Finding], rule: Rule) -> usize {
    findings.iter().filter(|it| it.rule == rule).count()
}

fn one_closed(drawing: &Drawing, settings: &Arc<Effective>) -> Result<f64, TestCaseError> {
    let analysis = Analysis::new(drawing, settings.clone());
    let outlines = analysis.outlines(drawing);
    prop_assert_eq!(outlines.len(), 1);
    prop_assert!(outlines[0].contour.closed);
    prop_assert_eq!(outlines[0].contour.pieces.len(), drawing.len());
    Ok(outlines[0].contour.twice_area(drawing).abs() / 2.0)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn ends_that_were_moved_apart_come_together_again(
        corners in corners(),
        moves in prop::collection::vec((0.0..TAU, 0.0_f64..1.0), 5..23),
        off in 0.006_f64..0.1,
        step in 1_usize..7,
    ) {
        let join = 2.0 * off + 1e-9;
        let settings = settings(Some(join));
        let segments = outline(&corners, 0.6 * join);
        let exact: Vec<Segment> = segments.iter().map(|(segment, _)| *segment).collect();
        let length: f64 = exact.iter().map(Segment::length).sum();
        let area = exact.iter().map(|it| it.twice_area(Point::origin())).sum::<f64>().abs() / 2.0;
        let mut drawing = apart(&segments, &moves, off, step);
        let within = |own: f64| (own - area).abs() <= length * join;
        prop_assert!(within(one_closed(&drawing, &settings)?));
        // What is cut is the outline, within what its ends were moved.
        let analysis = Analysis::new(&drawing, settings.clone());
        let paths = plan(&drawing, analysis.outlines(&drawing), &settings, None);
        let paths = paths.map_err(|refusal| TestCaseError::fail(format!("{refusal:?}")))?;
        for piece in paths[0].segments.iter().filter(|piece| matches!(piece.source, Source::Segment { .. } | Source::Corner { .. })) {
            let at = piece.geometry.point_at(0.5);
            let distance = exact.iter().map(|it| it.distance_to(at)).fold(f64::INFINITY, f64::min);
            prop_assert!((distance - CORRECTION).abs() <= 2.0 * join, "{} at {}", distance, at);
        }
        let before = findings(&drawing, &settings);
        prop_assert_eq!(of(&before, Rule::NarrowSlot) + of(&before, Rule::SelfIntersection), 0, "{:?}", before);
        for round in 0.. {
            prop_assert!(round < 12);
            let analysis = Analysis::new(&drawing, settings.clone());
            let Some(edit) = analysis.fix_all(&drawing) else { break };
            drawing.apply(&edit).unwrap();
        }
        let after = findings(&drawing, &settings);
        prop_assert_eq!(of(&after, Rule::Gap), 0, "{:?}", after);
        prop_assert!(within(one_closed(&drawing, &settings)?));
        // Without the wider tolerance, too.
        one_closed(&drawing, &self::settings(None))?;
    }
}

#[test]
fn what_would_be_joined_is_said() {
    let side = |from: [f64; 2], to: [f64; 2]| Geometry::Line {
        start: from.into(),
        end: to.into(),
    };
    // Inches of three decimals: each side ends 0.0254 mm beside the next.
    let square = || {
        [
            side([0.0254, 0.0], [10.0, 0.0]),
            side([10.0, 0.0254], [10.0, 10.0]),
            side([9.9746, 10.0], [0.0, 10.0]),
            side([0.0, 9.9746], [0.0, 0.0]),
        ]
    };
    let drawing = drawing_of(square(), Some(Role::Opening));
    let said = findings(&drawing, &settings(None));
    assert_eq!(of(&said, Rule::OpenContour), 4);
    for finding in said.iter().filter(|it| it.rule == Rule::OpenContour) {
        let sentence = wedm::finding::sentence(finding, 1.0);
        assert!(
            sentence.contains("0.025 mm from the next one: `join = 0.03`"),
            "{sentence}"
        );
    }
    // Two of them, in one finding.
    let mut both = drawing_of(square(), Some(Role::Opening));
    for geometry in square() {
        let Geometry::Line { start, end } = geometry else {
            unreachable!()
        };
        let away = Vector::new(20.0, 0.0);
        both.push(entity(
            side((start + away).into(), (end + away).into()),
            Some(Role::Opening),
        ));
    }
    let said = findings(&both, &settings(None));
    assert_eq!(of(&said, Rule::OpenContour), 1);
    assert!(wedm::finding::sentence(&said[0], 1.0).ends_with("`join = 0.03` would join them"));
    let said = findings(&both, &settings(Some(0.03)));
    assert_eq!((of(&said, Rule::OpenContour), of(&said, Rule::Gap)), (0, 8));
}

#[test]
fn a_dot_does_not_close_and_the_nearest_ends_are_joined() {
    let line = |from: [f64; 2], to: [f64; 2]| Geometry::Line {
        start: from.into(),
        end: to.into(),
    };
    let contours = |geometries: Vec<Geometry>| {
        let drawing = drawing_of(geometries, None);
        let analysis = Analysis::new(&drawing, settings(Some(0.05)));
        let outlines = analysis.outlines(&drawing).iter();
        let mut found: Vec<(usize, bool)> = outlines
            .map(|outline| (outline.contour.pieces.len(), outline.contour.closed))
            .collect();
        found.sort_unstable();
        found
    };
    // Three sides of a square of 0.02.
    let dot = vec![
        line([0.0, 0.0], [0.02, 0.0]),
        line([0.02, 0.0], [0.02, 0.02]),
        line([0.02, 0.02], [0.0, 0.02]),
    ];
    assert_eq!(contours(dot), [(3, false)]);
    // A short side between two gaps belongs to its contour.
    let short = vec![
        line([0.0, 0.0], [10.0, 0.0]),
        line([10.01, 0.015], [10.01, 0.035]),
        line([10.0, 0.05], [10.0, 8.0]),
        line([10.0, 8.0], [0.0, 0.0]),
    ];
    assert_eq!(contours(short), [(4, true)]);
    // Two squares whose corners are as near to each other as their own ends: each keeps its own.
    let square = |x: f64| {
        [
            line([x, 0.0], [x + 5.0, 0.0]),
            line([x + 5.0, 0.012], [x + 5.0, 5.0]),
            line([x + 5.0, 5.0], [x, 5.0]),
            line([x, 5.0], [x, 0.0]),
        ]
    };
    let two = square(0.0).into_iter().chain(square(5.03)).collect();
    assert_eq!(contours(two), [(4, true), (4, true)]);
}
