//! Questions about a program.

use super::*;

#[test]
fn formatting_follows_the_layout_that_is_set_and_else_the_text() {
    let aligned = "B   9900 B      0 B   9900 GX L1  ; in\nB   9900 B      0 B  39600 GY NR1\nB   9900 B      0 B   9900 GX L3\nDD\n";
    let compact = "B9900B0B9900GXL1 ; in\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n";
    for (options, expected) in [
        (json!({}), compact),
        (json!({ "program": { "layout": "aligned" } }), aligned),
    ] {
        let mut editor = Editor::open_under(options, THREE_B, TYPED);
        let edits = editor.ask("formatting", in_lines(0, 1));
        assert_eq!(editor.edited(&edits), expected);
        let (first, rest) = (
            expected.lines().next().unwrap(),
            TYPED.split_once('\n').unwrap().1,
        );
        let edits = editor.ask("rangeFormatting", in_lines(0, 1));
        assert_eq!(editor.edited(&edits), format!("{first}\n{rest}"));
        let mut typed = in_lines(0, 1);
        typed["position"] = at(3, 0)["position"].clone();
        typed["ch"] = json!("\n");
        let edits = editor.ask("onTypeFormatting", typed);
        let third = expected.lines().nth(2).unwrap();
        assert_eq!(
            editor.edited(&edits).lines().collect::<Vec<_>>(),
            [
                TYPED.lines().next().unwrap(),
                "B9900B0B39600GYNR1",
                third,
                "dd"
            ]
        );
        editor.close();
    }
    let mut editor = Editor::open(ISO, "g01 x1.50y2\nG02  X3.  Y4. i1.\nm02\n");
    let whole = editor.ask("formatting", in_lines(1, 2));
    assert_eq!(
        editor.edited(&whole),
        "G01 X1.50 Y2\nG02 X3. Y4. I1.\nM02\n"
    );
    let part = editor.ask("rangeFormatting", in_lines(1, 2));
    assert_eq!(editor.edited(&part), "g01 x1.50y2\nG02 X3. Y4. I1.\nm02\n");
    editor.close();
}

/// What `tests/programs` says of every layout holds for what an editor gets, too.
#[test]
fn formatting_changes_nothing_of_what_is_found() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/programs/wrong");
    let found = |text: &str| {
        let settings = wedm::settings::Effective::default();
        let language = wedm::program::Language::ThreeB;
        let program = wedm::program::Document::read(language, text.into(), &settings);
        let (findings, _) = program.findings(&settings, usize::MAX);
        let mut rules: Vec<_> = findings.iter().map(|one| one.rule.name()).collect();
        rules.sort();
        rules
    };
    for name in [
        "wrong_quadrant",
        "doubled_block",
        "x_is_another",
        "coordinates_or_block",
    ] {
        let text = std::fs::read_to_string(format!("{folder}/{name}.3b")).unwrap();
        for layout in ["compact", "aligned", "checking"] {
            let options = json!({ "program": { "layout": layout } });
            let mut editor = Editor::open_under(options, THREE_B, &text);
            let edits = editor.ask("formatting", in_lines(0, 1));
            let after = editor.edited(&edits);
            assert_eq!(found(&after), found(&text), "{name} as {layout}:\n{after}");
            let edits = editor.ask("rangeFormatting", in_lines(2, 4));
            let after = editor.edited(&edits);
            assert_eq!(found(&after), found(&text), "{name} as {layout}:\n{after}");
            editor.close();
        }
    }
}

#[test]
fn a_drawing_is_not_formatted() {
    let mut editor = Editor::open(["file:///a.dxf", "dxf"], "0\nEOF\n");
    assert_eq!(editor.ask("formatting", in_lines(0, 1)), Value::Null);
    editor.close();
}

#[test]
fn each_question_about_3b_has_its_answer() {
    let mut editor = Editor::open(THREE_B, NUMBERED);
    editor.check_said(3, 4, &["**X** of an arc", "R 9.900 mm, 360°"]);
    let range =
        json!({ "start": { "line": 3, "character": 4 }, "end": { "line": 3, "character": 8 } });
    let mut references = at(5, 0);
    references["context"] = json!({ "includeDeclaration": true });
    let places = json!({ "positions": [{ "line": 2, "character": 5 }] });
    editor.check(vec![
        ("hover", at(3, 4), "/range", range),
        (
            "inlayHint",
            in_lines(2, 4),
            "*/label",
            json!(["→ 9.900, 0.000", "R 9.900, 360° → 9.900, 0.000"]),
        ),
        ("documentSymbol", json!({}), "/0/name", json!("contour 1")),
        (
            "documentSymbol",
            json!({}),
            "/0/children/*/name",
            json!(["lead-in", "N2", "lead-out"]),
        ),
        ("foldingRange", json!({}), "/0/kind", json!("comment")),
        ("foldingRange", json!({}), "/1/endLine", json!(4)),
        ("definition", at(5, 0), "*/range/start/line", json!([6])),
        (
            "documentHighlight",
            at(2, 5),
            "*/range/start/line",
            json!([2, 4]),
        ),
        (
            "references",
            references,
            "*/range/start/line",
            json!([5, 6]),
        ),
        (
            "selectionRange",
            places.clone(),
            "/0/range/start/character",
            json!(4),
        ),
        (
            "selectionRange",
            places,
            "/0/parent/range/end/character",
            json!(19),
        ),
    ]);
    let full = editor.ask("semanticTokens/full", json!({}));
    assert_eq!(full["data"].as_array().unwrap()[10..15], [1, 0, 2, 2, 0]);
    let range = editor.ask("semanticTokens/range", in_lines(2, 4));
    assert_eq!(range["data"].as_array().unwrap().len(), 2 * 9 * 5);
    editor.close();
}

#[test]
fn each_question_about_iso_has_its_answer() {
    let mut editor = Editor::open(ISO, HOLE);
    assert_eq!(
        editor.client.open_text(ISO[0], ISO[1], HOLE),
        [] as [Value; 0]
    );
    editor.check_said(
        5,
        4,
        &[
            "**G03** cuts along an arc counter-clockwise",
            "**N50: arc** counter-clockwise about",
        ],
    );
    editor.check_said(
        5,
        16,
        &["-5.000 mm along X from the arc's start to its centre"],
    );
    editor.check_said(3, 9, &["offset register 1"]);
    let partner = |line, character, expected: u64| {
        let path = "/0/range/start/line";
        ("definition", at(line, character), path, json!(expected))
    };
    editor.check(vec![
        (
            "inlayHint",
            in_lines(4, 7),
            "*/label",
            json!([
                "→ 5.000, 0.000",
                "R 5.000, 180° → -5.000, 0.000",
                "R 5.000, 180° → 5.000, 0.000"
            ]),
        ),
        (
            "documentSymbol",
            json!({}),
            "*/name",
            json!(["contour 1", "N90", "jump to (20.000, 0.000)", "N110"]),
        ),
        (
            "documentSymbol",
            json!({}),
            "/0/children/*/name",
            json!(["lead-in", "N50", "N60", "lead-out"]),
        ),
        ("foldingRange", json!({}), "/0/startLine", json!(4)),
        ("foldingRange", json!({}), "/0/endLine", json!(8)),
        partner(3, 5, 7),
        partner(7, 5, 3),
        partner(0, 0, 12),
        partner(4, 9, 8),
        (
            "codeLens",
            json!({}),
            "*/command/title",
            json!([
                "Simulate",
                "Open picture",
                "Convert to DXF",
                "contour 1: closed, 2 blocks, cut 41.416 mm (10.000 mm of it leads), counter-clockwise"
            ]),
        ),
    ]);
    let full = editor.ask("semanticTokens/full", json!({}));
    assert!(full["data"].as_array().unwrap().len() > 5 * 30);
    let places = json!({ "positions": [{ "line": 5, "character": 5 }] });
    let selection = editor.ask("selectionRange", places);
    let around = std::iter::successors(Some(&selection[0]), |around| {
        Some(&around["parent"]).filter(|parent| !parent.is_null())
    });
    let grown: Vec<[&Value; 2]> = around
        .map(|around| ["start", "end"].map(|end| &around["range"][end]["line"]))
        .collect();
    assert_eq!(
        json!(grown),
        json!([[5, 5], [5, 5], [5, 6], [4, 8], [0, 13]])
    );
    editor.close();
}

#[test]
fn blocks_are_completed_and_their_form_is_shown() {
    let mut editor = Editor::open(ISO, "G92 X0. Y0.\nG90\nG01 X10. Y0.\nG03 X15. Y5. \n");
    editor.check(vec![
        (
            "completion",
            at(3, 13),
            "/0/textEdit/newText",
            json!("I0. J5."),
        ),
        (
            "completion",
            at(3, 13),
            "/0/detail",
            json!("R 5.000, 90.0°, leaves the block before it without a corner"),
        ),
        ("completion", at(4, 0), "/0/label", json!("G01 X0. Y0.")),
        ("signatureHelp", at(3, 13), "/activeParameter", json!(2)),
        (
            "signatureHelp",
            at(3, 13),
            "/signatures/0/label",
            json!("G03 X Y I J"),
        ),
    ]);
    editor.close();
    let mut editor = Editor::open(THREE_B, &format!("{NUMBERED}B9900B0B"));
    editor.check(vec![
        (
            "completion",
            at(7, 8),
            "/0/textEdit/newText",
            json!("9900GXL1"),
        ),
        (
            "completion",
            at(7, 8),
            "/0/detail",
            json!("line to (9.900, 0.000)"),
        ),
        ("signatureHelp", at(7, 8), "/activeParameter", json!(2)),
        (
            "signatureHelp",
            at(7, 8),
            "/signatures/0/label",
            json!("B X B Y B J G Z"),
        ),
    ]);
    editor.close();
}

#[test]
fn lenses_are_for_clients_that_have_the_commands() {
    let mut editor = Editor::open(THREE_B, &format!("{NUMBERED}B9900B0B"));
    let lenses = editor.ask("codeLens", json!({}));
    assert_eq!(
        part(&lenses, "*/command/command").as_array().unwrap()[..3],
        ["wedm.simulate", "wedm.openPicture", "wedm.convertToDxf"]
    );
    assert_eq!(lenses[0]["command"]["arguments"], json!([THREE_B[0]]));
    assert_eq!(
        lenses[3]["command"]["title"],
        "contour 1: closed, 1 block, cut 82.004 mm (19.800 mm of it leads), counter-clockwise"
    );
    editor.close();
    let mut client = Client::start();
    client.open_text(THREE_B[0], THREE_B[1], NUMBERED);
    let params = json!({ "textDocument": { "uri": THREE_B[0] } });
    assert_eq!(
        client.request("textDocument/codeLens", params).unwrap(),
        Value::Null
    );
    client.shut_down();
}

#[test]
fn odd_programs_are_answered_too() {
    let odd = [
        (
            THREE_B,
            &[
                "",
                "\n",
                "DD",
                "D\nD\n",
                "B1B2",
                "\u{feff}B5B0B5GXL1\r\nDD",
                "B0B0B5GXNR1\nB5B0B0GXL1\n",
                "N1\nN2\n;\n;\n",
            ][..],
        ),
        (
            ISO,
            &[
                "",
                "\n",
                "%",
                "G",
                "G03 X5 Y5 I",
                "M98 P1\nM02\nN1 M98 P1\nM99",
                "\u{feff}G01X5\r\nM02",
                "(",
                "G92 X99999999999 Y1e5\nG03 I1 J1\nG41 D",
            ],
        ),
    ];
    let texts = odd
        .iter()
        .flat_map(|(language, texts)| texts.iter().map(|text| (*language, *text)));
    for (language, text) in texts {
        let mut editor = Editor::open(language, text);
        for line in [0, 1, 99] {
            let mut range = in_lines(0, 9);
            range["context"] =
                json!({ "diagnostics": [], "only": ["refactor", "quickfix", "source"] });
            let places = json!({ "positions": [{ "line": line, "character": 1 }] });
            for (method, params) in [
                ("hover", at(line, 1)),
                ("completion", at(line, 99)),
                ("completion", at(line, 1)),
                ("signatureHelp", at(line, 1)),
                ("definition", at(line, 1)),
                ("documentHighlight", at(line, 0)),
                ("prepareRename", at(line, 0)),
                ("documentSymbol", json!({})),
                ("foldingRange", json!({})),
                ("selectionRange", places),
                ("codeLens", json!({})),
                ("codeAction", range.clone()),
                ("inlayHint", range.clone()),
                ("semanticTokens/full", json!({})),
                ("semanticTokens/range", range.clone()),
                ("formatting", range.clone()),
                ("rangeFormatting", range),
            ] {
                editor.ask(method, params);
            }
        }
        editor.close();
    }
}
