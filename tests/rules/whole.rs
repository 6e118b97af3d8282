//! What is said of a drawing as a whole, and what is left of it when all is repaired.

use super::corners::chords;
use super::{SQUARE, all_fixed, analysed, closed, count, drawings, entity};
use std::f64::consts::PI;
use std::sync::Arc;
use wedm::document::{Document, Source};
use wedm::drawing::{Change, Drawing, DrawingEdit, Geometry, Unit, Vertex};
use wedm::finding::{Detail, Finding, Rule, Severity};
use wedm::geometry::{Point, positive_angle};
use wedm::settings::{Effective, Settings};

/// Warnings that were measured in a unit that is in doubt are hints; errors stay, and what somebody has set.
#[test]
fn a_size_that_speaks_against_the_unit_leaves_errors() {
    for (scale, severity) in [(1.0, Severity::Warning), (1000.0, Severity::Hint)] {
        let corners = [
            (0.0, 0.0, 0.0),
            (10.0 * scale, 0.0, 0.0),
            (10.0 * scale, 0.003, 0.0),
            (10.0 * scale, 10.0 * scale, 0.0),
            (0.0, 10.0 * scale, 0.0),
        ];
        let mut drawing = closed(&corners).as_polyline(None);
        drawing.push(entity(
            Geometry::Circle {
                center: Point::new(10.0 * scale, 5.0 * scale),
                radius: 2.0 * scale,
            },
            None,
        ));
        let (_, findings) = analysed(&drawing);
        let told = |rule: Rule| {
            findings
                .iter()
                .find(|finding| finding.rule == rule)
                .map(|finding| finding.severity)
        };
        assert_eq!(told(Rule::ShortSegment), Some(severity));
        assert_eq!(told(Rule::SelfIntersection), Some(Severity::Error));
        let units = (scale > 1.0).then_some(Severity::Warning);
        assert_eq!(told(Rule::Units), units);
    }
}

#[test]
fn sizes_that_no_wire_cuts_speak_for_another_unit() {
    let scaled = |factor: f64| SQUARE.map(|(x, y, _)| (x * factor, y * factor, 0.0));
    for (sides, expected) in [
        (&[10.0][..], None),
        (&[0.04], Some(0.04)),
        (&[0.04, 10.0], None),
        (&[0.04, 0.03], Some(0.04)),
        (&[4999.0], None),
        (&[10.0, 5001.0, 7000.0], Some(7000.0)),
    ] {
        let mut drawing = Drawing::new(None);
        for &side in sides {
            drawing.push(entity(closed(&scaled(side / 10.0)).geometry(), None));
        }
        let (mut analysis, findings) = analysed(&drawing);
        let said = |findings: &[Finding]| {
            findings.iter().find_map(|finding| match finding.detail {
                Detail::Size { size } => Some(size),
                _ => None,
            })
        };
        assert_eq!(said(&findings), expected, "{sides:?}");
        // In inches all of it is larger.
        let mut inches = drawing.clone();
        inches.unit = Some(Unit::INCH);
        assert_eq!(
            said(&analysed(&inches).1).is_some(),
            sides.iter().any(|side| side * 25.4 > 5000.0),
            "{sides:?}"
        );
        // And once the odd ones are gone, nothing is reported.
        let last = *drawing.order().last().unwrap();
        let delta = drawing
            .apply(&DrawingEdit {
                changes: vec![Change::RemoveEntity { entity: last }],
            })
            .unwrap();
        analysis.update(&drawing, &delta);
        assert_eq!(
            analysis.findings(&drawing, 100).0,
            analysed(&drawing).1,
            "{sides:?}"
        );
    }
}

#[test]
fn fix_all_goes_on_until_nothing_safe_is_left() {
    let mut vertices = chords(150).vertices;
    vertices.insert(1, (0.0, 9.996, 0.0));
    vertices.insert(2, (0.0, 5.0, 0.0));
    vertices.insert(3, (0.0, 4.997, 0.0));
    for drawing in drawings(&closed(&vertices), None) {
        let mut doubled = drawing.clone();
        for (_, each) in drawing.entities() {
            doubled.push(each.clone());
        }
        let quiet = all_fixed(doubled);
        let findings = analysed(&quiet).1;
        for rule in [
            Rule::DuplicateEntity,
            Rule::ShortSegment,
            Rule::Gap,
            Rule::ArcAsChords,
            Rule::OpenContour,
        ] {
            assert_eq!(count(&findings, rule), 0, "{findings:#?}");
        }
        assert_eq!(
            quiet
                .entities()
                .map(|(_, entity)| entity.geometry.segment_count())
                .sum::<usize>(),
            5,
            "{quiet:#?}"
        );
    }
}

#[test]
fn what_the_reader_finds_keeps_its_severity_unless_somebody_sets_it() {
    let text = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n5\nA\n90\n7\n70\n1\n10\n0\n20\n0\n10\n5\n20\n0\n10\n5\n20\n5\n0\nENDSEC\n0\nEOF\n";
    for (toml, expected) in [
        ("", Some(Severity::Warning)),
        ("[rules]\nsyntax = \"error\"", Some(Severity::Error)),
        ("[rules]\nsyntax = \"off\"", None),
    ] {
        let settings: Settings = toml::from_str(toml).unwrap();
        let source = Source::Dxf(wedm::dxf::Document::read(text.into()));
        let (findings, _) = Document::new(source, Arc::new(Effective::of(&settings))).findings(100);
        let severity = findings
            .iter()
            .find(|finding| finding.rule == Rule::Syntax)
            .map(|finding| finding.severity);
        assert_eq!(severity, expected, "{toml}");
    }
}

/// The drawing on the page of a rule, turned by a quarter and mirrored.
fn mirrored(drawing: &Drawing) -> Drawing {
    let place = |at: Point| Point::new(at.y, at.x);
    let angle = |angle: f64| positive_angle(PI / 2.0 - angle);
    let mut other = Drawing::new(drawing.unit);
    for &id in drawing.order() {
        let mut entity = drawing.get(id).unwrap().clone();
        entity.geometry = match entity.geometry {
            Geometry::Polyline { closed, vertices } => Geometry::Polyline {
                closed,
                vertices: vertices
                    .iter()
                    .map(|vertex| Vertex::new(vertex.point.y, vertex.point.x, -vertex.bulge))
                    .collect(),
            },
            Geometry::Line { start, end } => Geometry::Line {
                start: place(start),
                end: place(end),
            },
            Geometry::Arc {
                center,
                radius,
                start_angle,
                end_angle,
            } => Geometry::Arc {
                center: place(center),
                radius,
                start_angle: angle(end_angle),
                end_angle: angle(start_angle),
            },
            Geometry::Circle { center, radius } => Geometry::Circle {
                center: place(center),
                radius,
            },
            Geometry::Text { at, text } => Geometry::Text {
                at: place(at),
                text,
            },
        };
        other.push(entity);
    }
    other
}

/// A new rule needs no row here: the drawing on its page is its fixture.
#[test]
fn what_a_rule_finds_on_its_page_it_finds_in_the_mirror() {
    let pictures = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pictures");
    let mut tried = 0;
    for rule in Rule::ALL {
        let Ok(bytes) = std::fs::read(pictures.join(format!("{}.dxf", rule.name()))) else {
            continue;
        };
        let document = wedm::dxf::Document::read(bytes);
        let drawing = document.drawing();
        let expected = count(&analysed(drawing).1, rule);
        let other = mirrored(drawing);
        let found = count(&analysed(&other).1, rule);
        assert_eq!(found, expected, "{}", rule.name());
        tried += usize::from(expected > 0);
    }
    assert!(tried >= 10, "{tried} rules find something on their pages");
}
