//! Ends that do not meet, and contours that are open.

use super::{
    SQUARE, Shape, all_fixed, analysed, check, closed, count, drawing_of, drawings, entity, open,
    repaired, saying_from, severities,
};
use std::f64::consts::PI;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Geometry, Role, Unit, Vertex};
use wedm::finding::{Rule, Severity};
use wedm::geometry::{Point, Segment};
use wedm::settings::{Effective, Settings};

#[test]
fn contours_that_are_open() {
    check(&open(&SQUARE), None, Rule::OpenContour, 1, true);
    check(
        &open(&[
            (0.0, 0.0, 0.0),
            (10.0, 0.0, 0.3),
            (10.0, 10.0, 0.0),
            (0.0, 0.5, 0.0),
        ]),
        None,
        Rule::OpenContour,
        1,
        true,
    );
    check(
        &open(&[(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)]),
        None,
        Rule::OpenContour,
        1,
        false,
    );
    check(&closed(&SQUARE), None, Rule::OpenContour, 0, true);
    // Two segments that return to their start: the halves of a circle, a half disc; out and back encloses nothing.
    for (back, bulge, is_open) in [(1.0, 1.0, 0), (0.0, 1.0, 0), (-1.0, 1.0, 1), (0.0, 0.0, 1)] {
        let there_and_back = open(&[(0.0, 0.0, bulge), (10.0, 0.0, back), (0.0, 0.0, 0.0)]);
        // As the polyline that it is.
        for drawing in drawings(&there_and_back, Some(Role::Opening))
            .iter()
            .take(1)
        {
            let found = analysed(drawing).1;
            let told = count(&found, Rule::OpenContour);
            assert_eq!(told.min(1), is_open, "{bulge} {back}: {found:?}");
        }
    }
    // Once it is closed the wire has a side on it, and four corners to leave round: that is no reason to leave it open.
    for drawing in drawings(&open(&SQUARE), Some(Role::Opening)) {
        let (analysis, findings) = analysed(&drawing);
        let finding = findings
            .iter()
            .find(|finding| finding.rule == Rule::OpenContour)
            .unwrap();
        let closed = repaired(&drawing, &analysis, finding);
        let findings = analysed(&closed).1;
        assert_eq!(
            (
                count(&findings, Rule::OpenContour),
                count(&findings, Rule::SharpCorner)
            ),
            (0, 4)
        );
    }
}

/// An open contour is an error of its own, and not cut: what it crosses of others is told when it is closed.
#[test]
fn a_crossing_of_open_contours_is_told_by_their_openings() {
    let open = |corners: [(f64, f64); 3]| Geometry::Polyline {
        closed: false,
        vertices: corners
            .iter()
            .map(|&(x, y)| Vertex::new(x, y, 0.0))
            .collect(),
    };
    let one = || open([(0.0, 0.0), (10.0, 0.0), (10.0, 8.0)]);
    let other = || open([(5.0, -3.0), (5.0, 3.0), (2.0, 9.0)]);
    let ring = Geometry::Circle {
        center: Point::new(10.0, 4.0),
        radius: 2.0,
    };
    for (geometries, openings, crossings) in
        [(vec![one(), other()], 2, 0), (vec![one(), ring], 1, 0)]
    {
        let drawing = drawing_of(geometries, None);
        let (_, findings) = analysed(&drawing);
        let told = [Rule::OpenContour, Rule::SelfIntersection].map(|rule| count(&findings, rule));
        assert_eq!(told, [openings, crossings], "{findings:?}");
    }
}

/// Ends nearer to each other than the correction, and to nothing else, are one corner: it is where the sides meet, or where one of them ends.
#[test]
fn ends_that_lie_near_each_other_are_brought_together() {
    let line = |[a, b, c, d]: [f64; 4]| Geometry::Line {
        start: Point::new(a, b),
        end: Point::new(c, d),
    };
    let rest = [[10.0, 6.0, 0.0, 6.0], [0.0, 6.0, 0.0, 0.0]];
    let outline = |first: [f64; 4], second: [f64; 4]| {
        let sides = [first, second, rest[0], rest[1]];
        sides.map(line).to_vec()
    };
    // Its two sides at the opening; what lies beside it; where the corner is made, if "fix all" makes it.
    type Side = [f64; 4];
    type Case = (Side, Side, Option<Side>, Option<(f64, f64)>);
    let cases: [Case; 7] = [
        // Both go on in their directions, or end earlier.
        (
            [0.0, 0.0, 9.98, 0.0],
            [10.0, 0.02, 10.0, 6.0],
            None,
            Some((10.0, 0.0)),
        ),
        (
            [0.0, 0.0, 10.02, 0.0],
            [10.0, -0.02, 10.0, 6.0],
            None,
            Some((10.0, 0.0)),
        ),
        (
            [0.0, 0.0, 10.0, 0.0],
            [10.02, 0.0, 10.0, 6.0],
            None,
            Some((10.02, 0.0)),
        ),
        // Sides that meet far away: one end moves onto the other.
        (
            [0.0, 0.0, 5.0, 0.0],
            [5.0, 0.02, 10.0, 6.0],
            None,
            Some((5.0, 0.0)),
        ),
        // A wire passes, another end is near, or is it far away.
        ([0.0, 0.0, 9.89, 0.0], [10.0, 0.0, 10.0, 6.0], None, None),
        (
            [0.0, 0.0, 9.98, 0.0],
            [10.0, 0.02, 10.0, 6.0],
            Some([10.1, 0.0, 15.0, 0.0]),
            None,
        ),
        (
            [0.0, 0.0, 9.98, 0.0],
            [10.0, 0.02, 10.0, 6.0],
            Some([10.3, 0.0, 15.0, 0.0]),
            Some((10.0, 0.0)),
        ),
    ];
    for (first, second, beside, corner) in cases {
        let mut geometries = outline(first, second);
        geometries.extend(beside.map(line));
        let drawing = drawing_of(geometries, Some(Role::Opening));
        let findings = analysed(&drawing).1;
        let openings = 1 + usize::from(beside.is_some());
        assert_eq!(
            count(&findings, Rule::OpenContour),
            openings,
            "{findings:?}"
        );
        assert_eq!(count(&findings, Rule::NarrowSlot), 0, "{findings:?}");
        let fixed = all_fixed(drawing);
        let left = analysed(&fixed).1;
        let closed = openings - usize::from(corner.is_some());
        assert_eq!(
            count(&left, Rule::OpenContour),
            closed,
            "{first:?} {second:?}: {left:?}"
        );
        let ends = fixed
            .entities()
            .filter_map(|(_, entity)| match entity.geometry {
                Geometry::Line { end, .. } => Some(end),
                _ => None,
            });
        let ends: Vec<Point> = ends.collect();
        let is_made = |(x, y): (f64, f64)| {
            ends.iter()
                .any(|end| (end - Point::new(x, y)).norm() < 1e-4)
        };
        assert!(
            corner.is_none_or(is_made),
            "{first:?} {second:?}: no corner at {corner:?}"
        );
    }
}

/// An open contour is one finding: what only spoils a cut along it is a hint until it is closed.
#[test]
fn what_only_spoils_a_cut_is_a_hint_while_the_contour_is_open() {
    let line = |from: (f64, f64), to: (f64, f64)| Geometry::Line {
        start: Point::new(from.0, from.1),
        end: Point::new(to.0, to.1),
    };
    let square = [
        line((0.0, 0.0), (9.997, 0.0)),
        line((10.0, 0.0), (10.0, 4.0)),
        line((10.0, 4.0), (10.0, 4.003)),
        line((10.0, 4.003), (10.0, 10.0)),
        line((2.0, 10.0), (6.0, 10.0)),
        line((10.0, 10.0), (0.0, 10.0)),
        line((0.0, 10.0), (0.0, 0.0)),
    ];
    let rules = [Rule::Gap, Rule::ShortSegment, Rule::Overlap];
    for (count, severity) in [(7, Severity::Warning), (6, Severity::Hint)] {
        let drawing = drawing_of(square[..count].to_vec(), None);
        let (_, findings) = analysed(&drawing);
        for rule in rules {
            let told = severities(&findings, rule);
            assert_eq!(told, [severity], "{rule:?} of {count}: {findings:?}");
        }
    }
}

/// What cannot be measured on the part is not said; an error is.
#[test]
fn what_is_below_the_resolution_is_not_said() {
    let said = |drawing: &Drawing, resolution: f64, rule: Rule| {
        let mut analysis = Analysis::new(drawing, saying_from(resolution));
        count(&analysis.findings(drawing, usize::MAX).0, rule)
    };
    let corners = [
        (0.0, 0.0, 0.0),
        (10.0, 0.0, 0.0),
        (10.0, 10.0, 0.0),
        (0.0, 10.0, 0.0),
    ];
    let mut gap = Drawing::new(None);
    for (at, (x, y, _)) in corners.into_iter().enumerate() {
        let (next_x, next_y, _) = corners[(at + 1) % 4];
        let short = if at == 0 { 0.0008 } else { 0.0 };
        let geometry = Geometry::Line {
            start: Point::new(x, y),
            end: Point::new(next_x - short, next_y),
        };
        gap.push(entity(geometry, None));
    }
    let mut stub = corners.to_vec();
    stub.insert(1, (9.9995, 0.0, 0.0));
    // R = c − 0.5 µm.
    let radius = 0.0995;
    let tight = [
        (0.0, 0.0, 0.0),
        (10.0 - radius, 0.0, (PI / 8.0).tan()),
        (10.0, radius, 0.0),
        (10.0, 10.0, 0.0),
        (0.0, 10.0, 0.0),
    ];
    for (drawing, rule, below, above) in [
        (gap, Rule::Gap, 0.001, 0.0005),
        (
            closed(&stub).as_polyline(None),
            Rule::ShortSegment,
            0.001,
            0.0004,
        ),
        (
            closed(&corners).as_polyline(Some(Role::Opening)),
            Rule::SharpCorner,
            0.05,
            0.001,
        ),
    ] {
        assert!(
            said(&drawing, above, rule) > said(&drawing, below, rule),
            "{rule:?}"
        );
    }
    let drawing = closed(&tight).as_polyline(Some(Role::Opening));
    assert_eq!(said(&drawing, 1.0, Rule::SmallRadius), 1);
}

/// Ends that miss each other by less than anybody can measure change nothing of what is said of the outline: at corners of both kinds, in
/// drawings of mm and of inches, wherever they lie.
#[test]
fn ends_that_are_off_by_less_than_the_resolution_are_no_fault() {
    let outline = closed(&[
        (0.0, 0.0, 0.0),
        (57.15, 0.0, 0.0),
        (57.15, 20.0, 0.0),
        (40.0, 32.0, 0.0),
        (40.0, 63.5, 0.0),
        (57.15, 63.5, 0.0),
        (57.15, 76.2, 0.414_213_562_373_095),
        (44.45, 88.9, 0.0),
        (0.0, 88.9, 0.0),
    ]);
    // Corners are sharp, whatever meets in them.
    let loud = |drawing: &Drawing| {
        let mut analysis = Analysis::new(drawing, saying_from(0.001));
        let found = analysis.findings(drawing, usize::MAX).0;
        found
            .into_iter()
            .filter(|found| found.severity <= Severity::Warning && found.rule != Rule::SharpCorner)
            .map(|found| (found.rule, format!("{:?}", found.detail)))
            .collect::<Vec<_>>()
    };
    let mut seed = 7_u64;
    let mut chance = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    for (unit, scale) in [(Unit::MILLIMETRE, 1.0), (Unit::INCH, 25.4)] {
        for off_mm in [0.0, 1e-14, 1e-9, 4e-7, 4e-5, 8e-4] {
            for role in [None, Some(Role::Opening), Some(Role::Punch)] {
                let mut drawing = Drawing::new(Some(unit));
                for segment in outline.geometry().segments() {
                    let [mut start, mut end] =
                        [segment.start(), segment.end()].map(|point| point / scale);
                    for point in [&mut start, &mut end] {
                        point.x += chance() * off_mm / scale;
                        point.y += chance() * off_mm / scale;
                    }
                    let bulge = match segment {
                        Segment::Line(_) => 0.0,
                        Segment::Arc(arc) => (arc.sweep / 4.0).tan(),
                    };
                    let vertices = vec![
                        Vertex::new(start.x, start.y, bulge),
                        Vertex::new(end.x, end.y, 0.0),
                    ];
                    let closed = false;
                    drawing.push(entity(Geometry::Polyline { closed, vertices }, role));
                }
                let said = loud(&drawing);
                assert!(said.is_empty(), "{unit:?} {off_mm} {role:?}: {said:?}");
            }
        }
    }
}

#[test]
fn ends_that_do_not_meet() {
    let (line, arc) = (
        |x0: f64, y0: f64, x1: f64, y1: f64| Geometry::Line {
            start: Point::new(x0, y0),
            end: Point::new(x1, y1),
        },
        Geometry::Arc {
            center: Point::new(10.0, 5.0),
            radius: 5.0,
            start_angle: -PI / 2.0,
            end_angle: PI / 2.0,
        },
    );
    let polyline = Geometry::Polyline {
        closed: false,
        vertices: vec![Vertex::new(10.0, 10.003, 0.0), Vertex::new(0.0, 10.0, 0.0)],
    };
    for (geometries, gaps) in [
        (
            vec![
                line(0.0, 0.0, 10.0, 0.0),
                line(10.004, 0.0, 10.0, 10.0),
                line(0.0, 0.003, 10.0, 10.0),
            ],
            2,
        ),
        (
            vec![
                line(0.0, 0.0, 9.995, 0.0),
                arc.clone(),
                line(10.0, 10.0, 0.0, 10.0),
                line(0.0, 10.004, 0.0, 0.0),
            ],
            2,
        ),
        (
            vec![
                line(0.0, 0.0, 10.0, 0.0),
                arc,
                polyline,
                line(0.0, 0.0, 0.0, 10.0),
            ],
            1,
        ),
        (
            vec![
                line(0.0, 0.0, 10.0, 0.0),
                line(10.0, 0.0, 10.0, 10.0),
                line(0.0, 0.0, 10.0, 10.0),
            ],
            0,
        ),
    ] {
        let drawing = drawing_of(geometries, None);
        let (analysis, findings) = analysed(&drawing);
        assert_eq!(count(&findings, Rule::Gap), gaps, "{findings:#?}");
        for finding in findings.iter().filter(|finding| finding.rule == Rule::Gap) {
            assert_eq!(finding.related.len(), 1);
            let edited = repaired(&drawing, &analysis, finding);
            assert_eq!(count(&analysed(&edited).1, Rule::Gap), gaps - 1);
        }
        let quiet = all_fixed(drawing);
        assert_eq!(count(&analysed(&quiet).1, Rule::Gap), 0);
    }
}

#[test]
fn an_open_contour_is_no_error_where_it_is_the_wires_path() {
    let drawing = open(&SQUARE).as_polyline(None);
    for (text, expected) in [
        ("", Severity::Error),
        ("[program]\ncompensation = \"none\"", Severity::Information),
        ("[rules]\nopen-contour = \"warning\"", Severity::Warning),
        (
            "[program]\ncompensation = \"none\"\n[rules]\nopen-contour = \"error\"",
            Severity::Error,
        ),
    ] {
        let settings: Settings = toml::from_str(text).unwrap();
        let (findings, _) =
            Analysis::new(&drawing, Arc::new(Effective::of(&settings))).findings(&drawing, 100);
        let severity = findings
            .iter()
            .find(|finding| finding.rule == Rule::OpenContour)
            .map(|finding| finding.severity);
        assert_eq!(severity, Some(expected), "{text}");
    }
}

/// What is open is one error: how near it comes to others, and what it touches, is asked again when it is closed.
#[test]
fn what_is_open_is_not_asked_how_near_it_comes() {
    let neighbour = closed(&[
        (10.1, 0.0, 0.0),
        (20.0, 0.0, 0.0),
        (20.0, 10.0, 0.0),
        (10.1, 10.0, 0.0),
    ]);
    let on_it = closed(&[(10.0, 4.0, 0.0), (20.0, 0.0, 0.0), (20.0, 10.0, 0.0)]);
    for (beside, rule) in [
        (&neighbour, Rule::NarrowSlot),
        (&on_it, Rule::SelfIntersection),
    ] {
        for is_closed in [true, false] {
            let outline = Shape {
                closed: is_closed,
                vertices: SQUARE.to_vec(),
            };
            let mut drawing = outline.as_polyline(None);
            drawing.push(entity(beside.geometry(), None));
            let findings = analysed(&drawing).1;
            let told = [rule, Rule::OpenContour].map(|rule| count(&findings, rule));
            assert_eq!(
                told,
                [usize::from(is_closed), usize::from(!is_closed)],
                "{findings:#?}"
            );
        }
    }
}

/// A gap that is shown as no more than the resolution is none.
#[test]
fn a_gap_that_rounds_to_the_resolution_is_none() {
    for (gap, expected) in [(0.001_02, 0), (0.001_4, 0), (0.001_6, 1), (0.002, 1)] {
        let mut drawing = closed(&SQUARE).as_chain(None);
        let first = *drawing.order().first().unwrap();
        let moved = Geometry::Line {
            start: Point::new(0.0, 0.0),
            end: Point::new(10.0 - gap, 0.0),
        };
        drawing.remove(first);
        drawing.push(entity(moved, None));
        let mut analysis = Analysis::new(&drawing, saying_from(0.001));
        let findings = analysis.findings(&drawing, usize::MAX).0;
        assert_eq!(count(&findings, Rule::Gap), expected, "{gap}");
    }
}
