//! Paths of small drawings as data, and the offset held against another library's.

mod families;

use super::{PathSegment, Refusal, Source, WirePath, plan, plan_while};
use crate::drawing::{Contour, Drawing, Entity, Geometry, Outline, Role, Unit, Vertex};
use crate::finding::{Detail, Place, Rule, Severity};
use crate::geometry::{Arc, Point, Segment, direction};
use crate::settings::{Compensation, Corner, Direction, Effective, PointSetting, SideSetting};
use cavalier_contours::polyline::internal::pline_intersects::all_self_intersects_as_basic;
use cavalier_contours::polyline::{PlineSource, PlineSourceMut, PlineVertex, Polyline};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

fn entity(handle: &str, geometry: Geometry) -> Entity {
    Entity {
        handle: handle.into(),
        layer: "0".into(),
        role: None,
        kind: crate::drawing::Kind::LightPolyline,
        geometry,
    }
}

/// A drawing of polylines `[x, y, bulge]`, closed but where the role is none, with handles 2A, 2B, ….
fn drawing(polylines: &[(&[[f64; 3]], Option<Role>)]) -> (Drawing, Vec<Outline>) {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    let outlines = polylines
        .iter()
        .enumerate()
        .map(|(index, (vertices, role))| {
            let vertices = vertices
                .iter()
                .map(|&[x, y, bulge]| Vertex::new(x, y, bulge))
                .collect();
            let handle = format!("{:X}", 42 + index);
            let id = drawing.push(entity(
                &handle,
                Geometry::Polyline {
                    closed: role.is_some(),
                    vertices,
                },
            ));
            outline(&drawing, [(id, false)], *role)
        });
    let outlines = outlines.collect();
    (drawing, outlines)
}

fn outline(
    drawing: &Drawing,
    entities: impl IntoIterator<Item = (crate::drawing::EntityId, bool)>,
    role: Option<Role>,
) -> Outline {
    let contour = Contour::new(drawing, entities, role.is_some());
    let twice_area = if role.is_some() {
        contour.twice_area(drawing)
    } else {
        0.0
    };
    Outline {
        contour,
        role: role.unwrap_or(Role::Both),
        twice_area,
    }
}

const SQUARE: &[[f64; 3]] = &[
    [0.0, 0.0, 0.0],
    [10.0, 0.0, 0.0],
    [10.0, 10.0, 0.0],
    [0.0, 10.0, 0.0],
];

fn at(x: f64, y: f64) -> Option<PointSetting> {
    Some(PointSetting::One([x, y]))
}

/// Contours come as they are drawn, or as they are selected; what lies within another before it.
#[test]
fn machining_order_is_that_of_the_drawing_or_of_the_selection() {
    let square = |x: f64, y: f64, side: f64| {
        [
            [x, y, 0.0],
            [x + side, y, 0.0],
            [x + side, y + side, 0.0],
            [x, y + side, 0.0],
        ]
    };
    let (plate, left, right) = (
        square(0.0, 0.0, 40.0),
        square(5.0, 5.0, 5.0),
        square(20.0, 5.0, 5.0),
    );
    let opening = Some(Role::Opening);
    let (drawing, outlines) = drawing(&[(&plate, opening), (&left, opening), (&right, opening)]);
    for (handles, expected) in [
        (None, vec![1, 2, 0]),
        (Some(vec!["2C", "2B"]), vec![2, 1]),
        (Some(vec!["2C", "2B", "2C"]), vec![2, 1]),
        (Some(vec!["2C", "2A", "2B"]), vec![2, 1, 0]),
        (Some(vec!["2A", "2C"]), vec![2, 0]),
    ] {
        let handles =
            handles.map(|handles| handles.into_iter().map(String::from).collect::<Vec<_>>());
        let chosen = super::order::chosen(
            &drawing,
            &outlines,
            handles.as_deref(),
            Default::default(),
            &Default::default(),
            1e-9,
        )
        .map(|chosen| chosen.outlines);
        assert_eq!(chosen, Ok(expected), "{handles:?}");
    }
}

/// Each piece as `kind x y` of its end, in mm to the µm.
fn shown(path: &WirePath) -> String {
    let start = path
        .segments
        .first()
        .map_or(path.thread_hole, |segment| segment.geometry.start());
    let mut text = format!("{:.3} {:.3}", start.x + 0.0, start.y + 0.0);
    for PathSegment { geometry, source } in &path.segments {
        let kind = match (source, geometry) {
            (Source::LeadIn, _) => "in",
            (Source::LeadOut, _) => "out",
            (Source::Corner { .. }, _) => "corner",
            (_, Segment::Line(_)) => "line",
            (_, Segment::Arc(arc)) if arc.sweep > 0.0 => "ccw",
            (_, Segment::Arc(_)) => "cw",
        };
        let end = geometry.end().map(|c| if c.abs() < 5e-4 { 0.0 } else { c });
        text.push_str(&format!(" {kind} {:.3} {:.3}", end.x, end.y));
    }
    text
}

fn check(polyline: &[[f64; 3]], role: Option<Role>, settings: Effective, expected: &str) {
    let (drawing, outlines) = drawing(&[(polyline, role)]);
    let paths = plan(&drawing, &outlines, &settings, None).expect("a path");
    assert_eq!(paths.iter().map(shown).collect::<Vec<_>>(), [expected]);
}

fn check_refused(polyline: &[[f64; 3]], role: Option<Role>, settings: Effective, expected: &str) {
    let (drawing, outlines) = drawing(&[(polyline, role)]);
    assert_eq!(
        plan(&drawing, &outlines, &settings, None),
        Err(Refusal::Sentence(expected.into()))
    );
}

fn defaults() -> Effective {
    Effective {
        correction: 0.1,
        ..Effective::default()
    }
}

#[test]
fn an_opening_is_cut_inside_and_a_punch_outside() {
    check(
        SQUARE,
        Some(Role::Opening),
        defaults(),
        "5.000 3.000 in 5.000 0.100 line 9.900 0.100 line 9.900 9.900 line 0.100 9.900 line 0.100 0.100 line 5.000 0.100 out 5.000 3.000",
    );
    check(
        SQUARE,
        Some(Role::Punch),
        Effective {
            corner: Corner::Intersection,
            direction: Direction::Cw,
            ..defaults()
        },
        "5.000 -3.000 in 5.000 -0.100 line -0.100 -0.100 line -0.100 10.100 line 10.100 10.100 line 10.100 -0.100 line 5.000 -0.100 out 5.000 -3.000",
    );
    check(
        SQUARE,
        Some(Role::Punch),
        Effective {
            thread: at(-4.0, 5.0),
            ..defaults()
        },
        "-4.000 5.000 in -0.100 5.000 line -0.100 0.000 corner 0.000 -0.100 line 10.000 -0.100 corner 10.100 0.000 line 10.100 10.000 \
         corner 10.000 10.100 line 0.000 10.100 corner -0.100 10.000 line -0.100 5.000 out -4.000 5.000",
    );
}

#[test]
fn a_sharp_tip_is_rolled_about() {
    let wedge: &[[f64; 3]] = &[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 0.5, 0.0]];
    let (drawing, outlines) = drawing(&[(wedge, Some(Role::Punch))]);
    let settings = Effective {
        corner: Corner::Intersection,
        ..defaults()
    };
    let corners = plan(&drawing, &outlines, &settings, None).expect("a path")[0]
        .segments
        .iter()
        .filter(|piece| matches!(piece.source, Source::Corner { .. }))
        .map(|piece| piece.geometry.as_arc().expect("an arc").center)
        .collect::<Vec<_>>();
    assert_eq!(corners, [Point::new(10.0, 0.0)]);
}

#[test]
fn an_arc_of_the_correction_is_left_out() {
    let quarter = (PI / 8.0).tan();
    let fillet: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [9.9, 0.0, quarter],
        [10.0, 0.1, 0.0],
        [10.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
    ];
    check(
        fillet,
        Some(Role::Opening),
        Effective {
            entry: at(0.0, 5.0),
            ..defaults()
        },
        "3.000 5.000 in 0.100 5.000 line 0.100 0.100 line 9.900 0.100 line 9.900 9.900 line 0.100 9.900 line 0.100 5.000 out 3.000 5.000",
    );
    // Tighter than the correction: the neighbours are cut with each other and the wire stays clear of the part.
    let tight: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [9.95, 0.0, quarter],
        [10.0, 0.05, 0.0],
        [10.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
    ];
    check(
        tight,
        Some(Role::Opening),
        Effective {
            entry: at(0.0, 5.0),
            ..defaults()
        },
        "3.000 5.000 in 0.100 5.000 line 0.100 0.100 line 9.900 0.100 line 9.900 9.900 line 0.100 9.900 line 0.100 5.000 out 3.000 5.000",
    );
}

#[test]
fn chords_tighter_than_the_correction_are_used_up() {
    let mut outline = vec![[0.0, 0.0, 0.0], [9.95, 0.0, 0.0]];
    outline.extend((1..9).map(|step| {
        let end =
            Point::new(9.95, 0.05) + direction(-PI / 2.0 + PI / 2.0 * f64::from(step) / 9.0) * 0.05;
        [end.x, end.y, 0.0]
    }));
    outline.extend([[10.0, 0.05, 0.0], [10.0, 10.0, 0.0], [0.0, 10.0, 0.0]]);
    check(
        &outline,
        Some(Role::Opening),
        Effective {
            entry: at(0.0, 5.0),
            ..defaults()
        },
        "3.000 5.000 in 0.100 5.000 line 0.100 0.100 line 9.900 0.100 line 9.900 9.900 line 0.100 9.900 line 0.100 5.000 out 3.000 5.000",
    );
}

#[test]
fn a_circle_is_cut_from_the_side_of_its_thread_hole() {
    let mut drawing = Drawing::new(Some(Unit::INCH));
    let id = drawing.push(entity(
        "2A",
        Geometry::Circle {
            center: Point::new(1.0, 2.0),
            radius: 0.5,
        },
    ));
    let outline = outline(&drawing, [(id, false)], Some(Role::Opening));
    for (thread, direction, expected) in [
        (
            at(1.0, 2.0),
            Direction::Ccw,
            "1.000 2.000 in 1.400 2.000 ccw 1.400 2.000 out 1.000 2.000",
        ),
        (
            at(1.0, 2.2),
            Direction::Cw,
            "1.000 2.200 in 1.000 2.400 cw 1.000 2.400 out 1.000 2.200",
        ),
        // An inch of lead would end in the far side, half an inch does not.
        (
            None,
            Direction::Ccw,
            "1.000 2.000 in 1.400 2.000 ccw 1.400 2.000 out 1.000 2.000",
        ),
    ] {
        let settings = Effective {
            correction: 2.54,
            thread,
            direction,
            lead_in: 25.4,
            ..Effective::default()
        };
        let path = plan(&drawing, std::slice::from_ref(&outline), &settings, None)
            .expect("a path")
            .remove(0);
        assert!((path.correction - 0.1).abs() < 1e-12);
        assert_eq!(shown(&path), expected);
    }
}

#[test]
fn a_mark_is_the_thread_hole_of_the_nearest_contour() {
    let far: Vec<[f64; 3]> = SQUARE.iter().map(|[x, y, b]| [x + 50.0, *y, *b]).collect();
    let (mut drawing, outlines) =
        drawing(&[(SQUARE, Some(Role::Opening)), (&far, Some(Role::Opening))]);
    drawing.push(entity(
        "M",
        Geometry::Text {
            at: Point::new(57.0, 4.0),
            text: "O".into(),
        },
    ));
    let paths = plan(&drawing, &outlines, &defaults(), None).expect("paths");
    assert_eq!(paths[1].thread_hole, Point::new(57.0, 4.0));
    assert_eq!(paths[1].segments[0].geometry.end(), Point::new(59.9, 4.0));
    assert_eq!(paths[0].thread_hole, Point::new(5.0, 3.0));
    let only = plan(&drawing, &outlines, &defaults(), Some(&["2B".to_string()])).expect("a path");
    assert_eq!(only, paths[1..]);
}

#[test]
fn what_lies_within_a_contour_is_cut_before_it() {
    let square = |x: f64, y: f64, size: f64| -> Vec<[f64; 3]> {
        SQUARE
            .iter()
            .map(|c| [x + c[0] / 10.0 * size, y + c[1] / 10.0 * size, 0.0])
            .collect()
    };
    let check = |squares: &[[f64; 3]], expected: &[usize]| {
        let corners: Vec<_> = squares
            .iter()
            .map(|&[x, y, size]| square(x, y, size))
            .collect();
        let outlines: Vec<_> = corners
            .iter()
            .map(|corners| (&corners[..], Some(Role::Opening)))
            .collect();
        let (drawing, outlines) = drawing(&outlines);
        let paths = plan(
            &drawing,
            &outlines,
            &Effective {
                lead_in: 1.0,
                ..defaults()
            },
            None,
        )
        .expect("paths");
        assert_eq!(
            paths.iter().map(|path| path.outline).collect::<Vec<_>>(),
            expected
        );
    };
    check(
        &[[0.0, 0.0, 50.0], [10.0, 10.0, 5.0], [30.0, 30.0, 5.0]],
        &[1, 2, 0],
    );
    check(
        &[[10.0, 10.0, 5.0], [0.0, 0.0, 50.0], [80.0, 0.0, 5.0]],
        &[0, 1, 2],
    );
    check(
        &[
            [80.0, 0.0, 5.0],
            [0.0, 0.0, 50.0],
            [10.0, 10.0, 20.0],
            [15.0, 15.0, 5.0],
        ],
        &[0, 3, 2, 1],
    );
}

#[test]
fn a_thread_hole_on_the_entry_has_no_lead() {
    for thread in [at(5.0, 0.0), at(5.0, 0.1)] {
        let settings = Effective {
            thread,
            entry: at(5.0, 0.0),
            ..defaults()
        };
        check(
            SQUARE,
            Some(Role::Opening),
            settings,
            "5.000 0.100 line 9.900 0.100 line 9.900 9.900 line 0.100 9.900 line 0.100 0.100 line 5.000 0.100",
        );
    }
}

#[test]
fn an_entry_in_a_corner_begins_where_the_path_turns() {
    check(
        SQUARE,
        Some(Role::Opening),
        Effective {
            thread: at(3.0, 3.0),
            entry: at(0.0, 0.0),
            ..defaults()
        },
        "3.000 3.000 in 0.100 0.100 line 9.900 0.100 line 9.900 9.900 line 0.100 9.900 line 0.100 0.100 out 3.000 3.000",
    );
}

#[test]
fn a_lead_that_would_cut_the_part_is_a_finding() {
    let cases = [
        (Role::Punch, at(5.0, 5.0), 3.0, "crosses the contour"),
        (Role::Opening, at(0.05, 5.0), 3.0, "crosses the contour"),
        (Role::Opening, None, 0.05, "no lead-in from 0.050 mm down"),
        (
            Role::Opening,
            None,
            f64::INFINITY,
            "no lead-in from inf mm down",
        ),
    ];
    for (role, thread, lead_in, sentence) in cases {
        let (drawing, outlines) = drawing(&[(SQUARE, Some(role))]);
        let settings = Effective {
            thread,
            lead_in,
            entry: at(5.0, 0.0),
            ..defaults()
        };
        match plan(&drawing, &outlines, &settings, None) {
            Err(Refusal::Findings(found)) => {
                assert_eq!(found.len(), 1);
                assert_eq!(
                    (found[0].rule, &found[0].place),
                    (
                        Rule::LeadIn,
                        &Place::Segment {
                            entity: crate::drawing::EntityId(0),
                            segment: 0
                        }
                    )
                );
                assert!(
                    matches!(&found[0].detail, Detail::Said(text) if text.contains(sentence)),
                    "{found:?}"
                );
            }
            other => panic!("{role:?} {thread:?}: {other:?}", thread = settings.thread),
        }
    }
}

#[test]
fn what_cannot_be_planned_is_refused_in_a_sentence() {
    check_refused(
        SQUARE,
        Some(Role::Both),
        defaults(),
        "side of contour 2A is not known: say opening or punch",
    );
    check_refused(
        SQUARE,
        None,
        defaults(),
        "contour 2A is open: the side of the wire is not known; close it, or set compensation to none to cut it as drawn",
    );
    check_refused(
        SQUARE,
        Some(Role::Opening),
        Effective {
            entry: at(5.0, 0.02),
            ..defaults()
        },
        "the entry (5, 0.02) lies 0.020 mm from contour 2A, expected a point on it",
    );
    check_refused(
        SQUARE,
        None,
        Effective {
            compensation: Compensation::None,
            entry: at(5.0, 0.0),
            ..defaults()
        },
        "contour 2A is open and cannot be entered at (5, 0), expected one of its ends",
    );
    let table = BTreeMap::from([("77".to_string(), [0.0, 0.0])]);
    check_refused(
        SQUARE,
        Some(Role::Opening),
        Effective {
            thread: Some(PointSetting::ByHandle(table)),
            ..defaults()
        },
        "there is no entity with the handle 77",
    );
    check_refused(
        &[],
        Some(Role::Opening),
        defaults(),
        "there is no contour to cut",
    );
    let (drawing, outlines) =
        drawing(&[(SQUARE, Some(Role::Opening)), (SQUARE, Some(Role::Opening))]);
    let settings = Effective {
        thread: at(5.0, 5.0),
        ..defaults()
    };
    let sentence = "one thread hole is given for 2 contours: choose one contour by its handle, or give a table by handle";
    assert_eq!(
        plan(&drawing, &outlines, &settings, None),
        Err(Refusal::Sentence(sentence.into()))
    );
    assert!(plan(&drawing, &outlines, &settings, Some(&["2A".to_string()])).is_ok());
}

#[test]
fn a_slot_narrower_than_the_wire_is_left_out_and_an_error() {
    for (width, fits) in [(0.19, false), (0.2, true), (0.201, true)] {
        let keyhole: &[[f64; 3]] = &[
            [0.0, 0.0, 0.0],
            [10.0, 0.0, 0.0],
            [10.0, 5.0, 0.0],
            [20.0, 5.0, 0.0],
            [20.0, 5.0 + width, 0.0],
            [10.0, 5.0 + width, 0.0],
            [10.0, 10.0, 0.0],
            [0.0, 10.0, 0.0],
        ];
        let (drawing, outlines) = drawing(&[(keyhole, Some(Role::Opening))]);
        for direction in [Direction::Ccw, Direction::Cw] {
            let settings = Effective {
                direction,
                ..defaults()
            };
            let path = plan(&drawing, &outlines, &settings, None)
                .expect("a path")
                .remove(0);
            let furthest = path
                .segments
                .iter()
                .map(|piece| piece.geometry.end().x)
                .fold(0.0, f64::max);
            assert_eq!(furthest > 19.0, fits, "{width}");
        }
        let settings = Effective {
            side: SideSetting::Opening,
            ..defaults()
        };
        let (findings, _) = crate::analysis::Analysis::new(&drawing, std::sync::Arc::new(settings))
            .findings(&drawing, usize::MAX);
        let told = findings
            .iter()
            .any(|finding| finding.rule == Rule::NarrowSlot && finding.severity == Severity::Error);
        assert_eq!(told, !fits, "{width} {findings:?}");
    }
}

#[test]
fn without_compensation_the_contour_is_the_path() {
    let none = || Effective {
        compensation: Compensation::None,
        ..defaults()
    };
    check(
        SQUARE,
        Some(Role::Both),
        none(),
        "0.000 0.000 line 10.000 0.000 line 10.000 10.000 line 0.000 10.000 line 0.000 0.000",
    );
    check(
        SQUARE,
        None,
        none(),
        "0.000 0.000 line 10.000 0.000 line 10.000 10.000 line 0.000 10.000",
    );
    check(
        SQUARE,
        None,
        Effective {
            entry: at(0.0, 10.0),
            direction: Direction::Cw,
            ..none()
        },
        "0.000 10.000 line 10.000 10.000 line 10.000 0.000 line 0.000 0.000",
    );
    check(
        SQUARE,
        None,
        Effective {
            thread: at(-1.0, 0.0),
            ..none()
        },
        "-1.000 0.000 in 0.000 0.000 line 10.000 0.000 line 10.000 10.000 line 0.000 10.000",
    );
    check(
        SQUARE,
        Some(Role::Both),
        Effective {
            thread: at(12.0, 5.0),
            ..none()
        },
        "12.000 5.000 in 10.000 5.000 line 10.000 10.000 line 0.000 10.000 line 0.000 0.000 line 10.000 0.000 line 10.000 5.000 out 12.000 5.000",
    );
}

#[test]
fn gaps_within_the_join_tolerance_are_closed_half_way() {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    let sides = [
        [0.0, 0.0, 10.0, 0.0],
        [10.004, 0.0, 10.0, 10.0],
        [10.0, 10.0, 0.0, 10.0],
        [0.0, 10.0, 0.0, 0.0],
    ];
    let lines = sides.map(|[x1, y1, x2, y2]| {
        (
            drawing.push(entity(
                "L",
                Geometry::Line {
                    start: Point::new(x1, y1),
                    end: Point::new(x2, y2),
                },
            )),
            false,
        )
    });
    let outline = outline(&drawing, lines, Some(Role::Opening));
    let path = plan(
        &drawing,
        &[outline],
        &Effective {
            entry: at(0.0, 5.0),
            ..defaults()
        },
        None,
    )
    .expect("a path")
    .remove(0);
    assert_eq!(
        shown(&path),
        "3.000 5.000 in 0.100 5.000 line 0.100 0.100 line 9.902 0.100 line 9.900 9.900 line 0.100 9.900 line 0.100 5.000 out 3.000 5.000"
    );
}

/// A closed outline about the origin with filleted or sharp corners and now and then a bowed side.
fn random_outline() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let corner = (
        2.0_f64..12.0,
        prop_oneof![
            Just(0.0),
            0.01_f64..0.0999,
            0.1001_f64..0.12,
            0.1001_f64..3.0
        ],
        prop_oneof![3 => Just(0.0), 1 => -0.5_f64..0.5],
    );
    (prop::collection::vec(corner, 3..14), 0.0_f64..TAU).prop_map(|(corners, turned)| {
        let count = corners.len();
        let point = |index: usize| {
            Point::origin()
                + direction(turned + TAU * (index % count) as f64 / count as f64)
                    * corners[index % count].0
        };
        let mut outline = Vec::new();
        for (index, &(_, radius, bow)) in corners.iter().enumerate() {
            let (before, vertex, after) =
                (point(index + count - 1), point(index), point(index + 1));
            let (arriving, leaving) = ((vertex - before).normalize(), (after - vertex).normalize());
            let turned = crate::geometry::turn(arriving, leaving);
            let back = radius * (turned.abs() / 2.0).tan();
            let room = (vertex - before).norm().min((after - vertex).norm()) * 0.45;
            let straight = bow == 0.0 && corners[(index + count - 1) % count].2 == 0.0;
            if straight && back > 1e-3 && back < room {
                let (foot, next) = (vertex - arriving * back, vertex + leaving * back);
                outline.push([foot.x, foot.y, (turned / 4.0).tan()]);
                outline.push([next.x, next.y, bow]);
            } else {
                outline.push([vertex.x, vertex.y, bow]);
            }
        }
        outline
    })
}

/// Points along segments, at most `step` apart.
fn samples(segments: &[Segment], step: f64) -> Vec<Point> {
    let each = |segment: &Segment| {
        let count = (segment.length() / step).ceil().max(1.0) as usize;
        let segment = *segment;
        (0..count)
            .map(move |index| segment.point_at(index as f64 / count as f64))
            .collect::<Vec<_>>()
    };
    segments.iter().flat_map(each).collect()
}

fn furthest(points: &[Point], segments: &[Segment]) -> f64 {
    let away = |point: &Point| {
        segments
            .iter()
            .map(|segment| segment.distance_to(*point))
            .fold(f64::INFINITY, f64::min)
    };
    points.iter().map(away).fold(0.0, f64::max)
}

/// What the other library offsets; `None` where the outline crosses itself.
fn judged(outline: &[[f64; 3]], offset: f64) -> Option<Vec<Vec<Segment>>> {
    let mut polyline = Polyline::new_closed();
    outline
        .iter()
        .for_each(|&[x, y, bulge]| polyline.add(x, y, bulge));
    let index = polyline.create_approx_aabb_index();
    if !all_self_intersects_as_basic(&polyline, &index, false, 1e-7).is_empty() {
        return None;
    }
    let segments = |pline: &Polyline| {
        let vertices: Vec<PlineVertex> = pline.iter_vertexes().collect();
        let next = |index: usize| vertices[(index + 1) % vertices.len()];
        let segment = |(index, v): (usize, &PlineVertex)| {
            Segment::from_bulge(
                [v.x, v.y].into(),
                [next(index).x, next(index).y].into(),
                v.bulge,
            )
        };
        vertices.iter().enumerate().map(segment).collect()
    };
    Some(
        polyline
            .parallel_offset(offset)
            .iter()
            .map(segments)
            .collect(),
    )
}

proptest! {
    #![proptest_config(ProptestConfig { max_global_rejects: 100_000, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn a_path_is_what_another_library_offsets(outline in random_outline(), punch: bool, clockwise: bool) {
        let role = if punch { Role::Punch } else { Role::Opening };
        let (drawing, outlines) = drawing(&[(&outline, Some(role))]);
        let side = outlines[0].wire_side().map_or(0.0, |side| side.sign());
        let settings = Effective { direction: if clockwise { Direction::Cw } else { Direction::Ccw }, lead_in: 0.0, ..defaults() };
        let settings = Effective { thread: at(outline[0][0], outline[0][1]), ..settings };
        let judged = judged(&outline, 0.1 * side);
        prop_assume!(judged.is_some());
        let expected = judged.unwrap_or_default();
        match plan(&drawing, &outlines, &settings, None) {
            Err(Refusal::Findings(found)) => {
                let rules: Vec<Rule> = found.iter().map(|finding| finding.rule).collect();
                prop_assert!(matches!(rules[..], [Rule::LostPocket | Rule::OffsetCollapse]), "{:?}", found);
                // A refusal is right only where the wire cannot follow the contour all the way round.
                let walls: Vec<Segment> = outlines[0].contour.segments(&drawing).map(|s| s.geometry).collect();
                let followed: Vec<Segment> = expected.iter().flatten().copied().collect();
                let lost = furthest(&samples(&walls, 0.05), &followed) > 0.1 + 1e-4;
                prop_assert!(lost || expected.len() != 1, "{:?}", found);
            }
            Err(refusal) => prop_assert!(false, "{:?}", refusal),
            Ok(paths) => {
                let path: Vec<Segment> = paths[0].segments.iter().map(|piece| piece.geometry).collect();
                prop_assert_eq!(expected.len(), 1);
                // The other library takes points 1e-5 apart for one; how exact the offset is, the walls say.
                let points = samples(&path, 0.25);
                prop_assert!(furthest(&points, &expected[0]) < 2e-5);
                prop_assert!(furthest(&samples(&expected[0], 0.25), &path) < 2e-5);
                let walls: Vec<Segment> = outlines[0].contour.segments(&drawing).map(|s| s.geometry).collect();
                for point in points {
                    prop_assert!((furthest(&[point], &walls) - 0.1).abs() < 1e-6);
                }
                for pair in path.windows(2) {
                    prop_assert_eq!(pair[0].end(), pair[1].start());
                }
                prop_assert_eq!(path[path.len() - 1].end(), path[0].start());
                let consistent = |arc: &Arc| ((arc.start - arc.center).norm() - arc.radius).abs() < 1e-6 && ((arc.end - arc.center).norm() - arc.radius).abs() < 1e-6;
                prop_assert!(path.iter().filter_map(Segment::as_arc).all(consistent));
                let program = crate::program::three_b::write(&paths, 1.0, &settings);
                prop_assert!(program.is_ok(), "{:?}", program);
            }
        }
    }
}

#[test]
fn a_path_that_nobody_wants_any_more_is_given_up() {
    let (drawing, outlines) = circles(40);
    let asked = std::cell::Cell::new(0);
    // Given up at each of the places where it asks, whichever comes first.
    let until = |most: usize| {
        asked.set(0);
        let goes_on = || {
            asked.set(asked.get() + 1);
            asked.get() <= most
        };
        plan_while(&drawing, &outlines, &defaults(), None, false, &goes_on)
    };
    assert!(until(usize::MAX).is_ok());
    let places = asked.get();
    assert!(places > 40 * 3, "{places}");
    for most in 0..places {
        assert_eq!(until(most), Err(Refusal::Cancelled), "{most} of {places}");
        assert_eq!(asked.get(), most + 1, "nothing is done once it has said so");
    }
}

/// Openings side by side.
fn circles(count: usize) -> (Drawing, Vec<Outline>) {
    let mut drawing = Drawing::new(None);
    for number in 0..count {
        let geometry = Geometry::Circle {
            center: Point::new(number as f64 * 10.0, 0.0),
            radius: 3.0,
        };
        drawing.push(Entity {
            handle: format!("{number}").into(),
            layer: "0".into(),
            role: Some(Role::Opening),
            kind: crate::drawing::Kind::Circle,
            geometry,
        });
    }
    let outlines = crate::analysis::Analysis::new(&drawing, std::sync::Arc::new(defaults()))
        .outlines(&drawing)
        .to_vec();
    (drawing, outlines)
}
