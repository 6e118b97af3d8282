use super::*;

/// Pieces that cross on the way through points, as `first x second`.
#[track_caller]
fn check(points: &[(f64, f64)], expected: &[&str]) {
    let point = |&(x, y): &(f64, f64)| Point::new(x, y);
    for mirrored in [false, true] {
        let mut way: Vec<Point> = points.iter().map(point).collect();
        if mirrored {
            way.iter_mut().for_each(|at| at.x = -at.x);
        }
        let pieces: Vec<Segment> = way
            .windows(2)
            .map(|pair| Segment::line(pair[0], pair[1]))
            .collect();
        let found: Vec<String> = crossings(&pieces, 0, &mut usize::MAX.clone())
            .iter()
            .map(|one| format!("{}x{}", one.first, one.second))
            .collect();
        assert_eq!(found, expected, "{points:?} mirrored: {mirrored}");
    }
}

#[test]
fn what_goes_through_crosses() {
    check(
        &[(0.0, 0.0), (1000.0, 1000.0), (0.0, 1000.0), (1000.0, 0.0)],
        &["0x2"],
    );
    // Through a joint of two blocks, and through the joints of both.
    check(
        &[
            (0.0, 0.0),
            (500.0, 500.0),
            (1000.0, 1000.0),
            (0.0, 1000.0),
            (1000.0, 0.0),
        ],
        &["0x3"],
    );
    check(
        &[
            (-900.0, -900.0),
            (-900.0, 0.0),
            (0.0, 0.0),
            (500.0, 500.0),
            (1000.0, 1000.0),
            (0.0, 1000.0),
            (500.0, 500.0),
            (1000.0, 0.0),
            (1900.0, 0.0),
            (1900.0, -900.0),
        ],
        &["2x5"],
    );
    // On one line for a while, from one side to the other.
    check(
        &[
            (0.0, 0.0),
            (3000.0, 0.0),
            (3000.0, 2000.0),
            (1000.0, 0.0),
            (500.0, 0.0),
            (200.0, -1000.0),
        ],
        &["0x2"],
    );
}

#[test]
fn what_touches_does_not() {
    check(
        &[
            (0.0, 0.0),
            (1000.0, 0.0),
            (1000.0, 1000.0),
            (500.0, 0.0),
            (0.0, 1000.0),
        ],
        &[],
    );
    check(
        &[
            (0.0, 0.0),
            (500.0, 500.0),
            (0.0, 1000.0),
            (1000.0, 1000.0),
            (500.0, 500.0),
            (1000.0, 0.0),
        ],
        &[],
    );
    check(
        &[
            (0.0, 0.0),
            (3000.0, 0.0),
            (3000.0, 2000.0),
            (1000.0, 0.0),
            (500.0, 0.0),
            (200.0, 1000.0),
        ],
        &[],
    );
    // It ends on itself.
    check(
        &[(0.0, 0.0), (1000.0, 0.0), (1000.0, 1000.0), (500.0, 0.0)],
        &[],
    );
    // A contour with lead-in and lead-out: it may be come to from both sides.
    check(
        &[
            (0.0, 0.0),
            (500.0, 500.0),
            (1000.0, 1000.0),
            (0.0, 1000.0),
            (500.0, 500.0),
            (1000.0, 0.0),
        ],
        &[],
    );
    // Lead-in and lead-out, on one way and on two.
    check(
        &[
            (-9.0, -500.0),
            (0.0, 0.0),
            (1000.0, 0.0),
            (1000.0, 1000.0),
            (-1000.0, 1000.0),
            (-1000.0, 0.0),
            (0.0, 0.0),
            (-9.0, -500.0),
        ],
        &[],
    );
    check(
        &[
            (-99.0, -500.0),
            (0.0, 0.0),
            (1000.0, 0.0),
            (1000.0, 1000.0),
            (-1000.0, 1000.0),
            (-1000.0, 0.0),
            (0.0, 0.0),
            (99.0, -500.0),
        ],
        &[],
    );
    check(
        &[
            (99.0, -500.0),
            (0.0, 0.0),
            (1000.0, 0.0),
            (1000.0, 1000.0),
            (-1000.0, 1000.0),
            (-1000.0, 0.0),
            (0.0, 0.0),
            (-99.0, -500.0),
        ],
        &[],
    );
}
