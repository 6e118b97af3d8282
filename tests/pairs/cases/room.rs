//! Walls that leave too little room.

use super::*;

fn check_slots(name: &str, entities: &[Geometry], role: Role, expected: &[(f64, Severity)]) {
    let (_, _, findings) = found(entities, role, Rule::NarrowSlot);
    let told = |finding: &Finding| match finding.detail {
        Detail::NarrowSlot { width, .. } => ((width * 1e6).round() / 1e6, finding.severity),
        _ => panic!("{finding:?}"),
    };
    assert_eq!(
        findings.iter().map(told).collect::<Vec<_>>(),
        expected,
        "{name} as {role:?}"
    );
}

#[test]
fn walls_leave_too_little_room() {
    use Role::{Both, Opening, Punch};
    let (error, warning) = (Severity::Error, Severity::Warning);
    // An opening with a slot of 0.15 in its upper side, and one with a tongue of 0.15.
    let slot = ring(&[
        [0., 0.],
        [6., 0.],
        [6., 4.],
        [3.15, 4.],
        [3.15, 7.],
        [3., 7.],
        [3., 4.],
        [0., 4.],
    ]);
    let tongue = ring(&[
        [0., 0.],
        [6., 0.],
        [6., 4.],
        [3.15, 4.],
        [3.15, 1.],
        [3., 1.],
        [3., 4.],
        [0., 4.],
    ]);
    // The opening of an open contour is no slot; what lies across it is.
    check_slots(
        "an outline that is not quite closed",
        &[open(&[[0., 0.], [4., 0.], [4., 4.], [0., 4.], [0., 0.05]])],
        Opening,
        &[],
    );
    check_slots(
        "ends of two contours",
        &[open(&[[0., 0.], [4., 0.]]), open(&[[4.05, 0.], [9., 0.]])],
        Opening,
        &[(0.05, warning)],
    );
    check_slots(
        "slot",
        std::slice::from_ref(&slot),
        Opening,
        &[(0.15, error)],
    );
    check_slots("slot", std::slice::from_ref(&slot), Punch, &[]);
    check_slots(
        "slot",
        std::slice::from_ref(&slot),
        Both,
        &[(0.15, warning)],
    );
    check_slots("tongue", std::slice::from_ref(&tongue), Opening, &[]);
    check_slots("tongue", &[tongue], Punch, &[(0.15, error)]);
    let wide = ring(&[
        [0., 0.],
        [6., 0.],
        [6., 4.],
        [3.2, 4.],
        [3.2, 7.],
        [3., 7.],
        [3., 4.],
        [0., 4.],
    ]);
    check_slots("as wide as the wire needs", &[wide], Both, &[]);
    let split = ring(&[
        [0., 0.],
        [6., 0.],
        [6., 4.],
        [3.15, 4.],
        [3.15, 5.],
        [3.15, 5.5],
        [3.15, 7.],
        [3., 7.],
        [3., 6.2],
        [3., 5.2],
        [3., 4.],
        [0., 4.],
    ]);
    check_slots(
        "a slot with walls of many lines is one slot",
        &[split],
        Opening,
        &[(0.15, error)],
    );
    let round = closed(&[
        [0., 0., 0.],
        [6., 0., 0.],
        [6., 4., 0.],
        [3.15, 4., 0.],
        [3.15, 7., 1.],
        [3., 7., 0.],
        [3., 4., 0.],
        [0., 4., 0.],
    ]);
    check_slots("with a round end", &[round], Opening, &[(0.15, error)]);
    let waist = ring(&[
        [0., 0.],
        [4., 1.9],
        [8., 0.],
        [8., 4.],
        [4., 2.05],
        [0., 4.],
    ]);
    check_slots(
        "two corners that face each other",
        &[waist],
        Opening,
        &[(0.15, error)],
    );
    let nose = ring(&[[0., 0.], [8., 0.], [8., 4.], [4., 0.12], [0., 4.]]);
    check_slots("a corner before a wall", &[nose], Opening, &[(0.12, error)]);
    let bumps = closed(&[
        [0., 0., 0.],
        [3., 0., -1.],
        [5., 0., 0.],
        [8., 0., 0.],
        [8., 2.1, 0.],
        [5., 2.1, -1.],
        [3., 2.1, 0.],
        [0., 2.1, 0.],
    ]);
    check_slots("two noses", &[bumps], Opening, &[(0.1, error)]);
    let keyhole = |bulge| {
        closed(&[
            [0., 0., 0.],
            [6., 0., 0.],
            [6., 4., 0.],
            [3.08, 4., bulge],
            [2.92, 4., 0.],
            [0., 4., 0.],
        ])
    };
    check_slots(
        "a bulb with a narrow mouth",
        &[keyhole(3.0)],
        Opening,
        &[(0.16, error)],
    );
    check_slots(
        "the mouth of a tight arc is small-radius",
        &[keyhole(1.5)],
        Opening,
        &[],
    );
    let wedge = ring(&[[0., 0.], [6., 0.], [0., 1.]]);
    check_slots("a corner is no slot", &[wedge], Both, &[]);
    let rounded = closed(&[
        [0., 0., 0.],
        [6., 0., (FRAC_PI_2 / 4.).tan()],
        [6.05, 0.05, 0.],
        [6.05, 4., 0.],
        [0., 4., 0.],
    ]);
    check_slots("a tight fillet is no slot", &[rounded], Both, &[]);
    let notch = closed(&[
        [0., 0., 0.],
        [3., 0., -0.9],
        [3.1, 0., 0.],
        [6., 0., 0.],
        [6., 4., 0.],
        [0., 4., 0.],
    ]);
    check_slots("a tight notch is no slot", &[notch], Both, &[]);
    check_slots(
        "a ring of 0.15",
        &[circle([0., 0.], 3.), circle([0., 0.], 2.85)],
        Both,
        &[(0.15, warning)],
    );
    check_slots(
        "two circles",
        &[circle([0., 0.], 3.), circle([5.15, 0.], 2.)],
        Punch,
        &[(0.15, error)],
    );
    check_slots(
        "two circles",
        &[circle([0., 0.], 3.), circle([5.15, 0.], 2.)],
        Opening,
        &[],
    );
    check_slots(
        "with something between",
        &[
            circle([0., 0.], 3.),
            circle([5.15, 0.], 2.),
            circle([3.07, 0.], 0.02),
        ],
        Punch,
        &[(0.05, error), (0.06, error)],
    );
    let octagon: Vec<[f64; 2]> = (0..8)
        .map(|k| f64::from(k) * PI / 4.)
        .map(|angle| [0.08 * angle.cos(), 0.08 * angle.sin()])
        .collect();
    check_slots(
        "a small hole of eight sides is one",
        &[ring(&octagon)],
        Opening,
        &[(0.147821, error)],
    );
    let saw: Vec<[f64; 2]> = (0..20)
        .flat_map(|k| [[f64::from(k) * 0.1, 0.], [f64::from(k) * 0.1 + 0.05, 0.05]])
        .collect();
    check_slots(
        "a saw has no slots",
        &[ring(&[&saw[..], &[[2., 3.], [0., 3.]]].concat())],
        Both,
        &[],
    );
}

fn check_lost(name: &str, entities: &[Geometry], role: Role, rule: Rule, expected: &[[f64; 2]]) {
    let (_, _, findings) = found(entities, role, rule);
    let told = |finding: &Finding| match finding.detail {
        Detail::LostPocket { near } => [near.x.round(), near.y.round()],
        Detail::OffsetCollapse { required, .. } => [required, required],
        _ => panic!("{finding:?}"),
    };
    assert_eq!(
        findings.iter().map(told).collect::<Vec<_>>(),
        expected,
        "{name} as {role:?}"
    );
}

#[test]
fn offsets_lose_pockets_or_all() {
    use Role::{Both, Opening, Punch};
    // A chamber of 6 × 4 and one of 3 × 3 behind a neck of 0.15.
    let bottle = |neck: f64| {
        let (left, right) = (3.0 - neck / 2.0, 3.0 + neck / 2.0);
        ring(&[
            [0., 0.],
            [6., 0.],
            [6., 4.],
            [right, 4.],
            [right, 5.],
            [4.5, 5.],
            [4.5, 8.],
            [1.5, 8.],
            [1.5, 5.],
            [left, 5.],
            [left, 4.],
            [0., 4.],
        ])
    };
    let pocket = |role, neck: f64| found(&[bottle(neck)], role, Rule::LostPocket).2.len();
    assert_eq!(
        [
            pocket(Opening, 0.15),
            pocket(Opening, 0.25),
            pocket(Punch, 0.15),
            pocket(Both, 0.15)
        ],
        [1, 0, 0, 0]
    );
    let (_, _, findings) = found(&[bottle(0.15)], Opening, Rule::LostPocket);
    assert!(
        matches!(findings[0].detail, Detail::LostPocket { near } if near.y > 5.0 && near.y < 8.0),
        "{findings:?}"
    );
    // A punch with a bay behind a narrow mouth.
    let bay = ring(&[
        [0., 0.],
        [6., 0.],
        [6., 6.],
        [3.1, 6.],
        [3.1, 5.],
        [5., 5.],
        [5., 1.],
        [1., 1.],
        [1., 5.],
        [2.95, 5.],
        [2.95, 6.],
        [0., 6.],
    ]);
    assert_eq!(found(&[bay], Punch, Rule::LostPocket).2.len(), 1);
    // A chamber behind a neck, and a dead end beside it that is too narrow all along: each is said once, by its own rule.
    let beside_a_slot = ring(&[
        [0., 0.],
        [6., 0.],
        [6., 1.9],
        [9., 1.9],
        [9., 2.05],
        [6., 2.05],
        [6., 4.],
        [3.075, 4.],
        [3.075, 5.],
        [4.5, 5.],
        [4.5, 8.],
        [1.5, 8.],
        [1.5, 5.],
        [2.925, 5.],
        [2.925, 4.],
        [0., 4.],
    ]);
    let (_, _, findings) = found(
        std::slice::from_ref(&beside_a_slot),
        Opening,
        Rule::LostPocket,
    );
    assert!(
        matches!(findings[..], [Finding { detail: Detail::LostPocket { near }, .. }] if near.y > 5.),
        "{findings:?}"
    );
    assert_eq!(
        found(&[beside_a_slot], Opening, Rule::NarrowSlot).2.len(),
        2
    );
    let collapse = Rule::OffsetCollapse;
    check_lost(
        "a hole for a needle",
        &[ring(&[[0., 0.], [0.3, 0.], [0.15, 0.26]])],
        Opening,
        collapse,
        &[[0.1, 0.1]],
    );
    check_lost(
        "a slit",
        &[ring(&[[0., 0.], [5., 0.], [5., 0.15], [0., 0.15]])],
        Opening,
        collapse,
        &[[0.1, 0.1]],
    );
    check_lost(
        "a slit",
        &[ring(&[[0., 0.], [5., 0.], [5., 0.15], [0., 0.15]])],
        Punch,
        collapse,
        &[],
    );
    check_lost(
        "a slit the wire fits in",
        &[ring(&[[0., 0.], [5., 0.], [5., 0.25], [0., 0.25]])],
        Opening,
        collapse,
        &[],
    );
    check_lost(
        "a tight circle is small-radius",
        &[circle([0., 0.], 0.08)],
        Opening,
        collapse,
        &[],
    );
    check_lost("a square", &[square(0., 0., 4.)], Opening, collapse, &[]);
    check_lost(
        "far from the origin",
        &[ring(&[[1e6, 0.], [1e6 + 0.3, 0.], [1e6 + 0.15, 0.26]])],
        Opening,
        collapse,
        &[[0.1, 0.1]],
    );
}
