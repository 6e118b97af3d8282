//! Punch and plate that are both drawn, compared with each other.

use super::{DRAWN, circle, drawing, findings, fit_of, polyline, rounded, settings, snapshot};
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Entity, Geometry, Kind, Vertex};
use wedm::finding::{Rule, Severity, sentence};
use wedm::geometry::Point;

fn grown(x: f64, y: f64, by: f64, radius: f64) -> Vec<Vertex> {
    rounded(&[
        (Point::new(-by, -by), radius),
        (Point::new(x + by, -by), radius),
        (Point::new(x + by, y + by), radius),
        (Point::new(-by, y + by), radius),
    ])
}

#[test]
fn two_drawn_parts_are_held_against_each_other_and_meet_in_no_other_rule() {
    let own = settings(DRAWN);
    let mut drawing = drawing(vec![
        polyline("PU", "A", grown(20.0, 10.0, 0.0, 0.05)),
        polyline("PL", "B", grown(20.0, 10.0, 0.01, 0.06)),
    ]);
    // 0.1 mm of half a kerf: 10 − 0.4142 (100 − 50 − 10) µm.
    let found = fit_of(&drawing, &own);
    let expected = 0.01 - (f64::sqrt(2.0) - 1.0) * (0.1 - 0.06);
    assert!((found.least() - expected).abs() < 1e-7, "{}", found.least());
    assert_eq!((found.spots().count(), found.alone.len()), (4, 0));
    let all = Analysis::new(&drawing, Arc::new(own.clone()))
        .findings(&drawing, usize::MAX)
        .0;
    let others: Vec<_> = all
        .iter()
        .filter(|finding| !matches!(finding.rule, Rule::DoesNotFit | Rule::SmallRadius))
        .collect();
    assert!(others.is_empty(), "{others:?}");
    assert!(
        all.iter()
            .all(|finding| finding.rule != Rule::SmallRadius
                || finding.severity == Severity::Warning)
    );
    // On both, and one edit for both, until it fits.
    for left in (0..4).rev() {
        let found = findings(&drawing, &own, Rule::DoesNotFit);
        assert_eq!(found.len(), 2 * (left + 1));
        let analysis = Analysis::new(&drawing, Arc::new(own.clone()));
        let fixes = analysis.fixes(&drawing, &found[0]);
        assert_eq!(fixes.len(), 1, "{found:?}");
        drawing.apply(&fixes[0].edit).unwrap();
    }
    let after = fit_of(&drawing, &own);
    assert!(after.fits() && after.least() < 0.001, "{after:?}");
    assert_eq!(findings(&drawing, &own, Rule::DoesNotFit), []);
    // The same two in one workpiece lie too near to each other; without partners each says so.
    let alone = settings(&DRAWN.replace("clearance = 0.01", "clearance = 0.001"));
    let found = findings(&drawing, &alone, Rule::DoesNotFit);
    assert_eq!(
        found
            .iter()
            .map(|finding| finding.severity)
            .collect::<Vec<_>>(),
        [Severity::Warning; 2]
    );
    let one = settings(
        &DRAWN
            .replace("PLATE = [\"PL\"]", "")
            .replace("[\"PU\"]", "[\"PU\", \"PL\"]")
            .replace("[pair]\nclearance = 0.01\n", ""),
    );
    let mut crossing = drawing.clone();
    crossing.push(polyline("PL", "C", grown(5.0, 30.0, 0.0, 1.0)));
    assert!(!findings(&crossing, &one, Rule::SelfIntersection).is_empty());
    assert_eq!(
        findings(&crossing, &own, Rule::SelfIntersection).len(),
        findings(&crossing, &own, Rule::SelfIntersection)
            .iter()
            .filter(|finding| !finding.related.is_empty())
            .count()
    );
}

/// The stripper runs round the punch as the plate does; it is not the plate's partner. A fix of the one pair spoils no other.
#[test]
fn a_punch_has_a_partner_in_each_of_the_other_workpieces() {
    let own = settings(&DRAWN.replace("[workpieces]", "[workpieces]\nSTRIPPER = [\"ST\"]"));
    let mut drawing = drawing(vec![
        polyline("ST", "C", grown(20.0, 10.0, 0.02, 0.11)),
        polyline("PL", "B", grown(20.0, 10.0, 0.01, 0.06)),
        polyline("PU", "A", grown(20.0, 10.0, 0.0, 0.05)),
    ]);
    let found = fit_of(&drawing, &own);
    assert_eq!((found.pairs.len(), found.alone.len()), (2, 0));
    let plate = 0.01 - (f64::sqrt(2.0) - 1.0) * (0.1 - 0.06);
    assert!((found.least() - plate).abs() < 1e-7, "{}", found.least());
    while let Some(finding) = findings(&drawing, &own, Rule::DoesNotFit).first() {
        let analysis = Analysis::new(&drawing, Arc::new(own.clone()));
        let fixes = analysis.fixes(&drawing, finding);
        assert_eq!(fixes.len(), 1, "{finding:?}");
        drawing.apply(&fixes[0].edit).unwrap();
    }
    assert!(fit_of(&drawing, &own).fits());
}

/// Layers that make the inner contour an opening and the outer one a punch: that is said of both, and they are laid in each other as they lie.
#[test]
fn partners_with_each_others_roles_are_said() {
    let with = |punch: &str, plate: &str| {
        let roles = DRAWN.replace("PU = \"punch\"", &format!("PU = \"{punch}\""));
        settings(&roles.replace("PL = \"opening\"", &format!("PL = \"{plate}\"")))
    };
    let drawing = drawing(vec![
        polyline("PU", "A", grown(20.0, 10.0, 0.0, 0.5)),
        polyline("PL", "B", grown(20.0, 10.0, 0.01, 0.51)),
    ]);
    for (punch, plate, said) in [
        ("punch", "opening", 0),
        ("opening", "punch", 2),
        ("opening", "opening", 1),
        ("punch", "punch", 1),
        ("both", "both", 0),
    ] {
        let found = findings(&drawing, &with(punch, plate), Rule::DoesNotFit);
        assert_eq!(found.len(), said, "{punch} in {plate}: {found:?}");
        assert!(
            found
                .iter()
                .all(|finding| finding.severity == Severity::Warning)
        );
    }
}

/// Parts that are looser than they should be: what is left is the true distance, not the clearance that was asked for.
#[test]
fn more_than_the_clearance_is_said_as_it_is() {
    for clearance in [0.005, 0.01, 0.02] {
        // Cut twice with a correction below half the kerf: both parts lose what is missing.
        for less in [0.0, 0.002, 0.009] {
            for drawn_as in ["punch", "plate"] {
                let own = settings(&format!(
                    "wire-diameter = 0.18\ngap = 0.01\ncorrection = {:?}\n[pair]\ndrawn-as = \"{drawn_as}\"\nclearance = {clearance:?}\n",
                    0.1 - less
                ));
                let found = fit_of(&circle(7.0), &own);
                let expected = clearance + 2.0 * less;
                let label = format!("{clearance} {less} {drawn_as}: {}", found.least());
                assert!((found.least() - expected).abs() < 1e-9, "{label}");
                assert!(found.fits() && found.spots().count() == 0, "{label}");
            }
        }
        // Two drawn parts, so far from each other.
        for share in [1.0, 1.3, 2.0, 3.0, 4.9] {
            let apart: f64 = share * clearance;
            let text = DRAWN.replace("clearance = 0.01", &format!("clearance = {clearance}"));
            let own = settings(&text);
            assert_eq!(own.pair.clearance, Some(clearance), "{text}");
            let drawing = drawing(vec![
                polyline("PU", "A", grown(20.0, 10.0, 0.0, 0.3)),
                polyline("PL", "B", grown(20.0, 10.0, apart, 0.3 + apart)),
            ]);
            let found = fit_of(&drawing, &own);
            assert_eq!(found.pairs.len(), 1, "{clearance} {share}");
            assert!(
                (found.least() - apart).abs() < 1e-6,
                "{clearance} {share}: {}",
                found.least()
            );
        }
    }
}

/// Lines of two parts whose ends are nearer to each other than the join tolerance.
#[test]
fn entities_of_two_workpieces_are_not_chained_to_each_other() {
    let own = settings(&DRAWN.replace("0.01\n[workpieces]", "0.006\n[workpieces]"));
    let mut entities = Vec::new();
    for (layer, by) in [("PU", 0.0), ("PL", 0.006)] {
        let corners = [
            (-by, -by),
            (8.0 + by, -by),
            (8.0 + by, 5.0 + by),
            (-by, 5.0 + by),
        ];
        for at in 0..4 {
            let point = |(x, y): (f64, f64)| Point::new(x, y);
            entities.push(Entity {
                handle: format!("{layer}{at}").as_str().into(),
                layer: layer.into(),
                role: None,
                kind: Kind::Line,
                geometry: Geometry::Line {
                    start: point(corners[at]),
                    end: point(corners[(at + 1) % 4]),
                },
            });
        }
    }
    let drawing = drawing(entities);
    let outlines = snapshot(&drawing, &own).outlines;
    assert!(
        outlines.len() == 2
            && outlines
                .iter()
                .all(|outline| outline.contour.closed && outline.contour.pieces.len() == 4)
    );
    let found = fit_of(&drawing, &own);
    let k = f64::sqrt(2.0) - 1.0;
    assert!(
        (found.least() - (0.006 - k * (0.1 - 0.006))).abs() < 1e-7,
        "{}",
        found.least()
    );
}

/// A sharp tip of the plate in a notch of the punch that ends in an arc: it stands as deep in the punch as it is farther from the arc's centre
/// than its radius. The walls of the punch beside it stand less deep in the plate.
#[test]
fn a_tip_of_the_plate_counts_that_stands_in_a_notch_of_the_punch() {
    for (radius, clearance) in [(0.3, 0.03_f64), (0.2, 0.02), (0.25, 0.02)] {
        let own = settings(&DRAWN.replace("clearance = 0.01", &format!("clearance = {clearance}")));
        let across = clearance * f64::sqrt(2.0);
        let shape = |by: f64, tip: f64, notch: f64| {
            rounded(&[
                (Point::new(-by, -by), 1.0 + by),
                (Point::new(20.0 + by, -by), 1.0 + by),
                (Point::new(20.0 + by, 10.0 + by), 1.0 + by),
                (Point::new(12.0 + by - tip, 10.0 + by), 0.5 + by),
                (Point::new(10.0, 8.0 + tip), notch),
                (Point::new(8.0 - by + tip, 10.0 + by), 0.5 + by),
                (Point::new(-by, 10.0 + by), 1.0 + by),
            ])
        };
        let drawing = drawing(vec![
            polyline("PU", "A", shape(0.0, 0.0, radius)),
            polyline("PL", "B", shape(clearance, across, 0.0)),
        ]);
        let deep = f64::sqrt(2.0) * (radius - clearance) - radius;
        let found = fit_of(&drawing, &own).least();
        assert!(
            (found + deep).abs() < 2e-4,
            "R {radius}: {found}, expected {}",
            -deep
        );
    }
}

/// A plate whose corner arc is tighter than the correction, beside a punch: to make that arc alone larger would make the two bind, or partners no
/// longer. Whatever is repaired, they are no tighter than before, and fit where they bound.
#[test]
fn no_repair_makes_a_drawn_pair_bind_more_or_parts_it() {
    for (wire, corrections, clearance, punch, plate, comes_to_fit) in [
        (0.23, "0.225, 0.125", 0.01, 0.11, 0.12, true),
        (0.23, "0.175, 0.125", 0.01, 0.09, 0.10, true),
        (0.23, "0.175, 0.125", 0.005, 0.09, 0.095, true),
        (0.23, "0.125", 0.002, 0.09, 0.10, false),
        (0.18, "0.1", 0.01, 0.05, 0.09, false),
    ] {
        let own = settings(
            &DRAWN
                .replace("wire-diameter = 0.18", &format!("wire-diameter = {wire}"))
                .replace("clearance = 0.01", &format!("clearance = {clearance}"))
                .replace(
                    "gap = 0.01\n",
                    &format!("gap = 0.01\n[passes]\ncorrections = [{corrections}]\n"),
                ),
        );
        let with_corner = |by: f64, radius: f64| {
            rounded(&[
                (Point::new(-by, -by), 1.0 + by),
                (Point::new(20.0 + by, -by), 1.0 + by),
                (Point::new(20.0 + by, 10.0 + by), radius),
                (Point::new(-by, 10.0 + by), 1.0 + by),
            ])
        };
        let mut drawing = drawing(vec![
            polyline("PU", "A", with_corner(0.0, punch)),
            polyline("PL", "B", with_corner(clearance, plate)),
        ]);
        let label = format!("R {punch} in R {plate}, {corrections}, {clearance}");
        let before = fit_of(&drawing, &own);
        let mut rounds = 0;
        while let Some(edit) = Analysis::new(&drawing, Arc::new(own.clone())).fix_all(&drawing) {
            drawing.apply(&edit).expect("an edit that can be made");
            rounds += 1;
            assert!(rounds < 12, "{label}");
        }
        let after = fit_of(&drawing, &own);
        assert_eq!(after.pairs.len(), 1, "{label}");
        assert!(!comes_to_fit || after.fits(), "{label}: {}", after.least());
        assert!(
            after.least() >= before.least() - 1e-6,
            "{label}: {} to {}",
            before.least(),
            after.least()
        );
    }
}

/// Two arcs whose radii do not differ by the clearance bind although no wire turned there: the finding says both radii.
#[test]
fn arcs_of_radii_that_do_not_go_together_are_told_by_them() {
    let own = settings(DRAWN);
    let of = |plate: f64| {
        let drawing = drawing(vec![
            polyline("PU", "A", grown(20.0, 10.0, 0.0, 0.67)),
            polyline("PL", "B", grown(20.0, 10.0, 0.01, plate)),
        ]);
        findings(&drawing, &own, Rule::DoesNotFit)
    };
    assert_eq!(of(0.68), []);
    let found = of(0.78);
    assert_eq!(found.len(), 8);
    for finding in &found {
        let sentence = sentence(finding, 1.0);
        assert!(
            sentence.contains("R 0.670 mm") && sentence.contains("R 0.780 mm"),
            "{sentence}"
        );
    }
}
