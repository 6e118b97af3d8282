//! Words, numbers, units, centres and tables.

use super::*;

#[test]
fn words_have_their_numbers_and_places() {
    let tokens = |line: &str| {
        let mut tokens = Vec::new();
        words(line.as_bytes(), 10, |token, range| {
            tokens.push((token, range))
        });
        tokens
    };
    let word =
        |letter: u8, mantissa: i64, decimals: u8, point: bool, range: std::ops::Range<usize>| {
            let number = Number {
                mantissa,
                decimals,
                point,
            };
            (Token::Word { letter, number }, range)
        };
    assert_eq!(
        tokens("g01X-1.50y +.5 (up) Z2. ; rest"),
        [
            word(b'G', 1, 0, false, 10..13),
            word(b'X', -150, 2, true, 13..19),
            word(b'Y', 5, 1, true, 19..24),
            (Token::Comment, 25..29),
            word(b'Z', 2, 0, true, 30..33),
            (Token::Comment, 34..40),
        ]
    );
    let definition = |index: i64, value: Option<i64>, range| {
        let number = |mantissa| Number {
            mantissa,
            decimals: 0,
            point: false,
        };
        let token = Token::Definition {
            letter: b'H',
            index: number(index),
            value: value.map(number),
        };
        (token, range)
    };
    assert_eq!(
        tokens("H001=110  H002 = +105 "),
        [
            definition(1, Some(110), 10..18),
            definition(2, Some(105), 20..31)
        ]
    );
    assert_eq!(
        tokens("H1= 5 2 G40"),
        [
            definition(1, None, 10..18),
            word(b'G', 40, 0, false, 18..21)
        ]
    );
    let fault = |fault, range| (Token::Fault(fault), range);
    assert_eq!(
        tokens("X Y1"),
        [
            fault(WordFault::NoNumber { letter: b'X' }, 10..11),
            word(b'Y', 1, 0, false, 12..14)
        ]
    );
    assert_eq!(
        tokens("X1,5"),
        [
            word(b'X', 15, 1, true, 10..14),
            fault(WordFault::DecimalComma, 12..13)
        ]
    );
    assert_eq!(
        tokens("X1.2.5"),
        [fault(WordFault::NotANumber { letter: b'X' }, 10..16)]
    );
    assert_eq!(
        tokens("X1234567890"),
        [fault(WordFault::TooManyDigits { digits: 10 }, 10..21)]
    );
    assert_eq!(
        tokens("(a(b)c) (open"),
        [
            (Token::Comment, 10..17),
            fault(WordFault::OpenComment, 18..23)
        ]
    );
    assert_eq!(
        tokens("X#101 STOP"),
        [
            fault(WordFault::Expression { letter: b'X' }, 10..15),
            (Token::Foreign, 16..20)
        ]
    );
    assert_eq!(tokens("é"), [fault(WordFault::NoWord, 10..12)]);
    // A program's number as Fanuc's tapes have it, and the move of an upper end.
    assert_eq!(
        tokens(":0007 N1"),
        [
            word(b'O', 7, 0, false, 10..15),
            word(b'N', 1, 0, false, 16..18)
        ]
    );
    assert_eq!(tokens(": G01 X1"), [(Token::Foreign, 10..18)]);
}

#[test]
fn centres_are_found_from_the_arcs() {
    let check = |text: &str, expected: (CenterRule, CenterRule)| {
        let document = read(text);
        assert_eq!(
            (document.reading().absolute, document.reading().incremental),
            expected,
            "{text}"
        );
        let faults = document
            .findings()
            .into_iter()
            .filter(|finding| finding.rule.name() == "arc-off-radius")
            .count();
        assert_eq!(faults, 0, "{text}");
    };
    use CenterRule::{Absolute, CenterToStart, StartToCenter};
    check(
        "G90 G03 X5000 Y5000 I0 J5000\nX0 Y10000 I-5000 J0",
        (StartToCenter, StartToCenter),
    );
    check(
        "G90 G03 X5000 Y5000 I0 J-5000\nX0 Y10000 I5000 J0",
        (CenterToStart, CenterToStart),
    );
    check(
        "G90 G03 X5000 Y5000 I0 J5000\nX0 Y10000 I0 J5000\nX-5000 Y5000 I0 J5000",
        (Absolute, StartToCenter),
    );
    check(
        "G91 G03 X5000 Y5000 J5000\nX-5000 Y5000 I-5000",
        (StartToCenter, StartToCenter),
    );
    check(
        "G91 G03 X5000 Y5000 J-5000\nX-5000 Y5000 I5000",
        (CenterToStart, CenterToStart),
    );
    // One wrong arc among right ones changes nothing.
    let document =
        read("G90 G03 X5.0 Y5.0 I0 J5.0\nX0 Y10.0 I0 J5.0\nX-5.0 Y5.0 I0 J4.0\nX0 Y0 I0 J5.0");
    assert_eq!(document.reading().absolute, Absolute);
    assert_eq!(
        document
            .findings()
            .iter()
            .filter(|finding| finding.rule.name() == "arc-off-radius")
            .count(),
        1
    );
}

#[test]
fn units_follow_from_the_numbers() {
    let end = |text: &str| read(text).trace().end();
    let check = |text: &str, x: f64, y: f64| {
        assert!(
            (end(text) - crate::geometry::Point::new(x, y)).norm() < 1e-9,
            "{text}: {:?}",
            end(text)
        )
    };
    check("G01 X1000 Y-5", 1000.0, -5.0);
    check("G01 X1. Y-5", 1000.0, -5000.0);
    check("G01 X1.2345678 Y0", 1234.568, 0.0);
    check("G20 G01 X1. Y.5", 25_400.0, 12_700.0);
    check("G20 G01 X10000", 25_400.0, 0.0);
    check("G91 G01 X1000 Y1000\nX500\nG90 X1", 1.0, 1000.0);
    // G92 before the first move sets the position, later it moves the zero, after a stop it tells where the wire was
    // taken.
    check("G92 X1000 Y500\nG91 G01 X10", 1010.0, 500.0);
    check("G90 G01 X1000\nG92 X0 Y0\nG01 X10", 1010.0, 0.0);
    check("G90 G01 X100\nM00\nG92 X1000 Y0\nG01 X1010", 1010.0, 0.0);
    // Words that use the coordinates themselves.
    check("G01 X1000\nG04 X500\nG28 X0 Y0\nG01 Y5", 1000.0, 5.0);
}

#[test]
fn tables_are_reckoned_and_units_are_what_is_said() {
    let slot = |table: &str| {
        format!(
            "{table}G92 X0. Y0.\nG90\nG41 H1\nG01 X.09 Y0.\nY1.\nG03 X-.09 Y1. I-.09 J0.\nG01 Y-1.\nG03 X.09 Y-1. I.09\nG01 Y0.\nG40\nG01 X0.\nM02\n"
        )
    };
    check(&slot("H175=.05\nH1 = .03 + H175\n"), &[]);
    check(
        &slot("H175=.05\nH1 = .08 + H175 - .02\n"),
        &[
            (7, "narrow-slot"),
            (7, "offset-collapse"),
            (8, "small-radius"),
            (10, "small-radius"),
        ],
    );
    check(
        &slot("H1 = .03 + H175\n"),
        &[
            (1, "machine-dependent"),
            (6, "narrow-slot"),
            (6, "offset-collapse"),
            (7, "small-radius"),
            (9, "small-radius"),
        ],
    );
    let inch = Effective::of(&crate::settings::from_toml("[program]\nunits = \"inch\"\n").0);
    let text = "G92 X0. Y0.\nG90\nG01 X1.5748 Y0.\nY.7874\nX0.\nY0.\nM02\n";
    let end = |settings: &Effective| {
        Document::read_with(text.into(), settings).trace().steps[0]
            .end
            .x
    };
    assert_eq!(
        (end(&inch), end(&Effective::default())),
        (39_999.92, 1574.8)
    );
    assert_eq!(faults(text, &inch), []);
    check(text, &[(3, "units")]);
    check(
        "G92 X0. Y0.\nG90\nG01 X1.5748 Y0. D1=.0065\nX0.\nM02\n",
        &[(3, "units")],
    );
    // Sodick's planes, and what the upper end of the wire does.
    let faults_of = |text: &str| {
        faults(text, &Effective::default())
            .into_iter()
            .filter(|(_, rule)| *rule != "machine-dependent")
            .collect::<Vec<_>>()
    };
    assert_eq!(
        faults_of(
            "TP0.0; TN20.0;\nG92 X0. Y0.\nG90\nG01 X20. Y0. : G01 X20. Y0.;\nG01 X20. Y20. : G01 X19. Y19.;\nG01 X0. Y0. : G01 X0. Y0.;\nM02\n"
        ),
        []
    );
}

#[test]
fn a_fault_in_a_word_is_told_by_its_column_and_the_others_of_its_line_are_read() {
    let text = "G92 X0 Y0\nG90\nG01 X1000 Y\nY1000\nX0 Y0\nM02\n";
    let finding = &read(text).findings()[0];
    assert_eq!(
        finding::sentence(finding, 1.0),
        "column 11: Y has no number"
    );
    // The meaning of these is clear, and the wire runs there.
    let meant = "G92 X0. Y0.\nG90\nG01 X10. Y0.\nX10. Y10.\nX0. Y10.\nX0. Y0.\nM02\n";
    for (plain, typed) in [("Y10.\nX0.", "Y1O.\nX0."), ("X10. Y10.", "X10,0 Y10.")] {
        let typed = meant.replace(plain, typed);
        assert_ne!(faults(&typed, &Effective::default()), [], "{typed}");
        assert_eq!(way(&typed), way(meant), "{typed}");
    }
}

#[test]
fn programs_and_subprograms_number_their_blocks_for_themselves() {
    let body = "N10 G01 X1000\nN20 Y1000\nN30 X0 Y0\n";
    check(
        &format!("G92 X0 Y0\n{body}M98 P2\nM02\nO2\n{body}M99\n"),
        &[],
    );
    check(
        &format!("G92 X0 Y0\n{body}N20 X1000\nN40 X0\nM02\n"),
        &[(5, "block-number")],
    );
    // A number out of its turn is not a missing number.
    check(
        "N10 G92 X0 Y0\nN20 G01 X1000\nN25 G01 Y1000\nN40 G01 X500\nN50 G01 X0 Y0\nM02\n",
        &[],
    );
    // Heads and ends without numbers are usual, and so are programs that number some lines only.
    check(&format!("%\nG92 X0 Y0\n{body}M02\n%\n"), &[]);
    check("G92 X0 Y0\nN1 G01 X1000\nY1000\nN2 X0 Y0\nM02\n", &[]);
}

#[test]
fn subprograms_are_followed_where_they_are_called() {
    let text = "H001=110\nG92X0Y0\nG90\nH001\nM98 P0001\nM00\nH001\nM98 P0001\nM00\nM02\n\nN0001\nG01X0Y2000\nG42\nG01X0Y5000\nX5000\nY-5000\nX-5000\nY5000\nX0\nG50\nG40\nG01X0Y2000\nG01X0Y0\nM99\n";
    check(text, &[(21, "machine-dependent")]);
    let trace = read(text).trace();
    assert_eq!(
        trace
            .steps
            .iter()
            .filter(|step| step.kind == Kind::Line)
            .count(),
        2 * 9
    );
    assert_eq!(trace.end(), crate::geometry::Point::origin());
    check(
        "G92 X0 Y0\nM98 P7\nG01 X1000\nG01 X0\nM02\n",
        &[(2, "machine-dependent")],
    );
    // Calls without end are cut off.
    check(
        "M98 P1\nM02\nN1 G91 G01 X1.\nM98 P1\nM99\n",
        &[
            (3, "not-closed"),
            (4, "machine-dependent"),
            (4, "missing-end"),
        ],
    );
}

#[test]
fn an_expression_where_the_wire_goes_is_an_error_and_a_name_is_told() {
    let with = |line: &str| {
        format!("G92 X0. Y0.\nG90\nG01 X3. Y-7.\n{line}\nG01 X7. Y3.\nG01 X0. Y0.\nM02\n")
    };
    for line in [
        "G01 X#1 Y2.",
        "g01 y#101",
        "X [#1 + 2]",
        "G1 X=AC(5) Y2.",
        "X=R1",
        "XQ1",
        "X+Q1",
        "X-#1",
        "XPOS5 Y1.",
        "G03 X1. Y1. I#2 J0.",
        "G#1 X2.",
        "X1. X2. Y#3",
        "G01 X1O. Y#3",
        "/X#1",
        "N4X#1(a comment)",
    ] {
        let text = with(line);
        let found = faults(&text, &Effective::default());
        assert!(found.contains(&(4, "syntax")), "{line}: {found:?}");
        assert_eq!(read(&text).unread_line(), Some(3), "{line}");
    }
    for (line, count) in [
        ("STOP", 1),
        ("#1=4", 1),
        ("RETURN", 1),
        ("GOTO20", 1),
        ("Z=3", 1),
        ("#1=4\nSTOP\n#2=5\nstop", 2),
        ("WHILE\nREPEAT\nSIDE", 3),
    ] {
        let found = faults(&with(line), &Effective::default());
        let told = found
            .iter()
            .filter(|(_, rule)| *rule == "machine-dependent");
        assert_eq!(told.count(), count, "{line}: {found:?}");
        assert!(!found.iter().any(|(_, rule)| *rule == "syntax"), "{line}");
    }
}

#[test]
fn every_number_that_stands_out_is_told_where_they_are_few() {
    for bare in [1, 5, 20] {
        let line = |index: usize| match index < bare {
            true => format!("G01 X1 Y{index}.5\n"),
            false => format!("G01 X{index}.5 Y0.5\n"),
        };
        let body: String = (0..200).map(line).collect();
        let text = format!("G92 X0.0 Y0.0\nG90\n{body}M02\n");
        let found = faults(&text, &Effective::default());
        let told = found.iter().filter(|(_, rule)| *rule == "mixed-numbers");
        assert_eq!(told.count(), bare);
    }
}

#[test]
fn a_number_that_the_control_passes_over_does_not_stand_for_one_with_other_decimals() {
    // Of X that is repeated the last one counts; and of many lines.
    for between in [0, 5, 400] {
        let comments = "(plate)\n".repeat(between);
        let body = "G01 X1.5 Y2.5\nG01 X3.5 Y0.5\n".repeat(10);
        let text = format!(
            "G92 X0.0 Y0.0\nG90\nG01 X9. X2.5\n{comments}{body}G01 X4. Y2.5\nG01 X0.0 Y0.0\nM02\n"
        );
        let found = faults(&text, &Effective::default());
        let line = 24 + between;
        let told: Vec<_> = found
            .iter()
            .filter(|(_, rule)| *rule == "mixed-numbers")
            .collect();
        assert_eq!(told, [&(line, "mixed-numbers")], "{between}");
    }
}

#[test]
fn an_arc_that_ends_in_the_zero_is_about_a_center_by_its_coordinates() {
    // About I, J, or about the mirrored centre: both fit.
    let text = "G92 X0 Y0\nG90\nG01 X-1.360 Y0.436\nG01 X-3.075 Y-4.905\nG01 X-1.716 Y-5.341\n\
                G02 X0.000 Y0.000 I-10.728 J0.500\nM02\n";
    let document = Document::read(text.into());
    let steps = document.trace().steps;
    let arcs = steps
        .iter()
        .filter_map(|step| step.ideal?.as_arc().copied());
    let turns: Vec<f64> = arcs.map(|arc| arc.sweep.to_degrees().round()).collect();
    assert_eq!(turns, [-330.0]);
    let told = document.plain_findings();
    let told = told
        .iter()
        .find(|finding| finding.rule.name() == "ambiguous-center");
    let sentence = told.map(|finding| crate::finding::sentence(finding, 1.0));
    assert!(sentence.is_some_and(|told| told.contains("coordinates of the centre")));
}

#[test]
fn a_line_that_leads_beyond_any_machine_is_named_and_not_followed() {
    let end = |text: &str| {
        let steps = read(text).trace().steps;
        steps.last().map(|step| [step.end.x, step.end.y])
    };
    let lines = "G01 X999999999. Y0\n".repeat(400);
    let text = format!("G20\nG91\nG92 X0 Y0\n{lines}M02\n");
    let expected: Vec<(usize, &str)> = (4..404).map(|line| (line, "too-many-digits")).collect();
    check(&text, &expected);
    assert_eq!(end(&text), Some([0.0, 0.0]));
    let called = "G20\nG91\nG92 X0 Y0\nM98 P100 L400\nM02\nO100\nG01 X999999999. Y0\nM99\n";
    check(called, &[(7, "too-many-digits")]);
    assert_eq!(end(called), Some([0.0, 0.0]));
    check("G92 X999999999. Y0\nG90\nM02\n", &[(1, "too-many-digits")]);
    // A place says where the wire is again; the unit of the line itself counts.
    let found = faults(
        "G90\nG92 X0 Y0\nG20 G01 X500000.\nG21 G01 X9999999.\nG01 X1.\nM02\n",
        &Effective::default(),
    );
    let beyond = found.iter().filter(|(_, rule)| *rule == "too-many-digits");
    assert_eq!(beyond.collect::<Vec<_>>(), [&(3, "too-many-digits")]);
}

/// Lines with the number `#`, in a program in mm with points.
const LENGTHS: [&str; 19] = [
    "G01 X#",
    "G01 Y-#",
    "G02 X0. Y10. I# J0.",
    "G02 X0. Y10. I0. J-#",
    "G03 X0. Y10. R#",
    "G03 X0. Y10. R-#",
    "G01 X0. R#",
    "G01 X0. ,R#",
    "G01 X0. ,C#",
    "G01 X0. U#",
    "G01 X0. V-#",
    "G01 X0. Z#",
    "G01 X0. : X# Y0.",
    "G01 X0. : G02 X0. Y5. I# J0.",
    "TP#",
    "TN-#",
    "D1=#",
    "H7=-#",
    "H1=1.+#",
];

proptest::proptest! {
    #[test]
    fn every_length_beyond_any_machine_is_named_once(at in 0..LENGTHS.len(), whole in 10_000_001_u32..=999_999_999, decimals in "[0-9]{0,9}") {
        let line = LENGTHS[at].replace('#', &format!("{whole}.{decimals}"));
        let text = format!("G21\nG90\nG92 X0. Y0.\nG01 X10.\nY10.\n{line}\nG01 X5. Y0.\nX0. Y0.\nM02\n");
        let document = Document::read_with(text.as_bytes().to_vec(), &Effective::default());
        let named = faults(&text, &Effective::default());
        let named: Vec<_> = named.iter().filter(|(_, rule)| *rule != "machine-dependent").collect();
        proptest::prop_assert!(named.contains(&&(6, "too-many-digits")), "{line}: {named:?}");
        proptest::prop_assert_eq!(named.iter().filter(|(row, _)| *row == 6).count(), 1, "{}: {:?}", line, named);
        let trace = document.trace();
        let is_sane = |step: &crate::program::path::Step| step.end.coords.abs().max() < 1e11;
        proptest::prop_assert!(trace.steps.iter().all(is_sane), "{line}");
        for way in document.taper().iter().flat_map(|taper| &taper.upper).flatten() {
            proptest::prop_assert!(way.end().coords.abs().max() < 1e11, "{line}");
        }
    }

    #[test]
    fn a_number_that_counts_nothing_depends_on_the_machine(letter in "[NDHL]", number in "-[1-9]|[0-9]\\.[1-9]") {
        let text = format!("G90 G92 X0. Y0.\n{letter}{number} G01 X5. Y0.\nY5.\nX0. Y0.\nM02\n");
        let found = faults(&text, &Effective::default());
        proptest::prop_assert!(found.contains(&(2, "machine-dependent")), "{text}{found:?}");
    }
}
