use super::super::{EllipticArc, Spline, SplineCurve};
use super::*;
use proptest::prelude::*;

fn segments(chain: &Chain) -> Vec<Segment> {
    chain
        .windows(2)
        .map(|pair| Segment::from_bulge(pair[0].0, pair[1].0, pair[0].1))
        .collect()
}

/// Dense samples of the curve lie within the tolerance of the chain, and the chain within the tolerance of the lines
/// between samples.
fn check(curve: &impl Curve, tolerance: f64) -> Result<Vec<Segment>, TestCaseError> {
    let chain = fit(curve, tolerance).unwrap_or_default();
    let fitted = segments(&chain);
    prop_assert!(!fitted.is_empty());
    let mut outline = Vec::new();
    for (piece, (from, to)) in curve.pieces().into_iter().enumerate() {
        for sample in 0..=100 {
            let (point, _) = curve.at(piece, from + (to - from) * f64::from(sample) / 100.0);
            let distance = fitted
                .iter()
                .map(|segment| segment.distance_to(point))
                .fold(f64::INFINITY, f64::min);
            prop_assert!(distance <= tolerance, "{distance} at {point}");
            outline.push(point);
        }
    }
    let longest = outline
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).norm())
        .fold(0.0, f64::max);
    for segment in &fitted {
        let middle = segment.point_at(0.5);
        let distance = outline
            .windows(2)
            .map(|pair| Segment::line(pair[0], pair[1]).distance_to(middle))
            .fold(f64::INFINITY, f64::min);
        // The lines between samples cut the curve's corners.
        prop_assert!(
            distance <= tolerance + longest * 0.2,
            "{distance} at {middle}"
        );
    }
    let ends = curve.pieces();
    prop_assert_eq!(
        fitted.first().map(|first| first.start()),
        Some(curve.at(0, ends[0].0).0)
    );
    Ok(fitted)
}

fn point() -> impl Strategy<Value = Point> {
    (-10.0..10.0f64, -10.0..10.0f64).prop_map(|(x, y)| Point::new(x, y))
}

fn vector() -> impl Strategy<Value = Vector> {
    (0.5..10.0f64, 0.0..std::f64::consts::TAU)
        .prop_map(|(length, angle)| super::super::direction(angle) * length)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn ellipses(center in point(), u in vector(), v in vector(), start in 0.0..6.0f64, sweep in 0.01..6.3f64) {
        let turn = super::super::cross(u, v).abs() / (u.norm() * v.norm());
        prop_assume!(turn > 0.1);
        let fitted = check(&EllipticArc { center, u, v, start, sweep: sweep.min(std::f64::consts::TAU) }, 1e-3)?;
        prop_assert!(fitted.len() < 400, "{}", fitted.len());
        for pair in fitted.windows(2) {
            prop_assert!(super::super::turn(pair[0].end_tangent(), pair[1].start_tangent()).abs() < 1e-6, "a kink");
        }
    }

    #[test]
    fn splines(points in prop::collection::vec(point(), 6..9), degree in 1..=5usize, weights in prop::collection::vec(0.2..3.0f64, 9)) {
        let count = points.len();
        let inner = (1..count - degree).map(|knot| knot as f64);
        let last = (count - degree) as f64;
        let knots: Vec<f64> = std::iter::repeat_n(0.0, degree + 1).chain(inner).chain(std::iter::repeat_n(last, degree + 1)).collect();
        let spline = Spline::new(degree, knots, points.clone(), weights[..count].to_vec()).unwrap();
        check(&SplineCurve::from(&spline), 1e-3)?;
    }

    #[test]
    fn splines_through_points(points in prop::collection::vec(point(), 2..8), tangent in prop::option::of(vector())) {
        let Some(spline) = Spline::through(&points, tangent, None) else { return Ok(()) };
        let fitted = check(&SplineCurve::from(&spline), 1e-3)?;
        for point in points {
            let distance = fitted.iter().map(|segment| segment.distance_to(point)).fold(f64::INFINITY, f64::min);
            prop_assert!(distance <= 1e-3, "{distance} from {point}");
        }
    }
}

#[test]
fn what_is_a_circle_or_a_line_becomes_one() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let circle: Vec<Point> = [
        (1, 0),
        (1, 1),
        (0, 1),
        (-1, 1),
        (-1, 0),
        (-1, -1),
        (0, -1),
        (1, -1),
        (1, 0),
    ]
    .map(|(x, y)| Point::new(f64::from(x) * 5.0, f64::from(y) * 5.0))
    .to_vec();
    let weights = vec![1.0, half, 1.0, half, 1.0, half, 1.0, half, 1.0];
    let knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];
    let spline = Spline::new(2, knots, circle, weights).unwrap();
    let arcs = segments(&fit(&SplineCurve::from(&spline), 1e-3).unwrap());
    assert_eq!(arcs.len(), 2);
    assert!(arcs.iter().all(|arc| {
        arc.as_arc()
            .is_some_and(|arc| (arc.radius - 5.0).abs() < 1e-9)
    }));
    let round = EllipticArc {
        center: Point::origin(),
        u: Vector::new(0.0, 2.0),
        v: Vector::new(-2.0, 0.0),
        start: 1.0,
        sweep: 1.0,
    };
    assert_eq!(segments(&fit(&round, 1e-3).unwrap()).len(), 1);
    let line = vec![
        Point::new(0.0, 0.0),
        Point::new(1.0, 1.0),
        Point::new(2.0, 2.0),
        Point::new(4.0, 4.0),
    ];
    let spline = Spline::new(
        3,
        vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0],
        line,
        Vec::new(),
    )
    .unwrap();
    assert_eq!(
        fit(&SplineCurve::from(&spline), 1e-3),
        Ok(vec![
            (Point::new(0.0, 0.0), 0.0),
            (Point::new(4.0, 4.0), 0.0)
        ])
    );
}

#[test]
fn a_curve_takes_no_more_arcs_than_its_pieces_may() {
    /// A wave of a thousand crests in one piece.
    struct Wave;
    impl Curve for Wave {
        fn pieces(&self) -> Vec<(f64, f64)> {
            vec![(0.0, 1000.0 * std::f64::consts::TAU)]
        }
        fn at(&self, _: usize, t: f64) -> (Point, Vector) {
            (Point::new(t, t.sin()), Vector::new(1.0, t.cos()))
        }
        fn extent(&self) -> f64 {
            7000.0
        }
    }
    let most = |arcs: usize| Err(Unfit::TooManyArcs(arcs));
    assert_eq!(fit(&Wave, 1e-3), most(MOST_ARCS + MOST_ARCS_OF_A_PIECE));
    // An eighth of the tolerance takes twice as many.
    assert_eq!(
        fit(&Wave, 1.25e-4),
        most(2 * (MOST_ARCS + MOST_ARCS_OF_A_PIECE))
    );
}

#[test]
fn a_round_spline_begins_at_its_first_point_however_many_there_are() {
    for count in 3..12 {
        let angle = |point: usize| 1.0 + point as f64 * std::f64::consts::TAU / count as f64;
        let points: Vec<Point> = (0..count)
            .map(|point| Point::new(3.0 * angle(point).cos(), angle(point).sin()))
            .collect();
        let spline = Spline::round(&points).unwrap();
        let curve = SplineCurve::from(&spline);
        let (from, _) = curve.pieces()[0];
        let off = (curve.at(0, from).0 - points[0]).norm();
        assert!(off < 1e-9, "{off} of {count} points");
    }
}

#[test]
fn a_curve_that_stands_still_on_its_way_has_no_tiny_pieces() {
    // Four control points in one place: a whole span of the cubic is one point.
    let points = [
        (0.0, 0.0),
        (1.0, 3.0),
        (5.0, 1.0),
        (5.0, 1.0),
        (5.0, 1.0),
        (5.0, 1.0),
        (9.0, 3.0),
        (10.0, 0.0),
    ];
    let points = points.map(|(x, y)| Point::new(x, y)).to_vec();
    let knots = [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 5.0, 5.0, 5.0].to_vec();
    let spline = Spline::new(3, knots, points, Vec::new()).unwrap();
    let fitted = segments(&fit(&SplineCurve::from(&spline), 1e-3).unwrap());
    assert!(
        fitted.len() < 200 && fitted.iter().all(|segment| segment.length() > 0.0),
        "{}",
        fitted.len()
    );
}

#[test]
fn periodic_knots_close_and_bad_numbers_are_refused() {
    let square = [
        (0.0, 0.0),
        (4.0, 0.0),
        (4.0, 4.0),
        (0.0, 4.0),
        (0.0, 0.0),
        (4.0, 0.0),
        (4.0, 4.0),
    ]
    .map(|(x, y)| Point::new(x, y));
    let spline = Spline::new(
        3,
        (0..11).map(f64::from).collect(),
        square.to_vec(),
        Vec::new(),
    )
    .unwrap();
    let chain = fit(&SplineCurve::from(&spline), 1e-3).unwrap();
    assert!((chain[0].0 - chain[chain.len() - 1].0).norm() < 1e-12);
    for (degree, knots, weights, expected) in [
        (0, 8, vec![], "has the degree 0, expected 1 to 24"),
        (7, 15, vec![], "has 7 control points, expected at least 8"),
        (
            3,
            10,
            vec![],
            "has 10 knots, expected 11 for 7 control points of degree 3",
        ),
        (3, 11, vec![1.0; 3], "has 3 weights for 7 control points"),
        (3, 11, vec![0.0; 7], "has weights of both signs, or of 0"),
    ] {
        let knots = (0..knots).map(f64::from).collect();
        assert_eq!(
            Spline::new(degree, knots, square.to_vec(), weights).unwrap_err(),
            expected
        );
    }
    let huge = EllipticArc {
        center: Point::origin(),
        u: Vector::new(1e308, 0.0),
        v: Vector::new(0.0, 1e308),
        start: 0.0,
        sweep: 6.0,
    };
    assert!(
        fit(&huge, 1e-3)
            .iter()
            .flatten()
            .all(|(point, _)| point.x.is_finite())
    );
}
