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
