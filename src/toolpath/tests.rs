//! Paths of small drawings as data, and the offset compared with another library's.

mod families;
mod order;
mod random;
mod refusals;

use super::{PathSegment, Source, WirePath, plan};
use crate::drawing::{Contour, Drawing, Entity, Geometry, Outline, Role, Unit, Vertex};
use crate::geometry::{Point, Segment, direction};
use crate::settings::{Compensation, Corner, Direction, Effective, PointSetting};
use std::f64::consts::PI;

fn entity(handle: &str, geometry: Geometry) -> Entity {
    Entity {
        handle: handle.into(),
        layer: "0".into(),
        role: None,
        kind: crate::drawing::Kind::LightPolyline,
        geometry,
    }
}

/// A drawing of polylines `[x, y, bulge]`, closed unless they have no role, with handles 2A, 2B, ….
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
