//! Ellipses and splines as arcs: how close they come, and that the setting is kept.

use super::blocks::with_blocks;
use super::reading::{dxf, entities, findings};
use crate::dxf::Document;
use crate::dxf::shape::MOST_CURVE_ARCS;
use crate::finding::Rule;
use crate::geometry::{Point, Segment};

fn segments(document: &Document) -> Vec<Segment> {
    document
        .drawing()
        .entities()
        .flat_map(|(_, entity)| entity.geometry.segments().collect::<Vec<_>>())
        .collect()
}

/// How far a point is from what is drawn.
fn distance(segments: &[Segment], point: Point) -> f64 {
    segments
        .iter()
        .map(|segment| segment.distance_to(point))
        .fold(f64::INFINITY, f64::min)
}

/// A periodic spline has no clamped ends: its curve runs from knot 3 on, and is closed because its first
/// control points are its last ones. The weights of the cubic B-spline give the points it passes: 1 4 1 at a knot and 1
/// 23 23 1 between two.
#[test]
fn a_periodic_spline_closes_without_running_through_its_control_points() {
    let corners = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]];
    let knots: String = (0..11).map(|knot| format!("40 {knot} ")).collect();
    let points: String = (0..7)
        .map(|at| format!("10 {} 20 {} ", corners[at % 4][0], corners[at % 4][1]))
        .collect();
    let document = Document::read(
        dxf(&format!(
            "0 SPLINE 5 A 100 AcDbSpline 70 11 71 3 72 11 73 7 {knots}{points}"
        ))
        .into_bytes(),
    );
    assert_eq!(findings(&document), [""; 0]);
    let drawn = segments(&document);
    assert!(
        document
            .drawing()
            .entities()
            .all(|(_, entity)| entity.geometry.is_closed())
    );
    for [x, y] in [
        [5.0, 1.0],
        [5.0, 5.0],
        [1.0, 5.0],
        [1.0, 1.0],
        [5.75, 3.0],
        [3.0, 5.75],
        [0.25, 3.0],
        [3.0, 0.25],
    ] {
        assert!(distance(&drawn, Point::new(x, y)) <= 1e-3, "{x} {y}");
    }
    assert!(distance(&drawn, Point::new(0.0, 0.0)) > 1.0);
}

/// Programs write splines without knots; others draw them with even ones. A spline that cannot be drawn is an error: a
/// part of the outline is missing.
#[test]
fn a_spline_without_knots_is_drawn_and_one_with_too_few_is_an_error() {
    let points = "10 0 20 0 10 1 20 3 10 4 20 3 10 5 20 0";
    let document = Document::read(
        dxf(&format!("0 SPLINE 5 A 100 AcDbSpline 70 8 71 3 {points}")).into_bytes(),
    );
    assert_eq!(
        findings(&document),
        [
            r#"warning at "SPLINE": SPLINE has no knots (group code 40): evenly spaced ones are taken"#
        ]
    );
    let drawn = segments(&document);
    for [x, y] in [[0.0, 0.0], [2.5, 2.25], [5.0, 0.0]] {
        assert!(distance(&drawn, Point::new(x, y)) <= 1e-3, "{x} {y}");
    }
    let document =
        Document::read(dxf(&format!("0 SPLINE 5 A 70 8 71 3 40 0 40 1 {points}")).into_bytes());
    assert_eq!(
        findings(&document),
        [
            r#"error at "SPLINE": SPLINE has 2 knots, expected 8 for 4 control points of degree 3: it is not drawn"#
        ]
    );
}

/// Programs round 360° and 2π, up as well as down.
#[test]
fn a_sweep_a_hair_over_a_full_turn_is_a_full_turn() {
    let arc = |from: f64, to: f64| format!("0 ARC 5 A 10 1 20 2 40 3 50 {from} 51 {to}");
    let ellipse =
        |from: f64, to: f64| format!("0 ELLIPSE 5 A 10 1 20 2 11 3 21 0 40 1 41 {from} 42 {to}");
    let (turn, whole) = (std::f64::consts::TAU, 3.0 * std::f64::consts::TAU);
    for (text, length) in [
        (arc(0.0, 360.0), whole),
        (arc(0.0, 360.0001), whole),
        (arc(90.0, 450.002), whole),
        (arc(-180.0, 180.05), whole),
        (arc(10.0, 400.0), whole / 12.0),
        (arc(350.0, 370.0), whole / 18.0),
        (ellipse(0.0, turn + 1.5e-5), whole),
        (ellipse(1.0, 1.0 + 6.284), whole),
        (ellipse(0.0, turn / 4.0), whole / 4.0),
    ] {
        let document = Document::read(dxf(&text).into_bytes());
        assert_eq!(findings(&document), [""; 0], "{text}");
        let drawn: f64 = segments(&document).iter().map(Segment::length).sum();
        assert!((drawn - length).abs() < 2e-3, "{text}: {drawn}");
    }
}

/// A factor that all weights share cancels; a knot that occurs more often than the degree may part the curve.
#[test]
fn weights_and_knots_of_splines() {
    let spline = |weights: [f64; 4]| {
        let points = weights.map(|weight| format!("41 {weight}")).join(" ");
        let text = format!(
            "0 SPLINE 5 A 100 AcDbSpline 70 8 71 3 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 {points} \
             10 0 20 0 10 1 20 3 10 4 20 3 10 5 20 0"
        );
        Document::read(dxf(&text).into_bytes())
    };
    let plain = entities(&spline([1.0; 4]));
    for same in [[-1.0; 4], [7.0; 4], [-0.25; 4]] {
        assert_eq!(entities(&spline(same)), plain, "{same:?}");
    }
    let uneven = entities(&spline([1.0, 2.0, 3.0, 1.0]));
    assert_ne!(uneven, plain);
    assert_eq!(entities(&spline([-1.0, -2.0, -3.0, -1.0])), uneven);
    for bad in [[1.0, -1.0, 1.0, 1.0], [1.0, 0.0, 1.0, 1.0], [0.0; 4]] {
        assert_eq!(
            findings(&spline(bad)),
            [r#"error at "SPLINE": SPLINE has weights of both signs, or of 0: it is not drawn"#]
        );
    }
    let broken = |x: f64| {
        let text = format!(
            "0 SPLINE 5 A 100 AcDbSpline 70 8 71 1 40 0 40 0 40 1 40 1 40 2 40 2 10 0 20 0 10 6 20 0 10 {x} 20 0 10 12 20 0"
        );
        Document::read(dxf(&text).into_bytes())
    };
    assert_eq!(findings(&broken(6.0)), [""; 0]);
    assert_eq!(
        findings(&broken(6.5)),
        [
            r#"error at "SPLINE": SPLINE breaks in two at a knot that occurs 2 times: it is not drawn"#
        ]
    );
}

/// The end mark of old systems, and what they fill the file with behind it.
#[test]
fn an_end_mark_is_no_fault() {
    let text = dxf("0 LINE 5 A 10 0 20 0 11 1 21 0");
    for end in ["\x1a", "\x1a\n", "\x1a\x1a\x1a", "\x1a\0\0\0"] {
        for between in ["\n", "\r\n", ""] {
            let whole = format!("{}{between}{end}", text.trim_end());
            let document = Document::read(whole.clone().into_bytes());
            let is_part_of_eof = between.is_empty() && end.contains('\0');
            let expected = usize::from(is_part_of_eof);
            assert!(findings(&document).len() <= 2 * expected, "{whole:?}");
        }
    }
    let without = text.trim_end().trim_end_matches("0\nEOF");
    let document = Document::read(format!("{without}\x1a").into_bytes());
    assert_eq!(
        findings(&document),
        [r#"warning at "\u{1a}": the text ends without EOF: something may be missing"#]
    );
}

/// Drawings written by scripts hold such splines: wedm reads them as any other, other programs refuse them.
#[test]
fn a_spline_without_the_mark_of_its_class_is_drawn_with_a_hint() {
    let document = Document::read(
        dxf("0 SPLINE 5 A 70 8 71 1 40 0 40 0 40 1 40 1 10 0 20 0 10 3 20 4").into_bytes(),
    );
    assert_eq!(
        findings(&document),
        [
            r#"hint at "SPLINE": SPLINE has no mark of its class (group code 100, AcDbSpline): it is read here, other programs may refuse the drawing"#
        ]
    );
    assert_eq!(segments(&document).len(), 1);
}

#[test]
fn the_setting_says_how_near_arcs_come_to_the_curve() {
    let text = dxf(
        "0 LINE 5 A 10 0 20 0 11 1 21 0 0 ELLIPSE 5 B 10 0 20 0 11 20 21 0 40 0.5 41 0 42 6.283185307179586 \
         0 SPLINE 5 C 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 50 10 10 20 70 10 20 20 50",
    );
    let mut counts = Vec::new();
    for fit in [0.1, 1e-3, 1e-5] {
        let mut document = Document::read(text.clone().into_bytes());
        document.set_arc_fit(fit);
        let drawn = segments(&document);
        counts.push(drawn.len());
        for step in 0..200 {
            let (sine, cosine) = (f64::from(step) * std::f64::consts::TAU / 200.0).sin_cos();
            assert!(
                distance(&drawn, Point::new(20.0 * cosine, 10.0 * sine)) <= fit,
                "{fit}"
            );
            let t = f64::from(step) / 200.0;
            assert!(
                distance(&drawn, Point::new(20.0 * t, 50.0 + 40.0 * t * (1.0 - t))) <= fit,
                "{fit}"
            );
        }
        // An edit elsewhere keeps the setting, as a reading of the whole text does.
        let at = document.text().len() - "0\nENDSEC\n0\nEOF\n".len();
        let circle = "0\nCIRCLE\n5\nD\n10\n0\n20\n0\n40\n1\n";
        document.edit(at..at, circle);
        let mut fresh = Document::read([&text[..at], circle, &text[at..]].concat().into_bytes());
        fresh.set_arc_fit(fit);
        assert_eq!(entities(&document), entities(&fresh));
    }
    assert!(
        counts.is_sorted() && counts[0] < counts[1] && counts[1] < counts[2],
        "{counts:?}"
    );
}

/// A block reference stretches the curve before it is fitted: the setting applies in the drawing, not in the block.
#[test]
fn curves_out_of_blocks_are_fitted_where_they_come_to_lie() {
    let block = "0 BLOCK 2 B 10 0 20 0 0 CIRCLE 8 0 10 0 20 0 40 0.01 0 ENDBLK ";
    let mut document = Document::read(
        with_blocks(block, "0 INSERT 5 A 2 B 10 0 20 0 41 2000 42 1000").into_bytes(),
    );
    document.set_arc_fit(1e-3);
    let drawn = segments(&document);
    for step in 0..100 {
        let (sine, cosine) = (f64::from(step) * std::f64::consts::TAU / 100.0).sin_cos();
        assert!(distance(&drawn, Point::new(20.0 * cosine, 10.0 * sine)) <= 1e-3);
    }
}

/// A line of text asks for hundreds of arcs: all curves of a drawing share one limit, and a finding names what is left
/// out. Edits keep to it.
#[test]
fn all_curves_of_a_drawing_take_no_more_than_so_many_arcs() {
    let ellipse = |handle: usize, major: u32| {
        format!(
            "0 ELLIPSE 5 {handle:X} 10 0 20 {handle} 11 {major} 21 0 40 0.5 41 0 42 6.283185307179586 "
        )
    };
    let small = dxf(&ellipse(0xA0, 20_000));
    let arcs = segments(&Document::read(small.into_bytes())).len();
    let fitting = MOST_CURVE_ARCS as usize / (arcs - 50);
    let text: String = (0..fitting + 3)
        .map(|n| ellipse(0x1000 + n, 20_000))
        .collect();
    let mut document = Document::read(dxf(&text).into_bytes());
    let drawn = |document: &Document| document.drawing().entities().count();
    let left_out = |document: &Document| {
        let mut findings = document.findings().iter();
        let places: Vec<_> = findings
            .by_ref()
            .filter(|finding| finding.rule == Rule::NotJudged)
            .map(|finding| finding.place.clone())
            .collect();
        places
    };
    assert_eq!((drawn(&document), left_out(&document).len()), (fitting, 3));
    // Where an early curve takes fewer arcs, a late one comes, and back.
    let majors = ["20000", "33", "20000", "200"];
    for pair in majors.windows(2) {
        let at = document
            .text()
            .as_str_lossy()
            .find(&format!("\n{}\n", pair[0]))
            .unwrap()
            + 1;
        document.edit(at..at + pair[0].len(), pair[1]);
        let fresh = Document::read(document.text().bytes().to_vec());
        assert_eq!(left_out(&document), left_out(&fresh));
        assert_eq!(drawn(&document), drawn(&fresh));
    }
    assert_eq!(
        (drawn(&document), left_out(&document).len()),
        (fitting + 1, 2)
    );
}
