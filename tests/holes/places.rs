//! Where start holes lie.

use super::*;

fn mark(handle: &str, at: [f64; 2]) -> Entity {
    let (at, text) = (Point::new(at[0], at[1]), "O".to_owned());
    entity(handle, None, Geometry::Text { at, text })
}

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

/// A bore with a keyway: all of its arc is as near to the start hole in its middle, and the wire does not enter at a corner.
#[test]
fn the_way_from_a_proposed_hole_ends_at_no_corner() {
    let bore = |turn: f64| {
        let (sin, cos) = turn.to_radians().sin_cos();
        let at = |x: f64, y: f64, bulge: f64| [20.0 + x * cos - y * sin, x * sin + y * cos, bulge];
        let x = (64.0_f64 - 4.0).sqrt();
        let half = (2.0_f64 / 8.0).asin();
        let bulge = ((std::f64::consts::TAU - 2.0 * half) / 4.0).tan();
        [
            at(x, 2.0, bulge),
            at(x, -2.0, 0.0),
            at(11.0, -2.0, 0.0),
            at(11.0, 2.0, 0.0),
        ]
    };
    for turn in [0.0, 30.0, 90.0, 135.0, 180.0, 250.0] {
        for lead in ["perpendicular", "arc"] {
            let settings = settings(&format!("[program]\nstart-hole = 2\nlead = \"{lead}\"\n"));
            let drawing = drawing(vec![polygon("2A", Role::Opening, &bore(turn))]);
            let path = &planned(&drawing, &settings).paths[0];
            let cut = path.segments.iter().filter(|piece| !is_lead(piece));
            let cut: Vec<_> = cut.map(|piece| piece.geometry).collect();
            let [first, last] = [cut[0], cut[cut.len() - 1]];
            let turn_there = wedm::geometry::turn(last.end_tangent(), first.start_tangent());
            assert!(turn_there.abs() < 1e-6, "{turn} {lead}: {turn_there}");
        }
    }
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
            "leaves 0.150 mm beside contour 2A, expected the correction 0.100 mm plus 0.1 mm",
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
            "its roomiest point is 1.200 mm from the nearest contour, expected at most Ø 2.000 mm",
        )],
    );
    check(
        "[program]\nstart-hole = 2.2\n",
        slot(),
        &[(
            warning,
            "leaves 0.100 mm beside contour 2A, expected the correction",
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
