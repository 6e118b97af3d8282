//! Reading ISO: what lines say, how centres are meant, what is wrong, and that an edited text is the one read afresh.

mod writing;

use super::document::Document;
use super::machine::CenterRule;
use super::plain::words;
use super::word::{Number, Token, WordFault};
use crate::finding;
use crate::program::path::Kind;
use crate::settings::{Effective, SideSetting};
use proptest::prelude::*;

fn read(text: &str) -> Document {
    Document::read(text.as_bytes().to_vec())
}

/// Line (from 1) and rule of each finding.
fn faults(text: &str, settings: &Effective) -> Vec<(usize, &'static str)> {
    let document = Document::read_with(text.as_bytes().to_vec(), settings);
    let line = |finding: &crate::finding::Finding| match &finding.place {
        crate::finding::Place::Text { range } => document.text().line_of(range.start) + 1,
        _ => 0,
    };
    document
        .findings()
        .iter()
        .map(|finding| (line(finding), finding.rule.name()))
        .collect()
}

fn check(text: &str, expected: &[(usize, &str)]) {
    assert_eq!(faults(text, &Effective::default()), expected, "{text}");
}

#[test]
fn words_have_their_numbers_and_places() {
    let tokens = |line: &str| {
        let mut tokens = Vec::new();
        words(line.as_bytes(), 10, |token| tokens.push(token));
        tokens
    };
    let word =
        |letter: u8, mantissa: i64, decimals: u8, point: bool, range: std::ops::Range<usize>| {
            Token::Word {
                letter,
                number: Number {
                    mantissa,
                    decimals,
                    point,
                },
                range,
            }
        };
    assert_eq!(
        tokens("g01X-1.50y +.5 (up) Z2. ; rest"),
        [
            word(b'G', 1, 0, false, 10..13),
            word(b'X', -150, 2, true, 13..19),
            word(b'Y', 5, 1, true, 19..24),
            Token::Comment { range: 25..29 },
            word(b'Z', 2, 0, true, 30..33),
            Token::Comment { range: 34..40 },
        ]
    );
    let definition = |index: i64, value: Option<i64>, range| Token::Definition {
        letter: b'H',
        index: Number {
            mantissa: index,
            decimals: 0,
            point: false,
        },
        value: value.map(|mantissa| Number {
            mantissa,
            decimals: 0,
            point: false,
        }),
        range,
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
    let fault = |fault, range| Token::Fault { fault, range };
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
            Token::Comment { range: 10..17 },
            fault(WordFault::OpenComment, 18..23)
        ]
    );
    assert_eq!(
        tokens("X#101 STOP"),
        [
            Token::Foreign { range: 10..15 },
            Token::Foreign { range: 16..20 }
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
    assert_eq!(tokens(": G01 X1"), [Token::Foreign { range: 10..18 }]);
}

/// A square of 10 mm with one rounded corner, cut from outside: absolute, from start to centre, µm.
const ROUNDED: &str = "%\nN10 G92 X-5000 Y0\nN20 G90\nG41 D1\nG01 X0 Y0\nY-10000\nX10000\nY-5000\nG03 X5000 Y0 I-5000 J0\nG01 X0\nG40\nX-5000\nM02\n%\n";

#[test]
fn a_right_program_has_no_fault() {
    check(ROUNDED, &[]);
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
    check("G91 G01 X10 Y10\nX5\nG90 X1", 1.0, 10.0);
    // G92 before the first move says where the wire stands, later it moves the zero, behind a stop it says where it was taken to.
    check("G92 X100 Y50\nG91 G01 X10", 110.0, 50.0);
    check("G90 G01 X100\nG92 X0 Y0\nG01 X10", 110.0, 0.0);
    check("G90 G01 X100\nM00\nG92 X1000 Y0\nG01 X1010", 1010.0, 0.0);
    // Words that take the coordinates for themselves.
    check("G01 X10\nG04 X500\nG28 X0 Y0\nG01 Y5", 10.0, 5.0);
}

#[test]
fn each_fault_is_named_at_its_line() {
    let body = "G92 X0 Y0\nG91\n";
    let with = |text: &str| format!("{body}{text}\nM02\n");
    check(
        &with("G01 X1000\nG01 X1000 Y\nG01 Y1000\nG01 X-2000 Y-1000"),
        &[(4, "syntax")],
    );
    check(
        &with("G01 X1000 Y0\nG02 X1000 Y0 I400 J0\nG01 X-2000 Y0"),
        &[(4, "arc-off-radius")],
    );
    check(
        &with("G01 X1000\nG02 X1000\nG01 X-2000"),
        &[(4, "arc-without-radius")],
    );
    check(
        &with("G01 X1000\nG02 X1000 I0 J0\nG01 X-2000"),
        &[(4, "arc-without-radius")],
    );
    check(
        &with("G01 X1000\nG01 Y1000\nG01 X-500\nG01 X-300"),
        &[(6, "not-closed")],
    );
    check(
        "G92 X0 Y0\nG91\nG01 X1000\nG01 Y1000\nG01 X-1000 Y-1000\n",
        &[(5, "missing-end")],
    );
    check(
        &(with("G01 X1000\nG01 Y1000\nG01 X-1000 Y-1000") + "G01 X5\nG01 X-5\n%\n"),
        &[(7, "text-after-end")],
    );
    check(
        &with("N1 G01 X1000\nN2 G01 Y1000\nN1 G01 X-1000 Y-1000"),
        &[(5, "block-number")],
    );
    check(
        &with("G61\nG60\nT84\nT85\nM50 G01 X1000\nG01 Y1000\nG01 X-1000 Y-1000"),
        &[
            (3, "machine-dependent"),
            (5, "machine-dependent"),
            (7, "machine-dependent"),
        ],
    );
    check(
        &with("G42 D1\nG03 X1000 I500 J0\nG01 Y1000\nG40\nG01 X-1000 Y-1000"),
        &[(4, "compensation-switch")],
    );
    check(
        &with("G42 D1\nG00 X1000\nG01 Y1000\nG01 X1000\nG01 X-1000 Y-1000\nG40\nG00 X-1000"),
        &[(4, "compensation-switch")],
    );
    // A whole turn fits whatever I and J mean.
    check(
        &with("G01 X1000\nG03 X0 Y0 I-1000 J0\nG01 X-1000"),
        &[(4, "ambiguous-center")],
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
    // What is meant by these is plain, and the wire runs there.
    let meant = "G92 X0. Y0.\nG90\nG01 X10. Y0.\nX10. Y10.\nX0. Y10.\nX0. Y0.\nM02\n";
    for (plain, typed) in [("Y10.\nX0.", "Y1O.\nX0."), ("X10. Y10.", "X10,0 Y10.")] {
        let typed = meant.replace(plain, typed);
        assert_ne!(faults(&typed, &Effective::default()), [], "{typed}");
        assert_eq!(way(&typed), way(meant), "{typed}");
    }
}

/// The text after the fix with a title that begins so, of the finding of a rule.
#[track_caller]
fn fixed(text: &str, rule: &str, title: &str) -> String {
    let document = read(text);
    let finding = document
        .findings()
        .into_iter()
        .find(|finding| finding.rule.name() == rule)
        .unwrap_or_else(|| panic!("no {rule} in {text}"));
    let fixes = document.fixes(&finding);
    let titles: Vec<String> = fixes
        .iter()
        .map(|fix| finding::title(&fix.kind, 1.0))
        .collect();
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
        "Take I and J as other controls",
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
        "Put the sign",
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
    // An arc that runs round the wrong way says so itself, in a block whose number could be taken for its word.
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
    // The line behind the stop is an arc because the one before it is.
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
            finding::title(&fix.kind, 1.0).starts_with("Close the contour with a line")
        };
        assert_eq!(
            document.fixes(&finding).iter().any(is_close),
            offered,
            "{text}"
        );
    }
}

#[test]
fn a_cut_that_goes_through_itself_is_told_at_both_places() {
    // A bow tie, absolute and incremental, cut by the wire's own path and by the part's contour.
    let bow = |side: &str| {
        format!(
            "G92 X0. Y0.\nG90\n{side}\nG01 X10. Y0.\nX20. Y10.\nX20. Y0.\nX10. Y10.\nX10. Y0.\nG40\nX0. Y0.\nM02\n"
        )
    };
    check(&bow("G40"), &[(7, "path-crosses-itself")]);
    check(&bow("G41 D1"), &[(7, "path-crosses-itself")]);
    check(
        "G92 X0 Y0\nG91\nG01 X10000\nX10000 Y10000\nY-10000\nX-10000 Y10000\nY-10000\nX-10000\nM02\n",
        &[(6, "path-crosses-itself")],
    );
    let document = read(&bow("G40"));
    let finding = &document.findings()[0];
    assert_eq!(
        finding::sentence(finding, 1.0),
        "the wire crosses its own path of line 5 here, at (15.000, 5.000) mm from the contour's start: it cuts the part in two"
    );
    // An arc through a line; a line that only touches; the same contour twice, as in a second pass.
    check(
        "G92 X0. Y0.\nG91\nG01 X5.\nX10.\nG03 X-4. Y4. I-4. J0.\nG01 X-4. Y-8.\nX-7. Y4.\nM02\n",
        &[(6, "path-crosses-itself")],
    );
    check(
        "G92 X0. Y0.\nG90\nG01 X10. Y0.\nX20. Y10.\nX10. Y20.\nX15. Y10.\nX10. Y0.\nX0. Y0.\nM02\n",
        &[],
    );
    check(
        "G92 X0. Y0.\nG90\nG01 X5. Y0.\nY5.\nX0.\nY0.\nX5. Y0.\nY5.\nX0.\nY0.\nM02\n",
        &[],
    );
    // Other cuts lie elsewhere, whatever lies between them in the text; a cut with a wrong arc is not told anything of.
    check(
        "G92 X0. Y0.\nG90\nG01 X9. Y9.\nX0.\nY0.\nM00\nG00 X0. Y5.\nG01 X9.\nY0.\nX0. Y5.\nM02\n",
        &[],
    );
    check(
        &bow("G40").replace("X20. Y0.\n", "X20. Y0.\nG02 X20. Y0. R0\nG01 "),
        &[(7, "arc-without-radius")],
    );
    // Far apart in the text, and across the borders of what is run together.
    let mut long = String::from("G92 X0 Y0\nG91\nG01 X1000\n");
    (0..700).for_each(|step| long += if step % 2 == 0 { "X10\n" } else { "Y10\n" });
    long += "Y3000\nX-2000\nY-5000\nX700 Y-3000\nX1000 Y6000\nX-700\nM02\n";
    let found = faults(&long, &Effective::default());
    assert!(
        found
            .iter()
            .any(|(line, rule)| *rule == "path-crosses-itself" && *line == 708),
        "{found:?}"
    );
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
    // A number between those of its turn is no number that is lacking.
    check(
        "N10 G92 X0 Y0\nN20 G01 X1000\nN25 G01 Y1000\nN40 G01 X500\nN50 G01 X0 Y0\nM02\n",
        &[],
    );
    // Heads and ends without numbers are usual, and so are programs that number some lines only.
    check(&format!("%\nG92 X0 Y0\n{body}M02\n%\n"), &[]);
    check("G92 X0 Y0\nN1 G01 X1000\nY1000\nN2 X0 Y0\nM02\n", &[]);
}

#[test]
fn the_wire_runs_where_the_role_and_its_way_in_say() {
    let opening = Effective {
        side: SideSetting::Opening,
        ..Effective::default()
    };
    let punch = Effective {
        side: SideSetting::Punch,
        ..Effective::default()
    };
    // From the middle of a square hole, counter-clockwise, the wire on the left.
    let hole = |word: &str| {
        format!(
            "G92 X0 Y0\nG90\n{word} D1\nG01 X5000 Y0\nY5000\nX-5000\nY-5000\nX5000\nY0\nG40\nX0\nM02\n"
        )
    };
    let check = |text: &str, settings: &Effective, expected: &[(usize, &str)]| {
        assert_eq!(faults(text, settings), expected, "{text}")
    };
    check(&hole("G41"), &Effective::default(), &[]);
    check(&hole("G41"), &opening, &[]);
    check(&hole("G41"), &punch, &[(3, "wrong-side")]);
    check(&hole("G42"), &opening, &[(3, "wrong-side")]);
    // Nobody said what it is, but the wire comes from inside.
    check(&hole("G42"), &Effective::default(), &[(3, "wrong-side")]);
    let document = Document::read_with(hole("G42").into_bytes(), &opening);
    let finding = &document.findings()[0];
    assert_eq!(
        finding::sentence(finding, 1.0),
        "G42 lets the wire run on the right, which is outside this contour: the settings say opening, the wire cuts into the part"
    );
    let fix = &document.fixes(finding)[0];
    let mut fixed = document.clone();
    fixed.edit(fix.edit[0].range.clone(), &fix.edit[0].text);
    assert_eq!(fixed.findings(), []);
}

#[test]
fn arcs_are_held_against_the_correction_under_compensation_only() {
    // A slot's end of R 0.09 mm, concave to a wire on the left.
    let program = |word: &str, table: &str| {
        format!(
            "{table}G92 X0 Y0\nG90\n{word}\nG01 X90 Y0\nY1000\nG03 X-90 Y1000 I-90 J0\nG01 Y-1000\nG03 X90 Y-1000 I90\nG01 Y0\nG40\nG01 X0\nM02\n"
        )
    };
    check(
        &program("G41 D1", ""),
        &[(6, "small-radius"), (8, "small-radius")],
    );
    // The wire outside.
    let outside = program("G42 D1", "")
        .replace("X0 Y0\nG90", "X500 Y0\nG90")
        .replace("G01 X0\n", "G01 X500\n");
    check(&outside, &[]);
    check(&program("G41 H1", "H1=80\n"), &[]);
    check(
        &program("G41 H1", "H1=95\n"),
        &[(7, "small-radius"), (9, "small-radius")],
    );
    check(&program("G40", ""), &[]);
    let none = Effective {
        compensation: crate::settings::Compensation::None,
        ..Effective::default()
    };
    assert_eq!(
        faults(&program("G40", ""), &none),
        [(6, "small-radius"), (8, "small-radius")]
    );
    let punch = Effective {
        side: SideSetting::Punch,
        ..none
    };
    assert_eq!(faults(&program("G40", ""), &punch), []);
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
        "M98 P1\nM02\nN1 G91 G01 X1\nM98 P1\nM99\n",
        &[
            (3, "not-closed"),
            (4, "machine-dependent"),
            (4, "missing-end"),
        ],
    );
}

/// Programs in the forms that the machines of the field have, found in programs and manuals of theirs: nothing is said of them but which
/// words are the machine's own.
#[test]
fn the_dialects_of_the_field_are_no_faults() {
    let square = "G01 X10.000 Y0.000\nG01 X10.000 Y10.000\nG01 X0.000 Y10.000\nG01 X0.000 Y0.000\n";
    for text in [
        // Rough and skim pass in one go, conditions by E, the wire threaded and fed by M words.
        format!("%\nO0001 (ROBOCUT)\nG90 G21\nG92 X0 Y0\nE0001 (ROUGH)\nM06\nM50\nM80 M81\nG42 H01 (RIGHT)\n{square}G40\nE0002\nG42 H02\n{square}G40\nM82 M83\nM51\nM02\n%\n"),
        // The taper, and conditions by C.
        format!("%\nO0010\nG90 G21\nG92 X0. Y0.\nC100 (IP8 ON12)\nM50\nG51 U3.500\nG42 D01\n{square}G40\nG50\nM51\nM02\n%\n"),
        // Fast wire: pump and wire switched by T words, blocks that end with a semicolon, a subprogram for each pass.
        "N10 T84 T86 G90 G92X0.000Y0.000;\nN12 G01 X5.000Y0.000;\nN14 G03 X-5.000 Y0.000 I-5.000 J0.000;\nN16 G03 X5.000 Y0.000 I5.000 J0.000;\nN18 G01 X0.000 Y0.000;\nN20 T85 T87 M02;\n".into(),
        "H000=+00000000 H001=+00000110;\nH005=+00000000;T84 T86 G54 G90 G92X+0Y+0;\nC007;\nG01X+3000Y+0;G04X0.0+H005;\nG41H000;\nC001;\nG41H000;\nG01X+4000Y+0;G04X0.0+H005;\nG41H001;\nX+4000Y+4000;\nX-4000Y+4000;\nX-4000Y-4000;\nX+4000Y-4000;\nX+4000Y+0;\nG40H000G01X+3000Y+0;\nM00;\nT85 T87 M02;\n".into(),
        // Robofil: the centre's own coordinates, the prologue before G90.
        "G92 X0 Y0\r\nG60\r\nG38\r\nG42 D0\r\nG90\r\nG01 X10.000 Y0.000\r\nG02 X0.000 Y-10.000 I0.000 J0.000\r\nG02 X10.000 Y0.000 I0.000 J0.000\r\nG40\r\nG01 X0.000 Y0.000\r\nM02\r\n".into(),
        // Numbers without zeros, R in the place of I and J, M30.
        "%\nN1G21G90\nN2G92X-5.Y0\nN3G42D1\nN4G1X0.Y0\nN5Y-9.\nN6G3X1.Y-10.R1.\nN7G1X9.\nN8G3X10.Y-9.R1.\nN9G1Y0\nN10X0.\nN11G40\nN12X-5.\nN13M30\n%\n".into(),
    ] {
        let found = faults(&text, &Effective::default());
        assert!(found.iter().all(|(_, rule)| *rule == "machine-dependent"), "{found:?}\n{text}");
    }
}

/// A plate of 40 by 20 with corners of R 2, cut from a hole in it: absolute, in mm.
const PLATE: &str = "G92 X20.000 Y5.000\nG90\nG01 X20.000 Y0.000\nG01 X38.000 Y0.000\nG03 X40.000 Y2.000 I0.000 J2.000\nG01 X40.000 Y18.000\nG03 X38.000 Y20.000 I-2.000 J0.000\nG01 X2.000 Y20.000\nG03 X0.000 Y18.000 I0.000 J-2.000\nG01 X0.000 Y2.000\nG03 X2.000 Y0.000 I2.000 J0.000\nG01 X20.000 Y0.000\nG01 X20.000 Y5.000\nM02\n";

/// What stands in the place of a line of the plate (from 1) makes such findings at lines, and the first fix of the first finding that has
/// one makes the plate again.
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
        .find_map(|finding| document.fixes(finding).into_iter().next())
        .unwrap_or_else(|| panic!("no fix: {with}"));
    let mut fixed = document.clone();
    fix.edit
        .iter()
        .rev()
        .for_each(|edit| fixed.edit(edit.range.clone(), &edit.text));
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
            // What goes leaves a node on a straight wall.
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

#[test]
fn compensation_and_subprograms_are_ended_and_complete() {
    let hole = |on: &str, mid: &str, off: &str| {
        format!(
            "G92 X0 Y0\nG90\n{on}\nG01 X5000 Y0\nY5000\n{mid}X-5000\nY-5000\nX5000\nY0\n{off}X0\nM02\n"
        )
    };
    check(&hole("G41 D1", "", "G40\n"), &[]);
    check(&hole("G41", "", "G40\n"), &[(3, "missing-offset")]);
    check(&hole("D3\nG41", "", "G40\n"), &[]);
    check(&hole("G41 D1", "G42\n", "G40\n"), &[(6, "side-change")]);
    check(&hole("G41 D1", "", ""), &[(11, "missing-cancel")]);
    assert_eq!(
        fixed(
            &hole("G41 D1", "G42\n", "G40\n"),
            "side-change",
            "Let the wire"
        ),
        hole("G41 D1", "G41\n", "G40\n")
    );
    assert_eq!(
        fixed(
            &hole("G41 D1", "", ""),
            "missing-cancel",
            "Insert the block G40"
        ),
        hole("G41 D1", "", "G40\n")
    );
    let two = |on: &str| {
        hole(on, "", "G40\n").replace("M02\n", "") + "M00\n" + &hole("G41 D1", "", "G40\n")
    };
    assert_eq!(
        fixed(&two("G41"), "missing-offset", "Write D1"),
        two("G41 D1")
    );
    let sub = |end: &str| format!("G92 X0 Y0\nM98 P1\nM02\nO1\nG01 X1000\nY1000\nX0 Y0{end}\n");
    check(&sub("\nM99"), &[]);
    check(&sub(""), &[(7, "missing-return")]);
    assert_eq!(
        fixed(&sub(""), "missing-return", "Insert the block M99"),
        sub("\nM99")
    );
}

/// The lines and arcs that a program runs along.
fn way(text: &str) -> Vec<crate::geometry::Segment> {
    let steps = read(text).trace().steps.into_iter();
    steps.filter_map(|step| step.ideal).collect()
}

#[test]
fn corner_words_are_followed() {
    let square = |first: &str, second: &str| {
        format!(
            "G92 X0. Y0.\nG90\nG01 X10. Y0.{first}\nX10. Y10.{second}\nX0. Y10.\nX0. Y0.\nM02\n"
        )
    };
    let rounded = |i: &str| {
        format!(
            "G92 X0. Y0.\nG90\nG01 X8. Y0.\nG03 X10. Y2. {i}\nG01 X10. Y10.\nX0. Y10.\nX0. Y0.\nM02\n"
        )
    };
    for (text, meant) in [
        (square(" R2.", ""), rounded("I0. J2.")),
        (square(" ,R2.", ""), rounded("I0. J2.")),
        (square(",C2.", ""), "G92 X0. Y0.\nG90\nG01 X8. Y0.\nX10. Y2.\nX10. Y10.\nX0. Y10.\nX0. Y0.\nM02\n".into()),
        (
            square(" R2.", " R3."),
            "G92 X0. Y0.\nG90\nG01 X8. Y0.\nG03 X10. Y2. J2.\nG01 X10. Y7.\nG03 X7. Y10. I-3. J0.\nG01 X0. Y10.\nX0. Y0.\nM02\n".into(),
        ),
        ("G92 X0. Y0.\nG91\nG01 X10. R2.\n(a comment)\nY10.\nX-10.\nY-10.\nM02\n".into(), rounded("I0. J2.")),
    ] {
        assert_eq!(way(&text), way(&meant), "{text}");
        assert_eq!(faults(&text, &Effective::default()), [], "{text}");
    }
    // Between an arc and a line both foot points lie on them, and the joints are tangent.
    let text = "G92 X0. Y0.\nG90\nG03 X10. Y0. R8. ,R1.\nG01 X10. Y10.\nX0. Y10.\nX0. Y0.\nM02\n";
    let [first, corner, next, ..] = way(text)[..] else {
        panic!("{text}")
    };
    assert!(
        (corner.as_arc().unwrap().radius - 1000.0).abs() < 0.01,
        "{corner:?}"
    );
    for (one, other) in [(first, corner), (corner, next)] {
        assert!(
            (one.end_tangent() - other.start_tangent()).norm() < 1e-5
                && (one.end() - other.start()).norm() < 1e-9,
            "{text}"
        );
    }
    check(
        "G92 X0. Y0.\nG90\nG01 X10. Y0. R20.\nX10. Y10.\nX0. Y10.\nX0. Y0.\nM02\n",
        &[(3, "corner-word")],
    );
    check(
        "G92 X0. Y0.\nG90\nG01 X5. Y0. ,C2.\nX10. Y0.\nX10. Y10.\nX0. Y0.\nM02\n",
        &[(3, "corner-word")],
    );
}

/// Words of a corner between two cuts, each of which may be an arc, at places in mm: what comes of it keeps to both ways, leaves the one
/// and enters the other without a corner where it is round, and lies at its distance where it is not.
#[test]
fn corner_words_between_arcs_keep_to_both_ways() {
    // How the wire comes to (10, 0), and how it goes on from there.
    let line_in = "G01 X10. Y0.";
    let arcs_in = [
        "G02 X10. Y0. R6.",
        "G03 X10. Y0. R6.",
        "G02 X10. Y0. R20.",
        "G03 X10. Y0. R20.",
    ];
    let arcs_out = [
        "G02 X10. Y10. R6.",
        "G03 X10. Y10. R6.",
        "G02 X20. Y0. R6.",
        "G03 X20. Y0. R30.",
        "G02 X14. Y8. R9.",
        "G03 X14. Y-8. R9.",
    ];
    let line_out = "G01 X10. Y10.";
    let program = |one: &str, word: &str, other: &str| {
        format!("G92 X0. Y0.\nG90\n{one}{word}\n{other}\nM02\n")
    };
    let (mut made, mut refused) = (0, 0);
    let pairs = arcs_in
        .iter()
        .flat_map(|one| arcs_out.iter().map(move |other| (*one, *other)))
        .chain(arcs_in.iter().map(|one| (*one, line_out)))
        .chain(arcs_out.iter().map(|other| (line_in, *other)));
    for (one, other) in pairs {
        let sharp = way(&program(one, "", other));
        for radius in [0.05, 0.5, 1.0, 2.0, 4.0, 50.0] {
            let text = program(one, &format!(" ,R{radius:?}"), other);
            let found: Vec<&str> = faults(&text, &Effective::default())
                .into_iter()
                .map(|(_, rule)| rule)
                .collect();
            let own = way(&text);
            if found.contains(&"corner-word") {
                // No room: both cuts stay as they are.
                assert_eq!(own, sharp, "{text}");
                refused += 1;
                continue;
            }
            made += 1;
            let [first, corner, next] = own[..] else {
                panic!("{text}{own:?}")
            };
            let arc = corner.as_arc().unwrap_or_else(|| panic!("{text}"));
            assert!((arc.radius - radius * 1e3).abs() < 0.02, "{text}{corner:?}");
            assert!(
                arc.sweep.abs() < std::f64::consts::PI + 1e-6,
                "{text}{corner:?}"
            );
            for (short, whole) in [(first, sharp[0]), (next, sharp[1])] {
                assert!(short.length() <= whole.length() + 0.01, "{text}");
                for share in [0.0, 0.3, 0.7, 1.0] {
                    assert!(whole.distance_to(short.point_at(share)) < 0.02, "{text}");
                }
            }
            assert!((first.start() - sharp[0].start()).norm() < 1e-9, "{text}");
            assert!((next.end() - sharp[1].end()).norm() < 1e-9, "{text}");
            for (a, b) in [(first, corner), (corner, next)] {
                // Places are whole nm.
                let tangent = 2e-3 / (radius * 1e3) + 1e-5;
                assert!((a.end() - b.start()).norm() < 1e-9, "{text}");
                assert!(
                    (a.end_tangent() - b.start_tangent()).norm() < tangent,
                    "{text}{a:?}\n{b:?}"
                );
            }
        }
        // A chamfer stands between straight cuts.
        let text = program(one, ",C1.", other);
        assert!(
            faults(&text, &Effective::default())
                .iter()
                .any(|(_, rule)| *rule == "corner-word"),
            "{text}"
        );
        assert_eq!(way(&text), sharp, "{text}");
    }
    assert!(made > 80 && refused > 34, "{made} made, {refused} refused");
}

#[test]
fn corner_words_that_find_no_corner_leave_the_cuts_as_they_are() {
    for (text, is_said) in [
        // Tangent already, back on the same way, nothing behind, a stop, a rapid, no length.
        ("G01 X10. Y0. ,R1.\nX20.\nM02\n", true),
        ("G01 X10. Y0. ,R1.\nG03 X20. Y10. R10.\nM02\n", true),
        ("G01 X10. Y0. ,R1.\nX0.\nM02\n", true),
        ("G01 X10. Y0. ,R1.\nM02\n", true),
        ("G01 X10. Y0. ,R1.\nM00\nG01 Y10.\nM02\n", true),
        ("G01 X10. Y0. ,R1.\nG00 Y10.\nM02\n", true),
        ("G03 X10. Y0. R6. ,R1.\nG92 X0. Y0.\nG01 Y10.\nM02\n", true),
        ("G03 X10. Y0. R6. ,R0.\nG01 Y10.\nM02\n", true),
        ("G03 X10. Y0. R6. ,R-1.\nG01 Y10.\nM02\n", true),
        ("G01 X10. Y0. ,C11.\nY10.\nM02\n", true),
        ("G01 X10. Y0.\nY10.\nM02\n", false),
    ] {
        let text = format!("G92 X0. Y0.\nG90\n{text}");
        let without = text
            .replace(" ,R-1.", "")
            .replace(" ,R1.", "")
            .replace(" ,R0.", "")
            .replace(" ,C11.", "");
        let said = faults(&text, &Effective::default())
            .iter()
            .any(|(_, rule)| *rule == "corner-word");
        assert_eq!(said, is_said, "{text}");
        assert_eq!(way(&text), way(&without), "{text}");
    }
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
        &[(8, "small-radius"), (10, "small-radius")],
    );
    check(
        &slot("H1 = .03 + H175\n"),
        &[
            (1, "machine-dependent"),
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
fn ways_that_come_back_are_no_faults() {
    // The next pass, back along the same contour, has the wire on its other side: from where the first began.
    check(
        "G92 X0. Y0.\nG90\nG41 D1\nG01 X5. Y0.\nY5.\nX-5.\nY-5.\nX5.\nY0.\nG42 D1\nY-5.\nX-5.\nY5.\nX5.\nY0.\nG40\nX0.\nM02\n",
        &[],
    );
    // A lens: two arcs about two centres, that turn back on each other all but.
    check(
        "G92 X99. Y-9.\nG90\nG01 X99. Y0.\nG03 X-99. Y0. I-99. J-4900.\nG03 X99. Y0. I99. J4900.\nG01 X108. Y9.\nM02\n",
        &[],
    );
}

#[test]
fn lines_that_name_places_do_not_move_with_what_stands_before_them() {
    // Steps move with what stands before them, places do not: where the one goes over into the other, all is read again.
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
        let fresh = Document::read(document.text().bytes().to_vec());
        assert_eq!(document.trace(), fresh.trace(), "{steps} steps");
        assert_eq!(document.findings(), fresh.findings(), "{steps} steps");
    }
}

/// Lines that programs are made of, with some that are damaged.
fn line() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => (prop::sample::select(vec!["G01 ", "G00 ", "", "N5 G01 "]), -50_i32..50, -50_i32..50).prop_map(|(g, x, y)| format!("{g}X{x} Y{y}")),
        3 => (-50_i32..50, -50_i32..50).prop_map(|(i, j)| format!("G02 X{} Y0 I{i} J{j}", 2 * i)),
        2 => (-50_i32..50).prop_map(|x| format!("G01 X{x}.5")),
        1 => prop::sample::select(vec![
            "G90", "G91", "G92 X0 Y0", "G41 D1", "G42", "G40", "M00", "M02", "G20", "X1 Y", "(comment)", "", "G28 X0", "T84", "G03 X5 Y5 J5", "M30", "%",
            "G03 X0 Y0 I5", "R5 G02 X5", "H1=80", "X#1",
        ])
        .prop_map(str::to_owned),
        1 => "[GXYIJN0-9. (;%/-]{0,8}",
    ]
}

/// A closed contour with what is right with it, or not: compensation, a rounded corner, a crossing, numbers.
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
        edits in prop::collection::vec((0_usize..6000, 0_usize..3, prop::sample::select(vec!["", "5", "1", "\n", "G90 ", "M00\n", "H1=2000\n", "X"])), 1..6),
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
    fn any_bytes_are_read(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let document = Document::read(bytes);
        let trace = document.trace();
        prop_assert!(document.findings().iter().all(|finding| !finding::sentence(finding, 1.0).is_empty()));
        prop_assert!(trace.steps.iter().all(|step| step.range.end <= document.text().len()));
    }
}

#[test]
fn a_line_that_cannot_be_read_says_nothing_of_a_cut_that_was_over_before_it() {
    // Between the two, the text falls into stretches somewhere.
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
