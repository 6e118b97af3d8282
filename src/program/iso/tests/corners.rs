//! Words for corners that the control makes.

use super::*;

#[test]
fn corner_words_are_followed() {
    let square = |first: &str, second: &str| {
        format!(
            "G92 X0. Y0.\nG90\nG01 X10. Y0.{first}\nX10. Y10.{second}\nX0. Y10.\nX0. Y0.\nM02\n"
        )
    };
    let rounded = |i: &str| {
        format!(
            "G92 X0. Y0.\nG90\nG01 X8. Y0.\nG03 X10. Y2. {i}\nG01 X10. Y10.\nX0. Y10.\nX0. Y0.\nM02\n"
        )
    };
    for (text, meant) in [
        (square(" R2.", ""), rounded("I0. J2.")),
        (square(" ,R2.", ""), rounded("I0. J2.")),
        (square(",C2.", ""), "G92 X0. Y0.\nG90\nG01 X8. Y0.\nX10. Y2.\nX10. Y10.\nX0. Y10.\nX0. Y0.\nM02\n".into()),
        (
            square(" R2.", " R3."),
            "G92 X0. Y0.\nG90\nG01 X8. Y0.\nG03 X10. Y2. J2.\nG01 X10. Y7.\nG03 X7. Y10. I-3. J0.\nG01 X0. Y10.\nX0. Y0.\nM02\n".into(),
        ),
        ("G92 X0. Y0.\nG91\nG01 X10. R2.\n(a comment)\nY10.\nX-10.\nY-10.\nM02\n".into(), rounded("I0. J2.")),
    ] {
        assert_eq!(way(&text), way(&meant), "{text}");
        assert_eq!(faults(&text, &Effective::default()), [], "{text}");
    }
    // Between an arc and a line both foot points lie on them, and the joints are tangent.
    let text = "G92 X0. Y0.\nG90\nG03 X10. Y0. R8. ,R1.\nG01 X10. Y10.\nX0. Y10.\nX0. Y0.\nM02\n";
    let [first, corner, next, ..] = way(text)[..] else {
        panic!("{text}")
    };
    assert!(
        (corner.as_arc().unwrap().radius - 1000.0).abs() < 0.01,
        "{corner:?}"
    );
    for (one, other) in [(first, corner), (corner, next)] {
        assert!(
            (one.end_tangent() - other.start_tangent()).norm() < 1e-5
                && (one.end() - other.start()).norm() < 1e-9,
            "{text}"
        );
    }
    check(
        "G92 X0. Y0.\nG90\nG01 X10. Y0. R20.\nX10. Y10.\nX0. Y10.\nX0. Y0.\nM02\n",
        &[(3, "corner-word")],
    );
    check(
        "G92 X0. Y0.\nG90\nG01 X5. Y0. ,C2.\nX10. Y0.\nX10. Y10.\nX0. Y0.\nM02\n",
        &[(3, "corner-word")],
    );
}

/// A corner between two cuts, each of which may be an arc, at places in mm: the result keeps to both ways, is tangent
/// to both where it is round, and has its distance where it is not.
#[test]
fn corner_words_between_arcs_keep_to_both_ways() {
    // How the wire comes to (10, 0), and how it goes on from there.
    let line_in = "G01 X10. Y0.";
    let arcs_in = [
        "G02 X10. Y0. R6.",
        "G03 X10. Y0. R6.",
        "G02 X10. Y0. R20.",
        "G03 X10. Y0. R20.",
    ];
    let arcs_out = [
        "G02 X10. Y10. R6.",
        "G03 X10. Y10. R6.",
        "G02 X20. Y0. R6.",
        "G03 X20. Y0. R30.",
        "G02 X14. Y8. R9.",
        "G03 X14. Y-8. R9.",
    ];
    let line_out = "G01 X10. Y10.";
    let program = |one: &str, word: &str, other: &str| {
        format!("G92 X0. Y0.\nG90\n{one}{word}\n{other}\nM02\n")
    };
    let (mut made, mut refused) = (0, 0);
    let pairs = arcs_in
        .iter()
        .flat_map(|one| arcs_out.iter().map(move |other| (*one, *other)))
        .chain(arcs_in.iter().map(|one| (*one, line_out)))
        .chain(arcs_out.iter().map(|other| (line_in, *other)));
    for (one, other) in pairs {
        let sharp = way(&program(one, "", other));
        for radius in [0.05, 0.5, 1.0, 2.0, 4.0, 50.0] {
            let text = program(one, &format!(" ,R{radius:?}"), other);
            let found: Vec<&str> = faults(&text, &Effective::default())
                .into_iter()
                .map(|(_, rule)| rule)
                .collect();
            let own = way(&text);
            if found.contains(&"corner-word") {
                // No room: both cuts stay as they are.
                assert_eq!(own, sharp, "{text}");
                refused += 1;
                continue;
            }
            made += 1;
            let [first, corner, next] = own[..] else {
                panic!("{text}{own:?}")
            };
            let arc = corner.as_arc().unwrap_or_else(|| panic!("{text}"));
            assert!((arc.radius - radius * 1e3).abs() < 0.02, "{text}{corner:?}");
            assert!(
                arc.sweep.abs() < std::f64::consts::PI + 1e-6,
                "{text}{corner:?}"
            );
            for (short, whole) in [(first, sharp[0]), (next, sharp[1])] {
                assert!(short.length() <= whole.length() + 0.01, "{text}");
                for share in [0.0, 0.3, 0.7, 1.0] {
                    assert!(whole.distance_to(short.point_at(share)) < 0.02, "{text}");
                }
            }
            assert!((first.start() - sharp[0].start()).norm() < 1e-9, "{text}");
            assert!((next.end() - sharp[1].end()).norm() < 1e-9, "{text}");
            for (a, b) in [(first, corner), (corner, next)] {
                // Places are whole nm.
                let tangent = 2e-3 / (radius * 1e3) + 1e-5;
                assert!((a.end() - b.start()).norm() < 1e-9, "{text}");
                assert!(
                    (a.end_tangent() - b.start_tangent()).norm() < tangent,
                    "{text}{a:?}\n{b:?}"
                );
            }
        }
        // A chamfer stands between straight cuts.
        let text = program(one, ",C1.", other);
        assert!(
            faults(&text, &Effective::default())
                .iter()
                .any(|(_, rule)| *rule == "corner-word"),
            "{text}"
        );
        assert_eq!(way(&text), sharp, "{text}");
    }
    assert!(made > 80 && refused > 34, "{made} made, {refused} refused");
}

#[test]
fn corner_words_that_find_no_corner_leave_the_cuts_as_they_are() {
    for (text, is_said) in [
        // Tangent already, back on the same way, nothing after, a stop, a rapid, no length.
        ("G01 X10. Y0. ,R1.\nX20.\nM02\n", true),
        ("G01 X10. Y0. ,R1.\nG03 X20. Y10. R10.\nM02\n", true),
        ("G01 X10. Y0. ,R1.\nX0.\nM02\n", true),
        ("G01 X10. Y0. ,R1.\nM02\n", true),
        ("G01 X10. Y0. ,R1.\nM00\nG01 Y10.\nM02\n", true),
        ("G01 X10. Y0. ,R1.\nG00 Y10.\nM02\n", true),
        ("G03 X10. Y0. R6. ,R1.\nG92 X0. Y0.\nG01 Y10.\nM02\n", true),
        ("G03 X10. Y0. R6. ,R0.\nG01 Y10.\nM02\n", true),
        ("G03 X10. Y0. R6. ,R-1.\nG01 Y10.\nM02\n", true),
        ("G01 X10. Y0. ,C11.\nY10.\nM02\n", true),
        ("G01 X10. Y0.\nY10.\nM02\n", false),
    ] {
        let text = format!("G92 X0. Y0.\nG90\n{text}");
        let without = text
            .replace(" ,R-1.", "")
            .replace(" ,R1.", "")
            .replace(" ,R0.", "")
            .replace(" ,C11.", "");
        let said = faults(&text, &Effective::default())
            .iter()
            .any(|(_, rule)| *rule == "corner-word");
        assert_eq!(said, is_said, "{text}");
        assert_eq!(way(&text), way(&without), "{text}");
    }
}
