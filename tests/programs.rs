//! Programs as files: the right ones are silent; in the wrong ones every fault is found at its line and column, and what can be
//! repaired safely is repaired.

#[path = "programs/passes.rs"]
mod passes;
#[path = "programs/refactorings.rs"]
mod refactorings;

use expect_test::expect_file;
use proptest::prelude::*;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use wedm::document::{Document, Source};
use wedm::finding::{Edit, Place, Rule, Severity};
use wedm::program::{self, Language};
use wedm::settings::{Effective, Layout};
use wedm::text::TextEdit;

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

proptest! {
    /// Whatever has been damaged, a repair repairs: after some rounds there is none left that would be made again and again.
    #[test]
    fn repairs_come_to_an_end(
        file in any::<prop::sample::Index>(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), prop::sample::select(&b"0159BGXYLNMD.- \n"[..])), 0..4),
    ) {
        let files = folder("wrong");
        let path = file.get(&files);
        let mut bytes = std::fs::read(path).unwrap();
        for (at, byte) in damage {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        let language = language_of(path).unwrap();
        let left = repaired(language, read(language, bytes.clone()));
        prop_assert!(
            left.fix_all().is_none(),
            "{}: {}",
            path.display(),
            String::from_utf8_lossy(&bytes)
        );
    }
}

#[test]
fn a_repair_whose_finding_survives_is_not_made() {
    for (language, text) in [
        (
            Language::ThreeB,
            "N1 B1000B0B1000GXL1\nN2 B0B1000B1000GYL2\nT84 N3 B1000B0B1000GXL3\nN4 B0B1000B1000GYL4\nDD\n",
        ),
        (
            Language::Iso,
            "%\nO1\nG21\nG90\nG92 X0 Y0\nG01 X10\nM98 P1\n",
        ),
    ] {
        let document = read(language, text.into());
        assert_eq!(document.fix_all(), None, "{text}");
    }
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
/// `UPDATE_EXPECT=1 cargo test --test core programs`.
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

/// The lines that cannot be read.
fn unread_lines(document: &mut Document) -> Vec<Range<usize>> {
    let findings = document.findings(usize::MAX).0;
    let unread = findings.iter().filter(|it| it.rule == Rule::Syntax);
    let start = |place: &Place| match place {
        Place::Text { range } => Some(range.start),
        _ => None,
    };
    let starts: Vec<usize> = unread.filter_map(|it| start(&it.place)).collect();
    let text = document.text().unwrap();
    let line = |at: usize| text.line_range(text.line_of(at));
    starts.into_iter().map(line).collect()
}

#[test]
fn every_fix_that_is_offered_repairs_and_makes_nothing_worse() {
    let mut failures: Vec<String> = Vec::new();
    for path in folder("wrong") {
        let bytes = std::fs::read(&path).unwrap();
        let mut document = read(language_of(&path).unwrap(), bytes.clone());
        let before = counts(&mut document);
        let unread = unread_lines(&mut document);
        for finding in document.findings(usize::MAX).0 {
            for fix in document.fixes(&finding) {
                let Edit::Text(edits) = fix.edit else {
                    panic!("a fix of a program edits its text")
                };
                // Of a line that cannot be read nothing is known to be a number.
                let is_in_unread = |edit: &TextEdit| {
                    let mut lines = unread.iter();
                    lines.any(|line| line.start < edit.range.end && edit.range.start < line.end)
                };
                if finding.rule != Rule::Syntax && edits.iter().any(is_in_unread) {
                    failures.push(format!(
                        "{}: {} by {:?} edits what cannot be read: {edits:?}",
                        path.display(),
                        finding.rule.name(),
                        fix.kind
                    ));
                }
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

#[test]
fn a_layout_changes_nothing_of_what_is_found() {
    let mut failures: Vec<String> = Vec::new();
    for path in folder("wrong").into_iter().chain(folder("right")) {
        let (language, bytes) = (language_of(&path).unwrap(), std::fs::read(&path).unwrap());
        let first = found(&mut read(language, bytes.clone()));
        for layout in LAYOUTS {
            let settings = Effective {
                stated_layout: Some(layout),
                ..Effective::default()
            };
            let document = program::Document::read(language, bytes.clone(), &settings);
            let lines = 0..document.text().line_count();
            let mut now = bytes.clone();
            for edit in program::format(&document, &settings, lines).iter().rev() {
                now.splice(edit.range.clone(), edit.text.bytes());
            }
            let then = found(&mut read(language, now));
            if then != first {
                failures.push(format!(
                    "{} as {layout:?}: {first:?} became {then:?}",
                    path.display()
                ));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// One slip in a sound program: what "fix all" makes of it is what was meant, or nothing where another slip explains as well what is seen.
#[test]
fn a_repair_is_made_only_where_no_other_is_as_plain() {
    const PADDED: &str = "B3000B800B003000GXL2\nBBB002750GYL2\nBBB003990GXL1\nB0B680B000680GYSR1\nBBB001250GYL4\nB1000B0B001000GXNR3\nBBB002330GXL1\nBBB006250GYL4\nBBB010740GXL3\nBBB005470GYL2\nBBB001780GXL1\nB0B960B000960GYNR4\nB3000B800B003000GXL4\nDD\n";
    const STATED: &str = "B2000B500B2000GXL2 ; -10.592 , 11.231\nB0B0B6175GYL4 ; -10.592 , 5.056\nB455B0B455GXNR3 ; -10.137 , 4.601\nB0B0B7075GXL1 ; -3.062 , 4.601\nB0B0B6630GYL2 ; -3.062 , 11.231\nB0B0B7530GXL3 ; -10.592 , 11.231\nB2000B500B2000GXL4 ; -8.592 , 10.731\nDD\n";
    const POINTED: &str = "G92 X0 Y0\nG90\nG01 X0.000 Y-1.500\nG01 X4.910 Y-1.500\nG03 X5.330 Y-1.080 I4.910 J-1.080\nG01 X5.330 Y4.830\nG01 X0.710 Y4.830\nG01 X0.710 Y7.740\nG01 X-2.100 Y7.740\nG03 X-2.560 Y7.280 I-2.100 J7.280\nG01 X-2.560 Y4.030\nG01 X-5.030 Y4.030\nG03 X-5.510 Y3.550 I-5.030 J3.550\nG01 X-5.510 Y-0.900\nG03 X-4.910 Y-1.500 I-4.910 J-0.900\nG01 X0.000 Y-1.500\nG01 X0.000 Y0.000\nM02\n";
    for (language, sound, meant, found) in [
        (Language::ThreeB, PADDED, "BBB003990", "BBB403990"),
        (Language::ThreeB, PADDED, "BBB010740", "BBB013740"),
        (Language::ThreeB, STATED, "B455B0B455", "B455B10B455"),
        (Language::Iso, POINTED, "X4.910 Y-1.500", "X.910 Y-1.500"),
        (Language::Iso, POINTED, "X-5.510 Y-0.900", "X-.510 Y-0.900"),
    ] {
        let wrong = sound.replacen(meant, found, 1);
        assert_ne!(wrong, sound);
        let repaired = repaired(language, read(language, wrong.clone().into_bytes()));
        let text = String::from_utf8_lossy(repaired.text().unwrap().bytes()).into_owned();
        assert!([sound, &wrong].contains(&&*text), "{found}:\n{text}");
    }
}
