//! Programs that were written under other settings than the drawing has now.

use super::changes::{lengths, line_of, with_number};
use super::shapes::{open, shape};
use super::{Case, Shape, document, program_of_some, settings_of, traced};
use proptest::prelude::*;
use std::ops::Range;
use wedm::beside::{Drawn, compare};
use wedm::drawing::Role;
use wedm::program::Format;

/// A drawing whose settings say a correction and no more, and what its program was written under beside that.
#[derive(Clone, Debug)]
struct Otherwise {
    case: Case,
    /// What holds for the drawing.
    now: String,
    /// The contours that are cut, in this order.
    handles: Option<Vec<String>>,
}

fn otherwise() -> impl Strategy<Value = Otherwise> {
    let of = |words: &[&'static str]| prop::sample::select(words.to_vec());
    let keys = (
        of(&["", "", "tab = 2.5", "tab = 1.2"]),
        of(&["", "", "direction = \"cw\"", "direction = \"as-drawn\""]),
        of(&["", "", "", "corner = \"intersection\""]),
        of(&["", "layout = \"checking\""]),
        of(&["", "", "", "closing-overlap = 1.5"]),
        of(&[
            "",
            "",
            "lead-in = 1.7",
            "lead = \"straight\"",
            "lead = \"arc\"",
        ]),
        of(&["", "", "order = \"nearest\"", "order = \"as-drawn\""]),
        of(&["", "", "compensation = \"controller\""]),
    );
    let corrections = prop::sample::select(vec![
        "correction = 0.1",
        "correction = 0.1",
        "correction = 0.137",
        "[passes]\ncorrections = [0.2, 0.15]",
        "[passes]\ncorrections = [0.2159, 0.1626, 0.1473, 0.1346]",
        "[passes]\ncorrections = [0.2, 0.16, 0.13]\nsequence = \"one-way\"",
    ]);
    let formats = prop::sample::select(vec![Format::ThreeB, Format::Iso, Format::FourB]);
    let profile = of(&["", "profile = \"fast-wire\"", "profile = \"robofil\""]);
    let handles = prop::option::of((0usize..3, prop::bool::ANY));
    let shapes = prop_oneof![5 => shape(), 1 => open()];
    (shapes, corrections, keys, formats, profile, handles).prop_map(
        |(shapes, corrections, keys, format, profile, handles)| {
            let (tab, direction, corner, layout, overlap, lead, order, compensation) = keys;
            let compensation = if format == Format::Iso {
                compensation
            } else {
                ""
            };
            let keys = [
                profile,
                tab,
                direction,
                corner,
                layout,
                overlap,
                lead,
                order,
                compensation,
            ];
            let handles = handles.map(|(first, two)| {
                let of = |index: usize| format!("{:X}", 42 + index % shapes.len());
                let mut all = vec![of(first)];
                all.extend((two && shapes.len() > 1).then(|| of(first + 1)));
                all
            });
            Otherwise {
                now: format!("correction = 0.1\n[program]\n{profile}\n"),
                case: Case {
                    shapes,
                    settings: format!("{corrections}\n[program]\n{}\n", keys.join("\n")),
                    format,
                },
                handles,
            }
        },
    )
}

/// What is wrong with what is said of one program, unchanged and with a change of each kind.
fn judge_otherwise(of: &Otherwise, picks: &[(f64, usize, bool)]) -> Vec<(&'static str, String)> {
    let Otherwise { case, now, handles } = of;
    let mut wrong: Vec<(&'static str, String)> = Vec::new();
    let [written, now] = [&case.settings, now].map(|text| settings_of(text));
    let made = document(&case.shapes, &written);
    let Some(text) = program_of_some(&made, case.format, handles.clone()) else {
        return wrong;
    };
    let drawn_of = |shapes: &[(Shape, Role)]| {
        let snapshot = document(shapes, &now).snapshot().unwrap();
        Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings)
    };
    let drawn = drawn_of(&case.shapes);
    let told = |drawn: &Drawn, text: &str| {
        compare(drawn, &traced(text, case.format, &now)).map(|found| found.differences)
    };
    let Some(whole) = compare(&drawn, &traced(&text, case.format, &now)) else {
        return vec![("nothing", format!("nothing is alike\n{text}"))];
    };
    if !whole.differences.is_empty() {
        return vec![("invented", format!("{:?}\n{text}", whole.differences))];
    }
    // How it was written is not known, and no block of it is compared with the drawing.
    if whole.follows.is_empty() {
        return vec![("nothing", format!("no block is known\n{text}"))];
    }
    let lines: Vec<&str> = text.lines().collect();
    let end = if text.contains("\r\n") { "\r\n" } else { "\n" };
    for &(share, _, is_more) in picks {
        let block = &whole.follows[(share * whole.follows.len() as f64) as usize];
        let line = line_of(&text, block.start);
        let mut expect =
            |kind, wrong_text: String, drawn: &Drawn, lines: Range<usize>, most: usize| {
                let found = told(drawn, &wrong_text);
                let at: Vec<usize> = found.iter().flatten().map(|found| found.line).collect();
                if at.is_empty() || at.len() > most || at.iter().any(|at| !lines.contains(at)) {
                    let kind = if at.is_empty() { "silent" } else { kind };
                    wrong.push((kind, format!("line {}: {found:?}\n{wrong_text}", line + 1)));
                }
            };
        let numbers = lengths(&text, block);
        let number = &numbers[(share * 7919.0) as usize % numbers.len()];
        if let Some(text) = with_number(&text, number, if is_more { 3 } else { -3 }) {
            expect("number", text, &drawn, line..line + 1, 1);
        }
        let with = |change: &dyn Fn(&mut Vec<&str>)| {
            let mut lines = lines.clone();
            change(&mut lines);
            lines.join(end) + end
        };
        let next = lines.get(line + 1).copied().unwrap_or_default();
        let is_block = |line: &str| line.contains(['B', 'X']) && !line.starts_with([';', '%']);
        if is_block(next) && next != lines[line] {
            let text = with(&|lines| lines.swap(line, line + 1));
            expect("exchanged", text, &drawn, line..line + 2, 2);
        }
        let text = with(&|lines| {
            lines.remove(line);
        });
        expect("lost", text, &drawn, line.saturating_sub(1)..line + 1, 1);
        let text = with(&|lines| lines.insert(line, lines[line]));
        expect("doubled", text, &drawn, line..line + 2, 1);
    }
    // A vertex of the first contour, where that is cut.
    if handles
        .as_ref()
        .is_none_or(|handles| handles.iter().any(|handle| handle == "2A"))
    {
        let mut shapes = case.shapes.clone();
        let mut moved = 0;
        if let Shape::Polyline(vertices) | Shape::Open(vertices) = &mut shapes[0].0 {
            moved = (picks[0].0 * vertices.len() as f64) as usize;
            vertices[moved][0] += 0.003;
        }
        let found = told(&drawn_of(&shapes), &text).unwrap_or_default();
        // Once in each pass.
        if !(1..=written.corrections.len()).contains(&found.len()) {
            wrong.push(("drawing", format!("vertex {moved}: {found:?}\n{text}")));
        }
    }
    wrong
}

/// Programs of which the drawing's settings do not know how they were written: nothing is reported about those that are unchanged, of a change
/// just its own line. `WEDM_CASES=500 cargo test --test core beside otherwise -- --nocapture` tells of each that is not so.
#[test]
fn programs_that_were_written_otherwise_are_known() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let count = std::env::var("WEDM_CASES").map_or(3, |count| count.parse().unwrap());
    let mut runner = TestRunner::deterministic();
    let pick = (0.0..1.0f64, 0usize..2, prop::bool::ANY);
    let strategy = (otherwise(), prop::collection::vec(pick, 2));
    let mut counts: std::collections::BTreeMap<&str, usize> = Default::default();
    for number in 0..count {
        let (of, picks) = strategy.new_tree(&mut runner).unwrap().current();
        if std::env::var("WEDM_CASE").is_ok_and(|only| only != number.to_string()) {
            continue;
        }
        for (kind, wrong) in judge_otherwise(&of, &picks) {
            let settings = of.case.settings.replace('\n', " ");
            println!(
                "==== {kind} case {number} {:?} {settings} {:?}\n{:?}\n{wrong}",
                of.case.format, of.handles, of.case.shapes
            );
            *counts.entry(kind).or_default() += 1;
        }
    }
    println!("wrong of {count}: {counts:?}");
    // Several passes under the control's own correction say too little of how they were written: then nothing is told of a change, rather
    // than something of what nobody changed.
    let of = |kind: &str| counts.get(kind).copied().unwrap_or(0);
    let wrong: usize = counts.values().sum();
    let silent = of("silent") + of("nothing");
    assert_eq!((of("invented"), of("number")), (0, 0), "{counts:?}");
    assert!(silent <= count, "{counts:?}");
    assert!(2 * (wrong - silent) <= count, "{counts:?}");
}
