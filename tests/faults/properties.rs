//! What holds of any faulty program: it is judged alike in the mirror, and a line that closes a contour brings no error.

use super::chance::Chance;
use super::contours::{Group, program};
use super::inject::{inject, kinds};
use super::judge::{findings, read};
use wedm::document::Document;
use wedm::finding::{Edit, FixKind, Severity};
use wedm::text::edited;

/// A compact 3B program with left and right exchanged.
fn mirrored(text: &str) -> String {
    let line = |line: &str| {
        let Some((head, quadrant)) = line.split_at_checked(line.len().saturating_sub(1)) else {
            return line.to_owned();
        };
        // A line along an axis is written with the quadrant of its direction.
        let fields: Vec<&str> = head.split('B').collect();
        let is_zero = |field: usize| {
            head.ends_with('L')
                && fields
                    .get(field)
                    .is_some_and(|of| of.trim_matches(['0', ' ']).is_empty())
        };
        let mirrored = match quadrant {
            "1" if is_zero(2) => "3",
            "3" if is_zero(2) => "1",
            "2" | "4" if is_zero(1) => quadrant,
            "1" => "2",
            "2" => "1",
            "3" => "4",
            "4" => "3",
            _ => return line.to_owned(),
        };
        let head = match head
            .strip_suffix('R')
            .map(|head| head.split_at(head.len() - 1))
        {
            Some((head, "N")) => format!("{head}SR"),
            Some((head, "S")) => format!("{head}NR"),
            _ => head.to_owned(),
        };
        head + mirrored
    };
    text.lines().map(|own| line(own) + "\n").collect()
}

fn said(text: &str) -> Vec<String> {
    let document = &mut read(Group::Compact, text);
    let mut said: Vec<String> = findings(document)
        .iter()
        .filter(|finding| finding.severity < Severity::Information)
        .map(|finding| format!("{} {:?}", finding.rule.name(), finding.severity))
        .collect();
    said.sort();
    said
}

#[test]
fn a_faulty_program_is_judged_alike_in_the_mirror() {
    let chance = &mut Chance::of_seed(12);
    let mut failures = Vec::new();
    for _ in 0..40 {
        let Some(sound) = program(Group::Compact, chance).filter(|text| text.starts_with('B'))
        else {
            continue;
        };
        for kind in kinds(Group::Compact) {
            let Some(faulty) = inject(Group::Compact, kind, &sound, chance) else {
                continue;
            };
            let (own, other) = (said(&faulty.text), said(&mirrored(&faulty.text)));
            if own != other {
                failures.push(format!("{kind}: {own:#?}\n{other:#?}\n{}", faulty.text));
            }
        }
    }
    assert!(
        failures.is_empty(),
        "{}:\n{}",
        failures.len(),
        failures.join("\n")
    );
}

/// A circle that does not come round, behind a block that stands twice: rounding does not decide whether it is blamed.
#[test]
fn a_circle_that_does_not_come_round_is_judged_alike_in_the_mirror() {
    let text = "B9900B0B9900GXL1\nB9900B0B9900GXL1\nB9900B0B39300GYNR1\nB9900B0B9900GXL3\nDD\n";
    assert_eq!(said(text), said(&mirrored(text)));
}

fn errors(document: &mut Document) -> usize {
    let found = findings(document);
    found
        .iter()
        .filter(|finding| finding.severity == Severity::Error)
        .count()
}

#[test]
fn a_line_that_closes_a_contour_brings_no_error() {
    let chance = &mut Chance::of_seed(3);
    let mut failures = Vec::new();
    let mut tried = 0;
    for group in Group::ALL {
        for _ in 0..5 {
            let Some(sound) = program(group, chance) else {
                continue;
            };
            for kind in kinds(group) {
                let another = chance.of(&kinds(group));
                let Some(faulty) = inject(group, kind, &sound, chance)
                    .and_then(|faulty| inject(group, another, &faulty.text, chance))
                else {
                    continue;
                };
                let mut document = read(group, &faulty.text);
                let before = errors(&mut document);
                for finding in findings(&mut document) {
                    for fix in document.fixes(&finding) {
                        let (FixKind::Close { .. }, Edit::Text(edits)) = (&fix.kind, &fix.edit)
                        else {
                            continue;
                        };
                        tried += 1;
                        let text = edited(faulty.text.as_bytes(), edits).unwrap();
                        let text = String::from_utf8(text).unwrap();
                        if errors(&mut read(group, &text)) > before {
                            failures.push(format!("{kind} and {another}:\n{text}"));
                        }
                    }
                }
            }
        }
    }
    assert!(tried > 20, "{tried}");
    assert!(
        failures.is_empty(),
        "{} of {tried}:\n{}",
        failures.len(),
        failures.join("\n")
    );
}
