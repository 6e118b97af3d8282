//! Outlines whose walls lie on one another: the sides that nesting gives them, and which of them are faults.

use super::{analysed, closed, drawing_of, entity, severities};
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Geometry, Role};
use wedm::finding::{Rule, Severity};
use wedm::geometry::Point;
use wedm::settings::{Effective, Settings, SideSetting};

fn rectangle(from: [f64; 2], to: [f64; 2]) -> Geometry {
    let corners = [[from[0], from[1]], [to[0], from[1]], to, [from[0], to[1]]];
    closed(&corners.map(|[x, y]| (x, y, 0.0))).geometry()
}

/// Outlines of which some are drawn again, by their corners, and a hole: the roles by nesting, and whether that is in doubt.
#[test]
fn an_outline_that_is_drawn_again_is_no_level_of_nesting() {
    let frame = |off: f64| rectangle([off, off], [30.0 - off, 20.0 - off]);
    let lines = |of: &Geometry| -> Vec<Geometry> {
        of.segments()
            .map(|segment| Geometry::Line {
                start: segment.start(),
                end: segment.end(),
            })
            .collect()
    };
    let hole = Geometry::Circle {
        center: Point::new(10.0, 10.0),
        radius: 4.0,
    };
    let slid = Geometry::Circle {
        center: Point::new(10.001, 10.001),
        radius: 4.0,
    };
    let by_nesting = Arc::new(Effective::of(&Settings {
        correction: Some(0.1),
        side: Some(SideSetting::Auto),
        ..Settings::default()
    }));
    let (punch, opening) = (Role::Punch, Role::Opening);
    for (drawn, roles, doubts) in [
        (vec![frame(0.0), hole.clone()], vec![punch, opening], 0),
        (
            vec![frame(0.0), frame(0.0), hole.clone()],
            vec![punch, punch, opening],
            0,
        ),
        (
            vec![frame(0.002), frame(0.0), hole.clone(), frame(0.002)],
            vec![punch, punch, opening, punch],
            0,
        ),
        (
            [vec![frame(0.0)], lines(&frame(0.0)), vec![hole.clone()]].concat(),
            vec![punch, punch, opening],
            0,
        ),
        (
            vec![frame(0.0), hole.clone(), slid],
            vec![punch, opening, opening],
            0,
        ),
        (
            vec![frame(0.0), frame(0.02), hole.clone()],
            vec![punch, opening, punch],
            1,
        ),
        (
            vec![frame(0.0), frame(0.06), frame(0.0), hole.clone()],
            vec![punch, opening, punch, punch],
            // The outline that is drawn again is told with the first one alone.
            1,
        ),
        (
            vec![frame(0.0), frame(0.3), hole.clone()],
            vec![punch, opening, punch],
            0,
        ),
    ] {
        let drawing = drawing_of(drawn, None);
        let mut analysis = Analysis::new(&drawing, by_nesting.clone());
        let found: Vec<Role> = analysis
            .outlines(&drawing)
            .iter()
            .map(|it| it.role)
            .collect();
        assert_eq!(found, roles);
        let findings = analysis.findings(&drawing, usize::MAX).0;
        let of_rule = severities(&findings, Rule::NarrowSlot);
        assert_eq!(of_rule, vec![Severity::Error; doubts], "{findings:#?}");
    }
}

/// Two outlines that share a stretch of wall: an error where the wire of the one runs in what the other leaves.
#[test]
fn parts_that_share_a_wall_have_no_room_between_them() {
    let left = || rectangle([0.0, 0.0], [10.0, 10.0]);
    let clockwise = || match left() {
        Geometry::Polyline { mut vertices, .. } => {
            vertices.reverse();
            Geometry::Polyline {
                closed: true,
                vertices,
            }
        }
        other => other,
    };
    let (punch, opening, both) = (Role::Punch, Role::Opening, Role::Both);
    for (one, other, roles, errors) in [
        (
            left(),
            rectangle([10.0, 0.0], [20.0, 10.0]),
            [punch, punch],
            1,
        ),
        (
            clockwise(),
            rectangle([10.0, 0.0], [20.0, 10.0]),
            [punch, punch],
            1,
        ),
        (
            left(),
            rectangle([10.0, 5.0], [20.0, 15.0]),
            [punch, punch],
            1,
        ),
        (
            left(),
            rectangle([10.002, 0.0], [20.0, 10.0]),
            [punch, punch],
            1,
        ),
        (
            left(),
            rectangle([9.998, 0.0], [20.0, 10.0]),
            [punch, punch],
            1,
        ),
        (
            left(),
            rectangle([10.0, 0.0], [20.0, 10.0]),
            [opening, opening],
            0,
        ),
        (
            left(),
            rectangle([10.0, 0.0], [20.0, 10.0]),
            [punch, opening],
            0,
        ),
        (
            left(),
            rectangle([10.0, 0.0], [20.0, 10.0]),
            [both, both],
            0,
        ),
        // An island at the wall of its opening, and an opening at the edge of its punch.
        (
            left(),
            rectangle([0.0, 4.0], [3.0, 7.0]),
            [opening, punch],
            1,
        ),
        (
            left(),
            rectangle([0.0, 4.0], [3.0, 7.0]),
            [punch, opening],
            0,
        ),
        // The wire round a punch comes through the wall of an opening beside it; those of two openings stay in them, and so does that
        // of a hole in the punch.
        (
            left(),
            rectangle([10.15, 0.0], [20.0, 10.0]),
            [punch, opening],
            1,
        ),
        (
            left(),
            rectangle([10.05, 0.0], [20.0, 10.0]),
            [opening, punch],
            1,
        ),
        (
            left(),
            rectangle([10.15, 0.0], [20.0, 10.0]),
            [opening, opening],
            0,
        ),
        (
            left(),
            rectangle([10.25, 0.0], [20.0, 10.0]),
            [punch, opening],
            0,
        ),
        (
            left(),
            rectangle([0.15, 4.0], [3.0, 7.0]),
            [punch, opening],
            0,
        ),
        // Drawn twice.
        (left(), left(), [punch, punch], 0),
        (left(), clockwise(), [opening, opening], 0),
    ] {
        let mut drawing = Drawing::new(None);
        for (geometry, role) in [one, other].into_iter().zip(roles) {
            drawing.push(entity(geometry, Some(role)));
        }
        let findings = analysed(&drawing).1;
        let found = severities(&findings, Rule::NarrowSlot);
        let found = found.iter().filter(|it| **it == Severity::Error).count();
        assert_eq!(found, errors, "{roles:?} {findings:#?}");
    }
}
