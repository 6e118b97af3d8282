//! Every refactoring at every fixture: the text that it makes, or why it refuses, as it is recorded in a file. Of long texts, and of
//! those that are made of faulty programs, a hash is recorded.
//!
//! `UPDATE_EXPECT=1 cargo test --test core programs refactor` records again what they do. By day every second program is looked at.

use super::language_of;
use crate::size::by_day;
use expect_test::expect_file;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};
use wedm::document::{Document, Source};
use wedm::finding::Severity;
use wedm::program::Proposal;
use wedm::program::{self, Language};
use wedm::program::{refactorings, scaled};
use wedm::settings::Effective;
use wedm::text::TextEdit;

/// All programs among the fixtures.
fn programs() -> Vec<PathBuf> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let mut files = Vec::new();
    for folder in ["programs/right", "programs/wrong", "refactorings"] {
        let mut own: Vec<PathBuf> = std::fs::read_dir(data.join(folder))
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .filter(|path| language_of(path).is_some())
            .collect();
        own.sort();
        files.extend(own);
    }
    files
}

fn applied(bytes: &[u8], edits: &[TextEdit]) -> Vec<u8> {
    let mut result = bytes.to_vec();
    for edit in edits.iter().rev() {
        result.splice(edit.range.clone(), edit.text.bytes());
    }
    result
}

/// FNV-1a.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// What is selected: nothing, and so everything; a block by the cursor, up to that many; some lines.
fn selections(program: &program::Document, most: usize) -> Vec<(String, Range<usize>)> {
    let text = program.text();
    let lines: BTreeSet<usize> = program
        .trace()
        .steps
        .iter()
        .filter(|step| step.moves())
        .map(|step| step.line)
        .collect();
    let mut found = vec![("nothing".to_owned(), 0..0)];
    for line in lines.iter().take(most) {
        let start = text.line_start(*line);
        found.push((format!("line {}", line + 1), start..start));
    }
    let lines: Vec<usize> = lines.into_iter().collect();
    if let [_, first, .., last, _] = lines[..] {
        let range = text.line_start(first)..text.line_range(last).end;
        found.push((format!("lines {} to {}", first + 1, last + 1), range));
    }
    found
}

/// Rules of the errors of a program.
fn errors(language: Language, bytes: &[u8], settings: &Effective) -> BTreeSet<&'static str> {
    let program = program::Document::read(language, bytes.to_vec(), settings);
    let mut document = Document::new(
        Source::Program(program),
        std::sync::Arc::new(settings.clone()),
    );
    let (findings, _) = document.findings(usize::MAX);
    findings
        .iter()
        .filter(|finding| finding.severity == Severity::Error)
        .map(|finding| finding.rule.name())
        .collect()
}

/// The part of a record that is about those programs whose names are wanted.
fn of_those(record: &str, is_wanted: impl Fn(&str) -> bool) -> String {
    let mut is_own = false;
    let own = record.split_inclusive('\n').filter(|line| {
        if let Some((name, _)) = line
            .strip_prefix("== ")
            .and_then(|line| line.split_once(": "))
        {
            is_own = is_wanted(name);
        }
        is_own
    });
    own.collect()
}

#[test]
fn refactorings_do_what_is_recorded_and_bring_no_error() {
    let settings = Effective::default();
    let mut record = String::new();
    let mut spoiled = Vec::new();
    let records = std::env::var_os("UPDATE_EXPECT").is_some();
    let is_looked_at = |name: &str| records || hash(name.as_bytes()).is_multiple_of(by_day(3, 1));
    for path in programs() {
        if !is_looked_at(path.file_name().unwrap().to_str().unwrap()) {
            continue;
        }
        let (language, bytes) = (language_of(&path).unwrap(), std::fs::read(&path).unwrap());
        let before = errors(language, &bytes, &settings);
        let is_wrong = path.parent().unwrap().ends_with("wrong");
        let name = path.file_name().unwrap().to_str().unwrap();
        let program = program::Document::read(language, bytes.clone(), &settings);
        let mut of_all: Vec<(String, Result<Vec<u8>, String>)> = Vec::new();
        let mut say = |title: &str, edits: Result<Vec<TextEdit>, String>| {
            let result = edits.map(|edits| applied(&bytes, &edits));
            // Most do the same wherever the cursor is.
            if let Ok(after) = &result
                && !of_all.iter().any(|(_, known)| known.as_ref() == Ok(after))
            {
                let now = errors(language, after, &settings);
                if let Some(rule) = now.difference(&before).next() {
                    spoiled.push(format!("{name}: {title} brings {rule}"));
                }
            }
            let (id, place) = title.split_once(" at ").unwrap();
            if place != "nothing" && of_all.contains(&(id.to_owned(), result.clone())) {
                return;
            }
            of_all.push((id.to_owned(), result.clone()));
            match result {
                Err(reason) => writeln!(record, "== {name}: {title}: refused: {reason}"),
                Ok(after)
                    if is_wrong || after.iter().filter(|byte| **byte == b'\n').count() > 60 =>
                {
                    writeln!(record, "== {name}: {title}: {:016x}", hash(&after))
                }
                Ok(after) => write!(
                    record,
                    "== {name}: {title}\n{}",
                    String::from_utf8_lossy(&after).replace('\r', "␍")
                ),
            }
            .unwrap();
        };
        for (place, selection) in selections(&program, if is_wrong { 2 } else { 6 }) {
            for Proposal { id, title, edits } in
                refactorings(&program, &settings, selection, |_| true)
            {
                let id = id.trim_start_matches("refactor.rewrite.");
                let profile = title
                    .strip_prefix("Rewrite as profile ")
                    .and_then(|title| title.split(':').next())
                    .unwrap_or_default();
                say(&format!("{id} {profile} at {place}"), edits);
            }
        }
        for factor in [25.4, 0.5, 1.0 / 25.4, 1e-9] {
            let edits = scaled(&program, &settings, factor);
            say(&format!("scaled by {factor:.4} at nothing"), edits);
        }
    }
    let recorded = expect_file!["../data/refactorings/expected.txt"];
    if records {
        recorded.assert_eq(&record);
    }
    let recorded = of_those(&recorded.data(), is_looked_at);
    let differs = recorded
        .lines()
        .zip(record.lines())
        .find(|(was, is)| was != is);
    assert_eq!(differs, None);
    assert_eq!(record.len(), recorded.len());
    assert!(spoiled.is_empty(), "{}", spoiled.join("\n"));
}

#[test]
fn refactorings_of_faulty_programs_bring_no_other_fault() {
    let settings = Effective::default();
    let mut spoiled = BTreeSet::new();
    for path in programs() {
        let (language, right) = (language_of(&path).unwrap(), std::fs::read(&path).unwrap());
        let is_small = right.len() < 250 && language == Language::ThreeB;
        let digits = |at: &usize| right[*at].is_ascii_digit() && is_small;
        for at in (0..right.len()).filter(digits).step_by(by_day(6, 1)) {
            // One digit is another one.
            let mut bytes = right.clone();
            bytes[at] = if bytes[at] == b'9' {
                b'1'
            } else {
                bytes[at] + 1
            };
            let before = errors(language, &bytes, &settings);
            let program = program::Document::read(language, bytes.clone(), &settings);
            let wanted = |id: &str| {
                ["mirror.x", "rotate.left", "reverse"]
                    .iter()
                    .any(|wanted| id.ends_with(wanted))
            };
            for Proposal { id, edits, .. } in refactorings(&program, &settings, 0..0, wanted) {
                let Ok(edits) = edits else { continue };
                let now = errors(language, &applied(&bytes, &edits), &settings);
                if let Some(rule) = now.difference(&before).next() {
                    let text = String::from_utf8_lossy(&bytes);
                    spoiled.insert(format!("{id} brings {rule}:\n{text}"));
                }
            }
        }
    }
    let spoiled: Vec<String> = spoiled.into_iter().collect();
    assert!(spoiled.is_empty(), "{}", spoiled.join("\n"));
}
