//! Programs of random drawings, with one block changed.

use super::changes::{changed, lengths, line_of, with_number};
use super::shapes::shape;
use super::{Case, document, program_of, settings_of, traced};
use proptest::prelude::*;
use wedm::beside::{Drawn, compare};
use wedm::program::Format;

fn case() -> impl Strategy<Value = Case> {
    let of = |words: &[&'static str]| prop::sample::select(words.to_vec());
    let corrections = prop::sample::select(vec![
        "correction = 0.1",
        "correction = 0.155",
        "[passes]\ncorrections = [0.2159, 0.1626, 0.1473]",
        "[passes]\ncorrections = [0.2, 0.15]\nsequence = \"one-way\"",
        "[passes]\ncorrections = [0.215, 0.17, 0.14]\nskim-corner = \"constant-stock\"",
    ]);
    let keys = (
        of(&["", "tab = 2.5"]),
        of(&[
            "direction = \"ccw\"",
            "direction = \"cw\"",
            "direction = \"as-drawn\"",
        ]),
        of(&["", "", "corner = \"intersection\""]),
        of(&["layout = \"compact\"", "layout = \"checking\""]),
        of(&["", "closing-overlap = 1.5"]),
        of(&["", "lead-in = 1.7"]),
        of(&["", "profile = \"fast-wire\"", "profile = \"robofil\""]),
        of(&["", "compensation = \"controller\""]),
    );
    let formats = prop::sample::select(vec![
        Format::ThreeB,
        Format::Iso,
        Format::FourB,
        Format::ThreeB,
    ]);
    (shape(), corrections, keys, formats).prop_map(|(shapes, corrections, keys, format)| {
        let (tab, direction, corner, layout, overlap, lead, profile, compensation) = keys;
        let compensation = if format == Format::Iso {
            compensation
        } else {
            ""
        };
        let lines = [
            tab,
            direction,
            corner,
            layout,
            overlap,
            lead,
            profile,
            compensation,
        ];
        Case {
            shapes,
            settings: format!("{corrections}\n[program]\n{}\n", lines.join("\n")),
            format,
        }
    })
}

/// What is wrong with what is said of a case, by one block changed.
fn judge(case: &Case, picks: &[(f64, usize, bool)]) -> Result<(), String> {
    let settings = settings_of(&case.settings);
    let document = document(&case.shapes, &settings);
    let Some(text) = program_of(&document, case.format) else {
        return Ok(());
    };
    let snapshot = document.snapshot().unwrap();
    let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
    let whole = compare(&drawn, &traced(&text, case.format, &settings));
    let Some(whole) = whole else {
        return Err(format!("nothing is alike\n{text}"));
    };
    if !whole.differences.is_empty() {
        return Err(format!("invented: {:?}\n{text}", whole.differences));
    }
    for &(share, axis, is_more) in picks {
        let block = &whole.follows[(share * whole.follows.len() as f64) as usize];
        let by = if is_more { 3 } else { -3 };
        let numbers = lengths(&text, block);
        let number = &numbers[(share * 7919.0) as usize % numbers.len()];
        let both = [
            changed(&text, block, by, axis),
            with_number(&text, number, by),
        ];
        for wrong in both.into_iter().flatten() {
            let found = compare(&drawn, &traced(&wrong, case.format, &settings));
            let lines = found.iter().flat_map(|found| &found.differences);
            let lines: Vec<usize> = lines.map(|found| found.line).collect();
            let line = line_of(&text, block.start);
            if lines != [line] {
                let found = found.map(|found| found.differences);
                return Err(format!(
                    "line {} changed, told: {found:?}\n{wrong}",
                    line + 1
                ));
            }
        }
    }
    Ok(())
}

/// Many programs and one changed block in each, the same ones at every run: nothing is reported about those that are unchanged, and of a change
/// just its own line. `WEDM_CASES=500 cargo test --test core beside -- --nocapture` tells of each that is not so, `WEDM_CASE=22` of one alone.
#[test]
fn one_changed_block_is_named_and_no_other() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let count = std::env::var("WEDM_CASES").map_or(8, |count| count.parse().unwrap());
    let mut runner = TestRunner::deterministic();
    let pick = (0.0..1.0f64, 0usize..2, prop::bool::ANY);
    let strategy = (case(), prop::collection::vec(pick, 4));
    let (mut invented, mut missed) = (0, 0);
    for number in 0..count {
        let (case, picks) = strategy.new_tree(&mut runner).unwrap().current();
        if std::env::var("WEDM_CASE").is_ok_and(|only| only != number.to_string()) {
            continue;
        }
        let Err(wrong) = judge(&case, &picks) else {
            continue;
        };
        let settings = case.settings.replace('\n', " ");
        println!(
            "==== case {number} {:?} {settings}\n{:?}\n{wrong}",
            case.format, case.shapes
        );
        match wrong.starts_with("line ") {
            true => missed += 1,
            false => invented += 1,
        }
    }
    println!("{invented} invented and {missed} missed of {count}");
    assert_eq!((invented, missed), (0, 0));
}
