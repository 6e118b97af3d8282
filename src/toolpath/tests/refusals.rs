//! Contours without a path, and paths that are cancelled.

use super::{SQUARE, at, defaults, drawing};
use crate::drawing::{Drawing, Entity, Geometry, Outline, Role};
use crate::finding::{Finding, Rule, Severity};
use crate::geometry::Point;
use crate::settings::{Compensation, Direction, Effective, Lead, PointSetting, SideSetting};
use crate::toolpath::{Refusal, plan, plan_while};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

fn check_refused(polyline: &[[f64; 3]], role: Option<Role>, settings: Effective, expected: &str) {
    let (drawing, outlines) = drawing(&[(polyline, role)]);
    assert_eq!(
        plan(&drawing, &outlines, &settings, None),
        Err(Refusal::Sentence(expected.into()))
    );
}

#[test]
fn what_cannot_be_planned_is_refused_in_a_sentence() {
    check_refused(
        SQUARE,
        Some(Role::Both),
        defaults(),
        "side of contour 1 (2A) at 0.000, 0.000 is not known: choose auto (by nesting), opening or punch",
    );
    check_refused(
        SQUARE,
        None,
        defaults(),
        "contour 1 (2A) at 0.000, 0.000 is open: the side of the wire is not known; close it, or set compensation to none to cut it as drawn",
    );
    check_refused(
        SQUARE,
        Some(Role::Opening),
        Effective {
            entry: at(5.0, 0.02),
            ..defaults()
        },
        "the entry (5, 0.02) lies 0.020 mm from contour 2A, expected a point on it",
    );
    check_refused(
        SQUARE,
        None,
        Effective {
            compensation: Compensation::None,
            entry: at(5.0, 0.0),
            ..defaults()
        },
        "contour 2A is open and cannot be entered at (5, 0), expected one of its ends",
    );
    let table = BTreeMap::from([("77".to_string(), [0.0, 0.0])]);
    check_refused(
        SQUARE,
        Some(Role::Opening),
        Effective {
            thread: Some(PointSetting::ByHandle(table)),
            ..defaults()
        },
        "there is no entity with the handle 77",
    );
    let (drawing, outlines) =
        drawing(&[(SQUARE, Some(Role::Opening)), (SQUARE, Some(Role::Opening))]);
    let settings = Effective {
        thread: at(5.0, 5.0),
        ..defaults()
    };
    let sentence = "one thread hole is given for 2 contours: choose one contour by its handle, or give a table by handle";
    assert_eq!(
        plan(&drawing, &outlines, &settings, None),
        Err(Refusal::Sentence(sentence.into()))
    );
    assert!(plan(&drawing, &outlines, &settings, Some(&["2A".to_string()])).is_ok());
}

/// On the contour, and nearer to it than the correction, there is no room for a thread hole; on the path there is no lead.
#[test]
fn a_thread_hole_on_the_contour_is_refused() {
    let (drawing, outlines) = drawing(&[(SQUARE, Some(Role::Punch))]);
    for (y, fits) in [
        (0.0, false),
        (-0.05, false),
        (-0.0985, false),
        (-0.0995, true),
        (-0.1, true),
        (-0.3, true),
    ] {
        let settings = Effective {
            thread: at(5.0, y),
            entry: at(5.0, 0.0),
            ..defaults()
        };
        let planned = plan(&drawing, &outlines, &settings, None);
        let begin = planned.as_ref().ok().map(|paths| paths[0].begin().y);
        assert_eq!(begin, fits.then_some(y.min(-0.1)), "{y}: {planned:?}");
        let is_lead_in = |findings: &[Finding]| findings.iter().all(|it| it.rule == Rule::LeadIn);
        assert!(fits || matches!(&planned, Err(Refusal::Findings(found)) if is_lead_in(found)));
    }
}

/// The longest line of a disc with a slit lies in the slit, where no arc has room: the disc is entered from outside. Where somebody
/// names the place, that is refused as before.
#[test]
fn where_no_lead_fits_another_side_is_entered() {
    const RADIUS: f64 = 5.0;
    for (width, lead) in [(0.25, Lead::Arc), (0.25, Lead::Perpendicular)] {
        let half = width / 2.0;
        let turn = TAU - 2.0 * (half / RADIUS).asin();
        let x = (RADIUS * RADIUS - half * half).sqrt();
        let disc: &[[f64; 3]] = &[
            [x, half, (turn / 4.0).tan()],
            [x, -half, 0.0],
            [-2.0, -half, 0.0],
            [-2.0, half, 0.0],
        ];
        let (drawing, outlines) = drawing(&[(disc, Some(Role::Punch))]);
        let settings = Effective { lead, ..defaults() };
        let path = plan(&drawing, &outlines, &settings, None)
            .unwrap_or_else(|refusal| panic!("{width} {lead:?}: {refusal:?}"))
            .remove(0);
        let begin = path.thread_hole - Point::origin();
        let is_within = lead == Lead::Perpendicular;
        assert_eq!(
            begin.norm() < RADIUS,
            is_within,
            "{width} {lead:?}: {begin}"
        );
        let asked = Effective {
            entry: at(1.5, half),
            ..settings
        };
        assert_eq!(plan(&drawing, &outlines, &asked, None).is_ok(), is_within);
    }
}

/// In the slit of a keyhole near the rim of a disc an arc comes in along the slit, but finds no way out past its mouth.
#[test]
fn an_arc_has_a_way_in_and_a_way_out() {
    let keyhole: &[[f64; 3]] = &[
        [4.869440, 0.301592, 32.322464518],
        [4.869440, -0.301592, 0.0],
        [3.853293, -0.301592, -8.195790205],
        [3.853293, 0.301592, 0.0],
    ];
    let (drawing, outlines) = drawing(&[(keyhole, Some(Role::Punch))]);
    let settings = Effective {
        lead: Lead::Arc,
        correction: 0.13,
        ..defaults()
    };
    let path = plan(&drawing, &outlines, &settings, None)
        .unwrap_or_else(|refusal| panic!("{refusal:?}"))
        .remove(0);
    assert!(path.thread_hole.x < -5.0, "{}", path.thread_hole);
}

#[test]
fn a_slot_narrower_than_the_wire_is_left_out_and_an_error() {
    for (width, fits) in [(0.19, false), (0.2, true), (0.201, true)] {
        let keyhole: &[[f64; 3]] = &[
            [0.0, 0.0, 0.0],
            [10.0, 0.0, 0.0],
            [10.0, 5.0, 0.0],
            [20.0, 5.0, 0.0],
            [20.0, 5.0 + width, 0.0],
            [10.0, 5.0 + width, 0.0],
            [10.0, 10.0, 0.0],
            [0.0, 10.0, 0.0],
        ];
        let (drawing, outlines) = drawing(&[(keyhole, Some(Role::Opening))]);
        for direction in [Direction::Ccw, Direction::Cw] {
            let settings = Effective {
                direction,
                ..defaults()
            };
            let path = plan(&drawing, &outlines, &settings, None)
                .expect("a path")
                .remove(0);
            let furthest = path
                .segments
                .iter()
                .map(|piece| piece.geometry.end().x)
                .fold(0.0, f64::max);
            assert_eq!(furthest > 19.0, fits, "{width}");
        }
        let settings = Effective {
            side: SideSetting::Opening,
            ..defaults()
        };
        let (findings, _) = crate::analysis::Analysis::new(&drawing, std::sync::Arc::new(settings))
            .findings(&drawing, usize::MAX);
        let told = findings
            .iter()
            .any(|finding| finding.rule == Rule::NarrowSlot && finding.severity == Severity::Error);
        assert_eq!(told, !fits, "{width} {findings:?}");
    }
}

#[test]
fn a_path_that_nobody_wants_any_more_is_given_up() {
    let (drawing, outlines) = circles(40);
    let asked = AtomicUsize::new(0);
    // Given up at each of the places where it asks, whichever comes first.
    let until = |most: usize| {
        asked.store(0, Relaxed);
        let goes_on = || asked.fetch_add(1, Relaxed) < most;
        plan_while(&drawing, &outlines, &defaults(), None, false, &goes_on)
    };
    assert!(until(usize::MAX).is_ok());
    let places = asked.load(Relaxed);
    assert!(places > 40 * 3, "{places}");
    for most in 0..places {
        assert_eq!(until(most), Err(Refusal::Cancelled), "{most} of {places}");
        // Each of the contours that are made at once may ask once more.
        let asked = asked.load(Relaxed);
        assert!(
            asked <= most + 40,
            "{asked}: nothing is done once it has said so"
        );
    }
}

/// Openings side by side.
fn circles(count: usize) -> (Drawing, Vec<Outline>) {
    let mut drawing = Drawing::new(None);
    for number in 0..count {
        let geometry = Geometry::Circle {
            center: Point::new(number as f64 * 10.0, 0.0),
            radius: 3.0,
        };
        drawing.push(Entity {
            handle: format!("{number}").into(),
            layer: "0".into(),
            role: Some(Role::Opening),
            kind: crate::drawing::Kind::Circle,
            geometry,
        });
    }
    let outlines = crate::analysis::Analysis::new(&drawing, std::sync::Arc::new(defaults()))
        .outlines(&drawing)
        .to_vec();
    (drawing, outlines)
}
