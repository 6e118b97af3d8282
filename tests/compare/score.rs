//! How much of what was changed in a program is named at its block, and how much is named that nobody changed: counted
//! by family, each with a floor.
//!
//! Seeds are few by day; `WEDM_CASES=200 cargo test --test core compare::score -- --nocapture` takes more and prints
//! each miss.

use super::changes::{changed, lengths, line_of, with_number};
use super::shapes::shape;
use super::{Case, Shape, document, program_of, settings_of, traced};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use wedm::compare::{Drawn, compare};
use wedm::drawing::Role;
use wedm::program::Format;

/// What one family has come to.
#[derive(Default)]
struct Score {
    tried: usize,
    /// Named in the changed lines and nowhere else.
    there: usize,
    /// Named, but elsewhere or more than once.
    elsewhere: usize,
    silent: usize,
}

#[derive(Default)]
struct Board(BTreeMap<&'static str, Score>);

impl Board {
    /// A change in these lines, from 0; none at all where nobody changed anything.
    fn note(
        &mut self,
        family: &'static str,
        found: Option<&[usize]>,
        lines: Option<RangeInclusive<usize>>,
        text: &str,
    ) {
        let score = self.0.entry(family).or_default();
        score.tried += 1;
        let found = found.unwrap_or_default();
        let is_right = match &lines {
            None => found.is_empty(),
            Some(lines) => {
                !found.is_empty() && found.len() <= 2 && found.iter().all(|at| lines.contains(at))
            }
        };
        match (is_right, found.is_empty()) {
            (true, _) => score.there += 1,
            (false, true) => score.silent += 1,
            (false, false) => score.elsewhere += 1,
        }
        if !is_right && std::env::var("WEDM_CASES").is_ok() {
            println!("==== {family}: {found:?} for {lines:?}\n{text}");
        }
    }

    /// Another drawing: anything may be named, or nothing be alike.
    fn note_whole(&mut self, family: &'static str, found: Option<&[usize]>, text: &str) {
        let is_named = found.is_none_or(|found| !found.is_empty());
        let told = [0].get(..usize::from(is_named));
        self.note(family, told, Some(0..=0), text);
    }

    /// Fails where less than this share of a family is named right, in percent.
    fn holds(&self, floors: &[(&str, usize)]) {
        for (family, score) in &self.0 {
            println!(
                "{family:24} {:4} tried {:4} right {:3} elsewhere {:3} silent",
                score.tried, score.there, score.elsewhere, score.silent
            );
        }
        for (family, floor) in floors {
            let score = self.0.get(family).unwrap_or_else(|| panic!("no {family}"));
            assert!(
                100 * score.there >= floor * score.tried,
                "{family}: {} of {}",
                score.there,
                score.tried
            );
        }
    }
}

fn count(by_day: usize) -> usize {
    std::env::var("WEDM_CASES").map_or(by_day, |count| count.parse().unwrap())
}

/// Settings of many kinds, and a drawing.
fn case() -> impl Strategy<Value = Case> {
    let of = |words: &[&'static str]| prop::sample::select(words.to_vec());
    let corrections = of(&[
        "correction = 0.1",
        "correction = 0.155",
        "[passes]\ncorrections = [0.2159, 0.1626, 0.1473]",
        "[passes]\ncorrections = [0.2, 0.15]\nsequence = \"one-way\"",
        "[passes]\ncorrections = [0.215, 0.17, 0.14]\nskim-corner = \"constant-stock\"",
    ]);
    let keys = (
        of(&["", "tab = 2.5", "tab = 1.2"]),
        of(&[
            "direction = \"ccw\"",
            "direction = \"cw\"",
            "direction = \"as-drawn\"",
        ]),
        of(&["", "", "corner = \"intersection\""]),
        of(&[
            "layout = \"compact\"",
            "layout = \"checking\"",
            "layout = \"aligned\"",
        ]),
        of(&["", "closing-overlap = 1.5"]),
        of(&["", "lead-in = 1.7", "lead = \"arc\"", "lead = \"straight\""]),
        of(&["", "profile = \"fast-wire\"", "profile = \"robofil\""]),
        of(&["", "compensation = \"controller\""]),
        of(&[
            "",
            "order = \"nearest\"",
            "order = \"as-drawn\"",
            "jumps = \"none\"",
        ]),
    );
    let formats = prop::sample::select(vec![
        Format::ThreeB,
        Format::Iso,
        Format::FourB,
        Format::ThreeB,
    ]);
    (shape(), corrections, keys, formats).prop_map(|(shapes, corrections, keys, format)| {
        let (tab, direction, corner, layout, overlap, lead, profile, control, order) = keys;
        let control = if format == Format::Iso { control } else { "" };
        let lines = [
            tab, direction, corner, layout, overlap, lead, profile, control, order,
        ];
        Case {
            shapes,
            settings: format!("{corrections}\n[program]\n{}\n", lines.join("\n")),
            format,
        }
    })
}

fn drawn_of(shapes: &[(Shape, Role)], settings: &str) -> Drawn {
    let snapshot = document(shapes, &settings_of(settings)).snapshot().unwrap();
    Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings)
}

/// The drawing with one vertex of its outline moved in X, mm.
fn with_vertex(shapes: &[(Shape, Role)], share: f64, by: f64) -> Vec<(Shape, Role)> {
    let mut shapes = shapes.to_vec();
    if let Shape::Polyline(vertices) = &mut shapes[0].0 {
        let at = (share * vertices.len() as f64) as usize;
        vertices[at][0] += by;
    }
    shapes
}

fn is_block(line: &str) -> bool {
    line.contains(['B', 'X', 'Y']) && !line.starts_with([';', '%', '(']) && !line.contains("G92")
}

/// Lines changed in turn: one lost, doubled, or exchanged with the next.
fn with_lines(text: &str, change: impl Fn(&mut Vec<&str>)) -> String {
    let mut lines: Vec<&str> = text.split_inclusive('\n').collect();
    change(&mut lines);
    lines.concat()
}

/// The lines that are named; `None` where nothing is compared.
fn named(drawn: &Drawn, text: &str, case: &Case, settings: &str) -> Option<Vec<usize>> {
    let found = compare(drawn, &traced(text, case.format, &settings_of(settings)))?;
    Some(found.differences.iter().map(|one| one.line).collect())
}

/// A program that wedm writes, under the settings that it was written under.
#[test]
fn own_programs() {
    let mut runner = TestRunner::deterministic();
    let picks = prop::collection::vec((0.0..1.0f64, 0usize..2, prop::bool::ANY), 2);
    let strategy = (case(), picks);
    let mut board = Board::default();
    for _ in 0..count(12) {
        let (case, picks) = strategy.new_tree(&mut runner).unwrap().current();
        let Some(text) = program_of(
            &document(&case.shapes, &settings_of(&case.settings)),
            case.format,
        ) else {
            continue;
        };
        let drawn = drawn_of(&case.shapes, &case.settings);
        let told = |drawn: &Drawn, text: &str| named(drawn, text, &case, &case.settings);
        let about = |text: &str| format!("{:?} {}\n{text}", case.format, case.settings);
        let whole = compare(
            &drawn,
            &traced(&text, case.format, &settings_of(&case.settings)),
        );
        let unchanged: Option<Vec<usize>> = whole
            .as_ref()
            .map(|all| all.differences.iter().map(|one| one.line).collect());
        board.note(
            "own, unchanged",
            Some(unchanged.as_deref().unwrap_or(&[0])),
            None,
            &about(&text),
        );
        let lines: Vec<&str> = text.lines().collect();
        let blocks: Vec<usize> = (0..lines.len()).filter(|at| is_block(lines[*at])).collect();
        for &(share, axis, is_more) in &picks {
            let line = blocks[(share * blocks.len() as f64) as usize];
            let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
            let end = lines[line].find(';').unwrap_or(lines[line].len());
            let block = start..start + lines[line][..end].trim_end().len();
            let by = if is_more { 3 } else { -3 };
            let numbers = lengths(&text, &block);
            let number = numbers.get((share * 7919.0) as usize % numbers.len().max(1));
            if let Some(wrong) = number.and_then(|number| with_number(&text, number, by)) {
                board.note(
                    "own, a number by 3 µm",
                    told(&drawn, &wrong).as_deref(),
                    Some(line..=line),
                    &about(&wrong),
                );
            }
            if let Some(wrong) = changed(&text, &block, by, axis) {
                board.note(
                    "own, a block by 3 µm",
                    told(&drawn, &wrong).as_deref(),
                    Some(line..=line),
                    &about(&wrong),
                );
            }
            let lost = with_lines(&text, |all| {
                all.remove(line);
            });
            board.note(
                "own, a block lost",
                told(&drawn, &lost).as_deref(),
                Some(line.saturating_sub(1)..=line + 1),
                &about(&lost),
            );
            let doubled = with_lines(&text, |all| all.insert(line, all[line]));
            board.note(
                "own, a block twice",
                told(&drawn, &doubled).as_deref(),
                Some(line..=line + 1),
                &about(&doubled),
            );
            if lines
                .get(line + 1)
                .is_some_and(|next| is_block(next) && *next != lines[line])
            {
                let exchanged = with_lines(&text, |all| all.swap(line, line + 1));
                board.note(
                    "own, two exchanged",
                    told(&drawn, &exchanged).as_deref(),
                    Some(line..=line + 1),
                    &about(&exchanged),
                );
            }
        }
        let shapes = with_vertex(&case.shapes, picks[0].0, 0.05);
        let found = told(&drawn_of(&shapes, &case.settings), &text);
        board.note_whole("own, another drawing", found.as_deref(), &about(&text));
    }
    board.holds(&[
        ("own, unchanged", 100),
        ("own, a number by 3 µm", 98),
        ("own, a block by 3 µm", 98),
        ("own, a block lost", 95),
        ("own, a block twice", 95),
        ("own, two exchanged", 95),
        ("own, another drawing", 85),
    ]);
}

/// A program whose settings nobody knows any more: those in force have another correction, lead and direction.
#[test]
fn programs_of_others() {
    let mut runner = TestRunner::deterministic();
    let picks = prop::collection::vec((0.0..1.0f64, 0usize..2, 20i64..200, prop::bool::ANY), 2);
    let strategy = (case(), picks);
    let mut board = Board::default();
    for _ in 0..count(12) {
        let (case, picks) = strategy.new_tree(&mut runner).unwrap().current();
        let Some(text) = program_of(
            &document(&case.shapes, &settings_of(&case.settings)),
            case.format,
        ) else {
            continue;
        };
        let settings = "correction = 0.125\n[program]\nlead-in = 2.3\n";
        let drawn = drawn_of(&case.shapes, settings);
        let about = |text: &str| format!("{:?} {}\n{text}", case.format, case.settings);
        let Some(whole) = compare(&drawn, &traced(&text, case.format, &settings_of(settings)))
        else {
            board.note("foreign, unchanged", Some(&[0]), None, &about(&text));
            continue;
        };
        let lines: Vec<usize> = whole.differences.iter().map(|one| one.line).collect();
        board.note(
            "foreign, unchanged",
            Some(&lines),
            None,
            &format!("{:?}\n{}", whole.differences, about(&text)),
        );
        if !lines.is_empty() || whole.follows.is_empty() {
            continue;
        }
        // Between two others of its contour: the ends of a pass may overlap, and a lead is not judged.
        let lines: Vec<usize> = whole
            .follows
            .iter()
            .map(|block| line_of(&text, block.start))
            .collect();
        let is_between =
            |at: &usize| lines.contains(&(at + 1)) && lines.contains(&(at.wrapping_sub(1)));
        let inner: Vec<usize> = (0..lines.len())
            .filter(|at| is_between(&lines[*at]))
            .collect();
        for &(share, axis, by, is_more) in &picks {
            let Some(&at) = inner.get((share * inner.len() as f64) as usize) else {
                continue;
            };
            let (block, line) = (&whole.follows[at], lines[at]);
            let by = if is_more { by } else { -by };
            if let Some(wrong) = changed(&text, block, by, axis) {
                let found = named(&drawn, &wrong, &case, settings);
                board.note(
                    "foreign, a block",
                    found.as_deref(),
                    Some(line.saturating_sub(1)..=line + 1),
                    &about(&wrong),
                );
            }
            let lost = with_lines(&text, |all| {
                all.remove(line);
            });
            let found = named(&drawn, &lost, &case, settings);
            board.note(
                "foreign, a block lost",
                found.as_deref(),
                Some(line.saturating_sub(1)..=line + 1),
                &about(&lost),
            );
        }
        let shapes = with_vertex(&case.shapes, picks[0].0, 0.5);
        let found = named(&drawn_of(&shapes, settings), &text, &case, settings);
        board.note_whole("foreign, other drawing", found.as_deref(), &about(&text));
    }
    board.holds(&[
        ("foreign, unchanged", 100),
        ("foreign, a block", 80),
        ("foreign, a block lost", 75),
        ("foreign, other drawing", 85),
    ]);
}
