//! What is read of a text.

use crate::drawing::{Geometry, Vertex};
use crate::dxf::Document;
use crate::finding::{Detail, Place, Severity};

/// Tags, one after another with spaces between, as DXF text.
pub(super) fn dxf(entities: &str) -> String {
    let lines: Vec<&str> = entities.split_whitespace().collect();
    format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}\n0\nENDSEC\n0\nEOF\n",
        lines.join("\n")
    )
}

/// Handle and geometry of each entity, in short.
pub(in crate::dxf) fn entities(document: &Document) -> Vec<String> {
    let drawing = document.drawing();
    drawing
        .entities()
        .map(|(_, entity)| {
            let geometry = match &entity.geometry {
                Geometry::Line { start, end } => {
                    format!("{} {} to {} {}", start.x, start.y, end.x, end.y)
                }
                Geometry::Arc {
                    center,
                    radius,
                    start_angle,
                    end_angle,
                } => {
                    format!(
                        "{} {} R{radius} {:.0} {:.0}",
                        center.x,
                        center.y,
                        start_angle.to_degrees(),
                        end_angle.to_degrees()
                    )
                }
                Geometry::Circle { center, radius } => {
                    format!("{} {} R{radius}", center.x, center.y)
                }
                Geometry::Polyline { closed, vertices } => {
                    let vertices: Vec<_> = vertices
                        .iter()
                        .map(|Vertex { point, bulge }| format!("{} {} {bulge}", point.x, point.y))
                        .collect();
                    format!(
                        "{}{}",
                        vertices.join(", "),
                        if *closed { " closed" } else { "" }
                    )
                }
                Geometry::Text { at, text } => format!("{} {} {text}", at.x, at.y),
            };
            format!(
                "{} {} on {}: {geometry}",
                entity.kind, entity.handle, entity.layer
            )
        })
        .collect()
}

/// Findings in short: what stands at the place, and the sentence.
pub(super) fn findings(document: &Document) -> Vec<String> {
    let lossy = |range: &std::ops::Range<usize>| {
        String::from_utf8_lossy(&document.text().bytes()[range.clone()]).into_owned()
    };
    document
        .findings()
        .iter()
        .map(|finding| {
            let place = match &finding.place {
                Place::Text { range } => lossy(range),
                _ => "document".into(),
            };
            let sentence = match &finding.detail {
                Detail::Said(sentence) => sentence.clone(),
                Detail::UnsupportedEntity { kind, count, why } => format!("{count} {kind}: {why}"),
                Detail::Unseen { .. } | Detail::NotJudged(_) => {
                    crate::finding::sentence(finding, 1.0)
                }
                other => format!("{other:?}"),
            };
            let severity = match finding.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Information => "information",
                Severity::Hint => "hint",
            };
            format!("{severity} at {place:?}: {sentence}")
        })
        .collect()
}

fn check(text: &str, expected_entities: &[&str], expected_findings: &[&str]) {
    let document = Document::read(text.as_bytes().to_vec());
    assert_eq!(entities(&document), expected_entities, "in {text}");
    assert_eq!(findings(&document), expected_findings, "in {text}");
}

const LINE: &str = "0 LINE 5 A1 8 DIE 10 1 20 2 30 0 11 3 21 4 31 0";

#[test]
fn each_kind_of_entity() {
    for (tags, expected) in [
        (LINE, "LINE A1 on DIE: 1 2 to 3 4"),
        ("0 LINE 10 1 20 2 11 3 21 4", "LINE #1 on 0: 1 2 to 3 4"),
        (
            "0 ARC 5 B 10 1 20 2 40 3 50 30 51 90",
            "ARC B on 0: 1 2 R3 30 90",
        ),
        (
            "0 ARC 5 B 10 1 20 2 40 3 50 30 51 90 210 0 220 0 230 -1",
            "ARC B on 0: -1 2 R3 90 150",
        ),
        (
            "0 CIRCLE 5 B 10 1 20 2 40 3 230 -1",
            "CIRCLE B on 0: -1 2 R3",
        ),
        ("0 TEXT 5 B 10 1 20 2 40 3 1 O", "TEXT B on 0: 1 2 O"),
        (
            "0 TEXT 5 B 10 1 20 2 40 3 1 O 72 1 11 5 21 6 73 2",
            "TEXT B on 0: 5 6 O",
        ),
        (
            "0 TEXT 5 B 10 1 20 2 40 3 1 O 72 0 11 5 21 6 73 0",
            "TEXT B on 0: 1 2 O",
        ),
        (
            "0 TEXT 5 B 10 1 20 2 40 3 1 O 72 5 11 5 21 6",
            "TEXT B on 0: 1 2 O",
        ),
        (
            "0 MTEXT 5 B 10 1 20 2 40 3 1 O 72 1 11 0 21 1",
            "MTEXT B on 0: 1 2 O",
        ),
        (
            "0 MTEXT 5 B 8 m\\U+00E4rks 10 1 20 2 40 3 3 {\\fArial; 1 O} 230 -1",
            "MTEXT B on märks: 1 2 O",
        ),
        (
            "0 LWPOLYLINE 5 B 90 2 70 1 43 0 10 1 20 2 42 0.5 10 3 20 4",
            "LWPOLYLINE B on 0: 1 2 0.5, 3 4 0 closed",
        ),
        (
            "0 LWPOLYLINE 5 B 90 2 10 1 20 2 42 0.5 10 3 20 4 230 -1.0 1001 X 1010 7 1020 8",
            "LWPOLYLINE B on 0: -1 2 -0.5, -3 4 0",
        ),
        (
            "0 POLYLINE 5 B 66 1 10 0 20 0 30 0 70 1 0 VERTEX 5 C 10 1 20 2 42 1 0 VERTEX 10 3 20 4 0 SEQEND 5 D",
            "POLYLINE B on 0: 1 2 1, 3 4 0 closed",
        ),
        ("0 POINT 5 B 10 1 20 2", "POINT B on 0: 1 2 O"),
        (
            "0 SPLINE 5 B 100 AcDbSpline 70 8 71 1 40 0 40 0 40 1 40 1 10 0 20 0 10 3 20 4",
            "SPLINE B on 0: 0 0 0, 3 4 0",
        ),
        (
            "0 SPLINE 5 B 100 AcDbSpline 70 8 71 3 11 0 21 0 11 3 21 4",
            "SPLINE B on 0: 0 0 0, 3 4 0",
        ),
        (
            "0 POLYLINE 5 B 66 1 70 4 0 VERTEX 10 1 20 2 70 16 0 VERTEX 10 1 20 3 70 8 0 VERTEX 10 3 20 4 70 8 0 SEQEND",
            "POLYLINE B on 0: 1 3 0, 3 4 0",
        ),
        (
            "0 LINE 5 A 102 {X 10 9 102 } 10 1 20 2 11 3 21 4 101 Embedded 10 8",
            "LINE A on 0: 1 2 to 3 4",
        ),
    ] {
        check(&dxf(tags), &[expected], &[]);
    }
}

#[test]
fn an_arc_without_radius_that_ends_as_it_begins_is_a_point() {
    // As LibreCAD's library of symbols and QCAD's drawings have them.
    let warning = r#"warning at "0": ARC has the radius 0: it is a point, and is not cut"#;
    for (tags, place) in [
        ("0 ARC 5 A 10 1 20 2 40 0 50 90 51 90", "1 2"),
        ("0 ARC 5 A 10 1 20 2 40 0 50 0 51 360", "1 2"),
        ("0 ARC 5 A 10 1 20 2 40 0 50 0 51 0 230 -1", "-1 2"),
    ] {
        check(&dxf(tags), &[&format!("ARC A on 0: {place} ")], &[warning]);
    }
}

#[test]
fn angles_beyond_a_turn() {
    for (from, to, read) in [
        ("810", "-270", "90 -270"),
        ("3600000000000000000000090", "720", "80 0"),
    ] {
        let tags = format!("0 ARC 5 A 10 1 20 2 40 3 50 {from} 51 {to}");
        check(&dxf(&tags), &[&format!("ARC A on 0: 1 2 R3 {read}")], &[]);
    }
}

#[test]
fn one_fault_is_one_finding_and_harms_no_neighbour() {
    let line = "LINE A1 on DIE: 1 2 to 3 4";
    for (tags, finding) in [
        (
            "0 LINE 10 1 20 2 11 3",
            r#"error at "LINE": LINE lacks group code 21 (end y)"#,
        ),
        (
            "0 LINE 10 1",
            r#"error at "LINE": LINE lacks the group codes 20 (y), 11 (end x) and 21 (end y)"#,
        ),
        (
            "0 LINE 10 1,5 20 2 11 3 21 4",
            r#"error at "1,5": group code 10 (x) is "1,5", expected a number with a decimal point"#,
        ),
        (
            "0 LINE 10 nan 20 2 11 3 21 4",
            r#"error at "nan": group code 10 (x) is "nan", expected a number"#,
        ),
        (
            "0 ARC 10 1 20 2 40 0 50 90 51 180",
            r#"error at "0": group code 40 (radius) of ARC is "0", expected a number above 0"#,
        ),
        (
            "0 CIRCLE 10 1 20 2 40 0",
            r#"error at "0": group code 40 (radius) of CIRCLE is "0", expected a number above 0"#,
        ),
        (
            "0 CIRCLE 10 1 20 2 40 -1",
            r#"error at "-1": group code 40 (radius) of CIRCLE is "-1", expected a number above 0"#,
        ),
        (
            "0 ARC 10 1 20 2 40 -5 50 0 51 1",
            r#"error at "-5": group code 40 (radius) of ARC is "-5", expected a number above 0"#,
        ),
        (
            "0 LWPOLYLINE 90 2 70 1 10 1 10 2 20 3",
            r#"error at "1": vertex 1 lacks group code 20 (y)"#,
        ),
        (
            "0 LWPOLYLINE 90 1 70 1 10 1 20 3",
            r#"warning at "LWPOLYLINE": LWPOLYLINE has 1 vertices, expected at least 2"#,
        ),
        (
            "0 SPLINE 71 3 40 0 10 1 20 1",
            r#"error at "SPLINE": SPLINE has 1 control points, expected at least 4: it is not drawn"#,
        ),
        (
            "0 SPLINE 71 3 10 1 20 1 30 0 10 2 20 2 30 1",
            r#"information at "SPLINE": 1 SPLINE: its points differ in z"#,
        ),
        (
            "0 ELLIPSE 10 1 20 1 11 0 21 0 40 0.5",
            r#"error at "ELLIPSE": ELLIPSE has no width or no length: it is not drawn"#,
        ),
        (
            "0 ELLIPSE 10 1 20 1 11 1 21 0 31 1 40 0.5",
            r#"information at "ELLIPSE": 1 ELLIPSE: its plane is tilted against the drawing's plane"#,
        ),
        (
            "0 HATCH 10 x 20 3",
            r#"information at "HATCH": 1 HATCH: what it fills is cut along lines and arcs that are drawn round it; its own boundary is not read (draw it in CAD: HATCHEDIT, recreate boundary)"#,
        ),
        (
            "0 LINE 67 1 10 1 20 2 11 3 21 4",
            r#"information at "LINE": 1 LINE: it lies in paper space"#,
        ),
        (
            "0 CIRCLE 10 1 20 2 40 1 210 1 220 0 230 0",
            r#"information at "CIRCLE": 1 CIRCLE: its plane is tilted against the drawing's plane"#,
        ),
        (
            "0 LINE 8 A 10 1 20 2.5 3.5 11 3 21 4.5",
            r#"error at "3.5": found "3.5" where a group code is expected: a line is missing, or there is one too many"#,
        ),
    ] {
        check(&dxf(&format!("{tags} {LINE}")), &[line], &[finding]);
        check(&dxf(&format!("{LINE} {tags}")), &[line], &[finding]);
    }
}

#[test]
fn an_empty_line_between_records_takes_nothing_from_either() {
    let lines = |count: usize| {
        let line = |at: usize| format!("0\nLINE\n10\n{at}\n20\n0\n11\n{at}\n21\n5\n");
        let text = dxf("");
        let (head, tail) = text.split_once("\n\n").unwrap();
        let empty = "\n".repeat(count);
        format!(
            "{head}\n{empty}{}{empty}{tail}",
            (1..5).map(line).collect::<Vec<_>>().join(&empty)
        )
    };
    let four: Vec<String> = (1..5)
        .map(|at| format!("LINE #{at} on 0: {at} 0 to {at} 5"))
        .collect();
    for (text, count, said) in [
        (lines(0), 0, ""),
        (
            lines(1),
            5,
            "warning at \"\": found an empty line where a group code is expected: it is passed over",
        ),
        (
            lines(1).replace('\n', "\r\n"),
            5,
            "warning at \"\": found an empty line where a group code is expected: it is passed over",
        ),
        (
            lines(1).replace("\n\n", "\n  \n"),
            5,
            "warning at \"  \": found an empty line where a group code is expected: it is passed over",
        ),
        (
            lines(2),
            5,
            "warning at \"\": found 2 empty lines where a group code is expected: they are passed over",
        ),
        (
            lines(3),
            5,
            "warning at \"\": found 3 empty lines where a group code is expected: they are passed over",
        ),
    ] {
        let document = Document::read(text.clone().into_bytes());
        assert_eq!(entities(&document), four, "in {text}");
        assert_eq!(findings(&document), vec![said; count], "in {text}");
    }
    // Also within what has records of its own.
    let polyline = "0 POLYLINE 66 1 _ 0 VERTEX 10 1 20 2 _ 0 VERTEX 10 3 20 4 _ 0 SEQEND _ 0 CIRCLE 10 1 20 2 40 3";
    let text = dxf(polyline).replace("_\n", "\n");
    assert_eq!(
        entities(&Document::read(text.into_bytes())),
        ["POLYLINE #1 on 0: 1 2 0, 3 4 0", "CIRCLE #2 on 0: 1 2 R3"]
    );
}

#[test]
fn the_frame_of_a_text_is_no_contour() {
    let polyline = |handle: &str| {
        format!("0 LWPOLYLINE 5 {handle} 90 4 70 1 10 0 20 0 10 9 20 0 10 9 20 4 10 0 20 4")
    };
    let text = "0 MTEXT 5 B 10 1 20 2 40 3 1 O 1001 ACAD 1000 ACAD_MTEXT_TEXT_BORDERS_BEGIN 1070 80 1070 16 1070 5 1005 A8 1070 5 1005 0a9 \
                1000 ACAD_MTEXT_TEXT_BORDERS_END 1005 AA";
    let circle = "0 CIRCLE 5 C 10 1 20 2 40 3";
    let frame = |count: &str| {
        format!("information at \"LWPOLYLINE\": {count} LWPOLYLINE: it is the frame of a text")
    };
    let expected = ["MTEXT B on 0: 1 2 O", "CIRCLE C on 0: 1 2 R3"];
    check(
        &dxf(&format!(
            "{text} {circle} {} {}",
            polyline("A8"),
            polyline("A9")
        )),
        &expected,
        &[&frame("2")],
    );
    check(
        &dxf(&format!("{} {text} {circle}", polyline("A8"))),
        &expected,
        &[&frame("1")],
    );
    // Another polyline, and one that other data name, are contours.
    let contour = "LWPOLYLINE AA on 0: 0 0 0, 9 0 0, 9 4 0, 0 4 0 closed";
    check(
        &dxf(&format!("{text} {circle} {}", polyline("AA"))),
        &[expected[0], expected[1], contour],
        &[],
    );
    // After edits of the text and of the frame it is as if read from scratch.
    let whole = dxf(&format!(
        "{circle} {} {text} {}",
        polyline("A8"),
        polyline("AA")
    ));
    for (from, to) in [
        ("BORDERS_BEGIN", "BORDERS_ENDED"),
        ("5\nA8", "5\nA7"),
        ("1005\nA8", "1005\nAA"),
        ("0\nMTEXT", "0\nTEXT"),
        ("20\n4\n0", "20\n5\n0"),
    ] {
        let at = whole.find(from).unwrap();
        let mut document = Document::read(whole.clone().into_bytes());
        document.edit(at..at + from.len(), to);
        let fresh = Document::read(whole.replacen(from, to, 1).into_bytes());
        assert_eq!(
            (entities(&document), findings(&document)),
            (entities(&fresh), findings(&fresh)),
            "{to}"
        );
        document.edit(at..at + to.len(), from);
        let fresh = Document::read(whole.clone().into_bytes());
        assert_eq!(
            (entities(&document), findings(&document)),
            (entities(&fresh), findings(&fresh)),
            "{from} again"
        );
    }
}

#[test]
fn a_scale_of_nothing_is_said_to_be_one() {
    let text = |scale: &str| {
        let block =
            "0 SECTION 2 BLOCKS 0 BLOCK 2 B 10 0 20 0 0 CIRCLE 10 0 20 0 40 3 0 ENDBLK 0 ENDSEC";
        let all = format!(
            "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC {block} 0 SECTION 2 ENTITIES 0 INSERT 5 A 2 B 10 1 20 2 {scale} 0 ENDSEC 0 EOF"
        );
        all.split_whitespace()
            .map(|tag| format!("{tag}\n"))
            .collect::<String>()
    };
    let said = |code: usize, axis: char| {
        format!(
            "warning at \"0\": group code {code} ({axis} scale) of INSERT is 0, expected any other number: 1 is read"
        )
    };
    let circle = "CIRCLE A on 0: 1 2 R3";
    check(&text(""), &[circle], &[]);
    check(&text("41 1 42 1 43 1"), &[circle], &[]);
    check(
        &text("41 0 42 0"),
        &[circle],
        &[&said(41, 'x'), &said(42, 'y')],
    );
    check(&text("43 0"), &[circle], &[&said(43, 'z')]);
}
