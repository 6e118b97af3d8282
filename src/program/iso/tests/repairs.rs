//! Repairs of a program, and the one slip behind its findings.

use super::*;

/// The text after the fix whose title begins like this, of the finding of a rule.
#[track_caller]
pub(super) fn fixed(text: &str, rule: &str, title: &str) -> String {
    let document = read(text);
    let finding = document
        .findings()
        .into_iter()
        .find(|finding| finding.rule.name() == rule)
        .unwrap_or_else(|| panic!("no {rule} in {text}"));
    let fixes = document.offered(&finding, Renumbering::Offered);
    let titles: Vec<String> = fixes.iter().map(|fix| fix.kind.title(1.0)).collect();
    let index = titles
        .iter()
        .position(|its| its.starts_with(title))
        .unwrap_or_else(|| panic!("no {title:?} in {titles:?}"));
    let mut after = document.clone();
    for edit in fixes[index].edit.iter().rev() {
        after.edit(edit.range.clone(), &edit.text);
    }
    assert!(
        after.findings().iter().all(|left| left.rule.name() != rule),
        "{:?}",
        after.findings()
    );
    String::from_utf8(after.text().bytes().to_vec()).unwrap()
}

#[test]
fn what_can_be_repaired_is_repaired_and_the_finding_goes() {
    let check = |rule: &str, title: &str, text: &str, expected: &str| {
        assert_eq!(fixed(text, rule, title), expected, "{title}")
    };
    let body = "G92 X0. Y0.\nG90\nG01 X5. Y0.\nG03 X0. Y5. I-5. J0.\n";
    let off = |line: &str| format!("{body}{line}\nG01 X0. Y0.\nM02\n");
    let right = off("G03 X-5. Y0. I0. J-5.");
    check(
        "arc-off-radius",
        "Read I and J as other controls",
        &off("G03 X-5. Y0. I0. J5."),
        &right,
    );
    check(
        "arc-off-radius",
        "Swap I and J",
        &off("G03 X-6. Y3. I-4. J-2."),
        &off("G03 X-6. Y3. I-2. J-4."),
    );
    check(
        "arc-off-radius",
        "Correct the sign",
        &off("G03 X-6. Y3. I2. J-4."),
        &off("G03 X-6. Y3. I-2. J-4."),
    );
    check(
        "arc-off-radius",
        "Move the centre by",
        &off("G03 X-5. Y0. I0.1 J-5."),
        &off("G03 X-5. Y0. I0.05 J-5.05"),
    );
    // A cut of which the last line is missing, absolute and incremental, with and without spaces.
    check(
        "not-closed",
        "Close the contour with a line of 5.000 mm",
        "G92 X0. Y0.\r\nG90\r\nG01 X5. Y0.\r\nX5. Y5.\r\nX0. Y5.\r\nM02\r\n",
        "G92 X0. Y0.\r\nG90\r\nG01 X5. Y0.\r\nX5. Y5.\r\nX0. Y5.\r\nG01 X0. Y0.\r\nM02\r\n",
    );
    check(
        "not-closed",
        "Close",
        "G92X0Y0\nG91\nG01X5000\nY5000\nX-5000\nM02\n",
        "G92X0Y0\nG91\nG01X5000\nY5000\nX-5000\nG01X0Y-5000\nM02\n",
    );
    // Back to the end of the way in, which is nearer.
    check(
        "not-closed",
        "Close the contour with a line of 2.000 mm",
        "G92 X0. Y0.\nG90\nG01 X5. Y0.\nX9. Y5.\nX5. Y9.\nX5. Y2.\nM02\n",
        "G92 X0. Y0.\nG90\nG01 X5. Y0.\nX9. Y5.\nX5. Y9.\nX5. Y2.\nG01 X5. Y0.\nM02\n",
    );
    let numbered = |numbers: [&str; 4]| {
        let [a, b, c, d] = numbers;
        format!("{a}G92 X0 Y0\n{b}G01 X1000\n{c}G01 Y1000\n{d}G01 X0 Y0\nN50 M02\n")
    };
    check(
        "block-number",
        "Number the block N30",
        &numbered(["N10 ", "N20 ", "N20 ", "N40 "]),
        &numbered(["N10 ", "N20 ", "N30 ", "N40 "]),
    );
    check(
        "block-number",
        "Number the block N30",
        &numbered(["N10 ", "N20 ", "", "N40 "]),
        &numbered(["N10 ", "N20 ", "N30 ", "N40 "]),
    );
    check(
        "block-number",
        "Number all blocks",
        &numbered(["N1 ", "N1 ", "N2 ", "N3 "]),
        &numbered(["N10 ", "N20 ", "N30 ", "N40 "]),
    );
    check(
        "compensation-switch",
        "Cut there",
        "G92 X0 Y0\nG42 D1\nG00 X1000\nG01 Y1000\nX2000\nX1000 Y0\nM02\n",
        "G92 X0 Y0\nG42 D1\nG01 X1000\nG01 Y1000\nX2000\nX1000 Y0\nM02\n",
    );
    check(
        "missing-end",
        "End the program",
        "G92 X0 Y0\nG01 X1000\nY1000\nX0 Y0\n",
        "G92 X0 Y0\nG01 X1000\nY1000\nX0 Y0\nM02\n",
    );
    // The arc that runs the wrong way is named, although the number of its block could be taken for its word.
    let rounded = |arc: &str| {
        format!("N1 G92 X0. Y0.\nN2 {arc} X2. Y2. I0. J2.\nN3 G01 Y8.\nX-8.\nY0.\nX0.\nM02\n")
    };
    let rounded = |arc: &str| rounded(arc).replace("N2 ", "G90\nG01 X-1. Y0.\nX0.\nN2 ");
    check("reversed-arc", "", &rounded("G02"), &rounded("G03"));
    // A number without its point: thousandths, or a point that was forgotten.
    let among = |number: &str| {
        format!(
            "G92 X0.000 Y0.000\nG90\nG01 X5.000 Y0.000\nX5.000 Y5.000\nX{number} Y5.000\nX25.000 Y-5.000\nX0.000 Y-5.000\nX0.000 Y0.000\nM02\n"
        )
    };
    check(
        "mixed-numbers",
        "Write X25.000",
        &among("25000"),
        &among("25.000"),
    );
    check(
        "text-after-end",
        "Delete",
        "G92 X0 Y0\nG01 X1000\nY1000\nX0 Y0\nM02\nG01 X5\nX0\n",
        "G92 X0 Y0\nG01 X1000\nY1000\nX0 Y0\nM02\n",
    );
}

#[test]
fn no_line_is_offered_where_what_follows_would_be_cut_otherwise() {
    // The line after the stop is an arc because the one before it is.
    let text = |next: &str| {
        format!(
            "G92 X0. Y0.\nG90\nG01 X5. Y0.\nX9. Y9.\nG03 X0. Y5. I-5. J0.\nM00\n{next}X-5. Y0. I0. J-5.\nG01 X0. Y5.\nM02\n"
        )
    };
    for (next, offered) in [("", false), ("G03 ", true)] {
        let text = text(next);
        let document = read(&text);
        let finding = document
            .findings()
            .into_iter()
            .find(|finding| finding.rule.name() == "not-closed")
            .expect(&text);
        let is_close = |fix: &finding::TextFix| {
            fix.kind
                .title(1.0)
                .starts_with("Close the contour with a line")
        };
        assert_eq!(
            document
                .offered(&finding, Renumbering::Offered)
                .iter()
                .any(is_close),
            offered,
            "{text}"
        );
    }
}

/// Replaces a line of the plate (from 1): the findings at lines, and the first fix of the first finding that has one,
/// which restores the plate.
#[track_caller]
fn slip(line: usize, with: &str, expected: &[(usize, &str)]) {
    let lines: Vec<&str> = PLATE.lines().collect();
    let mut faulty = lines.clone();
    faulty[line - 1] = with;
    let faulty = faulty.join("\n") + "\n";
    let found = faults(&faulty, &Effective::default());
    assert!(
        expected.iter().all(|one| found.contains(one)),
        "{with}: {found:?}"
    );
    let document = read(&faulty);
    let mut findings = document.findings();
    findings.sort_by_key(|finding| finding.severity);
    let fix = findings
        .iter()
        .find_map(|finding| {
            document
                .offered(finding, Renumbering::Offered)
                .into_iter()
                .next()
        })
        .unwrap_or_else(|| panic!("no fix: {with}"));
    let mut fixed = document.clone();
    fix.edit.iter().rev().for_each(|edit| {
        fixed.edit(edit.range.clone(), &edit.text);
    });
    assert_eq!(fixed.findings(), [], "{with}: {:?}", fix.kind);
    assert_eq!(
        fixed
            .trace()
            .steps
            .iter()
            .map(|step| step.ideal)
            .collect::<Vec<_>>(),
        read(PLATE)
            .trace()
            .steps
            .iter()
            .map(|step| step.ideal)
            .collect::<Vec<_>>(),
        "{with}: {:?}",
        fix.kind
    );
}

#[test]
fn one_slip_is_found_where_it_stands_and_turned_back() {
    check(PLATE, &[]);
    for (line, with, expected) in [
        (4, "G01 X38.OOO Y0.000", &[(4, "syntax")][..]),
        (4, "G01 X38,000 Y0.000", &[(4, "syntax")]),
        (4, "Ｇ０１ Ｘ３８．０００ Ｙ０．０００", &[(4, "syntax")]),
        (4, "G01\u{a0}X38.000\u{3000}Y0.000", &[(4, "syntax")]),
        (4, "G01 Х38.000 Y0.000", &[(4, "syntax")]),
        (
            5,
            "G01 X40.000 Y2.000 I0.000 J2.000",
            &[(5, "center-on-line")],
        ),
        (
            5,
            "G02 X40.000 Y2.000 I0.000 J2.000",
            &[(5, "reversed-arc")],
        ),
        (4, "G01 X38.000 X0.000", &[(4, "word-twice")]),
        (
            5,
            "G03 X40.000 Y2.000 I0.000 J-2.000",
            &[(5, "arc-off-radius")],
        ),
        (
            5,
            "G03 X40.000 Y2000 I0.000 J2.000",
            &[(5, "mixed-numbers")],
        ),
        (6, "G01 X40.000 Y81.000", &[]),
        (8, "G01 X2.000\nG01 X2.000 Y20.000", &[]),
        (
            5,
            "G03 X40.000 Y2.000 I0.000 J2.000\nG03 X40.000 Y2.000 I0.000 J2.000",
            &[(6, "doubled-block")],
        ),
        (
            6,
            "G01 X40.000 Y18.000\nG01 X40.000 Y18.000",
            &[(7, "doubled-block")],
        ),
        (
            6,
            "G01 X40.000 Y9.000\nG01 X50.000 Y9.000\nG01 X40.000 Y9.000\nG01 X40.000 Y18.000",
            &[(8, "spur")],
        ),
    ] {
        if with.contains("X2.000\nG01") || with.contains("Y9.000") {
            // The removed block leaves a node on a straight wall.
            let faulty = PLATE
                .lines()
                .enumerate()
                .map(|(at, own)| format!("{}\n", if at + 1 == line { with } else { own }))
                .collect::<String>();
            let found = faults(&faulty, &Effective::default());
            assert!(
                expected.iter().all(|one| found.contains(one)),
                "{with}: {found:?}"
            );
            continue;
        }
        slip(line, with, expected);
    }
}

/// Two passes without a stop: the way out and in again between them is no spur, in however many contours; one that lies
/// elsewhere is, beside these.
#[test]
fn ways_between_passes_are_no_spurs_in_any_number_of_contours() {
    let text = |contours: usize, spur: &str| {
        let mut text = String::from("G90\nG92 X0. Y0.\n");
        for contour in 0..contours {
            let x = 50 * contour;
            if contour > 0 {
                text += &format!("M00\nG00 X{x}. Y0.\n");
            }
            let round = format!(
                "G01 X{x}. Y5.\nX{0}. Y5.\nX{0}. Y15.\nX{1}. Y15.\nX{1}. Y5.\nX{x}. Y5.\nX{x}. Y0.\n",
                x + 10,
                x as i64 - 10
            );
            text += &round.repeat(2);
        }
        text + spur + "M02\n"
    };
    let spurs = |text: &str| {
        let found = faults(text, &Effective::default());
        found.iter().filter(|(_, rule)| *rule == "spur").count()
    };
    for contours in [1, 32, 33, 200] {
        assert_eq!(spurs(&text(contours, "")), 0, "{contours} contours");
        let x = 50 * (contours - 1);
        let spur = format!("G01 X{x}. Y2.\nX{0}. Y2.\nX{x}. Y2.\nX{x}. Y4.\n", x + 3);
        assert_eq!(spurs(&text(contours, &spur)), 1, "{contours} contours");
    }
}
