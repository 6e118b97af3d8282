//! What words mean, what can follow, which belong together. The cursor is `|` in the text.

use super::*;
use crate::ide::CompletionKind;
use crate::program::iso::Document;
use crate::settings::{Effective, from_toml};

fn settings(profile: &str) -> Effective {
    Effective::of(&from_toml(&format!("[program]\nprofile = \"{profile}\"\n")).0)
}

fn at_cursor(text: &str, settings: &Effective) -> (Document, usize) {
    let offset = text.find('|').unwrap();
    (
        Document::read_with(text.replacen('|', "", 1).into_bytes(), settings),
        offset,
    )
}

#[test]
fn every_word_says_what_it_means() {
    #[track_caller]
    fn check(text: &str, expected: &str) {
        let start = text.find('|').unwrap();
        let document = Document::read(text.replacen('|', "", 1).into_bytes());
        let said = meaning(&document, start..text.len() - 1).unwrap_or_default();
        let word = meaning(&document, start..start + 1).unwrap_or(said);
        assert!(word.contains(expected), "{text}: {word}");
    }
    check("|G01 X1.5", "cuts along a straight line");
    check("|g03 x1. y0 i.5", "counter-clockwise");
    check("G01 |X1.5", "to X 1.500 mm from the program's zero");
    check(
        "G91\nG01 |X1500",
        "1.500 mm along X from where the wire stands",
    );
    check("G20\nG01 |X1.", "to X 25.400 mm");
    check("G92 |X5.", "the wire stands at X 5.000 mm");
    check("G04 |X5.", "for the word of this line that takes it");
    check(
        "G91 G03 X5. Y5. |J5.",
        "from the arc's start to its centre (found from the arcs of this program",
    );
    check(
        "G91 G03 X5. Y5. |J-5.",
        "from the arc's centre to its start",
    );
    check(
        "G90 G03 X5. Y5. I0. J5.\nX0. Y10. |I0. J5.\nX-5. Y5. I0. J5.",
        "the arc's centre lies at X 0.000 mm",
    );
    check("G03 X0. Y0. |I5. J0.", "the arcs leave that open");
    check("G41 |D3", "offset register 3, not a length");
    check(
        "H1=110\nG41 |H1\nG01 X5",
        "0.110 mm, as this program sets it",
    );
    check("|H1=110\nG01 X5", "value of an offset register");
    check("G01 X1. |F3.2", "feed; its unit depends on the machine");
    check("|T84", "depends on the machine: a switch");
    check("|G50", "depends on the machine: ends the taper");
    check("|M50", "depends on the machine: cuts the wire off");
    check("|M02", "end of the program");
    check("|N10 G01 X1.", "block number");
    check("M98 |P5\nM02\nN5 M99", "begins at N5");
    check("G04 |P5", "how long the machine waits");
    check("|E0001", "a cutting condition");
    check("|G999", "depends on the machine: it is kept, not followed");
    check("|#1=5", "depends on the machine");
    check("|%\n", "on tape");
    let document = Document::read(b"(only a comment)".to_vec());
    assert_eq!(meaning(&document, 0..16), None);
}

#[track_caller]
fn offers(text: &str, settings: &Effective, expected: &[(&str, &str)]) -> Vec<String> {
    let (document, offset) = at_cursor(text, settings);
    let found = completions(&document, offset);
    for (label, about) in expected {
        assert!(
            found
                .iter()
                .any(|found| found.text == *label && found.about.contains(about)),
            "{text}: no {label} ({about}) in {found:#?}"
        );
    }
    for completion in found
        .iter()
        .filter(|completion| completion.kind != CompletionKind::Snippet)
    {
        // Each makes a line that can be read, with no arc off its radius.
        let mut whole = text.replacen('|', "", 1);
        whole.replace_range(completion.range.clone(), &completion.text);
        let bad = |text: &str| {
            let document = Document::read_with(text.as_bytes().to_vec(), settings);
            let rules = ["syntax", "arc-off-radius"];
            document
                .findings()
                .iter()
                .filter(|finding| rules.contains(&finding.rule.name()))
                .count()
        };
        assert!(bad(&whole) <= bad(&text.replacen('|', "", 1)), "{whole}");
    }
    found.into_iter().map(|found| found.text).collect()
}

#[test]
fn the_centre_of_an_arc_is_offered_from_its_end() {
    let any = Effective::default();
    // Tangent to the cut before, a quarter turn, a half turn.
    offers(
        "G92 X0. Y0.\nG90\nG01 X10. Y0.\nG03 X15. Y5. |\n",
        &any,
        &[(
            "I0. J5.",
            "R 5.000, 90.0°, leaves the block before it without a corner",
        )],
    );
    offers(
        "G92 X0. Y0.\nG91\nG01 X10. Y0.\nG02 X0. Y-10. |",
        &any,
        &[(
            "I0. J-5.",
            "180.0°, leaves the block before it without a corner",
        )],
    );
    offers(
        "G91\nG01 X10. Y0.\nG03 X5. Y5. I|",
        &any,
        &[("I0. J5.", "90.0°")],
    );
    // The unfinished letter is replaced; of a half-given centre the other half follows.
    offers(
        "G91\nG01 X10. Y0.\nG03 X5. Y5. I0. J|",
        &any,
        &[("J5.", "R 5.000")],
    );
    // The arc that R means, instead of R.
    offers(
        "G91\nG01 X10. Y0.\nG03 X6. Y2. R10.|",
        &any,
        &[("I0. J10.", "the arc that R means")],
    );
    // As this program writes its arcs, and in its number format.
    let text = "G90\nG03 X5000 Y5000 I0 J5000\nX0 Y10000 I0 J5000\nX-5000 Y5000 I0 J5000\nG01 X-5000 Y0\nG03 X0 Y-5000 |";
    offers(text, &any, &[("I0 J0", "R 5.000, 90.0°, leaves")]);
    let text =
        "G91\nG03 X5000 Y5000 I0 J-5000\nX-5000 Y5000 I5000 J0\nG01 X0 Y5\nG02 X5000 Y5000 |";
    offers(text, &any, &[("I-5000 J0", "R 5.000, 90.0°, leaves")]);
    // Nothing is offered for a circle with an unknown middle, nor in a comment.
    assert_eq!(offers("G03 X0. Y0. |", &any, &[]), Vec::<String>::new());
    assert_eq!(offers("G03 X5. Y5. (|", &any, &[]), Vec::<String>::new());
}

#[test]
fn a_new_line_is_offered_what_the_cut_and_the_profile_want() {
    let any = Effective::default();
    let cut = "G92 X0. Y0.\nG90\nG01 X5. Y0.\nX5. Y5.\nX0. Y5.\n|";
    offers(
        cut,
        &any,
        &[
            ("G01 X0. Y0.", "back to the start"),
            ("G01 X5. Y0.", "end of the lead-in"),
            ("G91", ""),
            ("M00", "stop"),
        ],
    );
    offers(
        "G92 X0 Y0\nG91\nG01 X5000\nG01 Y5000\n|",
        &any,
        &[("G01 X-5000 Y-5000", "back"), ("G90", "absolute")],
    );
    offers(
        "G41 D7\nG01 X5. Y0.\n|",
        &any,
        &[("G40", "ends the correction")],
    );
    offers(
        "H3=110\nG01 X5\n|",
        &any,
        &[("G41 H3", "left"), ("G42 H3", "right")],
    );
    offers(
        "G01 X5. \nG41 |",
        &any,
        &[("D0", "register"), ("D1", "register")],
    );
    offers("H3=110\nG41 H|", &any, &[("H3", "0.110 mm")]);
    offers("N10 G01 X5.\nN20 X6.\n|", &any, &[("N30", "next")]);
    offers("N10 G01 X5.\nN20 X6.\nN|", &any, &[("N30", "next")]);
    offers(
        "|",
        &settings("robofil"),
        &[
            ("G60", "profile"),
            ("G38", "profile"),
            ("G41 D0", ""),
            ("M02", "end"),
        ],
    );
    offers(
        "|",
        &settings("fast-wire"),
        &[("G92 X0 Y0", "wire stands"), ("G91", "")],
    );
    offers(
        "G|",
        &settings("robofil"),
        &[("G01", "straight"), ("G38", "profile"), ("G92", "stands")],
    );
    offers("G0|", &any, &[("G02", "clockwise")]);
    offers(
        "G01 X1.\nM|",
        &any,
        &[("M00", "stop"), ("M02", "end of the program")],
    );
    offers(
        "G01 X1.\nM98 P|\nM02\nN5 G01 X0.\nM99\n",
        &any,
        &[("P5", "line 4: N5 G01 X0.")],
    );
    offers("G92 |", &any, &[("X0.000 Y0.000", "zero")]);
}

#[test]
fn the_form_of_a_block_shows_where_the_cursor_is() {
    #[track_caller]
    fn check(text: &str, expected: Option<(&str, &str, &str)>) {
        let (document, offset) = at_cursor(text, &Effective::default());
        let found = signature(&document, offset);
        let found = found.map(|found| {
            (
                found.label,
                found.parameters[found.active].0,
                found.parameters[found.active].1,
            )
        });
        match (found, expected) {
            (Some(found), Some(expected)) => {
                assert_eq!((found.0, found.1), (expected.0, expected.1), "{text}");
                assert!(found.2.contains(expected.2), "{text}: {found:?}");
            }
            (found, expected) => {
                assert_eq!(found.is_some(), expected.is_some(), "{text}: {found:?}")
            }
        }
    }
    check("G01 |", Some(("G01 X Y", "X", "(G90)")));
    check("G91\nG01 X5.|", Some(("G01 X Y", "X", "(G91)")));
    check("G01 X5. |", Some(("G01 X Y", "Y", "")));
    check(
        "G03 X5. Y5. I|0. J5.",
        Some(("G03 X Y I J", "I", "from the arc's start to its centre")),
    );
    check("G02 X5. Y5. |", Some(("G02 X Y I J", "I", "")));
    check("G02 X5. Y5. R3|.", Some(("G02 X Y R", "R", "radius")));
    check("G03\nX5.|", Some(("G03 X Y I J", "X", "")));
    check("G92 X|", Some(("G92 X Y", "X", "where the wire stands")));
    check("G41 D|", Some(("G41 D", "D", "register")));
    check("M98 P|", Some(("M98 P L", "P", "subprogram")));
    check("G04 P|", Some(("G04 P", "P", "how long")));
    check("|", None);
    check("(G01 |", None);
    check("T84|", None);
}

#[test]
fn words_that_belong_together_are_found_from_both_ends() {
    #[track_caller]
    fn check(text: &str, expected: Option<&str>) {
        let (document, offset) = at_cursor(text, &Effective::default());
        let found = partner(&document, offset).map(|(_, other)| {
            let line = document.text().line_of(other.start);
            format!(
                "{}:{}",
                line + 1,
                String::from_utf8_lossy(&document.text().bytes()[other])
            )
        });
        assert_eq!(found.as_deref(), expected, "{text}");
    }
    check("|G41 D1\nG01 X5\nG40\nG01 X0", Some("3:G40"));
    check("G42 D1\nG01 X5\nG|40\nG01 X0", Some("1:G42"));
    check("|%\nG01 X5\nM02\n%\n", Some("4:%"));
    check("%\nG01 X5\nM02\n%|\n", Some("1:%"));
    check("M98 |P5\nM02\nN5 G01 X0.\nM99\n", Some("3:N5"));
    check("|M98 P5\nM02\nO5\nG01 X0.\nM99\n", Some("3:O5"));
    check("M98 P5\nM02\nN5 G01 X0.\n|M99\n", Some("3:N5"));
    check("|G01 X5\n", None);
}

#[test]
fn what_a_program_names_is_found_wherever_it_stands() {
    #[track_caller]
    fn check(text: &str, expected: &str) {
        let (document, offset) = at_cursor(text, &Effective::default());
        let found = named(&document, offset, 100, &|| false).unwrap();
        let told = found.into_iter().map(|place| {
            let (source, role) = (document.text(), place.role);
            let line = source.line_of(place.range.start) + 1;
            let word = String::from_utf8_lossy(&source.bytes()[place.range]).into_owned();
            format!("{line}:{word} {role:?}")
        });
        assert_eq!(told.collect::<Vec<_>>().join(", "), expected, "{text}");
    }
    let text = |cursor: &str| {
        let text = "H1 = .1\nH2=.0085+H001\nG41 H1 G01 X1.\nG04 P1\n";
        text.replacen(cursor, &format!("|{cursor}"), 1)
    };
    check("M98 P5\nM02\nN|5 G01 X0.\nM99\n", "1:P5 Uses, 3:N5 Defines");
    for cursor in ["H1 =", "H001", "H1 G01"] {
        check(&text(cursor), "1:H1 Defines, 2:H001 Uses, 3:H1 Uses");
    }
    check(&text("P1"), "");
    check(
        "C001 = ON 8 OFF 12\nC0|01\nC002\nC1\n",
        "1:C001 Defines, 2:C001 Uses, 4:C1 Uses",
    );
    check("E12=3\n(E12)\n|E12 G01 X1.\n", "1:E12 Defines, 3:E12 Uses");
    check("G01 |X5.\n", "");
    check("|(N5)\n", "");
    let (document, offset) = at_cursor("|N1 G01 X5.\n", &Effective::default());
    assert!(named(&document, offset, 100, &|| true).is_err(), "stopped");
}

#[test]
fn a_row_of_a_table_is_shown_where_it_is_chosen() {
    let document = Document::read(b"C001 = ON 8 OFF 12\nG01 X1.\nC001\nC002\n".to_vec());
    let said = |line| {
        meaning(
            &document,
            document.text().line_start(line)..document.text().line_start(line) + 4,
        )
        .unwrap()
    };
    assert!(
        said(2).contains("line 1") && said(2).contains("`C001 = ON 8 OFF 12`"),
        "{}",
        said(2)
    );
    assert!(!said(3).contains("line"), "{}", said(3));
}
