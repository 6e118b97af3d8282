//! The rules on segments and on contours: what they see in a drawing, however it is drawn, and that a fix lets it go.

use std::f64::consts::PI;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::document::{Document, Source};
use wedm::drawing::{Change, Drawing, DrawingEdit, Entity, Geometry, Kind, Role, Unit, Vertex};
use wedm::finding::{Detail, Finding, Rule, Severity};
use wedm::geometry::{Point, Segment, positive_angle};
use wedm::settings::{Effective, Settings};
use wedm::toolpath::plan;

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
        let mut drawing = Drawing::new(None);
        drawing.push(entity(self.geometry(), role));
        drawing
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
    let mut analysis = Analysis::new(drawing, settings());
    let (findings, count) = analysis.findings(drawing, usize::MAX);
    assert_eq!(findings.len(), count, "what is counted is told");
    (analysis, findings)
}

fn count(findings: &[Finding], rule: Rule) -> usize {
    findings
        .iter()
        .filter(|finding| finding.rule == rule)
        .count()
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

/// Asserts that the rule sees so many places however the shape is drawn, and, one at a time, that its fixes let them go where
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
    let kinked = closed(&[
        (0.0, 0.0, 0.0),
        (5.0, 0.1, 0.0),
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
        (&kinked, Some(Role::Opening), Rule::SharpCorner, 3),
        (&kinked, Some(Role::Punch), Rule::SharpCorner, 1),
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
    // One hint for all corners names none of them.
    assert_eq!(related(&kinked.as_chain(None), Rule::SharpCorner), [0]);
}

/// A spline that lies there twice goes as a whole, and a line may come in behind one; of what a block reference draws no part goes.
#[test]
fn doubles_of_curves_are_deleted_and_those_in_blocks_are_not() {
    let text = |blocks: &str, entities: &str| {
        let all = format!(
            "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 BLOCKS {blocks} 0 ENDSEC 0 SECTION 2 ENTITIES {entities} 0 ENDSEC 0 EOF"
        );
        all.split_whitespace()
            .map(|tag| format!("{tag}\n"))
            .collect::<String>()
    };
    let spline = |handle: &str| {
        format!(
            "0 SPLINE 5 {handle} 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 50 10 10 20 70 10 20 20 50 "
        )
    };
    let ellipse = |handle: &str| format!("0 ELLIPSE 5 {handle} 10 0 20 0 11 10 21 0 40 0.5 ");
    let line = "0 LINE 5 9 8 0 10 20 20 50 11 0 21 50 ";
    let block = "0 BLOCK 2 B 10 0 20 0 0 CIRCLE 8 0 10 0 20 0 40 3 0 ENDBLK ";
    let insert = |handle: &str| format!("0 INSERT 5 {handle} 2 B 10 0 20 0 ");
    for (blocks, entities, rule, expected) in [
        (
            "",
            format!("{}{line}{}", spline("1"), spline("2")),
            Rule::DuplicateEntity,
            Some(format!("{}{line}", spline("1"))),
        ),
        (
            "",
            ellipse("1") + &ellipse("2"),
            Rule::DuplicateEntity,
            Some(ellipse("1")),
        ),
        (
            "",
            spline("1"),
            Rule::OpenContour,
            Some(spline("1") + "0 LINE 5 2 10 20.0 20 50.0 11 0.0 21 50.0 "),
        ),
        (
            block,
            insert("1") + &insert("2"),
            Rule::DuplicateEntity,
            None,
        ),
    ] {
        let source = Source::Dxf(wedm::dxf::Document::read(
            text(blocks, &entities).into_bytes(),
        ));
        let mut document = Document::new(source, settings());
        let findings = document.findings(usize::MAX).0;
        let finding = findings
            .iter()
            .find(|finding| finding.rule == rule)
            .unwrap_or_else(|| panic!("{findings:#?}"));
        let fix = document.fixes(finding).into_iter().next();
        assert_eq!(fix.is_some(), expected.is_some(), "{entities}");
        if let (Some(fix), Some(expected), Source::Dxf(dxf)) = (fix, expected, document.source()) {
            let wedm::finding::Edit::Drawing(edit) = fix.edit else {
                panic!("an edit of the drawing")
            };
            let edited =
                wedm::text::edited(dxf.text().bytes(), &dxf.text_edits(&edit).unwrap()).unwrap();
            assert_eq!(String::from_utf8(edited).unwrap(), text(blocks, &expected));
        }
    }
}

/// The arc that rounds so flat a corner is shorter than what a control can follow: it would be a new finding, whose fix makes the
/// corner again.
#[test]
fn a_corner_too_flat_for_a_fillet_has_none() {
    let bend = |degrees: f64| {
        closed(&[
            (0.0, 0.0, 0.0),
            (5.0, 0.0, 0.0),
            (10.0, 5.0 * degrees.to_radians().tan(), 0.0),
            (5.0, 9.0, 0.0),
        ])
    };
    for (degrees, has_fix) in [(2.5, false), (3.5, true)] {
        let drawing = bend(degrees).as_polyline(Some(Role::Opening));
        let (analysis, findings) = analysed(&drawing);
        let is_flat = |finding: &&Finding| matches!(finding.detail, Detail::SharpCorner { turn, .. } if turn.abs() < 0.1);
        let flat = findings.iter().find(is_flat).expect("the flat corner");
        assert_eq!(
            !analysis.fixes(&drawing, flat).is_empty(),
            has_fix,
            "{degrees}"
        );
    }
}

/// A line that lies there twice: the fix of the arc beside it would move one of the two, and the contour would fall apart.
#[test]
fn an_arc_is_not_made_larger_beside_a_line_that_lies_there_twice() {
    let fillet = closed(&[
        (0.0, 0.0, 0.0),
        (9.95, 0.0, (PI / 8.0).tan()),
        (10.0, 0.05, 0.0),
        (10.0, 10.0, 0.0),
        (0.0, 10.0, 0.0),
    ]);
    let mut drawing = fillet.as_chain(Some(Role::Opening));
    let line = drawing
        .entities()
        .nth(2)
        .expect("the line behind the arc")
        .1
        .clone();
    drawing.push(line);
    let (analysis, findings) = analysed(&drawing);
    assert_eq!(
        (
            count(&findings, Rule::SmallRadius),
            count(&findings, Rule::DuplicateEntity)
        ),
        (1, 1),
        "{findings:#?}"
    );
    for fix in analysis.fixes(&drawing, &findings[0]) {
        let mut edited = drawing.clone();
        edited.apply(&fix.edit).unwrap();
        assert_eq!(
            count(&analysed(&edited).1, Rule::OpenContour),
            0,
            "{fix:#?}"
        );
    }
    let findings = analysed(&all_fixed(drawing)).1;
    assert_eq!(
        findings
            .iter()
            .filter(|finding| finding.rule != Rule::SharpCorner)
            .count(),
        0,
        "{findings:#?}"
    );
}

/// Two closed outlines in one place begin where they like, and have their vertices where they like.
#[test]
fn closed_outlines_that_lie_on_each_other_are_doubles() {
    let polyline = |vertices: &[(f64, f64, f64)]| closed(vertices).geometry();
    let l: Vec<(f64, f64, f64)> = vec![
        (0.0, 0.0, 0.0),
        (8.0, 0.0, 0.3),
        (8.0, 4.0, 0.0),
        (3.0, 4.0, 0.0),
        (3.0, 9.0, 0.0),
        (0.0, 9.0, 0.0),
    ];
    let with = |at: usize, vertex: (f64, f64, f64)| {
        let mut more = l.clone();
        more.insert(at, vertex);
        polyline(&more)
    };
    let circle = Geometry::Circle {
        center: Point::new(5.0, 5.0),
        radius: 3.0,
    };
    let moved = |by: f64| {
        polyline(
            &l.iter()
                .map(|&(x, y, bulge)| (x + by, y, bulge))
                .collect::<Vec<_>>(),
        )
    };
    for (name, one, other, expected) in [
        (
            "begun elsewhere",
            polyline(&l),
            closed(&l).begun_elsewhere().geometry(),
            true,
        ),
        (
            "the other way round",
            polyline(&l),
            closed(&l).reversed().geometry(),
            true,
        ),
        (
            "the other way round from elsewhere",
            polyline(&l),
            closed(&l).reversed().begun_elsewhere().geometry(),
            true,
        ),
        (
            "one vertex more",
            polyline(&l),
            with(3, (5.0, 4.0, 0.0)),
            true,
        ),
        (
            "a vertex more at the begin",
            with(0, (0.0, 2.0, 0.0)),
            polyline(&l),
            true,
        ),
        (
            "a vertex twice",
            polyline(&l),
            with(4, (3.0, 4.0, 0.0)),
            true,
        ),
        (
            "one corner more",
            polyline(&l),
            with(3, (5.0, 4.01, 0.0)),
            false,
        ),
        (
            "a circle and its two halves",
            circle.clone(),
            polyline(&[(2.0, 5.0, 1.0), (8.0, 5.0, 1.0)]),
            true,
        ),
        (
            "a circle and its two halves backwards",
            polyline(&[(5.0, 8.0, -1.0), (5.0, 2.0, -1.0)]),
            circle.clone(),
            true,
        ),
        (
            "a circle and half of another",
            circle,
            polyline(&[(2.0, 5.0, 1.0), (8.0, 5.0, 0.9)]),
            false,
        ),
        (
            "beside each other by less than a place",
            polyline(&l),
            moved(0.004),
            true,
        ),
        (
            "beside each other by more than a place",
            polyline(&l),
            moved(0.006),
            false,
        ),
    ] {
        for swapped in [false, true] {
            let mut drawing = Drawing::new(None);
            for geometry in if swapped {
                [&other, &one]
            } else {
                [&one, &other]
            } {
                drawing.push(entity(geometry.clone(), Some(Role::Opening)));
            }
            let (analysis, findings) = analysed(&drawing);
            let double = findings
                .iter()
                .find(|finding| finding.rule == Rule::DuplicateEntity);
            assert_eq!(
                double.is_some(),
                expected,
                "{name}, swapped {swapped}: {findings:#?}"
            );
            if let Some(double) = double {
                assert_eq!(
                    (
                        count(&findings, Rule::DuplicateEntity),
                        count(&findings, Rule::Overlap)
                    ),
                    (1, 0),
                    "{name}: {findings:#?}"
                );
                drawing
                    .apply(
                        &analysis
                            .fixes(&drawing, double)
                            .first()
                            .expect("a fix")
                            .edit,
                    )
                    .unwrap();
                assert_eq!(drawing.len(), 1, "{name}");
            }
        }
    }
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
        assert_eq!(near.len(), 2, "{findings:#?}");
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

/// A slot's end of a half turn, as so many chords.
fn chords(number: usize) -> Shape {
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

/// More chords than one finding holds, behind two lines and up to an open end: one fix makes arcs of all.
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

fn all_segments(drawing: &Drawing) -> usize {
    drawing
        .entities()
        .map(|(_, entity)| entity.geometry.segments().count())
        .sum()
}

/// Two sequences of chords that meet, each bent its own way: each is a finding, and a fix, of its own.
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
    for finding in findings.iter().filter(|its| its.rule == Rule::ArcAsChords) {
        let Detail::ArcAsChords { chords, radius, .. } = finding.detail else {
            panic!("{finding:?}")
        };
        assert_eq!(chords, 10);
        assert!((radius - 5.0).abs() < 1e-9, "{radius}");
    }
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
fn what_has_no_length_is_a_point_that_is_not_cut() {
    let dot = open(&[(20.0, 20.0, 0.0), (20.0, 20.0, 0.0)]);
    check(&dot, None, Rule::ShortSegment, 1, true);
    check(&dot, None, Rule::OpenContour, 0, true);
    let mut vertices = SQUARE.to_vec();
    vertices.insert(1, (10.0, 0.0, 0.0));
    check(&closed(&vertices), None, Rule::ShortSegment, 1, true);
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
            (2, 0),
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
    // Once it is closed the wire has a side on it, and four corners to leave round: that is no reason to leave it open.
    for drawing in drawings(&open(&SQUARE), Some(Role::Opening)) {
        let (analysis, findings) = analysed(&drawing);
        let finding = findings
            .iter()
            .find(|finding| finding.rule == Rule::OpenContour)
            .unwrap();
        let mut closed = drawing.clone();
        closed
            .apply(
                &analysis
                    .fixes(&drawing, finding)
                    .first()
                    .expect("a fix")
                    .edit,
            )
            .unwrap();
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
        let mut drawing = Drawing::new(None);
        for geometry in geometries {
            drawing.push(entity(geometry, None));
        }
        let (_, findings) = analysed(&drawing);
        let told = [Rule::OpenContour, Rule::SelfIntersection].map(|rule| count(&findings, rule));
        assert_eq!(told, [openings, crossings], "{findings:?}");
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
        let mut drawing = Drawing::new(None);
        for geometry in &square[..count] {
            drawing.push(entity(geometry.clone(), None));
        }
        let (_, findings) = analysed(&drawing);
        for rule in rules {
            let told: Vec<Severity> = findings
                .iter()
                .filter(|finding| finding.rule == rule)
                .map(|finding| finding.severity)
                .collect();
            assert_eq!(told, [severity], "{rule:?} of {count}: {findings:?}");
        }
    }
}

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
    let mut flat = corners.to_vec();
    flat.insert(1, (5.0, -0.2, 0.0));
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
            closed(&flat).as_polyline(Some(Role::Opening)),
            Rule::SharpCorner,
            0.001,
            0.00005,
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

/// Three entities in one place are one finding, whose fix leaves the first.
#[test]
fn what_lies_in_one_place_is_one_finding() {
    let circle = Geometry::Circle {
        center: Point::new(5.0, 5.0),
        radius: 3.0,
    };
    let mut drawing = Drawing::new(None);
    for _ in 0..3 {
        drawing.push(entity(circle.clone(), None));
    }
    let (analysis, findings) = analysed(&drawing);
    let doubles: Vec<&Finding> = findings
        .iter()
        .filter(|finding| finding.rule == Rule::DuplicateEntity)
        .collect();
    assert_eq!(doubles.len(), 1, "{findings:#?}");
    assert_eq!(doubles[0].related.len(), 2);
    let fixes = analysis.fixes(&drawing, doubles[0]);
    drawing.apply(&fixes[0].edit).unwrap();
    assert_eq!(drawing.len(), 1);
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
        let mut drawing = Drawing::new(None);
        geometries.into_iter().for_each(|geometry| {
            drawing.push(entity(geometry, None));
        });
        let (analysis, findings) = analysed(&drawing);
        assert_eq!(count(&findings, Rule::Gap), gaps, "{findings:#?}");
        for finding in findings.iter().filter(|finding| finding.rule == Rule::Gap) {
            assert_eq!(finding.related.len(), 1);
            let mut edited = drawing.clone();
            edited
                .apply(
                    &analysis
                        .fixes(&drawing, finding)
                        .first()
                        .expect("a fix")
                        .edit,
                )
                .unwrap();
            assert_eq!(count(&analysed(&edited).1, Rule::Gap), gaps - 1);
        }
        let quiet = all_fixed(drawing);
        assert_eq!(count(&analysed(&quiet).1, Rule::Gap), 0);
    }
}

#[test]
fn what_lies_wholly_on_another_entity_goes_with_fix_all() {
    let line = |x0: f64, x1: f64| Geometry::Line {
        start: Point::new(x0, 0.0),
        end: Point::new(x1, 0.0),
    };
    let arc = |from: f64, to: f64| Geometry::Arc {
        center: Point::new(0.0, 20.0),
        radius: 5.0,
        start_angle: from,
        end_angle: to,
    };
    for (geometries, overlaps, left) in [
        (vec![line(0.0, 10.0), line(2.0, 4.0), line(6.0, 8.0)], 2, 1),
        (vec![line(2.0, 4.0), line(10.0, 0.0)], 1, 1),
        (vec![arc(0.0, 3.0), arc(1.0, 2.0)], 1, 1),
        // Each reaches past the other: which of them ends where is not for a program to say.
        (vec![line(0.0, 6.0), line(4.0, 10.0)], 1, 2),
    ] {
        let mut drawing = Drawing::new(None);
        geometries.into_iter().for_each(|geometry| {
            drawing.push(entity(geometry, None));
        });
        assert_eq!(count(&analysed(&drawing).1, Rule::Overlap), overlaps);
        let fixed = all_fixed(drawing);
        assert_eq!(fixed.len(), left);
        assert_eq!(count(&analysed(&fixed).1, Rule::Overlap), left - 1);
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
        // And once the odd ones are gone, nothing is said.
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

/// The drawing after "fix all", again and again until it has nothing more to offer.
fn all_fixed(mut drawing: Drawing) -> Drawing {
    for _ in 0..12 {
        let Some(edit) = Analysis::new(&drawing, settings()).fix_all(&drawing) else {
            return drawing;
        };
        // An arc in the place of chords, whose kinks were none, may nearly be tangent at its ends.
        let left = |drawing: &Drawing| {
            let findings = analysed(drawing).1;
            findings.len() - count(&findings, Rule::NearTangent)
        };
        let before = left(&drawing);
        drawing.apply(&edit).unwrap();
        assert!(left(&drawing) < before);
    }
    panic!("there is no end to the fixes");
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

/// An outline that lies there twice is one finding, whichever of its entities come first, and one fix; so is each of two outlines.
#[test]
fn an_outline_that_lies_there_twice_is_one_finding() {
    for (copies, count_of_more) in [(2, 4), (3, 8)] {
        for drawing in drawings(&closed(&SQUARE), None) {
            let entities: Vec<Entity> = drawing.entities().map(|(_, each)| each.clone()).collect();
            let mut doubled = Drawing::new(None);
            // One after the other, or each beside its double.
            let (by_outline, by_line) = (
                std::iter::repeat_n(&entities, copies)
                    .flatten()
                    .collect::<Vec<_>>(),
                entities
                    .iter()
                    .flat_map(|each| std::iter::repeat_n(each, copies))
                    .collect::<Vec<_>>(),
            );
            for order in [by_outline, by_line] {
                let mut drawing = Drawing::new(None);
                for each in order {
                    drawing.push(each.clone());
                }
                let (analysis, findings) = analysed(&drawing);
                let told: Vec<&Finding> = findings
                    .iter()
                    .filter(|finding| finding.rule == Rule::DuplicateEntity)
                    .collect();
                let [finding] = told[..] else {
                    panic!("{findings:#?}")
                };
                let lines = entities.len();
                assert_eq!(finding.related.len(), count_of_more * lines / 4);
                assert!(
                    matches!(finding.detail, Detail::DuplicateEntity { count } if count == lines),
                    "{finding:?}"
                );
                assert_eq!(count(&findings, Rule::OpenContour), 0, "{findings:#?}");
                let fix = &analysis.fixes(&drawing, finding)[0];
                drawing.apply(&fix.edit).unwrap();
                assert_eq!(drawing.order().len(), lines);
                assert_eq!(
                    count(&analysed(&drawing).1, Rule::DuplicateEntity),
                    0,
                    "{fix:?}"
                );
                doubled = drawing;
            }
            assert_eq!(doubled.order().len(), entities.len());
        }
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

/// What has no length does no harm: a hint. What is only too short to cut is a warning.
#[test]
fn points_are_hints() {
    for (at, severity) in [(10.0, Severity::Hint), (9.997, Severity::Warning)] {
        let mut vertices = SQUARE.to_vec();
        vertices.insert(1, (at, 0.0, 0.0));
        let findings = analysed(&closed(&vertices).as_polyline(None)).1;
        let told: Vec<Severity> = findings
            .iter()
            .filter(|finding| finding.rule == Rule::ShortSegment)
            .map(|finding| finding.severity)
            .collect();
        assert_eq!(told, [severity]);
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
