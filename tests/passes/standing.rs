//! What stands until a tab is cut off, and what a program leaves of the corners.

use super::{PLATE, document, drawing, generate, paths, settings};
use wedm::drawing::Role::{self, Opening, Punch};
use wedm::finding::{Severity, sentence};
use wedm::job::Refusal;
use wedm::program::Format;

/// A body of 10 × 10 with an arm of 20 × 1.
const ARM: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [30.0, 0.0, 0.0],
    [30.0, 1.0, 0.0],
    [10.0, 1.0, 0.0],
    [10.0, 10.0, 0.0],
    [0.0, 10.0, 0.0],
];

/// Two bodies of 5 × 5, and a neck of 10 × 0.35 between them: what stands of it is nothing.
const DUMBBELL: [[f64; 3]; 12] = [
    [0.0, 0.0, 0.0],
    [5.0, 0.0, 0.0],
    [5.0, 2.0, 0.0],
    [15.0, 2.0, 0.0],
    [15.0, 0.0, 0.0],
    [20.0, 0.0, 0.0],
    [20.0, 5.0, 0.0],
    [15.0, 5.0, 0.0],
    [15.0, 2.35, 0.0],
    [5.0, 2.35, 0.0],
    [5.0, 5.0, 0.0],
    [0.0, 5.0, 0.0],
];

/// Corners of R 0.14.
const FILLET: [[f64; 3]; 5] = [
    [0.0, 0.14, 0.414_213_562_373_095],
    [0.14, 0.0, 0.0],
    [10.0, 0.0, 0.0],
    [10.0, 8.0, 0.0],
    [0.0, 8.0, 0.0],
];

const WIRE: &str = "wire-diameter = 0.2\ngap = 0.01\n";
const HEAVY: &str = "[job]\nthickness = 40\nslug-limit = 5\n";

fn wire(more: &str) -> String {
    format!("{WIRE}[program]\n{more}\n")
}

/// What drops out, the contour, settings, and how severely what is said.
type Row = (
    Role,
    &'static [[f64; 3]],
    String,
    Severity,
    &'static [&'static str],
);

#[test]
fn a_tab_that_holds_nothing_is_said() {
    let rows: &[Row] = &[
        (
            Punch,
            &PLATE,
            wire("tab = 0.05"),
            Severity::Error,
            &["nothing of the tab", "0.220 mm wide"],
        ),
        (
            Punch,
            &PLATE,
            wire("tab = 0.22"),
            Severity::Error,
            &["nothing of the tab"],
        ),
        (
            Punch,
            &PLATE,
            wire("tab = 0.3"),
            Severity::Warning,
            &["a neck of 0.080 mm"],
        ),
        (
            Punch,
            &PLATE,
            wire("tab = 0.05\ncompensation = \"controller\""),
            Severity::Error,
            &["nothing of the tab", "0.220 mm wide"],
        ),
        (Punch, &PLATE, wire("tab = 0.4"), Severity::Hint, &[]),
        (Punch, &PLATE, wire("tab = 3"), Severity::Hint, &[]),
        (
            Punch,
            &PLATE,
            wire("tab = 3\nstart-hole = 6"),
            Severity::Hint,
            &[],
        ),
        (
            Punch,
            &PLATE,
            wire("tab = 0.2\nstart-hole = 6"),
            Severity::Error,
            &["nothing of the tab"],
        ),
        (
            Punch,
            &PLATE,
            wire("tab = 1\nstart-hole = 6"),
            Severity::Warning,
            &["a neck of 0.1"],
        ),
        // The lead runs along the tab.
        (
            Punch,
            &PLATE,
            wire("tab = 2\nthread = [16.0, -0.5]\nentry = [20.0, 0.0]"),
            Severity::Warning,
            &["the tab of 2.000 mm at contour 2A holds by a neck of 0.170 mm"],
        ),
        (
            Punch,
            &PLATE,
            wire(
                "tab = 2\nthread = [16.0, -0.5]\nentry = [20.0, 0.0]\ncompensation = \"controller\"",
            ),
            Severity::Error,
            &["nothing of the tab of 2.000 mm"],
        ),
        (
            Punch,
            &PLATE,
            wire("tab = 2\nlead = \"arc\"\nlead-in = 20"),
            Severity::Warning,
            &["a neck of 0.074 mm"],
        ),
        // What is not known is not more than the correction of the last pass.
        (
            Punch,
            &PLATE,
            "[passes]\ncorrections = [0.3, 0.1]\n[program]\ntab = 0.5\n".into(),
            Severity::Hint,
            &[],
        ),
        // The lead reaches the other side of the arm.
        (
            Opening,
            &ARM,
            format!("{}{HEAVY}", wire("tab = 2\nentry = [16.0, 0.0]")),
            Severity::Warning,
            &["7.6 mm² of the slug come loose", "meets itself at (16."],
        ),
        (
            Opening,
            &ARM,
            format!("{}{HEAVY}", wire("tab = 2\ndirection = \"cw\"")),
            Severity::Warning,
            &["94.2 mm² of the slug come loose"],
        ),
        (
            Opening,
            &ARM,
            format!(
                "{}{HEAVY}",
                wire("tab = 2\ndirection = \"cw\"\ncompensation = \"controller\"")
            ),
            Severity::Warning,
            &["mm² of the slug come loose"],
        ),
        (
            Opening,
            &ARM,
            format!("{}{HEAVY}", wire("tab = 2\nentry = [5.0, 0.0]")),
            Severity::Hint,
            &[],
        ),
        (
            Opening,
            &ARM,
            format!(
                "{}{HEAVY}",
                wire("tab = 2\nentry = [16.0, 0.0]\nlead-in = 0.2")
            ),
            Severity::Hint,
            &[],
        ),
        (
            Opening,
            &ARM,
            wire("tab = 0\ndirection = \"cw\""),
            Severity::Hint,
            &[],
        ),
        (
            Opening,
            &DUMBBELL,
            wire("tab = { 2A = 1 }\nentry = [2.0, 0.0]"),
            Severity::Warning,
            &["mm² of the slug come loose"],
        ),
        (Punch, &DUMBBELL, wire("tab = 1"), Severity::Hint, &[]),
    ];
    let mut wrong = Vec::new();
    for (role, vertices, text, severity, says) in rows {
        let (drawing, settings) = (drawing(*role, vertices), settings(text));
        let format = match text.contains("controller") {
            true => Format::Iso,
            false => Format::ThreeB,
        };
        let made = generate(&document(&drawing, &settings), format, false);
        let (is_made, mut found) = match made {
            Ok(made) => (true, made.warnings),
            Err(Refusal::Findings(found) | Refusal::Errors(found)) => (false, found),
            Err(other) => panic!("{text}: {other:?}"),
        };
        found.retain(|finding| {
            finding.rule == wedm::finding::Rule::LeadIn && finding.severity <= Severity::Warning
        });
        let said: Vec<String> = found.iter().map(|one| sentence(one, 1.0)).collect();
        let is_as_severe = found.iter().all(|one| one.severity == *severity);
        let are_said = says
            .iter()
            .all(|own| said.iter().any(|one| one.contains(own)));
        if is_made == (*severity == Severity::Error)
            || !are_said
            || !is_as_severe
            || found.is_empty() != says.is_empty()
        {
            wrong.push(format!("{role:?} {text}: {said:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_contour_that_is_named_keeps_its_tab() {
    let count = |text: &str| paths(&drawing(Opening, &PLATE), &settings(text)).len();
    assert_eq!(
        count("[program]\ntab = 3\n"),
        1,
        "nothing says that it is heavy"
    );
    assert_eq!(count("[program]\ntab = { 2A = 3 }\n"), 2);
    assert_eq!(count("[program]\ntab = { 2A = 0 }\n"), 1);
}

/// Corners of R 0.201, or 0.2 where 4B rounds them up; what an arc leaves of a right angle is 0.4142 of its radius.
#[test]
fn what_four_b_leaves_is_that_of_its_arcs() {
    let wire = "wire-diameter = 0.25\ngap = 0.02\n";
    let passes = "[passes]\ncorrections = [0.2, 0.145]\n";
    for (role, text, uncut, overcut) in [
        (Opening, format!("{wire}{passes}"), 0.0833, 0.0),
        (Punch, format!("{wire}{passes}"), 0.0, 0.0833),
        (Opening, "correction = 0.2\n".into(), 0.0833, 0.0),
        (Punch, "correction = 0.2\n".into(), 0.0, 0.0833),
        (
            Punch,
            "correction = 0.2\n[program]\ntab = 3\n".into(),
            0.0,
            0.0833,
        ),
        // Of a pass that stays 0.055 from where it could be.
        (Opening, format!("{wire}correction = 0.2\n"), 0.1383, 0.0),
        (Punch, format!("{wire}correction = 0.2\n"), 0.055, 0.0283),
    ] {
        let (drawing, settings) = (drawing(role, &PLATE), settings(&text));
        let made = generate(&document(&drawing, &settings), Format::FourB, false);
        let left = made.unwrap().finished.expect("what is left");
        let near = |a: f64, b: f64| (a - b).abs() < 1e-4;
        assert!(
            near(left.uncut, uncut) && near(left.overcut, overcut),
            "{text}: {left:?}"
        );
    }
}

/// Between the last correction and the first, an arc is there only where the skims go beside the contour.
#[test]
fn no_skim_of_constant_stock_comes_to_an_arc_below_the_first_correction() {
    let of = |corner: &str| {
        let text = format!(
            "wire-diameter = 0.18\ngap = 0.01\n[passes]\ncorrections = [0.2, 0.15, 0.1]\nskim-corner = \"{corner}\"\n"
        );
        let document = document(&drawing(Opening, &FILLET), &settings(&text));
        generate(&document, Format::ThreeB, false)
    };
    assert!(of("sharp").is_ok());
    let Err(Refusal::Errors(found)) = of("constant-stock") else {
        panic!("an arc that is not cut");
    };
    let said = sentence(&found[0], 1.0);
    assert!(
        said.contains("R 0.140 mm is below the correction 0.200 mm"),
        "{said}"
    );
    assert!(said.contains("overcuts the contour by 0.060 mm"), "{said}");
}
