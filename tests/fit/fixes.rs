//! The fix of a contour that does not fit.

use super::{Vertex, corner, drawing, findings, fit_of, notch, pair, polyline, settings};
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::finding::{Detail, Finding, Rule, Severity};
use wedm::geometry::Point;

/// One drawn contour: one finding, at it; its fix makes it fit.
#[test]
fn one_contour_that_does_not_fit_has_one_finding_and_a_fix_that_makes_it_fit() {
    for (drawn_as, turn, radius, half, clearance) in [
        ("punch", 90.0, 0.05, 0.10, 0.01),
        ("punch", 90.0, 0.0, 0.10, 0.01),
        ("plate", 60.0, 0.0, 0.15, 0.006),
        ("plate", 110.0, 0.02, 0.12, 0.01),
        ("punch", 120.0, 0.03, 0.14, 0.008),
    ] {
        for vertices in [corner(turn, radius), notch(turn, radius)] {
            let own = pair(drawn_as, half, clearance);
            let mut drawing = drawing(vec![polyline("0", "2A", vertices)]);
            let label = format!("{drawn_as} {turn}° r {radius}");
            let found = findings(&drawing, &own, Rule::DoesNotFit);
            let [finding] = found.as_slice() else {
                panic!("{label}: {found:?}");
            };
            assert_eq!(
                (finding.severity, finding.related.len()),
                (Severity::Error, 1)
            );
            let analysis = Analysis::new(&drawing, Arc::new(own.clone()));
            let fixes = analysis.fixes(&drawing, finding);
            let [fix] = fixes.as_slice() else {
                panic!("{label}: {fixes:?}");
            };
            let mut all = drawing.clone();
            for _ in 0..12 {
                let now = Analysis::new(&all, Arc::new(own.clone()));
                let Some(edit) = now.fix_all(&all) else {
                    break;
                };
                all.apply(&edit).expect("an edit that can be made");
            }
            assert!(fit_of(&all, &own).fits(), "{label}: fix all");
            drawing.apply(&fix.edit).expect("an edit that can be made");
            let after = fit_of(&drawing, &own);
            // The least that fits, and the margin.
            let k = 1.0 / (f64::to_radians(turn) / 2.0).cos() - 1.0;
            assert!(after.fits(), "{label}: {after:?}");
            assert!(
                (after.least() - own.margin * k).abs() < 1e-6,
                "{label}: {}",
                after.least()
            );
            assert_eq!(findings(&drawing, &own, Rule::DoesNotFit), []);
            let errors = Analysis::new(&drawing, Arc::new(own.clone()))
                .findings(&drawing, usize::MAX)
                .0;
            assert!(
                errors
                    .iter()
                    .all(|finding| finding.severity != Severity::Error),
                "{label}: {errors:?}"
            );
        }
    }
}

/// Each finding names the two segments that meet in its corner, and its fix is of that corner, of several that bind alike.
#[test]
fn each_corner_of_several_has_the_fix_of_its_own() {
    let vertices = |corners: &[(f64, f64)]| -> Vec<Vertex> {
        let sharp = |&(x, y): &(f64, f64)| Vertex {
            point: Point::new(x, y),
            bulge: 0.0,
        };
        corners.iter().map(sharp).collect()
    };
    let rectangle = [(0.0, 0.0), (20.0, 0.0), (20.0, 10.0), (0.0, 10.0)];
    let angle = [
        (0.0, 0.0),
        (20.0, 0.0),
        (20.0, 8.0),
        (8.0, 8.0),
        (8.0, 20.0),
        (0.0, 20.0),
    ];
    for corners in [&rectangle[..], &angle[..], &rectangle[..3]] {
        for drawn_as in ["punch", "plate"] {
            let own = pair(drawn_as, 0.1, 0.01);
            let drawing = drawing(vec![polyline("0", "2A", vertices(corners))]);
            let found = findings(&drawing, &own, Rule::DoesNotFit);
            assert!(found.len() >= 3, "{drawn_as}: {found:?}");
            let place = |finding: &Finding| match &finding.detail {
                Detail::DoesNotFit(misfit) => misfit.at,
                other => panic!("{other:?}"),
            };
            for finding in &found {
                assert_ne!(finding.place, finding.related[0], "{finding:?}");
                let analysis = Analysis::new(&drawing, Arc::new(own.clone()));
                let fixes = analysis.fixes(&drawing, finding);
                let mut fixed = drawing.clone();
                fixed
                    .apply(&fixes[0].edit)
                    .expect("an edit that can be made");
                let left = findings(&fixed, &own, Rule::DoesNotFit);
                assert_eq!(left.len(), found.len() - 1, "{drawn_as}: {finding:?}");
                let stays = |other: &&Finding| (place(other) - place(finding)).norm() < 0.1;
                assert_eq!(left.iter().find(stays), None, "{drawn_as}: {finding:?}");
            }
        }
    }
}

/// Fix all moves a corner by no more than the correction, from the arc that is drawn there.
#[test]
fn the_move_of_a_corner_is_measured_from_its_arc() {
    for (radius, is_made) in [(0.02, true), (0.0, false)] {
        let own = pair("punch", 0.145, 0.01);
        let drawing = drawing(vec![polyline("0", "2A", corner(120.0, radius))]);
        let found = findings(&drawing, &own, Rule::DoesNotFit);
        let analysis = Analysis::new(&drawing, Arc::new(own));
        let fixes = analysis.fixes(&drawing, &found[0]);
        assert_eq!(
            (fixes.len(), fixes[0].in_fix_all),
            (1, is_made),
            "R {radius}"
        );
    }
}

/// Passes of a constant stock leave R = c1 in a corner: the least radius there is c1 - z - z/k, whether it is sharp or an arc.
#[test]
fn a_corner_of_constant_stock_has_its_fix() {
    for (passes, wire) in [
        ("[0.205, 0.165, 0.145]", 0.25),
        ("[0.17, 0.13, 0.11]", 0.18),
    ] {
        for radius in [0.0, 0.05, 0.12] {
            let own = settings(&format!(
                "wire-diameter = {wire:?}\ngap = 0.02\n[passes]\ncorrections = {passes}\nskim-corner = \"constant-stock\"\n\
                 [pair]\ndrawn-as = \"punch\"\nclearance = 0.01\n"
            ));
            let mut drawing = drawing(vec![polyline("0", "2A", corner(90.0, radius))]);
            let found = findings(&drawing, &own, Rule::DoesNotFit);
            let analysis = Analysis::new(&drawing, Arc::new(own.clone()));
            let fixes = analysis.fixes(&drawing, &found[0]);
            let label = format!("{passes} R {radius}: {fixes:?}");
            assert_eq!(fixes.len(), 1, "{label}");
            drawing
                .apply(&fixes[0].edit)
                .expect("an edit that can be made");
            let left = fit_of(&drawing, &own).least();
            let k = f64::sqrt(2.0) - 1.0;
            assert!((left - k * own.margin).abs() < 2e-6, "{label}: {left}");
        }
    }
}
