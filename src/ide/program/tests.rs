use super::words::WordKind;
use super::words_of;
use super::*;
use crate::ide::{CompletionKind, FoldKind, Symbol};
use crate::program::{Document, Language, refactorings};
use crate::settings::Effective;

/// A plate with a round hole and a square one: lead-in, contour, lead-out, and the way between them.
const PLATE: &str = "; Start Point = 0.000 , 0.000\n; two openings\nN1 B9900B0B9900GXL1\nN2 B9900B0B39600GYNR1\nN3 B9900B0B9900GXL3\nD\n\
                     N4 B50000B0B50000GXL1\nD\nN5 B5000B0B5000GXL1\nN6 B0B5000B5000GYL2\nN7 B10000B0B10000GXL3\nN8 B0B10000B10000GYL4\n\
                     N9 B10000B0B10000GXL1\nN10 B0B5000B5000GYL2\nN11 B5000B0B5000GXL3\nDD\n";

fn read(text: &str) -> Document {
    Document::read(Language::ThreeB, text.into(), &Effective::default())
}

/// Byte of the cursor, which is `|` in the text, and the text without it.
fn at_cursor(text: &str) -> (Document, usize) {
    let offset = text.find('|').unwrap();
    (read(&text.replacen('|', "", 1)), offset)
}

#[track_caller]
fn says(text: &str, expected: &[&str]) {
    let (document, offset) = at_cursor(text);
    let said = hover(&document, offset)
        .unwrap_or_else(|| panic!("nothing is reported about {text}"))
        .text;
    for expected in expected {
        assert!(
            said.contains(expected),
            "{text}: no {expected:?} in {said:?}"
        );
    }
}

#[test]
fn hover_says_where_a_block_goes_and_what_its_words_mean() {
    says(
        "|B9900B0B9900GXL1",
        &[
            "**B** leads",
            "**line** to (9.900, 0.000) mm",
            "length 9.900 mm, direction 0°",
        ],
    );
    says(
        "N3: B99|00B0B9900GXL1",
        &["**X** of a line", "**N3: line**"],
    );
    says(
        "B9900B0B9900GXL1\nB|9900B0B39600GYNR1",
        &[
            "**X** of an arc",
            "**circle** counter-clockwise about (0.000, 0.000) mm, R 9.900 mm, 360°",
        ],
    );
    says(
        "B9900B0B39600GYNR1|",
        &["**NR1** counter-clockwise arc that starts in quadrant 1"],
    );
    says(
        "B3000B4000B3|000GXL2",
        &[
            "**J** counting length",
            "the line's projection on the X axis",
        ],
    );
    says(
        "B5B0B5GXL1\nD|D",
        &["**end** of the program", "at (0.005, 0.000) mm"],
    );
    says("B0B5000B10000B50|00GXDDNR1", &["radius of a 4B arc"]);
    let (document, offset) = at_cursor("; not| a word\n");
    assert_eq!(hover(&document, offset), None);
}

#[test]
fn contours_are_found_with_their_ways_in_and_out() {
    #[track_caller]
    fn check(text: &str, expected: &[(usize, usize, usize, bool)]) {
        let found = crate::program::path::cuts(&read(text).trace());
        let found: Vec<_> = found
            .iter()
            .map(|cut| (cut.steps.len(), cut.lead_in, cut.lead_out, cut.closed))
            .collect();
        assert_eq!(found, expected, "{text}");
    }
    check(PLATE, &[(3, 1, 1, true), (1, 0, 0, false), (7, 1, 1, true)]);
    // A square without ways.
    check(
        "B5B0B5GXL1\nB0B5B5GYL2\nB5B0B5GXL3\nB0B5B5GYL4\n",
        &[(4, 0, 0, true)],
    );
    // In, round, and no way out.
    check(
        "B5000B0B5000GXL1\nB5000B0B20000GYNR1\nDD\n",
        &[(2, 1, 0, true)],
    );
    check("B5000B0B5000GXL1\nB0B7000B7000GYL2\n", &[(2, 0, 0, false)]);
    check("", &[]);
}

/// Three passes of a square at 160, 125 and 95 µm, then another square after a way.
#[test]
fn symbols_tell_passes_from_contours() {
    let square = |size: i64, at: i64| {
        let out = size / 2;
        let turn = format!(
            "B{size}B0B{size}GXL1\nB0B{size}B{size}GYL2\nB{size}B0B{size}GXL3\nB0B{size}B{size}GYL4\n"
        );
        format!("B{out}B{out}B{out}GXL3\n{turn}B{out}B{out}B{out}GXL1\nD\nB{at}B0B{at}GXL1\nD\n")
    };
    let stay = |size: i64| square(size, 1).replace("B1B0B1GXL1\nD\n", "");
    let program = [stay(9680), stay(9750), square(9810, 40_000), stay(5000)].concat() + "DD\n";
    let named: Vec<String> = symbols(&read(&program))
        .into_iter()
        .filter(|symbol| symbol.kind == crate::ide::SymbolKind::Cut)
        .map(|symbol| symbol.name)
        .collect();
    let passes = [
        "contour 1, pass 1",
        "contour 1, pass 2",
        "contour 1, pass 3",
    ];
    assert_eq!(named, [&passes[..], &["contour 2"]].concat());
}

#[test]
fn symbols_are_contours_with_their_blocks() {
    fn list(symbols: &[Symbol], depth: usize, lines: &mut Vec<String>) {
        for symbol in symbols {
            lines.push(format!(
                "{}{} | {}",
                "  ".repeat(depth),
                symbol.name,
                symbol.detail
            ));
            for child in &symbol.children {
                assert!(
                    symbol.range.start <= child.range.start && child.range.end <= symbol.range.end,
                    "{symbol:?}"
                );
                assert!(
                    child.range.start <= child.selection.start
                        && child.selection.end <= child.range.end,
                    "{child:?}"
                );
            }
            list(&symbol.children, depth + 1, lines);
        }
    }
    let mut lines = Vec::new();
    list(&symbols(&read(PLATE)), 0, &mut lines);
    let expected = "contour 1 | closed, 1 block, cut 82.004 mm (19.800 mm of it leads), counter-clockwise\n  lead-in | line to (9.900, 0.000)\n  N2 | circle R 9.900\n  \
                    lead-out | line to (0.000, 0.000)\npause | ";
    assert_eq!(lines[..5].join("\n"), expected);
    assert_eq!(lines.last().unwrap(), "end | ");
}

#[test]
fn contours_and_comments_fold() {
    let found: Vec<_> = folds(&read(PLATE), 100)
        .into_iter()
        .map(|fold| (fold.first, fold.last, fold.kind == FoldKind::Comment))
        .collect();
    assert_eq!(found, [(0, 1, true), (2, 4, false), (8, 14, false)]);
    assert_eq!(folds(&read(PLATE), 1).len(), 1);
}

#[test]
fn hints_say_what_the_text_does_not() {
    let document = read("B9900B0B9900GXL1\nB9900B0B39600GYNR1 ; 9.9 , 0\nD\n");
    let found: Vec<_> = hints(&document, 0..document.text().len())
        .into_iter()
        .map(|hint| (hint.offset, hint.text))
        .collect();
    assert_eq!(
        found,
        [
            (16, "→ 9.900, 0.000".into()),
            (35, "R 9.900, 360°".to_owned())
        ]
    );
}

#[test]
fn what_belongs_together_is_found_from_both_ends() {
    #[track_caller]
    fn check(line: usize, expected: usize) {
        let document = read(PLATE);
        let offset = document.text().line_range(line).end - 1;
        let found = match_of(&document, offset).map(|range| document.text().line_of(range.start));
        assert_eq!(found, Some(expected), "line {line}");
        assert!(highlights(&document, offset).len() <= 2);
    }
    // Pause to pause, pause to end, end to the beginning.
    check(5, 7);
    check(7, 15);
    check(15, 2);
    // In and out.
    check(2, 4);
    check(14, 8);
    // Round the contour.
    check(9, 13);
    check(10, 13);
    check(13, 9);
    assert_eq!(pauses(&read(PLATE)).len(), 3);
}

#[test]
fn selections_grow() {
    let (document, offset) = at_cursor("B5B0B5GXL1\nB0B5B|5GYL2 ; x\nB5B0B5GXL3\nB0B5B5GYL4\nDD\n");
    let found: Vec<_> = selections(&document, offset)
        .into_iter()
        .map(|range| (range.start, range.end))
        .collect();
    assert_eq!(found, [(15, 16), (11, 21), (11, 25), (0, 47), (0, 51)]);
}

#[test]
fn numbers_are_renamed_counted_and_left_out() {
    let apply = |document: &Document, edits: Vec<crate::text::TextEdit>| {
        let mut text = String::from_utf8(document.text().bytes().to_vec()).unwrap();
        edits
            .iter()
            .rev()
            .for_each(|edit| text.replace_range(edit.range.clone(), &edit.text));
        text
    };
    let document = read("N10 B5B0B5GXL1\nB5B0B5GXL1\nN    7: B5B0B5GXL1\nDD\n");
    let refactored = |id: &str| {
        let wanted = |its: &str| its.strip_prefix("refactor.rewrite.") == Some(id);
        let mut found = refactorings(&document, &Effective::default(), 0..0, wanted);
        apply(&document, found.remove(0).edits.unwrap())
    };
    assert_eq!(
        refactored("number"),
        "N1 B5B0B5GXL1\nN2 B5B0B5GXL1\nN    3: B5B0B5GXL1\nDD\n"
    );
    assert_eq!(
        refactored("withoutNumbers"),
        "B5B0B5GXL1\nB5B0B5GXL1\nB5B0B5GXL1\nDD\n"
    );
    assert_eq!(number_at(&document, 1), Some((1..3, 10)));
    assert_eq!(number_at(&document, 6), None);
    assert_eq!(
        renamed(&document, 1, "N20").map(|edits| apply(&document, edits)),
        Ok("N20 B5B0B5GXL1\nB5B0B5GXL1\nN    7: B5B0B5GXL1\nDD\n".into())
    );
    assert_eq!(
        renamed(&document, 1, "7"),
        Err("N7 is the block in line 3".into())
    );
    assert_eq!(
        renamed(&document, 1, "x"),
        Err("\"x\" is not a block number, expected up to 8 digits".into())
    );
}

#[test]
fn pieces_of_iso_are_named_too() {
    let document = Document::read(
        Language::Iso,
        b"N10 G01 X1.5 (x)\nM02\n".to_vec(),
        &Effective::default(),
    );
    let kinds: Vec<_> = words_of(&document, 0)
        .into_iter()
        .map(|part| part.kind)
        .collect();
    assert_eq!(
        kinds,
        [
            WordKind::Number,
            WordKind::Motion,
            WordKind::Length,
            WordKind::Comment
        ]
    );
}

#[track_caller]
fn offers(text: &str, expected: &[(&str, &str)]) {
    let (document, offset) = at_cursor(text);
    let found = completions(&document, offset);
    for (label, about) in expected {
        assert!(
            found
                .iter()
                .any(|found| found.label == *label && found.about.contains(about)),
            "{text}: no {label} ({about}) in {found:#?}"
        );
    }
    // Each makes a block that reads without a fault.
    for completion in found
        .iter()
        .filter(|found| found.kind != CompletionKind::Snippet)
    {
        let mut whole = text.replacen('|', "", 1);
        whole.replace_range(completion.range.clone(), &completion.text);
        assert_eq!(
            read(&whole)
                .findings(&Effective::default(), 99)
                .0
                .iter()
                .find(|finding| finding.rule == crate::finding::Rule::Syntax
                    && finding.severity == crate::finding::Severity::Error),
            None,
            "{whole}"
        );
    }
}

#[test]
fn the_rest_of_a_block_is_offered_from_its_first_numbers() {
    offers(
        "B9900B0B|",
        &[
            ("9900GXL1", "line to (9.900, 0.000)"),
            ("9900GXL3", "(-9.900, 0.000)"),
            ("39600GYNR1", "circle R 9.900"),
            ("19800GYSR4", "180.0° clockwise"),
        ],
    );
    offers(
        "B3000B4000B|",
        &[
            ("4000GYL1", "(3.000, 4.000)"),
            ("4000GYL3", "(-3.000, -4.000)"),
        ],
    );
    offers("B5B0B5GXL1\nB3B4B4|", &[("GYL1", "(0.008, 0.004)")]);
    offers("B3B4B4G|", &[("GYL2", "(-0.003, 0.004)")]);
    offers(
        "B3B4B4GY|",
        &[("L4", "(0.003, -0.004)"), ("NR1", "counter-clockwise")],
    );
    assert!(completions(&read("B1B2B3GXL1"), 10).is_empty());
    assert!(completions(&read("B1B2"), 4).is_empty());
}

#[test]
fn a_new_line_is_offered_the_way_back_and_the_words() {
    offers(
        "|",
        &[("D", "pause"), ("DD", "end"), ("B X B Y B", "third B")],
    );
    offers(
        "B5B0B5GXL1\nB0B7B7GYL2\n|",
        &[
            ("B5B7B7GYL3", "back to the start"),
            ("B0B7B7GYL4", "end of the lead-in"),
        ],
    );
    offers(
        "B5000B0B5000GXL1\nB5000B0B20000GYNR1\nD|",
        &[("B5000B0B5000GXL3", "back to the start"), ("DD", "end")],
    );
}

#[test]
fn the_form_of_a_block_shows_where_the_cursor_is() {
    for (text, active) in [
        ("B|", Some("X")),
        ("B99|00B0", Some("X")),
        ("B9900B|", Some("Y")),
        ("B9900B0B12|", Some("J")),
        ("B9900B0B12G|", Some("G")),
        ("B9900B0B12GX|", Some("G")),
        ("B9900B0B12GX |", Some("Z")),
        ("B9900B0B12GXL1|", Some("Z")),
        ("B0B5B10B5|GXDDNR1", Some("R")),
        ("; B|", None),
        ("D|", None),
        ("|B", None),
    ] {
        let (document, offset) = at_cursor(text);
        let found = signature(&document, offset).map(|found| found.parameters[found.active].0);
        assert_eq!(found, active, "{text}");
    }
}
