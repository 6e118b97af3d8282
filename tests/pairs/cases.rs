//! Figures, and what the rules say of them.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Role, Vertex};
use wedm::finding::{Detail, Finding, Rule, Severity};
use wedm::settings::{Effective, Settings};

fn closed(vertices: &[[f64; 3]]) -> Geometry {
    Geometry::Polyline {
        closed: true,
        vertices: vertices
            .iter()
            .map(|&[x, y, bulge]| Vertex::new(x, y, bulge))
            .collect(),
    }
}

fn ring(points: &[[f64; 2]]) -> Geometry {
    closed(&points.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>())
}

fn open(points: &[[f64; 2]]) -> Geometry {
    Geometry::Polyline {
        closed: false,
        vertices: points
            .iter()
            .map(|&[x, y]| Vertex::new(x, y, 0.0))
            .collect(),
    }
}

fn line(start: [f64; 2], end: [f64; 2]) -> Geometry {
    Geometry::Line {
        start: start.into(),
        end: end.into(),
    }
}

fn circle(center: [f64; 2], radius: f64) -> Geometry {
    Geometry::Circle {
        center: center.into(),
        radius,
    }
}

fn arc(center: [f64; 2], radius: f64, from: f64, to: f64) -> Geometry {
    Geometry::Arc {
        center: center.into(),
        radius,
        start_angle: from,
        end_angle: to,
    }
}

fn square(x: f64, y: f64, side: f64) -> Geometry {
    ring(&[[x, y], [x + side, y], [x + side, y + side], [x, y + side]])
}

/// What the rule finds among `entities` at a correction of 0.1 mm.
fn found(entities: &[Geometry], role: Role, rule: Rule) -> (Drawing, Analysis, Vec<Finding>) {
    let mut drawing = Drawing::new(None);
    for geometry in entities {
        let role = (role != Role::Both).then_some(role);
        drawing.push(Entity {
            handle: "A".into(),
            layer: "0".into(),
            role,
            kind: wedm::drawing::Kind::Line,
            geometry: geometry.clone(),
        });
    }
    // Where open contours are errors, little is asked of them.
    let open_contours_are_let_be = [(
        "open-contour".to_owned(),
        wedm::settings::RuleSeverity::Warning,
    )];
    let settings = Arc::new(Effective::of(&Settings {
        correction: Some(0.1),
        rules: Some(open_contours_are_let_be.into()),
        ..Settings::default()
    }));
    let mut analysis = Analysis::new(&drawing, settings);
    let (mut findings, _) = analysis.findings(&drawing, usize::MAX);
    findings.retain(|finding| finding.rule == rule);
    (drawing, analysis, findings)
}

fn check_contacts(name: &str, entities: &[Geometry], expected: &[([f64; 2], bool, Severity)]) {
    let (_, _, findings) = found(entities, Role::Both, Rule::SelfIntersection);
    let mut contacts: Vec<([f64; 2], bool, Severity)> = findings
        .iter()
        .map(|finding| match finding.detail {
            Detail::SelfIntersection { at, touches } => {
                let rounded = |number: f64| (number * 1e3).round() / 1e3 + 0.0;
                ([rounded(at.x), rounded(at.y)], touches, finding.severity)
            }
            _ => panic!("{finding:?}"),
        })
        .collect();
    contacts.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    assert_eq!(contacts, expected, "{name}");
}

#[test]
fn outlines_cross_and_touch() {
    use Severity::{Error, Warning};
    let (cross, touch) = (false, true);
    check_contacts("a square", &[square(0., 0., 4.)], &[]);
    check_contacts(
        "a bow tie",
        &[ring(&[[0., 0.], [4., 4.], [4., 0.], [0., 4.]])],
        &[([2., 2.], cross, Error)],
    );
    check_contacts(
        "two squares apart",
        &[square(0., 0., 4.), square(4.1, 0., 4.)],
        &[],
    );
    check_contacts(
        "two squares that cross",
        &[square(0., 0., 4.), square(2., 1., 4.)],
        &[([2., 4.], cross, Error), ([4., 1.], cross, Error)],
    );
    check_contacts(
        "corner on a side",
        &[square(0., 0., 4.), ring(&[[4., 2.], [6., 0.], [6., 4.]])],
        &[([4., 2.], touch, Error)],
    );
    check_contacts(
        "corner through a side",
        &[square(0., 0., 4.), ring(&[[3., 2.], [6., 0.], [6., 4.]])],
        &[([4., 1.333], cross, Error), ([4., 2.667], cross, Error)],
    );
    check_contacts(
        "a vertex on a side, and on to the other side of it",
        &[
            square(0., 0., 4.),
            ring(&[[2., 1.], [4., 2.], [6., 3.], [6., 9.], [2., 9.]]),
        ],
        &[([2., 4.], cross, Error), ([4., 2.], cross, Error)],
    );
    check_contacts(
        "two loops that touch in a vertex",
        &[ring(&[
            [0., 0.],
            [2., 2.],
            [4., 4.],
            [4., 0.],
            [2., 2.],
            [0., 4.],
        ])],
        &[([2., 2.], cross, Error)],
    );
    check_contacts(
        "the same vertex without a crossing",
        &[ring(&[
            [0., 0.],
            [2., 2.],
            [4., 0.],
            [4., 4.],
            [2., 2.],
            [0., 4.],
        ])],
        &[([2., 2.], touch, Error)],
    );
    check_contacts(
        "circles that touch",
        &[circle([0., 0.], 2.), circle([5., 0.], 3.)],
        &[([2., 0.], touch, Error)],
    );
    check_contacts(
        "circles that touch from within",
        &[circle([0., 0.], 2.), circle([0., 1.], 1.)],
        &[([0., 2.], touch, Error)],
    );
    check_contacts(
        "circles that cross",
        &[circle([0., 0.], 5.), circle([6., 0.], 5.)],
        &[([3., 4.], cross, Error)],
    );
    check_contacts(
        "a line tangent to a circle",
        &[circle([0., 0.], 2.), line([-5., 2.], [5., 2.])],
        &[([0., 2.], touch, Warning)],
    );
    check_contacts(
        "lines that lead into a circle",
        &[
            circle([0., 0.], 2.),
            open(&[[-5., 0.], [-5., 1.], [0., 1.]]),
        ],
        &[([-1.732, 1.], cross, Error)],
    );
    check_contacts(
        "a corner on a circle, from within",
        &[
            circle([0., 0.], 2.),
            ring(&[[0., 2.], [-0.5, 1.], [0.5, 1.]]),
        ],
        &[([0., 2.], touch, Error)],
    );
    check_contacts(
        "a vertex on a circle, and on to the other side of it",
        &[
            circle([0., 0.], 2.),
            ring(&[[0., 1.], [0., 2.], [0.5, 3.], [3., 3.], [3., 1.]]),
        ],
        &[([0., 2.], cross, Error), ([1.732, 1.], cross, Error)],
    );
    check_contacts(
        "a lead-in that ends on a side",
        &[square(0., 0., 4.), open(&[[2., 1.], [2., 2.], [4., 2.]])],
        &[([4., 2.], touch, Warning)],
    );
    check_contacts(
        "a lead-in that ends in a corner",
        &[square(0., 0., 4.), open(&[[2., 1.], [2., 2.], [4., 4.]])],
        &[([4., 4.], touch, Warning)],
    );
    check_contacts(
        "a lead-in that reaches past",
        &[square(0., 0., 4.), open(&[[2., 1.], [2., 2.], [4.5, 2.]])],
        &[([4., 2.], cross, Error)],
    );
    check_contacts(
        "an open chain that ends on itself",
        &[open(&[
            [2., 2.],
            [4., 2.],
            [4., 4.],
            [0., 4.],
            [0., 0.],
            [4., 0.],
            [4., 2.],
        ])],
        &[([4., 2.], touch, Warning)],
    );
    check_contacts(
        "an arc that comes back through its neighbour",
        &[
            line([-5., 0.], [0., 0.]),
            // From the end of the line over the top and back through it.
            arc([-1., 1.], 2f64.sqrt(), -PI / 4., PI * 1.4),
        ],
        &[([-2., 0.], cross, Error)],
    );
    check_contacts(
        "an arc that comes back onto its neighbour",
        &[line([-5., 0.], [0., 0.]), arc([-1., 0.], 1., 0., PI)],
        &[([-2., 0.], touch, Warning)],
    );
    check_contacts(
        "a rounded slot",
        &[closed(&[
            [0., 0., 0.],
            [4., 0., 1.],
            [4., 2., 0.],
            [0., 2., 1.],
        ])],
        &[],
    );
    check_contacts(
        "a sharp spike",
        &[ring(&[[0., 0.], [10., 0.05], [0., 0.1], [-5., 5.]])],
        &[],
    );
    check_contacts(
        "a tiny chamfer",
        &[ring(&[
            [0., 0.],
            [3.9995, 0.],
            [4., 0.0005],
            [4., 4.],
            [0., 4.],
        ])],
        &[],
    );
    check_contacts(
        "two squares that share a side",
        &[square(0., 0., 4.), square(4., 0., 4.)],
        &[],
    );
    check_contacts("a double", &[square(0., 0., 4.), square(0., 0., 4.)], &[]);
}

fn check_overlaps(name: &str, entities: &[Geometry], expected: &[(f64, usize)]) {
    let (drawing, analysis, findings) = found(entities, Role::Both, Rule::Overlap);
    let told = |finding: &Finding| match finding.detail {
        Detail::Overlap { length } => (
            (length * 1e3).round() / 1e3,
            analysis.fixes(&drawing, finding).len(),
        ),
        _ => panic!("{finding:?}"),
    };
    assert_eq!(
        findings.iter().map(told).collect::<Vec<_>>(),
        expected,
        "{name}"
    );
}

#[test]
fn segments_run_on_one_another() {
    check_overlaps(
        "lines end to end",
        &[line([0., 0.], [4., 0.]), line([4., 0.], [8., 0.])],
        &[],
    );
    check_overlaps(
        "lines that reach past each other a little",
        &[line([0., 0.], [4.004, 0.]), line([3.996, 0.], [8., 0.])],
        &[],
    );
    check_overlaps(
        "half on one another",
        &[line([0., 0.], [4., 0.]), line([6., 0.], [3., 0.])],
        &[(1.0, 0)],
    );
    check_overlaps(
        "one within the other",
        &[line([0., 0.], [4., 0.]), line([3., 0.], [1., 0.001])],
        &[(2.0, 1)],
    );
    check_overlaps(
        "beside one another",
        &[line([0., 0.], [4., 0.]), line([3., 0.006], [1., 0.006])],
        &[],
    );
    check_overlaps(
        "a double",
        &[line([0., 0.], [4., 0.]), line([4., 0.], [0., 0.])],
        &[],
    );
    check_overlaps(
        "a double of many sides",
        &[square(0., 0., 4.), square(0., 0., 4.)],
        &[],
    );
    check_overlaps(
        "a common side",
        &[square(0., 0., 4.), square(4., 1., 4.)],
        &[(3.0, 0)],
    );
    check_overlaps(
        "there and back",
        &[open(&[[0., 0.], [4., 0.], [1., 0.]])],
        &[(3.0, 0)],
    );
    check_overlaps(
        "arcs of one circle",
        &[
            arc([0., 0.], 2., 0., PI),
            arc([0., 0.], 2., FRAC_PI_2, 1.5 * PI),
        ],
        &[((PI * 1e3).round() / 1e3, 0)],
    );
    check_overlaps(
        "an arc on a circle",
        &[circle([1., 0.], 2.), arc([1., 0.], 2., 1., 2.)],
        &[(2.0, 1)],
    );
    check_overlaps(
        "crossing at a small angle",
        &[line([0., 0.], [4., 0.]), line([0., -0.1], [4., 0.1])],
        &[],
    );
}

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
