use super::numbers::number;
use super::pieces::{MANY, data_of_runs};
use super::sheet::path_data;
use super::*;
use crate::drawing::{Contour, Entity, EntityId, Geometry, Kind, Role, Unit, Vertex};
use crate::finding::{Detail, Place, Rule, Severity, Side, SmallRadius};
use crate::geometry::{Point, Segment};
use crate::toolpath::{PathSegment, Source};

/// Settings with the correction of the path that is shown.
fn settings() -> Effective {
    Effective::default()
}

fn drawn(
    drawing: &Drawing,
    outlines: &[Outline],
    findings: &[Finding],
    paths: &[WirePath],
    settings: &Effective,
) -> String {
    svg(&View {
        name: None,
        drawing,
        outlines,
        findings,
        paths,
        parts: &[],
        holes: &[],
        why: None,
        settings,
    })
}

fn entity(handle: &str, layer: &str, kind: Kind, geometry: Geometry) -> Entity {
    Entity {
        handle: handle.into(),
        layer: layer.into(),
        role: None,
        kind,
        geometry,
    }
}

fn tight(id: EntityId, segment: usize, geometry: Segment, required: f64) -> Finding {
    let arc = *geometry.as_arc().unwrap();
    let turn = arc.sweep.abs();
    let detail = SmallRadius {
        radius: arc.radius,
        required,
        center: arc.center,
        start: arc.start,
        end: arc.end,
        sweep: arc.sweep,
        side: Side::Left,
        overcut: (required - arc.radius) * (1.0 - turn.cos()),
        stock_left: (required - arc.radius) * (1.0 / (turn / 2.0).cos() - 1.0),
        pass: None,
        taken_by_skims: false,
        no_fix: None,
    };
    let place = Place::Segment {
        entity: id,
        segment,
    };
    Finding {
        rule: Rule::SmallRadius,
        severity: Severity::Error,
        place,
        detail: Detail::SmallRadius(Box::new(detail)),
        related: Vec::new(),
    }
}

/// An opening with one fillet of R 0.08 in a plate that is not cut, a text, and a path beside it.
fn plate() -> (Drawing, Vec<Outline>, Vec<Finding>, Vec<WirePath>) {
    let quarter = (std::f64::consts::PI / 8.0).tan();
    let mut drawing = Drawing::new(None);
    let rectangle =
        [(0.0, 0.0), (40.0, 0.0), (40.0, 30.0), (0.0, 30.0)].map(|(x, y)| Vertex::new(x, y, 0.0));
    drawing.push(entity(
        "10",
        "PLATE",
        Kind::LightPolyline,
        Geometry::Polyline {
            closed: true,
            vertices: rectangle.to_vec(),
        },
    ));
    let opening = [
        (10.0, 8.0, 0.0),
        (29.92, 8.0, quarter),
        (30.0, 8.08, 0.0),
        (30.0, 22.0, 0.0),
        (10.0, 22.0, 0.0),
    ];
    let opening = opening.map(|(x, y, bulge)| Vertex::new(x, y, bulge));
    let id = drawing.push(entity(
        "2A",
        "DIE",
        Kind::LightPolyline,
        Geometry::Polyline {
            closed: true,
            vertices: opening.to_vec(),
        },
    ));
    drawing.push(entity(
        "2B",
        "DIE",
        Kind::Text,
        Geometry::Text {
            at: Point::new(20.0, 15.0),
            text: "O".into(),
        },
    ));
    drawing.push(entity(
        "2C",
        "NOTE",
        Kind::Text,
        Geometry::Text {
            at: Point::new(2.0, 26.0),
            text: "<plate & die>".into(),
        },
    ));
    let contour = Contour::new(&drawing, [(id, false)], true);
    let twice_area = contour.twice_area(&drawing);
    let fault = contour.segment(&drawing, 1).unwrap();
    let findings = vec![tight(id, 1, fault.geometry, 0.1)];
    let at = |x, y| Point::new(x, y);
    let around = [
        at(20.0, 15.0),
        at(20.0, 8.1),
        at(29.9, 8.1),
        at(29.9, 21.9),
        at(10.1, 21.9),
        at(10.1, 8.1),
        at(20.0, 8.1),
    ];
    let mut segments: Vec<PathSegment> = around
        .windows(2)
        .map(|ends| PathSegment {
            geometry: Segment::line(ends[0], ends[1]),
            source: Source::Segment {
                entity: id,
                segment: 0,
            },
        })
        .collect();
    segments[0].source = Source::LeadIn;
    let path = WirePath {
        correction: 0.1,
        ..WirePath::along(at(20.0, 15.0), segments)
    };
    (
        drawing,
        vec![Outline {
            contour,
            role: Role::Opening,
            twice_area,
        }],
        findings,
        vec![path],
    )
}

#[test]
fn a_plate_shows_contour_fault_correction_and_path() {
    let (drawing, outlines, findings, paths) = plate();
    let picture = drawn(&drawing, &outlines, &findings, &paths, &settings());
    let expected = [
        "<title>contours and wire path</title>",
        "<text class=\"alert error\" x=\"40\" y=\"74\"><title>1 arc is tighter than the correction</title>",
        "class=\"fault error\" data-handle=\"2A\"",
        "20.000 × 14.000 mm",
        "LWPOLYLINE 2A · segment 1 · arc R 0.080 mm, 90.0°",
        "2A · segment 1 · R 0.080 mm, the correction is 0.100 mm",
        "R 0.080 &lt; 0.100 mm",
        "overcut 0.020",
        "thread hole at 20.000, 15.000 mm",
        "LWPOLYLINE 10 on layer PLATE, not cut",
        "&lt;plate &amp; die&gt;",
        "5 mm</text>",
    ];
    for text in expected {
        assert!(picture.contains(text), "{text} is missing");
    }
    assert_eq!(
        picture,
        drawn(&drawing, &outlines, &findings, &paths, &settings())
    );
}

#[test]
fn figures_for_people_are_mm_whatever_the_unit() {
    let (drawing, outlines, findings, paths) = plate();
    let inches = Effective {
        unit: Unit::INCH,
        ..settings()
    };
    let picture = drawn(&drawing, &outlines, &findings, &paths, &inches);
    assert!(picture.contains("R 2.032 &lt; 2.540 mm"));
}

#[test]
fn a_full_circle_is_drawn_in_pieces_below_a_half_turn() {
    let frame = Frame {
        origin: Point::origin(),
        scale: 1.0,
        left: 0.0,
        bottom: 0.0,
    };
    let circle = Geometry::Circle {
        center: Point::new(5.0, 5.0),
        radius: 2.0,
    };
    let data = path_data(&frame, circle.segments(), true);
    assert_eq!(
        data,
        "M7 5A2 2 0 0 1 4 6.732A2 2 0 0 1 4 3.268A2 2 0 0 1 7 5Z"
    );
}

#[test]
fn numbers_are_short() {
    for (value, text) in [
        (0.0, "0"),
        (-0.0001, "0"),
        (1.5, "1.5"),
        (100.0, "100"),
        (-2.0625, "-2.062"),
        (1e-9, "0"),
    ] {
        assert_eq!(number(value), text, "{value}");
    }
}

#[test]
fn nothing_and_a_single_point_are_pictures_too() {
    assert!(
        drawn(&Drawing::default(), &[], &[], &[], &settings())
            .contains("no lines, arcs or circles")
    );
    let mut drawing = Drawing::default();
    drawing.push(entity(
        "1",
        "0",
        Kind::Text,
        Geometry::Text {
            at: Point::new(3.0, 4.0),
            text: "O\u{1}".into(),
        },
    ));
    let picture = drawn(&drawing, &[], &[], &[], &settings());
    assert!(picture.contains(">O</text>") && !picture.contains("NaN") && !picture.contains("inf"));
}

#[test]
fn coordinates_beyond_all_measure_are_no_picture() {
    for (far, texts) in [
        (1e308, ["no lines, arcs", ""]),
        (1e150, ["class=\"aside\"", "e149 mm"]),
    ] {
        let mut drawing = Drawing::default();
        drawing.push(entity(
            "1",
            "0",
            Kind::Line,
            Geometry::Line {
                start: Point::new(-far, -far),
                end: Point::new(far, far),
            },
        ));
        let picture = drawn(&drawing, &[], &[], &[], &settings());
        assert!(
            texts.iter().all(|text| picture.contains(text)) && picture.len() < 9000,
            "{far}: {picture}"
        );
    }
}

#[test]
fn what_the_wire_cuts_and_leaves_is_shown_to_scale() {
    let (drawing, outlines, mut findings, paths) = plate();
    let shown = |paths: &[WirePath], findings: &[Finding], settings: &Effective| {
        drawn(&drawing, &outlines, findings, paths, settings)
    };
    // 40 mm of plate are 740 units wide.
    let wide = |mm: f64| format!(r#"class="kerf" stroke-width="{}""#, number(mm * 18.5));
    let plain = shown(&paths, &findings, &settings());
    assert!(plain.contains(&wide(0.2)), "{plain}");
    let known = Effective {
        wire_diameter: Some(0.18),
        gap: Some(0.02),
        start_hole: Some(2.0),
        ..settings()
    };
    let known = shown(&paths, &findings, &known);
    assert!(known.contains(&wide(0.22)), "{known}");
    let hole = format!(r#"r="{}""#, number(18.5));
    assert!(
        known
            .lines()
            .any(|line| line.contains(r#"class="hole""#) && line.contains(&hole))
    );
    // The enclosed core lies upon what the wire leaves.
    let at = |text: &str, from: usize| from + known[from..].find(text).expect(text);
    let lost = at(r#"class="lost""#, 0);
    assert!(at(r#"class="kerf""#, at(r#"class="void""#, lost)) > lost);
    assert!(!known.contains("stays uncut"));
    findings.push(Finding {
        rule: Rule::LostPocket,
        severity: Severity::Warning,
        detail: Detail::LostPocket {
            near: Point::new(29.0, 9.0),
        },
        ..findings[0].clone()
    });
    assert!(shown(&paths, &findings, &settings()).contains("stays uncut"));
    // A control that offsets the path cuts beside it.
    let controlled = [WirePath {
        side: Some(Side::Left),
        correction: 0.0,
        ..paths[0].clone()
    }];
    assert!(!shown(&controlled, &findings, &settings()).contains(r#"class="kerf""#));
    // Beside an open contour, which has no inside, the kerf is drawn all the same.
    let mut open = outlines.clone();
    open[0].contour.closed = false;
    (open[0].role, open[0].twice_area) = (Role::Left, 0.0);
    let beside = drawn(&drawing, &open, &findings, &paths, &settings());
    assert!(beside.contains(&wide(0.2)), "{beside}");
    // Several contours are numbered in their order.
    assert!(!plain.contains(r#"class="order""#));
    let twice = [paths[0].clone(), paths[0].clone()];
    let twice = shown(&twice, &findings, &settings());
    assert_eq!(twice.matches(r#"class="order""#).count(), 2, "{twice}");
}

/// What a viewer paints by itself are the elements that there would be.
#[test]
fn many_elements_come_in_pieces_where_that_is_asked() {
    let settings = settings();
    let shown = |count: usize| {
        let mut drawing = Drawing::new(None);
        for index in 0..count {
            let geometry = Geometry::Circle {
                center: Point::new(3.0 * index as f64, 0.0),
                radius: 1.0,
            };
            drawing.push(entity(&format!("{index:X}"), "0", Kind::Circle, geometry));
        }
        let view = View {
            name: None,
            drawing: &drawing,
            outlines: &[],
            findings: &[],
            paths: &[],
            parts: &[],
            holes: &[],
            why: None,
            settings: &settings,
        };
        (svg(&view), super::drawn(&view, true))
    };
    let (whole, few) = shown(10);
    assert_eq!((few.svg, few.pieces), (whole, None));
    let (whole, many) = shown(MANY + 1);
    assert!(!many.svg.contains("data-handle"));
    let pieces = many.pieces.unwrap();
    assert_eq!(pieces.len(), MANY + 1);
    for piece in pieces {
        let (class, handle) = (piece.class, piece.handle.unwrap());
        let data = data_of_runs(&[piece.at], true);
        let element = format!(r#"class="{class}" data-handle="{handle}" d="{data}""#);
        assert!(whole.contains(&element), "{element}");
    }
}
