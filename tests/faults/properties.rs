//! What holds of any faulty program: it is judged alike in the mirror, and no fix makes it worse.

use super::chance::Chance;
use super::contours::{Group, program};
use super::inject::{inject, kinds};
use super::judge::{findings, read};
use crate::size::by_day;
use std::collections::BTreeMap;
use wedm::document::Document;
use wedm::finding::{Edit, Finding, FixKind, Rule, Severity};
use wedm::text::edited;

/// A compact 3B program with left and right exchanged.
fn mirrored(text: &str) -> String {
    let line = |line: &str| {
        let Some((head, quadrant)) = line.split_at_checked(line.len().saturating_sub(1)) else {
            return line.to_owned();
        };
        // A line along an axis is written with the quadrant of its direction.
        let is_zero = |of: &str| !of.is_empty() && of.trim_matches(['0', ' ']).is_empty();
        let fields: Vec<&str> = head.split('B').collect();
        let [is_along_x, is_along_y] = match fields[..] {
            _ if !head.ends_with('L') => [false, false],
            ["", x, y, _] => [is_zero(y), !is_zero(y) && is_zero(x)],
            // Where a B is lost, the zero beside it is not: then the direction in which is counted says it.
            _ => ["GX", "GY"].map(|of| head.contains(of) && fields.iter().any(|it| is_zero(it))),
        };
        let mirrored = match quadrant {
            // Along an axis a wrong quadrant stays a wrong one.
            "1" if is_along_x => "3",
            "2" if is_along_x => "4",
            "3" if is_along_x => "1",
            "4" if is_along_x => "2",
            _ if is_along_y => quadrant,
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
    for _ in 0..by_day(12, 40) {
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

/// A circle that does not come round, after a block that is repeated: rounding does not decide whether it is blamed.
#[test]
fn a_circle_that_does_not_come_round_is_judged_alike_in_the_mirror() {
    let text = "B9900B0B9900GXL1\nB9900B0B9900GXL1\nB9900B0B39300GYNR1\nB9900B0B9900GXL3\nDD\n";
    assert_eq!(said(text), said(&mirrored(text)));
}

/// By how much `not-closed` says that a contour is open, µm; of other findings 0.
fn gap_of(finding: &Finding) -> f64 {
    let detail = format!("{:?}", finding.detail);
    let along = |axis: &str| {
        let rest = detail.split_once(axis)?.1;
        rest.split([',', ' ']).next()?.parse::<f64>().ok()
    };
    match (finding.rule, along("x: "), along("y: ")) {
        (Rule::NotClosed, Some(x), Some(y)) => x.hypot(y),
        _ => 0.0,
    }
}

/// How often each rule has something to say, and by how much contours are open, µm. Which block is to blame is no finding of its own.
fn standing(document: &mut Document) -> (BTreeMap<&'static str, usize>, f64) {
    let (mut counts, mut gap) = (BTreeMap::new(), 0.0);
    for finding in findings(document) {
        gap += gap_of(&finding);
        if finding.rule != Rule::SuspectBlock {
            *counts.entry(finding.rule.name()).or_default() += 1;
        }
    }
    (counts, gap)
}

#[test]
fn no_fix_that_is_offered_brings_a_finding_or_closes_worse() {
    let chance = &mut Chance::of_seed(3);
    let mut failures = Vec::new();
    let mut tried = 0;
    for group in Group::ALL {
        for _ in 0..2 {
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
                let (before, gap) = standing(&mut document);
                for finding in findings(&mut document) {
                    // What cannot be read may hide something, but from a line that closes.
                    for fix in document.fixes(&finding) {
                        let closes = matches!(fix.kind, FixKind::Close { .. });
                        if finding.rule == Rule::Syntax && !closes {
                            continue;
                        }
                        let Edit::Text(edits) = &fix.edit else {
                            continue;
                        };
                        tried += 1;
                        let text = edited(faulty.text.as_bytes(), edits).unwrap();
                        let text = String::from_utf8(text).unwrap();
                        let (after, open) = standing(&mut read(group, &text));
                        let is_new = |(rule, count): (&&str, &usize)| {
                            *count > before.get(*rule).copied().unwrap_or(0)
                        };
                        let name = Rule::NotClosed.name();
                        let is_wider = after.get(name) == before.get(name) && open > gap;
                        if after.iter().any(is_new) || is_wider {
                            let rule = finding.rule.name();
                            failures.push(format!(
                                "{kind} and {another}: {rule} by {:?}: {before:?} {gap} became {after:?} {open}:\n{text}",
                                fix.kind
                            ));
                        }
                    }
                }
            }
        }
    }
    assert!(tried > 400, "{tried}");
    assert!(
        failures.is_empty(),
        "{} of {tried}:\n{}",
        failures.len(),
        failures.join("\n")
    );
}
