//! Programs as files: the right ones are silent; in the wrong ones every fault is found at its line and column, and what can be
//! repaired safely is repaired.

#[path = "programs/refactorings.rs"]
mod refactorings;

use expect_test::expect_file;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use wedm::document::{Document, Source};
use wedm::finding::{Edit, Place, Severity};
use wedm::program::{self, Language};
use wedm::settings::{Effective, Layout};

fn folder(name: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data/programs")
        .join(name);
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.retain(|path| language_of(path).is_some());
    files.sort();
    files
}

fn open(path: &Path) -> Document {
    read(language_of(path).unwrap(), std::fs::read(path).unwrap())
}

fn language_of(path: &Path) -> Option<Language> {
    Language::of_ending(path.extension()?.to_str()?)
}

fn read(language: Language, bytes: Vec<u8>) -> Document {
    let settings = Arc::new(Effective::default());
    Document::new(
        Source::Program(program::Document::read(language, bytes, &settings)),
        settings,
    )
}

/// `LINE:COLUMN severity rule` of every finding, in the order of the text.
fn said(document: &mut Document) -> Vec<String> {
    let (findings, _) = document.findings(usize::MAX);
    let text = document.text().unwrap().clone();
    let mut said: Vec<(usize, usize, String)> = findings
        .iter()
        .map(|finding| {
            let Place::Text { range } = &finding.place else {
                panic!("{finding:?} has no place")
            };
            let line = text.line_of(range.start);
            let column = range.start - text.line_start(line) + 1;
            let severity = format!("{:?}", finding.severity).to_lowercase();
            (
                line,
                column,
                format!("{}:{column} {severity} {}", line + 1, finding.rule.name()),
            )
        })
        .collect();
    said.sort();
    said.into_iter().map(|(_, _, row)| row).collect()
}

/// The text after every safe fix, made again and again until there is none left.
fn repaired(language: Language, mut document: Document) -> Document {
    for _ in 0..12 {
        let Some(Edit::Text(edits)) = document.fix_all() else {
            break;
        };
        let mut bytes = document.text().unwrap().bytes().to_vec();
        for edit in edits.iter().rev() {
            bytes.splice(edit.range.clone(), edit.text.bytes());
        }
        document = read(language, bytes);
    }
    document
}

#[test]
fn right_programs_are_silent() {
    for path in folder("right") {
        let mut document = open(&path);
        let (findings, _) = document.findings(usize::MAX);
        let worse: Vec<_> = findings
            .iter()
            .filter(|finding| finding.severity < Severity::Information)
            .collect();
        assert!(worse.is_empty(), "{}: {worse:?}", path.display());
        let blocks = document
            .program()
            .unwrap()
            .trace()
            .steps
            .iter()
            .filter(|step| step.moves())
            .count();
        let is_fragment = blocks == 1;
        assert!(
            findings.is_empty() || is_fragment,
            "{}: {findings:?}",
            path.display()
        );
        assert!(
            document.fix_all().is_none() || is_fragment,
            "{}",
            path.display()
        );
    }
}

/// What is said of each stands beside it, and that nothing is left to say where "fix all" has an answer to all. Update it with
/// `UPDATE_EXPECT=1 cargo test --test programs`.
#[test]
fn every_fault_of_wrong_programs_is_found_at_its_place() {
    for path in folder("wrong") {
        let mut document = open(&path);
        let mut rows = said(&mut document);
        let mut repaired = repaired(language_of(&path).unwrap(), document);
        if said(&mut repaired).is_empty() {
            rows.push("fixed: clean".to_owned());
        }
        expect_file![path.with_extension("expected")].assert_eq(&(rows.join("\n") + "\n"));
    }
}

/// How often each rule has something to say.
fn counts(document: &mut Document) -> std::collections::BTreeMap<&'static str, usize> {
    let mut counts = std::collections::BTreeMap::new();
    for finding in document.findings(usize::MAX).0 {
        *counts.entry(finding.rule.name()).or_default() += 1;
    }
    counts
}

#[test]
fn every_fix_that_is_offered_repairs_and_makes_nothing_worse() {
    let mut failures: Vec<String> = Vec::new();
    for path in folder("wrong") {
        let bytes = std::fs::read(&path).unwrap();
        let mut document = read(language_of(&path).unwrap(), bytes.clone());
        let before = counts(&mut document);
        for finding in document.findings(usize::MAX).0 {
            for fix in document.fixes(&finding) {
                let Edit::Text(edits) = fix.edit else {
                    panic!("a fix of a program edits its text")
                };
                let mut repaired = bytes.clone();
                for edit in edits.iter().rev() {
                    repaired.splice(edit.range.clone(), edit.text.bytes());
                }
                let mut repaired = read(language_of(&path).unwrap(), repaired);
                let after = counts(&mut repaired);
                let rule = finding.rule.name();
                let is_less = after.get(rule).copied().unwrap_or(0) < before[rule];
                let worse = after
                    .iter()
                    .filter(|(rule, count)| **count > before.get(*rule).copied().unwrap_or(0));
                let worse: Vec<_> = worse.collect();
                if !is_less || !worse.is_empty() {
                    let text =
                        String::from_utf8_lossy(repaired.text().unwrap().bytes()).into_owned();
                    failures.push(format!(
                        "{}: {rule} by {:?}: {before:?} became {after:?}\n{text}",
                        path.display(),
                        fix.kind
                    ));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

const LAYOUTS: [Layout; 3] = [Layout::Compact, Layout::Aligned, Layout::Checking];

/// As often as each rule is found, with its severity.
fn found(document: &mut Document) -> Vec<(&'static str, Severity)> {
    let (findings, _) = document.findings(usize::MAX);
    let mut found: Vec<_> = findings
        .iter()
        .map(|finding| (finding.rule.name(), finding.severity))
        .collect();
    found.sort();
    found
}

/// End points in the text are evidence: one that a layout adds must not hide a fault, nor one that it leaves out.
#[test]
fn a_layout_changes_nothing_of_what_is_found() {
    let mut failures: Vec<String> = Vec::new();
    for path in folder("wrong").into_iter().chain(folder("right")) {
        let language = language_of(&path).unwrap();
        let (first, bytes) = (found(&mut open(&path)), std::fs::read(&path).unwrap());
        for one in LAYOUTS {
            // What a layout has left or added is there for the next.
            for two in LAYOUTS {
                let mut now = bytes.clone();
                for layout in [one, two] {
                    let settings = Effective {
                        stated_layout: Some(layout),
                        ..Effective::default()
                    };
                    let document = program::Document::read(language, now.clone(), &settings);
                    let lines = 0..document.text().line_count();
                    let edits = program::format(&document, &settings, lines);
                    for edit in edits.iter().rev() {
                        now.splice(edit.range.clone(), edit.text.bytes());
                    }
                    let then = found(&mut read(language, now.clone()));
                    if then != first {
                        failures.push(format!(
                            "{} as {one:?}, {two:?}: {first:?} became {then:?}",
                            path.display()
                        ));
                    }
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
