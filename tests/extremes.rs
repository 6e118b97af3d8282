//! What no person writes and a file may hold all the same: padding, numbers and heaps of absurd size. Nothing panics, and the
//! work stays bounded.

use crate::size::by_day;
use std::fmt::Write;
use std::sync::Arc;
use wedm::document::{Document, Source};
use wedm::finding::Edit;
use wedm::program::{self, Language};
use wedm::settings::{Budget, Effective, Settings, SideSetting};

/// More than `format!` takes as a width.
const WIDE: usize = 70_000;

fn dxf(text: &str) -> Document {
    dxf_under(text, Effective::default())
}

fn dxf_under(text: &str, settings: Effective) -> Document {
    let read = wedm::dxf::Document::read(text.as_bytes().to_vec());
    Document::new(Source::Dxf(read), Arc::new(settings))
}

fn three_b(text: &str) -> Document {
    let settings = Arc::new(Effective::default());
    Document::new(
        Source::Program(program::Document::read(
            Language::ThreeB,
            text.as_bytes().to_vec(),
            &settings,
        )),
        settings,
    )
}

fn iso(text: &str) -> Document {
    let settings = Arc::new(Effective::default());
    Document::new(
        Source::Program(program::Document::read(
            Language::Iso,
            text.as_bytes().to_vec(),
            &settings,
        )),
        settings,
    )
}

/// The rules of all findings; every fix of each is asked for, and that of all.
fn rules(mut document: Document) -> Vec<&'static str> {
    let (findings, _) = document.findings(usize::MAX);
    let length = document.text().map_or(0, |text| text.bytes().len());
    for finding in &findings {
        for fix in document.fixes(finding) {
            if let Edit::Text(edits) = &fix.edit {
                assert!(
                    edits
                        .iter()
                        .all(|edit| edit.range.end <= length && edit.text.len() < 1000),
                    "{:?}",
                    finding.rule
                );
            }
        }
    }
    document.fix_all();
    let mut rules: Vec<&str> = findings.iter().map(|finding| finding.rule.name()).collect();
    rules.dedup();
    rules
}

#[test]
fn numbers_with_more_digits_than_a_column_can_be_wide_are_repaired() {
    let zeros = "0".repeat(WIDE);
    let numbers = format!(
        "N1 B1000B0B1000GXL1\nN2 B0B1000B1000GYL2\nN{zeros}2 B1000B0B1000GXL3\nN4 B0B1000B1000GYL4\nDD\n"
    );
    assert!(rules(three_b(&numbers)).contains(&"block-number"));
    let places = format!(
        "N 1: B 1000 B 0 B 1000 GX L1 ; 1.000 , 0.000\nN 2: B 0 B 1000 B 1000 GY L2 ; 1.{zeros} , 1.{zeros}5\n\
         N 3: B 1000 B 0 B 1000 GX L3 ; 0.{zeros} , 1.500{zeros}\nN 4: B 0 B 1000 B 1000 GY L4 ; 0.000 , 0.000\nDD\n"
    );
    assert!(rules(three_b(&places)).contains(&"position-mismatch"));
}

#[test]
fn group_codes_behind_more_padding_than_a_column_can_be_wide_are_repaired() {
    let pad = " ".repeat(WIDE);
    let mut text = String::from("0\nSECTION\n2\nENTITIES\n");
    let corners = [(0, 0), (20, 0), (20, 20), (0, 20), (0, 0)];
    for (number, pair) in corners.windows(2).enumerate() {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let _ = write!(
            text,
            "{pad}0\nLINE\n{pad}5\nA{number}\n{pad}10\n{x0}\n{pad}20\n{y0}\n{pad}11\n{x1}\n{pad}21\n{y1}\n"
        );
    }
    let _ = write!(
        text,
        "{pad}0\nLWPOLYLINE\n{pad}5\nB\n{pad}90\n3\n{pad}70\n0\n"
    );
    for (x, y) in [(50, 0), (60, 0), (60, 10), (50, 0)] {
        let _ = write!(text, "{pad}10\n{x}\n{pad}20\n{y}\n");
    }
    text += "0\nENDSEC\n0\nEOF\n";
    let document = dxf(&text);
    let ids: Vec<_> = document
        .drawing()
        .unwrap()
        .entities()
        .map(|(id, _)| id)
        .collect();
    // A vertex gets a bulge, an entity a neighbour: tags are written in the style of those about them.
    let line = wedm::drawing::Geometry::Line {
        start: [0.0, 0.0].into(),
        end: [1.0, 1.0].into(),
    };
    let vertex = wedm::drawing::Vertex::new(60.0, 0.0, 0.5);
    let changes = vec![
        wedm::drawing::Change::SetVertex {
            entity: ids[4],
            index: 1,
            vertex,
        },
        wedm::drawing::Change::AddEntity {
            after: ids[0],
            geometry: line,
        },
    ];
    let Source::Dxf(source) = document.source() else {
        unreachable!("it was read as DXF")
    };
    let edits = source
        .text_edits(&wedm::drawing::DrawingEdit { changes })
        .unwrap();
    assert!(
        !edits.is_empty() && edits.iter().map(|edit| edit.text.len()).sum::<usize>() < 2 * WIDE
    );
    assert!(rules(document).contains(&"sharp-corner"));
}

/// Entities in a drawing in mm.
fn drawing(entities: impl Iterator<Item = String>) -> Document {
    drawing_under(entities, Effective::default())
}

fn drawing_under(entities: impl Iterator<Item = String>, settings: Effective) -> Document {
    let entities: String = entities.collect();
    let text = format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
    );
    dxf_under(&text, settings)
}

fn said(document: &mut Document) -> Vec<(&'static str, String)> {
    let (findings, _) = document.findings(usize::MAX);
    let mut said: Vec<(&str, String)> = findings
        .iter()
        .map(|finding| (finding.rule.name(), wedm::finding::sentence(finding, 1.0)))
        .collect();
    said.sort();
    said.dedup();
    said
}

#[test]
fn what_lies_side_by_side_by_the_thousand_is_compared_within_bounds_and_what_was_not_is_said() {
    let lines = |count: usize, end: &dyn Fn(usize) -> usize| {
        let line = |number: usize| {
            let end = end(number);
            format!("0\nLINE\n10\n{number}\n20\n0\n11\n{end}\n21\n7000\n")
        };
        // A twentieth of what a drawing is granted, so that a tenth of the lines is too many.
        let granted = Budget::default();
        let budget = Budget {
            looks: granted.looks / 20,
            ..granted
        };
        let settings = Effective {
            budget,
            ..Effective::default()
        };
        let mut document = drawing_under((0..count).map(line), settings);
        said(&mut document)
            .into_iter()
            .filter(|(rule, _)| *rule == "not-judged")
            .map(|(_, sentence)| sentence)
            .collect::<Vec<_>>()
    };
    assert_eq!(lines(500, &|number| number), [""; 0]);
    // Each is found among all beside it.
    assert_eq!(lines(2_400, &|number| number), [""; 0]);
    // The box of each holds a part of all others.
    assert_eq!(lines(2_400, &|number| number + 7000), [""; 0]);
    // Each crosses all others.
    let [sentence] = &lines(2_400, &|number| 2_400 - number)[..] else {
        panic!("one finding is expected")
    };
    assert!(sentence.contains("not compared"), "{sentence}");
}

#[test]
fn offsets_that_cross_themselves_everywhere_are_left_out_together_and_said() {
    let gear = |number: usize| {
        let vertex = |at: usize| {
            let (sin, cos) = (std::f64::consts::TAU * at as f64 / 300.0).sin_cos();
            let radius = if at.is_multiple_of(2) { 10.0 } else { 9.0 };
            let (x, y) = (30.0 * number as f64 + radius * cos, radius * sin);
            format!("10\n{x}\n20\n{y}\n")
        };
        let vertices: String = (0..300).map(vertex).collect();
        format!("0\nLWPOLYLINE\n90\n300\n70\n1\n{vertices}")
    };
    let left_out = |correction: f64| {
        let settings = Settings {
            side: Some(SideSetting::Opening),
            correction: Some(correction),
            ..Settings::default()
        };
        let granted = Budget::default();
        let budget = Budget {
            looks: granted.looks / 16,
            ..granted
        };
        let settings = Effective {
            budget,
            ..Effective::of(&settings)
        };
        let mut document = drawing_under((0..8).map(gear), settings);
        let said = said(&mut document).into_iter();
        let said = said.filter(|(rule, it)| *rule == "not-judged" && it.contains("offset"));
        said.map(|(_, sentence)| sentence).collect::<Vec<_>>()
    };
    assert_eq!(left_out(0.01), [""; 0]);
    let [sentence] = &left_out(8.5)[..] else {
        panic!("one finding is expected")
    };
    // The first ones are looked at.
    let count = sentence.rsplit(' ').next().map(str::parse::<usize>);
    assert!(matches!(count, Some(Ok(2..=7))), "{sentence}");
}

#[test]
fn outlines_within_each_other_are_all_compared() {
    let circle = |radius: f64| format!("0\nCIRCLE\n10\n0\n20\n0\n40\n{radius}\n");
    let square = |half: f64| {
        let corners = [(-half, -half), (half, -half), (half, half), (-half, half)];
        let corners = corners.map(|(x, y)| format!("10\n{x}\n20\n{y}\n"));
        format!("0\nLWPOLYLINE\n90\n4\n70\n1\n{}", corners.concat())
    };
    let granted = Budget::default();
    let budget = Budget {
        looks: granted.looks / 20,
        ..granted
    };
    let shapes: [&dyn Fn(f64) -> String; 2] = [&circle, &square];
    for shape in shapes {
        let settings = Effective {
            budget,
            ..Effective::default()
        };
        // One of them comes near another.
        let sizes = (1..3_000).map(f64::from).chain([1500.05]);
        let mut document = drawing_under(sizes.map(shape), settings);
        let said = said(&mut document);
        let of = |name: &str| said.iter().any(|(rule, _)| *rule == name);
        assert!(of("narrow-slot") && !of("not-judged"), "{said:?}");
    }
}

/// Few lines that ask for much: what each comes to, in counted steps, and that what was left out is said.
#[test]
fn what_a_few_lines_ask_for_is_bounded_in_steps() {
    let circle = "0\nCIRCLE\n10\n0\n20\n0\n40\n0.4\n";
    let block =
        |name: &str, holds: &str| format!("0\nBLOCK\n2\n{name}\n10\n0\n20\n0\n{holds}0\nENDBLK\n");
    let array = |name: &str, side: usize, step: f64| {
        format!(
            "0\nINSERT\n2\n{name}\n10\n0\n20\n0\n70\n{side}\n71\n{side}\n44\n{step}\n45\n{step}\n"
        )
    };
    let drawn = |blocks: &str, entities: &str| {
        dxf(&format!(
            "0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
        ))
    };
    let deep = block("A", circle)
        + &block("B", &array("A", 9, 1.0))
        + &block("C", &array("B", 9, 0.1))
        + &block("D", &array("C", 9, 0.0));
    let points: String = (0..60)
        .map(|at| format!("10\n{}\n20\n{}\n", at * 37 % 101, at * 53 % 97))
        .collect();
    let knots: String = (0..64usize)
        .map(|knot| format!("40\n{}\n", knot.clamp(3, 60) - 3))
        .collect();
    let curve = block(
        "S",
        &format!("0\nSPLINE\n100\nAcDbSpline\n70\n8\n71\n3\n72\n64\n73\n60\n{knots}{points}"),
    );
    for (name, mut document) in [
        (
            "one array",
            drawn(&block("A", circle), &array("A", 30_000, 1.0)),
        ),
        ("arrays in each other", drawn(&deep, &array("D", 9, 0.0))),
        (
            "an array behind another",
            drawn(
                &block("A", circle),
                &(array("A", 100, 1.0) + &array("A", 500, 1.0)),
            ),
        ),
        ("an array of curves", drawn(&curve, &array("S", 100, 0.01))),
    ] {
        let segments: usize = document
            .drawing()
            .unwrap()
            .entities()
            .map(|(_, entity)| entity.geometry.segment_count())
            .sum();
        assert!(segments <= 200_000, "{name}: {segments} segments");
        assert!(
            said(&mut document)
                .iter()
                .any(|(rule, _)| *rule == "not-judged"),
            "{name}"
        );
    }
    let calls = |body: &str, times: usize| {
        format!(
            "G91\n{}M02\nO1\n{body}M99\n",
            "M98 P1 L9999\n".repeat(times)
        )
    };
    let levels: String = (1..12)
        .map(|level| format!("O{level}\nG01X1.\nM98 P{} L9999\nM99\n", level + 1))
        .collect();
    for (name, text) in [
        ("many calls", calls("G01X1.\n", 10)),
        ("long subprogram", calls(&"G01X1.\nG01X-1.\n".repeat(50), 1)),
        (
            "calls in each other",
            format!("G91\nM98 P1 L9999\nM02\n{levels}O12\nG01Y1.\nM99\n"),
        ),
    ] {
        let mut document = iso(&text);
        let steps = document.program().unwrap().trace().steps.len();
        assert!(
            steps <= 100_000 + 2 * text.lines().count() + 2,
            "{name}: {steps} steps"
        );
        let said = said(&mut document);
        assert!(
            said.iter().any(|(rule, _)| *rule == "not-judged"),
            "{name}: {said:?}"
        );
        // What is cut short says nothing of the whole.
        assert!(
            said.iter().all(|(rule, _)| *rule != "missing-end"),
            "{name}: {said:?}"
        );
    }
}

#[test]
fn a_curve_that_takes_arcs_beyond_all_measure_is_named_and_not_drawn() {
    let spline = |count: usize, size: usize| {
        let knots = (0..count + 4).map(|knot| format!("40\n{}\n", knot.clamp(3, count) - 3));
        let points = (0..count).map(|point| {
            format!(
                "10\n{}\n20\n{}\n",
                point * 7919 % 101 * size,
                point * 104_729 % 97 * size
            )
        });
        let points: String = knots.chain(points).collect();
        format!(
            "0\nSPLINE\n100\nAcDbSpline\n70\n8\n71\n3\n72\n{}\n73\n{count}\n{points}",
            count + 4
        )
    };
    let mut near = drawing([spline(200, 1)].into_iter());
    assert!(
        said(&mut near).iter().all(|(rule, _)| *rule != "syntax")
            && near.drawing().unwrap().entities().count() == 1
    );
    // A hundred metres: a drawing that says metres and means millimetres.
    let mut wide = drawing([spline(200, 1000)].into_iter());
    let wide = (said(&mut wide), wide.drawing().unwrap().entities().count());
    let is_coarse =
        |(rule, sentence): &(&str, String)| *rule == "syntax" && sentence.contains("times arc-fit");
    assert!(
        wide.0.iter().any(is_coarse) && wide.1 == 1,
        "{:?}",
        wide.0.first()
    );
    let mut far = drawing([spline(200, 10_000_000)].into_iter());
    let far = (said(&mut far), far.drawing().unwrap().entities().count());
    assert!(
        matches!(&far.0[..], [("syntax", sentence)] if sentence.contains("arcs")) && far.1 == 0,
        "{far:?}"
    );
}

#[test]
fn lines_that_come_together_in_heaps_are_chained_each_once() {
    // Ends on both sides of a border between cells of the plane, so that each heap looks into the other.
    let near = |number: usize| {
        (
            0.0001 * (number % 13) as f64 - 0.0006,
            0.0001 * (number % 7) as f64 - 0.0003,
        )
    };
    let line = |number: usize| {
        let (angle, (x, y)) = (number as f64, near(number));
        format!(
            "0\nLINE\n10\n{}\n20\n{}\n11\n{x}\n21\n{y}\n",
            50.0 * angle.cos(),
            50.0 * angle.sin()
        )
    };
    let count = by_day(1200, 2400);
    let document = drawing((0..count).map(line));
    let snapshot = document.snapshot().unwrap();
    let mut pieces: Vec<u32> = snapshot
        .outlines
        .iter()
        .flat_map(|outline| &outline.contour.pieces)
        .map(|piece| piece.entity.0)
        .collect();
    pieces.sort_unstable();
    assert_eq!(pieces, (0..count as u32).collect::<Vec<u32>>());
    assert!(
        snapshot.outlines.len() <= count / 2 + 50,
        "{} contours",
        snapshot.outlines.len()
    );
}
