//! What is said of open contours.

use super::*;

#[test]
fn a_side_is_said_of_single_contours_and_says_nothing_of_closed_ones() {
    let closed = [[0.0, 20.0, 0.0], [9.0, 20.0, 0.0], [9.0, 29.0, 0.0]];
    let drawing = drawing(&[("2A", false, &STRIP), ("2B", true, &closed)]);
    assert_eq!(
        rules(&drawing, &Effective::default())[0].0,
        Rule::OpenContour
    );
    let own = settings("[contours]\n2A = \"left\"\n2B = \"punch\"\n");
    let told = rules(&drawing, &own);
    assert!(
        told.iter().all(|(rule, _)| *rule == Rule::SharpCorner),
        "{told:?}"
    );
    assert_eq!(paths(&drawing, &own).expect("paths").len(), 2);
    // Nobody knows on which side of the closed one the wire runs.
    let both = settings("side = \"left\"\n");
    let refused = paths(&drawing, &both).expect_err("no side");
    assert!(refused.sentence(1.0).contains("2B"), "{refused:?}");
    let opening = settings("side = \"opening\"\n");
    assert_eq!(rules(&drawing, &opening)[0].0, Rule::OpenContour);
}

#[test]
fn arcs_are_judged_on_the_side_of_the_wire() {
    let tight = [
        [0.0, 0.0, 0.0],
        [5.0, 0.0, 1.0],
        [5.0, 0.1, 0.0],
        [0.0, 0.1, 0.0],
    ];
    let fillet = [
        [0.0, 0.0, 0.0],
        [4.95, 0.0, (std::f64::consts::PI / 8.0).tan()],
        [5.0, 0.05, 0.0],
        [5.0, 5.0, 0.0],
    ];
    let of = |corners: Corners, side: &str| -> Vec<Rule> {
        let settings = settings(&format!("side = \"{side}\"\n"));
        let found = rules(&drawing(&[("2A", false, corners)]), &settings);
        let errors = found
            .into_iter()
            .filter(|(_, severity)| *severity == Severity::Error);
        errors.map(|(rule, _)| rule).collect()
    };
    assert_eq!(of(&fillet, "left"), [Rule::SmallRadius]);
    assert_eq!(of(&fillet, "right"), []);
    assert!(
        of(&tight, "left").contains(&Rule::NarrowSlot),
        "{:?}",
        of(&tight, "left")
    );
    assert_eq!(of(&tight, "right"), []);
    // A pocket behind a neck that the wire does not pass.
    let pocket = [
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, -5.0, 0.0],
        [20.0, -5.0, 0.0],
        [20.0, 0.0, 0.0],
        [10.15, 0.0, 0.0],
        [10.15, 3.0, 0.0],
        [30.0, 3.0, 0.0],
    ];
    let found = of(&pocket, "left");
    let lost = [Rule::NarrowSlot, Rule::LostPocket];
    assert!(found.iter().any(|rule| lost.contains(rule)), "{found:?}");
    let text = settings("side = \"left\"\n");
    assert!(paths(&drawing(&[("2A", false, &pocket)]), &text).is_err());
}

/// The wire of an open contour keeps off other contours, and theirs off it, whichever way the others face.
#[test]
fn the_path_of_an_open_contour_keeps_off_others() {
    let plate = [
        [0.0, 0.0, 0.0],
        [20.0, 0.0, 0.0],
        [20.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
    ];
    let outside = |away: f64| {
        [
            [-2.0, 10.0 + away, 0.0],
            [22.0, 10.0 + away, 0.0],
            [22.0, 15.0, 0.0],
        ]
    };
    let inside = [[2.0, 9.85, 0.0], [18.0, 9.85, 0.0], [18.0, 5.0, 0.0]];
    let end = |away: f64| [[20.0 + away, 5.0, 0.0], [30.0, 5.0, 0.0], [30.0, 8.0, 0.0]];
    // The correction is 0.1: the wire takes 0.2 on its side, and 0.1 past its ends.
    let near = outside(0.15);
    for (what, is_near, role, side, open) in [
        ("the wire beside a punch", true, "punch", "right", near),
        ("the punch's wire in the part", true, "punch", "left", near),
        ("far enough", false, "punch", "right", outside(0.25)),
        (
            "the wire in the punch, to its wall",
            true,
            "punch",
            "left",
            inside,
        ),
        (
            "the wire in the punch, away",
            false,
            "punch",
            "right",
            inside,
        ),
        ("the wire beside an opening", true, "opening", "right", near),
        ("a thin wall to an opening", false, "opening", "left", near),
        (
            "an end before an opening",
            true,
            "opening",
            "left",
            end(0.05),
        ),
        ("an end far enough", false, "opening", "left", end(0.15)),
        (
            "an end in the way of the punch's wire",
            true,
            "punch",
            "left",
            end(0.15),
        ),
    ] {
        let text = format!("[contours]\n2A = \"{side}\"\n2B = \"{role}\"\n");
        let drawing = drawing(&[("2A", false, &open), ("2B", true, &plate)]);
        let found = rules(&drawing, &settings(&text));
        let expected = (Rule::NarrowSlot, Severity::Error);
        assert_eq!(found.contains(&expected), is_near, "{what}: {found:?}");
    }
}

/// A straight line in a closed contour is drawn to be read, unless somebody says a side of it.
#[test]
fn a_line_within_a_contour_is_cut_where_a_side_is_said() {
    let plate = [
        [0.0, 0.0, 0.0],
        [20.0, 0.0, 0.0],
        [20.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
    ];
    let line = [[5.0, 5.0, 0.0], [15.0, 5.0, 0.0]];
    let drawing = drawing(&[("2A", true, &plate), ("2B", false, &line)]);
    let side = "side = \"punch\"\n";
    for (said, cut, error) in [
        ("", 1, None),
        ("[layers]\n0 = \"punch\"\n", 2, Some(Rule::OpenContour)),
        (
            "[layers]\n0 = \"left\"\n[contours]\n2A = \"punch\"\n",
            2,
            None,
        ),
        ("[contours]\n2B = \"right\"\n", 2, None),
        ("[contours]\n2B = \"both\"\n", 2, Some(Rule::OpenContour)),
    ] {
        let own = settings(&format!("{side}{said}"));
        let document = document(&drawing, &own);
        let snapshot = document.snapshot().expect("a drawing");
        assert_eq!(snapshot.outlines.len(), cut, "{said}");
        let found = rules(&drawing, &own);
        let aside = (Rule::UnsupportedEntity, Severity::Information);
        assert_eq!(found.contains(&aside), cut == 1, "{said}: {found:?}");
        let mut errors = found
            .iter()
            .filter(|(_, severity)| *severity == Severity::Error);
        assert_eq!(
            errors.next().map(|(rule, _)| *rule),
            error,
            "{said}: {found:?}"
        );
    }
}

/// A last segment that the wire does not come to is no cut; one that is shorter than what a corner leaves is said beside the program.
#[test]
fn an_end_in_a_wedge_is_lost() {
    let ends = |x: f64, y: f64| [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [x, y, 0.0]];
    let lost = Some(Rule::LostPocket);
    for (what, contour, side, error, uncut) in [
        ("a wedge", ends(5.0, 0.15), "left", lost, 0.0),
        ("its outside", ends(5.0, 0.15), "right", None, 0.0),
        (
            "a wedge at the beginning",
            {
                let mut turned = ends(5.0, 0.15);
                turned.reverse();
                turned
            },
            "right",
            lost,
            0.0,
        ),
        ("a corner", ends(10.0, 5.0), "left", None, 0.0414),
        (
            "a corner with a short end",
            ends(10.0, 0.05),
            "left",
            None,
            0.0414,
        ),
        (
            "a wedge that the wire comes into",
            ends(5.0, 3.0),
            "left",
            None,
            0.27,
        ),
    ] {
        let drawing = drawing(&[("2A", false, &contour)]);
        let own = settings(&format!("side = \"{side}\"\n"));
        let found = rules(&drawing, &own);
        let mut errors = found
            .iter()
            .filter(|(_, severity)| *severity == Severity::Error);
        assert_eq!(
            errors.next().map(|(rule, _)| *rule),
            error,
            "{what}: {found:?}"
        );
        let made = generate(&document(&drawing, &own), Format::Iso, false);
        let finished = made.ok().map(|made| made.finished.expect("what stays"));
        assert_eq!(finished.is_none(), error.is_some(), "{what}");
        if let Some(finished) = finished {
            assert!(
                (finished.uncut - uncut).abs() < 0.01,
                "{what}: {finished:?}"
            );
        }
    }
}
