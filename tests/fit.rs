//! Punch and plate: their corrections, whether they fit, the rule, its fix, and the programs of both.

use proptest::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::document::{Document, Snapshot, Source};
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Unit, Vertex};
use wedm::finding::{Finding, Rule, Severity};
use wedm::fit::{Fit, fit};
use wedm::geometry::{Point, Vector};
use wedm::job::{self, Wanted};
use wedm::program::Format;
use wedm::settings::{Effective, from_toml};

fn settings(text: &str) -> Effective {
    let (settings, errors) = from_toml(text);
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

/// A wire and a gap that come to half a kerf, a clearance, and what is drawn.
fn pair(drawn_as: &str, half: f64, clearance: f64) -> Effective {
    let wire = 2.0 * (half - 0.01);
    settings(&format!(
        "wire-diameter = {wire:?}\ngap = 0.01\n[pair]\ndrawn-as = \"{drawn_as}\"\nclearance = {clearance:?}\n"
    ))
}

fn polyline(layer: &str, handle: &str, vertices: Vec<Vertex>) -> Entity {
    Entity {
        handle: handle.into(),
        layer: layer.into(),
        role: None,
        kind: Kind::LightPolyline,
        geometry: Geometry::Polyline {
            closed: true,
            vertices,
        },
    }
}

fn drawing(entities: Vec<Entity>) -> Drawing {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    for entity in entities {
        drawing.push(entity);
    }
    drawing
}

/// A closed polyline through corners, each with its fillet (0: sharp).
fn rounded(corners: &[(Point, f64)]) -> Vec<Vertex> {
    let count = corners.len();
    let mut vertices = Vec::new();
    for at in 0..count {
        let (corner, radius) = corners[at];
        let before = (corner - corners[(at + count - 1) % count].0).normalize();
        let behind = (corners[(at + 1) % count].0 - corner).normalize();
        let turn = (before.x * behind.y - before.y * behind.x).atan2(before.dot(&behind));
        if radius == 0.0 {
            vertices.push(Vertex::new(corner.x, corner.y, 0.0));
            continue;
        }
        let length = radius * (turn.abs() / 2.0).tan();
        let (from, to) = (corner - before * length, corner + behind * length);
        vertices.push(Vertex::new(from.x, from.y, (turn / 4.0).tan()));
        vertices.push(Vertex::new(to.x, to.y, 0.0));
    }
    vertices
}

/// A kite whose corner at (0, 0) turns by `turn` degrees, with a fillet there; the other corners are wide or amply rounded.
fn corner(turn: f64, radius: f64) -> Vec<Vertex> {
    let half = (180.0 - turn).to_radians() / 2.0;
    let (x, y) = (10.0 * half.cos(), 10.0 * half.sin());
    rounded(&[
        (Point::new(0.0, 0.0), radius),
        (Point::new(x, -y), 2.0),
        (Point::new(x + 12.0, 0.0), 2.0),
        (Point::new(x, y), 2.0),
    ])
}

/// The same corner pointing inwards: the wire of the punch runs inside of it.
fn notch(turn: f64, radius: f64) -> Vec<Vertex> {
    let half = (180.0 - turn).to_radians() / 2.0;
    let (x, y) = (10.0 * half.cos(), 10.0 * half.sin());
    rounded(&[
        (Point::new(0.0, 0.0), radius),
        (Point::new(x, -y), 2.0),
        (Point::new(-12.0, -y - 12.0), 2.0),
        (Point::new(-12.0, y + 12.0), 2.0),
        (Point::new(x, y), 2.0),
    ])
}

fn snapshot(drawing: &Drawing, settings: &Effective) -> Snapshot {
    document(drawing, settings).snapshot().expect("a drawing")
}

fn document(drawing: &Drawing, settings: &Effective) -> Document {
    let source = Source::Cad(Arc::new(drawing.clone()));
    Document::new(source, Arc::new(settings.clone()))
}

fn fit_of(drawing: &Drawing, settings: &Effective) -> Fit {
    let snapshot = snapshot(drawing, settings);
    match fit(&snapshot.drawing, &snapshot.outlines, settings, &|| true) {
        Ok(fit) => fit,
        Err(refusal) => panic!("{refusal:?}"),
    }
}

fn findings(drawing: &Drawing, settings: &Effective, rule: Rule) -> Vec<Finding> {
    let mut analysis = Analysis::new(drawing, Arc::new(settings.clone()));
    let (mut findings, _) = analysis.findings(drawing, usize::MAX);
    findings.retain(|finding| finding.rule == rule);
    findings
}

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

fn circle(radius: f64) -> Drawing {
    let geometry = Geometry::Circle {
        center: Point::new(3.0, -2.0),
        radius,
    };
    drawing(vec![Entity {
        handle: "2A".into(),
        layer: "0".into(),
        role: None,
        kind: Kind::Circle,
        geometry,
    }])
}

/// A washer Ø53 / Ø34, 2.5 thick: published sizes of punch and plate, and a stripper and a holder beside them.
#[test]
fn a_published_pair_comes_out_with_its_sizes() {
    for (drawn_as, drawn, punch, plate) in [
        ("plate", 52.63, 52.45, 52.63),
        ("punch", 34.31, 34.31, 34.49),
        ("plate", 34.49, 34.31, 34.49),
        ("punch", 52.45, 52.45, 52.63),
    ] {
        let mut own = pair(drawn_as, 0.10, 0.09);
        own.pair.stripper = Some(0.05);
        own.pair.holder = Some(0.005);
        let drawing = circle(drawn / 2.0);
        let found = fit_of(&drawing, &own);
        assert!(found.fits() && found.spots().count() == 0, "{found:?}");
        let diameter =
            |outline: &[wedm::geometry::Segment]| 2.0 * outline[0].as_arc().unwrap().radius;
        assert!(
            (diameter(&found.pairs[0].punch) - punch).abs() < 1e-9,
            "{found:?}"
        );
        assert!(
            (diameter(&found.pairs[0].plate) - plate).abs() < 1e-9,
            "{found:?}"
        );
        let snapshot = snapshot(&drawing, &own);
        let wanted = Wanted {
            format: Format::Iso,
            handles: None,
            layers: None,
            force: false,
        };
        let made = match job::pair(&snapshot, &[], &wanted, &()) {
            Ok(made) => made,
            Err(refusal) => panic!("{refusal:?}"),
        };
        let corrections: Vec<(&str, f64)> = made
            .iter()
            .map(|part| (part.part.as_str(), part.corrections[0]))
            .collect();
        let within = if drawn_as == "plate" { 0.09 } else { 0.0 };
        let expected = [
            ("punch", 0.10 - within),
            ("plate", 0.01 + within),
            ("stripper", 0.10 + within - 0.05),
            ("holder", 0.10 + within + 0.005),
        ];
        for ((part, correction), (name, wanted)) in corrections.iter().zip(expected) {
            assert_eq!(*part, name);
            assert!(
                (correction - wanted).abs() < 1e-12,
                "{drawn_as} {part} {correction} {wanted}"
            );
        }
    }
}

#[test]
fn a_clearance_above_the_correction_turns_the_wire_to_the_other_side() {
    let drawing = circle(10.0);
    let own = pair("punch", 0.10, 0.15);
    let found = fit_of(&drawing, &own);
    let radius = found.pairs[0].plate[0].as_arc().unwrap().radius;
    assert!((radius - 10.15).abs() < 1e-9 && found.fits(), "{found:?}");
    let wanted = Wanted {
        format: Format::ThreeB,
        handles: None,
        layers: None,
        force: false,
    };
    let made = job::pair(&snapshot(&drawing, &own), &[], &wanted, &())
        .ok()
        .unwrap();
    let flags: Vec<bool> = made.iter().map(|part| part.is_other_side).collect();
    assert_eq!(flags, [false, true]);
    assert!((made[1].corrections[0] - 0.05).abs() < 1e-12);
}

#[test]
fn what_is_missing_for_a_fit_is_named() {
    let check = |text: &str, expected: &str| {
        let (read, _) = from_toml(text);
        let own = Effective::of(&read);
        let refusal = job::fit(&snapshot(&circle(5.0), &own), &()).unwrap_err();
        assert!(
            refusal.sentence(1.0).contains(expected),
            "{text}: {}",
            refusal.sentence(1.0)
        );
    };
    check(
        "",
        "expected pair.drawn-as, pair.clearance, wire-diameter and gap to be set",
    );
    check(
        "gap = 0.01\n[pair]\nclearance = 0.01\ndrawn-as = \"punch\"",
        "expected wire-diameter to be set",
    );
    check(
        "wire-diameter = 0.2\n[pair]\nclearance = 0.01\ndrawn-as = \"punch\"",
        "expected gap to be set",
    );
    check(
        "wire-diameter = 0.2\ngap = 0.01\n[pair]\nclearance = 0.01",
        "expected pair.drawn-as to be set",
    );
}

#[test]
fn settings_that_contradict_each_other_are_named_at_their_key() {
    let check = |text: &str, at: &str, expected: &str| {
        let (_, errors) = from_toml(text);
        let found: Vec<_> = errors
            .iter()
            .map(|error| {
                (
                    error.range.clone().map_or("", |range| &text[range]),
                    error.message.as_str(),
                )
            })
            .collect();
        assert!(
            found
                .iter()
                .any(|(place, message)| *place == at && message.contains(expected)),
            "{text}: {found:?}"
        );
    };
    check(
        "[pair]\ndrawn-as = \"punch\"\nclearance = 0.01\n",
        "clearance",
        "expected wire-diameter and gap beside it",
    );
    check(
        "wire-diameter = 0.2\ngap = 0.01\n[pair]\nclearance = 0.01\n",
        "clearance",
        "has no pair",
    );
    check(
        "[pair]\ndrawn-as = \"plate\"\n",
        "drawn-as",
        "says nothing without pair.clearance",
    );
    check(
        "side = \"auto\"\n[pair]\ndrawn-as = \"plate\"\n",
        "drawn-as",
        "side is auto: expected both",
    );
    check(
        "[pair]\ndrawn-as = \"plate\"\n[workpieces]\nA = [\"A\"]\nB = [\"B\"]\n",
        "drawn-as",
        "expected one of the two",
    );
    check(
        "[pair]\nholder = 0.01\n",
        "holder",
        "expected pair.drawn-as beside it",
    );
    check(
        "[workpieces]\nA = [\"X\"]\nB = [\"X\"]\n",
        "workpieces",
        "the layer X is of the workpieces A and B",
    );
}

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

const DRAWN: &str = "wire-diameter = 0.18\ngap = 0.01\n[layers]\nPU = \"punch\"\nPL = \"opening\"\n[pair]\nclearance = 0.01\n[workpieces]\nPUNCH = [\"PU\"]\nPLATE = [\"PL\"]\n";

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

/// Lines of two parts whose ends are nearer to each other than the join tolerance.
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

/// A contour as points, for an independent erosion and dilation.
fn sampled(drawing: &Drawing, settings: &Effective, step: f64) -> Vec<(Point, Vector)> {
    let snapshot = snapshot(drawing, settings);
    let mut points = Vec::new();
    let segments: Vec<_> = snapshot.outlines[0]
        .contour
        .segments(drawing)
        .map(|segment| segment.geometry)
        .collect();
    for (at, segment) in segments.iter().enumerate() {
        let count = (segment.length() / step).ceil().max(2.0) as usize;
        for share in 0..count {
            let share = share as f64 / count as f64;
            let tangent = segment.tangent_at(share);
            points.push((segment.point_at(share), Vector::new(-tangent.y, tangent.x)));
        }
        // The fan of a corner.
        let next = &segments[(at + 1) % segments.len()];
        let (from, to) = (segment.end_tangent(), next.start_tangent());
        let turn = (from.x * to.y - from.y * to.x).atan2(from.dot(&to));
        let fan = (turn.abs() * 60.0).ceil() as usize;
        for step in 0..=fan {
            let angle = from.y.atan2(from.x) + turn * step as f64 / fan.max(1) as f64;
            points.push((segment.end(), Vector::new(-angle.sin(), angle.cos())));
        }
    }
    points
}

/// Points by cells, to ask for the nearest.
struct Cloud {
    cells: std::collections::HashMap<(i64, i64), Vec<Point>>,
    size: f64,
}

impl Cloud {
    fn new(points: impl Iterator<Item = Point>, size: f64) -> Cloud {
        let mut cells: std::collections::HashMap<(i64, i64), Vec<Point>> = Default::default();
        for point in points {
            cells
                .entry((
                    (point.x / size).floor() as i64,
                    (point.y / size).floor() as i64,
                ))
                .or_default()
                .push(point);
        }
        Cloud { cells, size }
    }

    /// The distance to the nearest point, where that is within a few cells.
    fn distance(&self, at: Point) -> f64 {
        let (column, row) = (
            (at.x / self.size).floor() as i64,
            (at.y / self.size).floor() as i64,
        );
        let mut least = f64::INFINITY;
        for reach in 0..40_i64 {
            if least <= (reach - 1) as f64 * self.size {
                break;
            }
            for x in -reach..=reach {
                for y in -reach..=reach {
                    if x.abs().max(y.abs()) == reach {
                        for point in self.cells.get(&(column + x, row + y)).into_iter().flatten() {
                            least = least.min((point - at).norm());
                        }
                    }
                }
            }
        }
        least
    }
}

/// Places beside a contour (to the left where `off` is above 0) that are not nearer than `least` to any point of a cloud, by sampling alone;
/// where they end, to a micrometre.
fn beside(contour: &[(Point, Vector)], cloud: &Cloud, off: f64, least: f64) -> Vec<Point> {
    let is_free = |at: Point| cloud.distance(at) >= least;
    let mut free = Vec::new();
    for (at, &(point, normal)) in contour.iter().enumerate() {
        let (next, next_normal) = contour[(at + 1) % contour.len()];
        let between = |share: f64| {
            let normal = normal + (next_normal - normal) * share;
            point + (next - point) * share + normal.try_normalize(0.0).unwrap_or(normal) * off
        };
        let is_here = is_free(between(0.0));
        if is_here {
            free.push(between(0.0));
        }
        if is_here != is_free(between(1.0)) {
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..14 {
                let middle = (low + high) / 2.0;
                if is_free(between(middle)) == is_here {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            free.push(between(if is_here { low } else { high }));
        }
    }
    free
}

/// How deep punch and plate stand in each other by sampling; below 0 where they do not.
fn depth_by_sampling(contour: &[(Point, Vector)], corrections: [f64; 2], half: f64) -> f64 {
    let walls = Cloud::new(contour.iter().map(|(point, _)| *point), 0.01);
    // Counter-clockwise: the punch's wire runs on the right, the plate's on the left.
    let ways = [-1.0, 1.0].map(|side| {
        let correction = corrections[usize::from(side > 0.0)];
        let way = beside(contour, &walls, side * correction, correction - 2e-5);
        Cloud::new(way.into_iter(), 0.01)
    });
    let mut deepest = f64::NEG_INFINITY;
    for (own, side) in [(0, -1.0), (1, 1.0)] {
        // What a wire leaves of its part lies at half a kerf from its way, and nowhere nearer.
        let off = side * (corrections[own] - half);
        for edge in beside(contour, &ways[own], off, half - 3e-5) {
            deepest = deepest.max(ways[1 - own].distance(edge) - half);
        }
    }
    deepest
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(6), ..ProptestConfig::default() })]

    /// Every misfit is found, and none invented.
    #[test]
    fn the_fit_is_that_of_erosion_and_dilation_by_sampling(
        radii in proptest::collection::vec((0.4..0.9f64, prop_oneof![2 => Just(0.0), 3 => 0.02..0.14f64]), 4..8),
        is_punch in any::<bool>(),
        half in 0.06..0.12f64,
        clearance in 0.008..0.03f64,
    ) {
        let count = radii.len();
        let corners: Vec<(Point, f64)> = radii
            .iter()
            .enumerate()
            .map(|(at, (radius, fillet))| {
                let angle = TAU * at as f64 / count as f64;
                (Point::new(radius * angle.cos(), radius * angle.sin()), *fillet)
            })
            .collect();
        let drawing = drawing(vec![polyline("0", "2A", rounded(&corners))]);
        let own = pair(if is_punch { "punch" } else { "plate" }, half, clearance);
        let errors = Analysis::new(&drawing, Arc::new(own.clone())).findings(&drawing, usize::MAX).0;
        let is_sound = errors.iter().all(|finding| finding.rule == Rule::DoesNotFit || finding.severity != Severity::Error);
        prop_assume!(is_sound);
        let snapshot = snapshot(&drawing, &own);
        let Ok(found) = fit(&drawing, &snapshot.outlines, &own, &|| true) else {
            return Err(TestCaseError::reject("no path"));
        };
        let corrections = match is_punch {
            true => [half, half - clearance],
            false => [half - clearance, half],
        };
        let contour = sampled(&drawing, &own, 0.002);
        let depth = depth_by_sampling(&contour, corrections, half);
        let left = found.least();
        if left < -1e-4 || depth > 1e-4 {
            prop_assert!((depth + left).abs() < 1.5e-4, "sampled {depth}, found {left}");
        }
    }
}
