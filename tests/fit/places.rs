//! Each corner that binds is one place, and is named as what it is.

use super::{DRAWN, document, drawing, findings, fit_of, polyline, rounded, settings};
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Vertex};
use wedm::finding::{Finding, FixKind, Place, Rule, sentence};
use wedm::geometry::Point;
use wedm::settings::Effective;

/// 20 × 10, grown by so much, with a radius at (20, 10) and ample ones elsewhere.
fn outline(by: f64, radius: f64) -> Vec<Vertex> {
    rounded(&[
        (Point::new(-by, -by), 0.5 + by),
        (Point::new(20.0 + by, -by), 0.5 + by),
        (Point::new(20.0 + by, 10.0 + by), radius),
        (Point::new(-by, 10.0 + by), 0.5 + by),
    ])
}

fn both(clearance: f64, [punch, plate]: [f64; 2]) -> Drawing {
    drawing(vec![
        polyline("PU", "2A", outline(0.0, punch)),
        polyline("PL", "2B", outline(clearance, plate)),
    ])
}

/// Half a kerf and a clearance, small radii aside.
fn drawn(half: f64, clearance: f64, more: &str) -> Effective {
    let text = DRAWN
        .replace("0.18", &format!("{:?}", 2.0 * (half - 0.01)))
        .replace("clearance = 0.01", &format!("clearance = {clearance:?}"));
    settings(&format!("{text}{more}"))
}

/// The fix of the first finding, and what is left after it.
#[track_caller]
fn fixed(drawing: &Drawing, own: &Effective) -> (FixKind, f64) {
    let found = findings(drawing, own, Rule::DoesNotFit);
    let analysis = Analysis::new(drawing, Arc::new(own.clone()));
    let fixes = analysis.fixes(drawing, &found[0]);
    let [fix] = fixes.as_slice() else {
        panic!("{fixes:?} of {:?}", found[0]);
    };
    let mut after = drawing.clone();
    after.apply(&fix.edit).expect("an edit that can be made");
    (fix.kind.clone(), fit_of(&after, own).least())
}

#[test]
fn a_corner_is_one_place_and_one_finding_on_each_part() {
    for radii in [
        [0.0, 0.0],
        [0.0, 0.02],
        [0.02, 0.04],
        [0.05, 0.07],
        [0.0, 0.13],
        [0.05, 0.2],
        [0.1, 0.25],
        [0.0, 0.3],
    ] {
        for more in [
            "",
            "[passes]\ncorrections = [0.185, 0.135]\nskim-corner = \"constant-stock\"\n",
        ] {
            let (drawing, own) = (both(0.02, radii), drawn(0.135, 0.02, more));
            let fit = fit_of(&drawing, &own);
            let places: Vec<_> = fit.spots().map(|spot| (spot.at, spot.clearance)).collect();
            assert_eq!(places.len(), 1, "{radii:?} {more}: {places:?}");
            let found = findings(&drawing, &own, Rule::DoesNotFit);
            let binds = usize::from(!fit.fits());
            assert_eq!(found.len(), 2 * binds, "{radii:?} {more}: {found:?}");
            let handle = |finding: &Finding| match finding.place {
                Place::Segment { entity, .. } => {
                    drawing.get(entity).map(|it| it.handle.to_string())
                }
                _ => None,
            };
            let mut handles: Vec<_> = found.iter().filter_map(handle).collect();
            handles.sort();
            assert_eq!(handles, ["2A", "2B"][..2 * binds], "{radii:?} {more}");
        }
    }
}

/// A wall that is too near all along is a place of its own beside the corner in which it ends.
#[test]
fn walls_that_are_too_near_are_told_beside_their_corners() {
    let own = drawn(0.135, 0.02, "");
    let right = |by: f64, radius: f64| {
        rounded(&[
            (Point::new(-0.02, -0.02), 0.52),
            (Point::new(20.0 + by, -0.02), 0.52),
            (Point::new(20.0 + by, 10.02), radius),
            (Point::new(-0.02, 10.02), 0.52),
        ])
    };
    let drawing = drawing(vec![
        polyline("PU", "2A", outline(0.0, 0.5)),
        polyline("PL", "2B", right(-0.01, 0.49)),
    ]);
    let found = findings(&drawing, &own, Rule::DoesNotFit);
    let said: Vec<String> = found.iter().map(|found| sentence(found, 1.0)).collect();
    assert!(
        said.iter().any(|said| said.contains("along a wall")),
        "{said:?}"
    );
}

/// The corner of the plate is drawn so round that its wire turns in no point: the punch is too sharp for it.
#[test]
fn a_corner_that_is_sharper_than_its_partner_is_named_and_rounded() {
    for (half, clearance, radii, said) in [
        (
            0.11,
            0.03,
            [0.0, 0.2],
            "the corner of the PUNCH is sharp beside R 0.200 mm of the PLATE",
        ),
        (
            0.135,
            0.02,
            [0.03, 0.2],
            "the corner of the PUNCH has R 0.030 mm beside R 0.200 mm of the PLATE",
        ),
        (
            0.135,
            0.02,
            [0.0, 0.25],
            "the corner of the PUNCH is sharp beside R 0.250 mm of the PLATE",
        ),
    ] {
        let (drawing, own) = (both(clearance, radii), drawn(half, clearance, ""));
        let found = findings(&drawing, &own, Rule::DoesNotFit);
        assert_eq!(found.len(), 2, "{found:?}");
        for finding in &found {
            let sentence = sentence(finding, 1.0);
            assert!(sentence.contains(said), "{sentence}");
        }
        let (kind, left) = fixed(&drawing, &own);
        let is_of_punch = matches!(&kind, FixKind::FitCornerOf { of, .. } if **of == *"PUNCH");
        assert!(is_of_punch, "{kind:?}");
        assert!(
            (0.0..0.002).contains(&left),
            "{radii:?}: {kind:?}, {left} left"
        );
    }
}

/// A plate that is round enough keeps its radius: c − z − z/k for the punch.
#[test]
fn a_partner_that_is_round_enough_stays() {
    let (drawing, own) = (both(0.02, [0.0, 0.1]), drawn(0.135, 0.02, ""));
    let (kind, left) = fixed(&drawing, &own);
    let k = f64::sqrt(2.0) - 1.0;
    let least = 0.135 - 0.02 - 0.02 / k + own.margin;
    let FixKind::FitCornerOf { of, radius } = kind else {
        panic!("{kind:?}");
    };
    assert!(
        &*of == "PUNCH" && (radius - least).abs() < 1e-5,
        "{of} {radius}"
    );
    assert!((left - k * own.margin).abs() < 1e-6, "{left}");
}

/// Every finding of a corner has the fix, and fix all makes it.
#[test]
fn each_finding_of_a_corner_has_the_fix_and_fix_all_makes_it() {
    let sharp = |by: f64, others: [f64; 3], radius: f64| {
        rounded(&[
            (Point::new(-by, -by), others[0]),
            (Point::new(20.0 + by, -by), others[1]),
            (Point::new(20.0 + by, 10.0 + by), others[2]),
            (Point::new(-by, 10.0 + by), radius),
        ])
    };
    for others in [[0.5; 3], [0.111; 3]] {
        let own = drawn(0.11, 0.03, "");
        let drawing = drawing(vec![
            polyline("PU", "2A", sharp(0.0, others, 0.0)),
            polyline("PL", "2B", sharp(0.027, others.map(|it| it + 0.016), 0.0)),
        ]);
        let found = findings(&drawing, &own, Rule::DoesNotFit);
        assert_eq!(found.len(), 2, "{found:?}");
        let analysis = Analysis::new(&drawing, Arc::new(own.clone()));
        for finding in &found {
            assert_eq!(analysis.fixes(&drawing, finding).len(), 1, "{finding:?}");
        }
        let fix = analysis.fix_all(&drawing).expect("a fix of the corner");
        let mut after = drawing.clone();
        after.apply(&fix).expect("an edit that can be made");
        assert!(fit_of(&after, &own).fits());
    }
}

/// The end of the wall at which it does not bind meets an arc, but for a rounding: the fix is of the other end.
#[test]
fn a_fix_rounds_the_corner_that_binds_and_no_other() {
    let own = drawn(0.11, 0.03, "");
    let quarter = 0.414213562373095;
    let sharp = |low: [f64; 2], high: [f64; 2], first: f64, arc: f64| {
        let ([x, y], [right, top]) = (low, high);
        let vertex = |x: f64, y: f64, bulge: f64| Vertex::new(x, y, bulge);
        vec![
            vertex(x, y + first, quarter),
            vertex(x + first, y, 0.0),
            vertex(right - arc, y, quarter),
            vertex(right, y + arc, 0.0),
            vertex(right, top - arc, quarter),
            vertex(right - arc, top, 0.0),
            vertex(x, top, 0.0),
        ]
    };
    // Written to three digits, as a drawing holds them.
    let drawing = drawing(vec![
        polyline("PU", "2A", sharp([0.0, 0.0], [20.0, 10.0], 0.111, 0.111)),
        polyline(
            "PL",
            "2B",
            sharp([-0.027, -0.027], [20.027, 10.027], 0.127, 0.111),
        ),
    ]);
    let analysis = Analysis::new(&drawing, Arc::new(own.clone()));
    let fix = analysis.fix_all(&drawing).expect("a fix of the corner");
    let mut after = drawing.clone();
    after.apply(&fix).expect("an edit that can be made");
    assert!(fit_of(&after, &own).fits());
    assert_eq!(findings(&after, &own, Rule::ShortSegment), []);
    assert_eq!(findings(&after, &own, Rule::SharpCorner), []);
}

/// A drawn pair that fits has no finding, counted or listed.
#[test]
fn what_is_counted_is_listed() {
    for radii in [[0.3, 0.32], [0.0, 0.0], [0.0, 0.3]] {
        let mut document = document(&both(0.02, radii), &drawn(0.135, 0.02, ""));
        let (found, count) = document.findings(500);
        assert_eq!(found.len(), count, "{found:?}");
    }
}

/// An arc within a larger one: what is left is the distance along the line of their centres.
#[test]
fn what_is_left_between_two_arcs_of_one_corner() {
    let k = f64::sqrt(2.0) - 1.0;
    for radius in [0.09, 0.1, 0.12, 0.15, 0.17, 0.2] {
        let (drawing, own) = (both(0.03, [radius, 0.2]), drawn(0.11, 0.03, ""));
        let fit = fit_of(&drawing, &own);
        let expected = 0.03 - k * (0.17 - radius).max(0.0);
        assert!(
            (fit.least() - expected).abs() < 2e-6,
            "{radius}: {} {expected}",
            fit.least()
        );
        let missing = usize::from(radius < 0.17);
        assert_eq!(fit.spots().count(), missing, "{radius}");
    }
}
