//! Contours that are cut on the line beside others that are cut with a correction.

use super::{CORRECTION, circle, drawing, rectangle, settings};
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Geometry, Role};
use wedm::geometry::Point;
use wedm::settings::Effective;
use wedm::toolpath::{Refusal, Source, plan};

const LINE: Option<Role> = Some(Role::Line);
const OPENING: Option<Role> = Some(Role::Opening);
const PUNCH: Option<Role> = Some(Role::Punch);

fn line(x: f64, y: f64, x1: f64, y1: f64) -> Geometry {
    Geometry::Line {
        start: Point::new(x, y),
        end: Point::new(x1, y1),
    }
}

/// An outer contour of 60 × 40 with an opening of 20 × 10 in its middle, and what is cut on the line.
fn with_lines(lines: &[(&str, Geometry)]) -> Vec<(String, Option<Role>, Geometry)> {
    let part = [
        ("P", PUNCH, rectangle([0.0, 0.0], [60.0, 40.0])),
        ("D", OPENING, rectangle([20.0, 15.0], [20.0, 10.0])),
    ];
    let lines = lines
        .iter()
        .map(|(handle, own)| (*handle, LINE, own.clone()));
    let all = lines.chain(part);
    all.map(|(handle, role, own)| (handle.to_owned(), role, own))
        .collect()
}

fn of(entities: &[(String, Option<Role>, Geometry)]) -> Vec<(&str, Option<Role>, Geometry)> {
    let all = entities.iter();
    all.map(|(handle, role, own)| (handle.as_str(), *role, own.clone()))
        .collect()
}

#[test]
fn a_line_is_its_own_path_in_one_pass_whatever_the_passes() {
    let entities = with_lines(&[
        ("S", line(50.0, 20.0, 40.0, 20.0)),
        ("M", circle(10.0, 10.0, 0.05)),
    ]);
    let (drawing, outlines) = drawing(&of(&entities));
    let settings = Effective {
        corrections: vec![CORRECTION, 0.08, 0.07],
        ..settings()
    };
    let paths = plan(&drawing, &outlines, &settings, None).unwrap();
    let cut: Vec<(String, usize)> = paths
        .iter()
        .map(|path| {
            let first = outlines[path.outline].contour.pieces[0].entity;
            (drawing.get(first).unwrap().handle.to_string(), path.pass)
        })
        .collect();
    let cut: Vec<(&str, usize)> = cut
        .iter()
        .map(|(handle, pass)| (handle.as_str(), *pass))
        .collect();
    // The slit begins in the opening, which is cut before it; all lie within the outer contour.
    assert_eq!(
        cut.iter()
            .filter(|(_, pass)| *pass == 1)
            .map(|(handle, _)| *handle)
            .collect::<Vec<_>>(),
        ["M", "D", "S", "P"],
    );
    for handle in ["S", "M"] {
        let passes = cut.iter().filter(|(of, _)| *of == handle).count();
        assert_eq!(passes, 1, "{handle}");
    }
    let slit = paths.iter().find(|path| path.outline == 0).unwrap();
    assert_eq!((slit.correction, slit.side), (0.0, None));
    // Threaded in the opening, 3 mm beside the end that lies on its wall, and not at the end that is drawn first.
    assert_eq!(slit.thread_hole, Point::new(37.0, 20.0));
    let of_slit = slit
        .segments
        .iter()
        .filter(|it| matches!(it.source, Source::Segment { .. }));
    let of_slit: Vec<_> = of_slit
        .map(|it| (it.geometry.start(), it.geometry.end()))
        .collect();
    assert_eq!(of_slit, [(Point::new(40.0, 20.0), Point::new(50.0, 20.0))]);
}

/// A line, and the rule that refuses it, if one does.
#[test]
fn a_line_takes_of_a_part_only_where_it_meets_its_contour() {
    for (name, own, refused) in [
        ("from the wall outwards", line(40.0, 20.0, 50.0, 20.0), None),
        (
            "from the inside through the wall",
            line(35.0, 20.0, 50.0, 20.0),
            None,
        ),
        (
            "through both walls of the opening",
            line(10.0, 20.0, 50.0, 20.0),
            None,
        ),
        ("from a corner", line(40.0, 25.0, 50.0, 35.0), None),
        ("at 20° from the wall", line(30.0, 25.0, 50.0, 32.28), None),
        ("well beside a wall", line(20.0, 14.0, 40.0, 14.0), None),
        (
            "along a wall within the correction",
            line(20.0, 14.95, 40.0, 14.95),
            Some("unproved-path"),
        ),
        (
            "on a wall",
            line(22.0, 15.0, 38.0, 15.0),
            Some("unproved-path"),
        ),
        (
            "up to a wall that it does not reach",
            line(50.0, 20.0, 40.05, 20.0),
            Some("unproved-path"),
        ),
        (
            "at 2° from the wall",
            line(30.0, 25.0, 50.0, 25.7),
            Some("unproved-path"),
        ),
        ("closed, about a corner", circle(40.0, 25.0, 3.0), None),
        (
            "closed, tangent to a wall",
            circle(43.0, 20.0, 3.0),
            Some("unproved-path"),
        ),
        (
            "closed, beside a wall",
            circle(43.05, 20.0, 3.0),
            Some("unproved-path"),
        ),
    ] {
        let entities = with_lines(&[("S", own)]);
        let (drawing, outlines) = drawing(&of(&entities));
        let refusal = match plan(&drawing, &outlines, &settings(), None) {
            Ok(_) => None,
            Err(Refusal::Findings(found)) => Some(found[0].rule.name()),
            Err(refusal) => panic!("{name}: {refusal:?}"),
        };
        assert_eq!(refusal, refused, "{name}");
        // While it is drawn it is said as well.
        let mut analysis = Analysis::new(&drawing, Arc::new(settings()));
        let (found, _) = analysis.findings(&drawing, usize::MAX);
        let errors: Vec<&str> = found
            .iter()
            .filter(|it| {
                it.severity == wedm::finding::Severity::Error && it.rule.name() != "overlap"
            })
            .map(|it| it.rule.name())
            .collect();
        assert_eq!(errors.first().copied(), refused, "{name}");
    }
}

#[test]
fn a_line_needs_no_room_and_is_no_wall() {
    let zigzag = Geometry::Polyline {
        closed: false,
        vertices: [
            (5.0, 5.0, 0.0),
            (5.05, 5.0, -1.0),
            (5.1, 5.0, 0.0),
            (5.1, 5.08, 0.0),
            (5.0, 5.08, 0.0),
        ]
        .map(|(x, y, bulge)| wedm::drawing::Vertex::new(x, y, bulge))
        .to_vec(),
    };
    let entities = with_lines(&[("Z", zigzag), ("F", rectangle([-1.0, -1.0], [62.0, 42.0]))]);
    let (drawing, outlines) = drawing(&of(&entities));
    let mut analysis = Analysis::new(&drawing, Arc::new(settings()));
    let (found, _) = analysis.findings(&drawing, usize::MAX);
    let rules: Vec<&str> = found.iter().map(|it| it.rule.name()).collect();
    assert!(
        rules.iter().all(|rule| ![
            "small-radius",
            "narrow-slot",
            "lost-pocket",
            "open-contour",
            "offset-collapse"
        ]
        .contains(rule)),
        "{rules:?}"
    );
    // A frame round everything does not turn the nesting over.
    let auto = Arc::new(Effective {
        side: wedm::settings::SideSetting::Auto,
        ..settings()
    });
    let bare: Vec<_> = entities
        .iter()
        .map(|(handle, role, own)| {
            (
                handle.as_str(),
                role.filter(|role| *role == Role::Line),
                own.clone(),
            )
        })
        .collect();
    let (drawing, _) = super::drawing(&bare);
    let of_nesting = Analysis::new(&drawing, auto);
    let roles: Vec<Role> = of_nesting
        .outlines(&drawing)
        .iter()
        .map(|it| it.role)
        .collect();
    assert_eq!(roles, [Role::Line, Role::Line, Role::Punch, Role::Opening]);
    assert_eq!(outlines.len(), 4);
}

#[test]
fn a_slit_at_a_corner_is_no_part_of_the_contour_there() {
    let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)];
    let sides = (0..4).map(|at| {
        let ((x, y), (x1, y1)) = (corners[at], corners[(at + 1) % 4]);
        (["1", "2", "3", "4"][at], OPENING, line(x, y, x1, y1))
    });
    let all: Vec<_> = std::iter::once(("S", LINE, line(15.0, 15.0, 10.0, 10.0)))
        .chain(sides)
        .collect();
    let (_, outlines) = drawing(&all);
    let closed: Vec<(bool, Role)> = outlines
        .iter()
        .map(|it| (it.contour.closed, it.role))
        .collect();
    assert_eq!(closed, [(false, Role::Line), (true, Role::Opening)]);
}

/// A line begins in solid steel where nothing else is near: its start hole is checked as a given one is.
#[test]
fn the_start_hole_of_a_line_keeps_clear_of_the_walls() {
    for (name, own, is_told) in [
        ("far from any wall", line(44.0, 20.0, 50.0, 20.0), false),
        ("beside a wall", line(40.8, 20.0, 50.0, 20.0), true),
        ("in the opening", line(35.0, 20.0, 50.0, 20.0), false),
    ] {
        let entities = with_lines(&[("S", own)]);
        let (drawing, _) = drawing(&of(&entities));
        let settings = Arc::new(Effective {
            start_hole: Some(2.0),
            ..settings()
        });
        let (found, _) = Analysis::new(&drawing, settings).findings(&drawing, usize::MAX);
        let told = found.iter().any(|it| it.rule.name() == "start-hole");
        assert_eq!(told, is_told, "{name}: {found:?}");
    }
}
