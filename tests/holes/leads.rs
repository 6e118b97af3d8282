//! The leads from a hole to the path and back.

use super::*;

/// A program says nothing of itself when it is read again.
#[track_caller]
fn held(drawing: &Drawing, settings: &Effective, format: Format) -> String {
    let text = generated(drawing, settings, format).program.text;
    let language = format.language();
    if format != Format::FourB {
        let document = program::Document::read(language, text.clone().into(), settings);
        let (findings, _) = document.findings(settings, usize::MAX);
        assert_eq!(findings, [], "{text}");
    }
    text
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
                    wedm::analysis::work(&drawing, &outlines, &settings, &[path])
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
