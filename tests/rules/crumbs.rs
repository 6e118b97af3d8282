//! What is shorter than the resolution does not exist: the corner that it hides is judged as that corner, on every way to draw it.

use super::{Shape, analysed_under, closed, drawing_of, saying_from};
use wedm::drawing::{Drawing, Geometry, Role, Vertex};
use wedm::finding::{Rule, Severity};
use wedm::geometry::Point;

/// A square of which each corner is replaced by vertices about it, as `at` draws it: along the way in and along the way out.
fn square(at: impl Fn(f64) -> Vec<(f64, f64, f64)>, size: f64) -> Shape {
    let (corners, ways) = (
        [(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)],
        [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)],
    );
    let mut vertices = Vec::new();
    for (nth, (x, y)) in corners.into_iter().enumerate() {
        let (came, goes) = (ways[(nth + 3) % 4], ways[nth]);
        for (back, on, bulge) in at(size) {
            vertices.push((
                x - back * came.0 + on * goes.0,
                y - back * came.1 + on * goes.1,
                bulge,
            ));
        }
    }
    closed(&vertices)
}

fn told(drawing: &Drawing) -> Vec<(Rule, Severity)> {
    let (_, findings) = analysed_under(drawing, saying_from(0.001));
    findings.iter().map(|it| (it.rule, it.severity)).collect()
}

#[test]
fn a_corner_is_that_corner_whatever_crumbs_it_is_drawn_with() {
    let role = Some(Role::Opening);
    // One for all of a contour.
    let expected = vec![(Rule::SharpCorner, Severity::Warning)];
    let quarter = (std::f64::consts::PI / 8.0).tan();
    let plain = |_| vec![(0.0, 0.0, 0.0)];
    assert_eq!(told(&square(plain, 0.0).as_polyline(role)), expected);
    type At<'a> = &'a dyn Fn(f64) -> Vec<(f64, f64, f64)>;
    let ways: [(&str, At); 5] = [
        ("doubled", &|_| vec![(0.0, 0.0, 0.0); 3]),
        ("chamfer", &|size| vec![(size, 0.0, 0.0), (0.0, size, 0.0)]),
        ("fillet", &|size| {
            vec![(size, 0.0, quarter), (0.0, size, 0.0)]
        }),
        ("hook", &|size| vec![(-size, 0.0, 0.0), (0.0, 0.0, 0.0)]),
        ("many", &|size| {
            vec![
                (size, 0.0, 0.0),
                (size / 2.0, 0.0, 0.5),
                (0.0, size / 3.0, -0.5),
                (0.0, size / 2.0, 0.0),
            ]
        }),
    ];
    for (name, at) in ways {
        for size in [1e-9, 1e-7, 1e-6, 1e-5, 3e-4, 5e-4] {
            let drawn = square(at, size);
            for shape in [drawn.begun_elsewhere(), drawn.reversed(), drawn] {
                assert_eq!(told(&shape.as_polyline(role)), expected, "{name} {size}");
                assert_eq!(
                    told(&shape.as_chain(role)),
                    expected,
                    "{name} {size} as a chain"
                );
            }
        }
    }
}

#[test]
fn a_crumb_by_itself_is_nothing_and_a_way_of_short_steps_stays_where_it_is() {
    let crumbs = [
        Geometry::Line {
            start: Point::new(2.0, 2.0),
            end: Point::new(2.0, 2.000002),
        },
        Geometry::Circle {
            center: Point::new(3.0, 2.0),
            radius: 4e-4,
        },
        Geometry::Polyline {
            closed: true,
            vertices: vec![Vertex::new(4.0, 2.0, 0.0), Vertex::new(4.0003, 2.0, 1.0)],
        },
    ];
    assert_eq!(told(&drawing_of(crumbs, Some(Role::Opening))), []);
    // Steps of 0.4 micrometres along a whole side: some of them stay, and the outline is what it was.
    let steps = (0..=1000).map(|step| (f64::from(step) * 4e-4, 0.0, 0.0));
    let round = [(0.4, 3.0, 0.0), (0.0, 3.0, 0.0)];
    let shape = closed(&steps.chain(round).collect::<Vec<_>>());
    let (analysis, _) = analysed_under(&shape.as_polyline(Some(Role::Opening)), saying_from(0.001));
    let drawing = shape.as_polyline(Some(Role::Opening));
    let outlines = analysis.outlines(&drawing);
    assert!(
        (outlines[0].twice_area - 2.4).abs() < 1e-5,
        "{}",
        outlines[0].twice_area
    );
    assert!((300..510).contains(&outlines[0].contour.segments(&drawing).count()));
}
