//! An edited text reads as the same text from scratch, and a fault is found wherever the text is divided
//! into cuts.

use super::*;
use proptest::prelude::*;

/// Checks that an edited document is the same as its text read from scratch.
fn assert_as_afresh(document: &Document, what: &str) -> Document {
    let fresh = Document::read(document.text().bytes().to_vec());
    assert_eq!(document.reading(), fresh.reading(), "{what}");
    assert_eq!(document.findings(), fresh.findings(), "{what}");
    assert_eq!(document.trace(), fresh.trace(), "{what}");
    fresh
}

#[test]
fn lines_that_name_places_do_not_move_with_what_stands_before_them() {
    // Steps move with the text before them, places do not: where one replaces the other, all is read again.
    for steps in (150..290).step_by(7) {
        let places = (0..100).map(|line| format!("G01 X{line} Y{}\n", line % 7));
        let text = format!(
            "G92 X0 Y0\nG91\n{}G90\n{}M02\n",
            "G01 X3 Y1\n".repeat(steps),
            places.collect::<String>()
        );
        let mut document = read(&text);
        let at = document.text().line_start(5) + "G01 X".len();
        document.edit(at..at, "1");
        assert_as_afresh(&document, &format!("{steps} steps"));
    }
}

#[test]
fn a_contour_has_the_findings_of_its_moves_wherever_it_lies_and_however_its_centres_are_given() {
    // Each has a bow that goes through the wall opposite; the wire enters the later ones far from the origin.
    let told = |is_absolute: bool| {
        let contour = |x: i32| {
            let (i, j) = if is_absolute { (x + 10, 2) } else { (-4, 0) };
            format!(
                "G00 X{x}. Y0.\nG01 X{}.\nY10.\nX{}.\nY2.\nG02 X{}. I{i}. J{j}.\nG01 Y10.\nX{x}.\nY0.\n",
                x + 20,
                x + 14,
                x + 6
            )
        };
        let contours = [0, 100, 200, 300].map(contour).join("M00\n");
        let text = format!("G92 X0. Y0.\nG90\n{contours}M02\n");
        let mut document = read(&text);
        let first = document.findings();
        // One more line before them: they are taken on.
        document.edit(0..0, "(plate)\n");
        assert_as_afresh(&document, "with a line before");
        (faults(&text, &Effective::default()), first.len())
    };
    let expected = [6, 16, 26, 36].map(|line| (line + 2, "path-crosses-itself"));
    assert_eq!(told(true), (expected.to_vec(), 4));
    assert_eq!(told(false), (expected.to_vec(), 4));
}

#[test]
fn a_place_behind_a_line_that_cannot_be_read_does_not_move_with_what_stands_before_it() {
    // The wire's position is not known before it, so it makes no move; still it says where the wire is.
    let steps = "G01 X3. Y1.\n".repeat(30);
    for place in (0..60).step_by(7) {
        let comments = "(plate)\n".repeat(place);
        let text = format!(
            "G92 X0 Y0\nG91\n{steps}G90\n{comments}X#1\n{comments}G01 X40. Y9.\nG91\n{steps}M02\n"
        );
        let mut document = read(&text);
        let at = document.text().line_start(5) + "G01 X".len();
        document.edit(at..at, "1");
        assert_as_afresh(&document, &format!("{place} lines between"));
    }
}

#[test]
fn a_line_that_leads_too_far_in_one_unit_only_is_read_as_if_afresh() {
    let steps = "G01 X3. Y1.\n".repeat(30);
    for place in (0..60).step_by(7) {
        let comments = "(plate)\n".repeat(place);
        let text = format!(
            "G21\nG92 X0 Y0\nG91\n{steps}{comments}G01 X500000. Y0\n{steps}{comments}G90 G01 X40. Y9.\n{steps}M02\n"
        );
        let mut document = read(&text);
        document.edit(1..3, "20");
        assert_as_afresh(&document, &format!("{place} lines between, in inches"));
        let at = document.text().line_start(5) + "G01 X".len();
        document.edit(at..at, "9999999");
        assert_as_afresh(&document, &format!("{place} lines between, from far away"));
        document.edit(1..3, "21");
        assert_as_afresh(&document, &format!("{place} lines between, in mm"));
    }
}

#[test]
fn what_stands_before_the_first_tape_mark_is_passed_over_however_the_text_was_edited() {
    let cuts = "G01 X3. Y1.\n".repeat(60);
    for remark in [
        "PLATE 7 X 9 MM",
        "WIRE .25; 2 PASSES",
        "<A>\nN5 R#1 OF 2",
        "G90",
    ] {
        for lines in [0, 1, 30, 70] {
            let leader = format!("{remark}\n{}", "\n".repeat(lines));
            let text = format!("{leader}%\nG92 X0 Y0\nG91\n{cuts}M02\n%\n");
            let mut document = read(&text);
            let is_near = text.lines().position(|line| line == "%") < Some(64);
            let is_of_leader = |finding: &crate::finding::Finding| matches!(&finding.place, crate::finding::Place::Text { range } if range.start < leader.len());
            let is_said = document.findings().iter().any(is_of_leader);
            assert_eq!(is_said, !is_near && remark != "G90", "{text}");
            assert_eq!(
                document
                    .trace()
                    .steps
                    .iter()
                    .filter(|step| step.moves())
                    .count(),
                60
            );
            let tape = leader.len();
            document.edit(tape..tape + 1, "");
            assert_as_afresh(&document, "without the mark");
            document.edit(tape..tape, "%");
            assert_as_afresh(&document, "with it again");
            document.edit(tape..tape, "G01 X5.\n");
            assert_as_afresh(&document, "behind a cut");
            document.edit(tape..tape + 8, "");
            document.edit(0..0, "ANOTHER LINE\n");
            assert_as_afresh(&document, "a line more");
            document.edit(0..1, "");
            let fresh = assert_as_afresh(&document, "a letter less");
            let edits = crate::program::iso::format(
                fresh.text(),
                Some(crate::settings::Layout::Compact),
                0..fresh.text().line_count(),
            );
            let leader = fresh.text().line_start(fresh.leader());
            assert!(
                edits.iter().all(|edit| edit.range.start >= leader),
                "{text}"
            );
        }
    }
}

#[test]
fn the_first_centre_that_does_not_tell_is_where_it_is_however_the_text_was_edited() {
    // The first line with I and J follows one that cannot be read, so its arc is not known.
    for place in 0..60 {
        let comments = "(plate)\n".repeat(place);
        let text = format!(
            "G92 X10. Y0\nG90\n{comments}X\nG03 X0. Y0. I-5. J0.\n{comments}G03 X0. Y0. I-5. J0.\nM02\n"
        );
        let mut document = read(&text);
        document.edit(12..12, "\n");
        let fresh = assert_as_afresh(&document, &format!("{place} lines between"));
        let is_open = |finding: &crate::finding::Finding| {
            finding.rule == crate::finding::Rule::AmbiguousCenter
        };
        assert!(
            fresh.findings().iter().any(is_open),
            "{place} lines between"
        );
    }
}

#[test]
fn a_cut_with_a_line_that_cannot_be_read_is_not_judged_wherever_the_text_falls_apart() {
    for place in 0..60 {
        let comments = "(plate)\n".repeat(place);
        let text = format!(
            "G92 X0 Y0\nG90\n{comments}G01 X10. Y0.\nG01 X10. Y10.\n(open\nG01 X5. Y-5.\nG01 X0. Y0.\nM02\n"
        );
        let found = rules(&text);
        assert!(found.contains(&"syntax"), "{place} lines before: {found:?}");
        assert!(
            !found.contains(&"path-crosses-itself"),
            "{place} lines before: {found:?}"
        );
    }
    let sound = "G92 X0 Y0\nG90\nG01 X10. Y0.\nG01 X10. Y10.\nG01 X5. Y-5.\nG01 X0. Y0.\nM02\n";
    assert!(
        rules(sound).contains(&"path-crosses-itself"),
        "{:?}",
        rules(sound)
    );
}

#[test]
fn a_spur_before_a_doubled_block_is_one() {
    for doubled in ["", "G01 X1. Y5.\n"] {
        let text = format!(
            "G92 X0 Y0\nG90\nG01 X1. Y0.\nG01 X1. Y5.\nG01 X3. Y2.\nG01 X1. Y5.\n{doubled}G01 X-4. Y1.\nG01 X0. Y0.\nM02\n"
        );
        let found = rules(&text);
        assert!(found.contains(&"spur"), "{text}{found:?}");
    }
}

#[test]
fn what_a_joint_looks_at_behind_many_comments_is_looked_at_again() {
    // Whether the way goes back on itself is decided by the next block, which may be many
    // lines further on.
    for before in (0..50).step_by(7) {
        for between in 0..62 {
            let text = format!(
                "G92 X0 Y0\nG90\n{}G01 X1. Y0.\nG01 X1. Y5.\nG01 X3. Y2.\nG01 X1. Y5.\n{}G01 X-4. Y1.\nM02\n",
                "(plate)\n".repeat(before),
                "(plate)\n".repeat(between),
            );
            let mut document = read(&text);
            let at = text.find("X-4. Y1.").unwrap();
            document.edit(at..at + 8, "X1. Y0.");
            assert_as_afresh(&document, &format!("{before} {between}"));
        }
    }
}

#[test]
fn what_i_and_j_mean_does_not_turn_with_each_edit() {
    // Whether there is a corner before the arc depends on what its I and J mean.
    for arc in [
        "G02 X20. Y0. I15. J0.",
        "G02 X20. Y0. I5. J0.",
        "G02 X20. Y0. I-5. J0.",
    ] {
        let text = format!(
            "G92 X0 Y0\nG90\nG01 X10. Y0. R1.\n{arc}\nG01 X20. Y-10.\nG01 X0. Y-10.\nG01 X0. Y0.\nM02\n"
        );
        let mut document = read(&text);
        for edit in 0..4 {
            let at = document.text().line_range(6).end;
            document.edit(at..at, " ");
            assert_as_afresh(&document, &format!("{arc}, edit {edit}"));
        }
    }
}

/// The names of the rules that find something in a text.
fn rules(text: &str) -> Vec<&'static str> {
    let findings = read(text).findings();
    findings.iter().map(|finding| finding.rule.name()).collect()
}

/// Lines of programs, some of them damaged.
fn line() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => (prop::sample::select(vec!["G01 ", "G00 ", "", "N5 G01 "]), -50_i32..50, -50_i32..50).prop_map(|(g, x, y)| format!("{g}X{x} Y{y}")),
        3 => (-50_i32..50, -50_i32..50).prop_map(|(i, j)| format!("G02 X{} Y0 I{i} J{j}", 2 * i)),
        2 => (-50_i32..50).prop_map(|x| format!("G01 X{x}.5")),
        1 => prop::sample::select(vec![
            "G90", "G91", "G92 X0 Y0", "G41 D1", "G42", "G40", "M00", "M02", "G20", "X1 Y", "(comment)", "", "G28 X0", "T84", "G03 X5 Y5 J5", "M30", "%", "#1=5.", "#1=-2", "X#1", "Y-[#1+3.]", "G90.1", "G91.1", "GOTO1", "J2.5 R4",
            "G03 X0 Y0 I5", "R5 G02 X5", "H1=80", "X#1", "G01 Z-3", "Z-2 X5",
            "G01 X9. Y0. R1.", "G02 X30. Y0. I15. J0.", "G03 X20. Y4. I10. J0. ,R2.", "X4. ,C1.", "Y[1]", "#1=4", "STOP", "G#1 X2",
        ])
        .prop_map(str::to_owned),
        1 => "[GXYIJN0-9. (;%/-]{0,8}",
    ]
}

/// A closed contour with its good or bad details: compensation, a rounded corner, a crossing, numbers.
fn contour() -> impl Strategy<Value = String> {
    let size = 300_i32..2000;
    (size, 20_i32..250, prop::sample::select(vec!["", "G41 D1\n", "G42 H1\n"]), any::<bool>(), prop::bool::weighted(0.1)).prop_map(
        |(size, radius, side, is_turned, crosses)| {
            let (a, b) = if is_turned { ("Y", "X") } else { ("X", "Y") };
            let corner = if is_turned { format!("G02 Y{radius} X{radius} I{radius}") } else { format!("G03 X{radius} Y{radius} J{radius}") };
            let rest = size - radius;
            let long = if crosses { 3 * size } else { rest };
            let back = if crosses { format!("G01 {a}-100 {b}-{size}\nG01 {b}-{}\nG01 {a}100\n", long - size - 100) } else { String::new() };
            format!(
                "{side}G01 {a}-{size}\nG01 {a}{size}\n{corner}\nG01 {b}{long}\nG01 {a}-{size}\n{back}G01 {b}-{size}\nG01 {a}{rest}\nG40\nG00 X5000\n"
            )
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]
    #[test]
    fn an_edit_among_passes_leaves_them_as_read_afresh(
        rounds in prop::collection::vec((prop::sample::select(vec!["10.", "10.", "10.", "9.9", "40."]), 0_usize..12), 60..110),
        edits in prop::collection::vec((0_usize..5000, 0_usize..3, prop::sample::select(vec!["", "5", "1", "\n", "X", "G01 X-3. Y2.\n", "G03 X0. Y0. I-5. J0.\n"])), 1..4),
    ) {
        // Some of the squares cross themselves.
        let round = |(side, kind): &(&str, usize)| match kind {
            0 => format!("G01 X{side} Y0.\nG01 X0. Y{side}\nG01 X{side} Y{side}\nG01 X0. Y0.\n"),
            1 => format!("G01 X{side} Y0.\nG02 X{side} Y{side} I0. J5.\nG01 X0. Y{side}\nG01 X0. Y0.\n"),
            _ => format!("G01 X{side} Y0.\nG01 X{side} Y{side}\nG01 X0. Y{side}\nG01 X0. Y0.\n"),
        };
        let text: String = rounds.iter().map(round).collect();
        let mut document = read(&format!("G90\nG92 X0. Y0.\n{text}M02\n"));
        for (start, length, replacement) in edits {
            document.edit(start..start + length, replacement);
            let fresh = Document::read(document.text().bytes().to_vec());
            prop_assert_eq!(document.plain_findings(), fresh.plain_findings());
        }
    }
}

proptest! {
    #[test]
    fn an_edited_document_is_the_one_read_afresh(
        lines in prop::collection::vec(line(), 0..700),
        edits in prop::collection::vec((0_usize..8000, 0_usize..12, prop::collection::vec(line(), 0..3)), 1..5),
        with_calls in prop::bool::weighted(0.05),
    ) {
        let mut document = read(&lines.join("\n"));
        for (start, length, replacement) in edits {
            let mut replacement = replacement.join("\n");
            if with_calls {
                replacement += "\nM98 P5\n";
            }
            document.edit(start..start + length, &replacement);
            let fresh = Document::read(document.text().bytes().to_vec());
            prop_assert_eq!(document.text(), fresh.text());
            prop_assert_eq!(document.reading(), fresh.reading());
            prop_assert_eq!(document.findings(), fresh.findings());
            prop_assert_eq!(document.trace(), fresh.trace());
        }
    }

    #[test]
    fn an_edit_among_sound_contours_leaves_them_as_read_afresh(
        contours in prop::collection::vec(contour(), 1..60),
        edits in prop::collection::vec((0_usize..6000, 0_usize..3, prop::sample::select(vec!["", "5", "1", "\n", "G90 ", "M00\n", "H1=2000\n", "X", "G01 Z-9\n"])), 1..6),
        side in prop::sample::select(vec!["auto", "opening", "punch"]),
    ) {
        let settings = crate::settings::Effective::of(&crate::settings::from_toml(&format!("side = \"{side}\"\n")).0);
        let mut document = read(&format!("G91\n{}M02\n", contours.concat()));
        document.set_settings(&settings);
        for (start, length, replacement) in edits {
            document.edit(start..start + length, replacement);
            let fresh = Document::read_with(document.text().bytes().to_vec(), &settings);
            prop_assert_eq!(document.findings(), fresh.findings());
            prop_assert_eq!(document.trace(), fresh.trace());
        }
    }

    #[test]
    fn an_edit_among_long_contours_leaves_them_as_read_afresh(
        contours in prop::collection::vec((1_i32..30, any::<bool>(), prop::sample::select(vec!["", "M00\n", "M00\nM00\n", "G41 D1\n"])), 1..24),
        edits in prop::collection::vec((0_usize..20_000, 0_usize..3, prop::sample::select(vec!["", "5", "1", "\n", "M00\n", "G42 D1\n", "X", "G91\n", "H1=80\n"])), 1..6),
    ) {
        // Squares in steps of 1 mm: of some the way is long.
        let contour = |(nth, (steps, is_relative, before)): (usize, &(i32, bool, &str))| {
            let begin = 40 * nth as i32;
            let mut text = format!("G90\n{before}G00 X{begin}. Y0.\n{}\n", if *is_relative { "G91" } else { "G90" });
            let mut at = [0, 0];
            for [x, y] in [[1, 0], [0, 1], [-1, 0], [0, -1]] {
                for _ in 0..*steps {
                    at = [at[0] + x, at[1] + y];
                    let [x, y] = if *is_relative { [x, y] } else { [begin + at[0], at[1]] };
                    text += &format!("G01 X{x}. Y{y}.\n");
                }
            }
            text
        };
        let mut document = read(&(contours.iter().enumerate().map(contour).collect::<String>() + "M02\n"));
        for (start, length, replacement) in edits {
            document.edit(start..start + length, replacement);
            let fresh = Document::read(document.text().bytes().to_vec());
            prop_assert_eq!(document.findings(), fresh.findings());
            prop_assert_eq!(document.trace(), fresh.trace());
        }
    }

    #[test]
    fn any_bytes_are_read(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let document = Document::read(bytes);
        let trace = document.trace();
        prop_assert!(document.findings().iter().all(|finding| !finding::sentence(finding, 1.0).is_empty()));
        prop_assert!(trace.steps.iter().all(|step| step.range.end <= document.text().len()));
    }
}

#[test]
fn a_line_that_cannot_be_read_says_nothing_of_a_cut_that_was_over_before_it() {
    // However far apart the two are.
    for lines_between in [0, 400] {
        let text = format!(
            "G92 X0 Y0\nG01 X10. Y0\nG01 X10. Y10.\nG01 X3. Y10.\nG28 X0\nG00 X5. Y5.\n{}X- Y\nM02\n",
            "(plate)\n".repeat(lines_between)
        );
        let is_open =
            |finding: &crate::finding::Finding| finding.rule == crate::finding::Rule::NotClosed;
        assert!(
            read(&text).findings().iter().any(is_open),
            "{lines_between} lines between"
        );
    }
}
