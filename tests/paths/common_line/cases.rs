//! What is drawn and what becomes of it.

use super::{circle, line, polygon, rectangle};
use wedm::drawing::{Geometry, Vertex};

/// The sides of a rectangle as lines.
fn sides(x: f64, y: f64, width: f64, height: f64) -> Vec<Geometry> {
    let (right, top) = (x + width, y + height);
    vec![
        line(x, y, right, y),
        line(right, y, right, top),
        line(right, top, x, top),
        line(x, top, x, y),
    ]
}

fn ell() -> Geometry {
    polygon(&[
        (0.0, 0.0),
        (30.0, 0.0),
        (30.0, 10.0),
        (10.0, 10.0),
        (10.0, 30.0),
        (0.0, 30.0),
    ])
}

/// What is drawn; how many contours and which cuts on lines there are, and what is said of the first line.
pub(super) type Case = (
    &'static str,
    Vec<Geometry>,
    usize,
    Vec<[[f64; 2]; 2]>,
    &'static str,
);

pub(super) fn cases() -> Vec<Case> {
    let (left, right) = (
        rectangle([0.0, 0.0], [20.0, 10.0]),
        rectangle([20.0, 0.0], [20.0, 10.0]),
    );
    vec![
        (
            "two rectangles by eight lines",
            [sides(0.0, 0.0, 20.0, 10.0), sides(20.0, 0.0, 20.0, 10.0)].concat(),
            2,
            vec![[[20.0, 10.0], [20.0, 0.0]]],
            "contours 1, 2 share an edge of 10.000 mm: one cut on this line parts them, and each loses 0.100 mm along it; 1 measures 19.900 mm across it in place of 20.000; 2 measures 19.900 mm across it in place of 20.000",
        ),
        (
            "two rectangles by seven lines",
            [
                sides(0.0, 0.0, 20.0, 10.0),
                sides(20.0, 0.0, 20.0, 10.0)[..3].to_vec(),
            ]
            .concat(),
            2,
            vec![[[20.0, 0.0], [20.0, 10.0]]],
            "line of 10.000 mm between two parts of contour 1: one cut on it parts them, and each loses 0.100 mm along it",
        ),
        (
            "one rectangle with a line across",
            vec![
                rectangle([0.0, 0.0], [40.0, 10.0]),
                line(15.0, 0.0, 15.0, 10.0),
            ],
            2,
            vec![[[15.0, 0.0], [15.0, 10.0]]],
            "line of 10.000 mm between two parts of contour 1",
        ),
        (
            "two rectangles by polylines",
            vec![left.clone(), right.clone()],
            2,
            vec![[[20.0, 10.0], [20.0, 0.0]]],
            "contours 1, 2 share an edge of 10.000 mm",
        ),
        (
            "one of them the other way round",
            vec![
                left.clone(),
                polygon(&[(20.0, 0.0), (20.0, 10.0), (40.0, 10.0), (40.0, 0.0)]),
            ],
            2,
            vec![[[20.0, 10.0], [20.0, 0.0]]],
            "contours 1, 2 share an edge of 10.000 mm",
        ),
        (
            "a rectangle in the corner of an L",
            vec![ell(), rectangle([10.0, 10.0], [15.0, 15.0])],
            2,
            vec![[[10.0, 25.0], [25.0, 10.0]]],
            "contours 1, 2 share an edge of 30.000 mm: one cut on this line parts them, and each loses 0.100 mm along it",
        ),
        (
            "an L beside a rectangle that is longer",
            vec![ell(), rectangle([-12.0, -5.0], [12.0, 45.0])],
            2,
            vec![[[0.0, 0.0], [0.0, 30.0]]],
            "contours 1, 2 share an edge of 30.000 mm: one cut on this line parts them, and each loses 0.100 mm along it; 1 measures 29.900 mm across it in place of 30.000; 2 measures 11.900",
        ),
        (
            "three in a row",
            vec![
                left.clone(),
                right.clone(),
                rectangle([40.0, 0.0], [20.0, 10.0]),
            ],
            3,
            vec![[[40.0, 10.0], [40.0, 0.0]], [[20.0, 10.0], [20.0, 0.0]]],
            "contours 2, 3 share an edge of 10.000 mm: one cut on this line parts them, and each loses 0.100 mm along it; 2 measures 19.800 mm across it in place of 20.000; 3 measures 19.900",
        ),
        (
            "four round a point",
            vec![
                left.clone(),
                right.clone(),
                rectangle([0.0, 10.0], [20.0, 10.0]),
                rectangle([20.0, 10.0], [20.0, 10.0]),
            ],
            3,
            vec![[[20.0, 20.0], [20.0, 0.0]], [[0.0, 10.0], [40.0, 10.0]]],
            "contours 1, 2, 3, 4 share an edge of 20.000 mm",
        ),
        (
            "bricks",
            vec![
                left.clone(),
                right.clone(),
                rectangle([0.0, 10.0], [40.0, 10.0]),
            ],
            3,
            vec![[[0.0, 10.0], [40.0, 10.0]], [[20.0, 0.0], [20.0, 10.0]]],
            "contours 1, 2, 3 share an edge of 40.000 mm",
        ),
        (
            "a hole in one of them",
            vec![left.clone(), right.clone(), circle(10.0, 5.0, 2.0)],
            3,
            vec![[[20.0, 10.0], [20.0, 0.0]]],
            "contours 1, 2 share an edge of 10.000 mm",
        ),
        (
            "half discs",
            vec![
                Geometry::Polyline {
                    closed: true,
                    vertices: vec![Vertex::new(0.0, 0.0, 1.0), Vertex::new(10.0, 0.0, 0.0)],
                },
                Geometry::Polyline {
                    closed: true,
                    vertices: vec![Vertex::new(10.0, 0.0, 1.0), Vertex::new(0.0, 0.0, 0.0)],
                },
            ],
            2,
            vec![[[0.0, 0.0], [10.0, 0.0]]],
            "contours 1, 2 share an edge of 10.000 mm",
        ),
        (
            "an arc between them",
            vec![
                Geometry::Polyline {
                    closed: true,
                    vertices: vec![
                        Vertex::new(0.0, 0.0, 0.0),
                        Vertex::new(20.0, 0.0, 0.2),
                        Vertex::new(20.0, 10.0, 0.0),
                        Vertex::new(0.0, 10.0, 0.0),
                    ],
                },
                Geometry::Polyline {
                    closed: true,
                    vertices: vec![
                        Vertex::new(20.0, 0.0, 0.0),
                        Vertex::new(40.0, 0.0, 0.0),
                        Vertex::new(40.0, 10.0, 0.0),
                        Vertex::new(20.0, 10.0, -0.2),
                    ],
                },
            ],
            2,
            vec![[[20.0, 10.0], [20.0, 0.0]]],
            "contours 1, 2 share an edge of 10.265 mm: one cut on this line parts them, and each loses 0.100 mm along it",
        ),
    ]
}
