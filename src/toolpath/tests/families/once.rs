//! Single outlines that once had a wrong path or none, and the refusals where there is none.

use super::{C, distance, unled, without_leads, wrong};
use crate::drawing::Role;
use crate::finding::{Detail, Place, Rule, Severity};
use crate::geometry::{Point, direction};
use crate::settings::{Compensation, Corner, Direction, Effective, SideSetting};
use crate::toolpath::tests::{at, defaults, drawing, samples, shown};
use crate::toolpath::{PathSegment, Refusal, plan};
use std::f64::consts::{PI, TAU};

/// Outlines that once had a wrong path or none.
#[test]
fn what_went_wrong_once() {
    let noise: &[[f64; 3]] = &[
        [106.243, 92.283, 0.0],
        [62.711, 118.832, 1.1e-16],
        [58.897, 102.747, 0.0],
        [7.195, 78.15, 0.0],
    ];
    let spike: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.974, -0.002, 0.0],
        [1.222, -0.007, 0.0],
        [1.06, -2.0, 0.0],
        [0.0, -3.0, 0.0],
    ];
    let notch: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 5.0, 0.0],
        [5.05, 5.0, 0.0],
        [5.0, 5.5, 0.0],
        [4.95, 5.0, 0.0],
        [0.0, 5.0, 0.0],
    ];
    let bowl: &[[f64; 3]] = &[
        [100.0, 40.0, 0.0],
        [0.0, 40.0, 1.0],
        [0.0, -40.0, 0.0],
        [0.0, -50.0, 0.0],
        [100.0, -50.0, 0.0],
    ];
    for (outline, role) in [
        (noise, Role::Opening),
        (spike, Role::Punch),
        (notch, Role::Opening),
        (bowl, Role::Punch),
    ] {
        for direction in [Direction::AsDrawn, Direction::Ccw, Direction::Cw] {
            for corner in [Corner::Arc, Corner::Intersection] {
                let settings = Effective {
                    corner,
                    ..unled(outline, direction)
                };
                assert_eq!(wrong(outline, role, &settings), None, "{outline:?}");
            }
        }
    }
}

/// A hole that holds just the wire's centre: it is threaded, and cuts nothing.
#[test]
fn where_the_wire_can_only_stand_it_is_threaded() {
    let side = 2.0 * C;
    let square: &[[f64; 3]] = &[
        [3.0, 0.0, 0.0],
        [3.0 + side, 0.0, 0.0],
        [3.0 + side, side, 0.0],
        [3.0, side, 0.0],
    ];
    let circle: &[[f64; 3]] = &[[3.0, C, 1.0], [3.0 + side, C, 1.0]];
    let hexagon: Vec<[f64; 3]> = (0..6)
        .map(|step| {
            let corner = direction(TAU * f64::from(step) / 6.0) * (C / (PI / 6.0).cos());
            [3.0 + C + corner.x, C + corner.y, 0.0]
        })
        .collect();
    for outline in [square, circle, &hexagon] {
        let (drawing, outlines) = drawing(&[(outline, Some(Role::Opening))]);
        let paths = plan(&drawing, &outlines, &defaults(), None).expect("a path");
        assert!(paths[0].segments.is_empty(), "{}", shown(&paths[0]));
        assert!(
            (paths[0].thread_hole - Point::new(3.0 + C, C)).norm() < 1e-6,
            "{paths:?}"
        );
        let program = crate::program::three_b::write(&paths, 1.0, &defaults()).expect("a program");
        assert_eq!((program.blocks, program.text.as_str()), (0, "DD\n"));
        let elsewhere = Effective {
            thread: at(3.05, 0.05),
            ..defaults()
        };
        assert!(
            matches!(plan(&drawing, &outlines, &elsewhere, None), Err(Refusal::Findings(found)) if found[0].rule == Rule::LeadIn)
        );
    }
}

/// A slot that is just as wide as the wire, alone: out and back once.
#[test]
fn a_slot_of_the_wire_alone_is_cut_out_and_back() {
    let slot: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [8.0, 0.0, 0.0],
        [8.0, 2.0 * C, 0.0],
        [0.0, 2.0 * C, 0.0],
    ];
    let round: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [8.0, 0.0, 1.0],
        [8.0, 2.0 * C, 0.0],
        [0.0, 2.0 * C, 1.0],
    ];
    for (outline, from, to) in [(slot, C, 8.0 - C), (round, 0.0, 8.0)] {
        let (drawing, outlines) = drawing(&[(outline, Some(Role::Opening))]);
        let path = plan(&drawing, &outlines, &defaults(), None)
            .expect("a path")
            .remove(0);
        let pieces: Vec<PathSegment> = path.segments.clone();
        let length: f64 = pieces.iter().map(|piece| piece.geometry.length()).sum();
        assert!(
            (length - 2.0 * (to - from)).abs() < 1e-6,
            "{}",
            shown(&path)
        );
        assert!(
            pieces
                .iter()
                .all(|piece| (piece.geometry.end().y - C).abs() < 1e-9),
            "{}",
            shown(&path)
        );
        assert!(crate::program::three_b::write(&[path], 1.0, &defaults()).is_ok());
    }
}

/// A crumb where two walls meet in a corner may turn the corner inside out: there is a path all the same.
#[test]
fn a_crumb_in_a_corner_leaves_a_path() {
    for size in [2e-9, 2e-8, 2e-6] {
        for step in 0..24 {
            let way = direction(TAU * (f64::from(step) + 0.37) / 24.0) * size;
            for bulge in [0.0, 0.7, -0.7] {
                let outline = [
                    [0.0, 0.0, 0.1],
                    [10.0, 4.0, bulge],
                    [10.0 + way.x, 4.0 + way.y, 0.1],
                    [0.0, 8.0, 0.0],
                ];
                for role in [Role::Opening, Role::Punch] {
                    let settings = unled(&outline, Direction::AsDrawn);
                    let (drawing, outlines) = drawing(&[(&outline, Some(role))]);
                    let plain = [outline[0], outline[2], outline[3]];
                    let judge = crate::toolpath::tests::drawing(&[(&plain, Some(role))]);
                    let expected = without_leads(
                        &plan(&judge.0, &judge.1, &settings, None).expect("a path")[0],
                    );
                    let path = match plan(&drawing, &outlines, &settings, None) {
                        Ok(paths) => without_leads(&paths[0]),
                        Err(refusal) => panic!("{size} {step} {bulge} {role:?}: {refusal:?}"),
                    };
                    let furthest = samples(&path, 0.5)
                        .into_iter()
                        .map(|point| distance(&expected, point))
                        .fold(0.0, f64::max);
                    let missing = samples(&expected, 0.5)
                        .into_iter()
                        .map(|point| distance(&path, point))
                        .fold(0.0, f64::max);
                    assert!(
                        furthest.max(missing) < 2e-4,
                        "{size} {step} {bulge} {role:?}: {furthest} {missing}"
                    );
                }
            }
        }
    }
}

/// Obstacles to a path are findings of the drawing as well; one that only lets the wire stand is a warning there.
#[test]
fn what_has_no_path_is_found_before_one_is_asked_for() {
    let side = 2.0 * C;
    let hole: &[[f64; 3]] = &[[3.0, C, 1.0], [3.0 + side, C, 1.0]];
    let slot: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [8.0, 0.0, 0.0],
        [8.0, side, 0.0],
        [0.0, side, 0.0],
    ];
    let triangle: &[[f64; 3]] = &[[0.0, 0.0, 0.0], [0.32, 0.0, 0.0], [0.16, 0.277, 0.0]];
    for (outline, expected) in [
        (hole, vec![(Rule::OffsetCollapse, Severity::Warning)]),
        (slot, vec![]),
        (triangle, vec![(Rule::OffsetCollapse, Severity::Error)]),
    ] {
        let (drawing, outlines) = drawing(&[(outline, Some(Role::Opening))]);
        let settings = Effective {
            side: SideSetting::Opening,
            ..defaults()
        };
        let mut analysis =
            crate::analysis::Analysis::new(&drawing, std::sync::Arc::new(settings.clone()));
        let (findings, count) = analysis.findings(&drawing, usize::MAX);
        assert_eq!(findings.len(), count);
        let told = findings
            .iter()
            .filter(|finding| ![Rule::SharpCorner, Rule::SmallRadius].contains(&finding.rule));
        assert_eq!(
            told.map(|finding| (finding.rule, finding.severity))
                .collect::<Vec<_>>(),
            expected
        );
        let refused = plan(&drawing, &outlines, &settings, None).is_err();
        assert_eq!(
            refused,
            expected
                .iter()
                .any(|(_, severity)| *severity == Severity::Error)
        );
    }
}

/// A contour without a path is an error at its place.
#[test]
fn a_refusal_for_the_geometry_is_an_error_at_its_place() {
    let square: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
    ];
    let bottle: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 5.0, 0.0],
        [5.05, 5.0, 0.0],
        [5.05, 6.0, 0.0],
        [8.0, 6.0, 0.0],
        [8.0, 9.0, 0.0],
        [2.0, 9.0, 0.0],
        [2.0, 6.0, 0.0],
        [4.95, 6.0, 0.0],
        [4.95, 5.0, 0.0],
        [0.0, 5.0, 0.0],
    ];
    for (outline, correction, rule) in [
        (square, 5.5, Rule::OffsetCollapse),
        (bottle, 0.1, Rule::LostPocket),
    ] {
        let (drawing, outlines) = drawing(&[(outline, Some(Role::Opening))]);
        for compensation in [Compensation::Path, Compensation::Controller] {
            let settings = Effective {
                correction,
                compensation,
                ..defaults()
            };
            match plan(&drawing, &outlines, &settings, None) {
                Err(Refusal::Findings(found)) => {
                    assert_eq!(found[0].rule, rule);
                    assert!(matches!(found[0].place, Place::Segment { .. }));
                    if let Detail::LostPocket { near } = found[0].detail {
                        assert!(near.y > 6.0, "{near:?}");
                    }
                }
                other => panic!("{other:?}"),
            }
        }
    }
}
