//! What is left between punch and plate in a corner.

use super::{corner, drawing, fit_of, notch, pair, polyline};

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
