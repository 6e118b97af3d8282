//! Which contours are cut, in which order, and the thread hole of each.

use super::{SQUARE, at, check, defaults, drawing, entity, outline, shown};
use crate::drawing::{Drawing, Geometry, Role, Unit};
use crate::finding::{Detail, Place, Rule};
use crate::geometry::Point;
use crate::settings::{Direction, Effective};
use crate::toolpath::job::Job;
use crate::toolpath::{Refusal, plan};

/// Contours come as they are drawn, or as they are selected; those within another come before it.
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
        let settings = Effective::default();
        let job = Job::of(&drawing, &outlines, &settings);
        let chosen = job.chosen(handles.as_deref(), Default::default(), &Default::default());
        let chosen = chosen.map(|chosen| chosen.outlines);
        assert_eq!(chosen, Ok(expected), "{handles:?}");
    }
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
            at(25.4, 50.8),
            Direction::Ccw,
            "1.000 2.000 in 1.400 2.000 ccw 1.400 2.000 out 1.000 2.000",
        ),
        (
            at(25.4, 55.88),
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
fn a_thread_hole_on_the_path_has_no_lead() {
    for thread in [at(5.0, 0.1), at(5.0004, 0.0996)] {
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
        (Role::Opening, None, 0.05, "no lead-in of at most 0.050 mm"),
        (
            Role::Opening,
            None,
            f64::INFINITY,
            "no lead-in of at most inf mm",
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
