//! Sharp corners, joints that are nearly tangent, arcs drawn as chords, and what is too short to cut.

use super::{SQUARE, Shape, analysed, check, closed, count, drawings, open, settings};
use std::f64::consts::PI;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Role};
use wedm::finding::{Detail, Finding, Rule, Severity};
use wedm::geometry::Point;
use wedm::toolpath::plan;

#[test]
fn corners_are_sharp_where_the_wire_runs_inside() {
    let l = closed(&[
        (0.0, 0.0, 0.0),
        (10.0, 0.0, 0.0),
        (10.0, 5.0, 0.0),
        (5.0, 5.0, 0.0),
        (5.0, 10.0, 0.0),
        (0.0, 10.0, 0.0),
    ]);
    check(
        &closed(&SQUARE),
        Some(Role::Opening),
        Rule::SharpCorner,
        4,
        true,
    );
    check(
        &closed(&SQUARE),
        Some(Role::Punch),
        Rule::SharpCorner,
        0,
        true,
    );
    check(&l, Some(Role::Opening), Rule::SharpCorner, 5, true);
    check(&l, Some(Role::Punch), Rule::SharpCorner, 1, true);
    // A hint that stands for all of them.
    check(&l, None, Rule::SharpCorner, 1, false);
    // A corner between a line and an arc; at its other end the arc meets a line from outside.
    let step = closed(&[
        (0.0, 0.0, 0.0),
        (10.0, 0.0, 0.0),
        (10.0, 5.0, 0.4),
        (7.0, 5.0, 0.0),
        (0.0, 5.0, 0.0),
    ]);
    check(&step, Some(Role::Opening), Rule::SharpCorner, 4, true);
    check(&step, Some(Role::Punch), Rule::SharpCorner, 1, true);
}

/// A corner between two entities names both.
#[test]
fn corners_and_kinks_name_the_other_entity() {
    let notched = closed(&[
        (0.0, 0.0, 0.0),
        (5.0, 4.0, 0.0),
        (10.0, 0.0, 0.0),
        (5.0, 10.0, 0.0),
    ]);
    let related = |drawing: &Drawing, rule: Rule| {
        let findings = analysed(drawing).1;
        findings
            .iter()
            .filter(|finding| finding.rule == rule)
            .map(|finding| finding.related.len())
            .collect::<Vec<_>>()
    };
    let flat = closed(&[
        (0.0, 0.0, 0.0),
        (5.0, 0.05, 0.0),
        (10.0, 0.0, 0.0),
        (5.0, 10.0, 0.0),
    ]);
    for (shape, role, rule, expected) in [
        (&notched, Some(Role::Punch), Rule::SharpCorner, 1),
        (&flat, None, Rule::NearTangent, 1),
    ] {
        assert_eq!(
            related(&shape.as_chain(role), rule),
            vec![1; expected],
            "{rule:?}"
        );
        assert_eq!(
            related(&shape.as_polyline(role), rule),
            vec![0; expected],
            "{rule:?}"
        );
    }
    // One that stands for several names the others, and a hint for all corners none of them.
    let opening = notched.as_chain(Some(Role::Opening));
    assert_eq!(related(&opening, Rule::SharpCorner), [2]);
    assert_eq!(related(&notched.as_chain(None), Rule::SharpCorner), [0]);
}

#[test]
fn joints_that_are_nearly_tangent() {
    // Fillets of a quarter turn whose bulge is a little off, and a line with a bend of half a degree.
    let bulge = (PI / 8.0 + 0.0005f64).tan();
    let fillet = closed(&[
        (0.0, 0.0, 0.0),
        (9.0, 0.0, bulge),
        (10.0, 1.0, 0.0),
        (10.0, 10.0, 0.0),
        (0.0, 10.0, 0.0),
    ]);
    for drawing in drawings(&fillet, None) {
        let (analysis, findings) = analysed(&drawing);
        let near: Vec<&Finding> = findings
            .iter()
            .filter(|finding| finding.rule == Rule::NearTangent)
            .collect();
        assert_eq!(count(&findings, Rule::NearTangent), 2, "{findings:#?}");
        let fixes = analysis.fixes(&drawing, near[0]);
        let mut edited = drawing.clone();
        edited.apply(&fixes.first().expect("a fix").edit).unwrap();
        assert_eq!(count(&analysed(&edited).1, Rule::NearTangent), 0);
    }
    let bend = closed(&[
        (0.0, 0.0, 0.0),
        (0.3, 0.002, 0.0),
        (10.0, 0.0, 0.0),
        (10.0, 10.0, 0.0),
        (0.0, 10.0, 0.0),
    ]);
    check(&bend, None, Rule::NearTangent, 1, true);
    check(&closed(&SQUARE), None, Rule::NearTangent, 0, true);
}

/// A slot's end of a half turn, as this many chords.
pub(crate) fn chords(number: usize) -> Shape {
    let corner = |at: usize| {
        let angle = PI * at as f64 / number as f64 - PI / 2.0;
        (10.0 + 5.0 * angle.cos(), 5.0 + 5.0 * angle.sin(), 0.0)
    };
    let mut vertices = vec![(0.0, 10.0, 0.0), (0.0, 0.0, 0.0)];
    vertices.extend((0..=number).map(corner));
    closed(&vertices)
}

#[test]
fn chords_of_an_arc() {
    check(&chords(12), None, Rule::ArcAsChords, 1, true);
    check(&chords(200), None, Rule::ArcAsChords, 1, true);
    check(&chords(4), None, Rule::ArcAsChords, 0, true);
    check(&closed(&SQUARE), None, Rule::ArcAsChords, 0, true);
    let round = |number: usize| {
        let corner = |at: usize| {
            let angle = 2.0 * PI * at as f64 / number as f64;
            (5.0 * angle.cos(), 5.0 * angle.sin(), 0.0)
        };
        closed(&(0..number).map(corner).collect::<Vec<_>>())
    };
    check(&round(6), None, Rule::ArcAsChords, 0, true);
    check(&round(36), None, Rule::ArcAsChords, 1, true);
    check(&round(301), None, Rule::ArcAsChords, 1, true);
}

/// More chords than one finding holds, after two lines and up to an open end: one fix makes arcs of all.
#[test]
fn chords_without_number_are_made_arcs_by_one_fix() {
    let corner = |at: usize| {
        let angle = 1.9 * PI * at as f64 / 4300.0;
        (20.0 * angle.cos(), 20.0 * angle.sin(), 0.0)
    };
    let mut vertices = vec![(30.0, 0.0, 0.0), (30.0, -10.0, 0.0)];
    vertices.extend((0..=4300).map(corner));
    let mut drawing = open(&vertices).as_polyline(None);
    let (analysis, findings) = analysed(&drawing);
    let finding = findings.iter().find(|its| its.rule == Rule::ArcAsChords);
    let fixes = analysis.fixes(&drawing, finding.unwrap());
    drawing.apply(&fixes[0].edit).unwrap();
    assert_eq!(count(&analysed(&drawing).1, Rule::ArcAsChords), 0);
    assert!(all_segments(&drawing) <= 5, "{}", all_segments(&drawing));
}

/// Chords so short that the rounding of their ends to 0.001 mm turns them more than the arc does.
#[test]
fn the_rounding_of_short_chords_hides_no_arc() {
    let arc = |[x, y, r]: [f64; 3], from: f64, sweep: f64, chords: usize| {
        let at = move |nth: usize| {
            let angle = from + sweep * nth as f64 / chords as f64;
            let rounded = |value: f64| (value * 1e3).round() / 1e3;
            (
                rounded(x + r * angle.cos()),
                rounded(y + r * angle.sin()),
                0.0,
            )
        };
        (0..=chords).map(at)
    };
    for (chords, radius) in [(60, 1.0), (360, 1.0), (1000, 5.0)] {
        let corners: Vec<_> = arc([3.0, 4.0, radius], 0.0, 2.0 * PI, chords)
            .skip(1)
            .collect();
        becomes(&corners, 1, 2);
    }
    for chords in [10, 60, 150] {
        let ends = [(10.0, -0.5 * PI), (-10.0, 0.5 * PI)];
        let slot = ends.map(|(x, from)| arc([x, 0.0, 3.0], from, PI, chords));
        becomes(&slot.into_iter().flatten().collect::<Vec<_>>(), 2, 4);
        let corners = [(10.0, 5.0), (-10.0, 5.0), (-10.0, -5.0), (10.0, -5.0)];
        let rounded = (0..4).flat_map(|nth| {
            let (x, y) = corners[nth];
            arc([x, y, 1.5], 0.5 * PI * nth as f64, 0.5 * PI, chords)
        });
        becomes(&rounded.collect::<Vec<_>>(), 4, 8);
    }
}

/// A closed outline of chords has one finding, of so many arcs, and "fix all" leaves so many segments.
fn becomes(corners: &[(f64, f64, f64)], arcs: usize, segments: usize) {
    let mut drawing = closed(corners).as_polyline(None);
    let of_chords = |drawing: &Drawing| {
        let (analysis, findings) = analysed(drawing);
        let finding = findings
            .into_iter()
            .find(|its| its.rule == Rule::ArcAsChords);
        finding.map(|finding| (analysis.fixes(drawing, &finding), finding))
    };
    let found = match of_chords(&drawing).map(|(_, finding)| finding.detail) {
        Some(Detail::ArcAsChords { .. }) => 1,
        Some(Detail::ArcsAsChords { arcs, .. }) => arcs,
        _ => 0,
    };
    assert_eq!(found, arcs, "{} chords", corners.len());
    while let Some((fixes, _)) = of_chords(&drawing) {
        drawing.apply(&fixes[0].edit).unwrap();
    }
    assert_eq!(all_segments(&drawing), segments, "{} chords", corners.len());
}

fn all_segments(drawing: &Drawing) -> usize {
    drawing
        .entities()
        .map(|(_, entity)| entity.geometry.segments().count())
        .sum()
}

/// Two sequences of chords that meet, each bent its own way: each has a fix of its own.
#[test]
fn chords_that_bend_the_other_way_are_another_arc() {
    let bend = |middle: f64, from: f64, sweep: f64| {
        (1..=10).map(move |at| {
            let angle = from + sweep * f64::from(at) / 10.0;
            (middle + 5.0 * angle.cos(), 5.0 * angle.sin(), 0.0)
        })
    };
    let mut wave = vec![(-5.0, -10.0, 0.0), (-5.0, 0.0, 0.0)];
    wave.extend(bend(0.0, PI, -PI));
    wave.extend(bend(10.0, PI, PI));
    wave.push((15.0, -10.0, 0.0));
    check(&closed(&wave), None, Rule::ArcAsChords, 2, true);
    let (_, findings) = analysed(&closed(&wave).as_polyline(None));
    let finding = findings.iter().find(|its| its.rule == Rule::ArcAsChords);
    let Some(Detail::ArcsAsChords { chords, radius, .. }) = finding.map(|its| &its.detail) else {
        panic!("{finding:?}")
    };
    assert_eq!(*chords, 20);
    assert!((radius - 5.0).abs() < 1e-9, "{radius}");
}

/// Corners between chords of one arc are none, wherever the contour begins; those beside them are.
#[test]
fn corners_beside_chords_are_sharp_and_those_between_them_are_not() {
    let corner = |at: usize| {
        let angle = PI * at as f64 / 12.0;
        (5.0 * angle.cos(), 5.0 * angle.sin(), 0.0)
    };
    let mut vertices: Vec<_> = (0..=12).map(corner).collect();
    for _ in 0..vertices.len() {
        vertices.rotate_left(1);
        check(
            &closed(&vertices),
            Some(Role::Opening),
            Rule::SharpCorner,
            2,
            false,
        );
        check(
            &closed(&vertices),
            Some(Role::Opening),
            Rule::NearTangent,
            0,
            false,
        );
        let (_, findings) = analysed(&closed(&vertices).as_polyline(Some(Role::Opening)));
        let is_error = |finding: &Finding| finding.severity == Severity::Error;
        assert!(!findings.iter().any(is_error), "{findings:#?}");
    }
}

#[test]
fn segments_too_short_to_cut() {
    let mut vertices = SQUARE.to_vec();
    vertices.insert(1, (9.997, 0.0, 0.0));
    check(&closed(&vertices), None, Rule::ShortSegment, 1, true);
    vertices.insert(3, (10.0, 9.998, 0.0));
    check(&closed(&vertices), None, Rule::ShortSegment, 2, true);
    // A crumb in a side has no direction that counts.
    let mut vertices = SQUARE.to_vec();
    vertices.splice(1..1, [(5.0, 0.0, 0.0), (5.000_2, 0.000_2, 0.0)]);
    let crumb = closed(&vertices);
    check(&crumb, Some(Role::Opening), Rule::SharpCorner, 4, false);
    check(&crumb, Some(Role::Opening), Rule::NearTangent, 0, false);
    check(
        &open(&[(0.0, 0.0, 0.0), (0.003, 0.0, 0.0), (10.0, 0.0, 0.0)]),
        None,
        Rule::ShortSegment,
        1,
        false,
    );
}

#[test]
fn what_has_no_length_is_nowhere() {
    let dot = open(&[(20.0, 20.0, 0.0), (20.0, 20.0, 0.0)]);
    check(&dot, None, Rule::ShortSegment, 0, true);
    check(&dot, None, Rule::OpenContour, 0, true);
    let mut vertices = SQUARE.to_vec();
    vertices.insert(1, (10.0, 0.0, 0.0));
    check(&closed(&vertices), None, Rule::ShortSegment, 0, true);
    // Two on each other are cut no times, and a contour beside them is cut as if they were not there.
    for mut drawing in drawings(&closed(&SQUARE), Some(Role::Punch)) {
        let alone = plan(
            &drawing,
            Analysis::new(&drawing, settings()).outlines(&drawing),
            &settings(),
            None,
        )
        .unwrap();
        for handle in ["dot", "dot too"] {
            let geometry = Geometry::Line {
                start: Point::new(20.0, 20.0),
                end: Point::new(20.0, 20.0),
            };
            drawing.push(Entity {
                handle: handle.into(),
                layer: "0".into(),
                role: None,
                kind: Kind::Line,
                geometry,
            });
        }
        let (analysis, findings) = analysed(&drawing);
        assert_eq!(
            (
                count(&findings, Rule::ShortSegment),
                count(&findings, Rule::DuplicateEntity)
            ),
            (0, 0),
            "{findings:#?}"
        );
        assert!(
            findings
                .iter()
                .all(|finding| finding.severity > Severity::Error),
            "{findings:#?}"
        );
        let paths = plan(&drawing, analysis.outlines(&drawing), &settings(), None).unwrap();
        assert_eq!(paths, alone);
    }
}

/// What has no length is nowhere. What is only too short to cut is a warning.
#[test]
fn a_repeated_vertex_is_nothing() {
    for (at, severity) in [(10.0, None), (9.997, Some(Severity::Warning))] {
        let mut vertices = SQUARE.to_vec();
        vertices.insert(1, (at, 0.0, 0.0));
        let findings = analysed(&closed(&vertices).as_polyline(None)).1;
        let told: Vec<Severity> = findings
            .iter()
            .filter(|finding| finding.rule == Rule::ShortSegment)
            .map(|finding| finding.severity)
            .collect();
        assert_eq!(told, Vec::from_iter(severity));
    }
}
