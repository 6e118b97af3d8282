//! Every fix against an independent opening: the offset library goes inward by R and out again.

use super::support::{all_segments, drawing_of, faults, fix, settings};
use crate::star::{Corner, Star, star};
use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, DrawingEdit, Entity, Geometry, Role, Vertex};
use wedm::finding::{Detail, Finding, Severity, Side};
use wedm::geometry::{Point, Segment};

const CORRECTION: f64 = 0.2;

pub fn crosses_itself(vertices: &[Vertex]) -> bool {
    let outline = pline(vertices);
    let index = outline.create_approx_aabb_index();
    let found =
        cavalier_contours::polyline::internal::pline_intersects::all_self_intersects_as_basic(
            &outline, &index, false, 1e-7,
        );
    !found.is_empty()
}

fn pline(vertices: &[Vertex]) -> Polyline<f64> {
    let mut outline = Polyline::new_closed();
    vertices
        .iter()
        .for_each(|vertex| outline.add(vertex.point.x, vertex.point.y, vertex.bulge));
    outline
}

/// The opening of the region on one side of the outline by a disc of the radius, as segments.
fn opening(vertices: &[Vertex], side: Side, radius: f64) -> Vec<Segment> {
    let inward = radius * side.sign();
    let shrunk = pline(vertices).parallel_offset(inward);
    let opened = shrunk
        .iter()
        .flat_map(|outline| outline.parallel_offset(-inward));
    let segments = |outline: Polyline<f64>| {
        let vertices: Vec<Vertex> = outline
            .iter_vertexes()
            .map(|v| Vertex::new(v.x, v.y, v.bulge))
            .collect();
        Geometry::Polyline {
            closed: true,
            vertices,
        }
        .segments()
        .collect::<Vec<_>>()
    };
    opened.flat_map(segments).collect()
}

fn distance(segments: &[Segment], point: Point) -> f64 {
    segments
        .iter()
        .map(|segment| segment.distance_to(point))
        .fold(f64::INFINITY, f64::min)
}

/// The outline as a chain of LINE and ARC entities, every second one turned about where it may be.
fn as_chain(vertices: &[Vertex]) -> Drawing {
    let mut drawing = Drawing::new(None);
    let outline = Geometry::Polyline {
        closed: true,
        vertices: vertices.to_vec(),
    };
    for (i, segment) in outline.segments().enumerate() {
        let (kind, geometry) = match segment {
            Segment::Line(line) if i % 2 == 0 => (
                wedm::drawing::Kind::Line,
                Geometry::Line {
                    start: line.start,
                    end: line.end,
                },
            ),
            Segment::Line(line) => (
                wedm::drawing::Kind::Line,
                Geometry::Line {
                    start: line.end,
                    end: line.start,
                },
            ),
            Segment::Arc(arc) => {
                let (from, to) = if arc.sweep > 0.0 {
                    (arc.start_angle, arc.start_angle + arc.sweep)
                } else {
                    (arc.start_angle + arc.sweep, arc.start_angle)
                };
                (
                    wedm::drawing::Kind::Arc,
                    Geometry::Arc {
                        center: arc.center,
                        radius: arc.radius,
                        start_angle: from,
                        end_angle: to,
                    },
                )
            }
        };
        drawing.push(Entity {
            handle: format!("{i}").into(),
            layer: "0".into(),
            role: None,
            kind,
            geometry,
        });
    }
    drawing
}

/// Errors and warnings.
fn grave(findings: &[Finding]) -> usize {
    findings
        .iter()
        .filter(|finding| finding.severity <= Severity::Warning)
        .count()
}

/// Applies the preferred fix of the first finding that has one and holds the new outline against the opening.
fn check(
    vertices: &[Vertex],
    drawing: Drawing,
    side_setting: wedm::settings::SideSetting,
) -> Result<bool, TestCaseError> {
    let mut settings = (*settings(CORRECTION)).clone();
    settings.side = side_setting;
    let settings = std::sync::Arc::new(settings);
    let mut analysis = Analysis::new(&drawing, settings.clone());
    let (findings, _) = analysis.findings(&drawing, usize::MAX);
    let before = faults(&drawing, &settings).len();
    let old = all_segments(&drawing);
    let outline = Geometry::Polyline {
        closed: true,
        vertices: vertices.to_vec(),
    };
    let mut fixed_any = false;
    for finding in &findings {
        let Detail::SmallRadius(numbers) = &finding.detail else {
            continue;
        };
        let preferred = analysis
            .fixes(&drawing, finding)
            .into_iter()
            .find(|fix| fix.preferred);
        prop_assert_eq!(
            preferred.is_none(),
            numbers.no_fix.is_some(),
            "the finding says whether there is a fix"
        );
        let Some(fix) = preferred else { continue };
        fixed_any = true;
        let mut fixed = drawing.clone();
        prop_assert!(fixed.apply(&fix.edit).is_ok());
        let after = faults(&fixed, &settings).len();
        // Nor is it paid for with a fault of another rule, but for a kink of the opening that nearly is tangent, a hint.
        let others = Analysis::new(&fixed, settings.clone())
            .findings(&fixed, usize::MAX)
            .0;
        prop_assert!(
            grave(&others) < grave(&findings),
            "{findings:#?} before, {others:#?} after"
        );
        prop_assert!(after < before, "{before} faults before, {after} after");
        // The arc's own centre tells on which side of the outline the wire runs here.
        let along = outline.segments().find(|segment| {
            segment
                .as_arc()
                .is_some_and(|arc| (arc.center - numbers.center).norm() < 1e-6)
        });
        let Some(Segment::Arc(arc)) = along else {
            return Err(TestCaseError::fail("the fault is on the outline"));
        };
        let side = if arc.sweep > 0.0 {
            Side::Left
        } else {
            Side::Right
        };
        let opened = opening(vertices, side, CORRECTION);
        if opened.is_empty() {
            // An outline with room for the disc that the fix found has an opening: here the judge itself has lost it.
            continue;
        }
        for segment in all_segments(&fixed) {
            for k in 0..=16 {
                let point = segment.point_at(k as f64 / 16.0);
                let off = distance(&opened, point);
                let kept = distance(&old, point);
                prop_assert!(
                    off < 2e-5 || kept < 1e-9,
                    "point {point} lies {off} from the opening and {kept} from the old outline, {finding:?}"
                );
            }
        }
        // Nothing of the old outline that the opening keeps has gone.
        let new = all_segments(&fixed);
        for segment in &old {
            for k in 0..=16 {
                let point = segment.point_at(k as f64 / 16.0);
                let gone = distance(&new, point);
                prop_assert!(
                    gone < 2e-5 || distance(&opened, point) > 1e-9,
                    "{point} of the old outline is gone"
                );
            }
        }
    }
    // Fix-all leaves fewer faults, too, and stays between the old outline and the opening on either side.
    if let Some(edit) = analysis.fix_all(&drawing) {
        let mut fixed = drawing.clone();
        prop_assert!(fixed.apply(&edit).is_ok());
        let after = faults(&fixed, &settings).len();
        prop_assert!(after < before);
    }
    Ok(fixed_any)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, rng_seed: RngSeed::Fixed(20261121), ..ProptestConfig::default() })]

    #[test]
    fn a_fix_is_the_opening(star in star(), role in 0..3usize) {
        let vertices = star.vertices();
        prop_assume!(!crosses_itself(&vertices));
        let side = [wedm::settings::SideSetting::Opening, wedm::settings::SideSetting::Punch, wedm::settings::SideSetting::Both][role];
        let outline = Geometry::Polyline { closed: true, vertices: vertices.clone() };
        let mut drawing = drawing_of(outline, Role::Both);
        let id = drawing.order()[0];
        let entity = Entity { role: None, ..drawing.get(id).unwrap().clone() };
        drawing.replace(id, entity);
        check(&vertices, drawing, side)?;
        check(&vertices, as_chain(&vertices), side)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, rng_seed: RngSeed::Fixed(20261121), ..ProptestConfig::default() })]

    #[test]
    fn fillets_rounded_to_three_decimals_are_fixed(
        corners in proptest::collection::vec((0.6..1.4f64, 3.0..6.0f64, 0.03..0.09f64), 4..8),
        clockwise in any::<bool>(),
    ) {
        let corners = corners.into_iter().map(|(step, radius, length)| (step, radius, 0.0, Corner::Fillet { length })).collect();
        let rounded = |number: f64, places: i32| (number * 10f64.powi(places)).round() / 10f64.powi(places);
        let vertices: Vec<Vertex> = Star { corners, clockwise }
            .vertices()
            .into_iter()
            .map(|vertex| Vertex::new(rounded(vertex.point.x, 3), rounded(vertex.point.y, 3), rounded(vertex.bulge, 6)))
            .collect();
        let settings = settings(CORRECTION);
        let mut drawing = drawing_of(Geometry::Polyline { closed: true, vertices }, Role::Both);
        let before = faults(&drawing, &settings).len();
        fix(&mut drawing, &settings);
        prop_assert_eq!(faults(&drawing, &settings), vec![], "{} faults before", before);
    }
}

#[test]
fn an_empty_edit_changes_nothing() {
    let mut drawing = as_chain(&[Vertex::new(0.0, 0.0, 0.0), Vertex::new(1.0, 0.0, 0.5)]);
    let before = drawing.clone();
    drawing.apply(&DrawingEdit::default()).unwrap();
    assert_eq!(all_segments(&before), all_segments(&drawing));
}
