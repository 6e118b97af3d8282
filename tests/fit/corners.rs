//! What is left between punch and plate in a corner.

use super::{corner, drawing, fit_of, notch, pair, polyline, settings};
use wedm::drawing::Vertex;

/// What is left in one corner, µm, and whether it fits.
#[track_caller]
fn check(turn: f64, radius: f64, half: f64, clearance: f64, left: f64) {
    let k = 1.0 / (turn.to_radians() / 2.0).cos() - 1.0;
    for (drawn_as, is_notch) in [
        ("punch", false),
        ("plate", true),
        ("plate", false),
        ("punch", true),
    ] {
        let vertices = match is_notch {
            true => notch(turn, radius),
            false => corner(turn, radius),
        };
        let drawing = drawing(vec![polyline("0", "2A", vertices)]);
        let found = fit_of(&drawing, &pair(drawn_as, half, clearance));
        // Where the part that is drawn has the corner that the wire rounds, its partner keeps the sharp one, grown or shrunk by z.
        let is_formula = (drawn_as == "punch") != is_notch;
        let expected = if is_formula {
            clearance - k * (half - radius - clearance)
        } else {
            clearance - k * (half - radius.max(clearance))
        };
        let expected = expected.min(clearance);
        let label = format!("{turn}° r {radius} c {half} z {clearance} {drawn_as} {is_notch}");
        assert!(
            (found.least() - expected).abs() < 2e-7,
            "{label}: {} {expected}",
            found.least()
        );
        assert_eq!(found.fits(), expected >= 0.0, "{label}");
        if is_formula && left.is_finite() {
            assert!((expected * 1e3 - left).abs() < 0.06, "{label}: {expected}");
        }
        let missing = usize::from(expected < clearance - 1e-6);
        assert_eq!(
            found.spots().count(),
            missing,
            "{label}: {:?}",
            found.pairs[0].spots
        );
        for spot in found.spots() {
            assert!(spot.at.coords.norm() < 0.5, "{label}: {spot:?}");
            assert_eq!(
                &*spot.of,
                if is_notch { "punch" } else { "plate" },
                "{label}"
            );
        }
    }
}

#[test]
fn what_is_left_in_a_corner() {
    check(90.0, 0.05, 0.10, 0.01, -6.6);
    check(90.0, 0.05, 0.10, 0.02, 7.6);
    check(60.0, 0.05, 0.15, 0.01, -3.9);
    let unseen = f64::NAN;
    check(120.0, 0.03, 0.14, 0.008, unseen);
    check(120.0, 0.30, 0.14, 0.008, unseen);
    check(30.0, 0.0, 0.20, 0.004, unseen);
    check(90.0, 0.0, 0.10, 0.02, unseen);
    check(75.0, 0.02, 0.11, 0.03, unseen);
    check(90.0, 0.091, 0.10, 0.01, unseen);
}

#[test]
fn it_fits_up_to_the_correction_of_the_formula() {
    for (turn, radius, clearance) in [
        (90.0, 0.05, 0.01),
        (60.0, 0.05, 0.01),
        (110.0, 0.02, 0.015_f64),
    ] {
        let k = 1.0 / (f64::to_radians(turn) / 2.0).cos() - 1.0;
        let limit = radius + clearance + clearance / k;
        if turn == 90.0 {
            assert!((limit - 0.0841_f64).abs() < 5e-5, "{limit}");
        }
        let drawing = drawing(vec![polyline("0", "2A", corner(turn, radius))]);
        assert!(fit_of(&drawing, &pair("punch", limit - 1e-5, clearance)).fits());
        assert!(!fit_of(&drawing, &pair("punch", limit + 1e-5, clearance)).fits());
    }
}

/// With a constant stock the last pass runs on an arc about the point in which the first one turned, c1 from both walls, and leaves
/// c1 - cn + half a kerf there.
#[test]
fn passes_with_a_constant_stock_leave_the_radius_of_the_first_in_a_corner() {
    for turn in [60.0, 90.0, 120.0] {
        for corrections in [&[0.2, 0.145][..], &[0.215, 0.17, 0.14]] {
            for (drawn_as, is_notch) in [("punch", false), ("plate", true)] {
                let vertices = match is_notch {
                    true => notch(turn, 0.0),
                    false => corner(turn, 0.0),
                };
                let drawing = drawing(vec![polyline("0", "2A", vertices)]);
                let (first, last) = (corrections[0], corrections[corrections.len() - 1]);
                let left = |skim_corner: &str| {
                    let own = settings(&format!(
                        "wire-diameter = {:?}\ngap = 0.01\n[passes]\ncorrections = {corrections:?}\n\
                         skim-corner = \"{skim_corner}\"\n[pair]\ndrawn-as = \"{drawn_as}\"\nclearance = 0.01\n",
                        2.0 * (last - 0.01)
                    ));
                    fit_of(&drawing, &own).least()
                };
                let deep = 1.0 / f64::to_radians(turn / 2.0).cos();
                // The partner is cut by the clearance nearer.
                let constant = first - last + last - (first - 0.01) * deep;
                let sharp = last - (last - 0.01) * deep;
                for (name, expected) in [("constant-stock", constant), ("sharp", sharp)] {
                    let left = left(name);
                    let label = format!("{turn}° {corrections:?} {drawn_as} {name}");
                    assert!(
                        (left - expected.min(0.01)).abs() < 1e-6,
                        "{label}: {left} {expected}"
                    );
                }
            }
        }
    }
}

/// A tall edge comes down to the first of two acute corners, goes back to the second, and on to the left side: what is drawn, half a kerf, the
/// right upper corner, the two acute ones, where the left side begins, and how deep the parts stand in each other, by sampling both beside the
/// programs that are written.
#[test]
fn parts_bind_where_an_edge_lies_folded() {
    for (drawn_as, half, [x, y], first, second, end, depth) in [
        (
            "plate",
            0.106,
            [6.99, 3.47],
            [3.01, 3.81],
            [5.24, 3.37],
            4.11,
            0.1989,
        ),
        (
            "punch",
            0.114,
            [6.81, 3.27],
            [1.65, 2.13],
            [4.85, 2.47],
            1.53,
            0.2781,
        ),
        (
            "plate",
            0.091,
            [5.29, 3.29],
            [1.18, 3.62],
            [3.45, 3.72],
            3.98,
            0.2276,
        ),
        (
            "punch",
            0.094,
            [5.45, 2.78],
            [1.57, 3.05],
            [4.19, 3.1],
            3.21,
            0.1817,
        ),
        (
            "punch",
            0.068,
            [5.19, 4.25],
            [3.22, 3.16],
            [3.56, 3.42],
            2.42,
            0.0191,
        ),
        (
            "plate",
            0.111,
            [5.09, 4.42],
            [1.39, 4.86],
            [1.78, 4.87],
            4.83,
            0.0008,
        ),
    ] {
        let corners = [[0.0, 0.0], [x, 0.0], [x, y], first, second, [0.0, end]];
        let vertices = corners.map(|[x, y]| Vertex::new(x, y, 0.0)).to_vec();
        let found = fit_of(
            &drawing(vec![polyline("0", "2A", vertices)]),
            &pair(drawn_as, half, 0.05),
        );
        assert!(
            (found.least() + depth).abs() < 1e-3,
            "{corners:?}: {}",
            found.least()
        );
        assert!(!found.fits(), "{corners:?}");
    }
}
