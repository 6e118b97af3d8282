//! Start holes, leads and what the cuts come to on the machine.

#[path = "support/generate.rs"]
mod support;

use proptest::prelude::*;
use std::sync::Arc;
use support::generate;
use wedm::analysis::Analysis;
use wedm::document::{Document, Source as Of};
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Outline, Role, Unit, Vertex};
use wedm::finding::{Rule, Severity, sentence};
use wedm::geometry::{Point, Segment};
use wedm::job::{self, Generated};
use wedm::program::{self, Format, Language};
use wedm::settings::{Effective, from_toml};
use wedm::toolpath::{Source, WirePath};

fn settings(text: &str) -> Effective {
    let (settings, errors) = from_toml(text);
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

fn entity(handle: &str, role: Option<Role>, geometry: Geometry) -> Entity {
    Entity {
        handle: handle.into(),
        layer: "0".into(),
        role,
        kind: Kind::LightPolyline,
        geometry,
    }
}

fn polygon(handle: &str, role: Role, vertices: &[[f64; 3]]) -> Entity {
    let vertices = vertices
        .iter()
        .map(|&[x, y, bulge]| Vertex::new(x, y, bulge));
    let geometry = Geometry::Polyline {
        closed: true,
        vertices: vertices.collect(),
    };
    entity(handle, Some(role), geometry)
}

fn rectangle(handle: &str, role: Role, from: [f64; 2], to: [f64; 2]) -> Entity {
    let ([x, y], [x1, y1]) = (from, to);
    let corners = [[x, y, 0.0], [x1, y, 0.0], [x1, y1, 0.0], [x, y1, 0.0]];
    polygon(handle, role, &corners)
}

fn circle(handle: &str, role: Role, center: [f64; 2], radius: f64) -> Entity {
    let center = Point::new(center[0], center[1]);
    entity(handle, Some(role), Geometry::Circle { center, radius })
}

fn mark(handle: &str, at: [f64; 2]) -> Entity {
    let (at, text) = (Point::new(at[0], at[1]), "O".to_owned());
    entity(handle, None, Geometry::Text { at, text })
}

fn drawing(entities: Vec<Entity>) -> Drawing {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    for entity in entities {
        drawing.push(entity);
    }
    drawing
}

fn document(drawing: &Drawing, settings: &Effective) -> Document {
    Document::new(
        Of::Cad(Arc::new(drawing.clone())),
        Arc::new(settings.clone()),
    )
}

fn planned(drawing: &Drawing, settings: &Effective) -> wedm::toolpath::Planned {
    let snapshot = document(drawing, settings).snapshot().expect("a drawing");
    match job::planned(&snapshot, settings, None, false, &()) {
        Ok(planned) => planned,
        Err(refusal) => panic!("{refusal:?}"),
    }
}

fn refusal(drawing: &Drawing, settings: &Effective) -> String {
    let snapshot = document(drawing, settings).snapshot().expect("a drawing");
    let refused = job::planned(&snapshot, settings, None, false, &()).expect_err("no path");
    refused.sentence(1.0)
}

fn generated(drawing: &Drawing, settings: &Effective, format: Format) -> Generated {
    match generate(&document(drawing, settings), format, false) {
        Ok(generated) => generated,
        Err(refusal) => panic!("{format:?}: {}", refusal.sentence(1.0)),
    }
}

/// What is said of start holes, worst first.
fn said(drawing: &Drawing, settings: &Effective) -> Vec<(Severity, String)> {
    let found = document(drawing, settings).all_findings();
    let of_holes = found.iter().filter(|found| found.rule == Rule::StartHole);
    of_holes
        .map(|found| (found.severity, sentence(found, 1.0)))
        .collect()
}

/// A program says nothing of itself when it is read again.
#[track_caller]
fn held(drawing: &Drawing, settings: &Effective, format: Format) -> String {
    let text = generated(drawing, settings, format).program.text;
    let language = match format {
        Format::Iso | Format::Milling => Language::Iso,
        _ => Language::ThreeB,
    };
    if format != Format::FourB {
        let document = program::Document::read(language, text.clone().into(), settings);
        let (findings, _) = document.findings(settings, usize::MAX);
        assert_eq!(findings, [], "{text}");
    }
    text
}

fn is_lead(piece: &wedm::toolpath::PathSegment) -> bool {
    matches!(piece.source, Source::LeadIn | Source::LeadOut)
}

fn distance(
    outlines: &[Outline],
    drawing: &Drawing,
    point: Point,
    of: impl Fn(usize) -> bool,
) -> f64 {
    let chosen = outlines.iter().enumerate().filter(|(index, _)| of(*index));
    let segments = chosen.flat_map(|(_, outline)| outline.contour.segments(drawing));
    segments
        .map(|segment| segment.geometry.distance_to(point))
        .fold(f64::INFINITY, f64::min)
}

const L: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [30.0, 0.0, 0.0],
    [30.0, 10.0, 0.0],
    [12.0, 10.0, 0.0],
    [12.0, 40.0, 0.0],
    [0.0, 40.0, 0.0],
];

#[test]
fn a_start_hole_is_proposed_where_it_has_most_room() {
    let check = |text: &str, entities: Vec<Entity>, expected: [f64; 2]| {
        let (drawing, settings) = (drawing(entities), settings(text));
        let planned = planned(&drawing, &settings);
        let hole = planned.holes[0];
        let expected = Point::new(expected[0], expected[1]);
        assert!(
            (hole.at - expected).norm() < 2e-3,
            "{text}: {:?}, expected {expected}",
            hole.at
        );
        assert!(!hole.is_given);
    };
    let hole = "[program]\nstart-hole = 2\n";
    let round = circle("2A", Role::Opening, [5.0, 7.0], 4.0);
    check(hole, vec![round.clone()], [5.0, 7.0]);
    check(
        hole,
        vec![rectangle("2A", Role::Opening, [0.0, 0.0], [40.0, 20.0])],
        [20.0, 10.0],
    );
    // The largest disc in the corner of the L: it touches both outer sides and the inner corner.
    let r = 22.0 - (2.0_f64 * 12.0 * 10.0).sqrt();
    check(hole, vec![polygon("2A", Role::Opening, &L)], [r, r]);
    // A half disc of radius 10, whose arc counts: r = 5.
    let half = [[-10.0, 0.0, 0.0], [10.0, 0.0, 1.0]];
    check(hole, vec![polygon("2A", Role::Opening, &half)], [0.0, 5.0]);
    // A set lead-in is measured from the wire's path, beside the middle of the lower side.
    let lead = "correction = 0.155\n[program]\nstart-hole = 2\nlead-in = 4\n";
    let plate = |role| rectangle("2A", role, [0.0, 0.0], [40.0, 20.0]);
    check(lead, vec![plate(Role::Punch)], [20.0, -4.155]);
    check(lead, vec![plate(Role::Opening)], [20.0, 4.155]);
    // A larger hole than the lead has room for lies as far out as it needs: 4 + c + 0.1.
    check(
        "correction = 0.155\n[program]\nstart-hole = 8\n",
        vec![plate(Role::Punch)],
        [20.0, -4.255],
    );
    // An island takes room away.
    let ring = vec![
        rectangle("2A", Role::Opening, [0.0, 0.0], [40.0, 20.0]),
        rectangle("2B", Role::Punch, [15.0, 0.5], [39.5, 19.5]),
    ];
    let entry = format!("{hole}entry = {{ 2B = [15, 10] }}\n");
    let (ring, settings) = (drawing(ring), settings(&entry));
    let found = planned(&ring, &settings).holes;
    let of_opening = found.iter().find(|hole| hole.outline == 0).unwrap();
    assert!((of_opening.at.x - 7.5).abs() < 2e-3, "{of_opening:?}");
}

#[test]
fn a_hole_that_has_no_room_is_said() {
    let check = |text: &str, entities: Vec<Entity>, expected: &[(Severity, &str)]| {
        let found = said(&drawing(entities), &settings(text));
        assert_eq!(found.len(), expected.len(), "{text}: {found:?}");
        for ((severity, sentence), (expected, part)) in found.iter().zip(expected) {
            assert!(
                severity == expected && sentence.contains(part),
                "{text}: {found:?}"
            );
        }
    };
    let two = "[program]\nstart-hole = 2\n";
    let plate = || rectangle("2A", Role::Opening, [0.0, 0.0], [40.0, 20.0]);
    let (error, warning) = (Severity::Error, Severity::Warning);
    check(two, vec![plate()], &[]);
    check(two, vec![plate(), mark("3A", [20.0, 1.2])], &[]);
    check(
        two,
        vec![plate(), mark("3A", [20.0, 1.15])],
        &[(
            warning,
            "leaves 0.150 mm beside contour 2A, expected the correction 0.100 mm and 0.1 mm",
        )],
    );
    check(
        two,
        vec![plate(), mark("3A", [20.0, 0.9])],
        &[(
            error,
            "the start hole of Ø 2.000 mm at (20.000, 0.900) cuts 0.100 mm into contour 2A",
        )],
    );
    check(
        "[program]\nstart-hole = 2\nthread = [20, 0.9]\n",
        vec![plate()],
        &[(error, "cuts 0.100 mm into contour 2A")],
    );
    // Not only its own contour.
    let neighbour = rectangle("2B", Role::Punch, [10.0, 3.0], [20.0, 17.0]);
    check(
        two,
        vec![
            plate(),
            neighbour,
            mark("3A", [20.0, 1.4]),
            mark("3B", [15.0, 19.0]),
        ],
        &[(warning, "contour 2A")],
    );
    // Holes that meet; one hole of two contours does not meet itself.
    let pair = |x: f64| {
        vec![
            rectangle("2A", Role::Punch, [0.0, 0.0], [10.0, 10.0]),
            rectangle("2B", Role::Punch, [20.0, 0.0], [30.0, 10.0]),
            mark("3A", [14.5, 5.0]),
            mark("3B", [x, 5.0]),
        ]
    };
    check(
        two,
        pair(15.6),
        &[(warning, "meets that of contour 2B at (15.600, 5.000)")],
    );
    check(two, pair(16.5), &[]);
    // One larger than its opening: 2 (1.2 − 0.1 − 0.1).
    let slot = || vec![rectangle("2A", Role::Opening, [0.0, 0.0], [40.0, 2.4])];
    check(
        "[program]\nstart-hole = 3\n",
        slot(),
        &[(
            error,
            "its deepest point is 1.200 mm from the next contour, expected at most Ø 2.000 mm",
        )],
    );
    check(
        "[program]\nstart-hole = 2.2\n",
        slot(),
        &[(
            warning,
            "no start hole of Ø 2.200 mm has room in contour 2A",
        )],
    );
    check(two, slot(), &[]);
    check("", slot(), &[]);
    check(
        "[rules]\nstart-hole = \"off\"\n[program]\nstart-hole = 3\n",
        slot(),
        &[],
    );
    // A lead that is set is no room for it.
    let punch = drawing(vec![rectangle("2A", Role::Punch, [0.0, 0.0], [40.0, 20.0])]);
    let short = settings("[program]\nstart-hole = 3\nlead-in = 1\n");
    let said = refusal(&punch, &short);
    assert!(
        said.contains("expected a lead-in of 1.600 mm or more"),
        "{said}"
    );
}

#[test]
fn a_mark_on_the_parts_side_is_the_entry_beside_it() {
    let (hole, plain) = (settings("[program]\nstart-hole = 2\n"), settings(""));
    for (role, mark_at) in [
        (Role::Opening, [30.0, -1.0]),
        (Role::Punch, [30.0, 1.0]),
        (Role::Opening, [30.0, 0.05]),
    ] {
        let drawing = drawing(vec![
            rectangle("2A", role, [0.0, 0.0], [40.0, 20.0]),
            mark("3A", mark_at),
        ]);
        for settings in [&plain, &hole] {
            let planned = planned(&drawing, settings);
            let out = if role == Role::Punch { -3.0 } else { 3.0 };
            assert!(
                (planned.holes[0].at - Point::new(30.0, out)).norm() < 1e-9,
                "{:?}",
                planned.holes
            );
            assert!(!planned.holes[0].is_given);
            assert_eq!(said(&drawing, settings), []);
        }
    }
    // On the wire's side it is the hole, and the entry the nearest point.
    let drawing = drawing(vec![
        rectangle("2A", Role::Opening, [0.0, 0.0], [40.0, 20.0]),
        mark("3A", [30.0, 5.0]),
    ]);
    let hole = planned(&drawing, &hole).holes[0];
    assert_eq!((hole.at, hole.is_given), (Point::new(30.0, 5.0), true));
}

/// The lead in and the lead out of a path.
fn leads(path: &WirePath) -> [Vec<Segment>; 2] {
    [Source::LeadIn, Source::LeadOut].map(|source| {
        let own = path.segments.iter().filter(|piece| piece.source == source);
        own.map(|piece| piece.geometry).collect()
    })
}

#[test]
fn an_arc_leads_tangent_to_the_path_and_clear_of_the_part() {
    let entities = [
        (Role::Opening, circle("2A", Role::Opening, [0.0, 0.0], 6.0)),
        (
            Role::Opening,
            rectangle("2A", Role::Opening, [0.0, 0.0], [40.0, 20.0]),
        ),
        (
            Role::Punch,
            rectangle("2A", Role::Punch, [0.0, 0.0], [40.0, 20.0]),
        ),
    ];
    for (role, entity) in entities {
        for (compensation, inside) in [("path", 0.0), ("controller", 0.1)] {
            for direction in ["ccw", "cw"] {
                let settings = settings(&format!(
                    "[program]\nlead = \"arc\"\ndirection = \"{direction}\"\ncompensation = \"{compensation}\"\n"
                ));
                let drawing = drawing(vec![entity.clone()]);
                let outlines = Analysis::new(&drawing, Arc::new(settings.clone()))
                    .outlines(&drawing)
                    .clone();
                let path = planned(&drawing, &settings).paths.remove(0);
                for lead in leads(&path) {
                    let [a, b] = &lead[..] else {
                        panic!("{role:?} {compensation}: {lead:?}")
                    };
                    let arc = a.as_arc().or(b.as_arc()).expect("an arc");
                    assert!(a.as_arc().is_none() != b.as_arc().is_none());
                    assert!((arc.radius - inside) >= 0.1 - 1e-9, "{}", arc.radius);
                    // As the wire goes: the control lets it run inside of the arc by the correction.
                    let wire = |share: f64| {
                        let along = arc.point_at(share);
                        along + (arc.center - along).normalize() * inside
                    };
                    for step in 0..=32 {
                        let away =
                            distance(&outlines, &drawing, wire(f64::from(step) / 32.0), |_| true);
                        assert!(
                            away > 0.1 - 1e-6,
                            "{role:?} {compensation} {direction}: {away}"
                        );
                    }
                }
                for pair in path.segments.windows(2) {
                    let turn = wedm::geometry::turn(
                        pair[0].geometry.end_tangent(),
                        pair[1].geometry.start_tangent(),
                    );
                    assert!(
                        !is_lead(&pair[0]) && !is_lead(&pair[1]) || turn.abs() < 1e-6,
                        "{role:?} {compensation}: {turn}"
                    );
                }
                assert!(
                    wedm::toolpath::work(&drawing, &outlines, &settings, &[path])
                        .lead_angle
                        .unwrap()
                        < 1e-6
                );
                held(&drawing, &settings, Format::Iso);
                if compensation == "path" {
                    held(&drawing, &settings, Format::ThreeB);
                }
                if compensation == "controller" && role != Role::Opening {
                    held(&drawing, &settings, Format::FourB);
                }
            }
        }
    }
}

#[test]
fn a_control_is_switched_on_and_off_on_the_straight_piece_before_an_arc() {
    let text = "[program]\nlead = \"arc\"\ncompensation = \"controller\"\n";
    let drawing = drawing(vec![circle("2A", Role::Opening, [0.0, 0.0], 6.0)]);
    let program = held(&drawing, &settings(text), Format::Iso);
    let lines: Vec<&str> = program.lines().collect();
    for (at, line) in lines.iter().enumerate() {
        if line.starts_with("G41") || line.starts_with("G40") {
            assert!(lines[at + 1].starts_with("G01"), "{program}");
        }
    }
    assert!(
        lines.iter().any(|line| line.starts_with("G41")),
        "{program}"
    );
}

#[test]
fn a_lead_from_a_hole_aside_has_a_corner_or_goes_straight() {
    let plate = || {
        drawing(vec![rectangle(
            "2A",
            Role::Opening,
            [0.0, 0.0],
            [40.0, 20.0],
        )])
    };
    let check = |lead: &str, expected: &[[f64; 2]]| {
        let settings = settings(&format!(
            "[program]\nthread = [30, 10]\nentry = [20, 0]\nlead-in = 3\nlead = \"{lead}\"\n"
        ));
        let path = planned(&plate(), &settings).paths.remove(0);
        let [way_in, way_out] = leads(&path);
        let ends: Vec<[f64; 2]> = way_in.iter().map(|piece| piece.end().into()).collect();
        assert_eq!(ends.len(), expected.len(), "{lead}: {ends:?}");
        for (found, expected) in ends.iter().zip(expected) {
            assert!(
                (found[0] - expected[0]).abs() + (found[1] - expected[1]).abs() < 1e-9,
                "{lead}: {ends:?}"
            );
        }
        assert_eq!(way_out.len(), way_in.len());
        assert_eq!(
            (path.begin(), path.end()),
            (Point::new(30.0, 10.0), Point::new(30.0, 10.0))
        );
        held(&plate(), &settings, Format::ThreeB);
    };
    check("straight", &[[20.0, 0.1]]);
    check("perpendicular", &[[20.0, 3.1], [20.0, 0.1]]);
}

#[test]
fn an_arc_that_finds_no_room_is_an_error() {
    let slot = drawing(vec![rectangle(
        "2A",
        Role::Opening,
        [0.0, 0.0],
        [40.0, 0.25],
    )]);
    let said = refusal(&slot, &settings("[program]\nlead = \"arc\"\n"));
    assert!(
        said.contains("with an arc of R 0.100 mm or more fits"),
        "{said}"
    );
    let said = refusal(
        &slot,
        &settings("[program]\nlead = \"arc\"\nthread = [20, 0.125]\n"),
    );
    assert!(
        said.contains("no arc of R 0.100 mm or more leads from the thread hole"),
        "{said}"
    );
}

#[test]
fn the_way_between_two_contours_is_no_cut() {
    let both = || {
        drawing(vec![
            circle("2A", Role::Opening, [0.0, 0.0], 5.0),
            circle("2B", Role::Opening, [100.0, 0.0], 5.0),
        ])
    };
    let settings = settings("");
    let round = 2.0 * (std::f64::consts::TAU * 4.9 + 2.0 * 4.9);
    for format in [Format::ThreeB, Format::Iso] {
        let made = generated(&both(), &settings, format);
        assert!(
            (made.program.length - round).abs() < 0.01,
            "{format:?}: {}",
            made.program.length
        );
        assert!((made.work.length - round).abs() < 1e-6);
        assert!((made.work.jumps - 100.0).abs() < 1e-9);
    }
}

#[test]
fn the_cut_takes_its_length_by_its_rate() {
    // 66.428 mm of path: a circle of that circumference about the correction, without a lead.
    let radius = 66.428 / std::f64::consts::TAU;
    let punch = drawing(vec![circle("2A", Role::Punch, [0.0, 0.0], radius - 0.1)]);
    let text = "[passes]\nrates = [100]\n[job]\nthickness = 40\nmachine-rate = 60\n[program]\nthread = [10.4723, 0]\nentry = [10.4723, 0]\n";
    let made = generated(&punch, &settings(text), Format::ThreeB);
    let minutes = made.work.minutes.expect("all is set");
    assert!(
        (made.work.length - 66.428).abs() < 2e-3 && (minutes - 26.57).abs() < 2e-3,
        "{:?}",
        made.work
    );
    assert!((made.work.cost.unwrap() - minutes).abs() < 1e-9);
    assert_eq!(made.work.missing, ["gap"]);
    // What is not set is named, and nothing is guessed.
    let bare = generated(&punch, &settings(""), Format::ThreeB).work;
    assert_eq!(
        (bare.minutes, bare.cost, bare.largest_wire),
        (None, None, None)
    );
    assert_eq!(
        bare.missing,
        ["job.thickness", "passes.rates", "job.machine-rate", "gap"]
    );
}

#[test]
fn each_pass_has_its_own_rate_and_each_opening_its_slug() {
    let text = "wire-diameter = 0.25\ngap = 0.015\n[passes]\ncorrections = [0.2, 0.14]\nrates = [100, 200]\n[job]\nthickness = 40\n";
    let plate = drawing(vec![rectangle(
        "2A",
        Role::Opening,
        [0.0, 0.0],
        [40.0, 20.0],
    )]);
    let work = generated(&plate, &settings(text), Format::Iso).work;
    assert_eq!(work.cuts.len(), 2);
    for (cut, rate) in work.cuts.iter().zip([100.0, 200.0]) {
        assert!((cut.minutes.unwrap() - cut.length * 40.0 / rate).abs() < 1e-9);
    }
    // 7.85 g/cm³ × 8 cm² × 4 cm.
    assert!(
        (work.slugs[0].mass - 251.2).abs() < 1e-9,
        "{:?}",
        work.slugs
    );
}

#[test]
fn the_smallest_radius_names_the_largest_wire() {
    let fillet = (std::f64::consts::PI / 8.0).tan();
    let rounded = |role| {
        drawing(vec![polygon(
            "2A",
            role,
            &[
                [0.0, 0.0, 0.0],
                [9.8, 0.0, fillet],
                [10.0, 0.2, 0.0],
                [10.0, 10.0, 0.0],
                [0.0, 10.0, 0.0],
            ],
        )])
    };
    let check = |role, text: &str, expected: Option<f64>| {
        let (drawing, settings) = (rounded(role), settings(text));
        let outlines = Analysis::new(&drawing, Arc::new(settings.clone()))
            .outlines(&drawing)
            .clone();
        let found = wedm::toolpath::largest_wire(&drawing, &outlines, &settings, &|_| true);
        let diameter = found.map(|found| (found.diameter * 1e6).round() / 1e6);
        assert_eq!(diameter, expected, "{text}");
    };
    check(Role::Opening, "gap = 0.02\n", Some(0.36));
    check(Role::Both, "gap = 0.02\n", Some(0.36));
    check(
        Role::Opening,
        "[passes]\ncorrections = [0.2, 0.14]\ngaps = [0.03, 0.01]\n",
        Some(0.38),
    );
    // The wire runs outside of it.
    check(Role::Punch, "gap = 0.02\n", None);
    check(Role::Opening, "", None);
}

#[test]
fn a_contour_may_have_a_tab_of_its_own() {
    let both = drawing(vec![
        rectangle("2A", Role::Punch, [0.0, 0.0], [40.0, 20.0]),
        rectangle("2B", Role::Punch, [60.0, 0.0], [90.0, 20.0]),
        rectangle("2C", Role::Punch, [120.0, 0.0], [140.0, 20.0]),
    ]);
    let paths = planned(&both, &settings("[program]\ntab = { 2A = 5, 2C = 3 }\n")).paths;
    let tabs: Vec<(usize, f64)> = paths
        .iter()
        .filter(|path| path.cut_off)
        .map(|path| {
            let own = path
                .segments
                .iter()
                .filter(|piece| matches!(piece.source, Source::Segment { .. }));
            (
                path.outline,
                own.map(|piece| piece.geometry.length()).sum::<f64>(),
            )
        })
        .collect();
    let [(0, a), (2, c)] = tabs[..] else {
        panic!("{tabs:?}")
    };
    assert!((a - 5.0).abs() < 1e-9 && (c - 3.0).abs() < 1e-9, "{tabs:?}");
}

#[test]
fn a_tab_of_a_contour_that_is_not_there_is_said() {
    let punch = drawing(vec![rectangle("2A", Role::Punch, [0.0, 0.0], [40.0, 20.0])]);
    let said = refusal(&punch, &settings("[program]\ntab = { 2Z = 5 }\n"));
    assert_eq!(said, "there is no entity with the handle 2Z");
}

/// The way from the first on, each time to the nearest that is left.
fn nearest_next(points: &[Point]) -> f64 {
    let (mut at, mut left, mut way) = (points[0], points[1..].to_vec(), 0.0);
    while !left.is_empty() {
        let away = |point: &Point| (point - at).norm();
        let next = (0..left.len()).min_by(|&a, &b| away(&left[a]).total_cmp(&away(&left[b])));
        let next = left.remove(next.unwrap());
        way += (next - at).norm();
        at = next;
    }
    way
}

#[test]
fn nearest_goes_from_hole_to_hole_and_to_the_contour_round_them_last() {
    // Two rows of seven, drawn to and fro between the rows.
    let centers: Vec<[f64; 2]> = (0..14)
        .map(|at| [f64::from(at / 2) * 15.0, f64::from(at % 2) * 60.0])
        .collect();
    let mut entities = vec![rectangle("1F", Role::Punch, [-20.0, -20.0], [110.0, 80.0])];
    entities.extend(
        centers
            .iter()
            .enumerate()
            .map(|(at, &center)| circle(&format!("{:X}", at + 48), Role::Opening, center, 4.0)),
    );
    let drawing = drawing(entities);
    let jumps = |order: &str| {
        let settings = settings(&format!("[program]\norder = \"{order}\"\n"));
        let planned = planned(&drawing, &settings);
        assert_eq!(planned.paths.last().unwrap().outline, 0, "{order}");
        let holes = &planned.paths[..14];
        holes
            .windows(2)
            .map(|pair| (pair[1].begin() - pair[0].end()).norm())
            .sum::<f64>()
    };
    let to_and_fro = 7.0 * 60.0 + 6.0 * 60.0_f64.hypot(15.0);
    assert!((jumps("as-drawn") - to_and_fro).abs() < 1e-9);
    // Along one row and back along the other: 12 × 15 + 60.
    assert!((jumps("nearest") - 240.0).abs() < 1e-9);
    // As the handles are given, whatever lies where.
    let picked: Vec<String> = ["31", "30", "3D"].map(str::to_owned).to_vec();
    let as_picked = settings("[program]\norder = \"as-picked\"\n");
    let snapshot = document(&drawing, &as_picked).snapshot().unwrap();
    let paths = job::planned(&snapshot, &as_picked, Some(&picked), false, &())
        .unwrap()
        .paths;
    let order: Vec<usize> = paths.iter().map(|path| path.outline).collect();
    assert_eq!(order, [2, 1, 14]);
}

/// A plate of a grid of holes and slots, none nearer to another than 3 mm.
fn plate() -> impl Strategy<Value = Vec<Entity>> {
    let cell = (0..3_usize, 1.0..4.0_f64, 1.0..4.0_f64, -0.9..0.9_f64);
    prop::collection::vec(cell, 1..9).prop_map(|cells| {
        let place = |number: usize| [(number % 3) as f64 * 12.0, (number / 3) as f64 * 12.0];
        let one = |(number, (kind, a, b, bulge)): (usize, (usize, f64, f64, f64))| {
            let ([x, y], handle) = (place(number), format!("{:X}", number + 16));
            match kind {
                0 => circle(&handle, Role::Opening, [x, y], a),
                1 => rectangle(&handle, Role::Opening, [x - a, y - b], [x + a, y + b]),
                _ => polygon(
                    &handle,
                    Role::Opening,
                    &[
                        [x - a, y - b, 0.0],
                        [x + a, y - b, bulge.abs()],
                        [x + a, y + b, 0.0],
                        [x - a, y + b, 0.3],
                    ],
                ),
            }
        };
        cells.into_iter().enumerate().map(one).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// The jumps of `nearest` are those of going each time to the nearest hole that is left.
    #[test]
    fn nearest_is_nearest_next(places in prop::collection::vec((0..9_i32, 0..9_i32, 0.0..2.0_f64, 0.0..2.0_f64), 2..14)) {
        let mut seen = std::collections::BTreeSet::new();
        let places: Vec<[f64; 2]> = places
            .iter()
            .filter(|(x, y, ..)| seen.insert((*x, *y)))
            .map(|&(x, y, dx, dy)| [f64::from(x) * 12.0 + dx, f64::from(y) * 12.0 + dy])
            .collect();
        let circles = places.iter().enumerate().map(|(at, &center)| circle(&format!("{:X}", at + 48), Role::Opening, center, 3.0));
        let drawing = drawing(circles.collect());
        let settings = settings("[program]\norder = \"nearest\"\n");
        let planned = planned(&drawing, &settings);
        let points: Vec<Point> = places.iter().map(|&at| at.into()).collect();
        let jumps: f64 = planned.paths.windows(2).map(|pair| (pair[1].begin() - pair[0].end()).norm()).sum();
        prop_assert!((jumps - nearest_next(&points)).abs() < 1e-6, "{jumps}");
    }

    /// A hole that is proposed and of which nothing is said keeps its distance from everything, lies as deep as any point of a fine grid, and
    /// no lead comes nearer to another contour than the correction.
    #[test]
    fn proposed_holes_keep_clear_of_everything(
        entities in plate(),
        diameter in 0.5..4.0_f64,
        correction in 0.05..0.3_f64,
        lead in prop::sample::select(vec!["straight", "perpendicular", "arc"]),
    ) {
        let drawing = drawing(entities);
        let settings = settings(&format!(
            "correction = {correction}\n[program]\nstart-hole = {diameter}\nlead = \"{lead}\"\n"
        ));
        let snapshot = document(&drawing, &settings).snapshot().unwrap();
        let outlines = &snapshot.outlines;
        let any_said = !said(&drawing, &settings).is_empty();
        let Ok(planned) = job::planned(&snapshot, &settings, None, false, &()) else {
            // No arc of the correction has room beside the hole.
            prop_assert!(lead == "arc" || any_said || document(&drawing, &settings).all_findings().iter().any(|one| one.severity == Severity::Error));
            return Ok(());
        };
        for hole in &planned.holes {
            let away = distance(outlines, &drawing, hole.at, |_| true);
            prop_assert!(any_said || away >= diameter / 2.0 + correction + 0.1 - 1e-3, "{away} of {diameter}");
            for step in 0..64 {
                let (x, y) = (f64::from(step % 8) / 7.0, f64::from(step / 8) / 7.0);
                let point = Point::new(
                    hole.at.x - 5.0 + 10.0 * x,
                    hole.at.y - 5.0 + 10.0 * y,
                );
                let angle = {
                    let segments = outlines[hole.outline].contour.segments(&drawing);
                    let points: Vec<Point> = segments.flat_map(|segment| (0..16).map(move |at| segment.geometry.point_at(f64::from(at) / 16.0))).collect();
                    let around = points.iter().zip(points.iter().cycle().skip(1));
                    around.map(|(a, b)| wedm::geometry::turn(a - point, b - point)).sum::<f64>()
                };
                if angle.abs() > 3.0 {
                    prop_assert!(distance(outlines, &drawing, point, |_| true) <= away + 8e-3);
                }
            }
        }
        for path in &planned.paths {
            for piece in path.segments.iter().filter(|piece| is_lead(piece)) {
                for step in 0..=16 {
                    let point = piece.geometry.point_at(f64::from(step) / 16.0);
                    prop_assert!(distance(outlines, &drawing, point, |_| true) > correction - 1e-6);
                }
            }
        }
    }
}
