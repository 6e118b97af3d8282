//! The order of contours, and what the selection says of it.

use super::{along, circle, drawing, rectangle, settings};
use std::sync::Arc;
use wedm::drawing::{Drawing, Geometry, Outline, Role};
use wedm::geometry::Point;
use wedm::settings::{Direction, Effective, Order};
use wedm::toolpath::plan;

/// Four lines in a square, drawn about, with the handles 21 to 24 counter-clockwise from the bottom.
fn square_of_lines() -> (Drawing, Arc<Vec<Outline>>) {
    let line = |x0: f64, y0: f64, x1: f64, y1: f64| Geometry::Line {
        start: Point::new(x0, y0),
        end: Point::new(x1, y1),
    };
    let opening = Some(Role::Opening);
    drawing(&[
        ("23", opening, line(10.0, 10.0, 0.0, 10.0)),
        ("21", opening, line(0.0, 0.0, 10.0, 0.0)),
        ("24", opening, line(0.0, 0.0, 0.0, 10.0)),
        ("22", opening, line(10.0, 10.0, 10.0, 0.0)),
    ])
}

#[test]
fn as_picked_the_selection_says_where_a_chain_begins_and_which_way_it_goes() {
    let (drawing, outlines) = square_of_lines();
    let check = |picked: &[&str], direction: Option<Direction>, expected: &str| {
        let handles: Vec<String> = picked.iter().map(|handle| handle.to_string()).collect();
        let direction = Effective {
            stated_direction: direction,
            direction: direction.unwrap_or_default(),
            ..settings()
        };
        let paths = plan(
            &drawing,
            &outlines,
            &Effective {
                order: Order::AsPicked,
                states_order: true,
                ..direction
            },
            Some(&handles),
        )
        .unwrap();
        assert_eq!(along(&drawing, &paths[0]).join(" "), expected, "{picked:?}");
        // Begins where the first entity begins, not in its middle.
        let begin = paths[0].segments[1].geometry;
        assert!((begin.length() - 9.8).abs() < 1e-9, "{picked:?}: {begin:?}");
    };
    check(&["21", "22", "23"], None, "21 22 23 24");
    check(&["23", "22", "21"], None, "23 22 21 24");
    check(&["22", "21"], None, "22 21 24 23");
    check(&["22"], None, "22 23 24 21");
    // No way is shorter.
    check(&["22", "24"], None, "22 23 24 21");
    check(&["22", "24", "21"], None, "22 21 24 23");
    // A direction that is set wins.
    check(&["23", "22", "21"], Some(Direction::Ccw), "23 24 21 22");
    check(&["21", "22", "23"], Some(Direction::Cw), "21 24 23 22");
    // Any other order takes the handles for a selection alone.
    let handles = ["23".to_string(), "22".to_string()];
    let paths = plan(&drawing, &outlines, &settings(), Some(&handles)).unwrap();
    assert_eq!(paths, plan(&drawing, &outlines, &settings(), None).unwrap());
}

#[test]
fn contours_are_cut_in_the_order_that_is_asked_for() {
    let opening = Some(Role::Opening);
    let holes = [30.0, 0.0, 20.0, 10.0].map(|x| circle(x, 0.0, 2.0));
    let [a, b, c, d] = holes;
    let plate = rectangle([-5.0, -5.0], [50.0, 10.0]);
    let (drawing, outlines) = drawing(&[
        ("A", opening, a),
        ("P", Some(Role::Punch), plate),
        ("B", opening, b),
        ("C", opening, c),
        ("D", opening, d),
    ]);
    let ordered = |order: Order, handles: Option<&[&str]>| {
        let handles: Option<Vec<String>> =
            handles.map(|handles| handles.iter().map(|handle| handle.to_string()).collect());
        let paths = plan(
            &drawing,
            &outlines,
            &Effective {
                order,
                states_order: true,
                ..settings()
            },
            handles.as_deref(),
        )
        .unwrap();
        paths
            .iter()
            .map(|path| along(&drawing, path)[0].clone())
            .collect::<Vec<_>>()
            .join("")
    };
    assert_eq!(ordered(Order::AsDrawn, None), "ABCDP");
    assert_eq!(ordered(Order::InsideFirst, None), "ABCDP");
    assert_eq!(ordered(Order::Nearest, None), "ACDBP");
    assert_eq!(ordered(Order::AsPicked, Some(&["C", "P", "A"])), "CAP");
    assert_eq!(
        ordered(Order::AsPicked, Some(&["D", "B", "A", "C", "P"])),
        "DBACP"
    );
    assert_eq!(ordered(Order::Nearest, Some(&["D", "B", "A", "C"])), "DBCA");
}

#[test]
fn the_nearest_contour_is_not_the_one_whose_x_is_nearest() {
    let opening = Some(Role::Opening);
    for far in [-100.0, 0.0, 100.0] {
        for side in [-1.0, 1.0] {
            let hole = |x: f64, y: f64| circle(far + side * x, y, 2.0);
            let (drawing, outlines) = drawing(&[
                ("A", opening, hole(0.0, 0.0)),
                ("B", opening, hole(-1.0, 30.0)),
                ("C", opening, hole(10.0, 0.0)),
            ]);
            let nearest = Effective {
                order: Order::Nearest,
                ..settings()
            };
            let paths = plan(&drawing, &outlines, &nearest, None).unwrap();
            let order = paths.iter().map(|path| along(&drawing, path)[0].clone());
            assert_eq!(order.collect::<Vec<_>>().join(""), "ACB", "{far} {side}");
        }
    }
}
