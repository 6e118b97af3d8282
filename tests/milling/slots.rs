//! Slots beside walls and beside each other: what the electrode takes of them. It is 1.1 mm wide with its gap.

use super::*;

type Points<'a> = &'a [[f64; 3]];

/// What a slot is like, what is said of it, and where it lies.
type Row<'a> = (&'a str, &'a [(Rule, Severity)], Points<'a>);

const PLATE: Points = &[
    [0.0, 0.0, 0.0],
    [20.0, 0.0, 0.0],
    [20.0, 10.0, 0.0],
    [0.0, 10.0, 0.0],
];

const ALONG: Points = &[[0.0, 0.0, 0.0], [20.0, 0.0, 0.0]];

/// What is said of slots, beside a contour of a role where there is one.
fn judged(plate: Option<Role>, slots: &[Points]) -> Vec<(Rule, Severity)> {
    let slots = slots.iter().map(|&slot| (false, slot));
    let contours: Vec<(bool, Points)> = plate
        .map(|_| (true, PLATE))
        .into_iter()
        .chain(slots)
        .collect();
    let drawing = with_role(plate.unwrap_or(Role::Both), &contours);
    let source = Source::Cad(Arc::new(drawing));
    let document = Document::new(source, Arc::new(settings(ELECTRODE)));
    let findings = document.all_findings();
    let is_error = |one: &&Finding| one.severity == Severity::Error;
    // What is an error while one draws is written by nobody.
    let errors: Vec<Rule> = findings
        .iter()
        .filter(is_error)
        .map(|one| one.rule)
        .collect();
    match generate(&document, Format::Milling, false) {
        Err(Refusal::Errors(found)) => {
            let refused: Vec<Rule> = found.iter().map(|one| one.rule).collect();
            assert_eq!(refused, errors, "{contours:?}");
        }
        made => assert_eq!(errors, [], "{contours:?}: {:?}", made.err()),
    }
    let is_of_slots =
        |one: &&Finding| [Rule::NarrowSlot, Rule::SelfIntersection].contains(&one.rule);
    let of_slots = findings.iter().filter(is_of_slots);
    of_slots.map(|one| (one.rule, one.severity)).collect()
}

#[test]
fn a_slot_keeps_off_the_walls_of_closed_contours_on_either_side() {
    let narrow = [(Rule::NarrowSlot, Severity::Error)];
    let crosses = [(Rule::SelfIntersection, Severity::Error)];
    let rows: &[Row] = &[
        (
            "along a wall outside",
            &narrow,
            &[[-2.0, 10.3, 0.0], [10.0, 10.3, 0.0], [22.0, 10.3, 0.0]],
        ),
        (
            "at half its width",
            &[],
            &[[-2.0, 10.55, 0.0], [10.0, 10.55, 0.0], [22.0, 10.55, 0.0]],
        ),
        (
            "along a wall inside",
            &narrow,
            &[[2.0, 9.9, 0.0], [18.0, 9.9, 0.0], [18.0, 5.0, 0.0]],
        ),
        (
            "one line along a wall inside",
            &narrow,
            &[[2.0, 9.9, 0.0], [18.0, 9.9, 0.0]],
        ),
        (
            "one line in its middle",
            &[],
            &[[2.0, 5.0, 0.0], [18.0, 5.0, 0.0]],
        ),
        (
            "on a wall",
            &narrow,
            &[[2.0, 10.0, 0.0], [18.0, 10.0, 0.0], [18.0, 15.0, 0.0]],
        ),
        (
            "with its end",
            &narrow,
            &[[20.3, 5.0, 0.0], [30.0, 5.0, 0.0]],
        ),
        (
            "with its end far enough",
            &[],
            &[[20.6, 5.0, 0.0], [30.0, 5.0, 0.0]],
        ),
        (
            "with its end on a wall",
            &crosses,
            &[[20.0, 5.0, 0.0], [30.0, 5.0, 0.0]],
        ),
        (
            "through a wall",
            &crosses,
            &[[5.0, 5.0, 0.0], [25.0, 5.0, 0.0], [25.0, 9.0, 0.0]],
        ),
        (
            "round a corner",
            &narrow,
            &[[19.0, -1.5, 0.0], [21.5, 1.0, 0.0], [20.2, 12.0, 0.0]],
        ),
    ];
    for (what, expected, slot) in rows {
        for role in [Role::Punch, Role::Opening] {
            assert_eq!(
                judged(Some(role), &[slot]),
                *expected,
                "{what} of a {role:?}"
            );
        }
    }
    // Nobody knows what is left of it.
    let beside: Points = &[[-2.0, 10.3, 0.0], [22.0, 10.3, 0.0]];
    let (rule, severity) = judged(Some(Role::Both), &[beside])[0];
    assert_eq!((rule, severity), (Rule::NarrowSlot, Severity::Warning));
}

#[test]
fn slots_that_meet_are_one_cavity_and_between_others_a_wall_is_left() {
    let narrow = [(Rule::NarrowSlot, Severity::Error)];
    let rows: &[Row] = &[
        (
            "side by side",
            &narrow,
            &[[0.0, 0.3, 0.0], [20.0, 0.3, 0.0]],
        ),
        (
            "side by side with a wall",
            &[],
            &[[0.0, 1.2, 0.0], [20.0, 1.2, 0.0]],
        ),
        ("a T", &[], &[[10.0, 0.0, 0.0], [10.0, 9.0, 0.0]]),
        (
            "a T that ends in the other slot",
            &[],
            &[[10.0, 0.4, 0.0], [10.0, 9.0, 0.0]],
        ),
        (
            "an end behind a thin wall",
            &narrow,
            &[[10.0, 0.9, 0.0], [10.0, 9.0, 0.0]],
        ),
        ("a cross", &[], &[[10.0, -5.0, 0.0], [10.0, 9.0, 0.0]]),
        (
            "a cross at a small angle",
            &[],
            &[[0.0, -1.0, 0.0], [20.0, 1.0, 0.0]],
        ),
        (
            "a T, and beside the slot again",
            &narrow,
            &[
                [2.0, 0.0, 0.0],
                [2.0, 3.0, 0.0],
                [6.0, 3.0, 0.0],
                [6.0, 0.8, 0.0],
                [12.0, 0.8, 0.0],
                [12.0, 5.0, 0.0],
            ],
        ),
    ];
    for (what, expected, slot) in rows {
        assert_eq!(judged(None, &[ALONG, slot]), *expected, "{what}");
    }
    // One that comes back beside itself may be meant to clear an area.
    let warned = [(Rule::NarrowSlot, Severity::Warning)];
    let back: Points = &[
        [0.0, 0.0, 0.0],
        [20.0, 0.0, 0.0],
        [20.0, 0.3, 0.0],
        [3.0, 0.3, 0.0],
    ];
    assert_eq!(judged(None, &[back]), warned);
    let steps: Points = &[
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 0.3, 0.0],
        [20.0, 0.3, 0.0],
    ];
    assert_eq!(judged(None, &[steps]), []);
    let eight: Points = &[
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 5.0, 0.0],
        [5.0, 5.0, 0.0],
        [5.0, -5.0, 0.0],
    ];
    assert_eq!(judged(None, &[eight]), []);
}
